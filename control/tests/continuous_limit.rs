//! The sampled law against the continuous one: every formula of the doc comment converges to it with order one.
#![expect(clippy::expect_used, reason = "a helper that fails fails its test")]

use control::{Pid, PidGains, PidInput, PidState};

/// Largest difference over one second between the sampled PID and `exact`, for the error `sin(w t)`.
fn sine_error(gains: PidGains, tau: f64, w: f64, ticks: u32, exact: impl Fn(f64) -> f64) -> f64 {
    let period = 1.0 / f64::from(ticks);
    let pid = Pid::new(gains, period).and_then(|p| p.with_derivative_filter(tau)).expect("valid");
    let mut state = PidState::new();
    let mut worst = 0.0_f64;
    for k in 0..=ticks {
        let t = f64::from(k) * period;
        let output = pid.update(&mut state, PidInput::new((w * t).sin(), 0.0)).output;
        // The unfiltered derivative is zero at the first tick by definition.
        if k > 0 {
            worst = worst.max((output - exact(t)).abs());
        }
    }
    worst
}

/// Halving the period halves the error; second-order terms are 2 % of it at these periods.
fn assert_first_order(error: impl Fn(u32) -> f64) {
    let (coarse, fine) = (error(2000), error(4000));
    assert!((coarse / fine - 2.0).abs() < 0.05, "error {coarse:e} -> {fine:e}");
}

#[test]
fn a_sine_with_plain_derivative() {
    // u = kp sin wt + ki (1 - cos wt) / w + kd w cos wt
    let (gains, w) = (PidGains { kp: 2.0, ki: 30.0, kd: 0.5 }, 7.0_f64);
    let exact = |t: f64| {
        gains.kp * (w * t).sin() + gains.ki * (1.0 - (w * t).cos()) / w + gains.kd * w * (w * t).cos()
    };
    assert_first_order(|ticks| sine_error(gains, 0.0, w, ticks, exact));
    assert!(sine_error(gains, 0.0, w, 4000, exact) < 0.01, "of an amplitude of 9");
}

#[test]
fn a_sine_with_filtered_derivative() {
    // tau d' + d = w cos wt, d(0) = 0: d = w (cos wt + w tau sin wt - e^(-t / tau)) / (1 + w^2 tau^2)
    let (gains, w, tau) = (PidGains { kp: 0.0, ki: 0.0, kd: 1.0 }, 7.0_f64, 0.05_f64);
    let exact =
        |t: f64| w * ((w * t).cos() + w * tau * (w * t).sin() - (-t / tau).exp()) / (1.0 + (w * tau).powi(2));
    assert_first_order(|ticks| sine_error(gains, tau, w, ticks, exact));
}

#[test]
fn the_filter_follows_the_closed_form_of_its_recursion() {
    // A ramp of slope 3 gives d_k = 3 (1 - (tau / (tau + h))^k): geometric sum of h / (tau + h) per tick.
    let (period, tau, slope) = (1e-3, 7e-3, 3.0);
    let gains = PidGains { kp: 0.0, ki: 0.0, kd: 1.0 };
    let pid = Pid::new(gains, period).and_then(|p| p.with_derivative_filter(tau)).expect("valid");
    let mut state = PidState::new();
    for k in 0..60 {
        let setpoint = slope * f64::from(k) * period;
        let output = pid.update(&mut state, PidInput::new(setpoint, 0.0)).output;
        let exact = slope * (1.0 - (tau / (tau + period)).powi(k));
        // The differences of a ramp up to 0.18 carry its rounding, 3e-17, over tau + h = 8e-3.
        assert!((output - exact).abs() < 1e-13, "tick {k}: {output} instead of {exact}");
    }
}

#[test]
fn a_loop_on_a_first_order_plant() {
    // y' = u - y, u = kp e + ki int e, unit step of r:
    // y'' + (1 + kp) y' + ki y = ki with y(0) = 0, y'(0) = kp, so for kp = 2, ki = 5
    // y = 1 - e^(-1.5 t) (cos wt - 0.5 / w sin wt), w^2 = 5 - 1.5^2.
    let w = 2.75_f64.sqrt();
    let exact = |t: f64| 1.0 - (-1.5 * t).exp() * ((w * t).cos() - 0.5 / w * (w * t).sin());
    let error = |ticks: u32| {
        let period = 1.0 / f64::from(ticks);
        let pid = Pid::new(PidGains { kp: 2.0, ki: 5.0, kd: 0.0 }, period).expect("valid");
        let mut state = PidState::new();
        let decay = (-period).exp();
        let (mut y, mut worst) = (0.0, 0.0_f64);
        for k in 0..4 * ticks {
            worst = worst.max((y - exact(f64::from(k) * period)).abs());
            let u = pid.update(&mut state, PidInput::new(1.0, y)).output;
            // The plant under a held input, exact.
            y = u + (y - u) * decay;
        }
        worst
    };
    assert_first_order(error);
    assert!(error(4000) < 1e-3);
}
