//! Synthetic responses of each class, with noise.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use identify::{ResponseClass, ResponseClassifier, Signal};
use plants::{GaussianNoise, Noise};

const PERIOD: f64 = 1e-3;

/// A response from `from` to `target` with an error that starts at one, sampled with noise.
fn response(error: impl Fn(f64) -> f64, from: f64, target: f64, seed: u64) -> Vec<f64> {
    // A millionth of the move is 1 % of the threshold; no draw of 2000 is beyond six deviations.
    let mut noise = GaussianNoise::new(1e-6 * (target - from).abs(), seed).expect("valid");
    let value = |t: f64| target - (target - from) * error(t);
    (0..2000).map(|n| value(f64::from(n) * PERIOD) + noise.sample()).collect()
}

/// The class of a response, the same upwards and downwards and for every noise.
fn class(error: impl Fn(f64) -> f64) -> ResponseClass {
    let classify = |from, target, seed| {
        let values = response(&error, from, target, seed);
        let signal = Signal::sampled(&values, PERIOD).expect("valid");
        let found = ResponseClassifier::default().classify(&signal, from, target).expect("a move");
        assert_eq!(found.decays.len(), found.peaks.len().saturating_sub(1));
        assert_eq!(found.decay_changes.len(), found.decays.len().saturating_sub(1));
        found.class
    };
    let first = classify(0.0, 1.0, 0);
    for seed in 1..20 {
        assert_eq!(classify(0.0, 1.0, seed), first);
        assert_eq!(classify(3.0, -40.0, seed), first);
    }
    first
}

#[test]
fn a_lag_is_a() {
    assert_eq!(class(|t| (-8.0 * t).exp()), ResponseClass::A);
    // It rings, but on the near side of the target.
    assert_eq!(class(|t| (-4.0 * t).exp() * (1.0 + 0.2 * (60.0 * t).cos())), ResponseClass::A);
}

#[test]
fn one_overshoot_is_b() {
    assert_eq!(
        class(|t| (1.0 + 8.0 * t) * (-8.0 * t).exp() - 20.0 * t * (-10.0 * t).exp()),
        ResponseClass::B
    );
    // Two peaks have one decay and no change of it.
    assert_eq!(class(|t| (-30.0 * t).exp() * (40.0 * t).cos()), ResponseClass::B);
}

#[test]
fn ringing_is_c() {
    for (sigma, omega) in [(6.0, 50.0), (15.0, 120.0), (3.0, 300.0)] {
        assert_eq!(class(|t| (-sigma * t).exp() * (omega * t).cos()), ResponseClass::C);
    }
}

#[test]
fn peaks_that_decay_ever_faster_are_b() {
    // Decays of e^(-t^2 / 2 s^2) at peaks one period apart change by e^(-(period / s)^2) each: 0.54 here.
    let period = std::f64::consts::TAU / 60.0;
    let s = period / 0.62_f64.sqrt();
    assert_eq!(class(|t| (-0.5 * (t / s).powi(2)).exp() * (60.0 * t).cos()), ResponseClass::B);
}

#[test]
fn the_configuration_counts() {
    let values = response(|t| (-6.0 * t).exp() * (50.0 * t).cos(), 0.0, 1.0, 1);
    let signal = Signal::sampled(&values, PERIOD).expect("valid");
    let classify = |c: ResponseClassifier| c.classify(&signal, 0.0, 1.0).map(|found| found.class);
    let default = ResponseClassifier::default();
    assert_eq!(classify(ResponseClassifier { threshold: 2.0, ..default }), Ok(ResponseClass::A));
    assert_eq!(classify(ResponseClassifier { threshold: 0.2, ..default }), Ok(ResponseClass::B));
    assert_eq!(classify(ResponseClassifier { steady_from: 1.1, ..default }), Ok(ResponseClass::B));
    assert!(classify(ResponseClassifier { threshold: f64::NAN, ..default }).is_err());
    assert!(default.classify(&signal, 1.0, 1.0).is_err());
}
