//! One answer, whatever the way to it: by hand, by argmin, on one thread or several, in one run or two.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

mod common;

use argmin::core::{Error, Executor, State};
use common::{Function, RASTRIGIN, by_hand};
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

#[cfg(feature = "serde")]
mod checkpoints {
    use super::*;
    use argmin::core::checkpointing::{Checkpoint, CheckpointingFrequency};
    use argmin::core::observers::{Observe, ObserverMode};
    use argmin::core::{KV, PopulationState};
    use std::cell::RefCell;
    use std::rc::Rc;

    type Population = PopulationState<Vec<f64>, f64>;

    /// The last checkpoint, as the bytes that a file would hold.
    #[derive(Clone, Default)]
    struct Bytes(Rc<RefCell<Option<Vec<u8>>>>);

    impl Checkpoint<ParticleSwarm, Population> for Bytes {
        fn save(&self, solver: &ParticleSwarm, state: &Population) -> Result<(), Error> {
            *self.0.borrow_mut() = Some(postcard::to_stdvec(&(solver, state))?);
            Ok(())
        }
        fn load(&self) -> Result<Option<(ParticleSwarm, Population)>, Error> {
            Ok(self.0.borrow().as_deref().map(postcard::from_bytes).transpose()?)
        }
        fn frequency(&self) -> CheckpointingFrequency {
            CheckpointingFrequency::Every(7)
        }
    }

    /// Ends a run as a power cut would: between two checkpoints, with an error.
    struct Killer(u64);

    impl Observe<Population> for Killer {
        fn observe_iter(&mut self, state: &Population, _kv: &KV) -> Result<(), Error> {
            if state.get_iter() == self.0 { Err(Error::msg("killed")) } else { Ok(()) }
        }
    }

    fn executor(problem: Function, options: SwarmOptions) -> Executor<Function, ParticleSwarm, Population> {
        Executor::new(problem, ParticleSwarm::from(swarm(options))).configure(|state| state.counting(true))
    }

    #[test]
    fn a_killed_run_goes_on_as_if_nothing_had_been() {
        for options in options() {
            let straight = executor(RASTRIGIN, options).run().expect("runs");
            for killed_at in [7, 30, 55] {
                let checkpoint = Bytes::default();
                let cut = executor(RASTRIGIN, options)
                    .checkpointing(checkpoint.clone())
                    .add_observer(Killer(killed_at), ObserverMode::Always)
                    .run();
                assert!(cut.is_err() && checkpoint.0.borrow().is_some());
                let resumed = executor(RASTRIGIN, options).checkpointing(checkpoint).run().expect("runs");
                assert_eq!(resumed.solver.swarm(), straight.solver.swarm());
                // Best point, costs, iterations and counts of evaluations.
                let (resumed, straight) = (resumed.state(), straight.state());
                assert_eq!(resumed.get_best_param(), straight.get_best_param());
                assert_eq!(resumed.get_best_cost().to_bits(), straight.get_best_cost().to_bits());
                assert_eq!(resumed.get_iter(), straight.get_iter());
                assert_eq!(resumed.get_func_counts(), straight.get_func_counts());
                assert_eq!(resumed.get_func_counts().get("cost_count"), Some(&(24 * 61)));
            }
        }
    }

    #[test]
    fn a_swarm_that_does_not_fit_is_not_read() {
        let mut value = serde_json::to_value(swarm(options()[0])).expect("writes");
        let read = |value: &serde_json::Value| serde_json::from_value::<Swarm>(value.clone());
        assert_eq!(read(&value).expect("reads"), swarm(options()[0]));
        for (path, bad) in [
            ("/positions/3/1", serde_json::json!(77.0)),
            ("/positions/3", serde_json::json!([0.0])),
            ("/velocities", serde_json::json!([0.0])),
            ("/best_positions", serde_json::json!([])),
            ("/best_costs", serde_json::json!([])),
            ("/options/particles", serde_json::json!(0)),
            ("/options/velocity_limit", serde_json::json!(1.5)),
            ("/bounds/0/lower", serde_json::json!(9.0)),
            ("/generations", serde_json::json!(4)),
        ] {
            let place = value.pointer_mut(path).expect("a part");
            let good = std::mem::replace(place, bad);
            assert!(read(&value).is_err(), "{path}");
            *value.pointer_mut(path).expect("a part") = good;
        }
    }

    #[test]
    fn options_read_as_written() {
        for options in options() {
            let text = serde_json::to_string(&options).expect("writes");
            assert_eq!(serde_json::from_str::<SwarmOptions>(&text).expect("reads"), options);
        }
        let partly = serde_json::from_str::<SwarmOptions>(r#"{"particles": 50, "iterations": 30}"#);
        assert_eq!(partly.expect("reads"), SwarmOptions::new(50, 30));
        assert!(serde_json::from_str::<SwarmOptions>(r#"{"particle": 50}"#).is_err());
        let weights = optimize::FitnessWeights::new(1.0, 2.0, 3.0, 4.0).expect("valid");
        let text = serde_json::to_string(&weights).expect("writes");
        assert_eq!(serde_json::from_str::<optimize::FitnessWeights>(&text).expect("reads"), weights);
        assert!(serde_json::from_str::<optimize::FitnessWeights>(&text.replace("2.0", "-2.0")).is_err());
    }
}
