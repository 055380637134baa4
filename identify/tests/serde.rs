//! Options and results survive being written.
#![cfg(feature = "serde")]

use identify::{
    DampedSinusoids, MovingAverage, ResponseClassifier, SinusoidOptions, SpectrumOptions,
    TransferFunctionFit, TransferFunctionOptions, amplitude_spectrum, fit_damped_sinusoids,
    fit_transfer_function,
};

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

#[test]
fn transfer_functions_spectra_and_filters() {
    let options = TransferFunctionOptions::new(1, 0);
    let text = serde_json::to_string(&options).expect("writes");
    assert_eq!(serde_json::from_str::<TransferFunctionOptions>(&text).expect("reads"), options);
    let output: Vec<f64> = (0..60).map(|n| 1.0 - (-0.1 * f64::from(n)).exp()).collect();
    let fit = fit_transfer_function(&[1.0; 60], &output, 0.1, &options).expect("fits");
    let text = serde_json::to_string(&fit).expect("writes");
    let read: TransferFunctionFit = serde_json::from_str(&text).expect("reads");
    // Reading may round the last digit.
    assert!((read.poles[0].real - fit.poles[0].real).abs() < 1e-15);
    let options = SpectrumOptions::default();
    let text = serde_json::to_string(&options).expect("writes");
    assert_eq!(serde_json::from_str::<SpectrumOptions>(&text).expect("reads"), options);
    let spectrum = amplitude_spectrum(&output, 0.1, &options).expect("valid");
    assert!(serde_json::to_string(&spectrum).expect("writes").contains("amplitudes"));
    assert_eq!(serde_json::from_str::<MovingAverage>(r#"{"length":3}"#).expect("reads").length(), 3);
    assert!(serde_json::from_str::<MovingAverage>(r#"{"length":0}"#).is_err());
}

#[test]
fn what_a_log_says_reads_as_written() {
    let options = identify::LogOptions { most: 2, ..identify::LogOptions::default() };
    let text = serde_json::to_string(&options).expect("writes");
    assert_eq!(serde_json::from_str::<identify::LogOptions>(&text).expect("reads"), options);
    let response: Vec<f64> =
        (0..600).map(|n| (-0.01 * f64::from(n)).exp() * (0.2 * f64::from(n)).cos()).collect();
    let log = identify::Log::new(1e-3, &[0.0; 600], &response).expect("valid");
    let found = identify::identify_log(&log, &options).expect("a mode");
    let text = serde_json::to_string(&found).expect("writes");
    let read: identify::LogModes = serde_json::from_str(&text).expect("reads");
    assert_eq!((read.modes.len(), read.route, read.rests), (1, found.route, found.rests));
    assert!(serde_json::to_string(&log.figures()).expect("writes").contains("quantum"));
}
