//! Sections: what a cursor, the extrema and the response need to know of a law.

use crate::profile::Profile;
use crate::quantities::{Real, Sample};

/// A profile made of a few sections, each a polynomial of at most the fourth degree plus at most one sine.
///
/// A [`Cursor`](crate::Cursor) runs any of them on a fixed clock.
pub trait Sectioned: Profile {
    /// Whether any section has a sine.
    const HARMONIC: bool;

    /// The section with this index in order of time, `None` past the last one.
    fn section(&self, index: usize) -> Option<Section>;

    /// The motion before the start, at the start.
    fn before(&self) -> Sample;

    /// The motion after the end, at the end.
    fn after(&self) -> Sample;
}

/// One section: `polynomial(t - anchor) + amplitude sin(w (t - anchor))` for `start <= t < end`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// First instant of the section, s.
    pub start: f64,
    /// End of the section, s.
    pub end: f64,
    /// Time about which the section is expanded, s.
    pub anchor: f64,
    /// The polynomial part at the anchor.
    pub polynomial: Sample,
    /// Amplitude of the sine in the position, m.
    pub amplitude: f64,
    /// Angular frequency `w` of the sine, rad/s.
    pub angular_frequency: f64,
}

impl Section {
    /// A section without a sine.
    #[must_use]
    pub fn polynomial(start: f64, end: f64, anchor: f64, polynomial: Sample) -> Self {
        Self { start, end, anchor, polynomial, amplitude: 0.0, angular_frequency: 0.0 }
    }

    /// The motion at time `t`, s, the section's formula going on outside it.
    #[must_use]
    pub fn at(&self, t: f64) -> Sample {
        let x = t - self.anchor;
        with_sine(self.polynomial.advanced(x), self.amplitude, self.angular_frequency, x)
    }

    /// Length of the section, s.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.end - self.start
    }
}

/// `motion` plus `amplitude sin(w x)` and its derivatives.
#[inline]
pub(crate) fn with_sine<F: Real>(motion: Sample<F>, amplitude: F, w: F, x: F) -> Sample<F> {
    if amplitude == F::ZERO {
        return motion;
    }
    let (sine, cosine) = (w * x).sin_cos();
    let velocity = amplitude * w;
    let acceleration = velocity * w;
    let jerk = acceleration * w;
    Sample {
        position: motion.position + amplitude * sine,
        velocity: motion.velocity + velocity * cosine,
        acceleration: motion.acceleration - acceleration * sine,
        jerk: motion.jerk - jerk * cosine,
        snap: motion.snap + jerk * w * sine,
    }
}
