//! What a swarm costs beside its evaluations, next to argmin's own swarm with the same factors.

use std::hint::black_box;

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::particleswarm;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use optimize::{Cost, ParticleSwarm, Swarm, SwarmOptions};
use profiles::Interval;
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};

/// A cost of about a nanosecond per dimension, so that what is left is the solver's.
struct Sphere;

impl CostFunction for Sphere {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        Ok(sphere(x))
    }
}

fn sphere(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum()
}

fn swarms(criterion: &mut Criterion) {
    for (dimensions, particles, iterations) in [(2, 50, 30), (30, 400, 20)] {
        let bounds = vec![Interval::new(-5.0, 5.0); dimensions];
        let options = SwarmOptions::new(particles, iterations);
        let mut group = criterion.benchmark_group(format!("{dimensions} dimensions"));
        group.throughput(Throughput::Elements(particles as u64 * (iterations + 1)));
        group.bench_function("ours, by argmin", |b| {
            b.iter(|| {
                let solver = ParticleSwarm::new(black_box(&bounds), options, 1)?.sequential();
                Executor::new(Sphere, solver).run()
            });
        });
        group.bench_function("ours, by hand", |b| {
            let mut costs = vec![Cost::Failed; particles];
            b.iter(|| {
                let mut swarm = Swarm::new(black_box(&bounds), options, 1)?;
                while swarm.stop().is_none() {
                    costs.iter_mut().zip(swarm.ask()).for_each(|(cost, x)| *cost = sphere(x).into());
                    swarm.tell(&costs)?;
                }
                Ok::<_, Error>(swarm)
            });
        });
        group.bench_function("argmin's", |b| {
            b.iter(|| {
                let ends = (vec![-5.0; dimensions], vec![5.0; dimensions]);
                let solver =
                    particleswarm::ParticleSwarm::<Vec<f64>, f64, _>::new(black_box(ends), particles)
                        .with_rng_generator(Xoshiro256PlusPlus::seed_from_u64(1));
                Executor::new(Sphere, solver).configure(|state| state.max_iters(iterations)).run()
            });
        });
        group.finish();
    }
}

criterion_group!(benches, swarms);
criterion_main!(benches);
