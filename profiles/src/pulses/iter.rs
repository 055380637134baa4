//! Pulses at their exact instants.

use super::PulseTrain;
use super::run::{Near, Run, Runs};
use crate::section::Sectioned;

/// Which way a pulse goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Direction {
    /// Towards larger positions.
    Forward,
    /// Towards smaller positions.
    Backward,
}

impl Direction {
    /// 1 forward, -1 backward.
    #[must_use]
    pub const fn sign(self) -> i32 {
        match self {
            Self::Forward => 1,
            Self::Backward => -1,
        }
    }
}

/// One pulse of a train.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pulse {
    /// When it is sent, s after the start of the profile.
    pub instant: f64,
    /// Time since the pulse before, s; since the start of the profile for the first one.
    pub interval: f64,
    /// Which way it goes.
    pub direction: Direction,
}

/// The pulses of a train, from [`PulseTrain::pulses`].
#[derive(Debug, Clone)]
pub struct Pulses<'a, P> {
    train: &'a PulseTrain<P>,
    runs: Runs<'a, P>,
    run: Option<(Run, Near)>,
    count: i64,
    instant: f64,
}

impl<'a, P: Sectioned> Pulses<'a, P> {
    pub(super) fn new(train: &'a PulseTrain<P>) -> Self {
        let mut runs = train.runs();
        let run = enter(&mut runs);
        Self { train, runs, run, count: 0, instant: 0.0 }
    }

    /// The sum of the pulses sent so far.
    #[must_use]
    pub fn sum(&self) -> i64 {
        self.count
    }
}

fn enter<P: Sectioned>(runs: &mut Runs<'_, P>) -> Option<(Run, Near)> {
    runs.next().map(|run| (run, run.start()))
}

impl<P: Sectioned> Iterator for Pulses<'_, P> {
    type Item = Pulse;

    #[inline]
    fn next(&mut self) -> Option<Pulse> {
        let (instant, forward) = loop {
            match &mut self.run {
                Some((run, near)) => {
                    if run.left(self.count) > 0 {
                        let level = run.next_level(self.count) * self.train.size;
                        break (run.crossing(level, near), run.sign() > 0.0);
                    }
                    self.run = enter(&mut self.runs);
                }
                // Rounding may leave a crossing that the end only just touches.
                None if self.count != self.train.total => {
                    break (self.train.duration, self.train.total > self.count);
                }
                None => return None,
            }
        };
        let direction = if forward { Direction::Forward } else { Direction::Backward };
        self.count += i64::from(direction.sign());
        // Where two sections meet an instant may be one rounding early.
        let instant = instant.max(self.instant).min(self.train.duration);
        let interval = instant - self.instant;
        self.instant = instant;
        Some(Pulse { instant, interval, direction })
    }
}
