//! Fifteen seconds of a three-axis robot under control at 10 kHz, with its channels recorded.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use plants::nalgebra::SVector;
use plants::{
    BallScrewAxis, CartesianRobot, Clock, ControlTick, Disturbance, Friction, ModelError, RobotStepper,
    Simulation, Stepper,
};

const TICKS: u64 = 150_000;

fn run<S: Stepper<2, 2>>(simulation: &Simulation<6>, mut stepper: RobotStepper<3, S>) -> f64 {
    let outcome = simulation.run(
        &mut stepper,
        SVector::zeros(),
        &mut (),
        |(), tick: &ControlTick<'_, 6, 6>| {
            let (t, x) = (tick.time, tick.state);
            // A reference that costs nothing: the plant and the simulation are what is measured.
            let reference = [t, 1.0 - t, 5.0 * t];
            SVector::from_fn(|i, _| if i < 3 { 600.0 * (reference[i] - x[i]) - 10.0 * x[i + 3] } else { 0.0 })
        },
        [("x", "rad"), ("y", "rad"), ("z", "rad")],
        |(), probe| [probe.state[0], probe.state[1], probe.state[2]],
    );
    outcome.map_or(f64::NAN, |outcome| outcome.state()[0])
}

fn setup() -> Result<(CartesianRobot<3>, [Friction; 3], [Friction; 3], Disturbance), ModelError> {
    let robot = CartesianRobot::new([BallScrewAxis::from_coefficients(10.0, 1.0, 1.0)?; 3]);
    let coulomb = Friction::coulomb(5.0)?;
    let stribeck = coulomb.with_stribeck(8.0, 0.05, 2.0)?;
    Ok((robot, [coulomb; 3], [stribeck; 3], Disturbance::step(10.0, 10.0)?))
}

fn robot(criterion: &mut Criterion) {
    let (Ok((robot, coulomb, stribeck, load)), Ok(clock)) = (setup(), Clock::from_frequency(10_000)) else {
        return;
    };
    let mut loads = [Disturbance::none(); 6];
    loads[3] = load;
    let (quiet, loaded) = (Simulation::new(clock, TICKS), Simulation::new(clock, TICKS).disturbances(loads));
    let mut group = criterion.benchmark_group("robot, 15 s at 10 kHz");
    group.throughput(Throughput::Elements(TICKS)).sample_size(20);
    group.bench_function("no friction", |b| b.iter(|| run(black_box(&quiet), robot.stepper())));
    group.bench_function("no friction, a load", |b| b.iter(|| run(black_box(&loaded), robot.stepper())));
    group.bench_function("no friction, a load, ledger", |b| {
        b.iter(|| run(black_box(&loaded), robot.metered()))
    });
    for (name, friction) in [("Coulomb, a load", coulomb), ("Stribeck, a load", stribeck)] {
        let Ok(robot) = robot.with_friction(friction) else { return };
        group.bench_function(name, |b| b.iter(|| run(black_box(&loaded), robot.stepper())));
    }
    group.finish();
}

criterion_group!(benches, robot);
criterion_main!(benches);
