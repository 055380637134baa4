//! Planning a chain for one, two and three modes, beside the S-curve and a sample of it.
#![expect(clippy::expect_used, reason = "a bench may fail loudly")]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use profiles::{Chain, Limits, Mode, Profile, SCurve, residual_vibration};

fn chain(criterion: &mut Criterion) {
    let limits = Limits::new(0.5, 5.0, 200.0).expect("limits");
    let modes = [(12.0, 0.05), (27.6, 0.05), (50.0, 0.01)].map(|(hz, z)| Mode::from_hz(hz, z).expect("mode"));
    let mut group = criterion.benchmark_group("chain");
    for distance in [0.02, 0.1] {
        group.bench_function(format!("s-curve, {distance} m"), |b| {
            b.iter(|| SCurve::rest_to_rest(black_box(distance), &limits));
        });
        group.bench_function(format!("one mode, {distance} m"), |b| {
            b.iter(|| Chain::<23>::rest_to_rest(black_box(distance), &limits, &modes[..1]));
        });
        group.bench_function(format!("two modes, {distance} m"), |b| {
            b.iter(|| Chain::<47>::rest_to_rest(black_box(distance), &limits, &modes[..2]));
        });
        group.bench_function(format!("three modes, {distance} m"), |b| {
            b.iter(|| Chain::<95>::rest_to_rest(black_box(distance), &limits, &modes));
        });
    }
    let two = Chain::<47>::rest_to_rest(0.1, &limits, &modes[..2]).expect("plan");
    group.bench_function("sample, two modes", |b| b.iter(|| two.sample(black_box(0.123))));
    group.bench_function("residual of a mode, two modes", |b| {
        b.iter(|| residual_vibration(black_box(&two), modes[0]));
    });
    group.finish();
}

criterion_group!(benches, chain);
criterion_main!(benches);
