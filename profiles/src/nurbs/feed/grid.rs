//! Look-ahead over a whole block: the fastest way through a grid of places and speeds.

use alloc::vec::Vec;

use super::check::{Check, SLACK};
use super::law::FeedLaw;
use super::ramp::{Anchor, Place, Ramp};
use crate::quantities::Real;

/// Speeds of the search per factor of two, for so many factors of two below the command.
const LEVELS_PER_OCTAVE: f64 = 2.0;
const FINE_OCTAVES: f64 = 5.0;

/// The most speeds of the search.
const MOST_LEVELS: f64 = 40.0;

/// By how many speeds a ramp changes the feed.
const CHANGES: [usize; 11] = [1, 2, 3, 4, 6, 8, 11, 15, 20, 27, 36];

/// Time between places at which ramps are tried, as a part of the time of a ramp from half the cap to all of it, and how
/// many there are at least, if there are as many cells.
const APART: f64 = 0.125;
const LEAST_PLACES: f64 = 48.0;

impl<const D: usize> Check<'_, D> {
    /// The fastest way through a grid of places and speeds; `None` where every way through it is too fast.
    pub(super) fn search<L: FeedLaw>(&self) -> Option<Vec<Ramp<L>>> {
        let caps = || self.block.cells().iter().map(|c| c.cruise);
        let (lowest, highest) = (caps().fold(f64::INFINITY, f64::min), caps().fold(0.0, f64::max));
        let octaves = Real::ln(highest / lowest) / core::f64::consts::LN_2;
        // Fine where the time goes, coarse where a bend is so tight that it takes hardly any.
        let coarse = ((octaves - FINE_OCTAVES) / (MOST_LEVELS - FINE_OCTAVES * LEVELS_PER_OCTAVE)).max(1.0);
        let octave = |level: f64| {
            let fine = (level / LEVELS_PER_OCTAVE).min(FINE_OCTAVES);
            fine + coarse * (level - fine * LEVELS_PER_OCTAVE)
        };
        let speed = |level| highest * Real::exp(-octave(level) * core::f64::consts::LN_2);
        let mut speeds = Vec::new();
        while speeds.last().is_none_or(|last| *last > lowest) && speeds.len() <= MOST_LEVELS as usize {
            speeds.push(speed(speeds.len() as f64));
        }
        speeds.push(speed(speeds.len() as f64));
        let mut grid = Grid { check: *self, places: self.places::<L>(), states: Vec::new(), speeds };
        grid.run::<L>();
        grid.way()
    }

    /// Ends of cells at which ramps are tried: apart by a part of the ramp that the cap between them allows.
    fn places<L: FeedLaw>(&self) -> Vec<f64> {
        let (start, end) = (self.block.start(), self.block.end());
        let longest = (end - start) / LEAST_PLACES;
        let (mut places, mut passed) = (alloc::vec![start], 0.0);
        for c in self.block.cells() {
            let cap = c.cruise;
            let ramp = self.straight(c.start, c.end, f64::INFINITY);
            let ramp = ramp.and_then(|limits| L::change(0.5 * cap, cap, &limits).ok());
            let apart = APART * cap * ramp.map_or(0.0, |ramp| ramp.duration());
            passed += (c.end - c.start) / apart.min(longest);
            if passed >= 1.0 || c.end >= end {
                places.push(c.end);
                passed = 0.0;
            }
        }
        places
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

    /// Fills the grid from the start to the end: into every place first what cruises to it and what slows down to it,
    /// then from it what speeds up.
    fn run<L: FeedLaw>(&mut self) {
        let (rest, last) = (self.rest(), self.places.len().saturating_sub(1));
        self.states = alloc::vec![NEVER; (rest + 1) * self.places.len()];
        self.offer(0, rest, State { time: 0.0, ..NEVER });
        for place in 0..=last {
            let ceiling = if place < last { self.ceiling(place) } else { rest };
            self.cruise_to(place);
            for level in ceiling..=rest {
                if level < rest || place == last {
                    self.slow_down_to::<L>(place, level);
                }
            }
            for level in ceiling..=rest {
                if self.state(place, level).time < f64::INFINITY {
                    self.speed_up_from::<L>(place, level);
                }
            }
        }
    }

    /// The fastest level that both cells at a place allow.
    fn ceiling(&self, place: usize) -> usize {
        let block = self.check.block;
        let (s, around) = (self.place(place), 2.0 * block.rounding());
        let cells = block.joined(block.touched(s - around, s + around));
        let cap = cells.map(|c| c.speed).fold(f64::INFINITY, f64::min) * SLACK;
        self.speeds.partition_point(|speed| *speed > cap)
    }

    fn cruise_to(&mut self, place: usize) {
        let Some(before) = place.checked_sub(1) else { return };
        let (from, to) = (self.place(before), self.place(place));
        let length = to - from;
        let block = self.check.block;
        let cells = block.joined(block.touched(from, to));
        let cap = cells.map(|c| c.cruise).fold(f64::INFINITY, f64::min) * SLACK;
        for level in 0..self.rest() {
            let (speed, state) = (self.speed(level), self.state(before, level));
            if speed <= cap && state.time < f64::INFINITY {
                let time = state.time + length / speed;
                self.offer(place, level, State { time, before: (before, level), ramp: None });
            }
        }
    }

    /// Levels that are reached from `level` by a faster one: all of them at rest, else some.
    fn faster(&self, level: usize) -> impl Iterator<Item = usize> + use<D> {
        let (all, some) = if level == self.rest() { (level, 0) } else { (0, CHANGES.len()) };
        (1..=all).chain(CHANGES.into_iter().take(some)).map_while(move |change| level.checked_sub(change))
    }

    /// Ramps that end at a place, and start as late as they can: at a constant feed up to there.
    fn slow_down_to<L: FeedLaw>(&mut self, place: usize, level: usize) {
        let (end, to) = (self.place(place), self.speed(level));
        for higher in self.faster(level) {
            let (from, anchor) = (self.speed(higher), Anchor::End(end));
            let way = |ramp: &Place| {
                let reach = ramp.start + self.check.block.rounding();
                let start = self.places.partition_point(|s| *s <= reach).saturating_sub(1);
                let cruised = (ramp.start - self.place(start)).max(0.0);
                let time = self.state(start, higher).time + cruised / from + ramp.duration;
                (start, time)
            };
            let known = self.state(place, level).time;
            let Some(ramp) = self.check.ramp::<L>(anchor, from, to, |ramp| way(ramp).1 < known) else {
                continue;
            };
            let (start, time) = way(&ramp.place());
            if self.check.cruise(self.place(start), ramp.start, from) {
                self.offer(place, level, State { time, before: (start, higher), ramp: Some(anchor) });
            }
        }
    }

    /// Ramps that start at a place, and the constant feed to the next place after their end.
    fn speed_up_from<L: FeedLaw>(&mut self, place: usize, level: usize) {
        let (start, from) = (self.place(place), self.speed(level));
        let begun = self.state(place, level).time;
        for higher in self.faster(level) {
            let (to, anchor) = (self.speed(higher), Anchor::Start(start));
            let way = |ramp: &Place| {
                let reach = ramp.end - self.check.block.rounding();
                let end = self.places.partition_point(|s| *s < reach);
                let cruised = (self.place(end) - ramp.end).max(0.0);
                (end, begun + ramp.duration + cruised / to)
            };
            let worth = |ramp: &Place| {
                let (end, time) = way(ramp);
                time < self.state(end, higher).time
            };
            let Some(ramp) = self.check.ramp::<L>(anchor, from, to, worth) else { continue };
            let (end, time) = way(&ramp.place());
            if self.check.cruise(ramp.end, self.place(end), to) {
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
                ramps.push(self.check.ramp(anchor, from, to, |_| true)?);
            }
            at = state.before;
        }
        ramps.reverse();
        Some(ramps)
    }
}
