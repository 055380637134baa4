//! Sections: what a cursor, the extrema and the response need to know of a law.

use crate::profile::Profile;
use crate::quantities::{Real, Sample};

/// A profile made of a few sections, each a polynomial of at most the fourth degree plus at most one sine. All sines
/// of a profile have the same angular frequency.
///
/// A [`Cursor`](crate::Cursor) runs any of them on a fixed clock.
pub trait Sectioned: Profile {
    /// Whether any section has a sine.
    const HARMONIC: bool;

    /// The section with this index in order of time, `None` past the last one.
    fn section(&self, index: usize) -> Option<Section>;

    /// The section in which the instant `t` in s lies: the first one before the start, `None` from the end on.
    fn section_at(&self, t: f64) -> Option<Section> {
        (0..).map_while(|index| self.section(index)).find(|section| t < section.end)
    }

    /// The motion before the start, at the start.
    fn before(&self) -> Sample;

    /// The motion after the end, at the end.
    fn after(&self) -> Sample;
}

impl<P: Sectioned> Sectioned for &P {
    const HARMONIC: bool = P::HARMONIC;
    fn section(&self, index: usize) -> Option<Section> {
        (**self).section(index)
    }
    fn section_at(&self, t: f64) -> Option<Section> {
        (**self).section_at(t)
    }
    fn before(&self) -> Sample {
        (**self).before()
    }
    fn after(&self) -> Sample {
        (**self).after()
    }
}

/// One section: `polynomial(x) + amplitude sin(w x + phase)` of the local time `x = t - anchor`, for `start <= t < end`.
///
/// An instant `t` far from zero is coarser than a short section. The local time is therefore kept within
/// `[0, reach]` (or `[reach, 0]`), so that no value leaves the range it was planned for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// First instant of the section, s.
    pub start: f64,
    /// End of the section, s.
    pub end: f64,
    /// Time about which the section is expanded, s: its start or its end.
    pub anchor: f64,
    /// Planned length, s: positive where the anchor is the start, negative where it is the end.
    pub reach: f64,
    /// The polynomial part at the anchor.
    pub polynomial: Sample,
    /// Amplitude of the sine in the position, m.
    pub amplitude: f64,
    /// Angular frequency `w` of the sine, rad/s.
    pub angular_frequency: f64,
    /// Phase of the sine at the anchor, rad.
    pub phase: f64,
}

impl Section {
    /// A section of constant velocity from `start` to `end`.
    #[must_use]
    pub(crate) fn cruise(start: f64, end: f64, motion: Sample) -> Self {
        let reach = end - start;
        Self {
            start,
            end,
            anchor: start,
            reach,
            polynomial: motion,
            amplitude: 0.0,
            angular_frequency: 0.0,
            phase: 0.0,
        }
    }

    /// The local time of the instant `t`, s.
    #[must_use]
    pub fn local(&self, t: f64) -> f64 {
        local_time(t, self.anchor, self.reach)
    }

    /// The motion at the instant `t`, s; that of the nearer end outside the section.
    #[must_use]
    pub fn at(&self, t: f64) -> Sample {
        self.at_local(self.local(t))
    }

    /// Length, s.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.reach.abs()
    }

    /// Local time of the start and of the end, s.
    #[must_use]
    pub fn local_ends(&self) -> (f64, f64) {
        (self.reach.min(0.0), self.reach.max(0.0))
    }

    /// Angle of the sine at the local time `x` in s, rad.
    #[must_use]
    pub(crate) fn angle(&self, x: f64) -> f64 {
        self.angular_frequency * x + self.phase
    }

    /// The motion at the local time `x`, s.
    #[must_use]
    #[inline]
    pub fn at_local(&self, x: f64) -> Sample {
        with_sine(self.polynomial.advanced(x), self.amplitude, self.angular_frequency, self.angle(x))
    }
}

/// `t - anchor`, brought into the section.
#[inline]
pub(crate) fn local_time(t: f64, anchor: f64, reach: f64) -> f64 {
    // Written so that each line is one minimum or maximum instruction; an instant is never NaN here.
    let from = if reach < 0.0 { reach } else { 0.0 };
    let to = if reach > 0.0 { reach } else { 0.0 };
    let x = t - anchor;
    let x = if x > from { x } else { from };
    if x < to { x } else { to }
}

/// `motion` plus a sine of angular frequency `w` at `angle`, and its derivatives.
#[inline]
pub(crate) fn with_sine<F: Real>(motion: Sample<F>, amplitude: F, w: F, angle: F) -> Sample<F> {
    if amplitude == F::ZERO {
        return motion;
    }
    let (sine, cosine) = angle.sin_cos();
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
