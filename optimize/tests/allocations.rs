//! A generation allocates nothing, beyond the history that it leaves.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

mod common;

use allocation_counter::measure;
use argmin::core::{PopulationState, Problem, Solver, State};
use common::RASTRIGIN;
use optimize::{Breeding, Cost, GeneticOptions, ParticleSwarm, Swarm, SwarmOptions};

#[test]
fn by_hand_nothing_but_history() {
    let mut swarm = Swarm::new(&RASTRIGIN.bounds(10), SwarmOptions::new(50, 200), 1).expect("valid");
    let mut costs = vec![Cost::Failed; 50];
    let mut generation = |swarm: &mut Swarm| {
        costs.iter_mut().zip(swarm.ask()).for_each(|(cost, x)| *cost = (RASTRIGIN.value)(x).into());
        swarm.tell(&costs).expect("fifty");
    };
    let counts = measure(|| (0..201).for_each(|_| generation(&mut swarm)));
    // A vector that doubles from 4 to 256 entries.
    assert!(counts.count_total <= 7, "{}", counts.count_total);
}

#[test]
fn breeding_allocates_nothing_more() {
    for options in [GeneticOptions::new(50, 200), GeneticOptions::genetic(50, 200)] {
        let mut search = Breeding::new(&RASTRIGIN.bounds(10), options, 1).expect("valid");
        let mut costs = vec![Cost::Failed; 50];
        let mut turn = |search: &mut Breeding| {
            let candidates = search.ask().len();
            costs.iter_mut().zip(search.ask()).for_each(|(cost, x)| *cost = (RASTRIGIN.value)(x).into());
            search.tell(&costs[..candidates]).expect("as many as asked for");
        };
        let counts = measure(|| (0..201).for_each(|_| turn(&mut search)));
        assert!(counts.count_total <= 7, "{}", counts.count_total);
    }
}

#[test]
fn by_argmin_a_few_a_generation() {
    let solver = ParticleSwarm::new(&RASTRIGIN.bounds(10), SwarmOptions::new(50, 200), 1).expect("valid");
    let mut solver = solver.sequential();
    let mut problem = Problem::new(RASTRIGIN);
    let (mut state, _) = solver.init(&mut problem, PopulationState::new()).expect("starts");
    let mut taken = Some(std::mem::replace(&mut state, PopulationState::new()));
    let counts = measure(|| {
        for _ in 0..200 {
            let before = taken.take().expect("a state");
            let (mut state, _) = solver.next_iter(&mut problem, before).expect("goes on");
            state.update();
            state.increment_iter();
            taken = Some(state);
        }
    });
    // Log, best point and history: per generation of fifty, where argmin's own takes twelve per evaluation.
    assert!(counts.count_total <= 200 * 6, "{}", counts.count_total);
}
