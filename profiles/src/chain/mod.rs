//! Moves without vibration by averages.

mod link;
mod plan;
mod step;

use num_complex::Complex;

pub use link::Link;
use plan::{Demand, Plan, shortest};
use step::{Knot, Step};

use crate::error::{ChainError, PlanError};
use crate::laws::{SCurve, finite_distance, finite_limit, representable, symmetric_limits};
use crate::polynomial::{Piece, Piecewise};
use crate::profile::{Extrema, Profile};
use crate::quantities::{Limits, Mode, Sample};
use crate::section::{Section, Sectioned};

/// Modes a chain can leave at rest.
const MOST_MODES: usize = 4;
/// Links of the longest chain: a pair for every mode, and plain averages; or an average for every mode.
const MOST_LINKS: usize = MOST_MODES + 3;

/// A move from rest to rest that leaves nothing of given modes: a step through a chain of averages, in at most `N`
/// polynomial sections.
///
/// An S-curve is a step through three plain averages. Here an average over damped periods of a mode takes the place of
/// one of them, or a pair of weights half a period apart is added, whichever makes the shorter move; see [`Link`]. The
/// zero is exact, whatever the damping, and limits of velocity, acceleration and jerk hold. Nothing is searched:
/// every way to share out the parts has a closed form.
///
/// With room for 15 sections there is a chain for any mode, with 31 for any two, 63 for three and 127 for four. With 23, 47,
/// 95 and 191 an average over one period can take the place of a plain one; the shortest chain that fits is taken.
/// Limits of acceleration and jerk must be symmetric; limits of snap have no meaning for the law.
///
/// ```
/// use profiles::{Chain, Limits, Mode, Profile, SCurve, residual_vibration};
///
/// let limits = Limits::new(0.5, 5.0, 200.0)?;
/// let modes = [Mode::from_hz(8.0, 0.02)?, Mode::from_hz(18.4, 0.02)?];
/// let chain = Chain::<47>::rest_to_rest(0.1, &limits, &modes)?;
/// for mode in modes {
///     assert!(residual_vibration(&chain, mode) < 1e-15); // m
/// }
/// // What it costs beside the S-curve, s
/// let s_curve = SCurve::rest_to_rest(0.1, &limits)?;
/// assert!((chain.price() - (chain.duration() - s_curve.duration())).abs() < 1e-15);
/// assert!(chain.price() < 0.08);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # References
/// L. Biagiotti, C. Melchiorri, FIR filters for online trajectory planning with time- and frequency-domain
/// specifications, Control Engineering Practice 20 (2012) 1385-1399,
/// [doi:10.1016/j.conengprac.2012.08.005](https://doi.org/10.1016/j.conengprac.2012.08.005).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chain<const N: usize> {
    motion: Piecewise<N>,
    links: [Link; MOST_LINKS],
    len: usize,
    price: f64,
}

impl<const N: usize> Chain<N> {
    /// The shortest such move over a signed `distance` in m that leaves nothing of any of `modes`, of which there may be
    /// up to four; a mode that is given twice gets a zero of order two.
    ///
    /// # Errors
    /// A distance that is not finite, asymmetric limits, an unlimited jerk, more than four modes, more sections than `N`,
    /// or numbers beyond double precision.
    pub fn rest_to_rest(distance: f64, limits: &Limits, modes: &[Mode]) -> Result<Self, ChainError> {
        let distance = finite_distance(distance)?;
        let (acceleration, jerk) = symmetric_limits(limits)?;
        let jerk = finite_limit("jerk", jerk)?;
        if modes.len() > MOST_MODES {
            return Err(ChainError::Modes { modes: modes.len(), most: MOST_MODES });
        }
        let nothing = Link::Average { length: 0.0 };
        let mut chain =
            Self { motion: Piecewise::empty(0.0), links: [nothing; MOST_LINKS], len: 0, price: 0.0 };
        if distance == 0.0 {
            return Ok(chain);
        }
        let s_curve = SCurve::rest_to_rest(distance, limits)?.duration();
        let length = distance.abs();
        let demand = Demand {
            velocity: length / limits.along(distance).velocity().upper,
            acceleration: length / acceleration,
            jerk: length / jerk,
        };
        let Plan { modes, plain } =
            shortest(demand, modes, N).map_err(|needed| ChainError::Sections { needed, capacity: N })?;
        let plain = plain.into_iter().filter(|length| *length > 0.0).map(|length| Link::Average { length });
        for link in plain.chain(modes.into_iter().flatten()) {
            chain.push(link)?;
        }
        let step = chain.step(false)?;
        // Every candidate is verified: the weights of each link must add up to one.
        if step.end_error().is_nan() || step.end_error() > 1e-12 {
            return Err(PlanError::Range { quantity: "distance", value: distance }.into());
        }
        representable("duration", step.end())?;
        chain.motion = joined(&step, &chain.step(true)?, distance);
        chain.price = chain.motion.duration() - s_curve;
        Ok(chain)
    }

    /// The unit step through the links, or through their mirror images.
    fn step(&self, mirrored: bool) -> Result<Step<N>, ChainError> {
        let sections = ChainError::Sections { needed: N.saturating_add(1), capacity: N };
        self.links().iter().try_fold(Step::unit(), |step, link| step.through(link, mirrored).ok_or(sections))
    }

    /// Adds a link where it stands by its length.
    fn push(&mut self, link: Link) -> Result<(), PlanError> {
        representable("average", link.duration())?;
        let after = self.links().iter().filter(|kept| kept.duration() <= link.duration()).count();
        let mut carried = link;
        for place in self.links.iter_mut().take(self.len + 1).skip(after) {
            core::mem::swap(place, &mut carried);
        }
        self.len += 1;
        Ok(())
    }

    /// The links, the shortest first; their order does not matter to the motion.
    #[must_use]
    pub fn links(&self) -> &[Link] {
        self.links.get(..self.len).unwrap_or_default()
    }

    /// What the move takes longer than the S-curve within the same limits, s.
    #[must_use]
    pub fn price(&self) -> f64 {
        self.price
    }

    /// The sections of the move.
    #[must_use]
    pub fn as_piecewise(&self) -> &Piecewise<N> {
        &self.motion
    }
}

/// The move over `distance`: `forward` as far as half way, and from there on `backward` seen from the end, so that both
/// ends are exact and sections shorter than the rounding of an instant keep their length.
fn joined<const N: usize>(forward: &Step<N>, backward: &Step<N>, distance: f64) -> Piecewise<N> {
    let duration = forward.end();
    let (rising, falling) = (forward.knots(), backward.knots());
    // A knot that is half way but for rounding starts the second half.
    let half = 0.5 * duration * (1.0 - 16.0 * f64::EPSILON);
    let count = rising.iter().filter(|knot| knot.start < half).count();
    let met = rising.get(count.saturating_sub(1)).map_or(0.0, |knot| knot.start + knot.length);
    let left = falling.iter().take(rising.len() - count);
    let rest: f64 = left.clone().map(|knot| knot.length).sum();
    // Rounding may have split the two differently; then one of them serves.
    let one =
        rising.len() == falling.len() && (met + rest - duration).abs() <= 64.0 * f64::EPSILON * duration;
    let (count, left) = if one { (count, left) } else { (rising.len(), falling.iter().take(0)) };

    let mut ends = [duration; N];
    let mut pieces = [Piece::new(duration, 0.0, Sample::at_rest(distance)); N];
    let first = rising.iter().take(count).map(|knot| {
        (knot.start + knot.length, Piece::new(knot.start, knot.length, start_of(knot, distance)))
    });
    let second = left.rev().map(|knot| {
        let end = duration - knot.start;
        (end, Piece::new(end, -knot.length, end_of(knot, distance)))
    });
    for ((end, piece), section) in ends.iter_mut().zip(&mut pieces).zip(first.chain(second)) {
        (*end, *piece) = section;
    }
    // The last instant is the end, to the bit.
    if let Some(end) = rising.len().checked_sub(1).and_then(|last| ends.get_mut(last)) {
        *end = duration;
    }
    Piecewise { ends, pieces, before: 0.0, target: distance, after: 0.0, duration }
}

/// The motion from a knot on.
fn start_of(knot: &Knot, distance: f64) -> Sample {
    let Sample { position, velocity, acceleration, jerk, snap } = knot.motion;
    Sample {
        position: distance * position,
        velocity: distance * velocity,
        acceleration: distance * acceleration,
        jerk: distance * jerk,
        snap: distance * snap,
    }
}

/// The motion up to a knot that counts from the end.
fn end_of(knot: &Knot, distance: f64) -> Sample {
    let Sample { position, velocity, acceleration, jerk, snap } = start_of(knot, distance);
    Sample { position: distance - position, velocity, acceleration: -acceleration, jerk, snap: -snap }
}

impl<const N: usize> Profile for Chain<N> {
    fn duration(&self) -> f64 {
        self.motion.duration()
    }

    #[inline]
    fn sample(&self, t: f64) -> Sample {
        self.motion.sample(t)
    }

    fn extrema(&self) -> Extrema {
        self.motion.extrema()
    }

    /// `p h` times the product of the responses of the links.
    fn response(&self, p: Complex<f64>) -> Complex<f64> {
        self.links().iter().fold(p * self.motion.target, |product, link| product * link.response(p))
    }
}

impl<const N: usize> Sectioned for Chain<N> {
    const HARMONIC: bool = false;

    fn section(&self, index: usize) -> Option<Section> {
        self.motion.section(index)
    }

    fn section_at(&self, t: f64) -> Option<Section> {
        self.motion.section_at(t)
    }

    fn before(&self) -> Sample {
        self.motion.before()
    }

    fn after(&self) -> Sample {
        self.motion.after()
    }
}
