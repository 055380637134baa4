//! What the grid of the search leaves: every constant feed is raised until a limit stops it.

use alloc::vec::Vec;

use super::check::Check;
use super::law::FeedLaw;
use super::plan::ramps_duration;
use super::ramp::{Anchor, Ramp};

/// How often all feeds are raised in turn.
const ROUNDS: u32 = 4;

/// Halvings of the step by which a feed is raised.
const HALVINGS: u32 = 12;

/// The first step, as a part of the feed: a little more than that of the grid.
const STEP: f64 = 0.2;

impl<const D: usize> Check<'_, D> {
    /// The ramps with the feeds between them raised.
    pub(super) fn polished<L: FeedLaw>(&self, mut ramps: Vec<Ramp<L>>) -> Vec<Ramp<L>> {
        for _ in 0..ROUNDS {
            let before = ramps_duration(&ramps);
            for index in 1..ramps.len() {
                self.raise(&mut ramps, index);
            }
            if ramps_duration(&ramps) > before * (1.0 - 1e-6) {
                break;
            }
        }
        ramps
    }

    /// Raises the feed between the ramps `index - 1` and `index` as far as it makes the motion faster.
    fn raise<L: FeedLaw>(&self, ramps: &mut [Ramp<L>], index: usize) {
        let (done, ahead) = ramps.split_at_mut(index);
        let ([earlier @ .., first], [second, later @ ..]) = (done, ahead) else { return };
        let around = Neighbours {
            start: earlier.last().map_or(self.block.start(), |ramp| ramp.end),
            end: later.first().map_or(self.block.end(), |ramp| ramp.start),
        };
        let feed = self.limits.feed();
        let mut best = around.time(first, second);
        let mut step = STEP * first.to;
        for _ in 0..HALVINGS {
            let speed = (first.to + step).min(feed);
            step *= 0.5;
            // It stays on its side of both neighbours.
            let passes = |neighbour: f64| (neighbour > first.to) != (neighbour > speed);
            if speed <= first.to || passes(first.from) || passes(second.to) {
                continue;
            }
            let Some((one, two)) = self.raised(&around, first, second, speed) else { continue };
            let time = around.time(&one, &two);
            if time < best {
                (best, *first, *second) = (time, one, two);
            }
        }
    }

    /// Both ramps with another speed between them: what speeds up keeps its start, what slows down its end.
    fn raised<L: FeedLaw>(
        &self,
        around: &Neighbours,
        first: &Ramp<L>,
        second: &Ramp<L>,
        speed: f64,
    ) -> Option<(Ramp<L>, Ramp<L>)> {
        let anchor = |ramp: &Ramp<L>| {
            if ramp.to > ramp.from { Anchor::Start(ramp.start) } else { Anchor::End(ramp.end) }
        };
        let one: Ramp<L> = self.ramp(anchor(first), first.from, speed, true)?;
        let two: Ramp<L> = self.ramp(anchor(second), speed, second.to, true)?;
        let fits = one.start >= around.start && one.end <= two.start && two.end <= around.end;
        let holds = fits
            && self.cruise(around.start, one.start, one.from)
            && self.cruise(one.end, two.start, speed)
            && self.cruise(two.end, around.end, two.to);
        holds.then_some((one, two))
    }
}

/// Where the ramps before and after a pair end and begin, m.
struct Neighbours {
    start: f64,
    end: f64,
}

impl Neighbours {
    /// Time between them, s.
    fn time<L: FeedLaw>(&self, first: &Ramp<L>, second: &Ramp<L>) -> f64 {
        let cruised = |length: f64, speed: f64| if length > 0.0 { length / speed } else { 0.0 };
        cruised(first.start - self.start, first.from)
            + first.law.duration()
            + cruised(second.start - first.end, first.to)
            + second.law.duration()
            + cruised(self.end - second.end, second.to)
    }
}
