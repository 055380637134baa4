//! Synthesis of a filter, one sample through a delay line, and a shaped move.
#![expect(clippy::expect_used, reason = "a bench may fail loudly")]

use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use profiles::{Cursor, Limits, Mode, Profile, PulseTrain, Real, SCurve, Sectioned};
use shaping::{DelayFilter, DelayLine, DelayLineState, ImpulseTrain, ModeRange, Shaped, Shaper};

fn tick<F: Real>(criterion: &mut Criterion, name: &str) {
    let mode = Mode::from_hz(40.0, 0.02).expect("mode");
    let filter = DelayFilter::positive(mode, 0.0101).expect("filter");
    let line = DelayLine::<F, 6, 32>::new(filter.train(), mode, 1e-3).expect("line");
    let mut state = DelayLineState::at_rest(F::ZERO);
    criterion.bench_function(name, |b| b.iter(|| line.update(&mut state, black_box(F::ONE)).output));
}

/// A move of 40 mm through a filter with three impulses: an instant, a section, a tick and a pulse of it.
fn shaped(criterion: &mut Criterion) {
    let limits = Limits::new(0.2, 4.0, 200.0).expect("limits");
    let profile = SCurve::rest_to_rest(0.04, &limits).expect("plan");
    let mode = Mode::from_hz(33.0, 0.02).expect("mode");
    let shaped = Shaped::new(profile, *DelayFilter::zvd(mode).expect("filter").train());
    let instants: Vec<f64> =
        (0..4096).map(|k| shaped.duration() * (f64::from(k) * 0.618_033_988_749_895).fract()).collect();
    let mut group = criterion.benchmark_group("shaped s-curve");
    group.bench_function("extrema", |b| b.iter(|| black_box(&shaped).extrema()));
    group.throughput(Throughput::Elements(4096));
    group.bench_function("sample", |b| {
        b.iter(|| instants.iter().for_each(|t| _ = black_box(black_box(&shaped).sample(*t))));
    });
    group.bench_function("section at", |b| {
        b.iter(|| instants.iter().for_each(|t| _ = black_box(black_box(&shaped).section_at(*t))));
    });
    let cursor = Cursor::<_, f32>::new(&shaped, shaped.duration() / 4096.0).expect("clock");
    group.bench_function("tick of a cursor, f32", |b| {
        b.iter_batched_ref(
            || cursor,
            |cursor| (0..4096).for_each(|_| _ = black_box(cursor.tick())),
            BatchSize::SmallInput,
        );
    });
    let train = PulseTrain::new(&shaped, 1e-5).expect("train");
    group.throughput(Throughput::Elements(4000));
    group.bench_function("pulse", |b| {
        b.iter(|| train.pulses().for_each(|pulse| _ = black_box(pulse)));
    });
    group.finish();
}

fn shaping(criterion: &mut Criterion) {
    let mode = Mode::from_hz(40.0, 0.02).expect("mode");
    criterion.bench_function("delay filter", |b| b.iter(|| DelayFilter::positive(black_box(mode), 0.0101)));
    let filter = DelayFilter::positive(mode, 0.0101).expect("filter");
    criterion.bench_function("residual", |b| b.iter(|| filter.train().residual(black_box(mode))));
    tick::<f64>(criterion, "tick of a delay line, f64");
    tick::<f32>(criterion, "tick of a delay line, f32");
}

fn shaper<const N: usize>(criterion: &mut Criterion, name: &str, shaper: Shaper) {
    let mode = Mode::from_hz(40.0, 0.1).expect("mode");
    criterion.bench_function(name, |b| b.iter(|| black_box(shaper).train::<N>(black_box(mode))));
}

/// Every shaper of the family for one mode, and what is certified about one.
fn family(criterion: &mut Criterion) {
    shaper::<2>(criterion, "ZV", Shaper::ZV);
    shaper::<3>(criterion, "ZVD", Shaper::ZVD);
    shaper::<4>(criterion, "ZVDD", Shaper::ZVDD);
    shaper::<3>(criterion, "MZV", Shaper::MZV);
    shaper::<3>(criterion, "EI", Shaper::extra_insensitive(0.05));
    shaper::<4>(criterion, "EI, two humps", Shaper::ExtraInsensitive { humps: 2, tolerance: 0.05 });
    shaper::<5>(criterion, "EI, three humps", Shaper::ExtraInsensitive { humps: 3, tolerance: 0.05 });
    shaper::<3>(criterion, "unity-magnitude ZV", Shaper::UNITY_MAGNITUDE_ZV);
    shaper::<5>(criterion, "unity-magnitude ZVD", Shaper::UNITY_MAGNITUDE_ZVD);
    let mode = Mode::from_hz(40.0, 0.1).expect("mode");
    let zvd: ImpulseTrain<3> = Shaper::ZVD.train(mode).expect("train");
    let range = ModeRange::around(mode, 0.1, 0.05).expect("range");
    criterion.bench_function("worst case of ZVD, 10 % off", |b| b.iter(|| zvd.worst_case(black_box(&range))));
}

criterion_group!(benches, shaping, shaped, family);
criterion_main!(benches);
