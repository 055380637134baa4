//! Properties of random decays and of random numbers that are none.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

mod common;

use common::{Fractions, irregular};
use identify::{
    Hold, LogarithmicDecrement, MovingAverage, Peaks, ResponseClassifier, Signal, SinusoidError,
    SinusoidOptions, SpectrumOptions, TransferFunctionOptions, Window, amplitude_spectrum,
    fit_damped_sinusoids, fit_transfer_function,
};
use profiles::{Interval, Mode};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

/// A mode with 2 to 40 % of the sample rate and a decay that the record sees: frequency in rad per sample, damping
/// ratio, amplitude, phase.
fn component() -> impl Strategy<Value = (f64, f64, f64, f64)> {
    (0.02..0.4_f64, 0.003..0.08_f64, 0.3..1.0_f64, -PI..PI)
        .prop_map(|(f, z, a, phase)| (f * TAU, z, a, phase))
}

fn decay(components: &[(f64, f64, f64, f64)], samples: usize) -> Vec<f64> {
    let value = |n: f64| {
        components
            .iter()
            .map(|(w, z, a, phase)| {
                let pole = Mode::new(*w, *z).expect("valid").pole();
                a * (pole.re * n).exp() * (pole.im * n + phase).cos()
            })
            .sum()
    };
    (0..samples).map(|n| value(n as f64)).collect()
}

proptest! {
    #[test]
    fn a_mode_without_noise_is_found_to_rounding(one in component(), offset in -10.0..10.0_f64) {
        let values: Vec<f64> = decay(&[one], 400).iter().map(|y| y + offset).collect();
        let found = fit_damped_sinusoids(&values, 1.0, &SinusoidOptions::default()).expect("a mode");
        prop_assert_eq!(found.order(), 2, "{:?}", found);
        let mode = found.modes[0].mode;
        // The offset rounds to 1e-15, a tenth of an amplitude lasts ten samples: 1e-13 with a margin of ten.
        prop_assert!((mode.angular_frequency() / one.0 - 1.0).abs() < 1e-12);
        prop_assert!((mode.damping_ratio() - one.1).abs() < 1e-12);
        prop_assert!((found.offset - offset).abs() < 1e-12);
    }

    #[test]
    fn two_modes_without_noise_are_two(one in component(), other in component()) {
        prop_assume!((one.0 / other.0).ln().abs() > 0.1);
        let found =
            fit_damped_sinusoids(&decay(&[one, other], 600), 1.0, &SinusoidOptions::default()).expect("modes");
        prop_assert_eq!(found.order(), 4, "{:?}", found);
        for truth in [one, other] {
            let nearest = found
                .modes
                .iter()
                .map(|m| (m.mode.angular_frequency() / truth.0 - 1.0).abs())
                .fold(f64::INFINITY, f64::min);
            prop_assert!(nearest < 1e-9, "{:?} {:?}", truth, found);
        }
    }

    #[test]
    fn nothing_panics_and_nothing_is_nan(
        values in prop::collection::vec(prop_oneof![-1e300..1e300, -1.0..1.0, Just(0.0), Just(1e-310)], 0..60),
        largest_order in 0..30_usize, offset in any::<bool>(), target in -1.0..1.0_f64
    ) {
        match fit_damped_sinusoids(&values, 1e-3, &SinusoidOptions { largest_order, offset }) {
            Ok(found) => {
                for mode in &found.modes {
                    prop_assert!(mode.amplitude.is_finite() && mode.phase.is_finite());
                    prop_assert!(mode.frequency_deviation >= 0.0 && mode.damping_deviation >= 0.0);
                }
                prop_assert!(found.offset.is_finite() && found.noise >= 0.0 && found.fit <= 100.0);
            }
            Err(SinusoidError::NoMode { noise, .. }) => prop_assert!(noise >= 0.0),
            Err(_) => {}
        }
        if let Ok(signal) = Signal::sampled(&values, 1e-3) {
            let peaks = Peaks::find(&signal, 0.0).expect("valid");
            for peak in peaks.maxima.iter().chain(&peaks.minima) {
                prop_assert!(peak.time.is_finite() && peak.value.is_finite());
            }
            if let Ok(found) = LogarithmicDecrement::over_cycles(&peaks.maxima, target, 1) {
                prop_assert!(found.damping_ratio() > 0.0 && found.damping_ratio() <= 1.0);
            }
            if let Ok(found) = ResponseClassifier::default().classify(&signal, target + 2.0, target) {
                prop_assert!(found.decays.iter().all(|decay| !decay.is_nan()));
            }
        }
    }

    #[test]
    fn maxima_and_minima_alternate(values in prop::collection::vec(-5..5_i8, 1..80), prominence in 0..3_u8) {
        let values: Vec<f64> = values.into_iter().map(f64::from).collect();
        let signal = Signal::sampled(&values, 1.0).expect("valid");
        let peaks = Peaks::find(&signal, f64::from(prominence)).expect("valid");
        let mut all: Vec<(f64, i32)> = peaks.maxima.iter().map(|p| (p.time, 1)).collect();
        all.extend(peaks.minima.iter().map(|p| (p.time, -1)));
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        prop_assert!(all.windows(2).all(|pair| pair[0].1 == -pair[1].1), "{:?}", all);
        if prominence == 0 {
            // Brute force: a run of equal values between two lower ones.
            let mut runs = values.clone();
            runs.dedup();
            let expected = runs.windows(3).filter(|w| w[1] > w[0] && w[1] > w[2]).count();
            prop_assert_eq!(peaks.maxima.len(), expected);
        }
    }

    #[test]
    fn settling_is_the_last_time_outside(
        values in prop::collection::vec(-1.0..1.0_f64, 2..50), target in -0.5..0.5_f64, band in 0.0..1.0_f64
    ) {
        let signal = Signal::sampled(&values, 0.5).expect("valid");
        let outside = values.iter().rposition(|y| (y - target).abs() > band);
        match (signal.settling_time(target, band), outside) {
            (Ok(time), None) => prop_assert!(time <= 0.0),
            (Ok(time), Some(last)) => {
                let last = last as f64 * 0.5;
                prop_assert!(time >= last && time <= last + 0.5, "{} {}", time, last);
            }
            (Err(_), outside) => prop_assert_eq!(outside, Some(values.len() - 1)),
        }
    }

    #[test]
    fn a_random_stable_system_is_found(
        w in 0.03..0.6_f64, z in 0.02..0.9_f64, turn in -PI..PI, real in 0.01..0.5_f64, weight in 0.1..1.0_f64,
        third in any::<bool>(), first in any::<bool>()
    ) {
        let pole = Mode::new(w, z).expect("valid").pole();
        let mut terms = vec![((pole.re, pole.im), (w * turn.cos(), w * turn.sin()))];
        if third {
            terms.push(((-real, 0.0), (weight * real, 0.0)));
        }
        let system = Fractions::new(&terms);
        let (numerator, denominator) = system.coefficients();
        let scale = numerator.iter().zip(denominator.iter().skip(1)).map(|(b, a)| b.abs() / a).fold(0.0, f64::max);
        let zeros = numerator.len() - 1;
        // Without its first coefficient the numerator has a zero less.
        prop_assume!(numerator[0].abs() > 1e-3 * w);
        let hold = if first { Hold::First } else { Hold::Zero };
        let input = irregular(400);
        let output = system.output(&input, 1.0, hold, 0.0);
        let options = TransferFunctionOptions { hold, ..TransferFunctionOptions::new(zeros + 1, zeros) };
        let found = fit_transfer_function(&input, &output, 1.0, &options).expect("fits");
        prop_assert!(found.fit > 100.0 - 1e-6, "{}", found.fit);
        for (a, b) in found.denominator.iter().zip(&denominator) {
            prop_assert!((a - b).abs() < 1e-6 * b.abs(), "{:?} {:?}", found.denominator, denominator);
        }
        for ((a, b), c) in found.numerator.iter().zip(&numerator).zip(denominator.iter().skip(1)) {
            prop_assert!((a - b).abs() < 1e-6 * scale * c, "{:?} {:?}", found.numerator, numerator);
        }
    }

    #[test]
    fn no_fit_panics_and_none_is_nan(
        pairs in prop::collection::vec(
            (prop_oneof![-1.0..1.0, Just(0.0), -1e140..1e140], prop_oneof![-1.0..1.0, Just(0.0), Just(1e-140)]), 0..60
        ),
        poles in 0..4_usize, zeros in 0..4_usize, first in any::<bool>(), initial_state in any::<bool>(),
        offset in any::<bool>(), noise_lags in 0..100_usize
    ) {
        let (input, output): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
        let hold = if first { Hold::First } else { Hold::Zero };
        let options = TransferFunctionOptions { poles, zeros, hold, initial_state, offset, noise_lags };
        if let Ok(found) = fit_transfer_function(&input, &output, 1e-2, &options) {
            prop_assert!(found.poles.iter().all(|pole| pole.real < 0.0));
            prop_assert!(found.numerator.iter().chain(&found.denominator).all(|c| c.is_finite()));
            let deviations = found.numerator_deviations.iter().chain(&found.denominator_deviations);
            prop_assert!(deviations.copied().chain([found.dc_gain_deviation]).all(|d| d >= 0.0));
            for root in found.poles.iter().chain(&found.zeros) {
                prop_assert!(root.real.is_finite() && root.imaginary.is_finite());
                prop_assert!(root.frequency_deviation >= 0.0 && root.damping_deviation >= 0.0);
                prop_assert!(root.real_deviation >= 0.0 && root.imaginary_deviation >= 0.0);
            }
            prop_assert!(found.fit <= 100.0 && found.dc_gain.is_finite() && found.residual_deviation >= 0.0);
        }
    }

    #[test]
    fn averages_stay_in_range_and_spectra_find_their_sinusoid(
        values in prop::collection::vec(-1e308..1e308_f64, 1..80), length in 1..100_usize,
        bin in 4.0..28.0_f64, phase in -PI..PI, amplitude in 1e-3..1e3_f64
    ) {
        let average = MovingAverage::new(length).expect("positive");
        let largest = values.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        let zero_phase = average.zero_phase(&values).unwrap_or_default();
        for mean in average.causal(&values).expect("finite").iter().chain(&zero_phase) {
            prop_assert!(mean.abs() <= largest * (1.0 + 1e-13));
        }
        let record: Vec<f64> =
            (0..64).map(|n| amplitude * (TAU * bin * f64::from(n) / 64.0 + phase).cos()).collect();
        for window in [Window::Rectangular, Window::Hann, Window::Hamming, Window::Blackman] {
            let options = SpectrumOptions { window, remove_mean: false, least_length: 0 };
            let spectrum = amplitude_spectrum(&record, 1.0, &options).expect("valid");
            let peak = spectrum.peak(Interval::UNBOUNDED).expect("a peak");
            // A tenth of a bin, the image of the rectangular window four bins from the end being the worst.
            prop_assert!((peak.angular_frequency * 64.0 / TAU - bin).abs() < 0.1, "{:?}", window);
            prop_assert!((peak.amplitude / amplitude - 1.0).abs() < 0.02, "{:?}", window);
        }
    }
}
