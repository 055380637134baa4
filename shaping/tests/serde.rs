//! Shapers, trains and ranges as they are written down.
#![cfg(feature = "serde")]

use profiles::Mode;
use shaping::{ImpulseTrain, ModeRange, Robustness, Shaper};

#[test]
fn everything_comes_back_as_it_was() {
    let mode = Mode::from_hz(40.0, 0.02).expect("mode");
    let range = ModeRange::around(mode, 0.1, 0.01).expect("range");
    for shaper in [
        Shaper::ZVDD,
        Shaper::MZV,
        Shaper::ExtraInsensitive { humps: 2, tolerance: 0.05 },
        Shaper::UNITY_MAGNITUDE_ZV,
    ] {
        let text = serde_json::to_string(&shaper).expect("writes");
        assert_eq!(serde_json::from_str::<Shaper>(&text).expect(&text), shaper);
        let train: ImpulseTrain<4> = shaper.train(mode).expect("train");
        let text = serde_json::to_string(&train).expect("writes");
        let read: ImpulseTrain<4> = serde_json::from_str(&text).expect(&text);
        // The decimal reader may round differently, and amplitudes are divided by their sum again.
        for (ours, read) in train.impulses().iter().zip(read.impulses()) {
            assert!((ours.amplitude - read.amplitude).abs() < 1e-15 && (ours.time - read.time).abs() < 1e-15);
        }
        let report = train.robustness(mode, &range, 0.05);
        let text = serde_json::to_string(&report).expect("writes");
        let read: Robustness = serde_json::from_str(&text).expect(&text);
        assert!((read.worst_case.bound - report.worst_case.bound).abs() < 1e-15);
    }
    let text = serde_json::to_string(&range).expect("writes");
    let read: ModeRange = serde_json::from_str(&text).expect(&text);
    assert!((read.angular_frequency().upper - range.angular_frequency().upper).abs() < 1e-12);
    assert_eq!(
        serde_json::from_str::<Shaper>(r#"{"extra_insensitive": {"humps": 1, "tolerance": 0.05}}"#)
            .expect("shaper"),
        Shaper::extra_insensitive(0.05)
    );
}

#[test]
fn what_is_wrong_is_refused_with_its_number() {
    let train = |text: &str| serde_json::from_str::<ImpulseTrain<2>>(text).expect_err(text).to_string();
    let late = r#"[{"time": 0.2, "amplitude": 1}, {"time": 0.1, "amplitude": 1}]"#;
    assert!(train(late).contains("0.1"));
    let three = r#"[{"time": 0, "amplitude": 1}, {"time": 1, "amplitude": 1}, {"time": 2, "amplitude": 1}]"#;
    assert!(train(three).contains("3 impulses"));
    assert!(train("[]").contains("at least one"));
    assert!(train(r#"[{"time": 0, "amplitud": 1}]"#).contains("amplitud"));
    let range =
        r#"{"angular_frequency": {"lower": 3, "upper": 2}, "damping_ratio": {"lower": 0, "upper": 0}}"#;
    assert!(serde_json::from_str::<ModeRange>(range).expect_err(range).to_string().contains('3'));
}
