//! Costs that fail, and limits that hold.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

mod common;

use argmin::core::{CostFunction, Error, Executor, State, TerminationReason};
use argmin::solver::particleswarm;
use common::{SPHERE, by_hand};
use optimize::{
    Boundary, Cost, InitialVelocity, ParticleSwarm, Schedule, Stall, Stop, Swarm, SwarmError, SwarmOptions,
    Topology,
};
use profiles::Interval;
use proptest::prelude::*;
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};

/// A sphere about (1, 1) that is NaN outside the disc of radius 4 about it: in about half of the box.
struct Disc;

impl CostFunction for Disc {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        let square: f64 = x.iter().map(|x| (x - 1.0) * (x - 1.0)).sum();
        Ok(if square < 16.0 { square } else { f64::NAN })
    }
}

#[test]
fn no_run_is_lost_to_nan() {
    let bounds = [Interval::symmetric(5.0); 2];
    for seed in 0..100 {
        let solver = ParticleSwarm::new(&bounds, SwarmOptions::new(50, 60), seed).expect("valid");
        let result = Executor::new(Disc, solver).run().expect("runs");
        assert!(result.state().get_best_cost() < 1e-6, "{seed}: {}", result.state().get_best_cost());
        assert!(result.solver.swarm().history()[0].failed > 10);
    }
    // The same costs stop argmin's swarm: this is why ranks are ours.
    let lost = (0..20)
        .filter(|seed| {
            std::panic::catch_unwind(|| {
                let ends = (vec![-5.0; 2], vec![5.0; 2]);
                let solver = particleswarm::ParticleSwarm::<Vec<f64>, f64, _>::new(ends, 50)
                    .with_rng_generator(Xoshiro256PlusPlus::seed_from_u64(*seed));
                Executor::new(Disc, solver).configure(|state| state.max_iters(60)).run().expect("runs");
            })
            .is_err()
        })
        .count();
    assert!(lost > 10, "{lost}");
}

/// Feasible at one point in two hundred, an error on one side, a violation on the other.
struct Corner;

impl CostFunction for Corner {
    type Param = Vec<f64>;
    type Output = Cost;
    fn cost(&self, x: &Vec<f64>) -> Result<Cost, Error> {
        match x[..] {
            [x, _] if x < 0.0 => Err(Error::msg("the loop is unstable")),
            [x, y] if x + y < 9.0 => Ok(Cost::Infeasible(9.0 - x - y)),
            [x, y] => Ok(Cost::Ok(x * x + y * y)),
            _ => Err(Error::msg("two dimensions")),
        }
    }
}

#[test]
fn errors_and_violations_lead_to_the_feasible_corner() {
    for topology in [Topology::Global, Topology::Ring { reach: 1 }] {
        let options = SwarmOptions { topology, ..SwarmOptions::new(30, 300) };
        let solver = ParticleSwarm::new(&[Interval::symmetric(5.0); 2], options, 3).expect("valid");
        let result = Executor::new(Corner, solver).run().expect("runs");
        // On the constraint x + y = 9 the least of x^2 + y^2 is 40.5, at its ends 41. Along a constraint a swarm
        // comes to rest early: measured 40.505.
        let best = result.state().get_best_cost();
        assert!((40.5..40.55).contains(&best), "{best}");
        let history = result.solver.swarm().history();
        assert!(history[0].failed > 5 && matches!(history[0].best, Cost::Infeasible(_)));
        assert!(history.windows(2).all(|pair| pair[1].best <= pair[0].best));
    }
}

#[test]
fn a_search_without_an_answer_says_so() {
    struct Never;
    impl CostFunction for Never {
        type Param = Vec<f64>;
        type Output = f64;
        fn cost(&self, _: &Vec<f64>) -> Result<f64, Error> {
            Err(Error::msg("never"))
        }
    }
    let options = SwarmOptions::new(10, 20);
    let solver = ParticleSwarm::new(&[Interval::symmetric(1.0); 3], options, 1).expect("valid");
    let result = Executor::new(Never, solver).run().expect("runs");
    assert_eq!(result.solver.swarm().best().1, Cost::Failed);
    assert_eq!(result.state().get_best_param(), None);
    // It has looked everywhere all the same: a box of evenly scattered points spreads by the root of 1/12.
    let last = result.solver.swarm().history().last().expect("a generation");
    assert!(last.failed == 10 && (last.spread - 0.29).abs() < 0.1, "{}", last.spread);
}

#[test]
fn a_failure_attracts_nobody() {
    // All pull is to the own best: who has only failed keeps its speed, though a bound may turn it.
    let options = SwarmOptions {
        inertia: Schedule::Constant(1.0),
        social: Schedule::Constant(0.0),
        initial_velocity: InitialVelocity::Uniform,
        velocity_limit: 0.01,
        ..SwarmOptions::new(4, 10)
    };
    let mut swarm = Swarm::new(&[Interval::symmetric(1.0); 2], options, 9).expect("valid");
    let speeds = |swarm: &Swarm| -> Vec<Vec<f64>> {
        swarm.velocities().map(|v| v.iter().map(|v| v.abs()).collect()).collect()
    };
    let start = speeds(&swarm);
    for _ in 0..5 {
        swarm.tell(&[Cost::Failed, Cost::Ok(1.0), Cost::Failed, Cost::Failed]).expect("four");
    }
    let kept: Vec<bool> = speeds(&swarm).iter().zip(&start).map(|(now, start)| now == start).collect();
    assert_eq!(kept, [true, false, true, true]);
}

#[test]
fn searches_stop_for_their_reason() {
    let plain = SwarmOptions::new(20, 500);
    let run = |options| {
        let swarm = by_hand(Swarm::new(&SPHERE.bounds(2), options, 1).expect("valid"), SPHERE.value);
        let solver = ParticleSwarm::new(&SPHERE.bounds(2), options, 1).expect("valid");
        let state = Executor::new(SPHERE, solver).run().expect("runs").state;
        (swarm.stop().expect("stopped"), swarm, state.get_termination_reason().cloned())
    };
    let (stop, swarm, reason) = run(plain);
    assert_eq!((stop, reason), (Stop::Iterations, Some(TerminationReason::MaxItersReached)));
    assert_eq!(swarm.evaluations(), 20 * 501);
    let (stop, swarm, reason) = run(SwarmOptions { target: Some(1e-6), ..plain });
    assert_eq!((stop, reason), (Stop::Target, Some(TerminationReason::TargetCostReached)));
    let bests: Vec<f64> = swarm.history().iter().rev().filter_map(|p| p.best.value()).take(2).collect();
    assert!(bests[0] <= 1e-6 && bests[1] > 1e-6);
    let stall = Stall { iterations: 15, absolute: 1e-9, relative: 0.0 };
    let (stop, swarm, reason) = run(SwarmOptions { stall: Some(stall), ..plain });
    assert_eq!((stop, reason), (Stop::Stalled, Some(TerminationReason::SolverConverged)));
    let bests: Vec<f64> = swarm.history().iter().filter_map(|p| p.best.value()).collect();
    let last = bests.len() - 1;
    assert!(bests[last - 15] - bests[last] <= 1e-9 && bests[last - 16] - bests[last - 15] > 1e-9);
}

#[test]
fn schedules_are_applied() {
    // Without pulls a velocity is its start times the product of the inertias.
    let inertia = Schedule::Linear { from: 0.9, to: 0.3 };
    let none = Schedule::Constant(0.0);
    let options = SwarmOptions {
        inertia,
        cognitive: none,
        social: none,
        initial_velocity: InitialVelocity::Uniform,
        velocity_limit: 0.01,
        ..SwarmOptions::new(5, 4)
    };
    let mut swarm = Swarm::new(&[Interval::symmetric(1.0); 2], options, 5).expect("valid");
    let speeds = |swarm: &Swarm| swarm.velocities().flatten().map(|v| v.abs()).collect::<Vec<_>>();
    for factor in [0.9, 0.7, 0.5, 0.3, 0.3] {
        let before = speeds(&swarm);
        swarm.tell(&[Cost::Ok(1.0); 5]).expect("five");
        for (now, before) in speeds(&swarm).into_iter().zip(before) {
            assert!((now - factor * before).abs() < 1e-16, "{now} {before}");
        }
    }
    // Exact at the ends.
    for (index, moves, value) in [(0, 4, 0.9_f64), (3, 4, 0.3), (9, 4, 0.3), (0, 1, 0.9)] {
        assert_eq!(inertia.at(index, moves).to_bits(), value.to_bits(), "{index} of {moves}");
    }
}

#[test]
fn guesses_come_first() {
    let bounds = [Interval::new(0.0, 1.0), Interval::new(10.0, 20.0)];
    let swarm = || Swarm::new(&bounds, SwarmOptions::new(3, 5), 1).expect("valid");
    let guessed = swarm().with_guesses(&[vec![0.5, 11.0], vec![1.0, 20.0]]).expect("inside");
    assert_eq!(guessed.ask()[..2], [vec![0.5, 11.0], vec![1.0, 20.0]]);
    assert_eq!(guessed.ask()[2], swarm().ask()[2]);
    let error = |guesses: &[Vec<f64>]| swarm().with_guesses(guesses).expect_err("refused");
    assert_eq!(error(&[vec![0.5, 9.0]]), SwarmError::Guess { dimension: 1, value: 9.0 });
    assert_eq!(error(&[vec![0.5]]), SwarmError::GuessLength { given: 1, dimensions: 2 });
    assert_eq!(error(&vec![vec![0.5, 11.0]; 4]), SwarmError::Guesses { given: 4, particles: 3 });
    let mut told = swarm();
    told.tell(&[Cost::Failed; 3]).expect("three");
    assert_eq!(told.with_guesses(&[]), Err(SwarmError::Late(1)));
}

#[test]
fn bad_swarms_are_named() {
    let bounds = [Interval::symmetric(1.0)];
    let good = SwarmOptions::new(3, 5);
    let error = |options| Swarm::new(&bounds, options, 1).expect_err("refused");
    let nan = Schedule::Constant(f64::NAN);
    assert!(matches!(error(SwarmOptions { particles: 0, ..good }), SwarmError::Count { given: 0, .. }));
    assert!(matches!(error(SwarmOptions { particles: usize::MAX, ..good }), SwarmError::Count { .. }));
    assert!(matches!(error(SwarmOptions { inertia: nan, ..good }), SwarmError::Number { .. }));
    let rising = Schedule::Linear { from: 0.0, to: -1.0 };
    assert!(matches!(error(SwarmOptions { social: rising, ..good }), SwarmError::Number { value: -1.0, .. }));
    for velocity_limit in [0.0, -0.1, 1.1, f64::NAN] {
        assert!(matches!(error(SwarmOptions { velocity_limit, ..good }), SwarmError::Number { .. }));
    }
    let ring = Topology::Ring { reach: 0 };
    assert!(matches!(error(SwarmOptions { topology: ring, ..good }), SwarmError::Count { given: 0, .. }));
    let target = Some(f64::NEG_INFINITY);
    assert!(matches!(error(SwarmOptions { target, ..good }), SwarmError::Number { .. }));
    for (iterations, relative) in [(0, 0.0), (1, -1.0)] {
        let stall = Some(Stall { iterations, absolute: 0.0, relative });
        assert!(Swarm::new(&bounds, SwarmOptions { stall, ..good }, 1).is_err());
    }
    assert_eq!(Swarm::new(&[], good, 1), Err(SwarmError::NoDimension));
    for bad in [Interval::new(1.0, 1.0), Interval::UNBOUNDED, Interval::symmetric(f64::MAX)] {
        assert!(matches!(
            Swarm::new(&[bounds[0], bad], good, 1),
            Err(SwarmError::Bounds { dimension: 1, .. })
        ));
    }
    let mut swarm = Swarm::new(&bounds, good, 1).expect("valid");
    assert_eq!(swarm.tell(&[Cost::Failed; 2]), Err(SwarmError::Costs { given: 2, particles: 3 }));
}

fn costs() -> impl Strategy<Value = Cost> {
    prop_oneof![
        any::<f64>().prop_map(Cost::Ok),
        (-10.0..10.0_f64).prop_map(Cost::Ok),
        any::<f64>().prop_map(Cost::Infeasible),
        Just(Cost::Failed),
    ]
}

fn schedule(upper: f64) -> impl Strategy<Value = Schedule> {
    prop_oneof![
        (0.0..upper).prop_map(Schedule::Constant),
        (0.0..upper, 0.0..upper).prop_map(|(from, to)| Schedule::Linear { from, to }),
        Just(Schedule::Constant(1e308)),
    ]
}

fn any_options() -> impl Strategy<Value = SwarmOptions> {
    let topology =
        prop_oneof![Just(Topology::Global), (1..9_usize).prop_map(|reach| Topology::Ring { reach })];
    let boundary = prop_oneof![Just(Boundary::Clamp), Just(Boundary::Absorb), Just(Boundary::Reflect)];
    let start = prop_oneof![Just(InitialVelocity::Zero), Just(InitialVelocity::Uniform)];
    (topology, boundary, start, 1e-3..1.0_f64, [schedule(2.0), schedule(4.0), schedule(4.0)]).prop_map(
        |(topology, boundary, initial_velocity, velocity_limit, [inertia, cognitive, social])| SwarmOptions {
            topology,
            boundary,
            initial_velocity,
            velocity_limit,
            inertia,
            cognitive,
            social,
            ..SwarmOptions::new(7, 12)
        },
    )
}

proptest! {
    #[test]
    fn bounds_and_velocity_limit_hold_whatever_is_told(
        options in any_options(), seed in any::<u64>(), told in prop::collection::vec(costs(), 7 * 12),
        box_of in prop::collection::vec((-1e3..1e3_f64, prop_oneof![1e-9..1e3_f64, Just(1e300)]), 1..4)
    ) {
        let bounds: Vec<Interval> = box_of.iter().map(|(low, width)| Interval::new(*low, low + width)).collect();
        let mut swarm = Swarm::new(&bounds, options, seed).expect("valid");
        let mut best = Cost::Failed;
        for costs in told.chunks_exact(7) {
            let before = swarm.ask().to_vec();
            let progress = swarm.tell(costs).expect("seven");
            let least = costs.iter().map(|c| c.checked()).fold(best, |a, b| if b < a { b } else { a });
            prop_assert_eq!(progress.best, least);
            best = least;
            prop_assert!((0.0..=0.51).contains(&progress.spread), "{}", progress.spread);
            let scattered = best == Cost::Failed || options.topology != Topology::Global;
            for ((x, v), before) in swarm.ask().iter().zip(swarm.velocities()).zip(before) {
                for (((x, v), bounds), before) in x.iter().zip(v).zip(&bounds).zip(before) {
                    let limit = options.velocity_limit * (bounds.upper - bounds.lower);
                    prop_assert!(bounds.contains(*x), "{} {:?}", x, bounds);
                    // A rounding of the bound.
                    prop_assert!(v.abs() <= limit * (1.0 + 1e-15) + 1e-13 * bounds.magnitude(), "{} {}", v, limit);
                    // A step is no longer than the limit either, but for particles that are drawn anew.
                    let step = (x - before).abs();
                    prop_assert!(scattered || step <= limit + 1e-13 * bounds.magnitude(), "{} {}", step, limit);
                }
            }
        }
        let (position, cost) = swarm.best();
        prop_assert_eq!(cost, best);
        prop_assert!(position.iter().zip(&bounds).all(|(x, bounds)| bounds.contains(*x)));
    }
}
