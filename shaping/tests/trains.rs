//! Trains and delay filters against their poles, the published amplitudes, and each other.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use profiles::{Complex, Mode};
use proptest::prelude::*;
use shaping::{DelayFilter, DelayFilterError, Impulse, ImpulseTrain, TrainError};

fn mode() -> impl Strategy<Value = Mode> {
    ((0.1_f64.ln()..1e4_f64.ln()).prop_map(f64::exp), prop_oneof![Just(0.0), 0.0..0.9])
        .prop_map(|(w, z)| Mode::new(w, z).expect("mode"))
}

/// Delays in damped periods that keep clear of whole ones, where an undamped mode allows no filter.
fn turns() -> impl Strategy<Value = f64> {
    (0_u32..4, 0.05..0.95).prop_map(|(whole, part)| f64::from(whole) + part)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4096))]

    #[test]
    fn the_filter_has_its_zeros_on_the_pole_pair(mode in mode(), turns in turns()) {
        let filter = DelayFilter::new(mode, turns * mode.damped_period()).expect("filter");
        let largest = filter.amplitudes().into_iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        // Rounding of the phase and of three amplitudes.
        prop_assert!(filter.train().residual(mode) <= 8e-16 * (1.0 + turns * 6.3) * largest);
        prop_assert!((filter.amplitudes().iter().sum::<f64>() - 1.0).abs() < 1e-15 * (1.0 + largest));
        // A zero, not smallness: half a percent beside the mode there is something left.
        if mode.damping_ratio() < 0.1 {
            prop_assert!(filter.train().sensitivity(mode, 0.005) > 1e-7);
        }
    }

    #[test]
    fn a_convolution_has_the_zeros_of_both(a in mode(), b in mode(), first in turns(), second in turns()) {
        let first = DelayFilter::new(a, first * a.damped_period()).expect("filter");
        let second = DelayFilter::new(b, second * b.damped_period()).expect("filter");
        let both: ImpulseTrain<9> = first.train().convolved(second.train()).expect("room");
        for p in [a.pole(), b.pole(), Complex::new(-0.3, 2.0) * a.angular_frequency()] {
            let product = first.train().response(p) * second.train().response(p);
            let scale: f64 = both.impulses().iter().map(|i| i.amplitude.abs()).sum();
            let phase = 1.0 + p.norm() * both.duration();
            prop_assert!((both.response(p) - product).norm() <= 4e-16 * phase * scale);
        }
        prop_assert!(both.impulses().is_sorted_by_key(|i| i.time));
        prop_assert!((both.duration() - first.train().duration() - second.train().duration()).abs() < 1e-14 * both.duration());
    }
}

#[test]
fn the_published_amplitudes_come_out() {
    // J. Wu, Y. Zhang 2019: damping, frequency in rad/s, delay in s, amplitudes of table 3 and of the pulse axis.
    for (z, w, delay, printed) in [
        (0.4583, 274.01, 0.007, [0.7792, 0.0864, 0.1344]),
        (0.0722, 439.92, 0.006, [0.3198, 0.4617, 0.2185]),
        (0.15, 465.668, 0.006, [0.3767, 0.4603, 0.1629]),
    ] {
        let filter = DelayFilter::positive(Mode::new(w, z).expect("mode"), delay).expect("filter");
        for (ours, printed) in filter.amplitudes().into_iter().zip(printed) {
            assert!((ours - printed).abs() < 1e-4, "{ours} {printed}");
        }
    }
    // The pulse axis mixes 117 rad/s and 104.8 rad/s, which are not one mode; this is the pole that it uses.
    let (decay, damped) = (0.2123 * 117.0, 104.8_f64);
    let w = damped.hypot(decay);
    let pulse_axis = DelayFilter::positive(Mode::new(w, decay / w).expect("mode"), 0.02).expect("filter");
    for (ours, printed) in pulse_axis.amplitudes().into_iter().zip([0.505, 0.308, 0.187]) {
        // Three digits are printed.
        assert!((ours - printed).abs() < 6e-4, "{ours} {printed}");
    }
}

#[test]
fn half_a_period_is_the_zvd_shaper() {
    // 1, 2 K, K^2 over (1 + K)^2 with K = e^(-z pi / sqrt(1 - z^2)): the vibration's derivative vanishes too.
    let mode = Mode::from_hz(40.0, 0.1).expect("mode");
    let k = (-0.1 * std::f64::consts::PI / 0.99_f64.sqrt()).exp();
    let filter = DelayFilter::zvd(mode).expect("filter");
    for (ours, known) in filter.amplitudes().into_iter().zip([1.0, 2.0 * k, k * k]) {
        assert!((ours - known / ((1.0 + k) * (1.0 + k))).abs() < 1e-15);
    }
    // Second order in the frequency error.
    let ratio = filter.train().sensitivity(mode, 2e-3) / filter.train().sensitivity(mode, 1e-3);
    assert!((ratio - 4.0).abs() < 0.02, "{ratio}");
}

#[test]
fn the_width_of_the_band_is_known_for_undamped_modes() {
    // |cos(pi/2 (1 + e))| for two impulses half a period apart, its square for the ZVD shaper.
    let mode = Mode::new(100.0, 0.0).expect("mode");
    let half = 0.5 * mode.damped_period();
    let zv = ImpulseTrain::<2>::new(&[Impulse::new(0.0, 0.5), Impulse::new(half, 0.5)]).expect("train");
    let zvd = *DelayFilter::zvd(mode).expect("filter").train();
    for tolerance in [0.01_f64, 0.05, 0.3] {
        let known = tolerance.asin() * std::f64::consts::FRAC_2_PI;
        let band = zv.insensitivity(mode, tolerance).expect("band");
        assert!((band.upper - known).abs() < 1e-14 && (band.lower + known).abs() < 1e-14, "{band:?}");
        let known = tolerance.sqrt().asin() * std::f64::consts::FRAC_2_PI;
        let band = zvd.insensitivity(mode, tolerance).expect("band");
        assert!((band.upper - known).abs() < 1e-14 && (band.lower + known).abs() < 1e-14, "{band:?}");
    }
    // Everything, nothing, and a frequency of zero.
    let all = zv.insensitivity(mode, 1.0).expect("band");
    assert!(all.upper.is_infinite() && (all.lower + 1.0).abs() < 1e-15);
    // A train of a great many turns is searched as far as it goes, and no further.
    let long = ImpulseTrain::<2>::new(&[Impulse::new(0.0, 0.5), Impulse::new(1e4, 0.5)]).expect("train");
    let fast = Mode::new(1e4, 0.0).expect("mode");
    let searched = 100.0 * std::f64::consts::TAU / 1e8;
    let band = long.insensitivity(fast, 1.0).expect("band");
    assert!((band.lower + searched).abs() < 1e-12 && band.upper.is_infinite(), "{band:?}");
    assert!((zv.sensitivity(mode, -20.0) - 1.0).abs() < 1e-15);
    let detuned = Mode::new(110.0, 0.0).expect("mode");
    assert_eq!(zv.insensitivity(detuned, 0.05), None);
    assert_eq!(zv.insensitivity(mode, f64::NAN), None);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn the_band_ends_where_the_sensitivity_passes_the_tolerance(
        mode in mode(),
        turns in turns(),
        tolerance in 0.01..0.5,
    ) {
        let filter = DelayFilter::new(mode, turns * mode.damped_period()).expect("filter");
        let band = filter.train().insensitivity(mode, tolerance).expect("band");
        for k in 0..=200 {
            let reach = band.lower + (band.upper.min(10.0) - band.lower) * f64::from(k) / 200.0;
            prop_assert!(filter.train().sensitivity(mode, reach) <= tolerance * (1.0 + 1e-9));
        }
        for end in [band.lower, band.upper] {
            if end > -1.0 && end.is_finite() {
                prop_assert!(filter.train().sensitivity(mode, end * (1.0 + 1e-9)) >= tolerance * (1.0 - 1e-6));
            }
        }
    }
}

#[test]
fn the_transform_is_the_response_seen_from_the_start() {
    let train =
        ImpulseTrain::<4>::new(&[Impulse::new(0.0, 1.0), Impulse::new(0.3, -0.5), Impulse::new(0.7, 1.5)])
            .expect("train");
    let s = Complex::new(-0.4, 3.0);
    // By hand: amplitudes 0.5, -0.25, 0.75.
    let by_hand = Complex::new(0.5, 0.0) - (-s * 0.3).exp() * 0.25 + (-s * 0.7).exp() * 0.75;
    assert!((train.transform(s) - by_hand).norm() < 1e-15);
    assert!((train.response(s) - (s * 0.7).exp() * by_hand).norm() < 1e-15);
    assert!((train.mean_delay() - (-0.25 * 0.3 + 0.75 * 0.7)).abs() < 1e-16);
}

#[test]
fn bad_trains_are_named_with_their_number() {
    let new = |impulses: &[Impulse]| ImpulseTrain::<2>::new(impulses);
    assert_eq!(new(&[]), Err(TrainError::Empty));
    let three = [Impulse::new(0.0, 1.0); 3];
    assert_eq!(new(&three), Err(TrainError::Capacity { needed: 3, capacity: 2 }));
    assert!(matches!(new(&[Impulse::new(0.0, f64::NAN)]), Err(TrainError::Amplitude { index: 0, .. })));
    assert!(matches!(new(&[Impulse::new(-1.0, 1.0)]), Err(TrainError::Time { index: 0, .. })));
    let back = [Impulse::new(0.2, 1.0), Impulse::new(0.1, 1.0)];
    assert_eq!(new(&back), Err(TrainError::Time { index: 1, value: 0.1, earliest: 0.2 }));
    assert_eq!(new(&[Impulse::new(0.0, 1.0), Impulse::new(0.1, -1.0)]), Err(TrainError::Sum(0.0)));
    let two = new(&[Impulse::new(0.0, 1.0), Impulse::new(0.1, 1.0)]).expect("train");
    assert_eq!(two.convolved::<2, 2>(&two), Err(TrainError::Capacity { needed: 4, capacity: 2 }));
    // Two of the four impulses fall together.
    assert_eq!(two.convolved::<2, 3>(&two).expect("room").impulses().len(), 3);
}

#[test]
fn bad_delays_are_named_with_their_number() {
    let mode = Mode::new(100.0, 0.0).expect("mode");
    let period = mode.damped_period();
    assert_eq!(DelayFilter::new(mode, 0.0), Err(DelayFilterError::Delay(0.0)));
    assert!(matches!(DelayFilter::new(mode, f64::NAN), Err(DelayFilterError::Delay(t)) if t.is_nan()));
    assert!(matches!(DelayFilter::new(mode, 3.0 * period), Err(DelayFilterError::WholePeriods { .. })));
    assert!(DelayFilter::positive(mode, 0.26 * period).is_ok());
    assert!(DelayFilter::positive(mode, 1.74 * period).is_ok());
    for turns in [0.24, 0.76, 1.1] {
        let error = DelayFilter::positive(mode, turns * period).expect_err("negative");
        assert!(
            matches!(error, DelayFilterError::Negative { turns: t, .. } if (t - turns).abs() < 1e-12),
            "{error}"
        );
    }
}
