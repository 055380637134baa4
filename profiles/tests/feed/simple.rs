//! Curves whose feed is known by hand.

use profiles::nurbs::{FeedInterpolator, FeedLaw, FeedLimits, Homogeneous, Knots, NurbsCurve};
use profiles::{Cosine, FivePhase, Limits, SCurve, SnapLimited, Trapezoid};

use crate::checks::{chord_error, keeps, limits};

/// On a straight line at an angle the feed is the move of one axis whose limits are those of the nearer one, stretched
/// by the angle.
fn is_the_move_of_one_axis<L: FeedLaw>(axis: Limits, alone: &Limits, plan: fn(f64, &Limits) -> L) {
    for (direction, length) in
        [([1.0, 0.0], 0.1), ([0.0, -1.0], 0.1), ([0.6, -0.8], 0.1), ([0.8, 0.6], 0.002)]
    {
        let end = direction.map(|x| x * length);
        let line = NurbsCurve::bezier(&[[0.0, 0.0], end]).expect("line");
        let steepest = direction.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        // Times a factor that divides every limit but the velocity, which the command bounds.
        let (a, j, s) = (alone.acceleration().upper, alone.jerk().upper, alone.snap());
        let along =
            Limits::new(0.2, a / steepest, j / steepest).and_then(|l| l.with_snap(s)).expect("limits");
        let alone = plan(length, &along);
        let feed = FeedLimits::new(0.2, [axis; 2], 1e-3).expect("limits");
        let feed = FeedInterpolator::<2, L>::with_law(line, feed).expect("feed");
        assert!(feed.duration() >= alone.duration() * (1.0 - 1e-14));
        assert!(
            feed.duration() < alone.duration() + 1.001e-3,
            "{} {} {}",
            std::any::type_name::<L>(),
            feed.duration(),
            alone.duration()
        );
        for sample in feed.ticks().expect("clock") {
            let wanted = alone.sample(sample.time);
            // Roundings of the length, of the speed and of what they become with the time.
            assert!((sample.along.position - wanted.position).abs() <= 64.0 * f64::EPSILON * length);
            for (x, d) in sample.position.iter().zip(direction) {
                assert!((x - d * wanted.position).abs() <= 64.0 * f64::EPSILON * length);
            }
            for (v, d) in sample.velocity.iter().zip(direction) {
                assert!((v - d * wanted.velocity).abs() <= 256.0 * f64::EPSILON * 0.2);
            }
        }
        keeps(&feed);
    }
}

#[test]
fn a_straight_line_is_the_move_of_one_axis() {
    let axis = Limits::new(0.3, 4.0, 200.0).and_then(|l| l.with_snap(12_500.0)).expect("limits");
    is_the_move_of_one_axis(axis, &axis, |h, l| SCurve::rest_to_rest(h, l).expect("plan"));
    is_the_move_of_one_axis(axis, &axis, |h, l| SnapLimited::rest_to_rest(h, l).expect("plan"));
    is_the_move_of_one_axis(axis, &axis, |h, l| FivePhase::rest_to_rest(h, l).expect("plan"));
    is_the_move_of_one_axis(axis, &axis, |h, l| Cosine::rest_to_rest(h, l).expect("plan"));
    let jumping = Limits::new(0.3, 4.0, f64::INFINITY).expect("limits");
    is_the_move_of_one_axis(jumping, &jumping, |h, l| Trapezoid::rest_to_rest(h, l).expect("plan"));
}

#[test]
fn a_circle_at_the_command_has_the_chord_error_of_its_steps() {
    let (radius, feed, period) = (0.02_f64, 0.1, 1e-3);
    let circle = NurbsCurve::<2>::circle([0.01, -0.03], radius).expect("circle");
    let feed = FeedInterpolator::new(circle, limits(feed, (0.3, 5.0, 400.0), 1e-6, period)).expect("feed");
    keeps(&feed);
    // At the command a step is the angle v T / r: the chord is r (1 - cos(v T / 2 r)) away, at most.
    let exact = radius * (1.0 - (0.5 * 0.1 * period / radius).cos());
    let report = feed.report().expect("clock");
    assert!(exact < 1e-6 && (chord_error(&feed) - exact).abs() < 1e-3 * exact);
    // The bound is one of the curvature too.
    assert!(report.chord_error.value >= exact && report.chord_error.value < 1.01 * exact);
    assert_eq!(report.feed.value, 0.1);
    let cruising =
        feed.ticks().expect("clock").filter(|s| s.along.acceleration == 0.0 && s.along.velocity > 0.0);
    let mut count = 0;
    for sample in cruising {
        count += 1;
        let (x, y) = (sample.position[0] - 0.01, sample.position[1] + 0.03);
        assert!((x.hypot(y) - radius).abs() < 8.0 * f64::EPSILON * radius);
        let pull = sample.acceleration[0].hypot(sample.acceleration[1]);
        assert!((pull - 0.01 / radius).abs() < 1e-12 * pull);
    }
    // More than nine tenths of the way.
    assert!(f64::from(count) * 0.1 * period > 0.9 * feed.length());
}

#[test]
fn a_small_circle_is_run_as_fast_as_the_chord_error_allows() {
    let (radius, period, allowed) = (1e-3_f64, 2e-3, 1e-6);
    let circle = NurbsCurve::<2>::circle([0.0, 0.0], radius).expect("circle");
    let feed = FeedInterpolator::new(circle, limits(0.2, (1.0, 50.0, 1e5), allowed, period)).expect("feed");
    keeps(&feed);
    // kappa l^2 / 8 is the chord error of an arc to a part of (l / 4 r)^2 / 3.
    let by_chord = (8.0 * allowed * radius).sqrt() / period;
    let report = feed.report().expect("clock");
    assert!(report.feed.value <= by_chord && report.feed.value > 0.995 * by_chord, "{report:?}");
    assert!(report.at_limit > 0.8);
}

#[test]
fn two_points_in_one_at_the_end_of_a_span_are_no_reason_to_creep() {
    // The curve runs straight to its second and third control points, which are one but for a rounding, and stands still
    // there by the parameter: its derivatives along the arc are roundings over next to nothing.
    let knot = 0.234_556_420_951_182_23;
    let inner = [knot, knot, 0.585_587_129_683_518, 0.621_810_997_733_010_1, 0.851_053_991_061_571_6];
    let points = [
        ([0.222_497_834_183_383_3, 0.542_175_340_789_142_4], 1.147_905_917_475_677_6),
        ([1.202_242_060_689_299_8, 1.577_359_824_762_455_2], 2.035_970_894_492_041_6),
        ([2.205_403_161_442_141_4, 2.893_522_409_512_470_5], 3.734_802_494_551_334),
        ([-0.165_088_336_678_513_55, -0.200_661_636_551_753_04], 0.239_320_071_656_624_72),
        ([0.787_578_478_669_228_9, 0.590_889_877_810_908_1], 0.816_174_884_420_551_3),
        ([-0.507_484_621_885_914_4, -0.527_691_092_066_796], 1.044_852_739_334_932_7),
        ([-0.434_783_736_841_836_24, -0.452_095_482_330_750_53], 0.895_169_939_876_414_7),
        ([0.402_059_052_410_789_26, -0.366_106_250_510_038_8], 0.737_452_418_163_441_3),
    ];
    let points = points.map(|(weighted, weight)| Homogeneous { weighted, weight });
    let knots = Knots::clamped(2, 0.0, &inner, 1.0).expect("knots");
    let curve = NurbsCurve::from_homogeneous(knots, points.to_vec()).expect("curve");
    let feed = FeedInterpolator::new(curve, limits(5.0, (10.0, 60.0, 300.0), 5e-3, 1e-2)).expect("feed");
    println!("{} s for {} m", feed.duration(), feed.length());
    // From stop to stop each of its parts takes a second or two.
    assert!(feed.duration() < 10.0, "{} s for {} m", feed.duration(), feed.length());
    keeps(&feed);
}
