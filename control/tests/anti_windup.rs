//! What each kind of anti-windup does while the output is limited.
#![expect(clippy::expect_used, reason = "a helper that fails fails its test")]
#![expect(clippy::float_cmp, reason = "numbers that must be equal to the bit")]

use control::{AntiWindup, DerivativeOn, Pid, PidGains, PidInput, PidState, Status};

const TRACKING_TIME: f64 = 0.2;
const BACK_CALCULATION: AntiWindup = AntiWindup::BackCalculation { tracking_time: TRACKING_TIME };

fn pid(period: f64, anti_windup: AntiWindup) -> Pid {
    Pid::new(PidGains { kp: 2.0, ki: 5.0, kd: 0.0 }, period)
        .and_then(|p| p.with_output_limits(-1.0, 1.0))
        .and_then(|p| p.with_anti_windup(anti_windup))
        .expect("valid")
}

/// `y' = u - y` with `|u| <= 1` asked for 2 during five seconds, then for 0.5: when is it within 0.01 for good?
fn recovery_time(anti_windup: AntiWindup) -> f64 {
    let period = 1e-3;
    let pid = pid(period, anti_windup);
    let mut state = PidState::new();
    let decay = (-period).exp();
    let (mut y, mut last_outside) = (0.0_f64, 0);
    for k in 0..30_000 {
        let setpoint = if k < 5000 { 2.0 } else { 0.5 };
        let u = pid.update(&mut state, PidInput::new(setpoint, y)).output;
        y = u + (y - u) * decay;
        if (y - 0.5).abs() > 0.01 {
            last_outside = k;
        }
    }
    f64::from(last_outside - 5000) * period
}

#[test]
fn both_kinds_recover_faster_than_none() {
    let none = recovery_time(AntiWindup::None);
    let back_calculation = recovery_time(BACK_CALCULATION);
    let clamping = recovery_time(AntiWindup::Clamping);
    // Unwinding 5 s of an error of more than 1 at an error of 0.5 takes some 10 s; the loop itself settles in
    // ln(100) / 1.5 = 3 s.
    assert!(none > 8.0, "{none} s");
    assert!(back_calculation < 4.0, "{back_calculation} s");
    assert!(clamping < 4.0, "{clamping} s");
}

#[test]
fn back_calculation_decays_as_its_closed_form() {
    let (period, feedforward) = (0.01, 3.0);
    // The set-point met and 3 asked for by the feedforward: the integral gives way by the excess of 2.
    let input = PidInput { feedforward, ..PidInput::new(0.0, 0.0) };
    let pid = pid(period, BACK_CALCULATION);
    let mut state = PidState::new();
    for k in 0..100 {
        let output = pid.update(&mut state, input);
        assert_eq!(output.status, Status::AtUpper);
        let excess = feedforward + state.integral() - 1.0;
        let exact = 2.0 * (TRACKING_TIME / (TRACKING_TIME + period)).powi(k);
        // One rounding of a number of size 3 per tick.
        assert!((excess - exact).abs() < 100.0 * 3.0 * f64::EPSILON, "tick {k}: {excess} instead of {exact}");
    }
}

#[test]
fn back_calculation_tends_to_the_exponential() {
    let error = |period: f64, ticks: i32| {
        let pid = pid(period, BACK_CALCULATION);
        let mut state = PidState::new();
        for _ in 0..=ticks {
            let _ = pid.update(&mut state, PidInput { feedforward: 3.0, ..PidInput::new(0.0, 0.0) });
        }
        let exact = 2.0 * (-f64::from(ticks) * period / TRACKING_TIME).exp();
        (state.integral() + 2.0 - exact).abs()
    };
    let ratio = error(1e-3, 200) / error(5e-4, 400);
    assert!((ratio - 2.0).abs() < 0.02, "order one: {ratio}");
}

#[test]
fn back_calculation_follows_the_realised_output() {
    // No limit of its own; the actuator is left with 0.5.
    let pid = Pid::new(PidGains { kp: 2.0, ki: 5.0, kd: 0.0 }, 0.01)
        .and_then(|p| p.with_anti_windup(BACK_CALCULATION))
        .expect("valid");
    let mut state = PidState::new();
    let input = PidInput { feedforward: 3.0, realised: Some(0.5), ..PidInput::new(0.0, 0.0) };
    let mut output = 0.0;
    for _ in 0..1000 {
        output = pid.update(&mut state, input).output;
    }
    // (0.2 / 0.21)^1000 is nothing: what is commanded is what is realised.
    assert!((output - 0.5).abs() < 1e-12, "{output}");
}

#[test]
fn clamping_bounds_the_integral_for_any_sign_of_the_gain() {
    for sign in [1.0, -1.0] {
        let gains = PidGains { kp: 0.0, ki: 5.0 * sign, kd: 0.0 };
        let pid = Pid::new(gains, 0.01).and_then(|p| p.with_output_limits(-1.0, 2.0)).expect("valid");
        let mut state = PidState::new();
        for _ in 0..1000 {
            let _ = pid.update(&mut state, PidInput::new(sign * 1e6, 0.0));
        }
        assert_eq!(state.integral(), 2.0);
        // It leaves the limit at the first tick of the opposite error.
        assert_eq!(pid.update(&mut state, PidInput::new(-sign, 0.0)).output, 2.0 - 0.05);
    }
}

#[test]
fn a_bias_does_not_drift_without_an_integral_gain() {
    let gains = PidGains { kp: 2.0, ki: 0.0, kd: 0.0 };
    let pid = Pid::new(gains, 0.01)
        .and_then(|p| p.with_output_limits(-1.0, 1.0))
        .and_then(|p| p.with_anti_windup(BACK_CALCULATION))
        .expect("valid");
    let mut state = PidState::new();
    for _ in 0..1000 {
        let _ = pid.update(&mut state, PidInput::new(10.0, 0.0));
    }
    assert_eq!(state.integral(), 0.0);
}

#[test]
fn a_derivative_on_the_measurement_has_no_kick() {
    let with = |kd| {
        Pid::new(PidGains { kp: 2.0, ki: 5.0, kd }, 0.01)
            .expect("valid")
            .with_derivative_on(DerivativeOn::Measurement)
    };
    let (without_kd, with_kd) = (with(0.0), with(8.0));
    let (mut a, mut b) = (PidState::new(), PidState::new());
    for setpoint in [0.0, 0.0, 1.0, -3.0, 1e6] {
        let input = PidInput::new(setpoint, 0.25);
        assert_eq!(without_kd.update(&mut a, input), with_kd.update(&mut b, input));
    }
    // The same on the error kicks by kd / h = 800.
    let on_error = with_kd.with_derivative_on(DerivativeOn::Error);
    let mut state = PidState::new();
    let _ = on_error.update(&mut state, PidInput::new(0.0, 0.0));
    assert!(on_error.update(&mut state, PidInput::new(1.0, 0.0)).output > 800.0);
}

#[test]
fn a_manual_output_that_was_never_given_is_nothing_to_track() {
    let pid = pid(0.01, BACK_CALCULATION);
    let mut state = PidState::new();
    let _ = pid.update(&mut state, PidInput::new(0.0, 0.0));
    state.set_manual(0.5);
    state.set_automatic();
    assert_eq!(pid.update(&mut state, PidInput::new(0.0, 0.0)).output, 0.0);
}
