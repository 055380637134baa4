//! Look-ahead: the fastest sequence of ramps and cruises along a block.

use alloc::vec::Vec;

use super::FeedError;
use super::check::Check;
use super::law::FeedLaw;
use super::ramp::{Anchor, Ramp};
use crate::error::PlanError;
use crate::quantities::Real;

/// Speeds of the search per factor of two.
const LEVELS_PER_OCTAVE: f64 = 4.0;

/// The most speeds of the search.
const MOST_LEVELS: f64 = 64.0;

/// By how many speeds a ramp changes the feed.
const CHANGES: [usize; 13] = [1, 2, 3, 4, 6, 8, 11, 15, 20, 27, 36, 48, 64];

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
        let caps = || self.block.cells.iter().map(|c| c.cruise);
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

    /// The fastest way through a grid of places and speeds; `None` where every way through it is too fast.
    fn search<L: FeedLaw>(&self) -> Option<Vec<Ramp<L>>> {
        let lowest = self.block.cells.iter().map(|c| c.cruise).fold(f64::INFINITY, f64::min);
        let octaves = Real::ln(self.limits.feed() / lowest) / core::f64::consts::LN_2;
        let per_octave = LEVELS_PER_OCTAVE.min((MOST_LEVELS - 2.0) / octaves);
        let count = (Real::ceil(octaves * per_octave) as usize).saturating_add(2);
        let speed = |level: usize| {
            let octaves = level as f64 / per_octave;
            self.limits.feed() * Real::exp(-octaves * core::f64::consts::LN_2)
        };
        let speeds: Vec<f64> = (0..count).map(speed).collect();
        let places = core::iter::once(self.block.start()).chain(self.block.cells.iter().map(|c| c.cell.end));
        let mut grid = Grid { check: *self, places: places.collect(), states: Vec::new(), speeds };
        grid.run::<L>();
        grid.way()
    }
}

/// How a state is reached fastest.
#[derive(Debug, Clone, Copy)]
struct State {
    /// Time from the start of the block, s.
    time: f64,
    /// Place and level it is reached from.
    before: (usize, usize),
    /// The anchor of the ramp, if one leads here.
    ramp: Option<Anchor>,
}

const NEVER: State = State { time: f64::INFINITY, before: (0, 0), ramp: None };

/// Places and speeds; the last level of a place is rest.
struct Grid<'a, const D: usize> {
    check: Check<'a, D>,
    places: Vec<f64>,
    speeds: Vec<f64>,
    states: Vec<State>,
}

impl<const D: usize> Grid<'_, D> {
    fn rest(&self) -> usize {
        self.speeds.len()
    }

    fn speed(&self, level: usize) -> f64 {
        self.speeds.get(level).copied().unwrap_or(0.0)
    }

    fn place(&self, index: usize) -> f64 {
        self.places.get(index).copied().unwrap_or(0.0)
    }

    fn state(&self, place: usize, level: usize) -> State {
        self.states.get(place * (self.rest() + 1) + level).copied().unwrap_or(NEVER)
    }

    fn offer(&mut self, place: usize, level: usize, state: State) {
        let index = place * (self.rest() + 1) + level;
        if let Some(known) = self.states.get_mut(index).filter(|known| state.time < known.time) {
            *known = state;
        }
    }

    /// Fills the grid from the start to the end: into every place first what slows down to it and what cruises to it,
    /// then from it what speeds up.
    fn run<L: FeedLaw>(&mut self) {
        let (rest, last) = (self.rest(), self.places.len().saturating_sub(1));
        self.states = alloc::vec![NEVER; (rest + 1) * self.places.len()];
        self.offer(0, rest, State { time: 0.0, ..NEVER });
        for place in 0..=last {
            let ceiling = if place < last { self.ceiling(place) } else { rest };
            for level in ceiling..=rest {
                if level < rest || place == last {
                    self.slow_down_to::<L>(place, level);
                }
            }
            self.cruise_to(place);
            for level in ceiling..=rest {
                if self.state(place, level).time < f64::INFINITY {
                    self.speed_up_from::<L>(place, level);
                }
            }
        }
    }

    /// The fastest level that both cells at a place allow.
    fn ceiling(&self, place: usize) -> usize {
        let cells = &self.check.block.cells;
        let neighbours =
            [place.checked_sub(1), Some(place)].into_iter().flatten().filter_map(|k| cells.get(k));
        let cap = neighbours.map(|c| c.speed).fold(f64::INFINITY, f64::min) * (1.0 + 1e-12);
        self.speeds.partition_point(|speed| *speed > cap)
    }

    fn cruise_to(&mut self, place: usize) {
        let Some(before) = place.checked_sub(1) else { return };
        let length = self.place(place) - self.place(before);
        let cap = self.check.block.cells.get(before).map_or(0.0, |c| c.cruise) * (1.0 + 1e-12);
        for level in 0..self.rest() {
            let (speed, state) = (self.speed(level), self.state(before, level));
            if speed <= cap && state.time < f64::INFINITY {
                let time = state.time + length / speed;
                self.offer(place, level, State { time, before: (before, level), ramp: None });
            }
        }
    }

    /// Ramps that end at a place, and start as late as they can: at a constant feed up to there.
    fn slow_down_to<L: FeedLaw>(&mut self, place: usize, level: usize) {
        let (end, to) = (self.place(place), self.speed(level));
        let steps: &[usize] = &CHANGES;
        for step in 0..level {
            // All speeds at a stop, else some.
            let change = if level == self.rest() { Some(step + 1) } else { steps.get(step).copied() };
            let Some(higher) = change.and_then(|change| level.checked_sub(change)) else { break };
            let from = self.speed(higher);
            let anchor = Anchor::End(end);
            let Some(ramp) = self.check.ramp::<L>(anchor, from, to, false) else { continue };
            let reach = ramp.start + self.check.rounding();
            let start = self.places.partition_point(|s| *s <= reach).saturating_sub(1);
            let state = self.state(start, higher);
            let cruised = (ramp.start - self.place(start)).max(0.0);
            if state.time < f64::INFINITY && self.check.cruise(self.place(start), ramp.start, from) {
                let time = state.time + cruised / from + ramp.law.duration();
                self.offer(place, level, State { time, before: (start, higher), ramp: Some(anchor) });
            }
        }
    }

    /// Ramps that start at a place, and the constant feed to the next place after their end.
    fn speed_up_from<L: FeedLaw>(&mut self, place: usize, level: usize) {
        let (start, from) = (self.place(place), self.speed(level));
        let time = self.state(place, level).time;
        let steps: &[usize] = &CHANGES;
        for step in 0..level {
            let change = if level == self.rest() { Some(step + 1) } else { steps.get(step).copied() };
            let Some(higher) = change.and_then(|change| level.checked_sub(change)) else { break };
            let to = self.speed(higher);
            let anchor = Anchor::Start(start);
            let Some(ramp) = self.check.ramp::<L>(anchor, from, to, false) else { continue };
            let reach = ramp.end - self.check.rounding();
            let end = self.places.partition_point(|s| *s < reach);
            let cruised = (self.place(end) - ramp.end).max(0.0);
            if end < self.places.len() && self.check.cruise(ramp.end, self.place(end), to) {
                let time = time + ramp.law.duration() + cruised / to;
                self.offer(end, higher, State { time, before: (place, level), ramp: Some(anchor) });
            }
        }
    }

    /// The ramps of the fastest way, in sequence.
    fn way<L: FeedLaw>(&self) -> Option<Vec<Ramp<L>>> {
        let mut at = (self.places.len().checked_sub(1)?, self.rest());
        let mut ramps = Vec::new();
        while at.0 > 0 {
            let state = self.state(at.0, at.1);
            if state.time.is_infinite() {
                return None;
            }
            if let Some(anchor) = state.ramp {
                let (from, to) = (self.speed(state.before.1), self.speed(at.1));
                ramps.push(self.check.ramp(anchor, from, to, false)?);
            }
            at = state.before;
        }
        ramps.reverse();
        Some(ramps)
    }
}
