//! Whether a motion along a block keeps every limit, between the ticks too.

use super::FeedLimits;
use super::block::Block;
use super::caps::Capped;
use super::enclosure::{Enclosure, Scalar};
use crate::quantities::Sample;
use crate::section::{Section, Sectioned};

/// How often a section is halved where its bounds are too wide to decide.
const MOST_HALVINGS: u32 = 5;

/// What rounding may add to a feed that is at its cap.
pub(super) const SLACK: f64 = 1.0 + 1e-12;

/// A jerk that is this part of another one is zero, where a sine has its node.
const ROUNDING: f64 = 1e-12;

/// Checks motions along a block.
#[derive(Debug, Clone, Copy)]
pub(super) struct Check<'a, const D: usize> {
    pub(super) block: &'a Block<D>,
    pub(super) limits: &'a FeedLimits<D>,
}

/// A part of a section: local times of its ends, s, and the motion there.
type Part = [(f64, Sample); 2];

impl<const D: usize> Check<'_, D> {
    /// Whether a constant feed keeps the limits from `from` to `to`, m along the curve.
    pub(super) fn cruise(&self, from: f64, to: f64, speed: f64) -> bool {
        let short = to - from <= self.block.rounding();
        short || self.block.all(self.block.touched(from, to), &|c| speed <= c.cruise * SLACK)
    }

    /// Whether the motion, begun at `from` in m along the curve, keeps the limits: a proof, by intervals.
    pub(super) fn holds<P: Sectioned>(&self, from: f64, motion: &P) -> bool {
        let mut cell = self.block.index_at(from + self.block.rounding());
        let sections = (0..).map_while(|index| motion.section(index)).filter(|s| s.length() > 0.0);
        sections.into_iter().all(|section| {
            let (start, end) = section.local_ends();
            let ends = [(start, section.at_local(start)), (end, section.at_local(end))];
            self.part(from, &section, ends, &mut cell, MOST_HALVINGS)
        })
    }

    /// `cell` is one at or before the start of the part, and then the one there.
    fn part(&self, from: f64, section: &Section, part: Part, cell: &mut usize, halvings: u32) -> bool {
        let [(x0, first), (x1, last)] = part;
        let (s0, s1) = (from + first.position + self.block.rounding(), from + last.position);
        let cells = self.block.cells();
        while cells.get(*cell + 1).is_some_and(|next| next.start <= s0) {
            *cell += 1;
        }
        let motion = Motion::between(section, &part);
        let touched = self.block.touched_after(*cell, s1);
        if self.block.all(touched, &|c| motion.is_within(c, self.limits)) {
            return true;
        }
        if halvings == 0 {
            return false;
        }
        let x = 0.5 * (x0 + x1);
        let middle = section.at_local(x);
        // What fails in a point fails however often it is halved.
        let at = self.block.cell_at(from + middle.position);
        if !at.is_some_and(|c| Motion::at(&middle).is_within(c, self.limits)) {
            return false;
        }
        self.part(from, section, [(x0, first), (x, middle)], cell, halvings - 1)
            && self.part(from, section, [(x, middle), (x1, last)], cell, halvings - 1)
    }
}

/// A feed and its derivatives, enclosed.
struct Motion {
    speed: Enclosure,
    acceleration: Enclosure,
    jerk: Enclosure,
}

impl Motion {
    fn at(sample: &Sample) -> Self {
        Self {
            speed: Enclosure::from_f64(sample.velocity),
            acceleration: Enclosure::from_f64(sample.acceleration),
            jerk: Enclosure::from_f64(sample.jerk),
        }
    }

    /// Speed and jerk are monotone in a section of a law, and so is the acceleration as long as the jerk keeps its sign;
    /// otherwise it differs from the straight line between its ends by at most an eighth of its second derivative times
    /// the square of the time.
    fn between(section: &Section, [(x0, first), (x1, last)]: &Part) -> Self {
        let span = |a: f64, b: f64| Enclosure::new(a.min(b), a.max(b));
        let (speed, jerk) = (span(first.velocity, last.velocity), span(first.jerk, last.jerk));
        let mut acceleration = span(first.acceleration, last.acceleration);
        let turns = jerk.lower.min(0.0).max(-jerk.upper) < -ROUNDING * jerk.magnitude();
        if turns {
            let square = section.angular_frequency * section.angular_frequency;
            let snap = section.polynomial.snap.abs() + section.amplitude.abs() * square * square;
            acceleration = acceleration + Enclosure::around_zero(0.125 * (x1 - x0) * (x1 - x0) * snap);
        }
        Self { speed: Enclosure::new(speed.lower.max(0.0), speed.upper), acceleration, jerk }
    }

    /// Whether axis velocities, accelerations and jerks stay within their limits on a cell:
    ///
    /// `x' = t v`, `x'' = t a + k v^2`, `x''' = t j + 3 k v a + b v^3`
    ///
    /// with tangent `t`, its derivatives `k` and `b` by the arc, and feed `v`, acceleration `a` and jerk `j` along it.
    fn is_within<const D: usize>(&self, capped: &Capped<D>, limits: &FeedLimits<D>) -> bool {
        if self.speed.upper > capped.speed * SLACK {
            return false;
        }
        let square = self.speed.square();
        let cube = square * self.speed;
        let mixed = self.speed * self.acceleration * 3.0;
        let bounds = &capped.bounds;
        let geometry = bounds.tangent.iter().zip(&bounds.bend).zip(&bounds.twist);
        limits.axes().iter().zip(&capped.jerk).zip(geometry).all(|((axis, left), ((t, k), b))| {
            let acceleration = *t * self.acceleration + *k * square;
            let jerk = *t * self.jerk + *k * mixed + *b * cube;
            acceleration.is_within(axis.acceleration()) && jerk.is_within(*left)
        })
    }
}
