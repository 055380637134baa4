//! The tuning of a five-phase S-curve by a swarm: 50 particles, 30 iterations, 6 s of a vibrating drive in steps of 1 ms for each.
#![expect(clippy::expect_used, reason = "a bench may fail loudly")]

use std::hint::black_box;

use argmin::core::{CostFunction, Error, Executor};
use criterion::{Criterion, criterion_group, criterion_main};
use identify::Signal;
use optimize::{Cost, FitnessWeights, ParticleSwarm, Schedule, SwarmOptions};
use plants::nalgebra::{SVector, Vector1};
use plants::{DiscreteStateSpace, TransferFunction};
use profiles::{FivePhase, Interval, Profile};

const STEP: f64 = 1e-3;
const STEPS: u32 = 6000;
const TARGET: f64 = 50_000.0;

struct Tuning {
    drive: DiscreteStateSpace<2, 1, 1>,
    weights: FitnessWeights,
}

impl Tuning {
    fn new() -> Self {
        let transfer = TransferFunction::second_order(1.1497, 7.55, 0.2, 0.092).expect("stable");
        let drive =
            transfer.to_state_space::<2>().and_then(|drive| drive.discretise(STEP)).expect("two poles");
        Self { drive, weights: FitnessWeights::new(3e-4, 0.0, 100.0, 100.0).expect("weights") }
    }
}

impl CostFunction for &Tuning {
    type Param = Vec<f64>;
    type Output = Cost;

    fn cost(&self, candidate: &Vec<f64>) -> Result<Cost, Error> {
        let [jerk, phase] = candidate[..] else { return Ok(Cost::Failed) };
        let curve = FivePhase::new(0.0, jerk, phase, 6.0)?;
        let mut state = SVector::<f64, 2>::zeros();
        let (commands, outputs): (Vec<f64>, Vec<f64>) = (0..=STEPS)
            .map(|k| {
                let input = Vector1::new(curve.sample((f64::from(k) + 0.5) * STEP).velocity);
                let output = self.drive.output(&state, &input)[0];
                state = self.drive.step(&state, &input);
                (input[0], output)
            })
            .unzip();
        Ok(Cost::from(self.weights.of(&Signal::sampled(&outputs, STEP)?, &commands, 0.0, TARGET)?.total()))
    }
}

fn tune(criterion: &mut Criterion) {
    let tuning = Tuning::new();
    let options = SwarmOptions {
        inertia: Schedule::Constant(0.4),
        cognitive: Schedule::Constant(2.0),
        social: Schedule::Constant(2.0),
        ..SwarmOptions::new(50, 30)
    };
    let bounds = [Interval::new(100.0, 100_000.0), Interval::new(2e-3, 2.0)];
    let mut group = criterion.benchmark_group("tuning");
    group.sample_size(10);
    group.bench_function("swarm of 50 x 30 over 6 s of a drive", |b| {
        b.iter(|| {
            let solver = ParticleSwarm::new(&bounds, options, black_box(1)).expect("bounds");
            let result = Executor::new(&tuning, solver).run().expect("a search is never lost");
            result.solver.swarm().best().1
        });
    });
    group.finish();
}

criterion_group!(benches, tune);
criterion_main!(benches);
