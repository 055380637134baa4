//! Operations that leave the curve as it is.

use profiles::nurbs::{MAX_DEGREE, NurbsCurve, NurbsError};
use proptest::prelude::*;

use crate::curves::{CASES, a_curve, are_the_same, at, distance, size};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    #[test]
    fn insertion_leaves_the_curve(curve in a_curve::<3>(), places in prop::collection::vec(0.01..0.99, 1..6)) {
        let knots: Vec<f64> = places.iter().map(|place| at(&curve, *place)).collect();
        let refined = curve.refined(&knots)?;
        prop_assert_eq!(refined.knots().points(), curve.knots().points() + knots.len());
        are_the_same(&curve, &refined, 16.0 * curve.degree() as f64)?;
    }

    #[test]
    fn raising_leaves_the_curve(curve in a_curve::<3>(), times in 1..4_usize) {
        let raised = curve.raised(times)?;
        prop_assert_eq!(raised.degree(), curve.degree() + times);
        let expected: Vec<(f64, usize)> = curve.knots().distinct().map(|(knot, m)| (knot, m + times)).collect();
        prop_assert_eq!(raised.knots().distinct().collect::<Vec<_>>(), expected);
        are_the_same(&curve, &raised, 16.0 * raised.degree() as f64)?;
        prop_assert_eq!((raised.start(), raised.end()), (curve.start(), curve.end()));
    }

    #[test]
    fn decomposition_leaves_the_curve(curve in a_curve::<2>()) {
        let whole = curve.decomposed();
        are_the_same(&curve, &whole, 16.0 * curve.degree() as f64)?;
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

#[test]
fn degrees_end_somewhere() {
    let line = NurbsCurve::bezier(&[[0.0], [1.0]]).expect("line");
    let most = line.raised(MAX_DEGREE - 1).expect("raised");
    assert_eq!(most.degree(), 15);
    assert_eq!(most.raised(1), Err(NurbsError::Degree { degree: 16, most: 15 }));
    assert_eq!(most.raised(usize::MAX), Err(NurbsError::Degree { degree: usize::MAX, most: 15 }));
}
