//! A profile on a fixed clock.

use crate::error::ClockError;
use crate::quantities::{Real, Sample};
use crate::section::{Section, Sectioned, with_sine};

/// Ticks after which a section is expanded anew, so that the local time stays short and exact in `f32`.
const BLOCK: u32 = 1 << 12;

/// The most ticks a profile may last: every count up to here is exact in `f64`.
const MOST_TICKS: f64 = 9_007_199_254_740_992.0;

/// Runs a profile tick by tick in `f32` or `f64`.
///
/// The plan stays in double precision. At the start of a section (and every 4096 ticks) it is expanded about the
/// present tick; in between a tick costs one short polynomial in the time since then, so that single precision
/// never carries absolute time. Tick `k` is the instant `k` times the period; after the end the cursor goes on
/// with the motion after the profile.
///
/// ```
/// use profiles::{Cursor, Limits, Profile, SCurve};
///
/// let profile = SCurve::rest_to_rest(0.04, &Limits::new(0.2, 4.0, 200.0)?)?;
/// let mut cursor = Cursor::<_, f32>::new(profile, 1e-3)?;
/// while !cursor.is_finished() {
///     let reference = cursor.tick();
///     assert!(reference.velocity <= 0.2001);
/// }
/// assert_eq!(cursor.tick().position, 0.04);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Cursor<P, F> {
    profile: P,
    period: f64,
    /// The tick that comes next.
    tick: u64,
    /// Ticks left before the motion must be expanded anew.
    left: u32,
    /// Ticks since the motion was expanded, and the period, in the precision of the tick.
    since: F,
    step: F,
    motion: Sample<F>,
    /// The sine of the section: amplitude of its sine and cosine parts about the expansion, and `w`.
    sine: Turning<F>,
}

/// `sine sin(w x) + cosine cos(w x)` in the position, as the phase of a section's sine at the expansion.
#[derive(Debug, Clone, Copy, Default)]
struct Turning<F> {
    amplitude: F,
    phase: F,
    angular_frequency: F,
}

impl<P: Sectioned, F: Real> Cursor<P, F> {
    /// A cursor at the start of `profile` (by value or by reference) with a tick every `period` seconds.
    ///
    /// # Errors
    /// A period that is not positive and finite, or so short that ticks could not be counted exactly.
    pub fn new(profile: P, period: f64) -> Result<Self, ClockError> {
        check_clock(profile.duration(), period)?;
        Ok(Self {
            profile,
            period,
            tick: 0,
            left: 0,
            since: F::ZERO,
            step: F::from_f64(period),
            motion: Sample::default(),
            sine: Turning::default(),
        })
    }

    /// The motion at the present tick, then on to the next one.
    #[inline]
    pub fn tick(&mut self) -> Sample<F> {
        if self.left == 0 {
            self.expand();
        }
        let x = self.since * self.step;
        self.left -= 1;
        self.tick = self.tick.wrapping_add(1);
        self.since += F::ONE;
        let motion = self.motion.advanced(x);
        if P::HARMONIC { self.sine.added_to(motion, x) } else { motion }
    }

    /// The number of the tick that comes next.
    #[must_use]
    pub fn next_tick(&self) -> u64 {
        self.tick
    }

    /// Goes to a tick, forward or back.
    pub fn seek(&mut self, tick: u64) {
        self.tick = tick;
        self.left = 0;
    }

    /// Whether the tick that comes next is at or after the end.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.tick as f64 * self.period >= self.profile.duration()
    }

    /// The profile.
    #[must_use]
    pub fn profile(&self) -> &P {
        &self.profile
    }

    /// Expands the motion about the present tick.
    #[cold]
    #[inline(never)]
    fn expand(&mut self) {
        let now = self.tick as f64 * self.period;
        let mut index = 0;
        let section = loop {
            match self.profile.section(index) {
                Some(section) if section.end <= now => index += 1,
                Some(section) => break Some(section),
                None => break None,
            }
        };
        let duration = self.profile.duration();
        let (section, until) = match section {
            Some(section) => (section, section.end),
            None => {
                (Section::polynomial(duration, f64::INFINITY, duration, self.profile.after()), f64::INFINITY)
            }
        };
        let x = now - section.anchor;
        let motion = section.polynomial.advanced(x);
        self.motion = Sample {
            position: F::from_f64(motion.position),
            velocity: F::from_f64(motion.velocity),
            acceleration: F::from_f64(motion.acceleration),
            jerk: F::from_f64(motion.jerk),
            snap: F::from_f64(motion.snap),
        };
        if P::HARMONIC {
            self.sine = Turning {
                amplitude: F::from_f64(section.amplitude),
                phase: F::from_f64(section.angular_frequency * x),
                angular_frequency: F::from_f64(section.angular_frequency),
            };
        }
        // The cast saturates; a rounded quotient may leave one tick to the wrong side of a boundary by rounding,
        // where both sides agree.
        let ticks = Real::ceil((until - now) / self.period);
        self.left = (ticks as u32).clamp(1, BLOCK);
        self.since = F::ZERO;
    }
}

impl<F: Real> Turning<F> {
    #[inline]
    fn added_to(self, motion: Sample<F>, x: F) -> Sample<F> {
        let w = self.angular_frequency;
        if w == F::ZERO { motion } else { with_sine(motion, self.amplitude, w, x + self.phase / w) }
    }
}

/// Whether a clock of this period can count through a profile.
pub(crate) fn check_clock(duration: f64, period: f64) -> Result<(), ClockError> {
    if !(period > 0.0 && period.is_finite()) {
        return Err(ClockError::Period(period));
    }
    if duration / period > MOST_TICKS {
        return Err(ClockError::TooManyTicks { period, duration });
    }
    Ok(())
}
