//! What cannot be is refused, with the number that is wrong.

use profiles::nurbs::{Homogeneous, Knots, NurbsCurve, NurbsError};

const POINTS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 2.0], [3.0, 2.0], [4.0, 0.0]];

fn knots(all: &[f64]) -> Result<Knots, NurbsError> {
    Knots::new(2, all.to_vec())
}

#[test]
fn knots_that_cannot_be() {
    let good = [0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0];
    assert!(knots(&good).is_ok());
    for degree in [0, 16, usize::MAX] {
        let refused = Knots::new(degree, good.to_vec());
        assert_eq!(refused, Err(NurbsError::Degree { degree, most: 15 }));
        assert_eq!(Knots::uniform(degree, 5), Err(NurbsError::Degree { degree, most: 15 }));
    }
    assert_eq!(knots(&good[..5]), Err(NurbsError::KnotCount { knots: 5, needed: 6 }));
    assert_eq!(knots(&[]), Err(NurbsError::KnotCount { knots: 0, needed: 6 }));
    for (index, value) in [(0, f64::NEG_INFINITY), (3, f64::NAN), (6, f64::INFINITY), (4, 0.5), (6, 1e31)] {
        let mut bad = good;
        bad[index] = value;
        let refused = knots(&bad);
        let same = |v: f64| v.to_bits() == value.to_bits();
        assert!(
            matches!(refused, Err(NurbsError::Knot { index: i, value: v }) if i == index && same(v)),
            "{refused:?}"
        );
    }
    let unclamped = knots(&[0.0, 0.0, 0.5, 1.0, 2.0, 2.0, 2.0]);
    assert_eq!(unclamped, Err(NurbsError::Unclamped { end: "first", multiplicity: 2, needed: 3 }));
    let more = knots(&[0.0, 0.0, 0.0, 2.0, 2.0, 2.0, 2.0]);
    assert_eq!(more, Err(NurbsError::Unclamped { end: "last", multiplicity: 4, needed: 3 }));
    let torn = knots(&[0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
    assert_eq!(torn, Err(NurbsError::Multiplicity { knot: 1.0, multiplicity: 3, most: 2 }));
    assert_eq!(knots(&[1.0; 7]), Err(NurbsError::Domain { lower: 1.0, upper: 1.0 }));
    assert_eq!(Knots::bezier(2, 0.0, 1e-31), Err(NurbsError::Domain { lower: 0.0, upper: 1e-31 }));
    let close = 1.0 + 2.0 * f64::EPSILON;
    let refused = Knots::clamped(2, 0.0, &[1.0, close], 2.0);
    assert_eq!(
        refused,
        Err(NurbsError::KnotGap { index: 4, gap: 2.0 * f64::EPSILON, least: 32.0 * f64::EPSILON })
    );
    assert_eq!(Knots::uniform(3, 3), Err(NurbsError::PointCount { points: 3, least: 4 }));
}

#[test]
fn points_and_weights_that_cannot_be() {
    let knots = Knots::uniform(3, 4).expect("knots");
    let all = knots.as_slice().to_vec();
    assert!(NurbsCurve::new(3, &POINTS, &[1.0, 2.0, 1.0, 1.0], all.clone()).is_ok());
    for (index, value) in [(0, 0.0), (1, -2.0), (2, f64::NAN), (3, f64::INFINITY), (1, 1e-31), (0, -0.0)] {
        let mut weights = [1.0; 4];
        weights[index] = value;
        let refused = NurbsCurve::new(3, &POINTS, &weights, all.clone());
        let same = |v: f64| v.to_bits() == value.to_bits();
        assert!(matches!(refused, Err(NurbsError::Weight { index: i, value: v }) if i == index && same(v)));
    }
    let refused = NurbsCurve::new(3, &POINTS, &[1.0, 1e-16, 1.0, 1.0], all.clone());
    assert_eq!(refused, Err(NurbsError::WeightRatio { index: 1, value: 1e-16, largest: 1.0 }));
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1e76] {
        let mut points = POINTS;
        points[2][1] = value;
        let same = |v: f64| v.to_bits() == value.to_bits();
        for refused in [NurbsCurve::bspline(3, &points, all.clone()), NurbsCurve::bezier(&points)] {
            assert!(
                matches!(refused, Err(NurbsError::Coordinate { index: 2, axis: 1, value: v }) if same(v)),
                "{refused:?}"
            );
        }
        let weighted = points.iter().map(|p| Homogeneous { weighted: *p, weight: 1.0 }).collect();
        let refused = NurbsCurve::from_homogeneous(knots.clone(), weighted);
        assert!(matches!(refused, Err(NurbsError::Coordinate { index: 2, axis: 1, .. })));
    }
    let counts = NurbsCurve::new(3, &POINTS, &[1.0; 3], all.clone());
    assert_eq!(counts, Err(NurbsError::WeightCount { weights: 3, points: 4 }));
    let counts = NurbsCurve::bspline(3, &POINTS[..3], all.clone());
    assert_eq!(counts, Err(NurbsError::PointCount { points: 3, least: 4 }));
    let counts = NurbsCurve::bspline(2, &POINTS, all);
    assert_eq!(counts, Err(NurbsError::KnotCount { knots: 8, needed: 7 }));
    assert_eq!(NurbsCurve::<2>::bezier(&[]), Err(NurbsError::Degree { degree: 0, most: 15 }));
    assert!(matches!(NurbsCurve::bezier(&[[0.0]; 17]), Err(NurbsError::Degree { degree: 16, .. })));
}

#[test]
fn parameters_that_are_not_there() {
    let curve = NurbsCurve::uniform(2, &POINTS).expect("curve");
    let half_a_rounding = f64::EPSILON;
    for value in [0.0, 1.0, -1.0, 2.0, f64::NAN, f64::INFINITY, 1.0 - half_a_rounding] {
        for refused in
            [curve.with_knot(value, 1).err(), curve.split(value).err(), curve.refined(&[0.3, value]).err()]
        {
            assert!(
                matches!(refused, Some(NurbsError::Parameter { lower: 0.0, upper: 1.0, .. })),
                "{refused:?}"
            );
        }
        assert!(matches!(curve.without_knot(value, 1.0), Err(NurbsError::NoKnot(_))));
    }
    // A rounding beside a knot is that knot.
    let twice = curve.with_knot(0.5 + f64::EPSILON, 1).expect("curve");
    assert_eq!(twice.knots().inner(), [0.5, 0.5]);
    let refused = twice.with_knot(0.5, 1);
    assert_eq!(refused, Err(NurbsError::Multiplicity { knot: 0.5, multiplicity: 3, most: 2 }));
    assert!(matches!(twice.with_knot(0.3, usize::MAX), Err(NurbsError::Multiplicity { .. })));
    assert!(matches!(curve.without_knot(0.3, 1.0), Err(NurbsError::NoKnot(u)) if u == 0.3));
    assert!(matches!(curve.without_knot(0.5, f64::NAN), Err(NurbsError::Tolerance(_))));
    assert!(matches!(curve.without_knot(0.5, -1.0), Err(NurbsError::Tolerance(_))));
    assert_eq!(curve.part(0.5, 0.5).err(), Some(NurbsError::Domain { lower: 0.5, upper: 0.5 }));
    assert_eq!(curve.part(0.7, 0.5).err(), Some(NurbsError::Domain { lower: 0.7, upper: 0.5 }));
    assert!(matches!(curve.part(-0.5, 0.5).err(), Some(NurbsError::Parameter { .. })));
    assert!(matches!(curve.part(0.5, f64::NAN).err(), Some(NurbsError::Parameter { .. })));
    assert_eq!(curve.part(0.0, 1.0).expect("all"), curve);
    let longer = curve.with_domain(0.0, 2.0).expect("curve");
    assert_eq!(curve.deviation(&longer), Err(NurbsError::OtherDomain { value: 2.0, expected: 1.0 }));
    assert!(matches!(curve.with_domain(1.0, 0.0).err(), Some(NurbsError::Domain { .. })));
    assert!(matches!(curve.with_domain(f64::NAN, 1.0).err(), Some(NurbsError::Domain { .. })));
    assert!(matches!(curve.with_domain(1e17, 1e17 + 64.0).err(), Some(NurbsError::Domain { .. })));
}

/// Coordinates, weights and knots at the ends of what is allowed: every answer is a number.
#[test]
fn extremes_are_finite() {
    for (size, light, knot) in
        [(1e75, 1e-15, 1e-29), (1e-75, 1e-15, 1e30), (1e75, 1.0, 1e30), (1e-75, 1.0, 1e-29)]
    {
        let points =
            [[size, -size, 0.0], [-size, size, size], [0.0, 0.0, size], [size, size, size], [0.0; 3]];
        let near = 1e-14 * knot;
        let knots = Knots::clamped(3, 0.0, &[near], knot).expect("knots");
        let curve = NurbsCurve::with_knots(knots, &points, &[1.0, light, 1.0, light, 1.0]).expect("curve");
        for place in [0.0, 0.3e-14, 1e-14, 0.2, 0.9, 1.0] {
            let u = place * knot;
            let derivatives = curve.derivatives::<9>(u);
            assert!(
                derivatives.iter().flatten().all(|x| x.is_finite()),
                "{size} {light} {knot} {u}: {derivatives:?}"
            );
            for side in [profiles::nurbs::Side::Before, profiles::nurbs::Side::After] {
                assert!(curve.tangent(u, side).is_none_or(|t| t.iter().all(|x| x.is_finite())));
                assert!(curve.curvature(u, side).is_none_or(f64::is_finite));
                assert!(curve.torsion(u, side).is_none_or(f64::is_finite));
                assert!(curve.by_length(u, side).is_none_or(|d| d.iter().flatten().all(|x| x.is_finite())));
            }
        }
        assert!(!curve.curvature_bound(0.0, knot).is_nan());
        let speeds = curve.speed_bounds(0.0, knot);
        assert!(speeds.lower >= 0.0 && speeds.upper > speeds.lower, "{speeds:?}");
        let (length, bound) = curve.length(1e-9 * size).expect("length");
        assert!(length.is_finite() && bound.is_finite() && length > size, "{length} {bound}");
        let nearest = curve.closest([0.3 * size, 0.1 * size, 0.2 * size]).expect("nearest");
        assert!(nearest.distance.is_finite() && nearest.distance < 2.0 * size);
        assert!(curve.raised(2).is_ok() && curve.split(0.4 * knot).is_ok());
    }
}

#[test]
fn coincident_points_and_repeated_knots_are_a_curve() {
    // Two coincident points, a double and a triple inner knot.
    let knots = Knots::clamped(3, 0.0, &[0.25, 0.25, 0.5, 0.5, 0.5], 1.0).expect("knots");
    let points = [
        [0.0, 0.0],
        [0.0, 0.0],
        [1.0, 2.0],
        [1.0, 2.0],
        [1.0, 2.0],
        [2.0, 0.0],
        [3.0, 0.0],
        [3.0, 0.0],
        [3.0, 1.0],
    ];
    let curve = NurbsCurve::with_knots(knots, &points, &[1.0; 9]).expect("curve");
    for k in 0..=1000 {
        let u = f64::from(k) / 1000.0;
        assert!(curve.derivatives::<5>(u).iter().flatten().all(|x| x.is_finite()));
        assert!(curve.tangent(u, profiles::nurbs::Side::After).is_some());
    }
    let (length, bound) = curve.length(1e-10).expect("length");
    assert!(bound <= 1.1e-10 && length > 5.0_f64.sqrt() + 2.0, "{length} {bound}");
}
