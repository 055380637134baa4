//! Synthesis of a filter and one sample through a delay line.
#![expect(clippy::expect_used, reason = "a bench may fail loudly")]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use profiles::{Mode, Real};
use shaping::{DelayFilter, DelayLine, DelayLineState};

fn tick<F: Real>(criterion: &mut Criterion, name: &str) {
    let mode = Mode::from_hz(40.0, 0.02).expect("mode");
    let filter = DelayFilter::positive(mode, 0.0101).expect("filter");
    let line = DelayLine::<F, 6, 32>::new(filter.train(), mode, 1e-3).expect("line");
    let mut state = DelayLineState::at_rest(F::ZERO);
    criterion.bench_function(name, |b| b.iter(|| line.update(&mut state, black_box(F::ONE)).output));
}

fn shaping(criterion: &mut Criterion) {
    let mode = Mode::from_hz(40.0, 0.02).expect("mode");
    criterion.bench_function("delay filter", |b| b.iter(|| DelayFilter::positive(black_box(mode), 0.0101)));
    let filter = DelayFilter::positive(mode, 0.0101).expect("filter");
    criterion.bench_function("residual", |b| b.iter(|| filter.train().residual(black_box(mode))));
    tick::<f64>(criterion, "tick of a delay line, f64");
    tick::<f32>(criterion, "tick of a delay line, f32");
}

criterion_group!(benches, shaping);
criterion_main!(benches);
