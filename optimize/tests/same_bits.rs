//! One answer, whatever the way to it: by hand, by argmin, on one thread or several, in one run or two.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

mod common;

use argmin::core::{Executor, State};
use common::{RASTRIGIN, by_hand};
use optimize::{Boundary, Cost, InitialVelocity, ParticleSwarm, Swarm, SwarmOptions, Topology};

const DIMENSIONS: usize = 5;

fn options() -> [SwarmOptions; 3] {
    let plain = SwarmOptions::new(24, 60);
    [
        plain,
        SwarmOptions { topology: Topology::Ring { reach: 2 }, boundary: Boundary::Absorb, ..plain },
        SwarmOptions { initial_velocity: InitialVelocity::Uniform, boundary: Boundary::Clamp, ..plain },
    ]
}

fn swarm(options: SwarmOptions) -> Swarm {
    Swarm::new(&RASTRIGIN.bounds(DIMENSIONS), options, 11).expect("valid")
}

#[test]
fn by_hand_and_by_argmin() {
    for options in options() {
        let hand = by_hand(swarm(options), RASTRIGIN.value);
        for solver in [ParticleSwarm::from(swarm(options)), ParticleSwarm::from(swarm(options)).sequential()]
        {
            let result =
                Executor::new(RASTRIGIN, solver).configure(|state| state.counting(true)).run().expect("runs");
            assert_eq!(result.solver.swarm(), &hand);
            let (position, cost) = hand.best();
            assert_eq!(result.state().get_best_param().map(Vec::as_slice), Some(position));
            assert_eq!(Some(result.state().get_best_cost()), cost.value());
            assert_eq!(result.state().get_func_counts().get("cost_count"), Some(&(24 * 61)));
        }
    }
}

#[test]
fn on_any_number_of_threads() {
    for options in options() {
        let hand = by_hand(swarm(options), RASTRIGIN.value);
        for threads in [1, 2, 3, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            let run =
                || Executor::new(RASTRIGIN, ParticleSwarm::from(swarm(options))).run().expect("runs").solver;
            assert_eq!(pool.install(run).swarm(), &hand, "{threads} threads");
        }
    }
}

#[test]
fn evaluated_in_any_order() {
    let hand = by_hand(swarm(options()[1]), RASTRIGIN.value);
    let mut other = swarm(options()[1]);
    while other.stop().is_none() {
        let mut costs = vec![Cost::Failed; 24];
        for (slot, x) in costs.iter_mut().zip(other.ask()).rev() {
            *slot = (RASTRIGIN.value)(x).into();
        }
        other.tell(&costs).expect("as many as asked for");
    }
    assert_eq!(other, hand);
}

#[test]
fn told_half_way_and_handed_to_argmin() {
    let hand = by_hand(swarm(options()[0]), RASTRIGIN.value);
    let mut half = swarm(options()[0]);
    for _ in 0..20 {
        let costs: Vec<_> = half.ask().iter().map(|x| (RASTRIGIN.value)(x).into()).collect();
        half.tell(&costs).expect("as many as asked for");
    }
    let result = Executor::new(RASTRIGIN, ParticleSwarm::from(half)).run().expect("runs");
    assert_eq!(result.solver.swarm(), &hand);
}

#[test]
fn a_ring_that_sees_all_is_global() {
    let global = by_hand(swarm(options()[0]), RASTRIGIN.value);
    let ring = SwarmOptions { topology: Topology::Ring { reach: 12 }, ..options()[0] };
    let ring = by_hand(swarm(ring), RASTRIGIN.value);
    assert_eq!(ring.history(), global.history());
    let near = SwarmOptions { topology: Topology::Ring { reach: 11 }, ..options()[0] };
    assert_ne!(by_hand(swarm(near), RASTRIGIN.value).history(), global.history());
}

#[test]
fn another_seed_is_another_search() {
    let one = by_hand(swarm(options()[0]), RASTRIGIN.value);
    let bounds = RASTRIGIN.bounds(DIMENSIONS);
    let other = by_hand(Swarm::new(&bounds, options()[0], 12).expect("valid"), RASTRIGIN.value);
    assert_ne!(one.best(), other.best());
}
