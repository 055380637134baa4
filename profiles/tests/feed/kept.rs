//! Limits hold on any curve, and more of them is never slower.

use profiles::nurbs::{FeedInterpolator, FeedLimits, NurbsCurve};
use profiles::{Cosine, FivePhase, Interval, Limits, Profile, SCurve, SnapLimited};
use proptest::prelude::*;

use crate::checks::{drawing, keeps, limits, spatial};
use crate::curves;

/// Curves per property: each plans and samples a whole motion.
const CASES: u32 = 16;

#[test]
fn a_drawing_with_a_tight_bend_and_a_corner_keeps_every_limit() {
    let feed = FeedInterpolator::new(drawing(), limits(0.1, (0.3, 5.0, 100.0), 1e-6, 1e-3)).expect("feed");
    keeps(&feed);
    // The corner is at a tick, at rest.
    let corner = feed.curve().point(0.5);
    let stop = feed.ticks().expect("clock").skip(1).find(|s| s.along.velocity < 1e-12).expect("a stop");
    assert!(stop.position.iter().zip(corner).all(|(a, b)| (a - b).abs() < 1e-15));
    assert!(stop.along.position < feed.length());
}

#[test]
fn every_law_keeps_every_limit_in_space() {
    let limits: FeedLimits<3> = limits(0.15, (0.12, 3.0, 150.0), 2e-6, 1e-3);
    let axes = limits.axes().map(|axis| axis.with_snap(2e4).expect("snap"));
    let snappy =
        FeedLimits::new(limits.feed(), axes, 1e-3).and_then(|l| l.with_chord_error(2e-6)).expect("limits");
    let scurve = FeedInterpolator::<3, SCurve>::with_law(spatial(), limits).expect("feed");
    let snap = FeedInterpolator::<3, SnapLimited>::with_law(spatial(), snappy).expect("feed");
    let cosine = FeedInterpolator::<3, Cosine>::with_law(spatial(), limits).expect("feed");
    let five = FeedInterpolator::<3, FivePhase>::with_law(spatial(), limits).expect("feed");
    println!("{} {} {} {}", scurve.duration(), snap.duration(), cosine.duration(), five.duration());
    keeps(&scurve);
    keeps(&snap);
    keeps(&cosine);
    keeps(&five);
    // No law is slower than another by more than a few percent; the derivative of the jerk is bounded by the law that has it.
    for other in [snap.duration(), cosine.duration(), five.duration()] {
        assert!((scurve.duration() / other - 1.0).abs() < 0.03, "{other}");
    }
    assert!(snap.feed().extrema().snap.magnitude() <= 2e4 * (1.0 + 1e-12));
}

/// Any curve with limits that are felt: the time that the feed would take is up to thousands of periods.
fn a_task() -> impl Strategy<Value = (NurbsCurve<2>, FeedLimits<2>)> {
    let ratio = || (-1.0..1.0).prop_map(|x: f64| 8.0_f64.powf(x));
    let ratios = (ratio(), ratio(), ratio(), ratio(), ratio(), ratio());
    (curves::a_curve::<2>(), -3..=3_i32, 50.0..400.0, ratios).prop_map(|(curve, time, ticks, ratios)| {
        let (v, a, j, other, back, chord) = ratios;
        let (length, period) = (curve.polygon_length(), 10.0_f64.powi(time));
        let feed = length / (ticks * period);
        let ramp = 20.0 * period;
        let axis = |factor: f64| {
            let (v, a, j) = (v * feed, factor * a * feed / ramp, factor * j * feed / (ramp * ramp));
            Limits::new(v, a, j).and_then(|l| l.with_deceleration(a * back.max(1.0))).expect("limits")
        };
        let limits = FeedLimits::new(feed, [axis(1.0), axis(other)], period).expect("limits");
        (curve, limits.with_chord_error(1e-3 * chord * length / ticks).expect("chord"))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: CASES, ..ProptestConfig::default() })]

    #[test]
    fn any_curve_keeps_every_limit((curve, limits) in a_task()) {
        keeps(&FeedInterpolator::new(curve, limits).expect("feed"));
    }
}

/// Every limit but the command times the factors.
fn scaled(limits: &FeedLimits<2>, feed: f64, v: f64, a: f64, j: f64, chord: f64) -> FeedLimits<2> {
    let times = |bounds: Interval, factor: f64| Interval::new(bounds.lower * factor, bounds.upper * factor);
    let axes = limits.axes().map(|axis| {
        let axis = axis.with_velocity(times(axis.velocity(), v)).expect("velocity");
        let axis = axis.with_acceleration(times(axis.acceleration(), a)).expect("acceleration");
        axis.with_jerk(times(axis.jerk(), j)).expect("jerk")
    });
    let scaled = FeedLimits::new(limits.feed() * feed, axes, limits.period()).expect("limits");
    scaled.with_chord_error(limits.chord_error() * chord).expect("chord error")
}

proptest! {
    #![proptest_config(ProptestConfig { cases: CASES, ..ProptestConfig::default() })]

    #[test]
    fn more_of_a_limit_costs_no_time_but_that_of_the_grid((curve, limits) in a_task()) {
        let duration = |limits| FeedInterpolator::new(curve.clone(), limits).expect("feed").duration();
        let before = duration(limits);
        for (feed, v, a, j, chord) in [
            (2.0, 2.0, 2.0, 2.0, 2.0),
            (2.0, 1.0, 1.0, 1.0, 1.0),
            (1.0, 2.0, 1.0, 1.0, 1.0),
            (1.0, 1.0, 2.0, 1.0, 1.0),
            (1.0, 1.0, 1.0, 2.0, 1.0),
            (1.0, 1.0, 1.0, 1.0, 2.0),
        ] {
            let after = duration(scaled(&limits, feed, v, a, j, chord));
            println!("{:.5}", after / before);
            // The search is one of a grid of places and speeds, which move with the caps: 6 % in 600 pairs.
            prop_assert!(after <= 1.1 * before, "{feed} {v} {a} {j} {chord}: {}", after / before);
        }
    }
}
