//! Cost of a fit of two poles and a zero to 450 samples, of its spectrum and of a moving average.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use identify::{
    MovingAverage, SpectrumOptions, TransferFunctionOptions, amplitude_spectrum, fit_transfer_function,
};
use plants::{GaussianNoise, Noise};

const PERIOD: f64 = 1.0 / 75.0;

/// Step response of a mode of 7.5 rad/s with damping ratio 0.2, six seconds at 75 Hz.
fn response(noise: f64) -> Option<Vec<f64>> {
    let mut noise = GaussianNoise::new(noise, 1).ok()?;
    let (w, z) = (7.5, 0.2_f64);
    let d = w * (1.0 - z * z).sqrt();
    let value = |t: f64| 1.0 - (-z * w * t).exp() * ((d * t).cos() + z * w / d * (d * t).sin());
    Some((0..450).map(|n| value(f64::from(n) * PERIOD) + noise.sample()).collect())
}

fn identification(criterion: &mut Criterion) {
    let (Some(noisy), Some(clean)) = (response(0.05), response(0.0)) else { return };
    let input = vec![1.0; noisy.len()];
    let options = TransferFunctionOptions::new(2, 1);
    let mut group = criterion.benchmark_group("450 samples");
    group.bench_function("two poles and a zero in noise", |b| {
        b.iter(|| fit_transfer_function(&input, black_box(&noisy), PERIOD, &options));
    });
    group.bench_function("two poles and a zero without noise", |b| {
        b.iter(|| fit_transfer_function(&input, black_box(&clean), PERIOD, &options));
    });
    group.bench_function("spectrum, Hann", |b| {
        b.iter(|| amplitude_spectrum(black_box(&noisy), PERIOD, &SpectrumOptions::default()));
    });
    group.bench_function("moving average of 25", |b| {
        b.iter(|| MovingAverage::new(25).and_then(|average| average.zero_phase(black_box(&noisy))));
    });
    group.finish();
}

criterion_group!(benches, identification);
criterion_main!(benches);
