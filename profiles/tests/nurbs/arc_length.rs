//! Arc length against closed forms and chords, and its inverse.

use std::f64::consts::{PI, TAU};

use profiles::nurbs::{ArcLength, Knots, NurbsCurve, NurbsError, Side};
use proptest::prelude::*;

use crate::curves::{CASES, a_curve, a_light_curve, at, distance, norm, size, unevenness};

/// The table's length is the true one within its own bound, which is rounding.
fn is<const D: usize>(curve: &NurbsCurve<D>, length: f64) {
    let path = ArcLength::new(curve.clone(), 1e-13 * length).expect("table");
    let error = (path.length() - length).abs();
    assert!(
        error <= path.error_bound(),
        "{} instead of {length}, bound {}",
        path.length(),
        path.error_bound()
    );
    // What the coordinates round is more than what a short length would.
    let scale = length + size(curve);
    assert!(path.error_bound() <= 2e-12 * scale, "{}", path.error_bound() / scale);
}

#[test]
fn closed_forms() {
    is(&NurbsCurve::line([1.0, 2.0, 3.0], [3.0, 5.0, 9.0]).expect("line"), 7.0);
    // Zero speed at the start: 5 t^2.
    is(&NurbsCurve::bezier(&[[0.0, 0.0], [0.0, 0.0], [3.0, 4.0]]).expect("line"), 5.0);
    for sweep in [1e-3, 1.0, -2.0, PI, 5.0, TAU, 9.0] {
        is(&NurbsCurve::<2>::arc([1.0, 2.0], 3.0, 0.4, sweep).expect("arc"), 3.0 * sweep.abs());
    }
    // y = x^2 from 0 to 2: (2 a sqrt(1 + 4 a^2) + asinh 2 a) / 4.
    let parabola = NurbsCurve::bezier(&[[0.0, 0.0], [1.0, 0.0], [2.0, 4.0]]).expect("parabola");
    let a = 2.0_f64;
    is(&parabola, (2.0 * a * (1.0 + 4.0 * a * a).sqrt() + (2.0 * a).asinh()) / 4.0);
    is(
        &parabola.raised(5).expect("raised"),
        (2.0 * a * (1.0 + 4.0 * a * a).sqrt() + (2.0 * a).asinh()) / 4.0,
    );
    // The cusp (t^2, t^3) from -1 to 1: 2 (13 sqrt 13 - 8) / 27.
    let cusp =
        NurbsCurve::bezier(&[[1.0, -1.0], [-1.0 / 3.0, 1.0], [-1.0 / 3.0, -1.0], [1.0, 1.0]]).expect("cusp");
    is(&cusp, 2.0 * (13.0 * 13.0_f64.sqrt() - 8.0) / 27.0);
    // The same with the cusp at an odd place.
    is(&cusp.part(0.0, 0.9).expect("part").with_domain(1.0, 4.0).expect("domain"), {
        let t: f64 = 0.8;
        ((13.0 * 13.0_f64.sqrt() - 8.0) + ((4.0 + 9.0 * t * t).powf(1.5) - 8.0)) / 27.0
    });
    // A polyline turns back on itself.
    is(&NurbsCurve::polyline(&[[0.0, 0.0], [3.0, 4.0], [0.0, 0.0], [0.0, 1.0]]).expect("lines"), 11.0);
    // A nearly straight hairpin: y = 1e-4 (x - x^2), there and back by a parabola in x.
    let flat = NurbsCurve::bezier(&[[0.0, 0.0], [1.0, 1e-4], [0.0, 2e-4]]).expect("hairpin");
    let b = 1e-4_f64;
    // x' = 2 - 4 t, y' = 2 b: the integral of 2 sqrt(4 s^2 + b^2) over s in [-1/2, 1/2].
    let root = (1.0 + b * b).sqrt();
    is(&flat, root + b * b * (1.0 / b).asinh());
}

#[test]
fn a_point_has_no_length() {
    let point = NurbsCurve::rational_bezier(&[[3.0, 1.0]; 4], &[1.0, 2.0, 0.3, 1.0]).expect("point");
    let path = ArcLength::new(point, 1e-9).expect("table");
    assert!(path.length() <= path.error_bound() && path.error_bound() <= 1e-9);
    assert!((0.0..=1.0).contains(&path.parameter_at(0.0)));
    assert!((0.0..=1.0).contains(&path.parameter_at(1.0)));
}

/// A tolerance far below rounding ends in rounding, and in few pieces.
#[test]
fn no_tolerance_is_too_small() {
    let cusp =
        NurbsCurve::bezier(&[[1.0, -1.0], [-1.0 / 3.0, 1.0], [-1.0 / 3.0, -1.0], [1.0, 1.0]]).expect("cusp");
    let point = NurbsCurve::rational_bezier(&[[3.1, 1.7]; 4], &[1.0, 2.0, 0.3, 1.0]).expect("point");
    let circle = NurbsCurve::<2>::circle([1e3, 1e3], 1.0).and_then(|c| c.raised(4)).expect("circle");
    for curve in [cusp, point, circle] {
        let (rough, error) = curve.length(1e-9).expect("length");
        let (length, rounding) = curve.length(5e-324).expect("length");
        assert!(
            (length - rough).abs() <= error + rounding && rounding <= 1e-12 * (length + 10.0 * size(&curve))
        );
    }
}

#[test]
fn lengths_and_parameters_outside_are_brought_in() {
    let path = ArcLength::new(NurbsCurve::line([0.0], [2.0]).expect("line"), 1e-12).expect("table");
    assert_eq!(
        (path.parameter_at(-1.0), path.parameter_at(f64::NAN), path.parameter_at(9.0)),
        (0.0, 0.0, 1.0)
    );
    assert_eq!((path.length_at(-1.0), path.length_at(f64::NAN), path.length_at(9.0)), (0.0, 0.0, 2.0));
    for tolerance in [0.0, -1.0, f64::NAN] {
        let refused = ArcLength::new(path.curve().clone(), tolerance);
        assert!(matches!(refused, Err(NurbsError::Tolerance(t)) if t.to_bits() == tolerance.to_bits()));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    /// Chords are shorter, control polygons are longer, and both come closer by a quarter with every halving.
    #[test]
    fn the_length_lies_between_chords_and_polygon(curve in a_curve::<3>()) {
        let (length, error) = curve.length(1e-12 * size(&curve).max(1e-300))?;
        prop_assert!(error <= 1e-9 * size(&curve), "bound {}", error / size(&curve));
        let fine = curve.refined(&(1..128).map(|k| at(&curve, f64::from(k) / 128.0)).collect::<Vec<_>>())?;
        // As many roundings as there are points.
        let rounding = 8.0 * 150.0 * f64::EPSILON * size(&curve);
        let polygon = fine.polygon_length();
        prop_assert!(polygon >= length - error - rounding, "{} below {} - {} - {}", polygon, length, error, rounding);
        let chords: f64 = (0..4096)
            .map(|k| {
                let place = |k: u32| curve.point(at(&curve, f64::from(k) / 4096.0));
                distance(&place(k), &place(k + 1))
            })
            .sum();
        prop_assert!(chords <= length + error + 4096.0 * f64::EPSILON * size(&curve));
        // Where weights make a curve fast for a moment, chords cut a bend.
        prop_assert!(length - chords <= 0.1 * length, "{} of {}", chords, length);
    }

    /// A loose tolerance is met too, and its bound holds.
    #[test]
    fn the_bound_of_a_loose_tolerance_holds(curve in a_curve::<2>(), digits in 1..9_i32) {
        let (length, error) = curve.length(1e-13 * size(&curve))?;
        let tolerance = 10.0_f64.powi(-digits) * size(&curve);
        let (rough, bound) = curve.length(tolerance)?;
        prop_assert!(bound <= tolerance + error, "{} above {}", bound, tolerance);
        prop_assert!((rough - length).abs() <= bound + error);
    }

    /// On the way too, whatever the weights.
    #[test]
    fn the_bound_holds_on_the_way(
        curve in a_light_curve::<2>(), digits in 0..9_i32, places in prop::array::uniform8(0.0..1.0)
    ) {
        let fine = ArcLength::new(curve.clone(), 1e-13 * size(&curve))?;
        let tolerance = if digits > 0 { 10.0_f64.powi(-digits) * size(&curve) } else { f64::INFINITY };
        let rough = ArcLength::new(curve.clone(), tolerance)?;
        for place in places {
            let u = at(&curve, place);
            let (length, wanted) = (rough.length_at(u), fine.length_at(u));
            prop_assert!((0.0..=rough.length()).contains(&length));
            let allowed = rough.error_bound() + fine.error_bound();
            prop_assert!((length - wanted).abs() <= allowed, "{} for {}, allowed {}", length, wanted, allowed);
        }
    }

    #[test]
    fn the_inverse_undoes_it(curve in a_curve::<3>(), place in 0.0..=1.0) {
        let path = ArcLength::new(curve, 1e-12 * 1e-6)?;
        let curve = path.curve();
        let s = place * path.length();
        let u = path.parameter_at(s);
        let domain = curve.domain();
        prop_assert!(domain.contains(u));
        // The parameter is known to a rounding, which is a length at the speed there.
        let speed = norm(&curve.derivatives::<2>(u)[1]);
        let allowed = 8.0 * f64::EPSILON * (path.length() + speed * domain.magnitude().max(1.0));
        prop_assert!((path.length_at(u) - s).abs() <= allowed, "{} instead of {}", path.length_at(u), s);
        // And by the part of the curve, which has another table, and ends up to 16 roundings away, in a knot.
        if u - domain.lower > 1e-6 {
            let (part, bound) = curve.part(domain.lower, u)?.length(1e-12 * size(curve))?;
            let cut = 256.0 * f64::EPSILON * size(curve) * unevenness(curve);
            let total = bound + path.error_bound() + 3.0 * allowed + cut;
            prop_assert!((part - s).abs() <= total, "{} instead of {}, allowed {}", part, s, total);
        }
    }
}

#[test]
fn steps_of_equal_length_on_a_curve_with_a_cusp() {
    let cusp =
        NurbsCurve::bezier(&[[1.0, -1.0], [-1.0 / 3.0, 1.0], [-1.0 / 3.0, -1.0], [1.0, 1.0]]).expect("cusp");
    let path = ArcLength::new(cusp, 1e-12).expect("table");
    let half = 0.5 * path.length();
    for k in 0..=1000 {
        let s = f64::from(k) / 1000.0 * path.length();
        let t = 2.0 * path.parameter_at(s) - 1.0;
        // s = (sign t) ((4 + 9 t^2)^(3/2) - 8) / 27 about the cusp.
        let expected = half + ((4.0 + 9.0 * t * t).powf(1.5) - 8.0) / 27.0 * t.signum();
        assert!((s - expected).abs() <= 1e-12 + 64.0 * f64::EPSILON, "{s} and {expected}");
    }
}

#[test]
fn derivatives_by_length_are_those_of_the_inverse() {
    let points = [[0.0, 0.0, 0.0], [1.0, 2.0, 0.5], [3.0, -1.0, 2.0], [4.0, 1.0, -1.0], [5.0, 3.0, 1.0]];
    let knots = Knots::clamped(3, 0.0, &[0.4], 1.0).expect("knots");
    let curve = NurbsCurve::with_knots(knots, &points, &[1.0, 2.0, 0.7, 1.5, 1.0]).expect("curve");
    let path = ArcLength::new(curve, 1e-13).expect("table");
    for s in [1.0, 3.0, 6.0] {
        let at = |s: f64| path.curve().by_length(path.parameter_at(s), Side::After).expect("regular");
        let (early, here, late) = (at(s - 1e-5), at(s), at(s + 1e-5));
        for order in 0..3 {
            for axis in 0..3 {
                let quotient = (late[order][axis] - early[order][axis]) / 2e-5;
                // h^2 / 6 of a fifth derivative by length of up to a few hundred, and roundings of 1e-15 over h.
                assert!((quotient - here[order + 1][axis]).abs() <= 1e-7, "order {order}, axis {axis}");
            }
        }
        assert!((norm(&here[1]) - 1.0).abs() <= 1e-15 * 4.0);
    }
}
