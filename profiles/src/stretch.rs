//! Uniform stretching in time.

use crate::error::PlanError;
use crate::quantities::Sample;

/// The longest duration, s: its fourth power must be finite.
const LONGEST: f64 = 1e75;

/// How a motion of one duration becomes one of another.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stretch {
    ratio: f64,
    rate: f64,
    keeps_speeds: bool,
    shortest: f64,
    duration: f64,
}

impl Stretch {
    /// From `shortest` to `duration`, s; what moves before or after it, with these velocities in m/s, is a ramp and
    /// keeps its speeds.
    pub(crate) fn new(shortest: f64, duration: f64, before: f64, after: f64) -> Result<Self, PlanError> {
        if !(duration <= LONGEST && duration >= shortest && shortest > 0.0) {
            return Err(PlanError::Duration { requested: duration, shortest });
        }
        Ok(Self {
            ratio: duration / shortest,
            rate: shortest / duration,
            keeps_speeds: before != 0.0 || after != 0.0,
            shortest,
            duration,
        })
    }

    /// Where the instant `t` goes, s.
    pub(crate) fn time(&self, t: f64) -> f64 {
        if t < self.shortest { (t * self.ratio).min(self.duration) } else { self.duration }
    }

    /// What a length of time becomes, s.
    pub(crate) fn length(&self, length: f64) -> f64 {
        length * self.ratio
    }

    /// What a position becomes, m: longer for a ramp, the same for a move.
    pub(crate) fn position(&self, position: f64) -> f64 {
        if self.keeps_speeds { position * self.ratio } else { position }
    }

    /// What a velocity becomes, m/s: the same for a ramp, lower for a move.
    pub(crate) fn speed(&self, velocity: f64) -> f64 {
        if self.keeps_speeds { velocity } else { velocity * self.rate }
    }

    /// What a motion becomes.
    pub(crate) fn motion(&self, motion: Sample) -> Sample {
        let rate = self.rate;
        Sample {
            position: self.position(motion.position),
            velocity: self.speed(motion.velocity),
            acceleration: self.speed(motion.acceleration) * rate,
            jerk: self.speed(motion.jerk) * (rate * rate),
            snap: self.speed(motion.snap) * (rate * rate * rate),
        }
    }
}
