//! A unit step through a chain, as polynomials.

use super::link::{Link, MOST_STEPS};
use crate::quantities::{Real, Sample};

/// The motion from one knot on, expanded about it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Knot {
    pub(super) start: f64,
    /// Time to the next knot, s: that of its own, not the difference of two instants.
    pub(super) length: f64,
    /// Integral of the position up to here, s.
    integral: f64,
    /// Position, 0 to 1, and its derivatives.
    pub(super) motion: Sample,
}

impl Knot {
    fn advanced(&self, x: f64) -> Self {
        let Sample { position: p, velocity: v, acceleration: a, jerk: j, snap: s } = self.motion;
        let integral = self.integral + x * (p + x / 2.0 * (v + x / 3.0 * (a + x / 4.0 * (j + x / 5.0 * s))));
        Self { integral, motion: self.motion.advanced(x), ..*self }
    }
}

/// A step from 0 to 1 that takes some time, in at most `N` sections.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step<const N: usize> {
    knots: [Knot; N],
    len: usize,
    /// Where it is over; the position is one from there on.
    last: Knot,
}

/// A delayed copy of a step, as the knots are gone through.
#[derive(Debug, Clone, Copy)]
struct Delayed {
    delay: f64,
    /// Knots of it that have been passed.
    passed: usize,
    /// Time since the last of them, s.
    since: f64,
}

impl<const N: usize> Step<N> {
    /// The step that takes no time.
    pub(super) fn unit() -> Self {
        let last = Knot { motion: Sample::at_rest(1.0), ..Knot::default() };
        Self { knots: [Knot::default(); N], len: 0, last }
    }

    /// The sections, each from its knot on.
    pub(super) fn knots(&self) -> &[Knot] {
        self.knots.get(..self.len).unwrap_or_default()
    }

    /// Where it is over.
    pub(super) fn end(&self) -> f64 {
        self.last.start
    }

    /// How far the position at the end, which is set to one, was off it.
    pub(super) fn end_error(&self) -> f64 {
        (self.last.motion.position - 1.0).abs()
    }

    /// The step through `link`, or through its mirror image; `None` where that takes more sections than there is room for.
    ///
    /// An average over `L` is `(R(t) - R(t - L)) / L` with `R` the integral of the position. The links come in order of
    /// length, so that `R` is never much larger than `L` and the difference keeps its digits.
    pub(super) fn through(&self, link: &Link, mirrored: bool) -> Option<Self> {
        match *link {
            Link::Damped { period, periods, decay, .. } if decay < 1.0 => {
                let mut copies = [(0.0, 0.0); MOST_STEPS];
                let mut weight = 1.0 / link.effective();
                let mut growth = decay;
                if mirrored {
                    weight *= Real::powf(decay, f64::from(2 * periods - 1));
                    growth = 1.0 / decay;
                }
                // From each half period to the next the weight steps by what it grows.
                let (mut before, mut halves) = (0.0, 0.0);
                for copy in copies.iter_mut().take(2 * periods as usize) {
                    *copy = (0.5 * period * halves, weight - before);
                    (before, weight, halves) = (weight, weight * growth, halves + 1.0);
                }
                if let Some(last) = copies.get_mut(2 * periods as usize) {
                    *last = (0.5 * period * halves, -before);
                }
                self.averaged(copies.get(..link.knots())?)
            }
            Link::Average { .. } | Link::Damped { .. } => {
                let length = link.duration();
                self.averaged(&[(0.0, 1.0 / length), (length, -1.0 / length)])
            }
            Link::Pair { delay, decay, .. } => {
                let (now, past) = if mirrored { (decay, 1.0) } else { (1.0, decay) };
                let weights = [(0.0, now / (1.0 + decay)), (delay, past / (1.0 + decay))];
                self.combined(&weights, |knot| knot.motion)
            }
        }
    }

    /// The sum of copies of the integral of the position, each with its delay and weight.
    fn averaged(&self, copies: &[(f64, f64)]) -> Option<Self> {
        self.combined(copies, |knot| Sample {
            position: knot.integral,
            velocity: knot.motion.position,
            acceleration: knot.motion.velocity,
            jerk: knot.motion.acceleration,
            snap: knot.motion.jerk,
        })
    }

    /// The sum of copies of what `of` takes from the motion, each with its delay and weight.
    fn combined(&self, copies: &[(f64, f64)], of: impl Fn(&Knot) -> Sample) -> Option<Self> {
        let mut all = [Delayed { delay: 0.0, passed: 0, since: 0.0 }; MOST_STEPS];
        let at = all.get_mut(..copies.len())?;
        at.iter_mut().zip(copies).for_each(|(copy, (delay, _))| copy.delay = *delay);
        let mut step = Self { knots: [Knot::default(); N], len: 0, last: Knot::default() };
        let mut now = Knot::default();
        loop {
            // Knots of two copies that are one but for rounding are one: a section of a rounding would have peaks of its own.
            let same = 8.0 * f64::EPSILON * now.start;
            for copy in at.iter_mut() {
                let left = self.length(copy) - copy.since;
                if left <= 0.0 || copy.since > 0.0 && left <= same {
                    copy.passed += 1;
                    copy.since = 0.0;
                }
            }
            let mut motion = Sample::default();
            for (copy, (_, weight)) in at.iter().zip(copies) {
                let part = of(&self.seen(copy));
                motion.position += weight * part.position;
                motion.velocity += weight * part.velocity;
                motion.acceleration += weight * part.acceleration;
                motion.jerk += weight * part.jerk;
                motion.snap += weight * part.snap;
            }
            let length = at.iter().map(|copy| self.length(copy) - copy.since).fold(f64::INFINITY, f64::min);
            now = Knot { motion, length, ..now };
            if at.iter().all(|copy| copy.passed > self.len) {
                step.last = Knot { motion: Sample::at_rest(motion.position), ..now };
                return Some(step);
            }
            *step.knots.get_mut(step.len)? = now;
            step.len += 1;
            now = Knot { start: now.start + length, ..now.advanced(length) };
            at.iter_mut().for_each(|copy| copy.since += length);
        }
    }

    /// Time from the last knot of a copy that has been passed to the next one, s.
    fn length(&self, copy: &Delayed) -> f64 {
        match copy.passed.checked_sub(1) {
            None => copy.delay,
            Some(index) => self.knots().get(index).map_or(f64::INFINITY, |knot| knot.length),
        }
    }

    /// A copy now.
    fn seen(&self, copy: &Delayed) -> Knot {
        copy.passed.checked_sub(1).map_or(Knot::default(), |index| {
            self.knots().get(index).unwrap_or(&self.last).advanced(copy.since)
        })
    }
}
