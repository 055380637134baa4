//! Operations that leave the curve as it is.

use profiles::nurbs::{Knots, MAX_DEGREE, NurbsCurve, NurbsError};
use proptest::prelude::*;

use crate::curves::{CASES, a_curve, are_the_same, at, distance, size};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    #[test]
    fn insertion_leaves_the_curve(curve in a_curve::<3>(), places in prop::collection::vec(0.01..0.99, 1..6)) {
        let knots: Vec<f64> = places.iter().map(|place| at(&curve, *place)).collect();
        let refined = curve.refined(&knots)?;
        prop_assert_eq!(refined.knots().points(), curve.knots().points() + knots.len());
        are_the_same(&curve, &refined, 48.0 * curve.degree() as f64)?;
    }

    /// What was inserted goes without a trace, anywhere and at knots that were there already.
    #[test]
    fn removal_undoes_insertion(curve in a_curve::<3>(), place in 0.02..0.98, knot in 0..6_usize) {
        let inner: Vec<(f64, usize)> = curve.knots().distinct().skip(1).collect();
        let repeated = inner[..inner.len() - 1].get(knot).filter(|(_, m)| *m < curve.degree());
        let u = repeated.map_or(at(&curve, place), |(knot, _)| *knot);
        // A tenth of the shortest span away from any knot: solving for the old points magnifies roundings by its inverse.
        let clear = curve.knots().distinct().all(|(knot, _)| knot == u || (knot - u).abs() > 1e-2);
        prop_assume!(clear);
        let more = curve.with_knot(u, 1)?;
        let (less, deviation) = more.without_knot(u, 1e-9 * size(&curve))?;
        prop_assert_eq!(less.knots(), curve.knots());
        prop_assert!(deviation <= 1e-10 * size(&curve), "{}", deviation / size(&curve));
        are_the_same(&curve, &less, 1e5)?;
    }

    /// The bound is one, and no larger than a few times what is found.
    #[test]
    fn a_knot_that_matters_leaves_no_more_than_the_bound(curve in a_curve::<2>()) {
        for (knot, _) in curve.knots().distinct().skip(1).take(curve.knots().distinct().count() - 2) {
            match curve.without_knot(knot, f64::INFINITY) {
                Ok((less, deviation)) => {
                    prop_assert_eq!(less.knots().multiplicity(knot), curve.knots().multiplicity(knot) - 1);
                    let places = (0..=500).map(|k| at(&curve, f64::from(k) / 500.0));
                    let most = places.map(|u| distance(&curve.point(u), &less.point(u))).fold(0.0, f64::max);
                    prop_assert!(most <= deviation + 1e-13 * size(&curve), "{} above {}", most, deviation);
                    let refused = curve.without_knot(knot, 0.5 * deviation);
                    let same = matches!(refused, Err(NurbsError::Removal { deviation: d, .. }) if d == deviation);
                    prop_assert!(same);
                }
                // A weight would not stay positive.
                Err(NurbsError::Removal { deviation, .. }) => prop_assert_eq!(deviation, f64::INFINITY),
                Err(other) => prop_assert!(false, "{}", other),
            }
        }
    }

    /// The certain bound between two curves of different degree and knots: never below a dense sample's.
    #[test]
    fn deviation_is_never_below_samples(curve in a_curve::<3>(), times in 0..3_usize, shift in -1.0..1.0) {
        let raised = curve.raised(times)?;
        let same = curve.deviation(&raised)?;
        prop_assert!(same.bound <= 1e-13 * size(&curve), "{}", same.bound / size(&curve));
        // Another control point in the middle.
        let (knots, mut points) = (raised.knots().clone(), raised.homogeneous_points().to_vec());
        let middle = points.len() / 2;
        points[middle].weighted[0] += shift * size(&curve);
        let other = NurbsCurve::from_homogeneous(knots, points)?;
        let deviation = curve.deviation(&other)?;
        let apart = |u: f64| distance(&curve.point(u), &other.point(u));
        let most = (0..=1000).map(|k| apart(at(&curve, f64::from(k) / 1000.0))).fold(0.0, f64::max);
        let rounding = 1e-13 * size(&curve);
        prop_assert!(deviation.bound >= most - rounding, "{:?} below {}", deviation, most);
        prop_assert!(deviation.bound <= deviation.reached * 1.0011 + rounding, "{:?}", deviation);
        prop_assert!((apart(deviation.parameter) - deviation.reached).abs() <= rounding);
        let back = other.deviation(&curve)?;
        prop_assert!((back.bound - deviation.bound).abs() <= 2e-3 * deviation.bound + rounding);
    }

    #[test]
    fn raising_leaves_the_curve(curve in a_curve::<3>(), times in 1..4_usize) {
        let raised = curve.raised(times)?;
        prop_assert_eq!(raised.degree(), curve.degree() + times);
        let expected: Vec<(f64, usize)> = curve.knots().distinct().map(|(knot, m)| (knot, m + times)).collect();
        prop_assert_eq!(raised.knots().distinct().collect::<Vec<_>>(), expected);
        are_the_same(&curve, &raised, 48.0 * raised.degree() as f64)?;
        prop_assert_eq!((raised.start(), raised.end()), (curve.start(), curve.end()));
    }

    #[test]
    fn decomposition_leaves_the_curve(curve in a_curve::<2>()) {
        let whole = curve.decomposed();
        are_the_same(&curve, &whole, 48.0 * curve.degree() as f64)?;
        let segments = curve.bezier_segments();
        prop_assert_eq!(segments.len(), curve.knots().distinct().count() - 1);
        prop_assert_eq!(segments[0].from, curve.domain().lower);
        prop_assert_eq!(segments[segments.len() - 1].to, curve.domain().upper);
        for pair in segments.windows(2) {
            prop_assert_eq!(pair[0].to, pair[1].from);
            prop_assert_eq!(pair[0].points.last(), pair[1].points.first());
        }
        for segment in &segments {
            let u = 0.5 * (segment.from + segment.to);
            // The middle of a Bezier curve: binomials over a power of two.
            let (mut above, mut below, mut binomial) = ([0.0; 2], 0.0, 1.0);
            for (k, h) in segment.points.iter().enumerate() {
                below += binomial * h.weight;
                above.iter_mut().zip(h.weighted).for_each(|(sum, x)| *sum += binomial * x);
                binomial *= (curve.degree() - k) as f64 / (k + 1) as f64;
            }
            let middle = above.map(|x| x / below);
            prop_assert!(distance(&middle, &curve.point(u)) <= 512.0 * f64::EPSILON * size(&curve));
        }
    }

    #[test]
    fn parts_are_parts(curve in a_curve::<3>(), a in 0.0..1.0, b in 0.0..1.0, place in 0.0..=1.0) {
        let (a, b): (f64, f64) = (f64::min(a, b), f64::max(a, b));
        prop_assume!(b - a > 1e-3);
        let part = curve.part(at(&curve, a), at(&curve, b))?;
        let u = at(&part, place);
        prop_assert!(distance(&part.point(u), &curve.point(u)) <= 16.0 * 8.0 * f64::EPSILON * size(&curve));
        let (left, right) = curve.split(at(&curve, b))?;
        prop_assert_eq!(left.end(), right.start());
        prop_assert_eq!((left.start(), right.end()), (curve.start(), curve.end()));
        // At a knot of the curve too.
        for (knot, _) in curve.knots().distinct().skip(1).take(curve.knots().distinct().count() - 2) {
            let (left, right) = curve.split(knot)?;
            prop_assert_eq!((left.domain().upper, right.domain().lower), (knot, knot));
            for half in [&left, &right] {
                let u = at(half, place);
                prop_assert!(distance(&half.point(u), &curve.point(u)) <= 16.0 * 8.0 * f64::EPSILON * size(&curve));
            }
        }
    }

    #[test]
    fn reversal_and_another_domain(curve in a_curve::<2>(), place in 0.0..=1.0) {
        let back = curve.reversed();
        prop_assert_eq!(back.domain(), curve.domain());
        prop_assert_eq!((back.start(), back.end()), (curve.end(), curve.start()));
        let slow = curve.with_domain(-7.0, 13.0)?;
        prop_assert_eq!(slow.domain(), profiles::Interval::new(-7.0, 13.0));
        // Knots and parameters round; the shortest span is a hundredth.
        let steep = curve.derivatives::<2>(at(&curve, place))[1];
        let rounding = 32.0 * f64::EPSILON * (crate::curves::norm(&steep) * 10.0 + 1e4 * size(&curve));
        prop_assert!(distance(&back.point(at(&back, 1.0 - place)), &curve.point(at(&curve, place))) <= rounding);
        prop_assert!(distance(&slow.point(at(&slow, place)), &curve.point(at(&curve, place))) <= rounding);
    }
}

#[test]
fn a_raised_bezier_curve_has_the_textbook_points() {
    let points = [[0.0, 0.0], [1.0, 3.0], [4.0, -1.0]];
    let raised = NurbsCurve::bezier(&points).and_then(|curve| curve.raised(1)).expect("raised");
    let expected = [[0.0, 0.0], [2.0 / 3.0, 2.0], [2.0, 5.0 / 3.0], [4.0, -1.0]];
    for (one, other) in raised.control_points().zip(expected) {
        assert!(distance(&one, &other) <= 4.0 * f64::EPSILON * 4.0);
    }
    assert!(raised.weights().all(|w| w == 1.0));
}

/// Points and weights that other libraries give for the quarter circle in degree four, printed with 16 digits.
#[test]
fn a_quarter_circle_in_degree_four() {
    let quarter = NurbsCurve::<2>::arc([0.0, 0.0], 1.0, 0.0, std::f64::consts::FRAC_PI_2);
    let raised = quarter.and_then(|arc| arc.raised(2)).expect("raised");
    let points = [
        [1.0, 0.0],
        [1.0, 0.414_213_562_373_095_26],
        [0.792_893_218_813_452_4, 0.792_893_218_813_452_3],
        [0.414_213_562_373_095_2, 1.0],
        [0.0, 1.0],
    ];
    let weights = [1.0, 0.853_553_390_593_274, 0.804_737_854_124_364_6, 0.853_553_390_593_274_2, 1.0];
    assert_eq!(raised.knots(), &Knots::bezier(4, 0.0, 1.0).expect("knots"));
    for ((point, weight), (expected, heavy)) in
        raised.control_points().zip(raised.weights()).zip(points.iter().zip(weights))
    {
        assert!(
            distance(&point, expected) <= 4.0 * f64::EPSILON && (weight - heavy).abs() <= 4.0 * f64::EPSILON
        );
    }
}

#[test]
fn degrees_end_somewhere() {
    let line = NurbsCurve::bezier(&[[0.0], [1.0]]).expect("line");
    let most = line.raised(MAX_DEGREE - 1).expect("raised");
    assert_eq!(most.degree(), 15);
    assert_eq!(most.raised(1), Err(NurbsError::Degree { degree: 16, most: 15 }));
    assert_eq!(most.raised(usize::MAX), Err(NurbsError::Degree { degree: usize::MAX, most: 15 }));
}

#[test]
fn removal_spreads_what_it_misses() {
    // Degree 1: the middle point of three goes, a corner of height 1 is missed by the whole height at one point.
    let corner = NurbsCurve::polyline(&[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]).expect("lines");
    let (line, deviation) = corner.without_knot(0.5, 2.0).expect("removed");
    assert_eq!(line.control_points().collect::<Vec<_>>(), [[0.0, 0.0], [2.0, 0.0]]);
    assert!((deviation - 1.0).abs() <= 4.0 * f64::EPSILON);
    // Degree 2 with one inner knot, all shares a half: l = (1, -1), so that each inner point moves by half of what is
    // missed, P1 - P2 - (P0 - P3) / 2.
    let points = [[0.0], [1.0], [5.0], [6.0]];
    let curve = NurbsCurve::uniform(2, &points).expect("curve");
    let (less, deviation) = curve.without_knot(0.5, 9.0).expect("removed");
    assert!((deviation - 0.5).abs() <= 8.0 * f64::EPSILON, "{deviation}");
    assert!((less.homogeneous_points()[1].point()[0] - 3.0).abs() <= 8.0 * f64::EPSILON);
}
