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
/// never carries absolute time. Tick `k` is the instant `k` times the period, at a boundary where it is within four
/// roundings of it; after the end the cursor goes on
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
    /// The tick about which the motion is expanded.
    first: u64,
    /// Ticks since then, and how many the expansion serves.
    since: u32,
    served: u32,
    /// The period in the precision of the tick.
    step: F,
    motion: Expansion<F>,
}

/// A section about one tick: Taylor coefficients of the position and of its derivatives, and a sine.
#[derive(Debug, Clone, Copy, Default)]
struct Expansion<F> {
    /// Highest powers of position and velocity, from the fourth down, side by side: what stands side by side takes
    /// one vector instruction.
    high: [[F; 2]; 3],
    /// Second power of acceleration and jerk.
    square: [F; 2],
    /// First power and constant of position, velocity, acceleration and jerk.
    low: [[F; 4]; 2],
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
            first: 0,
            since: 0,
            served: 0,
            step: F::from_f64(period),
            motion: Expansion::default(),
        })
    }

    /// The motion at the present tick, then on to the next one.
    #[inline]
    pub fn tick(&mut self) -> Sample<F> {
        if self.since >= self.served {
            self.expand();
        }
        // One integer is all that a tick carries to the next.
        let x = F::from_u32(self.since) * self.step;
        self.since += 1;
        let sample = self.motion.at(x);
        if P::HARMONIC { self.motion.with_sine(sample, x) } else { sample }
    }

    /// The number of the tick that comes next.
    #[must_use]
    pub fn next_tick(&self) -> u64 {
        self.first.wrapping_add(u64::from(self.since))
    }

    /// Goes to a tick, forward or back.
    pub fn seek(&mut self, tick: u64) {
        self.first = tick;
        self.since = 0;
        self.served = 0;
    }

    /// Whether the tick that comes next is at or after the end.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        let duration = self.profile.duration();
        self.next_tick() as f64 * self.period >= duration - instant_rounding(duration)
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
        self.first = self.next_tick();
        self.since = 0;
        let mut now = self.first as f64 * self.period;
        now += instant_rounding(now);
        let section = self.profile.section_at(now).unwrap_or_else(|| {
            let end = self.profile.duration();
            Section::cruise(end, f64::INFINITY, self.profile.after())
        });
        self.motion = Expansion::about(now, &section);
        // The cast saturates.
        self.served = (Real::ceil((section.end - now) / self.period) as u32).clamp(1, BLOCK);
    }
}

impl<F: Real> Expansion<F> {
    fn about(now: f64, section: &Section) -> Self {
        let x = section.local(now);
        let Sample { position: p, velocity: v, acceleration: a, jerk: j, snap: s } =
            section.polynomial.advanced(x);
        let cast = F::from_f64;
        Self {
            high: [[s / 24.0, 0.0], [j / 6.0, s / 6.0], [a / 2.0, j / 2.0]].map(|pair| pair.map(cast)),
            square: [s / 2.0, 0.0].map(cast),
            low: [[v, a, j, s], [p, v, a, j]].map(|row| row.map(cast)),
            amplitude: cast(section.amplitude),
            phase: cast(section.angle(x)),
            angular_frequency: cast(section.angular_frequency),
        }
    }

    #[inline(always)]
    fn at(&self, x: F) -> Sample<F> {
        let pair = |[a, b]: [F; 2], [c, d]: [F; 2]| [a * x + c, b * x + d];
        let row = |[a, b, c, d]: [F; 4], [e, f, g, h]: [F; 4]| [a * x + e, b * x + f, c * x + g, d * x + h];
        let [fourth, third, second] = self.high;
        let [first, constant] = self.low;
        let [p, v] = pair(pair(fourth, third), second);
        let [a, j] = self.square;
        let [position, velocity, acceleration, jerk] = row(row([p, v, a, j], first), constant);
        let [_, _, _, snap] = first;
        Sample { position, velocity, acceleration, jerk, snap }
    }

    #[inline]
    fn with_sine(&self, motion: Sample<F>, x: F) -> Sample<F> {
        let w = self.angular_frequency;
        with_sine(motion, self.amplitude, w, w * x + self.phase)
    }
}

/// How much rounding may displace an instant, s: a tick that close to a boundary is at it.
pub(crate) fn instant_rounding(t: f64) -> f64 {
    4.0 * f64::EPSILON * t
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
