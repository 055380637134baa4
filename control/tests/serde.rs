//! Configurations are checked when they are read.
#![cfg(feature = "serde")]

use control::{
    AntiWindup, Cascade, CurrentLoop, DerivativeOn, Feedforward, FieldOriented, PiGains, Pid, PidGains,
    Windings,
};

#[test]
fn a_configuration_comes_back_as_it_was() {
    let gains = PidGains { kp: 0.1, ki: 3.0, kd: -0.0 };
    let plain = Pid::new(gains, 1e-3).expect("valid");
    let full = plain
        .with_derivative_on(DerivativeOn::Measurement)
        .with_derivative_filter(0.01)
        .and_then(|p| p.with_output_limits(f64::NEG_INFINITY, 2.0))
        .and_then(|p| p.with_anti_windup(AntiWindup::BackCalculation { tracking_time: 0.3 }))
        .expect("valid");
    for pid in [plain, full] {
        let text = serde_json::to_string(&pid).expect("writes");
        assert_eq!(serde_json::from_str::<Pid>(&text).expect(&text), pid);
    }
}

#[test]
fn coupling_gains_are_a_sequence_and_are_checked() {
    let coupling = control::CrossCoupling::new([0.5_f32, 0.0, 2.0]).expect("valid");
    let text = serde_json::to_string(&coupling).expect("writes");
    assert_eq!(text, "[0.5,0.0,2.0]");
    assert_eq!(serde_json::from_str::<control::CrossCoupling<3, f32>>(&text).expect("reads"), coupling);
    for (text, reason) in
        [("[0.5, -1, 2]", "axis 1"), ("[0.5, 1]", "3 gains"), ("[0.5, 1, 2, 3]", "trailing")]
    {
        let error = serde_json::from_str::<control::CrossCoupling<3>>(text).expect_err(text);
        assert!(error.to_string().contains(reason), "{error}");
    }
}

#[test]
fn what_is_absent_has_its_default_and_what_is_wrong_is_refused() {
    let read = |text: &str| serde_json::from_str::<Pid<f32>>(text);
    let gains = r#""gains": {"kp": 1, "ki": 2, "kd": 0}"#;
    let pid = read(&format!(r#"{{{gains}, "period": 0.5, "upper": 3}}"#)).expect("valid");
    assert_eq!(pid.anti_windup(), AntiWindup::Clamping);
    assert_eq!(pid.output_limits(), (f32::NEG_INFINITY, 3.0));

    let back = r#"{"back_calculation": {"tracking_time": -1}}"#;
    for (rest, reason) in [
        (r#""period": 0"#.to_owned(), "period"),
        (r#""period": 1, "lower": 2, "upper": 1"#.to_owned(), "limit"),
        (r#""period": 1, "derivative_filter": -2"#.to_owned(), "filter"),
        (format!(r#""period": 1, "anti_windup": {back}"#), "tracking"),
        (r#""period": 1, "uper": 2"#.to_owned(), "uper"),
    ] {
        let error = read(&format!("{{{gains}, {rest}}}")).expect_err(&rest).to_string();
        assert!(error.contains(reason), "{error}");
    }
}

#[test]
fn a_feedforward_is_checked() {
    let feedforward = Feedforward::two_mass(1.0, 2.0, 300.0, 4.0).expect("valid");
    let text = serde_json::to_string(&feedforward).expect("writes");
    assert_eq!(serde_json::from_str::<Feedforward>(&text).expect("reads"), feedforward);
    let mass = serde_json::from_str::<Feedforward>(r#"{"acceleration": 2}"#).expect("reads");
    assert_eq!(mass, Feedforward::rigid(2.0, 0.0).expect("valid"));
    assert!(serde_json::from_str::<Feedforward<f32>>(r#"{"acceleration": 1e39}"#).is_err(), "beyond f32");
}

#[test]
fn a_servo_comes_back_as_it_was_and_is_checked() {
    let windings = Windings { resistance: 2.0, d_inductance: 8e-3, q_inductance: 9e-3, flux: 0.2 };
    let unlimited = CurrentLoop::tuned(windings, 1000.0, 1e-4).expect("valid");
    let plain = Cascade::new(100.0, PiGains { kp: 2.0, ki: 30.0 }, 1e-4).expect("valid");
    let full = plain
        .with_divisors(10, 2)
        .and_then(|c| c.with_velocity_feedforward(0.5))
        .and_then(|c| c.with_velocity_limit(300.0))
        .and_then(|c| c.with_current_limit(20.0))
        .and_then(|c| c.with_anti_windup(AntiWindup::None))
        .expect("valid")
        .with_feedforward(Feedforward::rigid(0.5, 0.25).expect("valid"));
    let limited = unlimited.with_voltage_limit(180.0).expect("valid");
    for (cascade, current_loop) in [(plain, unlimited), (full, limited)] {
        let servo = FieldOriented::new(cascade, current_loop, 3).expect("valid");
        let text = serde_json::to_string(&servo).expect("writes");
        assert_eq!(serde_json::from_str::<FieldOriented>(&text).expect(&text), servo);
        for (right, wrong, reason) in [
            (r#""pole_pairs":3"#, r#""pole_pairs":0"#, "pole pair"),
            (r#""position_gain":100.0"#, r#""position_gain":-1.0"#, "position gain"),
            (r#""kp":8.0"#, r#""kp":0.0"#, "proportional gain of the d axis"),
            (r#""period":0.0001,"d_ind"#, r#""period":0.0002,"d_ind"#, "base tick"),
        ] {
            assert!(text.contains(right), "{text}");
            let error = serde_json::from_str::<FieldOriented>(&text.replace(right, wrong)).expect_err(wrong);
            assert!(error.to_string().contains(reason), "{error}");
        }
    }
}
