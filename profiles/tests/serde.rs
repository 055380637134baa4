//! What is written reads back, and what could not have been written is refused.
#![cfg(feature = "serde")]

use profiles::{Interval, Limits, Mode, Sample};

#[test]
fn limits_and_modes_read_back() {
    let limits = Limits::new(0.2, 4.0, 200.0)
        .and_then(|l| l.with_snap(12_500.0))
        .and_then(|l| l.with_jerk(Interval::new(-100.0, 200.0)))
        .expect("limits");
    let text = serde_json::to_string(&limits).expect("written");
    assert_eq!(serde_json::from_str::<Limits>(&text).expect("read"), limits);
    let mode = Mode::from_hz(40.0, 0.1).expect("mode");
    let text = serde_json::to_string(&mode).expect("written");
    assert_eq!(serde_json::from_str::<Mode>(&text).expect("read"), mode);
    let sample = Sample { position: 1.0, velocity: 2.0, acceleration: 3.0, jerk: 4.0, snap: 5.0 };
    let text = serde_json::to_string(&sample).expect("written");
    assert_eq!(serde_json::from_str::<Sample>(&text).expect("read"), sample);
}

#[test]
fn unlimited_survives_the_lack_of_infinity_in_json() {
    let limits = Limits::UNLIMITED.with_jerk(Interval::symmetric(3.0)).expect("limits");
    let text = serde_json::to_string(&limits).expect("written");
    assert_eq!(serde_json::from_str::<Limits>(&text).expect("read"), limits);
}

#[test]
fn what_cannot_be_is_refused() {
    let bad = r#"{"angular_frequency": 10.0, "damping_ratio": 1.5}"#;
    assert!(serde_json::from_str::<Mode>(bad).expect_err("overdamped").to_string().contains("1.5"));
    let bad = r#"{"velocity":{"lower":1.0,"upper":2.0}}"#;
    assert!(serde_json::from_str::<Limits>(bad).expect_err("above zero").to_string().contains('1'));
}

#[cfg(feature = "nurbs")]
#[test]
fn curves_read_back_and_are_checked() {
    use profiles::nurbs::{Knots, NurbsCurve, Side};

    // Without weights to the bit; a weight is multiplied in and divided out again.
    let plain = NurbsCurve::uniform(2, &[[0.1, 0.2], [1.0, 2.0], [3.0, 2.0], [0.3, 0.7]]).expect("curve");
    let text = serde_json::to_string(&plain).expect("written");
    assert!(!text.contains("weights"), "{text}");
    assert_eq!(serde_json::from_str::<NurbsCurve<2>>(&text).expect("read"), plain);
    let circle = NurbsCurve::<2>::circle([0.1, 0.2], 3.0).expect("circle");
    let text = serde_json::to_string(&circle).expect("written");
    let read = serde_json::from_str::<NurbsCurve<2>>(&text).expect("read");
    assert_eq!(read.knots(), circle.knots());
    assert!(read.deviation(&circle).expect("the same domain").bound <= 8.0 * f64::EPSILON * 3.3);
    assert_eq!(
        serde_json::from_str::<Knots>(&serde_json::to_string(circle.knots()).expect("written"))
            .expect("read"),
        *circle.knots()
    );
    assert_eq!(serde_json::to_string(&Side::Before).expect("written"), "\"before\"");

    let refused = |text: &str, number: &str| {
        let message = serde_json::from_str::<NurbsCurve<2>>(text).expect_err("no curve").to_string();
        assert!(message.contains(number), "{message}");
    };
    refused(r#"{"degree":1,"points":[[0,0],[1,0]],"weights":[1,-2.5],"knots":[0,0,1,1]}"#, "-2.5");
    refused(r#"{"degree":1,"points":[[0,0],[1,0]],"knots":[0,0.25,1,1]}"#, "first");
    refused(r#"{"degree":1,"points":[[0,0],[1,0,7]],"knots":[0,0,1,1]}"#, "3 coordinates");
    refused(r#"{"degree":1,"points":[[0,0],[1,0]],"weight":[1,1],"knots":[0,0,1,1]}"#, "weight");
}
