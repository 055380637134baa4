//! One change of feed, as fast as the axes allow where it happens.

use super::caps::Capped;
use super::check::Check;
use super::law::FeedLaw;
use crate::quantities::Limits;

/// A change of feed at its place on the curve.
#[derive(Debug, Clone)]
pub(super) struct Ramp<L> {
    /// Way from the start of the curve to its ends, m.
    pub(super) start: f64,
    pub(super) end: f64,
    /// Speeds, m/s.
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) law: L,
}

/// Which end of a ramp stays where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Anchor {
    Start(f64),
    End(f64),
}

/// By how much a ramp may be slower than one on a straight line, in steps that are tried one after the other.
const STRETCHES: [f64; 7] = [1.0, 1.15, 1.4, 1.8, 2.4, 3.4, 5.0];

/// Halvings between a stretch that is enough and the one before.
const FINE: u32 = 5;

impl<const D: usize> Check<'_, D> {
    /// The shortest ramp from one speed to another, m/s, or none.
    ///
    /// Its shape is that of the limits which the axes on its way have on a straight line; what they need for the curve is
    /// found by trying, on a fine scale or a coarse one.
    pub(super) fn ramp<L: FeedLaw>(&self, anchor: Anchor, from: f64, to: f64, fine: bool) -> Option<Ramp<L>> {
        let shape = self.shape::<L>(anchor, from, to)?;
        let mut failed = None;
        for stretch in STRETCHES {
            if let Some(mut ramp) = self.placed(anchor, from, to, &shape, stretch) {
                if let (Some(mut low), true) = (failed, fine) {
                    let mut high = stretch;
                    for _ in 0..FINE {
                        let middle = 0.5 * (low + high);
                        match self.placed(anchor, from, to, &shape, middle) {
                            Some(better) => (high, ramp) = (middle, better),
                            None => low = middle,
                        }
                    }
                }
                return Some(ramp);
            }
            failed = Some(stretch);
        }
        None
    }

    /// The ramp of the limits on its way, whatever the curve.
    fn shape<L: FeedLaw>(&self, anchor: Anchor, from: f64, to: f64) -> Option<L> {
        let mut reach = 0.0;
        loop {
            let limits = self.limits_along(anchor, reach)?;
            let law = L::change(from, to, &limits).ok()?;
            let length = 0.5 * (from + to) * law.duration();
            if length <= reach * (1.0 + 1e-9) {
                return Some(law);
            }
            // Cells only take away: the ramp grows until it holds all that it needs.
            reach = length;
        }
    }

    /// What the axes allow the feed from the anchor on as far as `reach`, m, if the curve is straight.
    fn limits_along(&self, anchor: Anchor, reach: f64) -> Option<Limits> {
        let (from, to) = match anchor {
            Anchor::Start(s) => (s, s + reach),
            Anchor::End(s) => (s - reach, s),
        };
        let inside = from >= self.block.start() - self.rounding() && to <= self.block.end() + self.rounding();
        if inside { self.straight(from, to, f64::INFINITY) } else { None }
    }

    /// The limits that the feed would have between two places if the curve were straight, up to `speed`, m/s.
    pub(super) fn straight(&self, from: f64, to: f64, speed: f64) -> Option<Limits> {
        let least = |(acceleration, jerk): (f64, f64), c: &Capped<D>| {
            (acceleration.min(c.acceleration), jerk.min(c.feed_jerk))
        };
        let (acceleration, jerk) = self.touched(from, to).fold((f64::INFINITY, f64::INFINITY), least);
        let snap = self.limits.axes().iter().map(Limits::snap).fold(f64::INFINITY, f64::min);
        Limits::new(speed, acceleration, jerk).and_then(|limits| limits.with_snap(snap)).ok()
    }

    fn placed<L: FeedLaw>(
        &self,
        anchor: Anchor,
        from: f64,
        to: f64,
        shape: &L,
        stretch: f64,
    ) -> Option<Ramp<L>> {
        let law =
            if stretch > 1.0 { shape.stretched_to(stretch * shape.duration()).ok()? } else { shape.clone() };
        let length = 0.5 * (from + to) * law.duration();
        let (start, end) = match anchor {
            Anchor::Start(s) => (s, s + length),
            Anchor::End(s) => (s - length, s),
        };
        let inside =
            start >= self.block.start() - self.rounding() && end <= self.block.end() + self.rounding();
        let fits = inside && self.allows(start, from) && self.allows(end, to) && self.holds(start, &law);
        fits.then_some(Ramp { start, end, from, to, law })
    }

    /// Whether the speed is below the cap where it is reached.
    fn allows(&self, s: f64, speed: f64) -> bool {
        let cell = self.block.cells.get(self.block.cell_at(s));
        cell.is_some_and(|c| speed <= c.speed * (1.0 + 1e-12))
    }
}
