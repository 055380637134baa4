//! Degree reduction by three searches with the same number of evaluations, and by the deterministic way.

use std::time::{Duration, Instant};

use anyhow::Result;
use argmin::core::Executor;
use optimize::reduction::{Criterion, Freed, Reduced, Reduction, ReductionSearch, Weights, deviation};
use optimize::{GeneticOptions, GeneticSwarm, Mates, reduce_degree};
use profiles::nurbs::NurbsCurve;

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// Particles and iterations of the patent.
const POPULATION: usize = 400;
const ITERATIONS: u64 = 1000;
/// Parameters at which a search looks at the deviation.
const SAMPLES: usize = 201;

/// The searches, by name.
pub(super) const METHODS: [&str; 3] = ["swarm", "genetic", "hybrid"];

/// What is free in a search, by name.
pub(super) const SETTINGS: [(&str, Freed); 3] = [
    ("points", Freed::Points),
    ("points-weights", Freed::PointsAndWeights),
    ("points-weights-knots", Freed::All),
];

/// The options of a method, so that all evaluate equally often: in one generation a swarm evaluates all particles, a
/// genetic algorithm the children of half of them, the hybrid both. Its mates are from the pool, as the patent has it.
fn options(method: &str, iterations: u64) -> GeneticOptions {
    match method {
        "swarm" => GeneticOptions { pool: 0.0, ..GeneticOptions::new(POPULATION, 3 * iterations / 2) },
        "genetic" => GeneticOptions::genetic(POPULATION, 3 * iterations),
        _ => GeneticOptions { mates: Mates::Pool, ..GeneticOptions::new(POPULATION, iterations) },
    }
}

/// A search after its run.
pub(super) struct Searched<const D: usize> {
    /// The best curve.
    pub(super) curve: NurbsCurve<D>,
    /// Its certified deviation, m.
    pub(super) deviation: f64,
    /// How often the cost was evaluated.
    pub(super) evaluations: u64,
    /// Evaluations and the best deviation at the samples so far, m.
    pub(super) history: Vec<(f64, f64)>,
    /// How long it took.
    pub(super) time: Duration,
}

/// One curve under one setting.
pub(super) struct Compared<const D: usize> {
    /// For every method its runs, one for each seed.
    pub(super) searches: [Vec<Searched<D>>; 3],
    /// The deterministic way.
    pub(super) deterministic: Reduced<D>,
    /// How long that took.
    pub(super) time: Duration,
}

/// Reduces a curve in every way.
pub(super) fn compare<const D: usize>(
    curve: &NurbsCurve<D>,
    to: usize,
    freed: Freed,
    seeds: std::ops::Range<u64>,
    quick: bool,
) -> Result<Compared<D>> {
    let weights = if freed == Freed::Points { Weights::Ones } else { Weights::Free };
    let reduction = Reduction { weights, ..Reduction::to(to) };
    let started = Instant::now();
    let deterministic = reduce_degree(curve, &reduction)?;
    let time = started.elapsed();
    // It gives the searches what they do not free: knots and weights.
    let start = reduce_degree(curve, &Reduction { criterion: Criterion::MeanSquare, ..reduction })?;
    let problem = ReductionSearch::new(curve, &start.curve, freed, SAMPLES)?;
    let iterations = if quick { 20 } else { ITERATIONS };
    let run = |method: &str, seed: u64| -> Result<Searched<D>> {
        let options = options(method, iterations);
        let started = Instant::now();
        let solver = GeneticSwarm::new(problem.bounds(), options, seed)?;
        let result = Executor::new(problem.clone(), solver).run()?;
        let (time, search) = (started.elapsed(), result.solver.search());
        let found = problem.curve(search.best().0)?;
        let generations = search.history().len().saturating_sub(1).max(1) as f64;
        let each = (search.evaluations() - POPULATION as u64) as f64 / generations;
        let points = search.history().iter().enumerate().filter_map(|(n, progress)| {
            let best = progress.best.value()?;
            Some((POPULATION as f64 + each * n as f64, best))
        });
        Ok(Searched {
            deviation: deviation(curve, &found)?.at_most,
            curve: found,
            evaluations: search.evaluations(),
            history: points.collect(),
            time,
        })
    };
    let mut searches = [Vec::new(), Vec::new(), Vec::new()];
    for (method, runs) in METHODS.into_iter().zip(&mut searches) {
        *runs = seeds.clone().map(|seed| run(method, seed)).collect::<Result<_>>()?;
    }
    Ok(Compared { searches, deterministic, time })
}

/// The median of numbers, the lower one of two.
pub(super) fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len().saturating_sub(1) / 2).copied().unwrap_or(f64::NAN)
}
