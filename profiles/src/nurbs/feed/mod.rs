//! A feed along a curve: look-ahead over all of it, and the motion of every axis at every tick.

mod block;
mod caps;
mod cell;
mod check;
mod coordinates;
mod enclosure;
mod error;
mod grid;
mod jet;
mod law;
mod limits;
mod path;
mod plan;
mod polish;
mod profile;
mod ramp;
mod report;
mod sample;
mod steps;

pub use coordinates::{AxisMotion, CoordinateList};
pub use error::FeedError;
pub use law::{FeedLaw, PolynomialLaw};
pub use limits::FeedLimits;
pub use profile::FeedProfile;
pub use report::{FeedReport, Peak};
pub use sample::{FeedSample, Ticks};

use crate::cursor::{Cursor, check_clock, instant_rounding};
use crate::laws::SCurve;
use crate::nurbs::{ArcLength, NurbsCurve, Side};
use crate::profile::Profile;
use crate::quantities::{Real, Sample};
use check::Check;
use path::Path;
use profile::Sections;

/// How well the length of a curve is known, in roundings of it.
const ROUNDINGS: f64 = 16.0;

/// A feed along a curve in `D` dimensions, planned and complete; changes of feed follow the law `L`.
#[derive(Debug, Clone)]
pub struct FeedInterpolator<const D: usize, L = SCurve> {
    arc: ArcLength<D>,
    limits: FeedLimits<D>,
    path: Path<D>,
    feed: FeedProfile<L>,
}

impl<const D: usize> FeedInterpolator<D> {
    /// The feed along `curve` within `limits`, changed by S-curves.
    ///
    /// # Errors
    /// As for [`with_law`](Self::with_law).
    pub fn new(curve: NurbsCurve<D>, limits: FeedLimits<D>) -> Result<Self, FeedError> {
        Self::with_law(curve, limits)
    }
}

impl<const D: usize, L: FeedLaw> FeedInterpolator<D, L> {
    /// The feed along `curve` within `limits`, changed by the law `L`.
    ///
    /// # Errors
    /// A curve without length; one so rough that bounding it takes more than 131 072 cells; a law whose acceleration
    /// jumps where jerk is limited, or that misses a limit that it needs; more ticks than can be counted; numbers
    /// beyond double precision.
    pub fn with_law(curve: NurbsCurve<D>, limits: FeedLimits<D>) -> Result<Self, FeedError> {
        if !L::CONTINUOUS {
            let jerks = limits.axes().iter().map(|axis| axis.jerk().magnitude()).enumerate();
            if let Some((axis, limit)) = jerks.into_iter().find(|(_, limit)| limit.is_finite()) {
                return Err(FeedError::Jumps { axis, limit });
            }
        }
        let size = curve.polygon_length();
        if !(size > 0.0 && size.is_finite()) {
            return Err(FeedError::Length(size));
        }
        let arc = ArcLength::new(curve, ROUNDINGS * f64::EPSILON * size)?;
        let path = Path::new(&arc, &limits)?;
        let mut motion = Sections::new();
        for block in caps::blocks(&path, &limits) {
            let plan = Check { block: &block, limits: &limits }.plan::<L>()?;
            motion.append(&plan, block.end(), limits.period());
        }
        check_clock(motion.duration(), limits.period())?;
        Ok(Self { arc, limits, path, feed: FeedProfile::new(motion) })
    }
}

impl<const D: usize, L> FeedInterpolator<D, L> {
    /// The curve.
    #[must_use]
    pub fn curve(&self) -> &NurbsCurve<D> {
        self.arc.curve()
    }

    /// What the feed keeps.
    #[must_use]
    pub fn limits(&self) -> &FeedLimits<D> {
        &self.limits
    }

    /// Length of the curve, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.arc.length()
    }

    /// The way along the curve over time.
    #[must_use]
    pub fn feed(&self) -> &FeedProfile<L> {
        &self.feed
    }

    /// Duration, s: a whole number of periods.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.feed.sections().duration()
    }

    /// The number of the tick at which the motion ends, the start being tick zero.
    #[must_use]
    pub fn last_tick(&self) -> u64 {
        let duration = self.duration();
        Real::ceil((duration - instant_rounding(duration)) / self.limits.period()) as u64
    }

    /// The motion at the instant `t`, s; at rest before the start and after the end.
    #[must_use]
    pub fn sample(&self, t: f64) -> FeedSample<D> {
        let along = self.feed.sections().sample(t);
        self.at(t, along)
    }

    /// The motion at every tick, from the first to the last one.
    ///
    /// # Errors
    /// None for what the constructors made: the clock was checked.
    pub fn ticks(&self) -> Result<Ticks<'_, D, L>, FeedError> {
        let cursor = Cursor::new(self.feed.sections(), self.limits.period())?;
        Ok(Ticks::new(self, cursor, self.last_tick()))
    }

    /// The points at every tick, for the drives.
    ///
    /// # Errors
    /// As for [`ticks`](Self::ticks).
    pub fn coordinates(&self) -> Result<CoordinateList<D>, FeedError> {
        let ticks = self.ticks()?.map(|sample| (sample.position, sample.velocity));
        Ok(CoordinateList::new(self.limits.period(), ticks))
    }

    /// The motion at a place along the curve.
    fn at(&self, time: f64, along: Sample) -> FeedSample<D> {
        let (curve, cell) = (self.curve(), self.path.cells.get(self.path.cell_at(along.position)));
        let mut parameter = self.arc.parameter_at(along.position);
        let mut side = Side::After;
        // Where two cells meet rounding must not choose the side: at a corner it is the one ahead.
        if let Some(cell) = cell {
            parameter = parameter.clamped(cell.from, cell.to);
            if parameter >= cell.to || along.position >= cell.end {
                (parameter, side) = (cell.to, Side::Before);
            }
        }
        let derivatives = curve.by_length(parameter, side);
        FeedSample::new(time, along, parameter, derivatives, || curve.point(parameter))
    }
}
