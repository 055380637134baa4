//! Exact extrema of a motion: the ends of every section and the zeros of every derivative.

use core::f64::consts::PI;

use crate::profile::Extrema;
use crate::quantities::{Interval, Real, Sample};
use crate::section::{Section, Sectioned, with_sine};

const NOTHING: Interval = Interval { lower: f64::INFINITY, upper: f64::NEG_INFINITY };

/// The most zeros of one derivative that are looked for in one section: far more than the four of a polynomial and
/// the one or two that a sine of half a wave adds.
const MOST: usize = 16;

/// The exact range of every derivative over all sections.
pub(crate) fn over<S: Sectioned>(profile: &S) -> Extrema {
    let sections = (0..).map_while(|k| profile.section(k)).filter(|section| section.length() > 0.0);
    let ranges = sections.map(|section| {
        let (from, to) = section.local_ends();
        let (w, phase) = (section.angular_frequency, section.phase);
        Extrema::of_motion(&section.polynomial, section.amplitude, w, phase, from, to)
    });
    ranges.reduce(Extrema::including).unwrap_or_else(|| Extrema::at(&profile.before()))
}

impl Extrema {
    /// The exact range of `motion` advanced by `x`, plus `amplitude sin(w x + phase)` in the position, for
    /// `from <= x <= to` in s, with `w > 0` in rad/s and at most a few waves in between.
    ///
    /// A derivative turns where the next one is zero, and changes sign at most once between two zeros of the one
    /// after that: from the highest derivative down every zero is bracketed, and bisected to rounding.
    #[must_use]
    pub fn of_motion(motion: &Sample, amplitude: f64, w: f64, phase: f64, from: f64, to: f64) -> Self {
        let at = |x: f64| with_sine(motion.advanced(x), amplitude, w, w * x + phase);
        let mut extrema = Self::at(&at(from)).including(Self::at(&at(to)));
        turns(&at, amplitude != 0.0, w, phase, from, to, |order, turn| {
            let (range, value) = match order {
                0 => (&mut extrema.snap, turn.snap),
                1 => (&mut extrema.jerk, turn.jerk),
                2 => (&mut extrema.acceleration, turn.acceleration),
                3 => (&mut extrema.velocity, turn.velocity),
                _ => (&mut extrema.position, turn.position),
            };
            *range = range.including(value);
        });
        extrema
    }

    /// The range of a single instant.
    #[must_use]
    pub fn at(sample: &Sample) -> Self {
        let one = |value: f64| NOTHING.including(value);
        Self {
            position: one(sample.position),
            velocity: one(sample.velocity),
            acceleration: one(sample.acceleration),
            jerk: one(sample.jerk),
            snap: one(sample.snap),
        }
    }

    /// The smallest ranges that hold both.
    #[must_use]
    pub fn including(self, other: Self) -> Self {
        let both = |a: Interval, b: Interval| a.including(b.lower).including(b.upper);
        Self {
            position: both(self.position, other.position),
            velocity: both(self.velocity, other.velocity),
            acceleration: both(self.acceleration, other.acceleration),
            jerk: both(self.jerk, other.jerk),
            snap: both(self.snap, other.snap),
        }
    }
}

/// The places inside a section, in local time, where the velocity changes sign: between them the position is monotone.
pub(crate) fn reversals(section: &Section) -> Zeros {
    let (from, to) = section.local_ends();
    let (w, phase) = (section.angular_frequency, section.phase);
    turns(&|x| section.at_local(x), section.amplitude != 0.0, w, phase, from, to, |_, _| ())
}

/// Calls `found` for every place where a derivative turns, with its order counted from the snap, 0, to the position, 4,
/// and gives the places where the position turns.
fn turns(
    at: &impl Fn(f64) -> Sample,
    harmonic: bool,
    w: f64,
    phase: f64,
    from: f64,
    to: f64,
    mut found: impl FnMut(usize, &Sample),
) -> Zeros {
    let mut zeros = Zeros::default();
    if harmonic {
        // The fifth derivative is that of the sine alone: a cosine.
        let mut wave = Real::ceil((w * from + phase) / PI - 0.5);
        while (wave + 0.5) * PI < w * to + phase && zeros.push(((wave + 0.5) * PI - phase) / w) {
            wave += 1.0;
        }
        zeros.iter().for_each(|x| found(0, &at(x)));
    }
    let derivatives: [fn(&Sample) -> f64; 4] = [|s| s.snap, |s| s.jerk, |s| s.acceleration, |s| s.velocity];
    for (order, derivative) in derivatives.into_iter().enumerate() {
        zeros = zeros.between(from, to, |x| derivative(&at(x)));
        zeros.iter().for_each(|x| found(order + 1, &at(x)));
    }
    zeros
}

/// The zeros of a function, in ascending order.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Zeros {
    places: [f64; MOST],
    len: usize,
}

impl Zeros {
    /// Whether there was room.
    fn push(&mut self, x: f64) -> bool {
        let place = self.places.get_mut(self.len);
        let room = place.is_some();
        if let Some(place) = place {
            *place = x;
            self.len += 1;
        }
        room
    }

    fn iter(&self) -> impl Iterator<Item = f64> + '_ {
        self.places.iter().take(self.len).copied()
    }

    /// The one with this index, in ascending order.
    pub(crate) fn get(&self, index: usize) -> Option<f64> {
        self.places.get(..self.len)?.get(index).copied()
    }

    /// The zeros of `f` in `[from, to]`, given those of its derivative: `f` is monotone between two of them.
    fn between(&self, from: f64, to: f64, f: impl Fn(f64) -> f64) -> Self {
        let mut zeros = Self::default();
        let mut left = from;
        for right in self.iter().chain([to]) {
            if let Some(zero) = bisect(&f, left, right) {
                zeros.push(zero);
            }
            left = right;
        }
        zeros
    }
}

/// The place between `left` and `right` where `f` changes sign, to the last bit.
fn bisect(f: impl Fn(f64) -> f64, mut left: f64, mut right: f64) -> Option<f64> {
    let (at_left, at_right) = (f(left), f(right));
    // No product, which small values would make zero.
    if !(at_left < 0.0 && at_right > 0.0 || at_left > 0.0 && at_right < 0.0) {
        return None;
    }
    // Astride zero the halves could shrink for a thousand steps; 200 leave 1e-60 of the interval.
    for _ in 0..200 {
        let middle = 0.5 * (left + right);
        if middle <= left || middle >= right {
            break;
        }
        let at_middle = f(middle);
        // A zero ends on the same side whichever way the function goes.
        if at_middle != 0.0 && (at_middle < 0.0) == (at_left < 0.0) {
            left = middle;
        } else {
            right = middle;
        }
    }
    Some(0.5 * (left + right))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_points_inside_a_section_are_found() {
        // p = t^4/24 - t^2/2 on [-3, 3]: extrema of every derivative are known by hand.
        let motion = Sample { acceleration: -1.0, snap: 1.0, ..Sample::default() };
        let extrema = Extrema::of_motion(&motion, 0.0, 0.0, 0.0, -3.0, 3.0);
        assert!((extrema.acceleration.lower + 1.0).abs() < 1e-15);
        assert!((extrema.acceleration.upper - 3.5).abs() < 1e-14);
        // Velocity t^3/6 - t turns where t^2 = 2, at -+ (2/3) sqrt 2; its ends are -+ 1.5.
        assert!((extrema.velocity.upper - 1.5).abs() < 1e-14);
        // Position turns at 0 and where t^2 = 6, at -1.5; its ends are 27/8 - 9/2 = -1.125.
        assert!((extrema.position.lower + 1.5).abs() < 1e-14);
        assert!(extrema.position.upper.abs() < 1e-14);
        assert_eq!((extrema.jerk, extrema.snap), (Interval::new(-3.0, 3.0), Interval::new(1.0, 1.0)));
    }

    #[test]
    fn a_sine_on_a_slope_turns_where_its_velocity_cancels() {
        // p = sin(2 x) - x on [0, 3]: v = 2 cos(2 x) - 1 is zero at x = pi/6 and 5 pi/6.
        let motion = Sample::cruising(0.0, -1.0);
        let extrema = Extrema::of_motion(&motion, 1.0, 2.0, 0.0, 0.0, 3.0);
        // Counted from elsewhere it is the same.
        let shifted = Extrema::of_motion(&motion.advanced(0.5), 1.0, 2.0, 1.0, -0.5, 2.5);
        assert!((extrema.position.upper - shifted.position.upper).abs() < 1e-15);
        assert!((extrema.velocity.lower - shifted.velocity.lower).abs() < 1e-15);
        let (high, low) = (3.0_f64.sqrt() / 2.0 - PI / 6.0, -(3.0_f64.sqrt()) / 2.0 - 5.0 * PI / 6.0);
        assert!((extrema.position.upper - high).abs() < 1e-15);
        assert!((extrema.position.lower - low).abs() < 1e-15);
        // Every derivative of the sine reaches its amplitude within the wave.
        assert!((extrema.velocity.lower + 3.0).abs() < 1e-15);
        assert!(
            (extrema.acceleration.lower + 4.0).abs() < 1e-15
                && (extrema.acceleration.upper - 4.0).abs() < 1e-15
        );
        assert!((extrema.snap.upper - 16.0).abs() < 1e-14 && (extrema.snap.lower + 16.0).abs() < 1e-14);
    }
}
