//! A profile as pulses for a drive with step and direction inputs.

mod counts;
mod iter;
mod periods;
mod run;

pub use counts::Counts;
pub use iter::{Direction, Pulse, Pulses};
pub use periods::{Period, Periods};

use crate::error::PulseError;
use crate::quantities::Real;
use crate::section::Sectioned;
use run::Runs;

/// The most pulses that could be sent at top speed over the duration of a profile: 2^40 leave each of them 4096
/// roundings of its instant and of its position.
const MOST_PULSES: f64 = 1_099_511_627_776.0;

/// Roundings of the largest position by which a profile may miss a position it was planned for.
const ROUNDINGS: f64 = 16.0;

/// A profile as integer pulses: pulse `k` is sent when the position crosses `k - 1/2` pulses, in either direction.
///
/// The sum of the pulses sent is then always the position rounded to whole pulses, never more than half a pulse away
/// from it, and in the end it is exactly `round(distance / size)`, halves away from zero. What a distance is short of
/// whole pulses is told by [`end_error`](Self::end_error), so that the next move can make up for it.
///
/// The first pulse comes half a pulse after the start and the last one half a pulse before the end: with start and stop
/// speeds the first and the last interval within the move are those of the start and of the stop frequency, the
/// first pulse comes half an interval after the start, and a move that follows without delay keeps the spacing.
///
/// A profile that turns just beyond a crossing sends a pulse there and takes it back: two pulses as near as the profile
/// asks. [`with_shortest_interval`](Self::with_shortest_interval) and [`with_reversal_time`](Self::with_reversal_time)
/// say what a drive can take; a profile that asks for more is an error and never merged or delayed. A profile that only
/// touches a crossing, to 16 roundings of its largest position, does not send it.
///
/// A change of velocity is sent until it ends, with `round(target / size)` pulses.
///
/// ```
/// use profiles::{Direction, Limits, PulseTrain, Trapezoid};
///
/// // 4000 pulses of 1 um, from 10 kHz towards 300 kHz with 10 000 kHz/s
/// let limits = Limits::new(0.3, 10.0, f64::INFINITY)?;
/// let profile = Trapezoid::with_speeds(4e-3, 0.01, 0.01, &limits)?;
/// let train = PulseTrain::new(profile, 1e-6)?.with_shortest_interval(1.0 / 300e3)?;
/// assert_eq!(train.total(), 4000);
/// let mut pulses = train.pulses();
/// let first = pulses.next().ok_or("no pulse")?;
/// // half an interval of the start frequency, less 1.2 us for speeding up meanwhile
/// assert!((first.instant - (50e-6 - 1.2e-6)).abs() < 0.1e-6 && first.direction == Direction::Forward);
/// assert_eq!(pulses.count(), 3999);
/// // For a timer at 72 MHz, and for a clock of 1 ms:
/// assert_eq!(train.periods(72e6)?.count(), 4000);
/// assert_eq!(train.counts(1e-3)?.sum::<i32>(), 4000);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PulseTrain<P> {
    profile: P,
    size: f64,
    duration: f64,
    total: i64,
    /// What rounding may make of a position, in pulses.
    noise: f64,
    /// Shortest time for one pulse at top speed, s.
    interval: f64,
    /// Shortest time between pulses of opposite directions, s, and when it begins, s.
    reversal: f64,
    reversal_start: f64,
    /// What the drive needs between two pulses, and between those of opposite directions, s.
    allowed_interval: f64,
    allowed_reversal: f64,
}

impl<P: Sectioned> PulseTrain<P> {
    /// `profile` (by value or by reference) in pulses of `size`, m or rad.
    ///
    /// # Errors
    /// A size that is not positive and finite, or so small that instants could not be told apart: more than 2^40
    /// pulses if top speed were kept throughout.
    pub fn new(profile: P, size: f64) -> Result<Self, PulseError> {
        if !(size > 0.0 && size.is_finite()) {
            return Err(PulseError::Size(size));
        }
        let (extrema, duration) = (profile.extrema(), profile.duration());
        let (position, speed) = (extrema.position.magnitude(), extrema.velocity.magnitude());
        let pulses = (speed * duration).max(position) / size;
        if pulses.is_nan() || pulses > MOST_PULSES {
            return Err(PulseError::TooManyPulses { pulses, most: MOST_PULSES });
        }
        let mut train = Self {
            size,
            duration,
            total: Real::round(profile.after().position / size) as i64,
            noise: ROUNDINGS * f64::EPSILON * (position / size),
            interval: size / speed,
            reversal: f64::INFINITY,
            reversal_start: 0.0,
            allowed_interval: 0.0,
            allowed_reversal: 0.0,
            profile,
        };
        if extrema.velocity.lower < 0.0 && extrema.velocity.upper > 0.0 {
            (train.reversal_start, train.reversal) = train.shortest_reversal();
        }
        Ok(train)
    }

    /// The same train for a drive that needs `interval` s from one pulse to the next, 1 / the highest frequency.
    ///
    /// The time from the start to the first pulse is no interval.
    ///
    /// # Errors
    /// An interval that is negative or not finite; a peak velocity above one pulse in that time, to 16 roundings; a
    /// reversal with less time between the pulses.
    pub fn with_shortest_interval(mut self, interval: f64) -> Result<Self, PulseError> {
        if !(interval >= 0.0 && interval.is_finite()) {
            return Err(PulseError::Interval(interval));
        }
        if self.interval < interval * (1.0 - 16.0 * f64::EPSILON) {
            return Err(PulseError::TooFast { frequency: self.peak_frequency(), most: 1.0 / interval });
        }
        self.allows_reversal_in(interval)?;
        self.allowed_interval = interval;
        self.allowed_reversal = self.allowed_reversal.max(interval);
        Ok(self)
    }

    /// The same train for a drive that needs `time` s between two pulses of opposite directions.
    ///
    /// # Errors
    /// A time that is negative or not finite, or a profile that turns faster.
    pub fn with_reversal_time(mut self, time: f64) -> Result<Self, PulseError> {
        if !(time >= 0.0 && time.is_finite()) {
            return Err(PulseError::Interval(time));
        }
        self.allows_reversal_in(time)?;
        self.allowed_reversal = self.allowed_reversal.max(time);
        Ok(self)
    }

    fn allows_reversal_in(&self, least: f64) -> Result<(), PulseError> {
        if self.reversal < least {
            let (instant, interval) = (self.reversal_start, self.reversal);
            return Err(PulseError::Reversal { instant, interval, least });
        }
        Ok(())
    }

    /// The profile.
    #[must_use]
    pub fn profile(&self) -> &P {
        &self.profile
    }

    /// Size of a pulse, m or rad.
    #[must_use]
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The sum of all pulses, backward ones negative: `round(distance / size)`.
    #[must_use]
    pub fn total(&self) -> i64 {
        self.total
    }

    /// What the profile covers beyond its pulses, m or rad: `distance - total size`, at most half a pulse.
    #[must_use]
    pub fn end_error(&self) -> f64 {
        self.profile.after().position - self.total as f64 * self.size
    }

    /// Peak velocity in pulses/s: no two pulses of one direction are closer than its inverse.
    #[must_use]
    pub fn peak_frequency(&self) -> f64 {
        1.0 / self.interval
    }

    /// Every pulse with its exact instant, in order of time.
    #[must_use]
    pub fn pulses(&self) -> Pulses<'_, P> {
        Pulses::new(self)
    }

    /// The table of variable periods, in ticks of a timer that runs at `clock` ticks/s.
    ///
    /// # Errors
    /// A clock that is not positive and finite or has more ticks than can be counted; one so slow that two pulses fall
    /// on one tick, or that whole ticks make an interval shorter than the drive allows.
    pub fn periods(&self, clock: f64) -> Result<Periods<'_, P>, PulseError> {
        Periods::new(self, clock)
    }

    /// Pulses per tick of a clock of `period` s.
    ///
    /// # Errors
    /// A period that is not positive and finite, more ticks than can be counted, or more pulses a tick than `i32` holds.
    pub fn counts(&self, period: f64) -> Result<Counts<'_, P>, PulseError> {
        Counts::new(self, period)
    }

    fn runs(&self) -> Runs<'_, P> {
        Runs::new(&self.profile, self.size, self.noise, self.total)
    }

    /// The shortest time between pulses of opposite directions: when it begins and how long it is, s.
    fn shortest_reversal(&self) -> (f64, f64) {
        let mut shortest = (0.0, f64::INFINITY);
        let mut count = 0;
        let mut last = (0.0, 0.0);
        for run in self.runs().filter(|run| run.length() > 0.0) {
            if run.left(count) <= 0 {
                continue;
            }
            let first = run.instant_of(run.next_level(count) * self.size);
            let (sign, instant) = last;
            if sign * run.sign() < 0.0 && first - instant < shortest.1 {
                shortest = (instant, first - instant);
            }
            count = run.goal();
            last = (run.sign(), run.instant_of(run.last_level() * self.size));
        }
        shortest
    }
}
