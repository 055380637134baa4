//! The table of variable periods.

use super::{Direction, PulseTrain, Pulses};
use crate::cursor::check_clock;
use crate::error::PulseError;
use crate::quantities::Real;
use crate::section::Sectioned;

/// What rounding may make of a count of ticks, as a part of it.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// One row of the table of variable periods.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Period {
    /// Timer ticks from the pulse before to this one; from the start of the profile for the first one.
    pub ticks: u64,
    /// Which way the pulse goes.
    pub direction: Direction,
}

/// The periods of a train in timer ticks, from [`PulseTrain::periods`].
///
/// Each pulse falls on the tick nearest to its instant, so that nothing drifts: the sum of the periods up to a pulse is
/// its rounded instant. Where the instant lies half way between two ticks, to rounding, it is the one that leaves the
/// pulse before it enough time.
#[derive(Debug, Clone)]
pub struct Periods<'a, P> {
    pulses: Pulses<'a, P>,
    clock: f64,
    elapsed: u64,
    /// The fewest ticks between two pulses, and between those of opposite directions.
    fewest: u64,
    fewest_to_turn: u64,
    direction: Option<Direction>,
}

impl<'a, P: Sectioned> Periods<'a, P> {
    pub(super) fn new(train: &'a PulseTrain<P>, clock: f64) -> Result<Self, PulseError> {
        if !(clock > 0.0 && clock.is_finite()) {
            return Err(PulseError::Frequency(clock));
        }
        check_clock(train.duration, 1.0 / clock)?;
        Ok(Self {
            pulses: train.pulses(),
            clock,
            elapsed: 0,
            fewest: fewest_ticks(train.interval, train.allowed_interval, clock)?,
            fewest_to_turn: fewest_ticks(train.reversal, train.allowed_reversal, clock)?,
            direction: None,
        })
    }
}

/// Ticks that an interval of at least `shortest` s lasts at least, if that is one and no less than `allowed` s.
fn fewest_ticks(shortest: f64, allowed: f64, clock: f64) -> Result<u64, PulseError> {
    let ticks = Real::floor(shortest * clock * (1.0 + ROUNDING));
    let needed = (allowed * clock * (1.0 - ROUNDING)).max(1.0);
    if ticks < needed {
        return Err(PulseError::Ticks { ticks, needed });
    }
    // The cast saturates where there is no such interval.
    Ok(ticks as u64)
}

impl<P: Sectioned> Iterator for Periods<'_, P> {
    type Item = Period;

    #[inline]
    fn next(&mut self) -> Option<Period> {
        let pulse = self.pulses.next()?;
        let fewest = match self.direction {
            None => 0,
            Some(direction) if direction == pulse.direction => self.fewest,
            Some(_) => self.fewest_to_turn,
        };
        self.direction = Some(pulse.direction);
        let nearest = Real::round(pulse.instant * self.clock) as u64;
        let ahead = nearest.saturating_sub(self.elapsed);
        let ticks = if ahead.saturating_add(1) == fewest { fewest } else { ahead };
        self.elapsed = self.elapsed.saturating_add(ticks);
        Some(Period { ticks, direction: pulse.direction })
    }
}
