//! What is refused, and with which number.

use profiles::nurbs::{FeedError, FeedInterpolator, FeedLimits, NurbsCurve, NurbsError};
use profiles::{Limits, SnapLimited, Trapezoid};

use crate::checks::limits;

fn axis() -> Limits {
    Limits::new(0.3, 4.0, 200.0).expect("limits")
}

fn line() -> NurbsCurve<2> {
    NurbsCurve::line([0.0, 0.0], [0.1, 0.05]).expect("line")
}

#[test]
fn limits_that_cannot_be_carry_their_number() {
    for bad in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        let same = |number: f64| number.to_bits() == bad.to_bits();
        assert!(
            matches!(FeedLimits::new(bad, [axis(); 2], 1e-3), Err(FeedError::Feed(number)) if same(number))
        );
        assert!(
            matches!(FeedLimits::new(0.1, [axis(); 2], bad), Err(FeedError::Period(number)) if same(number))
        );
        let chord = FeedLimits::new(0.1, [axis(); 2], 1e-3).expect("limits").with_chord_error(bad);
        // Infinity is no limit.
        match chord {
            Ok(limits) => assert!(bad > 0.0 && limits.chord_error() == f64::INFINITY),
            Err(FeedError::ChordError(number)) => assert!(same(number)),
            Err(other) => panic!("{other}"),
        }
    }
}

#[test]
fn a_curve_without_length_is_no_way_to_go() {
    let limits = limits::<2>(0.1, (0.3, 4.0, 200.0), 1e-6, 1e-3);
    for point in [[0.0, 0.0], [0.03, -7.0], [1e70, 1e70]] {
        let still = NurbsCurve::bezier(&[point; 4]).expect("curve");
        let refused = FeedInterpolator::new(still, limits).expect_err("no length");
        assert_eq!(refused, FeedError::Length(0.0));
        assert!(refused.to_string().starts_with("the curve is 0 m long"), "{refused}");
    }
    // Two points in one are a part without length, which is left out.
    let halting = NurbsCurve::bspline(
        1,
        &[[0.0, 0.0], [0.1, 0.0], [0.1, 0.0], [0.2, 0.0]],
        vec![0.0, 0.0, 1.0, 2.0, 3.0, 3.0],
    );
    let feed = FeedInterpolator::new(halting.expect("curve"), limits).expect("feed");
    assert!((feed.length() - 0.2).abs() < 1e-15);
    crate::checks::keeps(&feed);
    // A curve needs more points than its degree.
    let one = NurbsCurve::bspline(1, &[[0.0, 0.0]], vec![0.0, 0.0, 1.0]).expect_err("one point");
    assert_eq!(one, NurbsError::PointCount { points: 1, least: 2 });
}

#[test]
fn laws_that_do_not_fit_the_limits_are_named() {
    let limits = limits::<2>(0.1, (0.3, 4.0, 200.0), 1e-6, 1e-3);
    let jumps = FeedInterpolator::<2, Trapezoid>::with_law(line(), limits).expect_err("jerk");
    assert_eq!(jumps, FeedError::Jumps { axis: 0, limit: 200.0 });
    let only_y = [Limits::new(0.3, 4.0, f64::INFINITY).expect("limits"), axis()];
    let only_y = FeedLimits::new(0.1, only_y, 1e-3).expect("limits");
    let jumps = FeedInterpolator::<2, Trapezoid>::with_law(line(), only_y).expect_err("jerk");
    assert_eq!(jumps, FeedError::Jumps { axis: 1, limit: 200.0 });
    let unlimited = FeedInterpolator::<2, SnapLimited>::with_law(line(), limits).expect_err("snap");
    assert!(matches!(unlimited, FeedError::Plan(_)), "{unlimited}");
}

#[test]
fn more_ticks_than_can_be_counted_are_refused() {
    let limits = limits::<2>(0.1, (0.3, 4.0, 200.0), f64::INFINITY, 1e-18);
    let refused = FeedInterpolator::new(line(), limits).expect_err("too many");
    assert!(matches!(refused, FeedError::Clock(_)), "{refused}");
}
