//! Drives against closed forms and conservation laws.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use plants::nalgebra::{SVector, vector};
use plants::{
    DormandPrince, HeldLinear, LinearMotor, ModelError, Plant, Pmsm, PmsmDrive, PmsmWindings, Rk4, Stepper,
    Tolerance, TwoInertia, ZeroOrderHold,
};
use proptest::prelude::*;

fn undamped() -> TwoInertia {
    TwoInertia::new(0.003, 5.066e-4, 100.0).expect("valid")
}

fn servo() -> PmsmWindings {
    PmsmWindings::surface(2.875, 8.5e-3, 0.175, 3).expect("valid")
}

fn salient() -> PmsmWindings {
    PmsmWindings::new(1.2, 6e-3, 15e-3, 0.12, 4).expect("valid")
}

#[test]
fn a_released_spring_in_closed_form() {
    let (c, phi0) = (0.05, 0.02);
    let axis = undamped().with_damping(0.0, c, 0.0).expect("valid");
    let mode = axis.free_mode().expect("vibrates");
    let (decay, wd) = (-mode.pole().re, mode.pole().im);
    let mut stepper = ZeroOrderHold::new(axis);
    let total = axis.motor_inertia() + axis.load_inertia();
    let mut state = vector![phi0, 0.0, 0.0, 0.0];
    for k in 1..=500 {
        state = stepper.advance(&state, &vector![0.0, 0.0], 1e-4).expect("finite");
        let t = 1e-4 * f64::from(k);
        let twist = phi0 * (-decay * t).exp() * ((wd * t).cos() + decay / wd * (wd * t).sin());
        // The centre of gravity stays where it was: both ends follow from the twist.
        let centre = phi0 * axis.motor_inertia() / total;
        let expected =
            [centre + twist * axis.load_inertia() / total, centre - twist * axis.motor_inertia() / total];
        // Five hundred products of a matrix exact to 4e-14.
        assert!((state[0] - expected[0]).abs() < 1e-12 * phi0, "{t}: {} {}", state[0], expected[0]);
        assert!((state[2] - expected[1]).abs() < 1e-12 * phi0, "{t}: {} {}", state[2], expected[1]);
    }
}

#[test]
fn momentum_without_damping_is_the_torque_over_time() {
    let axis = undamped();
    let mut stepper = ZeroOrderHold::new(axis);
    let (mut state, mut impulse) = (vector![0.0, 2.0, 0.0, -1.0], 0.003 * 2.0 - 5.066e-4);
    let mut spring = 0.0_f64;
    for k in 0..2000 {
        let input = vector![f64::from(k % 13) - 5.0, f64::from(k % 7) - 3.0];
        impulse += (input[0] - input[1]) * 1e-4;
        state = stepper.advance(&state, &input, 1e-4).expect("finite");
        spring = spring.max(axis.spring_torque(&state).abs());
        let momentum = axis.motor_inertia() * state[1] + axis.load_inertia() * state[3];
        // Two thousand steps; the vibration carries up to 0.3 N m s within.
        assert!((momentum - impulse).abs() < 1e-12, "{momentum} {impulse}");
    }
    assert!(spring > 0.1, "{spring}");
}

#[test]
fn a_rigid_spring_makes_one_inertia() {
    let (motor, load) = (0.003, 5.066e-4);
    // As a rotation in rad, kg m^2 and N m s/rad.
    let rigid = LinearMotor::new(motor + load, 0.008 + 0.004).expect("valid");
    let torque = |k: u32| f64::from(k % 10) - 4.0;
    let mut difference = [1e4, 1e6].map(|stiffness| {
        let axis = TwoInertia::new(motor, load, stiffness)
            .and_then(|a| a.with_damping(0.008, 1.0, 0.004))
            .expect("valid");
        let (mut flexible, mut whole) = (ZeroOrderHold::new(axis), ZeroOrderHold::new(rigid));
        let (mut x, mut y) = (vector![0.0, 0.0, 0.0, 0.0], vector![0.0, 0.0]);
        for k in 0..200 {
            x = flexible.advance(&x, &vector![torque(k), 0.5], 1e-3).expect("finite");
            y = whole.advance(&y, &vector![torque(k) - 0.5], 1e-3).expect("finite");
        }
        assert!(y[0].abs() > 0.1);
        (x[0] - y[0]).abs().max((x[2] - y[0]).abs())
    });
    // The twist is the torque of the load over the stiffness.
    assert!(difference[0] < 5.0 / 1e4, "{difference:?}");
    difference[0] /= 100.0;
    assert!(difference[1] < 5.0 / 1e6 && difference[1] < 1.1 * difference[0], "{difference:?}");
}

#[test]
fn the_exact_step_is_the_limit_of_small_ones() {
    let axis = undamped().with_damping(0.008, 0.006, 0.002).expect("valid");
    let (mut exact, mut small) = (ZeroOrderHold::new(axis), Rk4::fixed(axis, 50, 0.0).expect("valid"));
    let (mut x, mut y) = (vector![0.0, 1.0, 0.01, 0.0], vector![0.0, 1.0, 0.01, 0.0]);
    for k in 0..200 {
        let input = vector![f64::from(k % 7) - 3.0, 0.2];
        x = exact.advance(&x, &input, 1e-3).expect("finite");
        y = small.advance(&y, &input, 1e-3).expect("finite");
        // w h = 0.01: (w h)^5 / 120 a step of ten thousand.
        assert!((x - y).amax() < 1e-8 * (1.0 + x.amax()), "{k}: {}", (x - y).amax());
    }
}

#[test]
fn a_locked_rotor_follows_the_exponential_of_its_windings() {
    // A rotor too heavy to move.
    let motor = Pmsm::new(salient(), 1e15).expect("valid");
    let mut stepper = Rk4::fixed(motor, 20, 0.0).expect("valid");
    let (v_d, v_q) = (5.0, -12.0);
    let mut state = vector![0.0, 0.0, 0.0, 0.0];
    for k in 1..=300 {
        state = stepper.advance(&state, &vector![v_d, v_q, 0.0], 1e-4).expect("stable");
        let t = 1e-4 * f64::from(k);
        let current = |v: f64, l: f64| v / 1.2 * (1.0 - (-1.2 / l * t).exp());
        // R h / L = 1e-3: rounding of six thousand steps is what remains.
        assert!((state[0] - current(v_d, 6e-3)).abs() < 1e-11, "{} at {t}", state[0]);
        assert!((state[1] - current(v_q, 15e-3)).abs() < 1e-11, "{} at {t}", state[1]);
    }
}

#[test]
fn a_steady_motor_obeys_its_closed_form() {
    // v_d = R i_d - p w L_q i_q, v_q = R i_q + p w (L_d i_d + psi), 1.5 p (psi + (L_d - L_q) i_d) i_q = b w + T_l.
    let (friction, load, speed, i_d) = (0.02, 1.5, 40.0, -3.0);
    let i_q = (friction * speed + load) / (6.0 * (0.12 - 9e-3 * i_d));
    let electric = 4.0 * speed;
    let v_d = 1.2 * i_d - electric * 15e-3 * i_q;
    let v_q = 1.2 * i_q + electric * (6e-3 * i_d + 0.12);
    let motor = Pmsm::new(salient(), 0.002).and_then(|m| m.with_friction(friction)).expect("valid");
    let steady = vector![i_d, i_q, 0.7, speed];
    let rest = motor.derivative(&steady, &vector![v_d, v_q, load]);
    // Volts of order ten over millihenries, N m over g m^2: a few roundings each.
    assert!((rest - vector![0.0, 0.0, speed, 0.0]).norm() < 1e-11, "{rest}");
    assert!((motor.windings().torque(i_d, i_q) - friction * speed - load).abs() < 1e-15 * 10.0);

    // And finds it from rest.
    let mut stepper = Rk4::accurate(motor, 600.0).expect("valid");
    let mut state = vector![0.0, 0.0, 0.0, 0.0];
    for _ in 0..2000 {
        state = stepper.advance(&state, &vector![v_d, v_q, load], 1e-3).expect("stable");
    }
    let near = (state - steady).fixed_rows::<2>(0).norm() + (state[3] - speed).abs();
    assert!(near < 1e-9, "{state}");
}

#[test]
fn a_motor_that_turns_feels_its_back_emf() {
    let motor = Pmsm::new(servo(), 0.003).expect("valid");
    let spinning = motor.derivative(&vector![0.0, 0.0, 0.0, 100.0], &vector![0.0, 0.0, 0.0]);
    assert!((spinning[1] * 8.5e-3 + servo().back_emf(100.0)).abs() < 1e-12);
    // At the voltage of its back-EMF it idles.
    let idle = motor.derivative(&vector![0.0, 0.0, 0.0, 100.0], &vector![0.0, servo().back_emf(100.0), 0.0]);
    assert!((idle - vector![0.0, 0.0, 100.0, 0.0]).norm() < 1e-11);
}

#[test]
fn the_inverter_shortens_a_long_vector() {
    let limited = servo().with_voltage_limit(10.0).expect("valid");
    let motor = Pmsm::new(limited, 0.003).expect("valid");
    let drive = PmsmDrive::new(limited, undamped());
    let (long, short) = (vector![12.0, 16.0, 3.0], vector![6.0, 8.0, 3.0]);
    assert_eq!(motor.realised(&long), short);
    assert_eq!(drive.realised(&short), short);
    assert_eq!(motor.saturation().apply(&long), short);
    let (x, y) = (vector![1.0, 2.0, 0.0, 30.0], vector![1.0, 2.0, 0.0, 30.0, 0.1, 20.0]);
    assert_eq!(motor.derivative(&x, &long), motor.derivative(&x, &short));
    assert_eq!(drive.derivative(&y, &long), drive.derivative(&y, &short));
    let huge = motor.derivative(&x, &vector![1e300, 0.0, 0.0]);
    assert!((huge - motor.derivative(&x, &vector![10.0, 0.0, 0.0])).norm() <= 0.0);
    // Without a limit nothing is lost.
    assert!(Pmsm::new(servo(), 0.003).expect("valid").realised(&(long * 1e6)) == long * 1e6);
}

proptest! {
    #[test]
    fn a_drive_is_its_motor_on_its_mechanics(
        state in prop::array::uniform6(-20.0..20.0), input in prop::array::uniform3(-300.0..300.0)
    ) {
        let (x, u) = (SVector::from(state), SVector::from(input));
        let motor = Pmsm::new(salient(), 0.002).and_then(|m| m.with_friction(0.01)).expect("valid");
        let drive = motor.coupled_with_damping(5e-4, 80.0, 0.01, 0.002).expect("valid");
        let whole = drive.derivative(&x, &u);
        // The motor feels the spring as its load; the mechanics feel the torque.
        let spring = drive.mechanics().spring_torque(&drive.mechanical_state(&x));
        let alone = motor.derivative(&vector![x[0], x[1], x[2], x[3]], &vector![u[0], u[1], spring]);
        let torque = motor.windings().torque(x[0], x[1]);
        let moved = drive.mechanics().derivative(&drive.mechanical_state(&x), &vector![torque, u[2]]);
        prop_assert!((whole.fixed_rows::<4>(0) - alone).norm() <= 1e-13 * whole.norm());
        prop_assert!((whole.fixed_rows::<4>(2) - moved).norm() <= 1e-15 * whole.norm());
    }
}

#[test]
fn two_methods_agree_on_a_drive() {
    let windings = salient().with_voltage_limit(40.0).expect("valid");
    let drive = PmsmDrive::new(windings, undamped().with_damping(0.008, 0.006, 0.002).expect("valid"));
    let tolerance = Tolerance::new(1e-10, 1e-10).expect("valid");
    let mut adaptive = DormandPrince::new(drive, tolerance);
    // The vibration is the fastest pole, 483 rad/s; steps of 0.12 over it.
    let mut fixed = Rk4::accurate(drive, 500.0).expect("valid");
    let (mut x, mut y) = (SVector::<f64, 6>::zeros(), SVector::<f64, 6>::zeros());
    for k in 0..200 {
        let input = vector![f64::from(k % 5) - 2.0, 30.0 * (0.1 * f64::from(k)).cos() + 15.0, 0.3];
        x = adaptive.advance(&x, &input, 1e-3).expect("regular");
        y = fixed.advance(&y, &input, 1e-3).expect("stable");
        // 0.12^4 / 120 for every radian that the windings remember, on up to 50 rad/s.
        assert!((x - y).amax() < 1e-4, "{k}: {}", (x - y).amax());
    }
    assert!(x[3].abs() > 1.0, "{x}");
}

#[test]
fn bad_parameters_are_named() {
    fn value<T: std::fmt::Debug>(result: Result<T, ModelError>) -> (&'static str, f64) {
        match result.expect_err("a bad number") {
            ModelError::Parameter { parameter, value, .. } => (parameter, value),
            other => panic!("{other}"),
        }
    }
    assert_eq!(value(TwoInertia::new(0.0, 1.0, 1.0)), ("the motor inertia in kg m^2", 0.0));
    assert_eq!(value(TwoInertia::new(1.0, -2.0, 1.0)), ("the load inertia in kg m^2", -2.0));
    assert_eq!(value(TwoInertia::new(1.0, 1.0, -3.0)), ("the stiffness in N m/rad", -3.0));
    assert_eq!(value(TwoInertia::new(1e-300, 1.0, 1e300)).0, "the stiffness over the inertias in 1/s^2");
    assert_eq!(value(undamped().with_damping(-1.0, 0.0, 0.0)), ("the motor damping in N m s/rad", -1.0));
    assert_eq!(value(undamped().with_damping(0.0, -1.0, 0.0)), ("the spring damping in N m s/rad", -1.0));
    assert_eq!(value(undamped().with_damping(0.0, 0.0, -1.0)), ("the load damping in N m s/rad", -1.0));
    assert_eq!(value(undamped().with_damping(1e308, 0.0, 0.0)).0, "the damping over the inertias in 1/s");
    assert!(value(undamped().with_damping(f64::NAN, 0.0, 0.0)).1.is_nan());
    assert_eq!(value(PmsmWindings::new(-1.0, 1.0, 1.0, 1.0, 1)), ("the resistance in ohm", -1.0));
    assert_eq!(value(PmsmWindings::new(1.0, 0.0, 1.0, 1.0, 1)), ("the d inductance in H", 0.0));
    assert_eq!(value(PmsmWindings::new(1.0, 1.0, -1.0, 1.0, 1)), ("the q inductance in H", -1.0));
    assert_eq!(value(PmsmWindings::new(1.0, 1.0, 1.0, -0.1, 1)), ("the flux linkage in Wb", -0.1));
    assert_eq!(value(PmsmWindings::new(1.0, 1.0, 1.0, 1.0, 0)), ("the number of pole pairs", 0.0));
    assert_eq!(value(servo().with_voltage_limit(0.0)), ("the voltage limit in V", 0.0));
    assert_eq!(value(Pmsm::new(servo(), -0.5)), ("the rotor inertia in kg m^2", -0.5));
    let motor = Pmsm::new(servo(), 1.0).expect("valid");
    assert_eq!(value(motor.with_friction(-0.5)), ("the friction in N m s/rad", -0.5));
    assert_eq!(value(motor.coupled(0.0, 1.0)), ("the load inertia in kg m^2", 0.0));
    assert_eq!(value(undamped().transition(-1.0)), ("the interval in s", -1.0));
}
