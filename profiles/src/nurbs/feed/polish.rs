//! What the grid of the search leaves: every constant feed is raised and every ramp is moved until a limit stops it.

use alloc::vec::Vec;

use super::check::Check;
use super::law::FeedLaw;
use super::plan::ramps_duration;
use super::ramp::{Anchor, Ramp};

/// How often all feeds are raised and all ramps moved in turn.
const ROUNDS: u32 = 6;

/// A round that makes the motion faster by less than this part of its duration is the last one.
const ENOUGH: f64 = 1e-4;

/// Halvings of the step by which a feed is raised or a ramp moved.
const HALVINGS: u32 = 10;

/// The first steps: a part of the feed, more than that of the grid, and a part of the length of the ramp.
const RISE: f64 = 0.4;
const SHIFT: f64 = 0.5;

impl<const D: usize> Check<'_, D> {
    /// The ramps with the feeds between them raised, and moved to where it is faster.
    pub(super) fn polished<L: FeedLaw>(&self, mut ramps: Vec<Ramp<L>>) -> Vec<Ramp<L>> {
        for _ in 0..ROUNDS {
            let before = ramps_duration(&ramps);
            for index in 1..ramps.len() {
                self.raise(&mut ramps, index);
                self.shift(&mut ramps, index - 1);
                self.shift(&mut ramps, index);
            }
            if ramps_duration(&ramps) > before * (1.0 - ENOUGH) {
                break;
            }
        }
        ramps
    }

    /// Raises the feed between the ramps `index - 1` and `index` as far as it makes the motion faster.
    fn raise<L: FeedLaw>(&self, ramps: &mut [Ramp<L>], index: usize) {
        let (done, ahead) = ramps.split_at_mut(index);
        let ([earlier @ .., first], [second, later @ ..]) = (done, ahead) else { return };
        let (start, end) = self.gap(earlier, later);
        let (mut best, mut step) = (time(start, &[first, second], end), RISE * first.to);
        for _ in 0..HALVINGS {
            let speed = (first.to + step).min(self.limits.feed());
            step *= 0.5;
            // It stays on its side of both neighbours.
            let passes = |neighbour: f64| (neighbour > first.to) != (neighbour > speed);
            if speed <= first.to || passes(first.from) || passes(second.to) {
                continue;
            }
            let one = self.fine_ramp::<L>(first.anchor(0.0), first.from, speed);
            let Some(one) = one.filter(|one| one.start >= start) else { continue };
            let two = self.fine_ramp::<L>(second.anchor(0.0), speed, second.to);
            let Some(two) = two.filter(|two| one.end <= two.start && two.end <= end) else { continue };
            let time = time(start, &[&one, &two], end);
            if time < best && self.cruises(start, &[&one, &two], end) {
                (best, *first, *second) = (time, one, two);
            }
        }
    }

    /// Moves a ramp up earlier and a ramp down later, as far as it makes the motion faster.
    fn shift<L: FeedLaw>(&self, ramps: &mut [Ramp<L>], index: usize) {
        let (earlier, ahead) = ramps.split_at_mut(index);
        let [ramp, later @ ..] = ahead else { return };
        let (start, end) = self.gap(earlier, later);
        let (mut best, mut step) = (time(start, &[ramp], end), SHIFT * (ramp.end - ramp.start));
        for _ in 0..HALVINGS {
            let moved = self.fine_ramp::<L>(ramp.anchor(step), ramp.from, ramp.to);
            step *= 0.5;
            let Some(moved) = moved.filter(|moved| moved.start >= start && moved.end <= end) else {
                continue;
            };
            let time = time(start, &[&moved], end);
            // At a stop there is nothing to cruise.
            let stays = (moved.from > 0.0 || moved.start <= start) && (moved.to > 0.0 || moved.end >= end);
            if time < best && stays && self.cruises(start, &[&moved], end) {
                (best, *ramp) = (time, moved);
            }
        }
    }

    /// From the end of the ramp before to the start of the ramp after, m.
    fn gap<L>(&self, earlier: &[Ramp<L>], later: &[Ramp<L>]) -> (f64, f64) {
        let start = earlier.last().map_or(self.block.start(), |ramp| ramp.end);
        (start, later.first().map_or(self.block.end(), |ramp| ramp.start))
    }

    /// Whether the constant feeds before, between and after some ramps keep the limits.
    fn cruises<L>(&self, start: f64, ramps: &[&Ramp<L>], end: f64) -> bool {
        let mut at = start;
        let before = ramps.iter().all(|ramp| {
            let from = core::mem::replace(&mut at, ramp.end);
            self.cruise(from, ramp.start, ramp.from)
        });
        before && ramps.last().is_none_or(|ramp| self.cruise(ramp.end, end, ramp.to))
    }
}

impl<L: FeedLaw> Ramp<L> {
    /// The end that stays, `earlier` than now for a ramp up and so much later for a ramp down, m.
    fn anchor(&self, earlier: f64) -> Anchor {
        if self.to > self.from {
            Anchor::Start(self.start - earlier)
        } else {
            Anchor::End(self.end + earlier)
        }
    }
}

/// Time from one place to another over some ramps, s.
fn time<L: FeedLaw>(start: f64, ramps: &[&Ramp<L>], end: f64) -> f64 {
    let cruised = |length: f64, speed: f64| if length > 0.0 { length / speed } else { 0.0 };
    let mut at = start;
    let mut sum = 0.0;
    for ramp in ramps {
        sum += cruised(ramp.start - at, ramp.from) + ramp.law.duration();
        at = ramp.end;
    }
    sum + ramps.last().map_or(0.0, |ramp| cruised(end - at, ramp.to))
}
