//! Configurations are checked when they are read.
#![cfg(feature = "serde")]

use control::{
    AntiWindup, AxisModel, Cascade, CurrentLoop, DerivativeOn, DisturbanceObserver, Feedforward,
    FieldOriented, PiGains, Pid, PidGains, ReachingLaw, Sampling, SlidingMode, SlidingSurface, SuperTwisting,
    Switching, Windings,
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

#[test]
fn sliding_mode_controllers_come_back_as_they_were_and_are_checked() {
    let model = AxisModel::new(10.0, 1.0, 2.0).expect("valid");
    let terminal = SlidingSurface::terminal(10.0, 1.0, 9, 5).expect("valid");
    let surfaces = [
        terminal,
        terminal.with_guard(1e-6).expect("valid"),
        SlidingSurface::linear(3.0).expect("valid"),
        SlidingSurface::nonsingular_terminal(3.0, 5, 3).expect("valid"),
        SlidingSurface::fast_nonsingular_terminal(1.0, 2.0, 3.0, 5, 3).expect("valid"),
    ];
    let laws = [
        ReachingLaw::improved_double_power(20.0, 20.0, 200.0, 0.25, 0.5),
        ReachingLaw::constant(3.0).and_then(|l| l.with_switching(Switching::Saturation { width: 0.1 })),
        ReachingLaw::exponential(3.0, 0.0).and_then(|l| l.with_switching(Switching::Smooth { width: 0.1 })),
        ReachingLaw::power(3.0, 0.5),
        ReachingLaw::double_power(3.0, 1.5, 4.0, 0.5),
    ];
    for (surface, law) in surfaces.into_iter().zip(laws) {
        let plain = SlidingMode::new(surface, law.expect("valid"), model, 1e-3).expect("valid");
        let full = plain
            .with_sampling(Sampling::Matched)
            .and_then(|c| c.with_integral_compensation(20.0))
            .and_then(|c| c.with_output_limits(f64::NEG_INFINITY, 2.0))
            .expect("valid");
        for controller in [plain, full] {
            let text = serde_json::to_string(&controller).expect("writes");
            assert_eq!(serde_json::from_str::<SlidingMode>(&text).expect(&text), controller);
        }
    }
    let twisting = SuperTwisting::new(terminal, 15.0, 110.0, model, 1e-3)
        .and_then(|c| c.with_sampling(Sampling::Implicit).with_output_limits(-3.0, f64::INFINITY))
        .expect("valid");
    let text = serde_json::to_string(&twisting).expect("writes");
    assert_eq!(serde_json::from_str::<SuperTwisting>(&text).expect(&text), twisting);
    let observer = DisturbanceObserver::new(model, 300.0, 1e-3).expect("valid");
    let text = serde_json::to_string(&observer).expect("writes");
    assert_eq!(serde_json::from_str::<DisturbanceObserver>(&text).expect(&text), observer);

    let text = r#"{"surface": {"terminal": {"alpha": 10, "beta": 1, "p": 9, "q": 5}},
        "reaching": {"law": {"exponential": {"k": 200, "eps": 33}}},
        "model": {"damping": 10, "stiffness": 1, "gain": 1}, "period": 0.001}"#;
    assert!(serde_json::from_str::<SlidingMode>(text).expect(text).output_limits().0.is_infinite());
    for (right, wrong, reason) in [
        (r#""q": 5"#, r#""q": 4"#, "odd exponents"),
        (r#""eps": 33"#, r#""eps": -1"#, "eps"),
        (r#""gain": 1"#, r#""gain": 0"#, "gain of the axis"),
        ("0.001", "0", "period"),
        (r#""period""#, r#""lower": 3, "upper": 2, "period""#, "limit"),
        (r#""alpha""#, r#""alfa""#, "alfa"),
    ] {
        let error = serde_json::from_str::<SlidingMode>(&text.replace(right, wrong)).expect_err(wrong);
        assert!(error.to_string().contains(reason), "{error}");
    }
}
