//! Feeds along curves.
#![cfg(feature = "nurbs")]
use profiles::nurbs::{FeedInterpolator, FeedLimits, NurbsCurve};
use profiles::{Limits, Profile, SCurve};

#[test]
fn a_straight_line_is_the_move_of_one_axis() {
    let axis = Limits::new(0.3, 5.0, 100.0).unwrap();
    let limits = FeedLimits::new(0.1, [axis; 2], 1e-3).unwrap().with_chord_error(1e-6).unwrap();
    let line = NurbsCurve::bezier(&[[0.0, 0.0], [0.1, 0.0]]).unwrap();
    let feed = FeedInterpolator::new(line, limits).unwrap();
    let alone = SCurve::rest_to_rest(0.1, &Limits::new(0.1, 5.0, 100.0).unwrap()).unwrap();
    assert!(feed.duration() >= alone.duration() && feed.duration() < alone.duration() + 1e-3);
    for sample in feed.ticks().unwrap() {
        assert!((sample.position[0] - alone.sample(sample.time).position).abs() < 1e-15);
    }
}
