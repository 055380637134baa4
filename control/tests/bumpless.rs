//! Gains, filters and modes change without a bump.
#![expect(clippy::expect_used, reason = "a helper that fails fails its test")]
#![expect(clippy::float_cmp, reason = "numbers that must be equal to the bit")]

use control::{AntiWindup, DerivativeOn, Pid, PidGains, PidInput, PidState, Status};
use proptest::prelude::*;

fn config(kp: f64, ki: f64, kd: f64, tau: f64) -> Pid {
    Pid::new(PidGains { kp, ki, kd }, 1e-3)
        .and_then(|p| p.with_derivative_filter(tau))
        .and_then(|p| p.with_anti_windup(AntiWindup::BackCalculation { tracking_time: 0.1 }))
        .expect("valid")
}

fn any_config() -> impl Strategy<Value = Pid> {
    let ki = prop_oneof![Just(0.0), -50.0..50.0];
    (-20.0..20.0, ki, -0.1..0.1, 0.0..0.01, any::<bool>()).prop_map(|(kp, ki, kd, tau, measurement)| {
        let on = if measurement { DerivativeOn::Measurement } else { DerivativeOn::Error };
        config(kp, ki, kd, tau).with_derivative_on(on)
    })
}

/// The largest term of the law after the last tick: what a rounding error is relative to.
fn scale(pid: &Pid, state: &PidState, error: f64, feedforward: f64) -> f64 {
    let gains = pid.gains();
    [feedforward, gains.kp * error, gains.kd * state.derivative(), state.integral()]
        .into_iter()
        .fold(0.0, |a: f64, b| a.max(b.abs()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1024))]

    /// With the last inputs again, the new law gives the old output plus what one tick adds by itself:
    /// `ki h e`, and the filter's forgetting `kd (tau / (tau + h) - 1) d`.
    #[test]
    fn a_change_of_configuration(
        old in any_config(),
        new in any_config(),
        samples in prop::collection::vec((-1.0..1.0, -1.0..1.0), 1..20),
        feedforward in -5.0..5.0,
    ) {
        let mut state = PidState::new();
        let mut last = (PidInput::default(), 0.0);
        for (setpoint, measurement) in samples {
            let input = PidInput { feedforward, ..PidInput::new(setpoint, measurement) };
            last = (input, old.update(&mut state, input).output);
        }
        let (input, before) = last;
        let error = input.setpoint - input.measurement;
        let size = scale(&old, &state, error, feedforward);
        new.take_over(&old, &mut state);
        let derivative = state.derivative();
        let size = size.max(scale(&new, &state, error, feedforward));
        let after = new.update(&mut state, input).output;
        let tau = new.derivative_filter();
        let own = new.gains().ki * 1e-3 * error - new.gains().kd * derivative * 1e-3 / (tau + 1e-3);
        // Some ten additions, each rounding by half an ulp of the largest term.
        prop_assert!((after - before - own).abs() <= 8.0 * f64::EPSILON * size, "{before} -> {after}, own {own}");
    }

    /// Through manual and back the output is continuous, whatever the set-point does meanwhile.
    #[test]
    fn a_change_of_mode(
        pid in any_config(),
        samples in prop::collection::vec((-1.0..1.0, -1.0..1.0), 1..20),
        manual in -10.0..10.0,
        rest in -1.0..1.0,
    ) {
        let mut state = PidState::new();
        let mut before = 0.0;
        for (setpoint, measurement) in &samples {
            before = pid.update(&mut state, PidInput::new(*setpoint, *measurement)).output;
        }
        state.set_manual(state.output());
        for (setpoint, measurement) in samples {
            let held = pid.update(&mut state, PidInput::new(measurement, setpoint));
            prop_assert_eq!((held.output, held.status), (before, Status::Manual));
        }
        state.set_manual(manual);
        let mut size = 0.0_f64;
        // Long enough for the filter to forget: (10/11)^500 of 2000 is below 1e-17.
        for _ in 0..500 {
            prop_assert_eq!(pid.update(&mut state, PidInput::new(rest, rest)).output, manual);
            size = size.max(scale(&pid, &state, 0.0, manual));
        }
        state.set_automatic();
        let after = pid.update(&mut state, PidInput::new(rest, rest));
        prop_assert_eq!(after.status, Status::Regular);
        prop_assert!((after.output - manual).abs() <= 4.0 * f64::EPSILON * size, "{manual} -> {}", after.output);
    }
}

#[test]
fn a_change_of_ki_alone_shifts_nothing() {
    let (old, new) = (config(2.0, 5.0, 0.1, 0.01), config(2.0, 50.0, 0.1, 0.01));
    let mut state = PidState::new();
    for k in 0..100 {
        let _ = old.update(&mut state, PidInput::new(1.0, 0.01 * f64::from(k)));
    }
    let before = state;
    new.take_over(&old, &mut state);
    assert_eq!(state, before);
}

#[test]
fn a_manual_output_keeps_the_limits() {
    let pid = config(2.0, 5.0, 0.0, 0.0).with_output_limits(-1.0, 1.0).expect("valid");
    let mut state = PidState::new();
    state.set_manual(7.0);
    assert_eq!(pid.update(&mut state, PidInput::new(0.0, 0.0)).output, 1.0);
    // By hand the output obeys even while the sensor fails.
    state.set_manual(-0.5);
    let held = pid.update(&mut state, PidInput::new(0.0, f64::NAN));
    assert_eq!((held.output, held.status), (-0.5, Status::Held));
}
