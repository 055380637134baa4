//! Conics, tangents, curvature, torsion and corners.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use profiles::nurbs::{Knots, NurbsCurve, NurbsError, Side};
use proptest::prelude::*;

use crate::curves::{CASES, a_curve, at, distance, norm, size};

#[test]
fn arcs_lie_on_their_circle() {
    for sweep in [1e-6, 0.1, FRAC_PI_2, 2.0, -PI, 4.0, -TAU, TAU, 20.0] {
        let (center, radius, start) = ([100.0, -30.0], 7.0, 0.9);
        let arc = NurbsCurve::<2>::arc(center, radius, start, sweep).expect("arc");
        let allowed = 8.0 * f64::EPSILON * 100.0;
        for k in 0..=1000 {
            let [x, y] = arc.point(f64::from(k) / 1000.0);
            assert!(((x - center[0]).hypot(y - center[1]) - radius).abs() <= allowed);
            let curvature = arc.signed_curvature(f64::from(k) / 1000.0, Side::After).expect("regular");
            // Derivatives of a short arc are differences of coordinates.
            let rounding = 1e-12 * (1.0 + 100.0 / (radius * sweep.abs()).powi(2));
            assert!((curvature - sweep.signum() / radius).abs() <= rounding, "{curvature} for {sweep}");
        }
        let ends =
            [start, start + sweep].map(|a| [center[0] + radius * a.cos(), center[1] + radius * a.sin()]);
        assert!(distance(&arc.start(), &ends[0]) <= allowed && distance(&arc.end(), &ends[1]) <= allowed);
        // Pieces of a quarter at most, and no corner.
        let pieces = arc.knots().distinct().count() - 1;
        assert_eq!(pieces, (sweep.abs() / FRAC_PI_2 - 1e-9).ceil().max(1.0) as usize);
        assert!(arc.corners(1e-6).is_empty());
    }
    let circle = NurbsCurve::<2>::circle([0.1, 0.2], 3.0).expect("circle");
    assert_eq!(circle.start(), circle.end());
}

#[test]
fn arcs_in_space_turn_about_their_axis() {
    let (center, start, axis) = ([1.0, 2.0, 3.0], [4.0, 2.0, 5.0], [0.0, 0.0, 2.0]);
    let arc = NurbsCurve::<3>::arc(center, start, axis, FRAC_PI_2).expect("arc");
    assert!(distance(&arc.start(), &start) <= 1e-14 && distance(&arc.end(), &[1.0, 5.0, 5.0]) <= 1e-14);
    for k in 0..=100 {
        let [x, y, z] = arc.point(f64::from(k) / 100.0);
        assert!(((x - 1.0).hypot(y - 2.0) - 3.0).abs() <= 1e-14 && (z - 5.0).abs() <= 1e-14);
    }
    assert!((arc.curvature(0.3, Side::After).expect("regular") - 1.0 / 3.0).abs() <= 1e-14);
    assert!(arc.torsion(0.3, Side::After).expect("regular").abs() <= 1e-13);
    let circle = NurbsCurve::<3>::circle(center, start, [1.0, 1.0, 1.0]).expect("circle");
    assert_eq!(circle.start(), circle.end());
}

#[test]
fn what_is_no_arc_is_refused() {
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = NurbsCurve::<2>::circle([0.0, 0.0], radius);
        assert!(matches!(refused, Err(NurbsError::Radius(r)) if r.to_bits() == radius.to_bits()));
    }
    for sweep in [0.0, f64::NAN, f64::INFINITY, 1e5] {
        let refused = NurbsCurve::<2>::arc([0.0, 0.0], 1.0, 0.0, sweep);
        assert!(matches!(refused, Err(NurbsError::Sweep(s)) if s.to_bits() == sweep.to_bits()));
    }
    let along = NurbsCurve::<3>::circle([0.0; 3], [0.0, 0.0, 2.0], [0.0, 0.0, 1.0]);
    assert_eq!(along, Err(NurbsError::Plane(0.0)));
    assert_eq!(NurbsCurve::<3>::circle([0.0; 3], [1.0; 3], [0.0; 3]), Err(NurbsError::Plane(0.0)));
    assert_eq!(NurbsCurve::<3>::circle([1.0; 3], [1.0; 3], [0.0, 0.0, 1.0]), Err(NurbsError::Radius(0.0)));
}

#[test]
fn a_twisted_cubic_has_its_torsion() {
    // (t, t^2, t^3): k^2 = 4 (9 t^4 + 9 t^2 + 1) / (9 t^4 + 4 t^2 + 1)^3, torsion 3 / (9 t^4 + 9 t^2 + 1).
    let points = [[0.0, 0.0, 0.0], [1.0 / 3.0, 0.0, 0.0], [2.0 / 3.0, 1.0 / 3.0, 0.0], [1.0, 1.0, 1.0]];
    let cubic = NurbsCurve::bezier(&points).expect("cubic");
    for t in [0.0_f64, 0.2, 0.5, 1.0] {
        let (a, b) = (9.0 * t.powi(4) + 9.0 * t * t + 1.0, 9.0 * t.powi(4) + 4.0 * t * t + 1.0);
        let (curvature, torsion) = (cubic.curvature(t, Side::After), cubic.torsion(t, Side::After));
        assert!((curvature.expect("regular") - 2.0 * a.sqrt() / b.powf(1.5)).abs() <= 1e-13);
        assert!((torsion.expect("regular") - 3.0 / a).abs() <= 1e-12);
    }
    let line = NurbsCurve::line([0.0; 3], [1.0, 2.0, 3.0]).and_then(|l| l.raised(2)).expect("line");
    assert_eq!(line.torsion(0.4, Side::After), None);
    assert!(line.curvature(0.4, Side::After).expect("regular") <= 1e-14);
}

#[test]
fn tangents_exist_where_the_curve_stands_still() {
    // Two points coincide at the start, three at the end.
    let points = [[0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [2.0, 2.0], [2.0, 2.0], [2.0, 2.0]];
    let curve = NurbsCurve::rational_bezier(&points, &[1.0, 3.0, 0.5, 1.0, 2.0, 1.0]).expect("curve");
    let start = curve.tangent(0.0, Side::After).expect("a direction");
    assert!(distance(&start, &[1.0, 0.0]) <= 1e-14);
    let end = curve.tangent(1.0, Side::After).expect("a direction");
    let half = 0.2_f64.sqrt();
    assert!(distance(&end, &[half, 2.0 * half]) <= 1e-13, "{end:?}");
    for (u, expected) in [(1e-6, start), (1.0 - 1e-5, end)] {
        assert!(distance(&curve.tangent(u, Side::After).expect("regular"), &expected) <= 1e-4);
    }
    assert_eq!(curve.by_length(0.0, Side::After), None);
    assert_eq!(curve.curvature(0.0, Side::After), None);
    assert_eq!(curve.curvature_bound(0.0, 1.0), f64::INFINITY);
    assert_eq!(curve.speed_bounds(0.0, 1.0).lower, 0.0);
    // A cusp turns back.
    let cusp =
        NurbsCurve::bezier(&[[1.0, -1.0], [-1.0 / 3.0, 1.0], [-1.0 / 3.0, -1.0], [1.0, 1.0]]).expect("cusp");
    let (before, after) = (cusp.tangent(0.5, Side::Before), cusp.tangent(0.5, Side::After));
    assert!(distance(&before.expect("a direction"), &[-1.0, 0.0]) <= 1e-14);
    assert!(distance(&after.expect("a direction"), &[1.0, 0.0]) <= 1e-14);
    // A point has no direction.
    let point = NurbsCurve::rational_bezier(&[[0.1, 0.7]; 4], &[1.0, 2.0, 0.3, 1.0]).expect("point");
    assert_eq!(point.tangent(0.3, Side::After), None);
    assert_eq!(point.curvature_bound(0.0, 1.0), f64::INFINITY);
    assert_eq!(point.speed_bounds(0.0, 1.0).lower, 0.0);
    assert!(point.speed_bounds(0.0, 1.0).upper <= 1e-15);
}

#[test]
fn corners_are_where_the_direction_jumps() {
    let lines =
        NurbsCurve::polyline(&[[0.0, 0.0], [4.0, 0.0], [6.0, 0.0], [6.0, 3.0], [6.0, 0.0]]).expect("lines");
    let corners = lines.corners(1e-9);
    let expected = [(0.5, FRAC_PI_2), (0.75, PI)];
    assert_eq!(corners.len(), expected.len());
    for (corner, (parameter, angle)) in corners.iter().zip(expected) {
        assert_eq!(corner.parameter, parameter);
        assert!((corner.angle - angle).abs() <= 4.0 * f64::EPSILON);
    }
    assert_eq!(lines.corners(2.0).len(), 1);
    // The same angle in a rational curve of a higher degree; and none where a full knot is smooth.
    let raised = lines.raised(2).expect("raised");
    assert_eq!(raised.corners(1e-9).len(), 2);
    let smooth =
        NurbsCurve::uniform(3, &[[0.0, 0.0], [1.0, 2.0], [3.0, 1.0], [4.0, 4.0], [6.0, 2.0]]).expect("curve");
    assert!(smooth.decomposed().corners(1e-9).is_empty());
}

#[test]
fn bounds_of_a_parabola() {
    // y = x^2: k = 2 / (1 + 4 x^2)^(3/2), speed sqrt(1 + 4 x^2).
    let parabola = NurbsCurve::bezier(&[[-1.0, 1.0], [0.0, -1.0], [1.0, 1.0]]).expect("parabola");
    for (from, to, nearest, farthest) in [(0.0, 1.0, 0.0, 1.0), (0.6, 0.9, 0.2, 0.8), (0.3, 0.3, -0.4, -0.4)]
    {
        let bound = parabola.curvature_bound(from, to);
        let most = 2.0 / (1.0_f64 + 4.0 * nearest * nearest).powf(1.5);
        assert!(bound >= most * (1.0 - 1e-14) && bound <= most * 1.001, "{bound} and {most}");
        let speeds = parabola.speed_bounds(from, to);
        let (slow, fast) = (speed(nearest), speed(farthest));
        assert!(
            speeds.lower <= slow * (1.0 + 1e-14) && speeds.lower >= slow * 0.999,
            "{speeds:?} and {slow}"
        );
        assert!(
            speeds.upper >= fast * (1.0 - 1e-14) && speeds.upper <= fast * 1.001,
            "{speeds:?} and {fast}"
        );
    }
    fn speed(x: f64) -> f64 {
        // dx/du is 2.
        2.0 * (1.0 + 4.0 * x * x).sqrt()
    }
    let line = NurbsCurve::line([1e3, 2e3], [1.0, 4.0]).and_then(|l| l.raised(4)).expect("line");
    assert!(line.curvature_bound(0.0, 1.0) <= 1e-14);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    #[test]
    fn bounds_hold_and_are_close(curve in a_curve::<3>(), a in 0.0..1.0, b in 0.0..1.0) {
        prop_assume!(f64::abs(b - a) > 1e-3);
        let (from, to) = (at(&curve, f64::min(a, b)), at(&curve, f64::max(a, b)));
        let (bound, speeds) = (curve.curvature_bound(from, to), curve.speed_bounds(from, to));
        let (mut sharpest, mut slowest, mut fastest) = (0.0_f64, f64::INFINITY, 0.0_f64);
        let knots = curve.knots().distinct().map(|(knot, _)| knot).filter(|knot| *knot >= from && *knot <= to);
        let places = (0..=2000).map(|k| from + f64::from(k) / 2000.0 * (to - from));
        for u in places.chain(knots) {
            for side in [Side::Before, Side::After] {
                if (side == Side::Before && u <= from) || (side == Side::After && u >= to) {
                    continue;
                }
                let speed = norm(&curve.derivatives_from::<2>(u, side)[1]);
                (slowest, fastest) = (slowest.min(speed), fastest.max(speed));
                sharpest = curve.curvature(u, side).map_or(sharpest, |k| sharpest.max(k));
            }
        }
        // A straight line of degree one has roundings for a curvature.
        let rounding = 1e-9 * sharpest + 1e-9 / size(&curve);
        prop_assert!(bound >= sharpest - rounding, "{} below {}", bound, sharpest);
        prop_assert!(speeds.lower <= slowest * (1.0 + 1e-9) && speeds.upper >= fastest * (1.0 - 1e-9));
        // Samples miss a little of the fastest place.
        prop_assert!(speeds.upper <= fastest * 1.1, "{:?} and {}", speeds, fastest);
        // An arc stays within its curvature's sagitta of its chord.
        let middle = curve.point(0.5 * (from + to));
        let (start, end) = (curve.point(from), curve.point(to));
        if curve.corners(0.0).is_empty() {
            let (length, error) = curve.part(from, to).map_or(Ok((0.0, 0.0)), |p| p.length(1e-9 * size(&curve)))?;
            let chord = NurbsCurve::line(start, end)?;
            let sagitta = chord.closest(middle)?.distance;
            prop_assert!(sagitta <= bound * (length + error).powi(2) / 8.0 + 1e-12 * size(&curve));
        }
    }

    #[test]
    fn polylines_keep_their_points(points in prop::collection::vec(prop::array::uniform2(-1.0..1.0), 2..20)) {
        let lines = NurbsCurve::polyline(&points)?;
        let length: f64 = points.windows(2).map(|pair| distance(&pair[0], &pair[1])).sum();
        for (knot, point) in lines.knots().distinct().map(|(knot, _)| knot).zip(&points) {
            prop_assert_eq!(lines.point(knot), *point);
        }
        let speeds = lines.speed_bounds(0.0, 1.0);
        prop_assert!((speeds.upper - length).abs() <= 1e-9 * length && (speeds.lower - length).abs() <= 1e-9 * length);
    }
}

#[test]
fn polylines_leave_out_what_has_no_length() {
    let lines = NurbsCurve::polyline(&[[0.0], [0.0], [1.0], [1.0], [3.0], [3.0]]).expect("lines");
    assert_eq!(lines.control_points().collect::<Vec<_>>(), [[0.0], [1.0], [3.0]]);
    assert_eq!(lines.knots(), &Knots::clamped(1, 0.0, &[1.0 / 3.0], 1.0).expect("knots"));
    let point = NurbsCurve::polyline(&[[2.0], [2.0]]);
    assert_eq!(point, Err(NurbsError::PointCount { points: 1, least: 2 }));
    assert!(matches!(
        NurbsCurve::polyline(&[[0.0], [f64::NAN]]),
        Err(NurbsError::Coordinate { index: 1, .. })
    ));
}
