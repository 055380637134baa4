//! Test functions with known optima, and the swarms that search them.
#![allow(dead_code, reason = "every test program uses its part")]
#![allow(unreachable_pub, reason = "shared by test programs")]

use std::f64::consts::{E, TAU};

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::particleswarm;
use optimize::{ParticleSwarm, Swarm, SwarmOptions};
use profiles::{Interval, Real};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};

/// A function with the least value 0 in a symmetric box.
#[derive(Clone, Copy)]
pub struct Function {
    pub name: &'static str,
    pub value: fn(&[f64]) -> f64,
    /// Half the width of the box.
    pub half_width: f64,
}

pub const SPHERE: Function = Function { name: "sphere", value: sphere, half_width: 5.0 };
pub const ROSENBROCK: Function = Function { name: "Rosenbrock", value: rosenbrock, half_width: 5.0 };
pub const RASTRIGIN: Function = Function { name: "Rastrigin", value: rastrigin, half_width: 5.12 };
pub const ACKLEY: Function = Function { name: "Ackley", value: ackley, half_width: 32.0 };

fn sphere(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum()
}

fn rosenbrock(x: &[f64]) -> f64 {
    x.windows(2).map(|x| 100.0 * (x[1] - x[0] * x[0]).powi(2) + (1.0 - x[0]).powi(2)).sum()
}

fn rastrigin(x: &[f64]) -> f64 {
    x.iter().map(|x| 10.0 + x * x - 10.0 * Real::cos(TAU * x)).sum()
}

fn ackley(x: &[f64]) -> f64 {
    let mean = |sum: f64| sum / x.len() as f64;
    let waves = mean(x.iter().map(|x| Real::cos(TAU * x)).sum());
    20.0 - 20.0 * Real::exp(-0.2 * mean(sphere(x)).sqrt()) + E - Real::exp(waves)
}

impl CostFunction for Function {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        Ok((self.value)(x))
    }
}

impl Function {
    pub fn bounds(&self, dimensions: usize) -> Vec<Interval> {
        vec![Interval::symmetric(self.half_width); dimensions]
    }

    /// The best cost that our swarm finds.
    pub fn ours(self, dimensions: usize, options: SwarmOptions, seed: u64) -> f64 {
        let solver = ParticleSwarm::new(&self.bounds(dimensions), options, seed).expect("valid");
        Executor::new(self, solver).run().expect("runs").state().get_best_cost()
    }

    /// The best cost that argmin's swarm finds, with its default factors, which are ours.
    pub fn theirs(self, dimensions: usize, options: SwarmOptions, seed: u64) -> f64 {
        let ends = (vec![-self.half_width; dimensions], vec![self.half_width; dimensions]);
        let solver = particleswarm::ParticleSwarm::<Vec<f64>, f64, _>::new(ends, options.particles)
            .with_rng_generator(Xoshiro256PlusPlus::seed_from_u64(seed));
        let executor = Executor::new(self, solver).configure(|state| state.max_iters(options.iterations));
        executor.run().expect("runs").state().get_best_cost()
    }
}

/// Tells a swarm the values of a function until it stops.
pub fn by_hand(mut swarm: Swarm, value: fn(&[f64]) -> f64) -> Swarm {
    while swarm.stop().is_none() {
        let costs: Vec<_> = swarm.ask().iter().map(|x| value(x).into()).collect();
        swarm.tell(&costs).expect("as many as asked for");
    }
    swarm
}

pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
