//! Vibration-free moves: cold, and warm from a neighbouring one.
#![expect(clippy::expect_used, reason = "moves that are known to exist")]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use optimize::vibration_free::{Robustness, plan, plan_ramp};
use profiles::{Chain, Limits, Mode};

const BAND: Robustness = Robustness::Band { half_width: 0.1, residual: 0.02 };

fn limits() -> Limits {
    Limits::new(0.5, 5.0, 200.0).expect("limits")
}

/// A distance in m and its modes in Hz, with their damping.
fn moves() -> [(&'static str, f64, Vec<Mode>); 4] {
    let modes = |all: &[(f64, f64)]| all.iter().map(|&(hz, z)| Mode::from_hz(hz, z).expect("mode")).collect();
    [
        ("0.1 m, 8 Hz", 0.1, modes(&[(8.0, 0.02)])),
        ("0.1 m, 20 Hz", 0.1, modes(&[(20.0, 0.02)])),
        ("0.02 m, 12 Hz", 0.02, modes(&[(12.0, 0.05)])),
        ("0.02 m, 12 and 27.6 Hz", 0.02, modes(&[(12.0, 0.05), (27.6, 0.05)])),
    ]
}

fn cold(criterion: &mut Criterion) {
    let limits = limits();
    let mut group = criterion.benchmark_group("vibration-free, cold");
    group.sample_size(10);
    for (name, distance, modes) in moves() {
        for (label, robustness) in
            [("zero", Robustness::None), ("double zero", Robustness::DoubleZero), ("band", BAND)]
        {
            group.bench_function(format!("{name}, {label}"), |b| {
                b.iter(|| plan(black_box(distance), &limits, &modes, robustness).expect("plan"));
            });
        }
        if modes.len() == 1 {
            group.bench_function(format!("{name}, ramp"), |b| {
                b.iter(|| plan_ramp(black_box(0.1), 0.4, &limits, &modes, Robustness::None).expect("plan"));
            });
        }
    }
    group.finish();
}

fn warm(criterion: &mut Criterion) {
    let limits = limits();
    let mut group = criterion.benchmark_group("vibration-free, to 1 % more");
    for (name, distance, modes) in moves() {
        for (label, robustness) in
            [("zero", Robustness::None), ("double zero", Robustness::DoubleZero), ("band", BAND)]
        {
            let planned = plan(distance, &limits, &modes, robustness).expect("plan");
            group.bench_function(format!("{name}, {label}"), |b| {
                b.iter(|| planned.replanned(black_box(1.01 * distance)).expect("plan"));
            });
        }
    }
    group.finish();
}

/// What needs no search, for comparison.
fn chain(criterion: &mut Criterion) {
    let limits = limits();
    for (name, distance, modes) in moves() {
        criterion.bench_function(&format!("chain, {name}"), |b| {
            b.iter(|| Chain::<47>::rest_to_rest(black_box(distance), &limits, &modes).expect("plan"));
        });
    }
}

criterion_group!(benches, cold, warm, chain);
criterion_main!(benches);
