//! Curves to feed along, and what every feed must keep.

use profiles::nurbs::{FeedInterpolator, FeedLaw, FeedLimits, Knots, NurbsCurve};
use profiles::{Interval, Limits};

/// Samples between two ticks.
const DENSE: u32 = 16;

/// A drawing of 0.1 m with wide bows, a bend of a radius of a few micrometres and a corner at the knot 0.5.
pub(crate) fn drawing() -> NurbsCurve<2> {
    let points = [
        [0.000, 0.000],
        [0.030, 0.040],
        [0.060, 0.035],
        [0.0702, -0.020],
        [0.0704, -0.020],
        [0.075, 0.030],
        [0.100, 0.030],
        [0.095, 0.055],
        [0.060, 0.050],
        [0.055, 0.080],
        [0.040, 0.045],
        [0.010, 0.070],
        [-0.010, 0.030],
        [0.000, 0.000],
    ];
    let weights = [1.0, 1.0, 0.7, 3.0, 3.0, 1.0, 0.5, 1.0, 2.0, 1.0, 1.0, 0.8, 1.2, 1.0];
    let inner = [0.1, 0.2, 0.3, 0.4, 0.5, 0.5, 0.5, 0.7, 0.8, 0.9];
    let knots = Knots::clamped(3, 0.0, &inner, 1.0).expect("knots");
    NurbsCurve::with_knots(knots, &points, &weights).expect("curve")
}

/// A way in space with an S and a loop.
pub(crate) fn spatial() -> NurbsCurve<3> {
    let points = [
        [0.00, 0.00, 0.00],
        [0.05, 0.00, 0.02],
        [0.05, 0.05, 0.04],
        [0.00, 0.05, 0.00],
        [0.02, -0.03, -0.03],
        [0.07, 0.02, 0.01],
        [0.09, 0.06, 0.05],
    ];
    NurbsCurve::uniform(4, &points).expect("curve")
}

/// Symmetric limits that are the same for every axis.
pub(crate) fn limits<const D: usize>(
    feed: f64,
    axis: (f64, f64, f64),
    chord_error: f64,
    period: f64,
) -> FeedLimits<D> {
    let (velocity, acceleration, jerk) = axis;
    let axis = Limits::new(velocity, acceleration, jerk).expect("limits");
    let limits = FeedLimits::new(feed, [axis; D], period).expect("limits");
    limits.with_chord_error(chord_error).expect("chord error")
}

/// The largest part of each limit that is used anywhere: feed, and velocity, acceleration and jerk of any axis; sampled
/// sixteen times a tick.
pub(crate) fn used<const D: usize, L: FeedLaw>(feed: &FeedInterpolator<D, L>) -> [f64; 4] {
    let limits = feed.limits();
    let part = |value: f64, bounds: Interval| (value / bounds.upper).max(value / bounds.lower);
    let mut used = [0.0_f64; 4];
    let step = limits.period() / f64::from(DENSE);
    for k in 0..=feed.last_tick() * u64::from(DENSE) {
        let sample = feed.sample(k as f64 * step);
        used[0] = used[0].max(sample.along.velocity / limits.feed());
        for (axis, bounds) in limits.axes().iter().enumerate() {
            used[1] = used[1].max(part(sample.velocity[axis], bounds.velocity()));
            used[2] = used[2].max(part(sample.acceleration[axis], bounds.acceleration()));
            used[3] = used[3].max(part(sample.jerk[axis], bounds.jerk()));
        }
    }
    used
}

/// The largest distance of the curve from the straight line between two ticks, over all ticks: 32 points a step.
pub(crate) fn chord_error<const D: usize, L: FeedLaw>(feed: &FeedInterpolator<D, L>) -> f64 {
    let ticks: Vec<_> = feed.ticks().expect("clock").collect();
    let mut worst = 0.0_f64;
    for pair in ticks.windows(2) {
        let (a, b) = (pair[0].position, pair[1].position);
        let (u0, u1) = (pair[0].parameter, pair[1].parameter);
        for k in 1..32 {
            let point = feed.curve().point(u0 + (u1 - u0) * f64::from(k) / 32.0);
            worst = worst.max(from_segment(&point, &a, &b));
        }
    }
    worst
}

/// Distance of a point from a straight piece.
fn from_segment<const D: usize>(point: &[f64; D], a: &[f64; D], b: &[f64; D]) -> f64 {
    let dot = |x: &[f64; D], y: &[f64; D]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    let from = |x: &[f64; D]| std::array::from_fn::<f64, D, _>(|k| x[k] - a[k]);
    let (p, d) = (from(point), from(b));
    let square = dot(&d, &d);
    let along = if square > 0.0 { (dot(&p, &d) / square).clamp(0.0, 1.0) } else { 0.0 };
    let rest: [f64; D] = std::array::from_fn(|k| p[k] - along * d[k]);
    dot(&rest, &rest).sqrt()
}

/// Everything that holds for any feed; `roundings` of the size of the curve are allowed for the chord error.
pub(crate) fn keeps<const D: usize, L: FeedLaw>(feed: &FeedInterpolator<D, L>) {
    // A limit is kept up to a part of it that the checks of the plan leave to rounding.
    const SLACK: f64 = 1.0 + 1e-9;
    let [command, velocity, acceleration, jerk] = used(feed);
    assert!(command <= SLACK, "feed {command}");
    assert!(velocity <= SLACK && acceleration <= SLACK && jerk <= SLACK, "{velocity} {acceleration} {jerk}");
    let size = feed.curve().control_points().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let (chord, allowed) = (chord_error(feed), feed.limits().chord_error());
    assert!(chord <= allowed * SLACK + 16.0 * f64::EPSILON * size, "chord error {chord} of {allowed}");

    let report = feed.report().expect("clock");
    assert!(
        report.chord_error.value <= allowed * SLACK
            && chord <= report.chord_error.value * SLACK + 16.0 * f64::EPSILON * size
    );
    assert!(report.fluctuation.value < 1e-9, "fluctuation {:e}", report.fluctuation.value);

    let ticks: Vec<_> = feed.ticks().expect("clock").collect();
    assert_eq!(ticks.len() as u64, feed.last_tick() + 1);
    let (first, last) = (ticks.first().expect("first"), ticks.last().expect("last"));
    assert_eq!((first.position, last.position), (feed.curve().start(), feed.curve().end()));
    // A sine begins at rest but for a rounding.
    assert!(first.along.velocity.abs() <= f64::EPSILON * feed.limits().feed());
    assert_eq!(last.along.velocity, 0.0);
    assert_eq!((last.along.position, last.along.acceleration), (feed.length(), 0.0));
    assert!(ticks.windows(2).all(|pair| pair[0].along.position <= pair[1].along.position));
}
