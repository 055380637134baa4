//! A swarm with a genetic pool: one answer whatever the way to it, its degenerate settings, costs that fail, quality.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

mod common;

use argmin::core::{CostFunction, Error, Executor, State};
use common::{RASTRIGIN, ROSENBROCK, SPHERE, by_hand, median};
use optimize::{
    Boundary, Breeding, Cost, Crossover, GeneticOptions, GeneticSwarm, Mates, Mutation, Schedule, Swarm,
    SwarmError, SwarmOptions, Topology,
};
use profiles::Interval;
use proptest::prelude::*;

const DIMENSIONS: usize = 5;

/// Pool sizes, operators and mates of every kind.
fn options() -> [GeneticOptions; 5] {
    let plain = GeneticOptions::new(24, 60);
    let ring =
        SwarmOptions { topology: Topology::Ring { reach: 2 }, boundary: Boundary::Absorb, ..plain.swarm };
    let near = Mutation::Nearby { reach: 0.1 };
    [
        plain,
        GeneticOptions { swarm: ring, mates: Mates::Pool, crossover: Crossover::Arithmetic, ..plain },
        GeneticOptions { pool: 1.0, crossover: Crossover::Blend { beyond: 0.5 }, mutation: near, ..plain },
        GeneticOptions { pool: 0.0, ..plain },
        GeneticOptions::genetic(24, 60),
    ]
}

fn search(options: GeneticOptions) -> Breeding {
    Breeding::new(&RASTRIGIN.bounds(DIMENSIONS), options, 11).expect("valid")
}

fn to_the_end(mut search: Breeding, value: fn(&[f64]) -> f64) -> Breeding {
    while search.stop().is_none() {
        let costs: Vec<_> = search.ask().iter().map(|x| value(x).into()).collect();
        search.tell(&costs).expect("as many as asked for");
    }
    search
}

#[test]
fn by_hand_and_by_argmin() {
    for options in options() {
        let hand = to_the_end(search(options), RASTRIGIN.value);
        for solver in [GeneticSwarm::from(search(options)), GeneticSwarm::from(search(options)).sequential()]
        {
            let result =
                Executor::new(RASTRIGIN, solver).configure(|state| state.counting(true)).run().expect("runs");
            assert_eq!(result.solver.search(), &hand);
            let (position, cost) = hand.best();
            assert_eq!(result.state().get_best_param().map(Vec::as_slice), Some(position));
            assert_eq!(Some(result.state().get_best_cost()), cost.value());
            assert_eq!(result.state().get_func_counts().get("cost_count"), Some(&hand.evaluations()));
        }
    }
}

#[test]
fn evaluations_are_counted() {
    let counts = options().map(|options| to_the_end(search(options), RASTRIGIN.value).evaluations());
    // Particles and children of 61 generations; without flight the particles once and then children only.
    assert_eq!(counts, [61 * 36, 61 * 36, 61 * 48, 61 * 24, 24 + 61 * 12]);
}

#[test]
fn on_any_number_of_threads() {
    for options in options() {
        let hand = to_the_end(search(options), RASTRIGIN.value);
        for threads in [1, 2, 3, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            let run = || Executor::new(RASTRIGIN, GeneticSwarm::from(search(options))).run().expect("runs");
            assert_eq!(pool.install(run).solver.search(), &hand, "{threads} threads");
        }
    }
}

#[test]
fn told_half_way_and_handed_to_argmin() {
    for options in options() {
        let hand = to_the_end(search(options), RASTRIGIN.value);
        // An odd number of times: between the particles and their children.
        let mut half = search(options);
        for _ in 0..21 {
            let costs: Vec<_> = half.ask().iter().map(|x| (RASTRIGIN.value)(x).into()).collect();
            half.tell(&costs).expect("as many as asked for");
        }
        let result = Executor::new(RASTRIGIN, GeneticSwarm::from(half)).run().expect("runs");
        assert_eq!(result.solver.search(), &hand);
    }
}

#[test]
fn an_empty_pool_is_a_plain_swarm() {
    for swarm in [SwarmOptions::new(24, 60), GeneticOptions::new(24, 60).swarm, options()[1].swarm] {
        let options = GeneticOptions { swarm, pool: 0.0, ..GeneticOptions::new(24, 60) };
        let bred = to_the_end(search(options), RASTRIGIN.value);
        let bounds = RASTRIGIN.bounds(DIMENSIONS);
        let plain = by_hand(Swarm::new(&bounds, swarm, 11).expect("valid"), RASTRIGIN.value);
        assert_eq!(bred.swarm(), &plain);
        assert_eq!(bred.evaluations(), plain.evaluations());
    }
}

#[test]
fn without_pulls_children_are_a_genetic_algorithm_of_their_own() {
    // Particles that cannot move find nothing after the first generation: what is better is bred.
    let still = Schedule::Constant(0.0);
    let plain = GeneticOptions::genetic(40, 100);
    let swarm = SwarmOptions { inertia: still, cognitive: still, social: still, ..plain.swarm };
    let resting = to_the_end(search(GeneticOptions { swarm, flight: true, ..plain }), RASTRIGIN.value);
    let genetic = to_the_end(search(plain), RASTRIGIN.value);
    for search in [&resting, &genetic] {
        let bests: Vec<f64> = search.history().iter().filter_map(|line| line.best.value()).collect();
        assert!(bests.windows(2).all(|pair| pair[1] <= pair[0]));
        assert!(bests[100] < 0.1 * bests[0], "{} {}", bests[0], bests[100]);
    }
    // Only the genetic algorithm moves its population to the bests.
    let spread = |search: &Breeding, n: usize| search.history()[n].spread;
    assert!((spread(&resting, 100) - spread(&resting, 0)).abs() < 1e-15);
    assert!(spread(&genetic, 100) < 0.5 * spread(&genetic, 0));
}

#[test]
fn the_better_part_passes_on() {
    // Costs by place: the particles with the better half of them keep their bests whatever the children are worth.
    let options = GeneticOptions { swarm: SwarmOptions::new(6, 10), ..GeneticOptions::new(6, 10) };
    let mut search = search(options);
    let start = search.ask().to_vec();
    assert_eq!(search.tell(&[5.0, 1.0, 4.0, 2.0, 3.0, 6.0].map(Cost::Ok)), Ok(None));
    assert_eq!(search.ask().len(), 3);
    let progress = search.tell(&[Cost::Ok(0.5); 3]).expect("three").expect("complete");
    assert_eq!((progress.iteration, progress.best), (0, Cost::Ok(0.5)));
    // The particles that stood at 6, 5 and 4 are followed by their children: the best is the first of them, 0.
    let bests = search.best();
    assert!(bests.0 != start[0].as_slice() && bests.1 == Cost::Ok(0.5));
    // A worse child changes nothing.
    let before = search.clone();
    assert_eq!(search.tell(&[Cost::Ok(9.0); 6]), Ok(None));
    search.tell(&[Cost::Ok(8.0); 3]).expect("three");
    assert_eq!(search.best(), before.best());
}

#[test]
fn schedules_are_the_published_ones() {
    let options = GeneticOptions::new(400, 1000);
    for t in 1..=1000_u64 {
        let published = 1.2 + 0.8 * (1000 - t) as f64 / 1000.0;
        for pull in [options.swarm.cognitive, options.swarm.social] {
            assert!((pull.at(t - 1, 1000) - published).abs() < 1e-15);
        }
    }
    assert_eq!((options.swarm.particles, options.swarm.iterations), (400, 1000));
    assert_eq!(options.swarm.inertia, Schedule::Constant(0.675));
}

/// A sphere about (1, 1) in a disc; NaN, an error or a violation around it.
struct Disc;

impl CostFunction for Disc {
    type Param = Vec<f64>;
    type Output = Cost;
    fn cost(&self, x: &Vec<f64>) -> Result<Cost, Error> {
        let square: f64 = x.iter().map(|x| (x - 1.0) * (x - 1.0)).sum();
        match x[..] {
            _ if square < 4.0 => Ok(Cost::Ok(square)),
            [x, y] if x > y => Ok(Cost::Infeasible(square)),
            [x, _] if x > 0.0 => Ok(Cost::Ok(f64::NAN)),
            _ => Err(Error::msg("unstable")),
        }
    }
}

#[test]
fn no_run_is_lost_to_failures() {
    let bounds = [Interval::symmetric(5.0); 2];
    let genetic = GeneticOptions::genetic(50, 300);
    for (options, bound) in [(GeneticOptions::new(50, 60), 1e-8), (genetic, 1e-2)] {
        for seed in 0..50 {
            let solver = GeneticSwarm::new(&bounds, options, seed).expect("valid");
            let result = Executor::new(Disc, solver).run().expect("runs");
            let best = result.state().get_best_cost();
            assert!(best < bound, "{seed}: {best}");
            assert!(result.solver.search().history()[0].failed > 10);
        }
    }
}

#[test]
fn a_search_without_an_answer_looks_everywhere() {
    for options in [GeneticOptions::new(10, 20), GeneticOptions::genetic(10, 20)] {
        let mut search = Breeding::new(&[Interval::symmetric(1.0); 3], options, 1).expect("valid");
        let mut seen = search.ask().to_vec();
        while search.stop().is_none() {
            search.tell(&vec![Cost::Failed; search.ask().len()]).expect("all");
            seen.extend_from_slice(search.ask());
        }
        assert_eq!(search.best().1, Cost::Failed);
        assert_eq!(search.history()[3].failed, if options.flight { 15 } else { 5 });
        // A quarter of all candidates in each half of each half, within five standard deviations.
        let count = seen.len() as f64;
        let quarter = seen.iter().filter(|x| x[0] > 0.0 && x[1] > 0.0).count() as f64;
        assert!((quarter - 0.25 * count).abs() < 5.0 * (0.1875 * count).sqrt(), "{quarter} of {count}");
    }
}

#[test]
fn a_pool_helps_a_swarm_and_flight_helps_a_pool() {
    let hybrid = GeneticOptions::new(400, 1000);
    let best = |options: GeneticOptions| {
        let run = |seed| {
            let search = Breeding::new(&RASTRIGIN.bounds(30), options, seed).expect("valid");
            to_the_end(search, RASTRIGIN.value).best().1.value().expect("a cost")
        };
        median((0..3).map(run).collect())
    };
    // As many evaluations: 400 and 200 in 1001 generations, 400 in 1502.
    let swarm = SwarmOptions { iterations: 1501, ..hybrid.swarm };
    let (both, swarm) = (best(hybrid), best(GeneticOptions { swarm, pool: 0.0, ..hybrid }));
    println!("Rastrigin in 30 dimensions: hybrid {both}, swarm {swarm}");
    assert!(both < 1e-6 && swarm > 10.0, "{both} {swarm}");
    // In a smooth valley the genetic part alone is slow: again as many evaluations.
    let valley = |options: GeneticOptions| {
        let run = |seed| {
            let search = Breeding::new(&ROSENBROCK.bounds(5), options, seed).expect("valid");
            to_the_end(search, ROSENBROCK.value).best().1.value().expect("a cost")
        };
        median((0..9).map(run).collect())
    };
    let (both, genetic) = (valley(GeneticOptions::new(60, 400)), valley(GeneticOptions::genetic(60, 1200)));
    println!("Rosenbrock in 5 dimensions: hybrid {both:e}, genetic {genetic:e}");
    assert!(both < 0.5 * genetic, "{both} {genetic}");
}

#[test]
fn guesses_come_first() {
    let guess = vec![0.25; DIMENSIONS];
    for options in options() {
        let guessed = search(options).with_guesses(std::slice::from_ref(&guess)).expect("inside");
        assert_eq!(guessed.ask()[0], guess);
        let mut told = search(options);
        told.tell(&[Cost::Failed; 24]).expect("all");
        assert_eq!(told.with_guesses(&[]), Err(SwarmError::Late(1)));
    }
    assert!(to_the_end(search(options()[0]), SPHERE.value).best().1 < Cost::Ok(1e-3));
}

#[test]
fn bad_searches_are_named() {
    let good = GeneticOptions::new(3, 5);
    let error = |options| Breeding::new(&[Interval::symmetric(1.0)], options, 1).expect_err("refused");
    for bad in [-0.1, 1.1, f64::NAN] {
        for options in [
            GeneticOptions { pool: bad, ..good },
            GeneticOptions { crossover_rate: bad, ..good },
            GeneticOptions { mutation_rate: bad, ..good },
            GeneticOptions { mutation: Mutation::Nearby { reach: bad }, ..good },
        ] {
            let SwarmError::Number { value, .. } = error(options) else { panic!("{options:?}") };
            assert_eq!(value.to_bits(), bad.to_bits());
        }
    }
    for beyond in [-0.1, f64::INFINITY, f64::NAN] {
        let options = GeneticOptions { crossover: Crossover::Blend { beyond }, ..good };
        assert!(matches!(error(options), SwarmError::Number { .. }));
    }
    let idle = GeneticOptions { pool: 0.1, ..GeneticOptions::genetic(3, 5) };
    assert!(matches!(error(idle), SwarmError::Number { value: 0.1, .. }));
    let none = GeneticOptions { swarm: SwarmOptions::new(0, 5), ..good };
    assert!(matches!(error(none), SwarmError::Count { given: 0, .. }));
    let mut search = search(good);
    assert_eq!(search.tell(&[Cost::Failed; 2]), Err(SwarmError::Costs { given: 2, particles: 3 }));
    search.tell(&[Cost::Failed; 3]).expect("three");
    // Half of three, rounded: two children.
    assert_eq!(search.tell(&[Cost::Failed; 3]), Err(SwarmError::Costs { given: 3, particles: 2 }));
}

fn costs() -> impl Strategy<Value = Cost> {
    prop_oneof![
        any::<f64>().prop_map(Cost::Ok),
        (-10.0..10.0_f64).prop_map(Cost::Ok),
        any::<f64>().prop_map(Cost::Infeasible),
        Just(Cost::Failed),
    ]
}

fn any_options() -> impl Strategy<Value = GeneticOptions> {
    let crossover = prop_oneof![
        Just(Crossover::Arithmetic),
        Just(Crossover::Uniform),
        prop_oneof![0.0..2.0_f64, Just(1e308)].prop_map(|beyond| Crossover::Blend { beyond }),
    ];
    let mutation =
        prop_oneof![Just(Mutation::Anywhere), (1e-6..1.0_f64).prop_map(|reach| Mutation::Nearby { reach })];
    let mates = prop_oneof![Just(Mates::Pool), Just(Mates::All)];
    (any::<bool>(), 0.2..=1.0_f64, mates, crossover, 0.0..=1.0_f64, mutation, 0.0..=1.0_f64).prop_map(
        |(flight, pool, mates, crossover, crossover_rate, mutation, mutation_rate)| GeneticOptions {
            swarm: SwarmOptions::new(7, 12),
            flight,
            pool,
            mates,
            crossover,
            crossover_rate,
            mutation,
            mutation_rate,
        },
    )
}

proptest! {
    #[test]
    fn bounds_hold_and_the_best_is_kept_whatever_is_told(
        options in any_options(), seed in any::<u64>(), told in prop::collection::vec(costs(), 7 * 24),
        box_of in prop::collection::vec((-1e3..1e3_f64, prop_oneof![1e-9..1e3_f64, Just(1e300)]), 1..4)
    ) {
        let bounds: Vec<Interval> = box_of.iter().map(|(low, width)| Interval::new(*low, low + width)).collect();
        let mut search = Breeding::new(&bounds, options, seed).expect("valid");
        let mut best = Cost::Failed;
        for costs in told.chunks_exact(7) {
            let candidates = search.ask().len();
            prop_assert!(search.ask().iter().all(|x| x.iter().zip(&bounds).all(|(x, b)| b.contains(*x))));
            best = costs.iter().take(candidates).map(|c| c.checked()).fold(best, |a, b| if b < a { b } else { a });
            if let Some(progress) = search.tell(&costs[..candidates]).expect("all") {
                prop_assert_eq!(progress.best, best);
            }
            prop_assert_eq!(search.best().1, best);
        }
        prop_assert!(search.best().0.iter().zip(&bounds).all(|(x, bounds)| bounds.contains(*x)));
    }
}
