//! Degree reduction: the deterministic way, the certificate, and the published search.
#![expect(clippy::expect_used, reason = "curves that are known to be valid")]

use std::hint::black_box;

use argmin::core::{Error, Executor};
use criterion::{Criterion, criterion_group, criterion_main};
use optimize::reduction::{Criterion as Least, Freed, Reduction, ReductionSearch, Weights, deviation};
use optimize::{GeneticOptions, GeneticSwarm, reduce_degree};
use profiles::nurbs::NurbsCurve;

#[path = "../tests/common/curves.rs"]
mod curves;

fn deterministic(criterion: &mut Criterion) {
    let quartic = curves::cubic().raised(1).expect("valid");
    let mut group = criterion.benchmark_group("reduce_degree");
    let all = [("quintic to 3", curves::quintic(), 3), ("quintic to 4", curves::quintic(), 4)];
    let knotted = [("four spans to 2", quartic.clone(), 2), ("four spans to 3, exact", quartic, 3)];
    for (name, curve, degree) in
        all.into_iter().chain(knotted).chain([("butterfly to 2", curves::butterfly(), 2)])
    {
        for (weights, label) in [(Weights::Ones, "weights of one"), (Weights::Free, "weights free")] {
            let reduction = Reduction { weights, ..Reduction::to(degree) };
            group.bench_function(format!("{name}, {label}"), |b| {
                b.iter(|| reduce_degree(black_box(&curve), &reduction));
            });
        }
    }
    let solid = curves::spatial();
    group.bench_function("spatial to 3, weights free", |b| {
        b.iter(|| reduce_degree(black_box(&solid), &Reduction::to(3)))
    });
    let within = Reduction::within(1e-3, Some(3));
    group.bench_function("quintic to 3 within 1e-3", |b| {
        let quintic = curves::quintic();
        b.iter(|| reduce_degree(black_box(&quintic), &within));
    });
    let lower = reduce_degree(&solid, &Reduction::to(3)).expect("reduces").curve;
    group
        .bench_function("deviation, spatial", |b| b.iter(|| deviation(black_box(&solid), black_box(&lower))));
    group.finish();
}

fn start<const D: usize>(curve: &NurbsCurve<D>, degree: usize, freed: Freed) -> ReductionSearch<D> {
    let plain = Reduction { weights: Weights::Ones, criterion: Least::MeanSquare, ..Reduction::to(degree) };
    let start = reduce_degree(curve, &plain).expect("reduces").curve;
    ReductionSearch::new(curve, &start, freed, 201).expect("valid")
}

fn searches(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("hybrid, 400 x 1000");
    group.sample_size(10);
    let quartic = curves::cubic().raised(1).expect("valid");
    for (name, freed) in [("fixed knots", Freed::PointsAndWeights), ("free knots", Freed::All)] {
        let search = start(&quartic, 3, freed);
        let guess = search.guess();
        group.bench_function(format!("four spans to 3, {name}, one cost"), |b| {
            b.iter(|| search.cost(black_box(&guess)))
        });
        group.bench_function(format!("four spans to 3, {name}"), |b| {
            b.iter(|| {
                let solver = GeneticSwarm::new(search.bounds(), GeneticOptions::new(400, 1000), 1)?;
                Ok::<_, Error>(Executor::new(search.clone(), solver).run()?.solver)
            });
        });
        let search = start(&curves::spatial(), 3, freed);
        group.bench_function(format!("spatial to 3, {name}"), |b| {
            b.iter(|| {
                let solver = GeneticSwarm::new(search.bounds(), GeneticOptions::new(400, 1000), 1)?;
                Ok::<_, Error>(Executor::new(search.clone(), solver).run()?.solver)
            });
        });
    }
    group.finish();
}

criterion_group!(benches, deterministic, searches);
criterion_main!(benches);
