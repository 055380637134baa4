//! A robot is its axes, to the bit.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use plants::nalgebra::{SVector, vector};
use plants::{
    BallScrewAxis, CartesianRobot, Clock, ControlTick, Disturbance, Friction, MeteredStickSlip, Recording,
    RobotStepper, Simulation, Stepper, StickSlip, ZeroOrderHold,
};

fn axes() -> [BallScrewAxis; 3] {
    [(10.0, 1.0, 1.0, 1.0), (3.0, 40.0, 2.0, 0.5), (0.0, 0.0, 5.0, 2.0)].map(|(a, b, k, inertia)| {
        BallScrewAxis::from_coefficients(a, b, k).and_then(|axis| axis.with_inertia(inertia)).expect("valid")
    })
}

fn frictions() -> [Friction; 3] {
    let stribeck = Friction::coulomb(1.0).and_then(|f| f.with_stribeck(1.5, 0.01, 2.0));
    let viscous = Friction::none().with_viscous(0.3);
    [Friction::coulomb(0.5), stribeck, viscous].map(|friction| friction.expect("valid"))
}

const START: [f64; 3] = [1.0, 0.0, -0.5];
const TICKS: u64 = 20_000;

fn reference(axis: usize, time: f64) -> f64 {
    [time.sin(), time.cos(), 0.5 * time][axis]
}

fn load(axis: usize) -> Disturbance {
    match axis {
        0 => Disturbance::step(1.0, 10.0),
        1 => Disturbance::sine(0.5, 30.0, 0.1),
        _ => Ok(Disturbance::none()),
    }
    .expect("finite")
}

fn command(axis: usize, time: f64, angle: f64, speed: f64) -> f64 {
    300.0 * (reference(axis, time) - angle) - 20.0 * speed
}

fn simulation<const M: usize>() -> Simulation<M> {
    Simulation::new(Clock::from_frequency(10_000).expect("valid"), TICKS)
        .control_every(5)
        .and_then(|s| s.delay(0.5))
        .expect("valid")
}

fn together<S: Stepper<2, 2>>(mut stepper: RobotStepper<3, S>) -> Recording {
    let robot = CartesianRobot::new(axes());
    simulation()
        .disturbances([
            Disturbance::none(),
            Disturbance::none(),
            Disturbance::none(),
            load(0),
            load(1),
            load(2),
        ])
        .run(
            &mut stepper,
            vector![START[0], START[1], START[2], 0.0, 0.0, 0.0],
            &mut (),
            |(), tick: &ControlTick<'_, 6, 6>| {
                let (angle, speed) = (robot.angles(tick.state), robot.speeds(tick.state));
                SVector::from_fn(|i, _| if i < 3 { command(i, tick.time, angle[i], speed[i]) } else { 0.0 })
            },
            [("x", "rad"), ("y", "rad"), ("z", "rad")],
            |(), probe| robot.angles(probe.state).into(),
        )
        .expect("valid")
        .completed()
        .expect("stable")
}

fn alone(axis: usize, stepper: &mut impl Stepper<2, 2>) -> Vec<f64> {
    let recording = simulation()
        .disturbances([Disturbance::none(), load(axis)])
        .run(
            stepper,
            vector![START[axis], 0.0],
            &mut (),
            |(), tick: &ControlTick<'_, 2, 2>| {
                vector![command(axis, tick.time, tick.state[0], tick.state[1]), 0.0]
            },
            [("angle", "rad")],
            |(), probe| [probe.state[0]],
        )
        .expect("valid")
        .completed()
        .expect("stable");
    recording.column("angle").expect("recorded").to_vec()
}

#[test]
fn three_axes_are_three_single_ones_to_the_bit() {
    let robot = CartesianRobot::new(axes());
    let recording = together(robot.stepper());
    for (i, name) in ["x", "y", "z"].into_iter().enumerate() {
        let single = alone(i, &mut ZeroOrderHold::new(axes()[i]));
        assert_eq!(recording.column(name), Ok(&single[..]), "axis {name}");
    }
    let robot = robot.with_friction(frictions()).expect("valid");
    let recording = together(robot.stepper());
    for (i, name) in ["x", "y", "z"].into_iter().enumerate() {
        let mut stepper = StickSlip::new(axes()[i], frictions()[i]).expect("valid");
        assert_eq!(recording.column(name), Ok(&alone(i, &mut stepper)[..]), "axis {name}");
    }
    // The friction shows.
    assert_ne!(recording.column("x"), together(CartesianRobot::new(axes()).stepper()).column("x"));
}

#[test]
fn one_axis_is_a_robot() {
    let [_, axis, _] = axes();
    let mut robot = CartesianRobot::new([axis]).stepper();
    assert_eq!(alone(1, &mut robot), alone(1, &mut ZeroOrderHold::new(axis)));
}

#[test]
fn a_robot_without_loads_has_an_input_for_each_axis() {
    let robot = CartesianRobot::new(axes()).with_friction(frictions()).expect("valid");
    let (mut with, mut without) = (robot.stepper(), robot.stepper());
    let state = vector![0.1, 0.2, 0.3, 1.0, -2.0, 3.0];
    let short = without.advance(&state, &vector![5.0, -6.0, 7.0], 1e-3).expect("valid");
    let long = with.advance(&state, &vector![5.0, -6.0, 7.0, 0.0, 0.0, 0.0], 1e-3).expect("valid");
    assert_eq!(short, long);
    assert_eq!(robot.angles(&state), vector![0.1, 0.2, 0.3]);
    assert_eq!(robot.speeds(&state), vector![1.0, -2.0, 3.0]);
}

#[test]
fn the_ledger_of_a_robot_is_that_of_its_axes() {
    let robot = CartesianRobot::new(axes()).with_friction(frictions()).expect("valid");
    let (mut plain, mut metered) = (robot.stepper(), robot.metered());
    let mut state: SVector<f64, 6> = vector![0.1, 0.2, 0.3, 1.0, -2.0, 3.0];
    for k in 0..10_000 {
        let torque = (1e-3 * f64::from(k)).sin();
        let input = vector![30.0 * torque, -40.0 * torque, 7.0 * torque, 1.0, 0.1, torque];
        let next = plain.advance(&state, &input, 1e-4).expect("valid");
        assert_eq!(metered.advance(&state, &input, 1e-4), Ok(next));
        state = next;
    }
    let ledger = metered.ledger();
    let dissipated: f64 = metered.axes().iter().map(|axis: &MeteredStickSlip| axis.ledger().dissipated).sum();
    assert!((ledger.dissipated - dissipated).abs() <= 0.0 && dissipated > 1.0);
    // To one rounding for each step and axis, as other exact plants.
    assert!(ledger.relative_imbalance() < 3e4 * f64::EPSILON, "{} {ledger:?}", ledger.relative_imbalance());
}

#[test]
fn an_axis_that_cannot_be_stepped_stops_the_robot() {
    let mut robot = CartesianRobot::new(axes()).stepper();
    let state = SVector::<f64, 6>::zeros();
    assert!(robot.advance(&state, &SVector::<f64, 3>::zeros(), f64::NAN).is_err());
    let excessive = Friction::none().with_viscous(1e300).expect("valid");
    let light = axes()[0].with_inertia(1e-300).expect("valid");
    assert!(CartesianRobot::new([light]).with_friction([excessive]).is_err());
}
