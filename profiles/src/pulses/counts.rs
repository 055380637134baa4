//! Pulses per tick of a fixed clock.

use super::PulseTrain;
use crate::cursor::{check_clock, instant_rounding};
use crate::error::PulseError;
use crate::quantities::Real;
use crate::section::Sectioned;

/// Pulses per tick of a fixed clock, from [`PulseTrain::counts`]: the rounded position at the end of the tick less all
/// that was sent before. The last tick is the first one that ends at or after the end of the profile.
#[derive(Debug, Clone)]
pub struct Counts<'a, P> {
    train: &'a PulseTrain<P>,
    period: f64,
    tick: u64,
    ticks: u64,
    sent: i64,
}

impl<'a, P: Sectioned> Counts<'a, P> {
    pub(super) fn new(train: &'a PulseTrain<P>, period: f64) -> Result<Self, PulseError> {
        check_clock(train.duration, period)?;
        // One more for the pulse that a tick of no length may hold.
        let most = period.min(train.duration) / train.interval + 1.0;
        if most > f64::from(i32::MAX) {
            return Err(PulseError::CountRange { pulses: most });
        }
        let ticks = Real::ceil((train.duration - instant_rounding(train.duration)) / period);
        Ok(Self { train, period, tick: 0, ticks: ticks as u64, sent: 0 })
    }
}

impl<P: Sectioned> Iterator for Counts<'_, P> {
    type Item = i32;

    #[inline]
    fn next(&mut self) -> Option<i32> {
        if self.tick >= self.ticks {
            return None;
        }
        self.tick += 1;
        let reached = if self.tick == self.ticks {
            self.train.total
        } else {
            let position = self.train.profile.sample(self.tick as f64 * self.period).position;
            Real::round(position / self.train.size) as i64
        };
        let count = reached - self.sent;
        self.sent = reached;
        // Checked when the clock was.
        Some(count as i32)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        match usize::try_from(self.ticks - self.tick) {
            Ok(left) => (left, Some(left)),
            Err(_) => (usize::MAX, None),
        }
    }
}
