//! Parts of a profile in which the position is monotone, and where it crosses a level in them.

use crate::polynomial::extrema::{Zeros, reversals};
use crate::quantities::{Real, Sample};
use crate::section::{Section, Sectioned};

/// More steps than halving an interval to rounding takes, with as many of Newton's between.
const MOST_STEPS: u32 = 128;

/// A part of a section in which the position is monotone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    section: Section,
    /// Local time of the start and of the end, s.
    from: f64,
    to: f64,
    /// The motion there.
    first: Sample,
    last: Sample,
    /// 1 forward, -1 backward, 0 where nothing moves.
    sign: f64,
    /// Pulses sent when it ends.
    goal: i64,
}

/// A place near which the next crossing is looked for: the last one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near {
    /// Local time of the last crossing, s.
    x: f64,
    /// Local time within rounding of it, s, and the motion there.
    at: f64,
    motion: Sample,
}

impl Run {
    pub(super) fn start(&self) -> Near {
        Near { x: self.from, at: self.from, motion: self.first }
    }

    pub(super) fn sign(&self) -> f64 {
        self.sign
    }

    pub(super) fn goal(&self) -> i64 {
        self.goal
    }

    pub(super) fn length(&self) -> f64 {
        self.to - self.from
    }

    /// Pulses still to be sent, at most zero where there is none, after `count` of them.
    pub(super) fn left(&self, count: i64) -> i64 {
        let ahead = self.goal - count;
        match self.sign {
            sign if sign > 0.0 => ahead,
            sign if sign < 0.0 => -ahead,
            _ => 0,
        }
    }

    /// Where the next pulse is sent, in pulses.
    pub(super) fn next_level(&self, count: i64) -> f64 {
        count as f64 + 0.5 * self.sign
    }

    /// Where the last pulse of the run is sent, in pulses.
    pub(super) fn last_level(&self) -> f64 {
        self.goal as f64 - 0.5 * self.sign
    }

    /// The instant at which the position is `level` in m, s.
    pub(super) fn instant_of(&self, level: f64) -> f64 {
        self.crossing(level, &mut self.start())
    }

    /// The instant at which the position is `level` in m, s, looked for after the place `near`.
    ///
    /// Newton's method from the parabola through the last crossing, kept within a bracket that is halved where a step
    /// leaves it or does not shrink fast enough.
    #[inline]
    pub(super) fn crossing(&self, level: f64, near: &mut Near) -> f64 {
        let x = self.local_crossing(level, near);
        near.x = x;
        self.section.anchor + x
    }

    #[inline]
    fn local_crossing(&self, level: f64, near: &mut Near) -> f64 {
        let Self { from, to, sign, .. } = *self;
        // Levels within rounding of the ends of a run.
        if sign * (self.first.position - level) >= 0.0 {
            return near.x;
        }
        if sign * (self.last.position - level) <= 0.0 {
            return to;
        }
        let (mut low, mut high) = (near.x, to);
        let resolution = f64::EPSILON * from.abs().max(to.abs());
        let Sample { position, velocity, acceleration, .. } = near.motion;
        let way = level - position;
        let root = Real::sqrt(velocity * velocity + 2.0 * acceleration * way);
        let guess = near.at + 2.0 * way / (velocity + sign * root);
        let mut x = if guess > low && guess < high { guess } else { 0.5 * (low + high) };
        let mut previous = high - low;
        for _ in 0..MOST_STEPS {
            let now = self.section.at_local(x);
            let miss = now.position - level;
            if sign * miss < 0.0 {
                low = x;
            } else {
                high = x;
            }
            let step = -miss / now.velocity;
            let newton = x + step;
            if newton >= low && newton <= high && step.abs() <= 0.5 * previous {
                // What the step leaves: its square times the curvature, over twice the slope.
                let curvature =
                    now.acceleration.abs() + step.abs() * (now.jerk.abs() + (step * now.snap).abs());
                if step * step * curvature <= 2.0 * now.velocity.abs() * resolution {
                    (near.at, near.motion) = (x, now);
                    return newton;
                }
                previous = step.abs();
                x = newton;
            } else {
                previous = high - low;
                if previous <= resolution {
                    break;
                }
                x = low + 0.5 * previous;
            }
        }
        (near.at, near.motion) = (high, self.section.at_local(high));
        high
    }
}

/// The runs of a profile, in order of time.
#[derive(Debug, Clone)]
pub(super) struct Runs<'a, P> {
    profile: &'a P,
    /// Size of a pulse, m, what rounding may make of a position, in pulses, and the sum of all pulses.
    size: f64,
    noise: f64,
    total: i64,
    section: Option<Section>,
    reversals: Zeros,
    next: usize,
}

impl<'a, P: Sectioned> Runs<'a, P> {
    pub(super) fn new(profile: &'a P, size: f64, noise: f64, total: i64) -> Self {
        let mut runs =
            Self { profile, size, noise, total, section: None, reversals: Zeros::default(), next: 0 };
        runs.enter(0.0);
        runs
    }

    /// Goes to the section at the instant `t`, s.
    fn enter(&mut self, t: f64) {
        self.section = self.profile.section_at(t);
        self.reversals = self.section.as_ref().map(reversals).unwrap_or_default();
        self.next = 0;
    }
}

impl<P: Sectioned> Iterator for Runs<'_, P> {
    type Item = Run;

    fn next(&mut self) -> Option<Run> {
        let section = self.section?;
        let (start, end) = section.local_ends();
        let turned = self.next.checked_sub(1).and_then(|index| self.reversals.get(index));
        let from = turned.unwrap_or(start);
        let to = match self.reversals.get(self.next) {
            Some(turn) => {
                self.next += 1;
                turn
            }
            None => {
                self.enter(section.end);
                end
            }
        };
        let (first, last) = (section.at_local(from), section.at_local(to));
        let way = last.position - first.position;
        let sign = if way == 0.0 { 0.0 } else { 1.0_f64.copysign(way) };
        let goal = if self.section.is_none() {
            self.total
        } else {
            // Levels that lie within the run by more than rounding; one at its very end belongs to the next run, or,
            // where the profile turns, to none.
            let within = Real::ceil(sign * last.position / self.size - 0.5 - self.noise);
            (sign * within) as i64
        };
        Some(Run { section, from, to, first, last, sign, goal })
    }
}
