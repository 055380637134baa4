//! Whether a motion along a block keeps every limit, between the ticks too.

use super::FeedLimits;
use super::caps::{Block, Capped};
use super::enclosure::{Enclosure, Scalar};
use crate::quantities::Sample;
use crate::section::{Section, Sectioned};

/// How often a section is halved where its bounds are too wide to decide.
const MOST_HALVINGS: u32 = 5;

/// What rounding may add to a feed that is at its cap.
const SLACK: f64 = 1.0 + 1e-12;

/// Checks motions along a block.
#[derive(Debug, Clone, Copy)]
pub(super) struct Check<'a, const D: usize> {
    pub(super) block: &'a Block<D>,
    pub(super) limits: &'a FeedLimits<D>,
}

impl<const D: usize> Check<'_, D> {
    /// Whether a constant feed keeps the limits from `from` to `to`, m along the curve.
    pub(super) fn cruise(&self, from: f64, to: f64, speed: f64) -> bool {
        to - from <= self.rounding() || self.touched(from, to).all(|c| speed <= c.cruise * SLACK)
    }

    /// The cells between two places; the first of them also where there is nothing between.
    pub(super) fn touched(&self, from: f64, to: f64) -> impl Iterator<Item = &Capped<D>> {
        let rounding = self.rounding();
        let cells = self.block.cells.get(self.block.cell_at(from + rounding)..).unwrap_or_default();
        let before = move |(index, c): &(usize, &Capped<D>)| *index == 0 || c.cell.start < to - rounding;
        cells.iter().enumerate().take_while(before).map(|(_, cell)| cell)
    }

    /// How far rounding may put the end of a ramp beyond a place, m.
    pub(super) fn rounding(&self) -> f64 {
        16.0 * f64::EPSILON * self.block.end()
    }

    /// Whether the motion, begun at `from` in m along the curve, keeps the limits: a proof, by intervals.
    pub(super) fn holds<P: Sectioned>(&self, from: f64, motion: &P) -> bool {
        let sections = (0..).map_while(|index| motion.section(index)).filter(|s| s.length() > 0.0);
        sections.into_iter().all(|section| {
            let (start, end) = section.local_ends();
            let ends = [(start, section.at_local(start)), (end, section.at_local(end))];
            self.part(from, &section, ends, MOST_HALVINGS)
        })
    }

    fn part(&self, from: f64, section: &Section, ends: [(f64, Sample); 2], halvings: u32) -> bool {
        let [(x0, first), (x1, last)] = ends;
        let length = x1 - x0;
        let w = section.angular_frequency;
        let wave = section.amplitude.abs() * w * w * w * w;
        // What a function differs from the straight line between its ends is at most a/8 of its second derivative.
        let bulge = 0.125 * length * length;
        let snap = bulge * (first.snap.abs().max(last.snap.abs()) + wave);
        let span = |a: f64, b: f64, bulge: f64| Enclosure::new(a.min(b) - bulge, a.max(b) + bulge);
        let motion = Motion {
            // A ramp is monotone and a move turns where its acceleration is zero, which is where a section ends.
            speed: Enclosure::new(
                first.velocity.min(last.velocity).max(0.0),
                first.velocity.max(last.velocity),
            ),
            acceleration: span(first.acceleration, last.acceleration, snap),
            jerk: span(first.jerk, last.jerk, bulge * wave * w),
        };
        let (s0, s1) = (from + first.position, from + last.position);
        if self.touched(s0, s1).all(|cell| motion.is_within(cell, self.limits)) {
            return true;
        }
        if halvings == 0 {
            return false;
        }
        let x = 0.5 * (x0 + x1);
        let middle = section.at_local(x);
        // What fails in a point fails however often it is halved.
        let at = self.block.cells.get(self.block.cell_at(from + middle.position));
        if !at.is_some_and(|cell| Motion::at(&middle).is_within(cell, self.limits)) {
            return false;
        }
        self.part(from, section, [(x0, first), (x, middle)], halvings - 1)
            && self.part(from, section, [(x, middle), (x1, last)], halvings - 1)
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
        let bounds = &capped.cell.bounds;
        let geometry = bounds.tangent.iter().zip(&bounds.bend).zip(&bounds.twist);
        limits.axes().iter().zip(&capped.jerk).zip(geometry).all(|((axis, left), ((t, k), b))| {
            let acceleration = *t * self.acceleration + *k * square;
            let jerk = *t * self.jerk + *k * mixed + *b * cube;
            acceleration.is_within(axis.acceleration()) && jerk.is_within(*left)
        })
    }
}
