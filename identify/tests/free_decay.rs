//! The fit of damped sinusoids against the Cramer-Rao bound, on hundreds of seeded noise draws.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use identify::{DampedSinusoids, SinusoidError, SinusoidOptions, fit_damped_sinusoids};
use plants::nalgebra::DMatrix;
use plants::{Encoder, GaussianNoise, Noise};
use std::f64::consts::TAU;

const PERIOD: f64 = 1e-3;
const SAMPLES: usize = 1000;
const DRAWS: u64 = 200;

/// Undamped angular frequency, damping ratio, amplitude and phase.
type Truth = [f64; 4];

/// Two modes of 38.5 and 92.3 Hz: with noise of 0.01, 26.1 dB.
const TWO_MODES: [Truth; 2] = [[38.5 * TAU, 0.035, 1.0, 0.3], [92.3 * TAU, 0.018, 0.6, -0.8]];

fn signal(modes: &[Truth]) -> Vec<f64> {
    let value = |t: f64| {
        modes
            .iter()
            .map(|[w, z, a, phase]| a * (-z * w * t).exp() * (w * (1.0 - z * z).sqrt() * t + phase).cos())
            .sum()
    };
    (0..SAMPLES).map(|n| value(n as f64 * PERIOD)).collect()
}

fn noisy(clean: &[f64], deviation: f64, seed: u64) -> Vec<f64> {
    let mut noise = GaussianNoise::new(deviation, seed).expect("valid");
    clean.iter().map(|y| y + noise.sample()).collect()
}

fn fit(values: &[f64]) -> Result<DampedSinusoids, SinusoidError> {
    fit_damped_sinusoids(values, PERIOD, &SinusoidOptions::default())
}

/// Bounds of the standard deviations of frequency and damping ratio of every mode: the inverse of the Fisher matrix
/// of (frequency, damping ratio, amplitude, phase) of the modes and a constant.
fn bounds(modes: &[Truth], noise: f64) -> Vec<[f64; 2]> {
    let parameters = 4 * modes.len() + 1;
    let gradient = DMatrix::from_fn(SAMPLES, parameters, |n, j| {
        let t = n as f64 * PERIOD;
        let Some([w, z, a, phase]) = modes.get(j / 4).copied() else { return 1.0 };
        let root = (1.0 - z * z).sqrt();
        let (sin, cos) = (w * root * t + phase).sin_cos();
        let envelope = (-z * w * t).exp();
        match j % 4 {
            0 => a * envelope * t * (-z * cos - root * sin),
            1 => a * envelope * w * t * (-cos + z / root * sin),
            2 => envelope * cos,
            _ => -a * envelope * sin,
        }
    });
    let covariance = (gradient.transpose() * &gradient).try_inverse().expect("regular") * (noise * noise);
    (0..modes.len())
        .map(|k| [covariance[(4 * k, 4 * k)].sqrt(), covariance[(4 * k + 1, 4 * k + 1)].sqrt()])
        .collect()
}

#[test]
fn two_modes_at_26_db_reach_the_bound() {
    const NOISE: f64 = 0.01;
    let clean = signal(&TWO_MODES);
    let power = clean.iter().map(|y| y * y).sum::<f64>() / SAMPLES as f64;
    assert!((10.0 * (power / (NOISE * NOISE)).log10() - 26.1).abs() < 0.05);
    let bounds = bounds(&TWO_MODES, NOISE);
    // The published bounds for this case, in Hz, without an offset: one changes the least of digits.
    assert!((bounds[0][0] / TAU / 0.004_922_909 - 1.0).abs() < 0.01);
    assert!((bounds[1][1] / 0.000_121_713_3 - 1.0).abs() < 0.01);

    let (mut squares, mut standardised, mut right) = ([[0.0; 2]; 2], [[0.0; 2]; 2], 0_u32);
    for seed in 0..DRAWS {
        let found = fit(&noisy(&clean, NOISE, seed)).expect("two modes");
        right += u32::from(found.order() == 4 && found.modes.len() == 2);
        assert!((found.noise / NOISE - 1.0).abs() < 0.15, "{found:?}");
        for (k, (truth, mode)) in TWO_MODES.iter().zip(&found.modes).enumerate() {
            let errors = [mode.mode.angular_frequency() - truth[0], mode.mode.damping_ratio() - truth[1]];
            for (j, (error, deviation)) in
                errors.into_iter().zip([mode.frequency_deviation, mode.damping_deviation]).enumerate()
            {
                squares[k][j] += error * error / DRAWS as f64;
                standardised[k][j] += (error / deviation).powi(2) / DRAWS as f64;
            }
        }
    }
    assert!(f64::from(right) >= 0.99 * DRAWS as f64, "order right in {right} of {DRAWS}");
    for k in 0..2 {
        for j in 0..2 {
            let ratio = squares[k][j].sqrt() / bounds[k][j];
            println!("mode {k} parameter {j}: {ratio:.3} bounds, chi-square {:.3}", standardised[k][j]);
            assert!(ratio < 1.2, "mode {k} parameter {j}: {ratio} times the bound");
            // A chi-square of 200 degrees of freedom over its number: 1, standard deviation 0.1.
            assert!((standardised[k][j] - 1.0).abs() < 0.4, "mode {k} parameter {j}: {}", standardised[k][j]);
        }
    }
}

#[test]
fn without_noise_the_error_is_rounding() {
    let found = fit(&signal(&TWO_MODES)).expect("two modes");
    assert_eq!((found.modes.len(), found.decays.len()), (2, 0));
    for (truth, mode) in TWO_MODES.iter().zip(&found.modes) {
        // Rounding of 1e-16 of the signal is 120 dB below the noise for which the bound is 1e-4: 1e-14 or so.
        assert!((mode.mode.angular_frequency() / truth[0] - 1.0).abs() < 1e-13, "{mode:?}");
        assert!((mode.mode.damping_ratio() / truth[1] - 1.0).abs() < 1e-11, "{mode:?}");
        assert!((mode.amplitude - truth[2]).abs() < 1e-12 && (mode.phase - truth[3]).abs() < 1e-12);
    }
    assert!(found.noise < 1e-14 && found.fit > 100.0 - 1e-10);
}

#[test]
fn decays_are_no_modes() {
    let fast = |t: f64| 0.8 * (-12.0 * t).exp() - 0.5 * (-60.0 * t).exp();
    let clean: Vec<f64> =
        signal(&TWO_MODES[..1]).iter().enumerate().map(|(n, y)| y + fast(n as f64 * PERIOD)).collect();
    let exact = fit(&clean).expect("one mode");
    assert_eq!((exact.modes.len(), exact.decays.len()), (1, 2));
    assert!((exact.decays[0].rate - 12.0).abs() < 1e-8 && (exact.decays[1].rate - 60.0).abs() < 1e-8);
    let mut right = 0;
    for seed in 0..100 {
        let found = fit(&noisy(&clean, 0.005, seed)).expect("one mode");
        let mode = found.modes[0];
        right += u32::from(found.modes.len() == 1 && found.decays.len() == 2);
        // Six deviations: never in 1e9 draws.
        assert!((mode.mode.angular_frequency() - TWO_MODES[0][0]).abs() < 6.0 * mode.frequency_deviation);
    }
    assert!(right >= 98, "{right} of 100");
    let alone: Vec<f64> = (0..SAMPLES).map(|n| fast(n as f64 * PERIOD)).collect();
    assert!(matches!(fit(&noisy(&alone, 0.005, 1)), Err(SinusoidError::NoMode { decays: 1 | 2, .. })));
}

#[test]
fn a_heavily_damped_mode_is_no_pair_of_decays_and_the_other_way_round() {
    let mode = signal(&[[10.0 * TAU, 0.8, 1.0, 0.3]]);
    let decay = |t: f64| (-20.0 * t).exp() - (-25.0 * t).exp();
    let decays: Vec<f64> = (0..SAMPLES).map(|n| decay(n as f64 * PERIOD)).collect();
    let mut right = [0; 2];
    for seed in 0..50 {
        let found = fit(&noisy(&mode, 0.01, seed));
        right[0] += u32::from(found.is_ok_and(|found| found.modes.len() == 1 && found.decays.is_empty()));
        let found = fit(&noisy(&decays, 0.003, seed));
        right[1] += u32::from(matches!(found, Err(SinusoidError::NoMode { decays: 2, .. })));
    }
    assert!(right.iter().all(|right| *right >= 49), "{right:?} of 50");
}

#[test]
fn close_modes_are_told_apart() {
    // Apart by 0.8 Hz, less than the bandwidth 2 z f of 1.3 Hz.
    let close = [[40.0 * TAU, 0.016, 1.0, 0.0], [40.8 * TAU, 0.016, 0.8, 1.0]];
    let found = fit(&signal(&close)).expect("two modes");
    assert_eq!(found.order(), 4);
    for (truth, mode) in close.iter().zip(&found.modes) {
        assert!((mode.mode.angular_frequency() / truth[0] - 1.0).abs() < 1e-9, "{mode:?}");
    }
    let bounds = bounds(&close, 0.003);
    let clean = signal(&close);
    let mut right = 0;
    for seed in 0..50 {
        let found = fit(&noisy(&clean, 0.003, seed)).expect("modes");
        if found.order() == 4 {
            let mut frequencies: Vec<f64> = found.modes.iter().map(|m| m.mode.angular_frequency()).collect();
            frequencies.sort_by(f64::total_cmp);
            right += u32::from(
                frequencies.iter().zip(&close).zip(&bounds).all(|((w, t), b)| (w - t[0]).abs() < 5.0 * b[0]),
            );
        }
    }
    assert!(right >= 49, "{right} of 50");
}

#[test]
fn counts_of_an_encoder() {
    for counts in [100.0, 1000.0] {
        let encoder = Encoder::new(1.0 / counts).expect("valid");
        let values: Vec<f64> = signal(&TWO_MODES).iter().map(|y| encoder.quantise(*y)).collect();
        let found = fit(&values).expect("modes");
        assert_eq!(found.modes.len(), 2, "{counts}: {found:?}");
        // Counts are noise of 1/sqrt(12), hardly white at the end: ten bounds.
        let bounds = bounds(&TWO_MODES, 1.0 / counts / 12_f64.sqrt());
        for ((truth, mode), bound) in TWO_MODES.iter().zip(&found.modes).zip(bounds) {
            assert!((mode.mode.angular_frequency() - truth[0]).abs() < 10.0 * bound[0], "{counts}: {mode:?}");
            assert!((mode.mode.damping_ratio() - truth[1]).abs() < 10.0 * bound[1], "{counts}: {mode:?}");
        }
    }
}

#[test]
fn noise_alone_has_no_mode() {
    let silent = vec![0.0; SAMPLES];
    let mut invented = 0;
    for seed in 0..100 {
        match fit(&noisy(&silent, 1.0, 1000 + seed)) {
            Err(SinusoidError::NoMode { noise, .. }) => assert!((noise - 1.0).abs() < 0.15),
            _ => invented += 1,
        }
    }
    assert!(invented <= 2, "{invented} of 100");
    assert_eq!(fit(&silent), Err(SinusoidError::NoMode { noise: 0.0, decays: 0 }));
    assert!(matches!(fit(&[3.5; SAMPLES]), Err(SinusoidError::NoMode { .. })));
}

#[test]
fn what_grows_is_an_error_and_what_rings_for_good_is_not() {
    let growing = signal(&[[100.0, -0.01, 1.0, 0.0]]);
    assert!(matches!(
        fit(&noisy(&growing, 0.01, 1)),
        Err(SinusoidError::Unstable { damping_ratio, .. }) if (damping_ratio + 0.01).abs() < 1e-3
    ));
    let undamped = signal(&[[100.0, 0.0, 1.0, 0.0]]);
    for seed in 0..20 {
        let mode = fit(&noisy(&undamped, 0.01, seed)).expect("a mode").modes[0];
        assert!(mode.mode.damping_ratio() < 5.0 * mode.damping_deviation);
    }
}

#[test]
fn bad_requests_are_named() {
    let options = SinusoidOptions::default();
    assert!(matches!(fit(&[1.0; 5]), Err(SinusoidError::TooShort { samples: 5, .. })));
    assert!(matches!(fit(&[]), Err(SinusoidError::Signal(_))));
    assert!(matches!(fit_damped_sinusoids(&[1.0; 50], 0.0, &options), Err(SinusoidError::Signal(_))));
    let order = SinusoidOptions { largest_order: 1, ..options };
    assert!(matches!(
        fit_damped_sinusoids(&[1.0; 50], 1.0, &order),
        Err(SinusoidError::Order { given: 1, .. })
    ));
}

#[test]
fn the_unit_and_the_period_do_not_matter() {
    let clean = noisy(&signal(&TWO_MODES), 0.01, 5);
    let here = fit(&clean).expect("modes");
    let scaled: Vec<f64> = clean.iter().map(|y| 1e-9 * y).collect();
    let there = fit_damped_sinusoids(&scaled, 1e3 * PERIOD, &SinusoidOptions::default()).expect("modes");
    for (here, there) in here.modes.iter().zip(&there.modes) {
        // The search stops at a thousandth of a deviation, not before: its path differs by roundings only.
        let difference = here.mode.angular_frequency() - 1e3 * there.mode.angular_frequency();
        assert!(difference.abs() < 1e-3 * here.frequency_deviation);
        assert!((here.amplitude - 1e9 * there.amplitude).abs() < 1e-6);
    }
}
