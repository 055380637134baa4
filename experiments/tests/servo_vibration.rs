//! The vibration that `response` predicts is the vibration that the simulation keeps, of moves and of shaped moves.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use plants::nalgebra::{self, SVector, matrix, vector};
use plants::{Clock, ControlTick, Simulation, StateSpace, Stepper, TwoInertia, ZeroOrderHold};
use profiles::{Complex, Limits, Mode, Profile, Sectioned, Trapezoid, residual_vibration};
use proptest::prelude::*;
use shaping::{DelayFilter, Shaped};

const FREQUENCY: u64 = 10_000; // ticks/s
const PERIOD: f64 = 1e-4; // s

/// What simulation and prediction may differ by, of the move.
const TOLERANCE: f64 = 1e-9;

/// A trapezoid whose sections end on ticks, so that its acceleration is held over every one of them.
fn move_on_ticks(rise: u32, cruise: u32, fall: u32, speed: f64) -> Trapezoid {
    let [rise, cruise, fall] = [rise, cruise, fall].map(|ticks| f64::from(ticks) * PERIOD);
    let limits = Limits::new(speed, speed / rise, f64::INFINITY)
        .and_then(|limits| limits.with_deceleration(speed / fall))
        .expect("valid");
    Trapezoid::rest_to_rest(speed * (0.5 * rise + cruise + 0.5 * fall), &limits).expect("valid")
}

/// The delay nearest to a share of the damped period that is a whole number of ticks, s.
fn delay_on_ticks(mode: Mode, share: f64) -> f64 {
    (share * mode.damped_period() / PERIOD).round().max(1.0) * PERIOD
}

/// The state after the end of a move, driven by `gain` times its acceleration, and the time since the end in s.
fn driven<const N: usize, const M: usize>(
    stepper: &mut impl Stepper<N, M>,
    profile: &impl Sectioned,
    gain: SVector<f64, M>,
) -> (SVector<f64, N>, f64) {
    let clock = Clock::from_frequency(FREQUENCY).expect("valid");
    let duration = profile.duration();
    // A few ticks more, over which the vibration is free.
    let ticks = clock.ticks(duration).expect("short") + 7;
    let outcome = Simulation::new(clock, ticks).divergence_bound(f64::INFINITY).expect("positive").run(
        stepper,
        SVector::zeros(),
        &mut (),
        |(), tick: &ControlTick<'_, N, M>| {
            // The middle of a tick lies in one section, however its ends are rounded.
            gain * profile.sample(tick.time + 0.5 * PERIOD).acceleration
        },
        [("first state", ""); 1],
        |(), probe| [probe.state[0]],
    );
    let outcome = outcome.expect("valid");
    assert_eq!(outcome.halt(), None);
    (*outcome.state(), clock.time(ticks) - duration)
}

/// The amplitude that a deflection and its rate had `since` s before, in free vibration: `|v - conj(p) x| / w_d`.
fn amplitude(mode: Mode, deflection: f64, rate: f64, since: f64) -> f64 {
    let phasor = Complex::new(rate, 0.0) - mode.pole().conj() * deflection;
    phasor.norm() / mode.damped_angular_frequency() * (-mode.pole().re * since).exp()
}

/// What an oscillator `x'' + 2 z w x' + w^2 x = -a(t)` keeps of a profile.
fn of_oscillator(mode: Mode, profile: &impl Sectioned) -> f64 {
    let (w, z) = (mode.angular_frequency(), mode.damping_ratio());
    let system = StateSpace::new(
        matrix![0.0, 1.0; -w * w, -2.0 * z * w],
        matrix![0.0; -1.0],
        matrix![1.0, 0.0],
        matrix![0.0],
    );
    let (state, since) = driven(&mut ZeroOrderHold::new(system.expect("finite")), profile, vector![1.0]);
    amplitude(mode, state[0], state[1], since)
}

/// What the twist of an axis keeps of a profile whose torque is fed forward, for the inertia of motor and load; and where
/// the centre of both ends.
fn of_axis(axis: &TwoInertia, profile: &impl Sectioned) -> (f64, f64) {
    let (motor, load) = (axis.motor_inertia(), axis.load_inertia());
    let (state, since) = driven(&mut ZeroOrderHold::new(*axis), profile, vector![motor + load, 0.0]);
    let [motor_angle, motor_speed, load_angle, load_speed] = state.data.0[0];
    let mode = axis.free_mode().expect("vibrates");
    let kept = amplitude(mode, motor_angle - load_angle, motor_speed - load_speed, since);
    (kept, (motor * motor_angle + load * load_angle) / (motor + load))
}

fn moves() -> impl Strategy<Value = Trapezoid> {
    (1..200_u32, 0..300_u32, 1..200_u32, -3.0..3.0_f64)
        .prop_map(|(rise, cruise, fall, decade)| move_on_ticks(rise, cruise, fall, 10.0_f64.powf(decade)))
}

/// Modes of 2 to 1000 Hz, undamped ones included.
fn modes() -> impl Strategy<Value = Mode> {
    let damping =
        prop_oneof![Just(0.0), -4.0..-0.3_f64].prop_map(|z| if z < 0.0 { 10.0_f64.powf(z) } else { z });
    (0.3..3.0_f64, damping)
        .prop_map(|(decade, damping)| Mode::from_hz(10.0_f64.powf(decade), damping).expect("valid"))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn an_oscillator_keeps_what_is_predicted(
        profile in moves(), mode in modes(), other in modes(), share in 0.3..0.7_f64,
    ) {
        let distance = profile.sample(profile.duration()).position;
        let near = |simulated: f64, predicted: f64| (simulated - predicted).abs() <= TOLERANCE * distance;
        let (simulated, predicted) = (of_oscillator(mode, &profile), residual_vibration(&profile, mode));
        prop_assert!(near(simulated, predicted), "{simulated} {predicted}");

        let wrong = DelayFilter::new(other, delay_on_ticks(other, share)).expect("half a period or so");
        let shaped = Shaped::new(profile, *wrong.train());
        let (simulated, predicted) = (of_oscillator(mode, &shaped), residual_vibration(&shaped, mode));
        prop_assert!(near(simulated, predicted), "{simulated} {predicted}");

        let right = DelayFilter::new(mode, delay_on_ticks(mode, share)).expect("half a period or so");
        let simulated = of_oscillator(mode, &Shaped::new(profile, *right.train()));
        prop_assert!(near(simulated, 0.0), "{simulated}");
    }

    #[test]
    fn a_servo_axis_keeps_what_is_predicted(
        profile in moves(), wanted in modes(), ratio in 0.05..20.0_f64, other in modes(), share in 0.3..0.7_f64,
    ) {
        // A motor of 0.003 kg m^2, its load, and the spring that gives the mode.
        let (motor, load) = (0.003, 0.003 * ratio);
        let reduced = motor * load / (motor + load);
        let (w, z) = (wanted.angular_frequency(), wanted.damping_ratio());
        let axis = TwoInertia::new(motor, load, reduced * w * w)
            .and_then(|axis| axis.with_damping(0.0, 2.0 * z * w * reduced, 0.0))
            .expect("valid");
        let mode = axis.free_mode().expect("vibrates");
        // The torque moves both, the motor alone takes it: the twist is driven by so much more.
        let gain = (motor + load) / motor;

        let distance = profile.sample(profile.duration()).position;
        let near = |value: f64, expected: f64| (value - expected).abs() <= TOLERANCE * distance;
        let (simulated, end) = of_axis(&axis, &profile);
        let predicted = gain * residual_vibration(&profile, mode);
        prop_assert!(near(simulated / gain, predicted / gain), "{simulated} {predicted}");
        prop_assert!(near(end, distance), "{end} {distance}");

        let wrong = DelayFilter::new(other, delay_on_ticks(other, share)).expect("half a period or so");
        let shaped = Shaped::new(profile, *wrong.train());
        let (simulated, end) = of_axis(&axis, &shaped);
        let predicted = gain * residual_vibration(&shaped, mode);
        prop_assert!(near(simulated / gain, predicted / gain), "{simulated} {predicted}");
        prop_assert!(near(end, distance), "{end} {distance}");

        let right = DelayFilter::new(mode, delay_on_ticks(mode, share)).expect("half a period or so");
        let (simulated, _) = of_axis(&axis, &Shaped::new(profile, *right.train()));
        prop_assert!(near(simulated / gain, 0.0), "{simulated}");
    }
}

#[test]
fn a_filter_for_another_mode_leaves_some_of_it() {
    let profile = move_on_ticks(50, 200, 50, 94.2); // rad/s
    let mode = Mode::new(439.92, 0.0722).expect("valid");
    let other = Mode::new(465.668, 0.15).expect("valid");
    let kept = |mode: Mode| {
        let filter = DelayFilter::positive(mode, 0.006).expect("valid");
        Shaped::new(profile, *filter.train())
    };
    let plain = residual_vibration(&profile, mode);
    let wrong = residual_vibration(&kept(other), mode);
    assert!(wrong > 0.01 * plain && wrong < 0.5 * plain, "{wrong} of {plain}");
    let distance = profile.sample(profile.duration()).position;
    assert!((of_oscillator(mode, &kept(other)) - wrong).abs() < TOLERANCE * distance);
    assert!(of_oscillator(mode, &kept(mode)) < TOLERANCE * distance);
}
