//! The delay line against an exactly simulated mode and against the convolution it stands for.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use profiles::{Complex, Mode, Real};
use proptest::prelude::*;
use shaping::{DelayFilter, DelayLine, DelayLineError, DelayLineState, Impulse, ImpulseTrain, Status};

/// What a step through taps on a clock leaves in a mode, as a part of what the step alone leaves: the exact motion
/// `q' = p q + u'` of the mode's coordinate from sample to sample, until the last tap has acted.
fn left_in(mode: Mode, period: f64, steps: impl IntoIterator<Item = f64>) -> f64 {
    let turn = (mode.pole() * period).exp();
    let (mut q, mut held) = (Complex::new(0.0, 0.0), 0.0);
    for u in steps {
        q = q * turn + (u - held);
        held = u;
    }
    q.norm()
}

/// The line's answer to a step, long enough for all its taps.
fn step<F: Real>(filter: &DelayFilter, mode: Mode, period: f64) -> Vec<f64> {
    let line = DelayLine::<F, 6, 128>::new(filter.train(), mode, period).expect("line");
    let mut state = DelayLineState::at_rest(F::ZERO);
    (0..128).map(|_| line.update(&mut state, F::ONE).output.to_f64()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2048))]

    #[test]
    fn the_zero_survives_any_delay_and_rate(
        hz in 5.0..200.0,
        z in prop_oneof![Just(0.0), 0.0..0.5],
        turns in 0.26..0.74_f64,
        samples_a_period in 2.5..100.0_f64,
    ) {
        let mode = Mode::from_hz(hz, z).expect("mode");
        let filter = DelayFilter::positive(mode, turns * mode.damped_period()).expect("filter");
        let period = mode.damped_period() / samples_a_period;
        if filter.train().duration() / period < 125.0 {
            // Near two samples a period the split needs taps of 1 / sin(w_d h).
            let spread = 1.0 / (std::f64::consts::TAU / samples_a_period).sin().abs();
            let left = left_in(mode, period, step::<f64>(&filter, mode, period));
            prop_assert!(left < 1e-13 * (1.0 + spread), "{left}");
        }
    }
}

/// Any train of up to four impulses, signs mixed, within 20 ms.
fn train() -> impl Strategy<Value = ImpulseTrain<4>> {
    let impulses = proptest::collection::vec((0.0..0.02, prop_oneof![0.1..1.0, -0.2..-0.05]), 1..5);
    impulses.prop_filter_map("amplitudes that nearly cancel", |mut impulses: Vec<(f64, f64)>| {
        impulses.sort_by(|a, b| a.0.total_cmp(&b.0));
        let impulses: Vec<Impulse> = impulses.into_iter().map(|(t, a)| Impulse::new(t, a)).collect();
        let sum: f64 = impulses.iter().map(|impulse| impulse.amplitude).sum();
        (sum.abs() > 0.2).then(|| ImpulseTrain::new(&impulses).expect("train"))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn the_line_is_the_offline_convolution(
        train in train(),
        hz in 5.0..200.0,
        input in proptest::collection::vec(-1.0..1.0, 1..200),
        rest in -1.0..1.0,
    ) {
        let mode = Mode::from_hz(hz, 0.05).expect("mode");
        let line = DelayLine::<f64, 8, 24>::new(&train, mode, 1e-3).expect("line");
        let mut state = DelayLineState::at_rest(rest);
        let online: Vec<f64> = input.iter().map(|u| line.update(&mut state, *u).output).collect();
        // The whole record at once: a kernel laid over it, with what was there before.
        let mut kernel = [0.0; 24];
        line.taps().for_each(|(delay, weight)| kernel[delay] += weight);
        let record: Vec<f64> = std::iter::repeat_n(rest, 23).chain(input).collect();
        for (online, window) in online.iter().zip(record.windows(24)) {
            let offline: f64 = kernel.iter().zip(window.iter().rev()).map(|(weight, u)| weight * u).sum();
            prop_assert!((online - offline).abs() < 1e-14, "{online} {offline}");
        }
    }

    #[test]
    fn the_taps_are_to_the_mode_what_the_impulses_were(
        train in train(),
        hz in 5.0..200.0,
        z in 0.0..0.5,
        detuned in 0.5..1.5,
    ) {
        let (mode, period) = (Mode::from_hz(hz, z).expect("mode"), 1e-3);
        let line = DelayLine::<f64, 8, 24>::new(&train, mode, period).expect("line");
        let taps: Vec<(usize, f64)> = line.taps().collect();
        prop_assert!((taps.iter().map(|tap| tap.1).sum::<f64>() - 1.0).abs() < 1e-14);
        // One scale for all, real, that makes the taps add up to one: any train, not only one with a zero there.
        let p = mode.pole();
        let seen = taps.iter().fold(Complex::new(0.0, 0.0), |sum, (k, a)| sum + (-p * period * *k as f64).exp() * *a);
        let exact = train.transform(p);
        let size: f64 = taps.iter().map(|(k, a)| a.abs() * (-p.re * period * *k as f64).exp()).sum();
        prop_assert!((seen * exact.conj()).im.abs() < 1e-13 * size * exact.norm() + 1e-13 * size * size);
        // What is left in another mode, stepped exactly, is the closed form of the taps.
        let beside = Mode::from_hz(hz * detuned, z).expect("mode");
        let mut state = DelayLineState::at_rest(0.0);
        let left = left_in(beside, period, (0..24).map(|_| line.update(&mut state, 1.0).output));
        let response = taps.iter().fold(Complex::new(0.0, 0.0), |sum, (k, a)| {
            sum + (beside.pole() * period * (23 - k) as f64).exp() * *a
        });
        let gain: f64 = taps.iter().map(|tap| tap.1.abs()).sum();
        prop_assert!((left - response.norm()).abs() < 1e-12 * gain, "{left} {}", response.norm());
    }
}

#[test]
fn at_1_khz_and_40_hz_what_is_left_is_rounding_and_plain_rounding_of_delays_is_not() {
    let period = 1e-3;
    let mut worst = [0.0_f64; 4];
    for z in [0.0, 0.02, 0.1] {
        let mode = Mode::from_hz(40.0, z).expect("mode");
        for part in 0..100 {
            let delay = mode.damped_period() * (0.26 + 0.48 * f64::from(part) / 100.0);
            let filter = DelayFilter::positive(mode, delay).expect("filter");
            let in_f64 = left_in(mode, period, step::<f64>(&filter, mode, period));
            let in_f32 = left_in(mode, period, step::<f32>(&filter, mode, period));
            // The two ways in common use: the nearest sample, and a straight line between samples.
            let command = |line: bool| {
                let impulses = filter.train().impulses().to_vec();
                (0..128).map(move |k| {
                    let reached = |i: &Impulse| {
                        let late = f64::from(k) - i.time / period;
                        if line { (late + 1.0).clamp(0.0, 1.0) } else { f64::from(u8::from(late > -0.5)) }
                    };
                    impulses.iter().map(|i| i.amplitude * reached(i)).sum::<f64>()
                })
            };
            let found =
                [in_f64, in_f32, left_in(mode, period, command(false)), left_in(mode, period, command(true))];
            for (worst, found) in worst.iter_mut().zip(found) {
                *worst = worst.max(found);
            }
        }
    }
    let [in_f64, in_f32, nearest, straight] = worst;
    assert!(in_f64 < 1e-12, "{in_f64}");
    assert!(in_f32 < 1e-5, "{in_f32}");
    assert!(nearest > 1e-2 && straight > 1e-4, "{nearest} {straight}");
}

#[test]
fn whole_samples_are_the_convolution() {
    let train =
        ImpulseTrain::<3>::new(&[Impulse::new(0.0, 0.5), Impulse::new(0.003, 0.3), Impulse::new(0.007, 0.2)])
            .expect("train");
    let mode = Mode::from_hz(60.0, 0.05).expect("mode");
    let line = DelayLine::<f64, 3, 8>::new(&train, mode, 1e-3).expect("line");
    assert_eq!(line.taps().map(|(delay, _)| delay).collect::<Vec<_>>(), [0, 3, 7]);
    let input = |k: i32| if k < 0 { 2.0 } else { f64::from((k * k) % 17) };
    let mut state = DelayLineState::at_rest(2.0);
    for k in 0..100 {
        let expected = 0.5 * input(k) + 0.3 * input(k - 3) + 0.2 * input(k - 7);
        let answer = line.update(&mut state, input(k));
        assert!((answer.output - expected).abs() < 1e-14 && answer.status == Status::Regular);
    }
}

#[test]
fn an_input_that_is_not_finite_is_the_one_before_it() {
    let mode = Mode::from_hz(40.0, 0.02).expect("mode");
    let filter = DelayFilter::zvd(mode).expect("filter");
    let line = DelayLine::<f32, 6, 32>::new(filter.train(), mode, 1e-3).expect("line");
    let (mut broken, mut whole) = (DelayLineState::at_rest(1.0), DelayLineState::at_rest(1.0));
    for k in 0..60_u16 {
        let good = f32::from(k % 7);
        let gap = k % 5 == 4;
        let held = f32::from((k - u16::from(gap)) % 7);
        let answer = line.update(&mut broken, if gap { f32::NAN } else { good });
        assert_eq!(answer.status, if gap { Status::Held } else { Status::Regular });
        let expected = line.update(&mut whole, if gap { held } else { good });
        assert!((answer.output - expected.output).abs() <= f32::EPSILON);
    }
    assert!(line.update(&mut DelayLineState::at_rest(f32::NAN), 0.0).output.abs() <= 0.0);
}

#[test]
fn bad_clocks_are_named_with_their_number() {
    let mode = Mode::from_hz(40.0, 0.02).expect("mode");
    let train = *DelayFilter::zvd(mode).expect("filter").train();
    let line = |period: f64| DelayLine::<f64, 6, 16>::new(&train, mode, period);
    assert_eq!(line(0.0), Err(DelayLineError::Period(0.0)));
    assert!(matches!(line(0.0126), Err(DelayLineError::Undersampled { .. })));
    assert!(matches!(line(1e-3), Err(DelayLineError::History { capacity: 16, .. })));
    assert!(matches!(line(1e-300), Err(DelayLineError::History { .. })));
    assert_eq!(DelayLine::<f64, 4, 64>::new(&train, mode, 1e-3), Err(DelayLineError::Taps { capacity: 4 }));
}
