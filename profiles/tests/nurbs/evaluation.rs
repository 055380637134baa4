//! Points and derivatives by independent routes.

use profiles::nurbs::{Knots, NurbsCurve, Side};
use proptest::prelude::*;

use crate::curves::{CASES, a_curve, at, distance, norm, size, unevenness};

/// Cox and de Boor's recursion as it is written down.
fn by_recursion(knots: &[f64], i: usize, p: usize, u: f64, last: bool) -> f64 {
    if p == 0 {
        let inside = if last { knots[i] < u && u <= knots[i + 1] } else { knots[i] <= u && u < knots[i + 1] };
        return f64::from(u8::from(inside));
    }
    let part = |numerator: f64, denominator: f64, below: f64| {
        if denominator == 0.0 { 0.0 } else { numerator / denominator * below }
    };
    part(u - knots[i], knots[i + p] - knots[i], by_recursion(knots, i, p - 1, u, last))
        + part(
            knots[i + p + 1] - u,
            knots[i + p + 1] - knots[i + 1],
            by_recursion(knots, i + 1, p - 1, u, last),
        )
}

fn weighted_sum<const D: usize>(curve: &NurbsCurve<D>, u: f64) -> [f64; D] {
    let knots = curve.knots().as_slice();
    let last = u == curve.domain().upper;
    let (mut above, mut below) = ([0.0; D], 0.0);
    for (i, (point, weight)) in curve.control_points().zip(curve.weights()).enumerate() {
        let basis = by_recursion(knots, i, curve.degree(), u, last) * weight;
        below += basis;
        above.iter_mut().zip(point).for_each(|(sum, x)| *sum += basis * x);
    }
    above.map(|x| x / below)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    #[test]
    fn a_point_is_the_weighted_sum(curve in a_curve::<3>(), place in 0.0..=1.0) {
        for u in [at(&curve, place), curve.domain().lower, curve.domain().upper] {
            // Each of the two routes rounds `degree` convex combinations, and their sums.
            let allowed = 16.0 * curve.degree() as f64 * f64::EPSILON * size(&curve);
            prop_assert!(distance(&curve.point(u), &weighted_sum(&curve, u)) <= allowed);
        }
        prop_assert_eq!(curve.point(curve.domain().lower), curve.start());
        prop_assert_eq!(curve.point(curve.domain().upper), curve.end());
    }

    #[test]
    fn basis_functions_are_a_partition_of_unity(curve in a_curve::<1>(), place in 0.0..=1.0) {
        let knots = curve.knots();
        let u = at(&curve, place);
        let basis = knots.basis(u, Side::After);
        prop_assert!(basis.values().iter().all(|n| *n >= 0.0));
        let sum: f64 = basis.values().iter().sum();
        prop_assert!((sum - 1.0).abs() <= 4.0 * (knots.degree() + 1) as f64 * f64::EPSILON);
        for (k, value) in basis.values().iter().enumerate() {
            let other = by_recursion(knots.as_slice(), basis.first() + k, knots.degree(), u, place == 1.0);
            prop_assert!((value - other).abs() <= 64.0 * f64::EPSILON);
        }
    }

    /// A central difference over a step `h` is off by `h^2 / 6` of the derivative two orders on.
    #[test]
    fn derivatives_are_difference_quotients(curve in a_curve::<3>(), span in 0..6_usize, place in 0.1..0.9) {
        let ends: Vec<f64> = curve.knots().distinct().map(|(knot, _)| knot).collect();
        let span = span % (ends.len() - 1);
        let length = ends[span + 1] - ends[span];
        let u = ends[span] + place * length;
        let (early, late) = (u - 1e-4 * length, u + 1e-4 * length);
        let (left, right) = (curve.derivatives::<5>(early), curve.derivatives::<5>(late));
        let here = curve.derivatives::<8>(u);
        let h = 0.5 * (late - early);
        for k in 0..5 {
            let mut quotient = [0.0; 3];
            for (q, (a, b)) in quotient.iter_mut().zip(left[k].iter().zip(right[k])) {
                *q = (b - a) / (late - early);
            }
            // The scale of a derivative: what spans and weights make of the size.
            let scale = |k: usize| {
                let steep = curve.degree() as f64 * unevenness(&curve) / length;
                size(&curve) * steep.powi(k as i32) * (1..=k).product::<usize>() as f64
            };
            let rounding = 64.0 * f64::EPSILON * scale(k) / h;
            let allowed = h * h * (norm(&here[k + 3]) / 3.0 + 1e-2 * scale(k + 3) * h) + rounding;
            prop_assert!(
                distance(&quotient, &here[k + 1]) <= allowed,
                "order {}: {:?} and {:?}, allowed {}", k + 1, quotient, here[k + 1], allowed
            );
        }
    }

    /// Fewer derivatives are the same ones.
    #[test]
    fn orders_do_not_depend_on_their_number(curve in a_curve::<2>(), place in 0.0..=1.0) {
        let u = at(&curve, place);
        let many = curve.derivatives::<12>(u);
        let few = curve.derivatives::<3>(u);
        prop_assert_eq!(&many[..3], &few[..]);
        prop_assert_eq!(many[0], curve.point(u));
        prop_assert!(many.iter().flatten().all(|x| x.is_finite()));
    }
}

/// The derivatives of (1 - t^2, 2 t) / (1 + t^2), order by order: f = n / q gives q f_k + k q' f_(k-1) + k (k-1) / 2 q''
/// f_(k-2) = n_k.
#[test]
fn rational_derivatives_of_every_order() {
    let weights = [1.0, 1.0, 2.0];
    let curve = NurbsCurve::rational_bezier(&[[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], &weights).expect("curve");
    for t in [0.0, 0.3, 0.5, 0.9, 1.0] {
        let q = [1.0 + t * t, 2.0 * t, 2.0];
        let numerators = [[1.0 - t * t, -2.0 * t, -2.0], [2.0 * t, 2.0, 0.0]];
        let derivatives = curve.derivatives::<13>(t);
        for (axis, n) in numerators.iter().enumerate() {
            let mut expected = [0.0_f64; 13];
            for k in 0..13 {
                let mut sum = n.get(k).copied().unwrap_or(0.0);
                let order = k as f64;
                if k > 0 {
                    sum -= order * q[1] * expected[k - 1];
                }
                if k > 1 {
                    sum -= 0.5 * order * (order - 1.0) * q[2] * expected[k - 2];
                }
                expected[k] = sum / q[0];
                // Poles at +-i: the derivative of order k is of the size of k! and its recursion rounds that often.
                let scale: f64 = (1..=k).map(|i| i as f64).product();
                assert!((derivatives[k][axis] - expected[k]).abs() <= 64.0 * f64::EPSILON * scale.max(1.0));
            }
        }
    }
}

#[test]
fn corners_are_seen_from_both_sides() {
    let knots = Knots::clamped(2, 0.0, &[1.0, 1.0], 3.0).expect("knots");
    let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 4.0]];
    let curve = NurbsCurve::with_knots(knots, &points, &[1.0; 5]).expect("curve");
    let [point, before] = curve.derivatives_from::<2>(1.0, Side::Before);
    let [same, after] = curve.derivatives_from::<2>(1.0, Side::After);
    assert_eq!((point, before), ([2.0, 0.0], [2.0, 0.0]));
    assert_eq!((same, after), ([2.0, 0.0], [0.0, 1.0]));
    // At the ends there is only one side.
    assert_eq!(curve.derivatives_from::<2>(0.0, Side::Before), curve.derivatives::<2>(0.0));
    assert_eq!(curve.derivatives_from::<2>(3.0, Side::Before), curve.derivatives::<2>(3.0));
}

#[test]
fn any_parameter_has_an_answer() {
    let curve = NurbsCurve::uniform(3, &[[0.0], [1.0], [5.0], [2.0], [3.0]]).expect("curve");
    for u in [f64::NAN, f64::NEG_INFINITY, -1e300, -0.0] {
        assert_eq!(curve.point(u), [0.0]);
        assert_eq!(curve.derivatives::<4>(u), curve.derivatives::<4>(0.0));
    }
    for u in [f64::INFINITY, 1e300] {
        assert_eq!(curve.point(u), [3.0]);
    }
    assert!(curve.knots().basis(f64::NAN, Side::Before).values().iter().all(|n| n.is_finite()));
}

#[test]
fn the_highest_degree_is_evaluated_too() {
    // x = t in degree 15: control points at Greville parameters.
    let knots = Knots::clamped(15, 0.0, &[0.3, 0.3, 0.7], 1.0).expect("knots");
    let points: Vec<[f64; 1]> = knots.greville().map(|u| [u]).collect();
    let curve = NurbsCurve::with_knots(knots, &points, &[2.0; 19]).expect("curve");
    for k in 0..=100 {
        let u = f64::from(k) / 100.0;
        let [x, slope, bend] = curve.derivatives::<3>(u);
        assert!((x[0] - u).abs() <= 32.0 * f64::EPSILON);
        // Differences of neighbours over spans of a tenth, times the degree.
        assert!((slope[0] - 1.0).abs() <= 1e3 * f64::EPSILON);
        assert!(bend[0].abs() <= 1e5 * f64::EPSILON);
    }
}
