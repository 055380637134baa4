//! The fit of a transfer function: exact without noise, and as uncertain as it says with it.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

mod common;

use common::{Fractions, irregular};
use identify::{
    Hold, MovingAverage, RootEstimate, TransferFunctionError, TransferFunctionFit, TransferFunctionOptions,
    fit_transfer_function,
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

/// Frequency, damping ratio and lead against the truth, in reported deviations.
fn errors(found: &TransferFunctionFit) -> [f64; 3] {
    let pole = found.poles[0];
    let (lead, lead_deviation) = lead(found);
    [
        (pole.angular_frequency() - frequency()) / pole.frequency_deviation,
        (pole.damping_ratio() - DAMPING) / pole.damping_deviation,
        (lead - LEAD) / lead_deviation,
    ]
}

#[test]
fn the_belt_drive_from_counts() {
    // Counts per sample are averages over a sample: between averages of a held input the line is straight.
    let options = TransferFunctionOptions { hold: Hold::First, ..TransferFunctionOptions::new(2, 1) };
    for seed in 0..40 {
        // A jitter of 2 counts, 212 pulse/s of speed, which is 0.4 % of the final one.
        let (input, output) = belt_log(0.2, 2.0, seed);
        let found = fit_transfer_function(&input, &output, PERIOD, &options).expect("fits");
        assert!(found.fit > 93.5, "{seed}: {}", found.fit);
        // Differences of white noise disturb slow motions less than white noise: errors are within a deviation.
        assert!(errors(&found).iter().all(|e| e.abs() < 1.5), "{seed}: {:?}", errors(&found));
        assert!((found.dc_gain - GAIN).abs() < 3.0 * found.dc_gain_deviation);
    }
    let (input, output) = belt_log(0.2, 0.0, 3);
    let quantised = fit_transfer_function(&input, &output, PERIOD, &options).expect("fits");
    assert!(quantised.fit > 99.0, "{}", quantised.fit);
}

#[test]
fn the_same_filter_on_both_sides_leaves_the_transfer_function() {
    let lags = 8;
    let options =
        TransferFunctionOptions { hold: Hold::First, noise_lags: lags, ..TransferFunctionOptions::new(2, 1) };
    let average = MovingAverage::new(5).expect("positive");
    for filter in [MovingAverage::causal, MovingAverage::zero_phase] {
        let mut squares = [0.0; 3];
        for seed in 0..40 {
            // The motor starts with a sample: a jump between two is no straight line.
            let (input, output) = belt_log(0.4, 2.0, 100 + seed);
            let (u, y) =
                (filter(&average, &input).expect("finite"), filter(&average, &output).expect("finite"));
            let found = fit_transfer_function(&u, &y, PERIOD, &options).expect("fits");
            assert!(found.fit > 99.5, "{seed}: {}", found.fit);
            for (square, error) in squares.iter_mut().zip(errors(&found)) {
                *square += error * error / 40.0;
                // Of 240 draws one is expected beyond three deviations, none in a hundred runs beyond four.
                assert!(error.abs() < 4.0, "{seed}: {error}");
            }
        }
        // A chi-square of 40 degrees of freedom over its number: 1, standard deviation 0.22.
        assert!(squares.iter().all(|square| (0.3..1.9).contains(square)), "{squares:?}");
    }
}

/// Systems of one to four poles, in rad per sample of one.
fn systems() -> Vec<Fractions> {
    vec![
        Fractions::new(&[((-0.05, 0.0), (0.4, 0.0))]),
        Fractions::new(&[((-0.02, 0.1), (0.05, -0.3))]),
        Fractions::new(&[((-0.3, 0.0), (0.4, 0.0)), ((-0.02, 0.0), (-0.03, 0.0))]),
        Fractions::new(&[((-0.01, 0.2), (0.1, 0.2)), ((-0.1, 0.0), (0.2, 0.0))]),
        Fractions::new(&[((-0.004, 0.08), (0.02, 0.1)), ((-0.02, 0.5), (-0.05, 0.2))]),
        // A fast and a slow one: three decades apart.
        Fractions::new(&[((-0.8, 0.0), (0.9, 0.0)), ((-0.001, 0.0), (0.001, 0.0))]),
        // Two poles closer than a hundredth, and two modes closer than their bandwidth.
        Fractions::new(&[((-0.1, 0.0), (1.0, 0.0)), ((-0.1005, 0.0), (-0.9, 0.0))]),
        Fractions::new(&[((-0.01, 0.2), (0.0, 0.1)), ((-0.01, 0.206), (0.05, 0.1))]),
    ]
}

fn close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= tolerance * b.abs(), "{found:?} {expected:?}");
    }
}

#[test]
fn without_noise_the_coefficients_are_exact() {
    let input = irregular(600);
    for system in systems() {
        let (numerator, denominator) = system.coefficients();
        for hold in [Hold::Zero, Hold::First] {
            for (initial, offset) in [(0.0, 0.0), (2.0, 0.7)] {
                let output: Vec<f64> =
                    system.output(&input, 1.0, hold, initial).iter().map(|y| y + offset).collect();
                let poles = denominator.len() - 1;
                let options = TransferFunctionOptions {
                    hold,
                    initial_state: initial > 0.0,
                    offset: offset > 0.0,
                    ..TransferFunctionOptions::new(poles, poles - 1)
                };
                let found = fit_transfer_function(&input, &output, 1.0, &options).expect("fits");
                // Close poles are told apart by differences of a thousandth and less of the output.
                close(&found.numerator, &numerator, 1e-7);
                close(&found.denominator, &denominator, 1e-7);
                assert!((found.offset - offset).abs() < 1e-8);
                assert!(found.fit > 100.0 - 1e-8);
                assert!(found.output.iter().zip(&output).all(|(a, b)| (a - b).abs() < 1e-9));
            }
        }
    }
}

#[test]
fn the_response_and_the_roots_are_those_of_the_coefficients() {
    let system = &systems()[3];
    let input = irregular(400);
    let output = system.output(&input, 1.0, Hold::Zero, 0.0);
    let found =
        fit_transfer_function(&input, &output, 1.0, &TransferFunctionOptions::new(3, 2)).expect("fits");
    for w in [0.0, 0.1, 0.2, 1.0] {
        let s = profiles::Complex::new(0.0, w);
        let expected = system
            .terms
            .iter()
            .map(|(p, r)| if p.im > 0.0 { r / (s - p) + r.conj() / (s - p.conj()) } else { r / (s - p) })
            .sum::<profiles::Complex<f64>>();
        assert!((found.frequency_response(w) - expected).norm() < 1e-9 * expected.norm().max(1.0));
    }
    assert!((found.dc_gain - found.frequency_response(0.0).re).abs() < 1e-12);
    let pole = found.poles[1];
    assert!((pole.real + 0.01).abs() < 1e-9 && (pole.imaginary - 0.2).abs() < 1e-9);
    assert!((pole.damping_ratio() - 0.01 / 0.01_f64.hypot(0.2)).abs() < 1e-9);
    // A product over the zeros and the gain is the numerator at a point.
    let s = profiles::Complex::new(0.3, 0.4);
    let product: profiles::Complex<f64> = found.zeros.iter().map(|zero| s - zero.value()).product();
    let numerator = (found.numerator[0] * s + found.numerator[1]) * s + found.numerator[2];
    assert!((found.gain() * product - numerator).norm() < 1e-12);
}

/// What a fit says, and how sure it is: coefficients, frequency and damping of the first pole, first zero, gain.
fn said(found: &TransferFunctionFit) -> Vec<(f64, f64)> {
    let pole = found.poles[0];
    let zero = found.zeros[0];
    let coefficients = found.numerator.iter().zip(&found.numerator_deviations);
    let others = found.denominator.iter().zip(&found.denominator_deviations).skip(1);
    coefficients
        .chain(others)
        .map(|(value, deviation)| (*value, *deviation))
        .chain([
            (pole.angular_frequency(), pole.frequency_deviation),
            (pole.damping_ratio(), pole.damping_deviation),
            (pole.real, pole.real_deviation),
            (pole.imaginary, pole.imaginary_deviation),
            (zero.real, zero.real_deviation),
            (found.dc_gain, found.dc_gain_deviation),
        ])
        .collect()
}

/// Mean square of error over reported deviation, of everything that is said.
fn scatter(options: &TransferFunctionOptions, filter: Option<usize>) -> Vec<f64> {
    const DRAWS: u64 = 200;
    let system = &systems()[1];
    let input = irregular(400);
    let clean = system.output(&input, 1.0, Hold::Zero, 0.0);
    let exact =
        fit_transfer_function(&input, &clean, 1.0, &TransferFunctionOptions::new(2, 1)).expect("fits");
    let truth = said(&exact);
    let mut squares = vec![0.0; truth.len()];
    for seed in 0..DRAWS {
        let mut source = GaussianNoise::new(0.3, seed).expect("valid");
        let mut noise: Vec<f64> = clean.iter().map(|_| source.sample()).collect();
        if let Some(length) = filter {
            noise = MovingAverage::new(length).expect("positive").causal(&noise).expect("finite");
        }
        let output: Vec<f64> = clean.iter().zip(&noise).map(|(y, e)| y + e).collect();
        let found = fit_transfer_function(&input, &output, 1.0, options).expect("fits");
        for ((square, truth), found) in squares.iter_mut().zip(&truth).zip(said(&found)) {
            *square += ((found.0 - truth.0) / found.1).powi(2) / DRAWS as f64;
        }
        // The covariance is that of the deviations.
        for (k, deviation) in
            found.numerator_deviations.iter().chain(&found.denominator_deviations[1..]).enumerate()
        {
            assert!((found.covariance[k][k].sqrt() / deviation - 1.0).abs() < 1e-9);
        }
    }
    squares
}

#[test]
fn white_noise_scatters_as_reported() {
    for initial_state in [false, true] {
        let options = TransferFunctionOptions { initial_state, ..TransferFunctionOptions::new(2, 1) };
        let squares = scatter(&options, None);
        // A chi-square of 200 degrees of freedom over its number: 1, standard deviation 0.1.
        assert!(squares.iter().all(|square| (square - 1.0).abs() < 0.4), "{squares:?}");
    }
}

#[test]
fn filtered_noise_scatters_as_reported_with_lags_and_more_without() {
    let options = TransferFunctionOptions::new(2, 1);
    let white = scatter(&options, Some(5));
    let lags = scatter(&TransferFunctionOptions { noise_lags: 20, ..options }, Some(5));
    // The poles see noise of five times the variance per sample that it seems to have.
    assert!(white[4] > 2.5, "{white:?}");
    // Fading lags and few samples leave deviations low by up to a fifth.
    assert!(lags.iter().all(|square| (square - 1.0).abs() < 0.6), "{lags:?}");
}

#[test]
fn a_direct_path_is_a_zero_more() {
    let input = irregular(300);
    let output: Vec<f64> = systems()[0]
        .output(&input, 1.0, Hold::Zero, 0.0)
        .iter()
        .zip(&input)
        .map(|(y, u)| y + 0.5 * u)
        .collect();
    let found =
        fit_transfer_function(&input, &output, 1.0, &TransferFunctionOptions::new(1, 1)).expect("fits");
    // 0.5 + 0.4 / (s + 0.05)
    close(&found.numerator, &[0.5, 0.425], 1e-9);
    close(&found.denominator, &[1.0, 0.05], 1e-9);
}

#[test]
fn what_grows_is_an_error() {
    let input = irregular(200);
    for (growing, real) in [
        (Fractions::new(&[((0.02, 0.0), (0.3, 0.0))]), 0.02),
        (Fractions::new(&[((0.01, 0.2), (0.1, 0.2))]), 0.01),
    ] {
        let mut noise = GaussianNoise::new(0.01, 1).expect("valid");
        let output: Vec<f64> =
            growing.output(&input, 1.0, Hold::Zero, 0.0).iter().map(|y| y + noise.sample()).collect();
        let poles = growing.coefficients().1.len() - 1;
        let result =
            fit_transfer_function(&input, &output, 1.0, &TransferFunctionOptions::new(poles, poles - 1));
        let Err(TransferFunctionError::Unstable { real: found, deviation, .. }) = result else {
            panic!("{result:?}")
        };
        assert!((found - real).abs() < 5.0 * deviation, "{found} {deviation}");
    }
}

#[test]
fn what_the_data_do_not_say_is_an_error() {
    let fit = |u: &[f64], y: &[f64], poles, zeros| {
        fit_transfer_function(u, y, 1.0, &TransferFunctionOptions::new(poles, zeros))
    };
    let mut noise = GaussianNoise::new(1.0, 7).expect("valid");
    let random: Vec<f64> = (0..300).map(|_| noise.sample()).collect();
    let input = irregular(300);
    assert!(matches!(
        fit(&[0.0; 300], &random, 2, 1),
        Err(TransferFunctionError::NoExcitation { quantity: "the input", .. })
    ));
    assert!(matches!(
        fit(&input, &[0.0; 300], 2, 1),
        Err(TransferFunctionError::NoExcitation { quantity: "the output", .. })
    ));
    // Noise does not follow the input.
    let unrelated = fit(&input, &random, 2, 1);
    assert!(matches!(unrelated, Err(TransferFunctionError::NoResponse { .. })), "{unrelated:?}");
    // A constant input, a free start and an offset: the input has no trace of its own.
    let options =
        TransferFunctionOptions { initial_state: true, offset: true, ..TransferFunctionOptions::new(2, 1) };
    let still = fit_transfer_function(&[1.0; 300], &random, 1.0, &options);
    assert!(matches!(still, Err(TransferFunctionError::Undetermined { .. })), "{still:?}");
    // A constant output from an input at work.
    assert!(fit(&input, &[1.0; 300], 2, 1).is_err());
}

#[test]
fn bad_requests_are_named() {
    let fit = |u: &[f64], y: &[f64], period, poles, zeros| {
        fit_transfer_function(u, y, period, &TransferFunctionOptions::new(poles, zeros)).err()
    };
    let one = [1.0; 50];
    assert_eq!(
        fit(&one, &[1.0; 49], 1.0, 2, 1),
        Some(TransferFunctionError::Lengths { input: 50, output: 49 })
    );
    assert!(matches!(fit(&[], &[], 1.0, 2, 1), Some(TransferFunctionError::Signal(_))));
    assert!(matches!(fit(&one, &one, 0.0, 2, 1), Some(TransferFunctionError::Signal(_))));
    for (poles, zeros) in [(0, 0), (9, 0), (2, 3)] {
        let found = fit(&one, &one, 1.0, poles, zeros);
        assert_eq!(found, Some(TransferFunctionError::Order { poles, zeros, most: 8 }));
    }
    assert!(matches!(
        fit(&one[..7], &one[..7], 1.0, 2, 1),
        Some(TransferFunctionError::TooShort { samples: 7, needed: 8 })
    ));
    let mut broken = one;
    broken[20] = f64::NAN;
    assert!(matches!(fit(&broken, &one, 1.0, 1, 0), Some(TransferFunctionError::Signal(_))));
    assert!(matches!(fit(&one, &broken, 1.0, 1, 0), Some(TransferFunctionError::Signal(_))));
    assert!(matches!(fit(&[1e200; 50], &one, 1.0, 1, 0), Some(TransferFunctionError::Signal(_))));
}

#[test]
fn units_do_not_matter() {
    let system = &systems()[4];
    let input = irregular(500);
    let mut noise = GaussianNoise::new(0.02, 3).expect("valid");
    let output: Vec<f64> =
        system.output(&input, 1.0, Hold::Zero, 0.0).iter().map(|y| y + noise.sample()).collect();
    let options = TransferFunctionOptions::new(4, 3);
    let here = fit_transfer_function(&input, &output, 1.0, &options).expect("fits");
    let scaled = |x: &[f64], by: f64| x.iter().map(|x| x * by).collect::<Vec<f64>>();
    let there =
        fit_transfer_function(&scaled(&input, 1e6), &scaled(&output, 1e-9), 1e-3, &options).expect("fits");
    for (here, there) in here.poles.iter().zip(&there.poles) {
        // The search stops at a thousandth of a deviation: its path differs by roundings only.
        let RootEstimate { real, imaginary, .. } = *there;
        assert!((here.real - 1e-3 * real).abs() < 1e-3 * here.real_deviation);
        assert!((here.imaginary - 1e-3 * imaginary).abs() < 1e-3 * here.imaginary_deviation);
        assert!((here.frequency_deviation / (1e-3 * there.frequency_deviation) - 1.0).abs() < 1e-3);
    }
    assert!((here.dc_gain - 1e15 * there.dc_gain).abs() < 1e-3 * here.dc_gain_deviation);
    assert!((here.fit - there.fit).abs() < 1e-6);
}
