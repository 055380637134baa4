//! One change of feed, as fast as the axes allow where it happens.

use super::caps::Capped;
use super::check::{Check, SLACK};
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

/// Where a ramp would be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Way from the start of the curve to its ends, m.
    pub(super) start: f64,
    pub(super) end: f64,
    /// Its duration, s.
    pub(super) duration: f64,
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

impl<L: FeedLaw> Ramp<L> {
    /// Where it is.
    pub(super) fn place(&self) -> Place {
        Place { start: self.start, end: self.end, duration: self.law.duration() }
    }
}

impl Anchor {
    /// From where to where a ramp of this length lies, m.
    fn span(self, length: f64) -> (f64, f64) {
        match self {
            Self::Start(s) => (s, s + length),
            Self::End(s) => (s - length, s),
        }
    }
}

impl<const D: usize> Check<'_, D> {
    /// The shortest ramp from one speed to another, m/s, or none.
    ///
    /// Its shape is that of the limits which the axes on its way have on a straight line; what they need for the curve is
    /// found by trying slower ones, as long as they are `worth` it.
    pub(super) fn ramp<L: FeedLaw>(
        &self,
        anchor: Anchor,
        from: f64,
        to: f64,
        worth: impl Fn(&Place) -> bool,
    ) -> Option<Ramp<L>> {
        let shape = self.shape::<L>(anchor, from, to)?;
        for stretch in STRETCHES {
            let place = self.place(anchor, from, to, stretch * shape.duration()).filter(&worth)?;
            if let Some(ramp) = self.placed(&place, from, to, &shape) {
                return Some(ramp);
            }
        }
        None
    }

    /// The same on a finer scale.
    pub(super) fn fine_ramp<L: FeedLaw>(&self, anchor: Anchor, from: f64, to: f64) -> Option<Ramp<L>> {
        let shape = self.shape::<L>(anchor, from, to)?;
        let stretched = |stretch: f64| {
            let place = self.place(anchor, from, to, stretch * shape.duration())?;
            self.placed(&place, from, to, &shape)
        };
        let mut low = None;
        for stretch in STRETCHES {
            let Some(mut ramp) = stretched(stretch) else {
                low = Some(stretch);
                continue;
            };
            if let Some(mut low) = low {
                let mut high = stretch;
                for _ in 0..FINE {
                    let middle = 0.5 * (low + high);
                    match stretched(middle) {
                        Some(better) => (high, ramp) = (middle, better),
                        None => low = middle,
                    }
                }
            }
            return Some(ramp);
        }
        None
    }

    /// The ramp of the limits on its way, whatever the curve.
    fn shape<L: FeedLaw>(&self, anchor: Anchor, from: f64, to: f64) -> Option<L> {
        let mut reach = 0.0;
        loop {
            let (start, end) = anchor.span(reach);
            let law = L::change(from, to, &self.straight(start, end, f64::INFINITY)?).ok()?;
            let length = 0.5 * (from + to) * law.duration();
            self.place(anchor, from, to, law.duration())?;
            if length <= reach * (1.0 + 1e-9) {
                return Some(law);
            }
            // Cells only take away: the ramp grows until it holds all that it needs.
            reach = length;
        }
    }

    /// The limits that the feed would have between two places if the curve were straight, up to `speed`, m/s.
    pub(super) fn straight(&self, from: f64, to: f64, speed: f64) -> Option<Limits> {
        let least = |(acceleration, jerk): (f64, f64), c: &Capped<D>| {
            (acceleration.min(c.acceleration), jerk.min(c.feed_jerk))
        };
        let (acceleration, jerk) =
            self.block.joined(self.block.touched(from, to)).fold((f64::INFINITY, f64::INFINITY), least);
        let snap = self.limits.axes().iter().map(Limits::snap).fold(f64::INFINITY, f64::min);
        Limits::new(speed, acceleration, jerk).and_then(|limits| limits.with_snap(snap)).ok()
    }

    /// Where a ramp of this duration lies, if it lies within the block.
    fn place(&self, anchor: Anchor, from: f64, to: f64, duration: f64) -> Option<Place> {
        let (start, end) = anchor.span(0.5 * (from + to) * duration);
        let rounding = self.block.rounding();
        let inside = start >= self.block.start() - rounding && end <= self.block.end() + rounding;
        inside.then_some(Place { start, end, duration })
    }

    fn placed<L: FeedLaw>(&self, place: &Place, from: f64, to: f64, shape: &L) -> Option<Ramp<L>> {
        let Place { start, end, duration } = *place;
        // The faster end is where most fail.
        let (s, fastest) = if from > to { (start, from) } else { (end, to) };
        let cell = self.block.cell_at(s)?;
        if fastest > cell.speed * SLACK {
            return None;
        }
        let stretched = duration > shape.duration();
        let law = if stretched { shape.stretched_to(duration).ok()? } else { shape.clone() };
        self.holds(start, &law).then_some(Ramp { start, end, from, to, law })
    }
}
