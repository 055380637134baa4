//! Axes that stick and slip, against closed forms, an adaptive method and their energy.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use plants::nalgebra::{SVector, vector};
use plants::{
    BallScrewAxis, DormandPrince, Friction, StepError, Stepper, StickSlip, Tolerance, ZeroOrderHold,
};
use proptest::prelude::*;

fn axis(a: f64, b: f64, inertia: f64) -> BallScrewAxis {
    BallScrewAxis::from_coefficients(a, b, 1.0).and_then(|axis| axis.with_inertia(inertia)).expect("valid")
}

fn coulomb(torque: f64) -> Friction {
    Friction::coulomb(torque).expect("valid")
}

fn sticking(axis: BallScrewAxis, friction: Friction) -> StickSlip {
    StickSlip::new(axis, friction).expect("valid")
}

/// The state after `time` in steps of lengths that are no part of it.
fn after(
    stepper: &mut impl Stepper<2, 2>,
    mut state: SVector<f64, 2>,
    time: f64,
    steps: u32,
) -> SVector<f64, 2> {
    let weight = |k: u32| f64::from(1 + k * 7 % 5);
    let sum: f64 = (0..steps).map(weight).sum();
    for k in 0..steps {
        state = stepper.advance(&state, &vector![0.0, 0.0], time * weight(k) / sum).expect("valid");
    }
    state
}

#[test]
fn a_slide_without_a_spring_ends_where_it_should() {
    let (inertia, torque, speed) = (0.5, 3.0, 4.0);
    for damping in [0.0, 0.2, 30.0] {
        let mut stepper = sticking(axis(damping / inertia, 0.0, inertia), coulomb(torque));
        // J w' = -c w - T: w = (w0 + T/c) e^(-c t/J) - T/c, which stops at (J/c) ln(1 + c w0/T).
        let (stop, way) = if damping > 0.0 {
            let stop = inertia / damping * (damping * speed / torque).ln_1p();
            (stop, (inertia * speed - torque * stop) / damping)
        } else {
            (inertia * speed / torque, 0.5 * inertia * speed * speed / torque)
        };
        for steps in [1, 3, 1000] {
            for side in [-1.0, 1.0] {
                let before = after(&mut stepper, vector![0.0, side * speed], 0.5 * stop, steps);
                let expected = if damping > 0.0 {
                    let decay = (-damping * 0.5 * stop / inertia).exp();
                    (speed + torque / damping) * decay - torque / damping
                } else {
                    0.5 * speed
                };
                // Every step rounds a few times.
                let tolerance = 1e-15 * f64::from(10 + steps) * speed;
                assert!((before[1] - side * expected).abs() < tolerance, "{before} {expected}");
                let rest = after(&mut stepper, vector![0.0, side * speed], 1.5 * stop, steps);
                assert!((rest[0] - side * way).abs() < tolerance * stop.max(1.0), "{rest} {way}");
                assert_eq!(rest[1].to_bits(), 0.0_f64.to_bits());
            }
        }
    }
}

#[test]
fn a_vibration_loses_as_much_with_every_swing() {
    // Half a swing from x at rest ends at -(x - 2 T/K) at rest, and the last one within T/K of the middle.
    let (inertia, stiffness, torque) = (0.5, 200.0, 1.5);
    let dead: f64 = torque / stiffness;
    let half = std::f64::consts::PI * (inertia / stiffness).sqrt();
    for steps in [7, 200] {
        let mut stepper = sticking(axis(0.0, stiffness / inertia, inertia), coulomb(torque));
        let mut state = vector![9.3 * dead, 0.0];
        for swing in 1..=4 {
            state = after(&mut stepper, state, half, steps);
            let size = 9.3 * dead - 2.0 * f64::from(swing) * dead;
            let side = if swing % 2 == 0 { 1.0 } else { -1.0 };
            // At a turn the speed is that of the roundings, 1e-14 of the largest.
            let speed = 9.3 * dead * (stiffness / inertia).sqrt();
            assert!((state[0] - side * size).abs() < 1e-13 * dead, "{state} {size}");
            assert!(state[1].abs() < 1e-13 * speed, "{state}");
        }
        // 1.3 times the dead band is left: one more swing, to 0.7 of it on the same side, and there it stays.
        let rest = after(&mut stepper, state, 1.01 * half, steps);
        assert!((rest - vector![0.7 * dead, 0.0]).norm() < 1e-13, "{rest}");
        assert_eq!(after(&mut stepper, rest, 100.0, 5), rest);
    }
}

#[test]
fn what_sticks_stays_and_breaks_away_at_its_torque() {
    let friction = coulomb(2.0).with_stribeck(3.0, 0.01, 2.0).expect("valid");
    let inertia = 0.25;
    for (friction, breakaway) in [(friction, 3.0), (coulomb(2.0), 2.0)] {
        let mut free = sticking(axis(1.0, 0.0, inertia), friction);
        let mut sprung = sticking(axis(1.0, 40.0, inertia), friction);
        for side in [-1.0, 1.0] {
            let (held, enough) = (side * breakaway, side * breakaway * (1.0 + 4.0 * f64::EPSILON));
            // A load and an input pull alike; the torque of an input is k J.
            for (within, beyond) in
                [([0.0, -held], [0.0, -enough]), ([held / inertia, 0.0], [enough / inertia, 0.0])]
            {
                let state = vector![0.7, 0.0];
                assert_eq!(free.advance(&state, &within.into(), 1.0), Ok(state));
                let moved = free.advance(&state, &beyond.into(), 1.0).expect("valid");
                assert!(side * moved[1] > 0.0, "{moved}");
            }
            // A spring of 10 N m/rad pulls at what is out of the middle.
            let state = vector![side * 0.0999 * breakaway, 0.0];
            assert_eq!(sprung.advance(&state, &vector![0.0, 0.0], 1.0), Ok(state));
            let beyond = state * 1.002;
            let moved = sprung.advance(&beyond, &vector![0.0, 0.0], 1.0).expect("valid");
            assert!(side * (moved[0] - beyond[0]) < 0.0, "{moved}");
        }
    }
}

#[test]
fn a_drive_that_creeps_sticks_until_its_spring_pulls_enough() {
    // The motor turns at 0.02 rad/s, the screw follows through 10 N m/rad against 0.3 N m.
    let axis = BallScrewAxis::new(0.01, 0.05, 10.0).expect("valid");
    let friction = coulomb(0.1).with_stribeck(0.3, 0.05, 2.0).expect("valid");
    let mut stepper = StickSlip::new(axis, friction).expect("valid");
    let (mut state, mut sticks, mut was_at_rest) = (SVector::zeros(), Vec::new(), true);
    for k in 0..200_000_u32 {
        let time = f64::from(k) * 1e-4;
        state = stepper.advance(&state, &vector![0.02 * time, 0.0], 1e-4).expect("valid");
        let at_rest = state[1].abs() <= 0.0;
        if was_at_rest && !at_rest {
            sticks.push((time, state[0]));
        }
        was_at_rest = at_rest;
    }
    // Each time it breaks away when the motor is ahead by T_s / K, to the tick.
    assert!(sticks.len() > 5, "{sticks:?}");
    for (time, angle) in &sticks {
        let ahead = 0.02 * time - angle;
        assert!((ahead - 0.03).abs() <= 0.02 * 1e-4 + 1e-9, "{ahead}");
    }
}

/// A free axis pulled against Stribeck friction, as an ordinary differential equation while it goes one way.
fn sliding_oracle(
    axis: BallScrewAxis,
    friction: Friction,
    state: SVector<f64, 2>,
    input: f64,
    time: f64,
) -> SVector<f64, 2> {
    let plant = move |x: &SVector<f64, 2>, u: &SVector<f64, 1>| {
        let torque = axis.torque_gain() * u[0] - friction.torque(x[1]);
        vector![x[1], torque / axis.inertia() - axis.a() * x[1] - axis.b() * x[0]]
    };
    DormandPrince::new(plant, Tolerance::new(1e-13, 1e-13).expect("valid"))
        .advance(&state, &vector![input], time)
        .expect("converges")
}

#[test]
fn stribeck_slides_are_of_order_two() {
    for exponent in [1.0, 1.5, 2.0] {
        let axis = axis(2.0, 5.0, 0.5);
        let friction =
            coulomb(1.0).with_viscous(0.1).and_then(|f| f.with_stribeck(2.0, 0.5, exponent)).expect("valid");
        let (start, input, time) = (vector![0.1, 0.2], 8.0, 0.4);
        let truth = sliding_oracle(axis, friction, start, input, time);
        let error = |steps: u32| {
            let mut stepper = sticking(axis, friction);
            let mut state = start;
            for _ in 0..steps {
                let length = time / f64::from(steps);
                state = stepper.advance(&state, &vector![input, 0.0], length).expect("valid");
            }
            (state - truth).norm()
        };
        // Steps no longer than a substep would be, so that each is one.
        for steps in [100, 200, 400] {
            let ratio = error(steps) / error(2 * steps);
            assert!((ratio / 4.0 - 1.0).abs() < 0.05, "{ratio} {exponent}");
        }
        // One long step is divided, to a ten thousandth.
        assert!(error(1) < 1e-4 * truth.norm(), "{} {exponent}", error(1));
    }
}

#[test]
fn a_narrow_regularisation_tends_to_it() {
    let axis = axis(1.0, 30.0, 0.5);
    let friction = coulomb(0.8).with_stribeck(1.2, 0.2, 2.0).expect("valid");
    let input = |k: u32| vector![3.0 * (0.07 * f64::from(k)).sin(), 0.0];
    let mut exact = sticking(axis, friction);
    let mut worst = Vec::new();
    for width in [4e-3, 1e-3, 2.5e-4] {
        let smooth = move |x: &SVector<f64, 2>, u: &SVector<f64, 2>| {
            // The dry part at the speed, turned on over a width.
            let dry = friction.torque(x[1].abs().max(1e-300)) * (x[1] / width).tanh();
            vector![x[1], u[0] - dry / axis.inertia() - axis.a() * x[1] - axis.b() * x[0]]
        };
        let mut oracle = DormandPrince::new(smooth, Tolerance::new(1e-9, 1e-9).expect("valid"));
        let (mut x, mut y, mut error) = (vector![0.3, 0.0], vector![0.3, 0.0], 0.0_f64);
        for k in 0..300 {
            x = exact.advance(&x, &input(k), 1e-2).expect("valid");
            y = oracle.advance(&y, &input(k), 1e-2).expect("valid");
            error = error.max((x - y).norm());
        }
        worst.push(error);
    }
    // First order in the width, down to the substeps of the exact one.
    assert!(worst[2] < 0.4 * worst[1] && worst[1] < 0.4 * worst[0] && worst[2] < 2e-3, "{worst:?}");
}

fn frictions() -> impl Strategy<Value = Friction> {
    (
        0.0..3.0_f64,
        prop_oneof![Just(0.0), 0.0..0.5_f64],
        prop_oneof![Just(0.0), 0.01..2.0_f64],
        0.01..1.0_f64,
        1.0..3.0_f64,
    )
        .prop_map(|(torque, viscous, excess, speed, exponent)| {
            coulomb(torque)
                .with_viscous(viscous)
                .and_then(|f| f.with_stribeck(torque + excess, speed, exponent))
                .expect("valid")
        })
}

proptest! {
    #[test]
    fn the_energy_closes_to_rounding_and_steps_are_the_same(
        friction in frictions(), a in 0.0..20.0_f64, b in prop_oneof![Just(0.0), 0.0..2e3_f64],
        log_inertia in -2.0..1.0_f64, frequency in 1.0..60.0_f64,
    ) {
        const STEPS: u32 = 1000;
        let axis = axis(a, b, 10_f64.powf(log_inertia));
        let mut plain = sticking(axis, friction);
        let mut metered = plain.clone().metered();
        let (mut x, mut y) = (vector![0.2, -1.0], vector![0.2, -1.0]);
        let mut size = 0.0;
        for k in 0..STEPS {
            let time = 1e-3 * f64::from(k);
            let torque = 4.0 * (frequency * time).sin();
            let input = vector![torque / axis.torque_gain(), 0.5 * (31.0 * time).cos()];
            // Three lengths in turn, as a split step has them.
            let interval = [1e-3, 0.3e-3, 1.7e-3][k as usize % 3];
            let before = y;
            x = plain.advance(&x, &input, interval).expect("valid");
            y = metered.advance(&y, &input, interval).expect("valid");
            prop_assert_eq!(x, y);
            prop_assert!(x.iter().all(|x| x.is_finite()));
            // What is added and taken in a step, which rounds.
            size += (torque * (y - before)[0]).abs() + plants::Energetic::stored(&axis, &y);
        }
        let ledger = metered.ledger();
        prop_assert!(ledger.dissipated >= 0.0);
        // Ten roundings for each step, and those of quadrature at half a radian, 4e-13.
        let tolerance = 10.0 * f64::EPSILON * size + 4e-13 * ledger.dissipated;
        prop_assert!(ledger.imbalance().abs() <= tolerance, "{} > {} {:?}", ledger.imbalance(), tolerance, ledger);
    }

    #[test]
    fn coulomb_steps_add_up(
        torque in 0.0..3.0_f64, a in 0.0..20.0_f64, b in prop_oneof![Just(0.0), 0.0..2e3_f64],
        angle in -1.0..1.0_f64, speed in -3.0..3.0_f64, input in -5.0..5.0_f64, part in 0.01..0.99_f64,
    ) {
        let mut stepper = sticking(axis(a, b, 1.0), coulomb(torque));
        let (start, input, interval) = (vector![angle, speed], vector![input, 0.0], 0.05);
        let whole = stepper.advance(&start, &input, interval).expect("valid");
        let half = stepper.advance(&start, &input, part * interval).expect("valid");
        let parts = stepper.advance(&half, &input, (1.0 - part) * interval).expect("valid");
        // At a reversal the position is flat in the time of the stop, whose rounding costs no more than others.
        let size = 1.0 + angle.abs() * (1.0 + b.sqrt()) + speed.abs();
        prop_assert!((whole - parts).norm() <= 1e-13 * size, "{whole} {parts}");
        // Dry friction never adds energy to an axis that is left alone.
        let alone = stepper.advance(&start, &vector![0.0, 0.0], interval).expect("valid");
        let energy = |x: &SVector<f64, 2>| 0.5 * (x[1] * x[1] + b * x[0] * x[0]);
        prop_assert!(energy(&alone) <= energy(&start) * (1.0 + 1e-14));
    }

    #[test]
    fn without_dry_friction_it_is_the_linear_axis_to_the_bit(
        a in 0.0..20.0_f64, b in 0.0..2e3_f64, viscous in prop_oneof![Just(0.0), 0.0..2.0_f64],
        state in prop::array::uniform2(-1.0..1.0_f64), input in prop::array::uniform2(-3.0..3.0_f64),
    ) {
        let friction = Friction::none().with_viscous(viscous).expect("valid");
        let mut stick = sticking(axis(a, b, 2.0), friction);
        let mut linear = ZeroOrderHold::new(axis(a + viscous * 0.5, b, 2.0));
        let (state, input) = (state.into(), input.into());
        prop_assert_eq!(stick.advance(&state, &input, 1e-3), linear.advance(&state, &input, 1e-3));
    }
}

#[test]
fn the_torque_by_hand_and_its_steepest_fall() {
    let friction =
        coulomb(2.0).with_viscous(0.5).and_then(|f| f.with_stribeck(3.0, 0.1, 2.0)).expect("valid");
    for (speed, ratio) in [(0.05_f64, 0.25_f64), (0.1, 1.0), (-0.3, 9.0)] {
        let expected = (2.0 + (-ratio).exp()).copysign(speed) + 0.5 * speed;
        assert!((friction.torque(speed) - expected).abs() < 1e-15);
    }
    assert!(friction.torque(0.0).abs() <= 0.0);
}

#[test]
fn bad_numbers_are_errors() {
    assert!(Friction::coulomb(-1.0).is_err() && Friction::coulomb(f64::NAN).is_err());
    let friction = coulomb(2.0);
    assert!(friction.with_viscous(-0.1).is_err());
    for (breakaway, speed, exponent) in
        [(1.9, 1.0, 2.0), (f64::INFINITY, 1.0, 2.0), (3.0, 0.0, 2.0), (3.0, 1.0, 0.5), (3.0, 1.0, f64::NAN)]
    {
        assert!(friction.with_stribeck(breakaway, speed, exponent).is_err());
    }
    assert!(StickSlip::new(axis(1.0, 1.0, 1e-300), friction.with_viscous(1e100).expect("valid")).is_err());
    let mut stepper = sticking(axis(1.0, 1.0, 1.0), friction);
    for interval in [-1.0, f64::NAN, f64::INFINITY] {
        let result = stepper.advance(&vector![0.0, 1.0], &vector![0.0, 0.0], interval);
        assert!(matches!(result, Err(StepError::Interval(_))));
    }
    assert_eq!(stepper.advance(&vector![0.5, 1.0], &vector![9.0, 0.0], 0.0), Ok(vector![0.5, 1.0]));
    let mut stiff = sticking(axis(1e9, 0.0, 1.0), friction);
    let result = stiff.advance(&vector![0.0, 1.0], &vector![0.0, 0.0], 1.0);
    assert!(matches!(result, Err(StepError::Substeps { .. })));
}
