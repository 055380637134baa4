//! Cost of an identification: 1000 samples of two modes in noise, order selection included.

use std::f64::consts::TAU;
use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use identify::{Peaks, Signal, SinusoidOptions, fit_damped_sinusoids};
use plants::{GaussianNoise, Noise};

const PERIOD: f64 = 1e-3;

fn decay(noise: f64) -> Option<Vec<f64>> {
    let mut noise = GaussianNoise::new(noise, 1).ok()?;
    let mode = |t: f64, f: f64, z: f64, phase: f64| {
        let w = f * TAU;
        (-z * w * t).exp() * (w * (1.0 - z * z).sqrt() * t + phase).cos()
    };
    let value = |t: f64| mode(t, 38.5, 0.035, 0.3) + 0.6 * mode(t, 92.3, 0.018, -0.8);
    Some((0..1000).map(|n| value(f64::from(n) * PERIOD) + noise.sample()).collect())
}

fn identification(criterion: &mut Criterion) {
    let (Some(noisy), Some(clean)) = (decay(0.01), decay(0.0)) else { return };
    let options = SinusoidOptions::default();
    let mut group = criterion.benchmark_group("1000 samples");
    group.bench_function("damped sinusoids, two modes at 26 dB", |b| {
        b.iter(|| fit_damped_sinusoids(black_box(&noisy), PERIOD, &options));
    });
    group.bench_function("damped sinusoids, two modes without noise", |b| {
        b.iter(|| fit_damped_sinusoids(black_box(&clean), PERIOD, &options));
    });
    group.bench_function("peaks", |b| {
        b.iter(|| Signal::sampled(black_box(&noisy), PERIOD).and_then(|s| Peaks::find(&s, 0.05)));
    });
    group.finish();
}

criterion_group!(benches, identification);
criterion_main!(benches);
