//! Uniform stretching in time.

use crate::error::PlanError;
use crate::quantities::Sample;

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
    /// From `shortest` to `duration`, s; what moves before or after it is a ramp and keeps its speeds.
    pub(crate) fn new(
        shortest: f64,
        duration: f64,
        before: Sample,
        after: Sample,
    ) -> Result<Self, PlanError> {
        if !(duration.is_finite() && duration >= shortest && shortest > 0.0) {
            return Err(PlanError::Duration { requested: duration, shortest });
        }
        Ok(Self {
            ratio: duration / shortest,
            rate: shortest / duration,
            keeps_speeds: before.velocity != 0.0 || after.velocity != 0.0,
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

    /// Where a motion goes.
    pub(crate) fn motion(&self, motion: Sample) -> Sample {
        let (position, speed) = self.scales();
        Sample {
            position: motion.position * position,
            velocity: motion.velocity * speed,
            acceleration: motion.acceleration * (speed * self.rate),
            jerk: motion.jerk * (speed * self.rate * self.rate),
            snap: motion.snap * (speed * self.rate * self.rate * self.rate),
        }
    }

    /// The factors of position and of velocity.
    pub(crate) fn scales(&self) -> (f64, f64) {
        if self.keeps_speeds { (self.ratio, 1.0) } else { (1.0, self.rate) }
    }
}
