//! Ball-screw axes against closed forms, and their energy.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use plants::nalgebra::{SVector, vector};
use plants::{
    BallScrewAxis, Clock, ControlTick, Disturbance, DormandPrince, Energetic, HeldLinear, Plant, Simulation,
    Stepper, Tolerance, ZeroOrderHold, eigenvalues,
};
use proptest::prelude::*;

#[test]
fn the_transition_in_closed_form() {
    let t = 0.3;
    for (a, b) in [(10.0, 1.0), (1.0, 40.0), (0.0, 25.0), (3.0, 0.0), (20.0, 0.5)] {
        let axis = BallScrewAxis::from_coefficients(a, b, 2.0).expect("valid");
        let hold = axis.transition(t).expect("finite");
        // The impulse response s(t) by the poles, its integral g by the equation itself where b is not zero.
        let discriminant: f64 = 0.25 * a * a - b;
        let (w, decay) = (discriminant.abs().sqrt(), (-0.5 * a * t).exp());
        let (s, c) = if discriminant > 0.0 {
            (decay * (w * t).sinh() / w, decay * (w * t).cosh())
        } else {
            (decay * (w * t).sin() / w, decay * (w * t).cos())
        };
        let g = if b > 0.0 { (1.0 - c - 0.5 * a * s) / b } else { (t - s) / a };
        let expected = [[1.0 - b * g, s, 2.0 * g, -g], [-b * s, c - 0.5 * a * s, 2.0 * s, -s]];
        for (row, expected) in expected.iter().enumerate() {
            let got =
                [hold.state[(row, 0)], hold.state[(row, 1)], hold.input[(row, 0)], hold.input[(row, 1)]];
            for (x, y) in got.iter().zip(expected) {
                // The hyperbolic functions cancel down to e^(-a t) = 1/400, and g to b t^2 / 2.
                assert!((x - y).abs() <= 1e-12 * y.abs().max(1e-3), "{x} {y} {a} {b}");
            }
        }
    }
}

#[test]
fn both_forms_are_one_axis() {
    let (inertia, damping, stiffness) = (0.25, 2.0, 8.0);
    let axis = BallScrewAxis::new(inertia, damping, stiffness).expect("valid");
    let other = BallScrewAxis::from_coefficients(8.0, 32.0, 32.0).and_then(|a| a.with_inertia(0.25));
    assert_eq!(Ok(axis), other);
    assert_eq!((axis.damping(), axis.stiffness(), axis.torque_gain()), (damping, stiffness, stiffness));
    // J theta'' + f theta' + K theta = K theta_M - M, with numbers.
    let (angle, speed, motor, load) = (0.5, -3.0, 0.75, 1.5);
    let torque = stiffness * motor - load - damping * speed - stiffness * angle;
    let derivative = axis.derivative(&vector![angle, speed], &vector![motor, load]);
    assert_eq!(derivative, vector![speed, torque / inertia]);
    // At rest the screw is behind the motor by M / K, eq. (2) at s = 0.
    let rest = axis.transition(1e3).expect("stable").apply(&SVector::zeros(), &vector![motor, load]);
    assert!((rest - vector![motor - load / stiffness, 0.0]).norm() < 1e-13);
    // The poles are the roots of s^2 + a s + b.
    for root in eigenvalues(axis.state_space().expect("finite").a()).expect("converges") {
        assert!((root * root + root * 8.0 + 32.0).norm() < 1e-13 * 32.0);
    }
}

#[test]
fn the_exact_step_is_the_limit_of_an_adaptive_one() {
    let axis = BallScrewAxis::from_coefficients(10.0, 200.0, 3.0).and_then(|a| a.with_inertia(0.4));
    let axis = axis.expect("valid");
    let tolerance = Tolerance::new(1e-12, 1e-12).expect("valid");
    let mut adaptive = DormandPrince::new(axis, tolerance);
    let (state, input) = (vector![0.3, -2.0], vector![1.5, 0.7]);
    for interval in [1e-4, 0.05, 1.0] {
        let exact = axis.transition(interval).expect("finite").apply(&state, &input);
        let stepped = adaptive.advance(&state, &input, interval).expect("converges");
        // A thousand tolerances at most, on numbers of the order of ten.
        assert!((exact - stepped).norm() < 1e-8, "{}", (exact - stepped).norm());
    }
}

fn axes() -> impl Strategy<Value = BallScrewAxis> {
    (0.0..20.0_f64, prop_oneof![Just(0.0), 0.0..1e4_f64], 0.1..50.0_f64, -3.0..3.0_f64).prop_map(
        |(a, b, k, log_inertia)| {
            BallScrewAxis::from_coefficients(a, b, k)
                .and_then(|axis| axis.with_inertia(10_f64.powf(log_inertia)))
                .expect("valid")
        },
    )
}

proptest! {
    #[test]
    fn the_equations_conserve_energy(
        axis in axes(), angle in -1.0..1.0_f64, speed in -5.0..5.0_f64, input in -2.0..2.0_f64,
        acceleration in -2.0..2.0_f64,
    ) {
        let (state, input) = (vector![angle, speed], vector![input, acceleration * axis.inertia()]);
        let rate = axis.derivative(&state, &input);
        // The gradient of the stored energy, by hand.
        let growth = axis.inertia() * speed * rate[1] + axis.stiffness() * angle * rate[0];
        let powers = axis.powers(&state, &input);
        let size = powers.input.abs() + powers.dissipated + powers.delivered.abs()
            + axis.inertia() * (speed * rate[1]).abs() + (axis.stiffness() * angle * speed).abs();
        prop_assert!((growth - powers.net()).abs() <= 8.0 * f64::EPSILON * size);
        prop_assert!(powers.dissipated >= 0.0 && axis.stored(&state) >= 0.0);
    }

    #[test]
    fn the_ledger_closes_to_rounding(axis in axes(), interval in 1e-5..1e-3_f64) {
        const STEPS: u32 = 2000;
        let mut stepper = ZeroOrderHold::new(axis).metered();
        let mut state = vector![0.1, 0.0];
        for k in 0..STEPS {
            let t = f64::from(k) * interval;
            let input = vector![(300.0 * t).sin() + 0.2, 0.3 * axis.inertia() * (170.0 * t).cos()];
            state = stepper.advance(&state, &input, interval).expect("finite");
        }
        let ledger = stepper.ledger();
        // The rounding of a transition is the same in every step and adds up; the energy at the start counts too.
        let size = ledger.input.abs() + ledger.dissipated + ledger.stored.abs() + axis.stored(&vector![0.1, 0.0]);
        let tolerance = 4.0 * f64::from(STEPS) * f64::EPSILON * size;
        prop_assert!(ledger.imbalance().abs() <= tolerance, "{} {:?}", ledger.imbalance(), ledger);
    }
}

/// The integral of time times the squared error of the paper's PID loop on one axis, over all and over the last third.
#[test]
fn the_papers_loop_has_its_printed_figures() {
    let axis = BallScrewAxis::from_coefficients(10.0, 1.0, 1.0).expect("valid");
    let clock = Clock::from_frequency(10_000).expect("valid");
    let (period, filter) = (1e-4, 0.01);
    // The printed figures are those of a load that drives the axis, against the sign of eq. (1).
    let load = Disturbance::step(10.0, -10.0).expect("finite");
    let recording = Simulation::new(clock, 150_000)
        .disturbances([Disturbance::none(), load])
        .run(
            &mut ZeroOrderHold::new(axis),
            vector![1.0, 0.0],
            // Integral, filtered derivative, last error: all start at zero, so that the derivative kicks.
            &mut (0.0, 0.0, 0.0),
            |(integral, derivative, last), tick: &ControlTick<'_, 2, 2>| {
                let error = tick.time.sin() - tick.state[0];
                *integral += error * period;
                *derivative += (error - *last - period * *derivative) / (filter + period);
                *last = error;
                vector![600.0 * error + *integral + 10.0 * *derivative, 0.0]
            },
            [("error", "rad")],
            |_, probe| [probe.time.sin() - probe.state[0]],
        )
        .expect("valid")
        .completed()
        .expect("stable");
    let error = recording.column("error").expect("recorded");
    let itse =
        |from: usize| -> f64 { (from..150_000).map(|n| n as f64 * 1e-4 * error[n] * error[n] * 1e-4).sum() };
    // Table 1 prints 0.024180 and 0.015390 without sample time or solver; to a part in a thousand of them.
    assert!((itse(0) / 0.024180 - 1.0).abs() < 1e-3, "{}", itse(0));
    assert!((itse(100_000) / 0.015390 - 1.0).abs() < 1e-3, "{}", itse(100_000));
}

#[test]
fn bad_numbers_are_errors() {
    assert!(BallScrewAxis::new(0.0, 1.0, 1.0).is_err());
    assert!(BallScrewAxis::new(1.0, -1.0, 1.0).is_err());
    assert!(BallScrewAxis::new(1.0, 1.0, 0.0).is_err());
    assert!(BallScrewAxis::new(1e-300, 1.0, 1e100).is_err());
    assert!(BallScrewAxis::from_coefficients(f64::NAN, 1.0, 1.0).is_err());
    assert!(BallScrewAxis::from_coefficients(1.0, 1.0, 0.0).is_err());
    let axis = BallScrewAxis::from_coefficients(1.0, 1e200, 1.0).expect("valid");
    assert!(axis.with_inertia(1e200).is_err() && axis.with_inertia(-1.0).is_err());
    assert!(axis.transition(-1.0).is_err());
}
