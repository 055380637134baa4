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
