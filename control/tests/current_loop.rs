//! The current loop on a winding that is stepped exactly.
#![expect(clippy::expect_used, reason = "a helper that fails fails its test")]

use control::{
    CurrentInput, CurrentLoop, CurrentLoopError, CurrentLoopState, CurrentStatus, Dq, PiGains, Windings,
};

const WINDINGS: Windings =
    Windings { resistance: 2.875, d_inductance: 8.5e-3, q_inductance: 12e-3, flux: 0.175 };
const BANDWIDTH: f64 = 1970.0;

fn tuned(period: f64) -> CurrentLoop {
    CurrentLoop::tuned(WINDINGS, BANDWIDTH, period).expect("valid")
}

/// `L i' = v - R i` over one period with the voltage held, exactly.
fn winding(current: f64, voltage: f64, inductance: f64, period: f64) -> f64 {
    let settled = voltage / WINDINGS.resistance;
    settled + (current - settled) * (-WINDINGS.resistance / inductance * period).exp()
}

/// The currents at standstill after each tick, from 0, for a constant reference.
fn response(current_loop: &CurrentLoop, state: &mut CurrentLoopState, reference: Dq, ticks: u32) -> Vec<Dq> {
    let mut current = Dq::default();
    let tick = |_| {
        let input = CurrentInput { reference, current, ..CurrentInput::default() };
        let voltage = current_loop.update(state, input).voltage;
        current = Dq {
            d: winding(current.d, voltage.d, WINDINGS.d_inductance, current_loop.period()),
            q: winding(current.q, voltage.q, WINDINGS.q_inductance, current_loop.period()),
        };
        current
    };
    (0..ticks).map(tick).collect()
}

#[test]
fn gains_cancel_the_pole_of_each_axis() {
    let current_loop = tuned(1e-4);
    assert_eq!(current_loop.d_gains(), PiGains { kp: 8.5e-3 * BANDWIDTH, ki: 2.875 * BANDWIDTH });
    assert_eq!(current_loop.q_gains(), PiGains { kp: 12e-3 * BANDWIDTH, ki: 2.875 * BANDWIDTH });
    assert_eq!(current_loop.decoupling(), (8.5e-3, 12e-3, 0.175));
}

#[test]
fn the_step_is_a_geometric_sequence_at_any_period() {
    // The integral is R i at every tick, so that e_(k+1) = (1 - kp (1 - e^(-h R / L)) / R) e_k.
    for period in [1e-6, 1e-4, 4e-4] {
        let reference = Dq { d: -2.0, q: 5.0 };
        let currents = response(&tuned(period), &mut CurrentLoopState::new(), reference, 40);
        for (k, current) in (1..).zip(currents) {
            for (reference, current, inductance) in
                [(reference.d, current.d, 8.5e-3), (reference.q, current.q, 12e-3)]
            {
                let gain = -(-WINDINGS.resistance / inductance * period).exp_m1() / WINDINGS.resistance;
                let exact = reference * (1.0 - (1.0 - inductance * BANDWIDTH * gain).powi(k));
                // 1 - e^(-h R / L) of 2e-4 and more is rounded to 1e-12 of itself.
                assert!((current - exact).abs() < 1e-11 * reference.abs(), "tick {k}: {current} {exact}");
            }
        }
    }
}

#[test]
fn the_step_tends_to_the_first_order_response_it_was_tuned_for() {
    let error = |period: f64| {
        let ticks = (5.0 / BANDWIDTH / period) as u32;
        let currents = response(&tuned(period), &mut CurrentLoopState::new(), Dq { d: 0.0, q: 1.0 }, ticks);
        let designed = |k: u32| 1.0 - (-BANDWIDTH * period * f64::from(k)).exp();
        (1..).zip(currents).map(|(k, i)| (i.q - designed(k)).abs()).fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(1e-6), error(5e-7));
    // The pole 1 - (w - R / 2L w h) h + ... is off by (w^2 / 2 - R w / 2L) h^2: e^-1 / 2 (w - R / L) h at worst.
    let predicted = 0.5 * (BANDWIDTH - 2.875 / 12e-3) * 1e-6 / std::f64::consts::E;
    assert!((coarse / predicted - 1.0).abs() < 0.01, "{coarse:e} instead of {predicted:e}");
    assert!((coarse / fine - 2.0).abs() < 0.01, "order one: {coarse:e} -> {fine:e}");
}

#[test]
fn decoupling_cancels_what_the_speed_induces() {
    // L_d i_d' = v_d - R i_d + w L_q i_q, L_q i_q' = v_q - R i_q - w (L_d i_d + psi), in steps far below the period.
    let current_loop = tuned(1e-5);
    let without = current_loop.with_decoupling(0.0, 0.0, 0.0).expect("valid");
    let (speed, reference) = (900.0, Dq { d: 0.0, q: 4.0 });
    let worst = |current_loop: &CurrentLoop| {
        let mut state = CurrentLoopState::new();
        let (mut current, mut worst) = (Dq::default(), 0.0_f64);
        for k in 1..=500 {
            let input = CurrentInput { reference, current, speed, realised: None };
            let v = current_loop.update(&mut state, input).voltage;
            for _ in 0..20 {
                let (d, q) = (current.d, current.q);
                current.d += 5e-7 * (v.d - 2.875 * d + speed * 12e-3 * q) / 8.5e-3;
                current.q += 5e-7 * (v.q - 2.875 * q - speed * (8.5e-3 * d + 0.175)) / 12e-3;
            }
            let designed = 4.0 * (1.0 - (-BANDWIDTH * 1e-5 * f64::from(k)).exp());
            worst = worst.max(current.d.abs()).max((current.q - designed).abs());
        }
        worst
    };
    // What the sampled tick is late by is w h = 1 % of the current and of the response.
    assert!(worst(&current_loop) < 0.04, "{} A", worst(&current_loop));
    assert!(worst(&without) > 2.0, "{} A", worst(&without));
}

#[test]
fn at_the_limit_the_d_axis_comes_first() {
    let gains = PiGains { kp: 1.0, ki: 0.0 };
    let current_loop =
        CurrentLoop::new(gains, gains, 1.0).and_then(|l| l.with_voltage_limit(5.0)).expect("valid");
    for (asked, given, status) in [
        ((3.0, 4.0), (3.0, 4.0), CurrentStatus::Regular),
        ((-3.0, -40.0), (-3.0, -4.0), CurrentStatus::Limited),
        ((-4.0, 9.0), (-4.0, 3.0), CurrentStatus::Limited),
        ((7.0, 9.0), (5.0, 0.0), CurrentStatus::Limited),
        ((-7.0, 0.0), (-5.0, 0.0), CurrentStatus::Limited),
    ] {
        let reference = Dq { d: asked.0, q: asked.1 };
        let input = CurrentInput { reference, ..CurrentInput::default() };
        let output = current_loop.update(&mut CurrentLoopState::new(), input);
        assert_eq!((output.voltage.d, output.voltage.q), given, "asked for {asked:?}");
        assert_eq!(output.status, status);
    }
}

/// From the limit the current goes on as the first-order response from wherever it is: no windup, no overshoot.
#[test]
fn nothing_winds_up_at_the_voltage_limit() {
    let current_loop = tuned(1e-4).with_voltage_limit(20.0).expect("valid");
    let mut state = CurrentLoopState::new();
    let currents = response(&current_loop, &mut state, Dq { d: 0.0, q: 6.0 }, 400);
    // 6 A need 17 V, and 24 V/A are asked for: limited for most of the way.
    let decay = 1.0 + BANDWIDTH * 12e-3 * (-2.875e-4 / 12e-3_f64).exp_m1() / 2.875;
    let errors: Vec<f64> = currents.iter().map(|i| 6.0 - i.q).collect();
    let regular =
        errors.iter().position(|e| 12e-3 * BANDWIDTH * e + 2.875 * (6.0 - e) <= 20.0).expect("arrives");
    assert!(regular > 40, "limited for {regular} ticks");
    let mut expected = errors[regular];
    for (k, error) in errors.iter().enumerate().skip(regular) {
        assert!((error - expected).abs() < 1e-12 * 6.0 * 40.0, "tick {k}: {error} instead of {expected}");
        expected *= decay;
    }
    assert!((state.integral().q - 2.875 * 6.0).abs() < 1e-10, "R i: {}", state.integral().q);
}

#[test]
fn the_integral_follows_the_voltage_the_inverter_gave() {
    // No limit of its own; the inverter gives 3 V whatever is asked: I tends to 3 V as R i does.
    let current_loop = tuned(1e-4);
    let mut state = CurrentLoopState::new();
    let realised = Some(Dq { d: 0.0, q: 3.0 });
    let mut current = Dq::default();
    for _ in 0..100 {
        let input = CurrentInput { reference: Dq { d: 0.0, q: 6.0 }, current, speed: 0.0, realised };
        let _ = current_loop.update(&mut state, input);
        // One rounding of 3 V per tick.
        assert!((state.integral().q - 2.875 * winding(current.q, 3.0, 12e-3, 1e-4)).abs() < 1e-12);
        current.q = winding(current.q, 3.0, 12e-3, 1e-4);
    }
}

#[test]
fn gains_change_without_a_bump() {
    let old = tuned(1e-4);
    let gains = PiGains { kp: 3.0, ki: 900.0 };
    let new = old.with_gains(gains, PiGains { kp: 60.0, ki: 0.0 }).expect("valid");
    let mut state = CurrentLoopState::new();
    let input = |k: f64| CurrentInput {
        reference: Dq { d: -1.0, q: 5.0 },
        current: Dq { d: -0.3 * k, q: 0.7 * k },
        speed: 300.0,
        realised: None,
    };
    let mut before = Dq::default();
    for k in 0..4 {
        before = old.update(&mut state, input(f64::from(k))).voltage;
    }
    new.take_over(&old, &mut state);
    let after = new.update(&mut state, input(3.0)).voltage;
    // What one tick of the new law does: the integral takes (1 - e^(-h ki / kp)) kp e of each axis.
    let own = (1.0 - (-1e-4 * 300.0_f64).exp()) * 3.0 * (-1.0 + 0.9);
    // Some ten roundings of terms of 300 V.
    assert!((after.d - before.d - own).abs() < 3e3 * f64::EPSILON, "{before:?} -> {after:?}");
    assert!((after.q - before.q).abs() < 3e3 * f64::EPSILON, "{before:?} -> {after:?}");
}

#[test]
fn bad_numbers_are_named() {
    let gains = PiGains { kp: 1.0, ki: 2.0 };
    assert_eq!(CurrentLoop::new(gains, gains, 0.0), Err(CurrentLoopError::Period(0.0)));
    assert_eq!(
        CurrentLoop::new(PiGains { kp: 0.0, ..gains }, gains, 1.0),
        Err(CurrentLoopError::ProportionalGain { axis: "d", value: 0.0 })
    );
    assert_eq!(
        CurrentLoop::new(gains, PiGains { ki: -1.0, ..gains }, 1.0),
        Err(CurrentLoopError::IntegralGain { axis: "q", value: -1.0 })
    );
    let current_loop = CurrentLoop::new(gains, gains, 1.0).expect("valid");
    assert_eq!(current_loop.with_voltage_limit(-1.0), Err(CurrentLoopError::VoltageLimit(-1.0)));
    assert!(current_loop.with_voltage_limit(f64::NAN).is_err());
    assert!(matches!(current_loop.with_voltage_limit(1e200), Err(CurrentLoopError::Range { .. })));
    assert!(current_loop.with_decoupling(-1.0, 0.0, 0.0).is_err());
    assert!(current_loop.with_decoupling(0.0, 0.0, f64::NAN).is_err());
    assert_eq!(
        PiGains::pole_zero_cancellation(1.0, 0.0, 1.0),
        Err(CurrentLoopError::Parameter { which: "inductance", range: "positive", value: 0.0 })
    );
    assert!(PiGains::pole_zero_cancellation(1.0, f64::MAX, 2.0).is_err());
}
