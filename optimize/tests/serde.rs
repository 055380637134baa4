//! A run that was cut goes on to the same bits; options survive being written.
#![cfg(feature = "serde")]
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

mod common;

use argmin::core::checkpointing::{Checkpoint, CheckpointingFrequency};
use argmin::core::observers::{Observe, ObserverMode};
use argmin::core::{Error, Executor, State};
use argmin::core::{KV, PopulationState};
use common::{Function, RASTRIGIN};
use optimize::vibration_free::{OwnedMoveTable, Robustness, plan_table};
use optimize::{
    Boundary, Breeding, Crossover, FitnessWeights, GeneticOptions, GeneticSwarm, Mutation, ParticleSwarm,
    Schedule, Stall, Swarm, SwarmOptions, Topology,
};
use profiles::switched::MoveTable;
use profiles::{Limits, Mode, Profile};
use std::cell::RefCell;
use std::rc::Rc;

fn options() -> [SwarmOptions; 2] {
    let plain = SwarmOptions::new(24, 60);
    let stall = Some(Stall { iterations: 50, absolute: 1e-3, relative: 0.1 });
    [
        SwarmOptions { inertia: Schedule::Linear { from: 0.9, to: 0.4 }, target: Some(-1.0), ..plain },
        SwarmOptions { topology: Topology::Ring { reach: 2 }, boundary: Boundary::Absorb, stall, ..plain },
    ]
}

fn swarm(options: SwarmOptions) -> Swarm {
    Swarm::new(&RASTRIGIN.bounds(5), options, 11).expect("valid")
}

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
    let weights = FitnessWeights::new(1.0, 2.0, 3.0, 4.0).expect("valid");
    let text = serde_json::to_string(&weights).expect("writes");
    assert_eq!(serde_json::from_str::<FitnessWeights>(&text).expect("reads"), weights);
    assert!(serde_json::from_str::<FitnessWeights>(&text.replace("2.0", "-2.0")).is_err());
}

#[test]
fn breeding_goes_on_after_being_written_between_particles_and_children() {
    let search = || Breeding::new(&RASTRIGIN.bounds(5), GeneticOptions::new(24, 60), 11).expect("valid");
    let tell = |search: &mut Breeding| {
        let costs: Vec<_> = search.ask().iter().map(|x| (RASTRIGIN.value)(x).into()).collect();
        search.tell(&costs).expect("as many as asked for");
    };
    let (mut straight, mut written) = (search(), search());
    for turn in 0..40 {
        tell(&mut straight);
        tell(&mut written);
        if turn % 7 == 0 {
            let bytes = postcard::to_stdvec(&GeneticSwarm::from(written)).expect("writes");
            written = postcard::from_bytes::<GeneticSwarm>(&bytes).expect("reads").search().clone();
        }
        assert_eq!(written, straight);
    }
    tell(&mut straight);
    let mut value = serde_json::to_value(&straight).expect("writes");
    let read = |value: &serde_json::Value| serde_json::from_value::<Breeding>(value.clone());
    assert_eq!(read(&value).expect("reads"), straight);
    for (path, bad) in [
        ("/order/3", serde_json::json!(77)),
        ("/order", serde_json::json!([0])),
        ("/children", serde_json::json!([])),
        ("/children/3", serde_json::json!([0.0])),
        ("/children/3/1", serde_json::json!(77.0)),
        ("/options/pool", serde_json::json!(0.25)),
        ("/options/mutation_rate", serde_json::json!(-1.0)),
        ("/options/swarm/particles", serde_json::json!(23)),
        ("/swarm/positions/3/1", serde_json::json!(77.0)),
        ("/failed", serde_json::json!(1000)),
    ] {
        let place = value.pointer_mut(path).expect("a part");
        let good = std::mem::replace(place, bad);
        assert!(read(&value).is_err(), "{path}");
        *value.pointer_mut(path).expect("a part") = good;
    }
}

#[test]
fn genetic_options_read_as_written() {
    let plain = GeneticOptions::new(50, 30);
    let (crossover, mutation) = (Crossover::Blend { beyond: 0.25 }, Mutation::Nearby { reach: 0.125 });
    for options in [plain, GeneticOptions { crossover, mutation, ..GeneticOptions::genetic(7, 8) }] {
        let bytes = postcard::to_stdvec(&options).expect("writes");
        assert_eq!(postcard::from_bytes::<GeneticOptions>(&bytes).expect("reads"), options);
    }
    let partly = serde_json::from_str::<GeneticOptions>(r#"{"pool": 0.25}"#).expect("reads");
    assert_eq!(partly, GeneticOptions { pool: 0.25, ..GeneticOptions::new(400, 1000) });
    assert!(serde_json::from_str::<GeneticOptions>(r#"{"pools": 0.25}"#).is_err());
}

#[test]
fn uncertain_modes_and_tasks_read_as_written_and_bad_ones_are_refused() {
    let mode = profiles::Mode::new(50.0, 0.03).expect("valid");
    let mode = optimize::UncertainMode::new(mode, 0.25, 0.001).expect("valid");
    let text = serde_json::to_string(&mode).expect("writes");
    assert_eq!(serde_json::from_str::<optimize::UncertainMode>(&text).expect("reads"), mode);
    assert!(serde_json::from_str::<optimize::UncertainMode>(&text.replace("0.25", "-0.25")).is_err());
    let limits = profiles::Limits::new(0.5, 5.0, 200.0).expect("valid");
    let task = optimize::MoveTask { distance: 0.1, limits, tolerated: 1e-4, deviations: 3.0 };
    let text = serde_json::to_string(&task).expect("writes");
    assert_eq!(serde_json::from_str::<optimize::MoveTask>(&text).expect("reads"), task);
}

#[test]
fn a_table_of_moves_is_read_as_it_was_written() {
    let limits = Limits::new(0.5, 5.0, 200.0).expect("limits");
    let mode = Mode::from_hz(8.0, 0.02).expect("mode");
    let owned: OwnedMoveTable<16> =
        plan_table(0.1, 0.11, &limits, &[mode], Robustness::None, 1e-2).expect("built");
    let text = serde_json::to_string(&owned).expect("written");
    let read: OwnedMoveTable<16> = serde_json::from_str(&text).expect("read");
    let (read, owned) = (read.as_table().expect("checked"), owned.as_table().expect("built"));
    let duration = |table: &MoveTable<'_, 16>| table.rest_to_rest(0.1034).expect("within").duration();
    // A number of JSON may be read with another last bit.
    assert!((duration(&read) - duration(&owned)).abs() < 1e-14);
    let other = text.replace("\"double\":false", "\"double\":true");
    let other: OwnedMoveTable<16> = serde_json::from_str(&other).expect("read");
    assert!(other.as_table().is_err());
}
