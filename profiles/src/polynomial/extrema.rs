//! Exact extrema of a polynomial motion: the ends of every section and the roots of every derivative.

use super::Piecewise;
use crate::profile::Extrema;
use crate::quantities::{Interval, Real, Sample};
use crate::section::Sectioned;

const NOTHING: Interval = Interval { lower: f64::INFINITY, upper: f64::NEG_INFINITY };

pub(crate) fn over<const N: usize>(profile: &Piecewise<N>) -> Extrema {
    let mut extrema =
        Extrema { position: NOTHING, velocity: NOTHING, acceleration: NOTHING, jerk: NOTHING, snap: NOTHING };
    let mut sections = (0..N).filter_map(|k| profile.section(k)).filter(|s| s.length() > 0.0).peekable();
    if sections.peek().is_none() {
        include(&mut extrema, &profile.before());
    }
    for section in sections {
        // In local time one of the ends is exact.
        let (from, to) = section.local_ends();
        let motion = section.polynomial;
        include(&mut extrema, &motion.advanced(from));
        include(&mut extrema, &motion.advanced(to));

        let turns = |x: Option<f64>| x.filter(|x| from < *x && *x < to);
        let jerk_root = turns((motion.snap != 0.0).then(|| -motion.jerk / motion.snap));
        if let Some(x) = jerk_root {
            extrema.acceleration = extrema.acceleration.including(motion.advanced(x).acceleration);
        }
        let mut pieces = [from, to, to, to];
        let mut count = 0;
        for x in quadratic_roots(motion.acceleration, motion.jerk, 0.5 * motion.snap) {
            if let Some(x) = turns(x) {
                extrema.velocity = extrema.velocity.including(motion.advanced(x).velocity);
                count += 1;
                if let Some(piece) = pieces.get_mut(count) {
                    *piece = x;
                }
            }
        }
        for ends in pieces.windows(2) {
            if let [left, right] = *ends
                && let Some(x) = velocity_root(&motion, left, right)
            {
                extrema.position = extrema.position.including(motion.advanced(x).position);
            }
        }
    }
    extrema
}

fn include(extrema: &mut Extrema, sample: &Sample) {
    extrema.position = extrema.position.including(sample.position);
    extrema.velocity = extrema.velocity.including(sample.velocity);
    extrema.acceleration = extrema.acceleration.including(sample.acceleration);
    extrema.jerk = extrema.jerk.including(sample.jerk);
    extrema.snap = extrema.snap.including(sample.snap);
}

/// The real roots of `c + b x + a x^2`, in ascending order.
fn quadratic_roots(c: f64, b: f64, a: f64) -> [Option<f64>; 2] {
    if a == 0.0 {
        return [(b != 0.0).then(|| -c / b), None];
    }
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return [None, None];
    }
    // The sum without cancellation first, the other root from the product.
    let q = -0.5 * (b + Real::sqrt(discriminant).copysign(b));
    let (first, second) = (q / a, if q == 0.0 { 0.0 } else { c / q });
    [Some(first.min(second)), Some(first.max(second))]
}

/// The zero of the velocity between `left` and `right`, where the velocity is monotone, by bisection.
fn velocity_root(motion: &Sample, mut left: f64, mut right: f64) -> Option<f64> {
    let (at_left, at_right) = (motion.advanced(left).velocity, motion.advanced(right).velocity);
    if at_left * at_right >= 0.0 {
        return None;
    }
    // Halving ends when the interval is one unit in the last place; 128 halvings reach it from any interval
    // that is not astride zero, and 1e-38 of it from those.
    for _ in 0..128 {
        let middle = 0.5 * (left + right);
        if (motion.advanced(middle).velocity < 0.0) == (at_left < 0.0) {
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
    use crate::polynomial::Piece;

    #[test]
    fn turning_points_inside_a_section_are_found() {
        // p = t^4/24 - t^2/2 on [-3, 3]: extrema of every derivative are known by hand.
        let motion = Sample { acceleration: -1.0, snap: 1.0, ..Sample::default() };
        let profile = Piecewise::<2> {
            ends: [3.0, 6.0],
            pieces: [Piece::new(3.0, -3.0, motion), Piece::new(3.0, 3.0, motion)],
            before: 0.0,
            target: 0.0,
            after: 0.0,
            duration: 6.0,
        };
        let extrema = over(&profile);
        assert!(
            (extrema.acceleration.lower + 1.0).abs() < 1e-15
                && (extrema.acceleration.upper - 3.5).abs() < 1e-14
        );
        // Velocity t^3/6 - t turns where t^2 = 2, at -+ (2/3) sqrt 2; its ends are -+ 1.5.
        assert!((extrema.velocity.upper - 1.5).abs() < 1e-14);
        // Position turns at 0 and where t^2 = 6, at -1.5; its ends are 27/8 - 9/2 = -1.125.
        assert!((extrema.position.lower + 1.5).abs() < 1e-14);
        assert!(extrema.position.upper.abs() < 1e-14);
        assert_eq!((extrema.jerk, extrema.snap), (Interval::new(-3.0, 3.0), Interval::new(1.0, 1.0)));
    }

    #[test]
    fn quadratic_roots_keep_their_digits() {
        let [small, large] = quadratic_roots(1.0, -1e9, 1.0);
        assert!((small.expect("root") - 1e-9).abs() < 1e-24);
        assert!((large.expect("root") - 1e9).abs() < 1e-6);
        assert_eq!(quadratic_roots(1.0, 0.0, 1.0), [None, None]);
        assert_eq!(quadratic_roots(-6.0, 2.0, 0.0), [Some(3.0), None]);
    }
}
