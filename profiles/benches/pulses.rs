//! Pulses of one move of 4000, beside the closed form that only a trapezoid has.
#![expect(clippy::expect_used, reason = "a bench may fail loudly")]

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use profiles::{Cosine, Limits, Profile, PulseTrain, SCurve, Sectioned, SnapLimited, Trapezoid};

const PULSES: f64 = 4000.0;

fn pulses(criterion: &mut Criterion) {
    // In pulses: 10 kHz at the start, at most 300 kHz, 10 000 kHz/s.
    let limits = Limits::new(3e5, 1e7, 2e9).and_then(|l| l.with_snap(2e12)).expect("limits");
    let mut group = criterion.benchmark_group("pulse");
    group.throughput(Throughput::Elements(PULSES as u64));
    let trapezoid = Trapezoid::with_speeds(PULSES, 1e4, 1e4, &limits).expect("plan");
    every(&mut group, "trapezoid", &trapezoid);
    every(&mut group, "s-curve", &SCurve::rest_to_rest(PULSES, &limits).expect("plan"));
    every(&mut group, "snap-limited", &SnapLimited::rest_to_rest(PULSES, &limits).expect("plan"));
    every(&mut group, "cosine", &Cosine::rest_to_rest(PULSES, &limits).expect("plan"));
    group.bench_function("trapezoid, closed form by hand", |b| {
        let (f0, a, half, duration) = (1e4_f64, 1e7_f64, 0.5 * PULSES, trapezoid.duration());
        b.iter(|| {
            let (f0, a) = (black_box(f0), black_box(a));
            let mut last = 0.0;
            for k in 0..PULSES as u32 {
                let way = f64::from(k) + 0.5;
                let left = if way < half { way } else { PULSES - way };
                let instant = ((f0 * f0 + 2.0 * a * left).sqrt() - f0) / a;
                let instant = if way < half { instant } else { duration - instant };
                black_box(instant - last);
                last = instant;
            }
        });
    });
    let train = PulseTrain::new(&trapezoid, 1.0).expect("train");
    group.bench_function("trapezoid, periods at 72 MHz", |b| {
        b.iter(|| train.periods(black_box(72e6)).expect("clock").for_each(|period| _ = black_box(period)));
    });
    group.finish();

    let mut group = criterion.benchmark_group("count");
    let s_curve = SCurve::rest_to_rest(PULSES, &limits).expect("plan");
    let train = PulseTrain::new(&s_curve, 1.0).expect("train");
    let period = s_curve.duration() / PULSES;
    group.throughput(Throughput::Elements(PULSES as u64));
    group.bench_function("s-curve, a tick", |b| {
        b.iter(|| train.counts(black_box(period)).expect("clock").for_each(|count| _ = black_box(count)));
    });
    group.finish();
    let mut group = criterion.benchmark_group("train");
    group.bench_function("s-curve, new", |b| b.iter(|| PulseTrain::new(black_box(&s_curve), 1.0)));
    group.finish();
}

fn every<P: Sectioned>(
    group: &mut criterion::BenchmarkGroup<'_, criterion::measurement::WallTime>,
    name: &str,
    profile: &P,
) {
    let train = PulseTrain::new(profile, 1.0).expect("train");
    assert_eq!(train.total(), PULSES as i64);
    group.bench_function(name, |b| {
        b.iter(|| black_box(&train).pulses().for_each(|pulse| _ = black_box(pulse)));
    });
}

criterion_group!(benches, pulses);
criterion_main!(benches);
