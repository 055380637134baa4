//! Configurations survive being written, and are checked when read.
#![cfg(feature = "serde")]

use plants::{Clock, Encoder, LinearMotor};

#[test]
fn round_trips() {
    let clock = Clock::from_period(3, 8).expect("valid");
    let text = serde_json::to_string(&clock).expect("writes");
    assert_eq!(serde_json::from_str::<Clock>(&text).expect("reads"), clock);
    for motor in [
        LinearMotor::new(2.0, 0.1).expect("valid"),
        LinearMotor::new(2.0, 0.0)
            .and_then(|m| m.driven_by_current(3.0)?.with_force_limit(4.0))
            .expect("valid"),
    ] {
        let text = serde_json::to_string(&motor).expect("writes");
        assert_eq!(serde_json::from_str::<LinearMotor>(&text).expect("reads"), motor);
    }
}

#[test]
fn bad_numbers_are_refused() {
    assert!(serde_json::from_str::<Clock>(r#"{"numerator":1,"denominator":0}"#).is_err());
    assert!(serde_json::from_str::<Encoder>(r#"{"resolution":-1.0}"#).is_err());
    let motor = r#"{"mass":0.0,"damping":0.0,"force_constant":null,"force_limit":null}"#;
    assert!(serde_json::from_str::<LinearMotor>(motor).is_err());
}
