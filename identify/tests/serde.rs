//! Options and results survive being written.
#![cfg(feature = "serde")]

use identify::{DampedSinusoids, ResponseClassifier, SinusoidOptions, fit_damped_sinusoids};

#[test]
fn round_trips() {
    let options = SinusoidOptions::default();
    let text = serde_json::to_string(&options).expect("writes");
    assert_eq!(serde_json::from_str::<SinusoidOptions>(&text).expect("reads"), options);
    let rule = ResponseClassifier::default();
    let text = serde_json::to_string(&rule).expect("writes");
    assert_eq!(serde_json::from_str::<ResponseClassifier>(&text).expect("reads"), rule);
    let values: Vec<f64> =
        (0..200).map(|n| 0.02 * f64::from(n)).map(|t| (-0.2 * t).exp() * (5.0 * t).sin()).collect();
    let decay = fit_damped_sinusoids(&values, 0.02, &options).expect("a mode");
    let text = serde_json::to_string(&decay).expect("writes");
    let read: DampedSinusoids = serde_json::from_str(&text).expect("reads");
    // Reading may round the last digit.
    assert!((read.modes[0].amplitude - decay.modes[0].amplitude).abs() < 1e-15);
    assert_eq!(read.modes.len(), decay.modes.len());
}

#[test]
fn a_mode_that_cannot_be_is_refused() {
    let bad = r#"{"modes":[{"mode":{"angular_frequency":-1.0,"damping_ratio":0.1},"amplitude":1.0,"phase":0.0,
        "frequency_deviation":0.0,"damping_deviation":0.0}],"decays":[],"offset":0.0,"fit":1.0,"noise":0.0}"#;
    assert!(serde_json::from_str::<DampedSinusoids>(bad).is_err());
}
