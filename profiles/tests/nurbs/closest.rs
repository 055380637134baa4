//! The nearest point against brute force.

use profiles::nurbs::{Knots, NurbsCurve, NurbsError};
use proptest::prelude::*;

use crate::curves::{CASES, a_curve, a_light_curve, at, distance, norm, size};

/// The smallest distance of 2000 samples, and how much nearer the curve can be between two of them.
fn sampled<const D: usize>(curve: &NurbsCurve<D>, target: &[f64; D]) -> (f64, f64) {
    let fastest = curve.speed_bounds(curve.domain().lower, curve.domain().upper).upper;
    let places = (0..=2000).map(|k| curve.point(at(curve, f64::from(k) / 2000.0)));
    let nearest = places.map(|point| distance(&point, target)).fold(f64::INFINITY, f64::min);
    (nearest, fastest * (curve.domain().upper - curve.domain().lower) / 4000.0)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    #[test]
    fn no_sample_is_nearer(curve in a_curve::<3>(), target in prop::array::uniform3(-1.5..1.5)) {
        let target = target.map(|x: f64| x * size(&curve));
        let found = curve.closest(target)?;
        prop_assert_eq!(found.point, curve.point(found.parameter));
        prop_assert_eq!(found.distance, distance(&found.point, &target));
        let (nearest, between) = sampled(&curve, &target);
        let rounding = 16.0 * f64::EPSILON * size(&curve);
        prop_assert!(found.distance <= nearest + rounding, "{} beyond {}", found.distance, nearest);
        prop_assert!(found.distance >= nearest - between - rounding);
        // Inside a span the connection is perpendicular to the curve.
        let inside = curve.knots().distinct().all(|(knot, _)| (knot - found.parameter).abs() > 1e-9);
        if inside {
            let [point, first, second] = curve.derivatives::<3>(found.parameter);
            let apart: Vec<f64> = point.iter().zip(target).map(|(x, t)| x - t).collect();
            let slope: f64 = apart.iter().zip(first).map(|(x, y)| x * y).sum();
            // A parameter rounds; so do both vectors.
            let steep = norm(&first).powi(2) + found.distance * norm(&second);
            let magnitude = curve.domain().magnitude();
            let allowed = 64.0 * f64::EPSILON * (steep * magnitude + size(&curve) * (norm(&first) + 1e4 * size(&curve)));
            prop_assert!(slope.abs() <= allowed, "{} above {}", slope, allowed);
        }
    }

    #[test]
    fn a_point_of_the_curve_is_found(curve in a_curve::<2>(), place in 0.0..=1.0) {
        let u = at(&curve, place);
        let found = curve.closest(curve.point(u))?;
        // The squared distance of a piece is known to roundings of its size, the distance only to their root; Newton's
        // method then goes down to the rounding of the parameter.
        let speed = norm(&curve.derivatives::<2>(u)[1]).max(norm(&curve.derivatives::<2>(found.parameter)[1]));
        let allowed = 64.0 * f64::EPSILON * (size(&curve) + speed * curve.domain().magnitude());
        prop_assert!(found.distance <= allowed, "{} above {}", found.distance, allowed);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    #[test]
    fn light_weights_hide_no_branch(curve in a_light_curve::<2>(), target in prop::array::uniform2(-1.5..1.5)) {
        let target = target.map(|x: f64| x * size(&curve));
        let found = curve.closest(target)?;
        let nearest = sampled(&curve, &target).0;
        // Squared distances are known to 64 roundings, distances to the root of that.
        let rounding = 8.0 * f64::EPSILON.sqrt() * size(&curve);
        prop_assert!(found.distance <= nearest + rounding, "{} beyond {}", found.distance, nearest);
    }
}

#[test]
fn the_nearer_of_two_branches_is_found() {
    // A hairpin with legs 2 apart, and targets a hair nearer to one of them.
    let knots = Knots::clamped(2, 0.0, &[0.45, 0.55], 1.0).expect("knots");
    let points = [[0.0, 1.0], [10.0, 1.0], [10.0, -1.0], [4.0, -1.0], [0.0, -1.0]];
    let curve = NurbsCurve::with_knots(knots, &points, &[1.0; 5]).expect("curve");
    for k in 1..12 {
        let hair = 10.0_f64.powi(-k);
        for side in [-1.0, 1.0] {
            let target = [0.5, side * hair];
            let found = curve.closest(target).expect("nearest");
            assert!(found.distance < sampled(&curve, &target).0 + 1e-15, "{k}");
            // The upper leg bends away from y = 1 and is nearer for either sign as long as the hair is short.
            let upper = found.point[1] > 0.0;
            assert!(upper || side < 0.0, "{found:?}");
        }
    }
}

#[test]
fn from_the_middle_of_a_circle_every_point_is_as_near() {
    for degree in 0..4 {
        let circle =
            NurbsCurve::<2>::circle([3.0, -2.0], 7.0).and_then(|c| c.raised(degree)).expect("circle");
        let found = circle.closest([3.0, -2.0]).expect("nearest");
        assert!((found.distance - 7.0).abs() <= 8.0 * f64::EPSILON * 10.0);
        // A hair off the middle it is the side of the hair.
        for angle in [0.3_f64, 2.0, -1.0] {
            let target = [3.0 + 1e-9 * angle.cos(), -2.0 + 1e-9 * angle.sin()];
            let found = circle.closest(target).expect("nearest");
            assert!((found.distance - 7.0 + 1e-9).abs() <= 16.0 * f64::EPSILON * 10.0);
        }
    }
}

#[test]
fn ends_corners_and_degenerate_curves() {
    let lines = NurbsCurve::polyline(&[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]]).expect("lines");
    let corner = lines.closest([6.0, -1.0]).expect("nearest");
    assert_eq!(corner.point, [4.0, 0.0]);
    let end = lines.closest([4.5, 9.0]).expect("nearest");
    assert_eq!((end.point, end.parameter), ([4.0, 3.0], 1.0));
    let inside = lines.closest([1.0, 2.0]).expect("nearest");
    assert!((inside.point[0] - 1.0).abs() < 1e-15 && (inside.distance - 2.0).abs() < 1e-15);
    let point = NurbsCurve::bezier(&[[3.0, 1.0]; 4]).expect("point");
    assert_eq!(point.closest([0.0, 5.0]).expect("nearest").distance, 5.0);
    assert_eq!(point.closest([3.0, 1.0]).expect("nearest").distance, 0.0);
    let nan = point.closest([0.0, f64::NAN]);
    assert!(matches!(nan, Err(NurbsError::Coordinate { index: 0, axis: 1, value }) if value.is_nan()));
}
