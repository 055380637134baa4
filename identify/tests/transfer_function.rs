//! The fit of a transfer function: exact without noise, and as uncertain as it says with it.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use identify::{
    Hold, TransferFunctionError, TransferFunctionFit, TransferFunctionOptions, fit_transfer_function,
};
use plants::{Encoder, GaussianNoise, Noise};
use std::f64::consts::TAU;

const PERIOD: f64 = 1.0 / 75.0;
const SAMPLES: usize = 450;

/// The belt drive of the paper: gain, damped frequency 1.177 Hz, damping ratio, lead in s.
const GAIN: f64 = 1.1497;
const DAMPING: f64 = 0.2;
const LEAD: f64 = 0.092;

fn frequency() -> f64 {
    1.177 * TAU / (1.0 - DAMPING * DAMPING).sqrt()
}

/// Step response of the belt drive and its integral, t in s: closed forms.
fn step(t: f64) -> (f64, f64) {
    if t <= 0.0 {
        return (0.0, 0.0);
    }
    let (w, z) = (frequency(), DAMPING);
    let (s, d) = (z * w, w * (1.0 - z * z).sqrt());
    let (e, (sin, cos)) = ((-s * t).exp(), (d * t).sin_cos());
    // Impulse response of w^2/(s^2 + 2 z w s + w^2), and its first two integrals.
    let h = w * w / d * e * sin;
    let h1 = 1.0 - e * (cos + s / d * sin);
    let h2 = t - 2.0 * z / w + e * (2.0 * z / w * cos + (2.0 * z * z - 1.0) / d * sin);
    (GAIN * (h1 + LEAD * h), GAIN * (h2 + LEAD * h1))
}

/// Counts per sample of motor and load, as speeds in pulse/s: the motor runs up to 30 000 pulse/s within 1 ms.
fn belt_log(start: f64, jitter: f64, seed: u64) -> (Vec<f64>, Vec<f64>) {
    let encoder = Encoder::new(1.0).expect("valid");
    let mut noise = GaussianNoise::new(jitter, seed).expect("valid");
    // A ramp of 1 ms is a step delayed by half of it, to a part in a million of the position.
    let mut counts = |part: usize| {
        let mut before = 0.0;
        (0..SAMPLES)
            .map(|k| {
                let t = k as f64 * PERIOD - start - 0.5e-3;
                let position = 30_000.0 * if part == 0 { t.max(0.0) } else { step(t).1 };
                let now = encoder.quantise(position + 0.37 * (seed as f64).sin() + noise.sample());
                let speed = if k == 0 { 0.0 } else { (now - before) / PERIOD };
                before = now;
                speed
            })
            .collect::<Vec<f64>>()
    };
    (counts(0), counts(1))
}

fn lead(found: &TransferFunctionFit) -> (f64, f64) {
    let zero = found.zeros[0];
    (-1.0 / zero.real, zero.real_deviation / (zero.real * zero.real))
}

#[test]
fn the_belt_drive_from_counts() {
    let options = TransferFunctionOptions { hold: Hold::First, ..TransferFunctionOptions::new(2, 1) };
    let mut worst = [0.0_f64; 3];
    for seed in 0..40 {
        let (input, output) = belt_log(0.2, 5.0, seed);
        let found = fit_transfer_function(&input, &output, PERIOD, &options).expect("fits");
        let pole = found.poles[0];
        let (lead, lead_deviation) = lead(&found);
        let errors = [
            (pole.angular_frequency() - frequency()) / pole.frequency_deviation,
            (pole.damping_ratio() - DAMPING) / pole.damping_deviation,
            (lead - LEAD) / lead_deviation,
        ];
        println!("{seed}: fit {:.2} {:?} {errors:?}", found.fit, pole);
        for (worst, error) in worst.iter_mut().zip(errors) {
            *worst = worst.max(error.abs());
        }
    }
    println!("{worst:?}");
}
