//! Best values found, beside argmin's own swarm.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

mod common;

use common::{ACKLEY, Function, RASTRIGIN, ROSENBROCK, SPHERE, median};
use optimize::{Schedule, SwarmOptions, Topology};

const FUNCTIONS: [Function; 4] = [SPHERE, ROSENBROCK, RASTRIGIN, ACKLEY];
const SEEDS: u64 = 20;

/// Medians over so many seeds: ours and argmin's.
fn medians(function: Function, dimensions: usize, options: SwarmOptions, seeds: u64) -> (f64, f64) {
    let over = |run: fn(Function, usize, SwarmOptions, u64) -> f64| {
        median((0..seeds).map(|seed| run(function, dimensions, options, seed)).collect())
    };
    (over(Function::ours), over(Function::theirs))
}

#[test]
fn known_optima_are_found_from_every_seed() {
    // Four decades above what the worst of the seeds reaches, far below the next local optimum at about 1.
    for (function, bound) in [(SPHERE, 1e-18), (ROSENBROCK, 1e-4), (RASTRIGIN, 1e-4), (ACKLEY, 1e-6)] {
        for seed in 0..SEEDS {
            let best = function.ours(2, SwarmOptions::new(40, 200), seed);
            assert!((0.0..bound).contains(&best), "{} {seed}: {best}", function.name);
        }
    }
}

#[test]
fn no_function_is_searched_worse_than_by_argmin() {
    for (dimensions, particles, iterations) in [(2, 50, 30), (2, 40, 200), (10, 40, 200), (30, 60, 300)] {
        for function in FUNCTIONS {
            // Ties are both at the optimum to the last bit.
            let (ours, theirs) =
                medians(function, dimensions, SwarmOptions::new(particles, iterations), SEEDS);
            println!("{:10} {dimensions:2}: ours {ours:9.2e}, argmin's {theirs:9.2e}", function.name);
            assert!(ours <= theirs, "{} in {dimensions} dimensions: {ours} {theirs}", function.name);
        }
    }
}

#[test]
fn many_local_optima_are_searched_better_than_by_argmin() {
    let options = SwarmOptions::new(400, 1000);
    let (ours, theirs) = medians(RASTRIGIN, 30, options, 7);
    println!("Rastrigin in 30 dimensions, 400 x 1000: ours {ours}, argmin's {theirs}");
    // Argmin's is checked from below too, so that the comparison stays one with a swarm that works.
    assert!(ours < 50.0 && theirs > 75.0 && theirs < 100.0, "{ours} {theirs}");
    let scheduled = SwarmOptions {
        inertia: Schedule::Linear { from: 0.9, to: 0.4 },
        cognitive: Schedule::Linear { from: 2.5, to: 0.5 },
        social: Schedule::Linear { from: 0.5, to: 2.5 },
        ..options
    };
    let best = median((0..7).map(|seed| RASTRIGIN.ours(30, scheduled, seed)).collect());
    println!("with schedules: {best}");
    assert!(best < 30.0, "{best}");
}

#[test]
fn a_ring_is_slower_and_harder_to_trap() {
    let global = SwarmOptions::new(40, 400);
    let ring = SwarmOptions { topology: Topology::Ring { reach: 1 }, ..global };
    let best = |function: Function, options| {
        median((0..SEEDS).map(|seed| function.ours(10, options, seed)).collect())
    };
    assert!(best(RASTRIGIN, ring) < best(RASTRIGIN, global));
    assert!(best(SPHERE, ring) > best(SPHERE, global));
}
