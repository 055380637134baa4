//! Field-oriented control: its parts, its phases, and a motor.
#![expect(clippy::expect_used, reason = "a helper that fails fails its test")]

use control::{
    AntiWindup, Cascade, CascadeInput, CascadeState, CurrentInput, CurrentLoop, CurrentLoopState,
    CurrentStatus, Dq, Feedforward, FieldOriented, FieldOrientedError, FieldOrientedInput,
    FieldOrientedState, Phases, PiGains, Rotation, Status, Windings,
};
use profiles::Sample;
use proptest::prelude::*;

const PERIOD: f64 = 1e-4;
const WINDINGS: Windings =
    Windings { resistance: 2.875, d_inductance: 8.5e-3, q_inductance: 8.5e-3, flux: 0.175 };
const POLE_PAIRS: f64 = 3.0;
/// `1.5 p psi`, N m/A.
const TORQUE_CONSTANT: f64 = 1.5 * POLE_PAIRS * 0.175;
const INERTIA: f64 = 4e-3;

fn cascade() -> Cascade {
    let feedforward = Feedforward::NONE.with_acceleration(INERTIA / TORQUE_CONSTANT).expect("valid");
    Cascade::new(180.0, PiGains { kp: 2.3, ki: 33.0 }, PERIOD)
        .and_then(|c| c.with_divisors(10, 2))
        .and_then(|c| c.with_velocity_feedforward(1.0))
        .and_then(|c| c.with_current_limit(20.0))
        .expect("valid")
        .with_feedforward(feedforward)
}

fn current_loop(limit: f64) -> CurrentLoop {
    CurrentLoop::tuned(WINDINGS, 1970.0, PERIOD).and_then(|l| l.with_voltage_limit(limit)).expect("valid")
}

fn servo(limit: f64) -> FieldOriented {
    FieldOriented::new(cascade(), current_loop(limit), 3).expect("valid")
}

/// A motor without load, in steps far below the base period.
#[derive(Debug, Clone, Copy, Default)]
struct Motor {
    current: Dq,
    velocity: f64,
    position: f64,
}

impl Motor {
    fn run(&mut self, v: Dq, load: f64) {
        let h = PERIOD / 50.0;
        for _ in 0..50 {
            let (Dq { d, q }, w) = (self.current, POLE_PAIRS * self.velocity);
            let Windings { resistance, d_inductance, q_inductance, flux } = WINDINGS;
            self.current.d += h * (v.d - resistance * d + w * q_inductance * q) / d_inductance;
            self.current.q += h * (v.q - resistance * q - w * (d_inductance * d + flux)) / q_inductance;
            self.velocity += h * (TORQUE_CONSTANT * q - load) / INERTIA;
            self.position += h * self.velocity;
        }
    }

    fn input(&self, reference: Sample) -> FieldOrientedInput {
        FieldOrientedInput::new(reference, self.position, self.velocity, self.current)
    }
}

/// Rest to rest over 1 rad in 0.2 s: `10 s^3 - 15 s^4 + 6 s^5`.
fn reference(t: f64) -> Sample {
    let (s, duration) = ((t / 0.2).min(1.0), 0.2_f64);
    Sample {
        position: s.powi(3) * (10.0 + s * (6.0 * s - 15.0)),
        velocity: 30.0 * (s * (1.0 - s)).powi(2) / duration,
        acceleration: 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) / duration.powi(2),
        ..Sample::default()
    }
}

#[test]
fn a_motor_follows_a_move_and_carries_a_load() {
    let servo = servo(180.0);
    let (mut state, mut motor) = (FieldOrientedState::new(), Motor::default());
    let (mut worst, mut worst_d) = (0.0_f64, 0.0_f64);
    for k in 0..12_000 {
        let t = f64::from(k) * PERIOD;
        if k % 10 == 0 && t < 0.3 {
            worst = worst.max((reference(t).position - motor.position).abs());
        }
        let output = servo.update(&mut state, motor.input(reference(t)));
        assert_eq!((output.cascade, output.current_loop), (Status::Regular, CurrentStatus::Regular));
        motor.run(output.voltage, if t < 0.3 { 0.0 } else { 1.5 });
        worst_d = worst_d.max(motor.current.d.abs());
    }
    // Held for 1 ms, the command of the position loop is half of that late: 0.5 ms times 144 rad/s^2 over 180 / s.
    assert!(worst < 4e-4, "{worst} rad");
    // The held voltage turns with the rotor by w h = 0.8 mrad of the 14 V and less that the move takes.
    assert!(worst_d < 5e-3, "{worst_d} A");
    // 0.9 s under load, of which 33 / 2.3 / s leave e^-13 of 5 mrad: the place, the current and the voltage of the load.
    let current = 1.5 / TORQUE_CONSTANT;
    assert!((motor.position - 1.0).abs() < 1e-6, "{} rad", motor.position);
    assert!((motor.current.q - current).abs() < 1e-5 * current, "{} A", motor.current.q);
    assert!((state.current_loop().output().q - 2.875 * current).abs() < 1e-3, "{state:?}");
}

#[test]
fn it_is_its_two_loops() {
    let servo = servo(180.0);
    let (mut state, mut outer, mut inner) =
        (FieldOrientedState::new(), CascadeState::new(), CurrentLoopState::new());
    let mut motor = Motor::default();
    for k in 0..500 {
        let reference = reference(f64::from(k) * PERIOD);
        let input = FieldOrientedInput { feedforward: 0.5, ..motor.input(reference) };
        let output = servo.update(&mut state, input);
        let wanted = cascade().update(
            &mut outer,
            CascadeInput { feedforward: 0.5, ..CascadeInput::new(reference, motor.position, motor.velocity) },
        );
        let given = current_loop(180.0).update(
            &mut inner,
            CurrentInput {
                reference: Dq { d: 0.0, q: wanted.current },
                current: motor.current,
                speed: 3.0 * motor.velocity,
                realised: None,
            },
        );
        assert_eq!((output.current, output.voltage), (wanted.current, given.voltage));
        motor.run(output.voltage, 0.0);
    }
    assert!(outer.integral() != 0.0 && inner.integral().q != 0.0);
}

/// Asked for 400 rad/s for a second, which 60 V do not allow, then for 50 rad/s for another: the lowest and
/// the last speed after that.
fn slowed_down(anti_windup: AntiWindup) -> (f64, f64) {
    let cascade = Cascade::new(0.0, PiGains { kp: 0.5, ki: 5.0 }, PERIOD)
        .and_then(|c| c.with_velocity_feedforward(1.0))
        .and_then(|c| c.with_current_limit(10.0))
        .and_then(|c| c.with_anti_windup(anti_windup))
        .expect("valid");
    let servo = FieldOriented::new(cascade, current_loop(60.0), 3).expect("valid");
    let (mut state, mut motor) = (FieldOrientedState::new(), Motor::default());
    let mut run = |velocity: f64, ticks: u32| {
        let mut lowest = f64::INFINITY;
        for _ in 0..ticks {
            let output = servo.update(&mut state, motor.input(Sample { velocity, ..Sample::default() }));
            motor.run(output.voltage, 0.0);
            lowest = lowest.min(motor.velocity);
        }
        (lowest, motor.velocity)
    };
    let (_, top) = run(400.0, 10_000);
    // w psi = 60 V
    assert!((top - 60.0 / 0.175 / 3.0).abs() < 1.0, "{top} rad/s");
    let (lowest, last) = run(50.0, 10_000);
    (lowest, last)
}

#[test]
fn the_velocity_loop_does_not_wind_up_at_the_voltage_limit() {
    let (lowest, last) = slowed_down(AntiWindup::Clamping);
    // The integral stood still. From the current limit, at e = 20 rad/s, e'' + 98 e' + 984 e = 0 falls 1.41 rad/s short
    // (its poles 11.3 and 87 / s), to the accuracy with which the current loop, 1970 rad/s, follows.
    assert!(
        (lowest - (50.0 - 1.41)).abs() < 0.1 && (last - 50.0).abs() < 1e-3,
        "{lowest}, then {last} rad/s"
    );
    // 285 rad/s short for a second is 1400 A, and 64 rad/s take them back in more than four.
    let (_, last) = slowed_down(AntiWindup::None);
    assert!(last > 100.0, "{last} rad/s");
}

/// 60 V allow 114 rad/s: asked for 120 for a second, within the current limit at last, then for 100.
#[test]
fn the_velocity_loop_goes_by_the_current_that_flows_while_the_voltage_falls_short() {
    let cascade = Cascade::new(0.0, PiGains { kp: 0.5, ki: 5.0 }, PERIOD)
        .and_then(|c| c.with_velocity_feedforward(1.0))
        .and_then(|c| c.with_current_limit(10.0))
        .expect("valid");
    let servo = FieldOriented::new(cascade, current_loop(60.0), 3).expect("valid");
    let (mut state, mut motor) = (FieldOrientedState::new(), Motor::default());
    let mut short_since = None;
    for _ in 0..10_000 {
        let output = servo.update(&mut state, motor.input(Sample { velocity: 120.0, ..Sample::default() }));
        motor.run(output.voltage, 0.0);
        if output.current_loop == CurrentStatus::Limited && motor.velocity > 100.0 && short_since.is_none() {
            short_since = Some(state.cascade().integral());
        }
    }
    // 2.9 A are asked for and none flows; left alone the integral would fill up the 10 A and take 0.3 s to empty.
    assert_eq!(short_since, Some(state.cascade().integral()));
    let mut lowest = f64::INFINITY;
    for _ in 0..1000 {
        let output = servo.update(&mut state, motor.input(Sample { velocity: 100.0, ..Sample::default() }));
        motor.run(output.voltage, 0.0);
        lowest = lowest.min(motor.velocity);
    }
    // From e = 14.3 rad/s the linear loop falls 0.0706 of it short, as in the test above.
    assert!((lowest - (100.0 - 0.0706 * 14.3)).abs() < 0.1, "{lowest} rad/s");
}

proptest! {
    #[test]
    fn phases_are_rotor_axes_seen_from_the_stator(
        currents in prop::array::uniform2(-10.0..10.0_f64), angles in prop::collection::vec(-4.0..4.0_f64, 1..20),
        velocity in -100.0..100.0_f64,
    ) {
        let servo = servo(180.0);
        let (mut in_phases, mut in_rotor_axes) = (FieldOrientedState::new(), FieldOrientedState::new());
        let currents = Phases { a: currents[0], b: currents[1], c: -currents[0] - currents[1] };
        for angle in angles {
            let rotor = Rotation::by(angle);
            let current = currents.to_dq(rotor);
            let input = FieldOrientedInput::new(Sample::default(), 0.0, velocity, current);
            let expected = servo.update(&mut in_rotor_axes, input);
            // The current of the input does not matter here.
            let input = FieldOrientedInput { current: Dq { d: 7.0, q: 7.0 }, ..input };
            let (output, voltages) = servo.update_phases(&mut in_phases, input, currents, rotor);
            prop_assert_eq!(output, expected);
            prop_assert_eq!(voltages, expected.voltage.to_phases(rotor));
        }
    }
}

#[test]
fn a_rotor_that_is_none_holds_the_last_phases() {
    let servo = servo(180.0);
    let mut state = FieldOrientedState::new();
    let input = FieldOrientedInput::new(Sample::at_rest(0.01), 0.0, 0.0, Dq::default());
    let (_, before) = servo.update_phases(&mut state, input, Phases::default(), Rotation::by(1.0));
    assert!(before.a != 0.0);
    for rotor in
        [Rotation::by(f64::NAN), Rotation::from_sin_cos(0.0, 0.0), Rotation::from_sin_cos(1e300, 0.0)]
    {
        let untouched = state;
        let (output, voltages) = servo.update_phases(&mut state, input, Phases::default(), rotor);
        assert_eq!((output.cascade, output.current_loop), (Status::Held, CurrentStatus::Held));
        assert_eq!((voltages, state), (before, untouched));
    }
}

#[test]
fn gains_change_without_a_bump() {
    let old = servo(180.0);
    let gains = PiGains { kp: 5.0, ki: 0.0 };
    let outer = old.cascade().with_gains(90.0, PiGains { kp: 1.0, ki: 0.0 }).expect("valid");
    let inner = old.current_loop().with_gains(gains, gains).expect("valid");
    let new = FieldOriented::new(outer.with_divisors(1, 1).expect("valid"), inner, 3).expect("valid");
    let (mut state, mut motor) = (FieldOrientedState::new(), Motor::default());
    let input = motor.input(reference(0.05));
    let before = old.update(&mut state, input);
    let mut bumped = state;
    new.take_over(&old, &mut state);
    let after = new.update(&mut state, input);
    // Without integral gains the new law repeats itself, to some ten roundings of terms of 200 V.
    assert!((after.voltage.q - before.voltage.q).abs() < 2e3 * f64::EPSILON, "{before:?} -> {after:?}");
    assert!((after.current - before.current).abs() < 2e2 * f64::EPSILON, "{before:?} -> {after:?}");
    assert!(
        (new.update(&mut bumped, input).voltage.q - before.voltage.q).abs() > 10.0,
        "there was a bump to avoid"
    );
    motor.run(after.voltage, 0.0);
}

#[test]
fn bad_parts_are_named() {
    assert_eq!(FieldOriented::new(cascade(), current_loop(1.0), 0), Err(FieldOrientedError::PolePairs));
    let other = CurrentLoop::tuned(WINDINGS, 1000.0, 2e-4).expect("valid");
    assert_eq!(
        FieldOriented::new(cascade(), other, 1),
        Err(FieldOrientedError::Periods { cascade: 1e-4, current_loop: 2e-4 })
    );
}
