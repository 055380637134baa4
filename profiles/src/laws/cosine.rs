//! A raised cosine of the velocity.

use core::f64::consts::PI;

use num_complex::Complex;

use super::{covers, finite_distance, representable, speed_within, symmetric_limits};
use crate::error::PlanError;
use crate::polynomial::{extrema, response};
use crate::profile::{Extrema, Profile};
use crate::quantities::{Limits, Real, Sample};
use crate::section::{Section, Sectioned};
use crate::stretch::Stretch;

/// The motion whose velocity rises and falls along half a period of a cosine.
///
/// A ramp by `dv` in the time `t1` is `v = v0 + dv/2 (1 - cos(pi t / t1))`; its peaks are `pi dv / (2 t1)` of the
/// acceleration and `pi^2 dv / (2 t1^2)` of the jerk, and `t1` is the shortest that holds both limits. The jerk
/// jumps to its peak at both ends of a ramp, so a limit of snap has no meaning for the law. Limits of acceleration
/// and jerk must be symmetric.
///
/// ```
/// use profiles::{Cosine, Limits, Profile};
///
/// let profile = Cosine::velocity_ramp(0.0, 0.2, &Limits::new(0.2, 4.0, 200.0)?)?;
/// assert!((profile.duration() - core::f64::consts::PI * 0.2 / 8.0).abs() < 1e-16);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cosine {
    sections: [Section; 3],
    before: Sample,
    after: Sample,
}

impl Cosine {
    /// The fastest move of this law over a signed `distance` in m.
    ///
    /// # Errors
    /// A distance that is not finite, asymmetric limits, no limit of either acceleration or jerk, or numbers beyond
    /// double precision.
    pub fn rest_to_rest(distance: f64, limits: &Limits) -> Result<Self, PlanError> {
        let length = finite_distance(distance)?.abs();
        let bounds = Bounds::of(limits)?;
        if length == 0.0 {
            return Ok(Self::empty(Sample::default()));
        }
        // Without a cruise h = v t1(v) for each of the two limits in turn.
        let limit = limits.along(distance).velocity().upper;
        let reached = Real::sqrt(bounds.acceleration * length * (2.0 / PI))
            .min(Real::cbrt(bounds.jerk * length * length * (2.0 / (PI * PI))));
        let speed = limit.min(reached);
        let ramp = representable("ramp", bounds.ramp_time(speed))?;
        let down_start = if limit < reached { (length / speed).max(ramp) } else { ramp };
        let duration = representable("duration", down_start + ramp)?;

        covers(speed * down_start, length)?;

        let velocity = speed.copysign(distance);
        let cruise = Sample::cruising(0.5 * velocity * ramp, velocity);
        let wave = Wave { change: velocity, from: 0.0, ramp };
        Ok(Self {
            sections: [
                wave.section(0.0, ramp, 0.0, 0.0),
                Section::cruise(ramp, down_start, cruise),
                wave.section(down_start, duration, duration, distance),
            ],
            before: Sample::default(),
            after: Sample::at_rest(distance),
        })
    }

    /// The fastest change of velocity of this law from `from` to `to`, both in m/s and signed.
    ///
    /// # Errors
    /// A speed that is not finite or outside the limits, asymmetric limits, no limit of either acceleration or
    /// jerk, or numbers beyond double precision.
    pub fn velocity_ramp(from: f64, to: f64, limits: &Limits) -> Result<Self, PlanError> {
        let from = speed_within("start", from, limits.velocity())?;
        let to = speed_within("stop", to, limits.velocity())?;
        let bounds = Bounds::of(limits)?;
        let change = to - from;
        if change == 0.0 {
            return Ok(Self::empty(Sample::cruising(0.0, from)));
        }
        let ramp = representable("ramp", bounds.ramp_time(change.abs()))?;
        let after = Sample::cruising(0.5 * (from + to) * ramp, to);
        let rest = Section::cruise(ramp, ramp, after);
        Ok(Self {
            sections: [Wave { change, from, ramp }.section(0.0, ramp, 0.0, 0.0), rest, rest],
            before: Sample::cruising(0.0, from),
            after,
        })
    }

    /// The same motion in a longer time, see [`Piecewise::stretched_to`](crate::Piecewise::stretched_to).
    ///
    /// # Errors
    /// A duration above 1e75 s or shorter than the motion's own.
    pub fn stretched_to(&self, duration: f64) -> Result<Self, PlanError> {
        let stretch = Stretch::new(self.duration(), duration, self.before.velocity, self.after.velocity)?;
        let sections = self.sections.map(|s| {
            let (start, end, anchor) = (stretch.time(s.start), stretch.time(s.end), stretch.time(s.anchor));
            Section {
                start,
                end,
                anchor,
                reach: stretch.length(s.reach),
                polynomial: stretch.motion(s.polynomial),
                amplitude: stretch.position(s.amplitude),
                angular_frequency: s.angular_frequency * (self.duration() / duration),
                phase: s.phase,
            }
        });
        Ok(Self { sections, before: stretch.motion(self.before), after: stretch.motion(self.after) })
    }

    fn empty(motion: Sample) -> Self {
        let nothing = Section::cruise(0.0, 0.0, motion);
        Self { sections: [nothing; 3], before: motion, after: motion }
    }
}

/// One ramp of the law.
#[derive(Debug, Clone, Copy)]
struct Wave {
    change: f64,
    from: f64,
    ramp: f64,
}

impl Wave {
    /// The ramp expanded about its slow end: rising from there, or falling to it from before.
    fn section(self, start: f64, end: f64, anchor: f64, position: f64) -> Section {
        let w = PI / self.ramp;
        let half = 0.5 * self.change;
        Section {
            start,
            end,
            anchor,
            reach: if anchor > start { -self.ramp } else { self.ramp },
            polynomial: Sample::cruising(position, self.from + half),
            amplitude: -half / w,
            angular_frequency: w,
            phase: 0.0,
        }
    }
}

/// Magnitudes of the limits a ramp must hold; one of them is finite.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    acceleration: f64,
    jerk: f64,
}

impl Bounds {
    fn of(limits: &Limits) -> Result<Self, PlanError> {
        let (acceleration, jerk) = symmetric_limits(limits)?;
        if acceleration.is_infinite() && jerk.is_infinite() {
            return Err(PlanError::Unlimited("acceleration or the jerk"));
        }
        Ok(Self { acceleration, jerk })
    }

    /// The shortest ramp by `speed`, s.
    fn ramp_time(self, speed: f64) -> f64 {
        (0.5 * PI * (speed / self.acceleration)).max(PI * Real::sqrt(speed / (2.0 * self.jerk)))
    }
}

impl Profile for Cosine {
    fn duration(&self) -> f64 {
        let [_, _, fall] = &self.sections;
        fall.end
    }

    fn sample(&self, t: f64) -> Sample {
        if t >= 0.0 {
            match self.sections.iter().find(|section| t < section.end) {
                Some(section) => section.at(t),
                None => self.after.coasted(t - self.duration()),
            }
        } else {
            self.before.coasted(if t < 0.0 { t } else { 0.0 })
        }
    }

    fn extrema(&self) -> Extrema {
        extrema::over(self)
    }

    fn response(&self, p: Complex<f64>) -> Complex<f64> {
        response::over(self, p)
    }
}

impl Sectioned for Cosine {
    const HARMONIC: bool = true;

    fn section(&self, index: usize) -> Option<Section> {
        self.sections.get(index).copied()
    }

    fn before(&self) -> Sample {
        self.before
    }

    fn after(&self) -> Sample {
        self.after
    }
}
