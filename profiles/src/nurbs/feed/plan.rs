//! The feed along a block: one move, or ramps and constant feeds between them.

use alloc::vec::Vec;

use super::FeedError;
use super::check::Check;
use super::law::FeedLaw;
use super::ramp::Ramp;
use crate::error::PlanError;
use crate::quantities::Real;

/// How often a move from rest to rest over a whole block is slowed down by half before there is none.
const MOST_DOUBLINGS: u32 = 200;

/// How well its slowness is then found: halvings of a factor of two.
const HALVINGS: u32 = 12;

/// The feed along one block.
#[derive(Debug, Clone)]
pub(super) enum BlockPlan<L> {
    /// One move from rest to rest.
    Move(L),
    /// Ramps with constant feed between them.
    Ramps(Vec<Ramp<L>>),
}

impl<L: FeedLaw> BlockPlan<L> {
    /// Duration, s.
    pub(super) fn duration(&self) -> f64 {
        match self {
            Self::Move(law) => law.duration(),
            Self::Ramps(ramps) => ramps_duration(ramps),
        }
    }
}

/// Ramps and what is cruised between them, s.
pub(super) fn ramps_duration<L: FeedLaw>(ramps: &[Ramp<L>]) -> f64 {
    let cruises = ramps.iter().zip(ramps.iter().skip(1));
    let cruised: f64 = cruises.map(|(a, b)| (b.start - a.end).max(0.0) / a.to).sum();
    cruised + ramps.iter().map(|ramp| ramp.law.duration()).sum::<f64>()
}

impl<const D: usize> Check<'_, D> {
    /// The faster of a move from rest to rest and what the search finds.
    pub(super) fn plan<L: FeedLaw>(&self) -> Result<BlockPlan<L>, FeedError> {
        let (whole, is_best) = self.whole_move::<L>()?;
        let whole = BlockPlan::Move(whole);
        if is_best {
            return Ok(whole);
        }
        let Some(ramps) = self.search::<L>() else { return Ok(whole) };
        let found = BlockPlan::Ramps(self.polished(ramps));
        Ok(if found.duration() < whole.duration() { found } else { whole })
    }

    /// The move from rest to rest below the lowest cap, as slow as it must be to keep the limits, and whether nothing else
    /// can be faster: the cap is the same everywhere, and the limits are those of a straight line.
    fn whole_move<L: FeedLaw>(&self) -> Result<(L, bool), FeedError> {
        let (from, to) = (self.block.start(), self.block.end());
        let caps = || self.block.cells().iter().map(|c| c.cruise);
        let (lowest, highest) = (caps().fold(f64::INFINITY, f64::min), caps().fold(0.0, f64::max));
        let none = FeedError::NoFeed { from, to };
        let limits = self.straight(from, to, lowest).ok_or(none)?;
        let fastest = L::rest_to_rest(to - from, &limits)?;
        if self.holds(from, &fastest) {
            return Ok((fastest, lowest >= highest * (1.0 - 1e-12)));
        }
        let stretched =
            |factor: f64| -> Result<L, PlanError> { fastest.stretched_to(factor * fastest.duration()) };
        let mut high = 2.0;
        let mut found = None;
        for _ in 0..MOST_DOUBLINGS {
            let slower = stretched(high)?;
            if self.holds(from, &slower) {
                found = Some(slower);
                break;
            }
            high *= 2.0;
        }
        let mut best = found.ok_or(none)?;
        let mut low = 0.5 * high;
        for _ in 0..HALVINGS {
            let middle = Real::sqrt(low * high);
            let faster = stretched(middle)?;
            if self.holds(from, &faster) {
                (high, best) = (middle, faster);
            } else {
                low = middle;
            }
        }
        Ok((best, false))
    }
}
