//! Curves whose feed is known by hand.

use profiles::nurbs::{FeedInterpolator, FeedLaw, FeedLimits, NurbsCurve};
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
