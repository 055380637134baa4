//! Cost of a base tick of a whole simulation.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use plants::nalgebra::{Vector1, Vector2, vector};
use plants::{Clock, ControlTick, LinearMotor, Rk4, Simulation, Stepper, ZeroOrderHold};

const TICKS: u64 = 10_000;

fn run(simulation: &Simulation<1>, stepper: &mut impl Stepper<2, 1>) -> f64 {
    let outcome = simulation.run(
        stepper,
        vector![1.0, 0.0],
        &mut (),
        |_, tick: &ControlTick<'_, 2, 1>| vector![-1e3 * tick.state[0] - 40.0 * tick.state[1]],
        [("position", "m"), ("force", "N")],
        |_, probe| [probe.state[0], probe.input[0]],
    );
    outcome.map_or(f64::NAN, |outcome| outcome.state()[0])
}

fn pendulum(x: &Vector2<f64>, u: &Vector1<f64>) -> Vector2<f64> {
    vector![x[1], u[0] - 9.81 * x[0] - 30.0 * x[0] * x[0] * x[0]]
}

fn ticks(criterion: &mut Criterion) {
    let (Ok(clock), Ok(motor)) = (Clock::from_frequency(100_000), LinearMotor::new(1.0, 0.5)) else { return };
    let every_tick = Simulation::new(clock, TICKS);
    let Ok(split) = every_tick.clone().control_every(40).and_then(|s| s.delay(0.3331)) else { return };
    let Ok(sparse) = split.clone().record_every(40) else { return };
    let mut group = criterion.benchmark_group("base tick");
    group.throughput(Throughput::Elements(TICKS));
    let mut exact = ZeroOrderHold::new(motor);
    group.bench_function("exact hold, control and record every tick", |b| {
        b.iter(|| run(black_box(&every_tick), &mut exact));
    });
    group.bench_function("exact hold, control every 40, record every tick, delay", |b| {
        b.iter(|| run(black_box(&split), &mut exact));
    });
    group.bench_function("exact hold, control and record every 40, delay", |b| {
        b.iter(|| run(black_box(&sparse), &mut exact));
    });
    let Ok(mut smooth) = Rk4::fixed(pendulum, 1, 0.0) else { return };
    group.bench_function("RK4, control and record every tick", |b| {
        b.iter(|| run(black_box(&every_tick), &mut smooth));
    });
    group.finish();
}

criterion_group!(benches, ticks);
criterion_main!(benches);
