//! Certified bounds against dense sampling, and what a train costs.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use profiles::{Complex, Interval, Limits, Mode, Profile, SCurve};
use proptest::prelude::*;
use shaping::{Impulse, ImpulseTrain, ModeRange, ModeRangeError, Shaped, Shaper};

fn mode(w: f64, z: f64) -> Mode {
    Mode::new(w, z).expect("mode")
}

fn shaper() -> impl Strategy<Value = Shaper> {
    prop_oneof![
        (1_usize..=4).prop_map(|order| Shaper::ZeroVibration { order }),
        (0.5..1.0).prop_map(|span| Shaper::EquallySpaced { impulses: 3, span }),
        (1_usize..=3, 0.01..0.1).prop_map(|(humps, tolerance)| Shaper::ExtraInsensitive { humps, tolerance }),
        (1.0..3.0).prop_map(|demand| Shaper::Negative { order: 1, demand }),
        (1.0..5.0).prop_map(|demand| Shaper::Negative { order: 2, demand }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn no_sample_of_a_range_is_above_the_bound(
        shaper in shaper(),
        w in (0.1_f64.ln()..1e4_f64.ln()).prop_map(f64::exp),
        z in 0.0..0.2,
        low in 0.2_f64..1.0,
        high in 1.0_f64..3.0,
        least in 0.0_f64..1.0,
        most in 0.0_f64..0.5,
    ) {
        let train: ImpulseTrain<5> = shaper.train(mode(w, z)).expect("train");
        let (frequency, damping) = (Interval::new(low * w, high * w), Interval::new(least * z, z + most));
        let range = ModeRange::new(frequency, damping).expect("range");
        let worst = train.worst_case(&range);
        prop_assert!(range.contains(worst.mode));
        prop_assert!((train.residual(worst.mode) - worst.residual).abs() < 1e-15);
        prop_assert!(worst.residual <= worst.bound && worst.bound <= worst.residual + 1.001e-9);
        for i in 0..=60 {
            let at = low + (high - low) * f64::from(i) / 60.0;
            for k in 0..=20 {
                let ratio = damping.lower + (damping.upper - damping.lower) * f64::from(k) / 20.0;
                let left = train.residual(mode((at * w).min(frequency.upper), ratio.min(damping.upper)));
                prop_assert!(left <= worst.bound, "{left} {worst:?}");
            }
        }
    }

    #[test]
    fn the_transient_is_the_largest_vibration_of_a_dense_sampling(
        shaper in shaper(),
        z in 0.0..0.2,
        ratio in 0.3..3.0,
    ) {
        let train: ImpulseTrain<5> = shaper.train(mode(1.0, z)).expect("train");
        let mode = mode(ratio, z);
        let transient = train.transient(mode);
        let mut largest = 0.0_f64;
        for k in 0..=4000 {
            let t = train.duration() * f64::from(k) / 4000.0;
            let past = train.impulses().iter().filter(|impulse| impulse.time <= t);
            let sum: Complex<f64> = past.map(|i| (mode.pole() * (t - i.time)).exp() * i.amplitude).sum();
            largest = largest.max(sum.norm());
        }
        prop_assert!(largest <= transient + 1e-14);
        // It is reached just after an impulse.
        let after = |t: f64| -> Complex<f64> {
            let past = train.impulses().iter().filter(|impulse| impulse.time <= t);
            past.map(|i| (mode.pole() * (t - i.time)).exp() * i.amplitude).sum()
        };
        let peak = train.impulses().iter().map(|i| after(i.time).norm()).fold(0.0_f64, f64::max);
        prop_assert!((peak - transient).abs() < 1e-14);
    }

    #[test]
    fn no_derivative_of_a_command_grows_by_more_than_the_demand(
        shaper in shaper(),
        w in 5.0..500.0,
        z in 0.0..0.2,
    ) {
        let train: ImpulseTrain<5> = shaper.train(mode(w, z)).expect("train");
        let profile = SCurve::rest_to_rest(0.04, &Limits::new(0.2, 4.0, 200.0).expect("limits")).expect("plan");
        let (plain, shaped) = (profile.extrema(), Shaped::new(profile, train).extrema());
        let held = |shaped: Interval, plain: Interval| {
            shaped.magnitude() <= train.demand() * plain.magnitude() * (1.0 + 1e-12)
        };
        prop_assert!(held(shaped.velocity, plain.velocity));
        prop_assert!(held(shaped.acceleration, plain.acceleration));
        prop_assert!(held(shaped.jerk, plain.jerk));
        // The family never exceeds a command nor reverses it.
        prop_assert_eq!(train.step_range(), Interval::new(0.0, 1.0));
    }
}

#[test]
fn the_worst_case_of_two_halves_is_known() {
    // |cos(w t / 2)| of two halves t apart: zero at w t = pi, and largest at the end that is further from there.
    let train = ImpulseTrain::<2>::new(&[Impulse::new(0.0, 0.5), Impulse::new(0.1, 0.5)]).expect("train");
    let at = |turn: f64| turn / 0.1;
    let worst = |from: f64, to: f64| {
        let frequency = Interval::new(at(from), at(to));
        train.worst_case(&ModeRange::new(frequency, Interval::new(0.0, 0.0)).expect("range"))
    };
    let low = worst(2.0, 3.5);
    assert!((low.residual - 1.0_f64.cos()).abs() < 1e-15 && (low.bound - low.residual) < 1.1e-9);
    assert!((low.mode.angular_frequency() - 20.0).abs() < 1e-12);
    // With a whole turn inside nothing is taken away.
    let whole = worst(3.0, 7.0);
    assert!((whole.bound - 1.0).abs() < 1.1e-9 && whole.residual > 1.0 - 1.1e-9);
    // One mode, known exactly.
    let one = train.worst_case(&mode(at(std::f64::consts::PI), 0.0).into());
    assert!(one.residual < 1e-15 && one.bound < 2e-14, "{one:?}");
}

#[test]
fn a_train_of_thousands_of_turns_is_bounded_all_the_same() {
    let impulses: [Impulse; 8] = std::array::from_fn(|k| Impulse::new(1.37 * (k * k) as f64, 1.0));
    let train = ImpulseTrain::<8>::new(&impulses).expect("train");
    let range = ModeRange::new(Interval::new(300.0, 900.0), Interval::new(0.0, 0.3)).expect("range");
    let worst = train.worst_case(&range);
    assert!(worst.bound <= 1.0 + 1e-9);
    for k in 0..20_000 {
        let left = train.residual(mode(300.0 + 0.03 * f64::from(k), 0.0));
        assert!(left <= worst.bound, "{left} {worst:?}");
    }
}

#[test]
fn a_report_says_what_its_parts_say() {
    let m = mode(250.0, 0.1);
    let range = ModeRange::around(m, 0.1, 0.05).expect("range");
    let train: ImpulseTrain<3> = Shaper::UNITY_MAGNITUDE_ZV.train(m).expect("train");
    let report = train.robustness(m, &range, 0.05);
    assert_eq!(report.worst_case, train.worst_case(&range));
    assert_eq!(report.insensitivity, train.insensitivity(m, 0.05));
    assert_eq!((report.duration, report.mean_delay), (train.duration(), train.mean_delay()));
    assert_eq!((report.demand, report.step), (3.0, Interval::new(0.0, 1.0)));
    assert!(report.residual < 1e-15);
    // The first impulse excites the mode fully, and the second hardly more.
    assert!(report.transient >= 1.0 && report.transient < 1.1);
    // A command that overshoots and reverses.
    let wild =
        ImpulseTrain::<3>::new(&[Impulse::new(0.0, 2.0), Impulse::new(1.0, -2.5), Impulse::new(2.0, 1.5)]);
    assert_eq!(wild.expect("train").step_range(), Interval::new(-0.5, 2.0));
}

#[test]
fn the_table_of_the_readme_holds() {
    let m = Mode::from_hz(40.0, 0.1).expect("mode");
    let range = ModeRange::around(m, 0.1, 0.05).expect("range");
    let humps = |humps| Shaper::ExtraInsensitive { humps, tolerance: 0.05 };
    for (shaper, printed) in [
        (Shaper::ZV, [12.56, -3.7, 3.8, 16.1, 0.58, 1.0]),
        (Shaper::ZVD, [25.13, -16.5, 17.5, 2.6, 0.33, 1.0]),
        (Shaper::ZVDD, [37.69, -27.3, 30.1, 0.4, 0.28, 1.0]),
        (Shaper::MZV, [18.84, -6.1, 7.4, 10.7, 0.37, 1.0]),
        (humps(1), [25.02, -22.7, 24.5, 6.4, 0.35, 1.0]),
        (humps(2), [37.22, -40.1, 45.9, 5.1, 0.26, 1.0]),
        (humps(3), [49.27, -52.4, 62.8, 7.3, 0.22, 1.0]),
        (Shaper::Negative { order: 1, demand: 2.0 }, [9.85, -3.3, 3.3, 18.6, 0.79, 2.0]),
        (Shaper::UNITY_MAGNITUDE_ZV, [8.39, -3.1, 3.1, 19.8, 1.09, 3.0]),
        (Shaper::UNITY_MAGNITUDE_ZVD, [18.46, -14.8, 14.4, 3.5, 1.04, 5.0]),
    ] {
        let train: ImpulseTrain<5> = shaper.train(m).expect("train");
        // The humps touch the tolerance.
        let report = train.robustness(m, &range, 0.05 * (1.0 + 1e-9));
        let band = report.insensitivity.expect("band");
        let percent = [band.lower, band.upper, report.worst_case.bound].map(|part| 100.0 * part);
        let ours =
            [1e3 * report.duration, percent[0], percent[1], percent[2], report.transient, report.demand];
        for ((ours, printed), digit) in ours.into_iter().zip(printed).zip([0.01, 0.1, 0.1, 0.1, 0.01, 1.0]) {
            assert!((ours - printed).abs() < 0.51 * digit, "{shaper:?}: {ours} {printed}");
        }
    }
}

#[test]
fn bad_ranges_are_named_with_their_numbers() {
    let new = |w: (f64, f64), z: (f64, f64)| ModeRange::new(Interval::new(w.0, w.1), Interval::new(z.0, z.1));
    let frequency = |lower, upper| Err(ModeRangeError::Frequency { lower, upper });
    let damping = |lower, upper| Err(ModeRangeError::DampingRatio { lower, upper });
    assert_eq!(new((2.0, 1.0), (0.0, 0.1)), frequency(2.0, 1.0));
    assert_eq!(new((0.0, 1.0), (0.0, 0.1)), frequency(0.0, 1.0));
    assert_eq!(new((1.0, f64::INFINITY), (0.0, 0.1)), frequency(1.0, f64::INFINITY));
    assert!(matches!(new((1.0, f64::NAN), (0.0, 0.1)), Err(ModeRangeError::Frequency { .. })));
    assert_eq!(new((1.0, 2.0), (0.2, 0.1)), damping(0.2, 0.1));
    assert_eq!(new((1.0, 2.0), (0.0, 1.0)), damping(0.0, 1.0));
    assert_eq!(new((1.0, 2.0), (-0.1, 0.1)), damping(-0.1, 0.1));
    let m = mode(10.0, 0.02);
    assert!(ModeRange::around(m, 1.0, 0.0).is_err() && ModeRange::around(m, -0.1, 0.0).is_err());
    assert!(ModeRange::around(m, 0.1, -0.01).is_err() && ModeRange::around(m, 0.1, 0.99).is_err());
    assert!(ModeRange::around(m, f64::NAN, 0.0).is_err() && ModeRange::around(m, 0.1, f64::NAN).is_err());
    assert_eq!(ModeRange::around(m, 0.1, 0.05).expect("range").lowest().damping_ratio().to_bits(), 0);
}
