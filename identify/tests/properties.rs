//! Properties of random decays and of random numbers that are none.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use identify::{
    LogarithmicDecrement, Peaks, ResponseClassifier, Signal, SinusoidError, SinusoidOptions,
    fit_damped_sinusoids,
};
use profiles::Mode;
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
}
