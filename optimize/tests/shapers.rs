//! Shortest trains: what they are asked for, at the modes and between samples, and beside what they replace.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use optimize::shapers::{Requirement, ShortestTrainError, shortest_train};
use profiles::{Complex, Interval, Mode};
use proptest::prelude::*;
use shaping::{ImpulseTrain, ModeRange, Shaper, TrainError};

/// A train of any size that a search may end with.
type Any = ImpulseTrain<32>;

fn mode(w: f64, z: f64) -> Mode {
    Mode::new(w, z).expect("mode")
}

fn zero(mode: Mode, order: usize) -> Requirement {
    Requirement::Zero { mode, order }
}

fn range(lower: f64, upper: f64, least: f64, most: f64) -> ModeRange {
    ModeRange::new(Interval::new(lower, upper), Interval::new(least, most)).expect("range")
}

fn shortest(requirements: &[Requirement], demand: f64) -> Any {
    shortest_train::<32>(requirements, demand).expect("a train").train
}

#[test]
fn one_mode_gets_the_shaper_that_is_known_to_be_shortest() {
    for z in [0.0, 0.1, 0.4] {
        let mode = mode(250.0, z);
        for (shaper, order) in [(Shaper::ZV, 1), (Shaper::ZVD, 2)] {
            let known: Any = shaper.train(mode).expect("shaper");
            let ours = shortest(&[zero(mode, order)], 1.0);
            assert_eq!(ours.impulses().len(), known.impulses().len());
            for (a, b) in ours.impulses().iter().zip(known.impulses()) {
                // The times of a zero of order two are found to the root of what is left of it, 1e-13.
                let tolerance = if order == 1 { 1e-12 } else { 1e-6 };
                assert!((a.amplitude - b.amplitude).abs() < tolerance, "{ours:?}");
                assert!((a.time - b.time).abs() < tolerance * known.duration());
            }
        }
    }
}

#[test]
fn a_mode_of_three_times_the_frequency_costs_nothing() {
    // Half a period of the slow one is three halves of the fast one.
    let modes = [mode(10.0, 0.0), mode(30.0, 0.0)];
    let joint = shortest(&modes.map(|mode| zero(mode, 1)), 1.0);
    assert!((joint.duration() - 0.1 * std::f64::consts::PI).abs() < 1e-9, "{joint:?}");
    assert!(modes.iter().all(|mode| joint.residual(*mode) < 1e-12));
}

#[test]
fn the_durations_of_the_readme_hold() {
    let ratios = [1.2, 1.5, 2.0, 2.3, 3.0, 5.0];
    let one_by_one = [1.833, 1.667, 1.5, 1.435, 1.333, 1.2];
    for ((ratio, one_by_one), known) in
        ratios.into_iter().zip(one_by_one).zip([1.818, 1.6, 1.333, 1.212, 1.06, 1.047])
    {
        let modes = [mode(100.0, 0.02), mode(100.0 * ratio, 0.02)];
        let half = 0.5 * modes[0].damped_period();
        let joint = shortest(&modes.map(|mode| zero(mode, 1)), 1.0);
        // Three digits are printed.
        assert!((joint.duration() / half - known).abs() < 6e-4, "{ratio} {}", joint.duration() / half);
        let sum: f64 = modes.iter().map(|mode| 0.5 * mode.damped_period()).sum();
        assert!((sum / half - one_by_one).abs() < 6e-4);
    }
}

/// Two to three modes within a decade, with their damping and the order of their zeros.
fn modes() -> impl Strategy<Value = Vec<(f64, f64, usize)>> {
    let order = prop_oneof![4 => Just(1_usize), 1 => Just(2)];
    prop::collection::vec((0.0_f64..1.0, 0.0..0.2, order), 2..=3).prop_map(|modes| {
        modes.into_iter().map(|(decade, z, order)| (50.0 * 10.0_f64.powf(decade), z, order)).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn zeros_of_all_modes_are_exact_and_take_no_longer_than_one_by_one(
        modes in modes(),
        demand in prop_oneof![2 => Just(1.0), 1 => 1.0..3.0],
    ) {
        let requirements: Vec<_> = modes.iter().map(|&(w, z, order)| zero(mode(w, z), order)).collect();
        let train = shortest(&requirements, demand);
        let mut one_by_one = 0.0;
        for &(w, z, order) in &modes {
            let mode = mode(w, z);
            prop_assert!(train.residual(mode) < 1e-12, "{}", train.residual(mode));
            if order == 2 {
                // sum of A (T - t) e^(p (T - t)), by hand.
                let end = train.duration();
                let slope: Complex<f64> = train
                    .impulses()
                    .iter()
                    .map(|i| (mode.pole() * (end - i.time)).exp() * (i.amplitude * (end - i.time) * w))
                    .sum();
                prop_assert!(slope.norm() < 1e-11, "{slope}");
            }
            one_by_one += order as f64 * 0.5 * mode.damped_period();
        }
        prop_assert!(train.duration() <= one_by_one * (1.0 + 1e-6), "{} {one_by_one}", train.duration());
        prop_assert!(train.demand() <= demand + 1e-10);
        if demand <= 1.0 {
            prop_assert!(train.impulses().iter().all(|impulse| impulse.amplitude > 0.0));
        }
    }

    #[test]
    fn a_range_is_kept_between_all_samples_in_less_time_than_by_any_shaper(
        part in 0.03_f64..0.4,
        z in 0.0..0.15,
        spread in prop_oneof![Just(0.0), 0.0..0.05],
        tolerance in 0.01..0.1,
    ) {
        let range = range(100.0 * (1.0 - part), 100.0 * (1.0 + part), z, z + spread);
        let requirement = Requirement::Within { range, tolerance };
        let shortest = shortest_train::<32>(&[requirement], 1.0).expect("a train");
        let train = shortest.train;
        prop_assert!(shortest.worst_cases.len() == 1 && shortest.worst_cases[0].bound <= tolerance);
        prop_assert!(train.impulses().iter().all(|impulse| impulse.amplitude > 0.0));
        for i in 0..=400 {
            let w = 100.0 * (1.0 - part + 2.0 * part * f64::from(i) / 400.0);
            for k in 0..=4 {
                let left = train.residual(mode(w, z + spread * f64::from(k) / 4.0));
                prop_assert!(left <= tolerance * (1.0 + 1e-9), "{w} {left}");
            }
        }
        // The family, tuned to the middle of the range.
        let middle = mode(100.0 * (1.0 - part * part).sqrt(), z + 0.5 * spread);
        let humps = (1..=3).map(|humps| Shaper::ExtraInsensitive { humps, tolerance });
        for shaper in (1..=5).map(|order| Shaper::ZeroVibration { order }).chain(humps) {
            if let Ok(other) = shaper.train::<6>(middle)
                && other.worst_case(&range).bound <= tolerance
            {
                prop_assert!(train.duration() <= other.duration() * (1.0 + 1e-6), "{shaper:?}");
            }
        }
    }
}

#[test]
fn on_the_band_of_an_extra_insensitive_shaper_it_is_no_longer_than_that() {
    for z in [0.0, 0.1, 0.2] {
        let mode = mode(100.0, z);
        let known: ImpulseTrain<3> = Shaper::extra_insensitive(0.05).train(mode).expect("shaper");
        let band = known.insensitivity(mode, 0.05 * (1.0 + 1e-9)).expect("band");
        let range = range(100.0 * (1.0 + band.lower), 100.0 * (1.0 + band.upper), z, z);
        let train = shortest(&[Requirement::Within { range, tolerance: 0.05 }], 1.0);
        let ratio = train.duration() / known.duration();
        // Undamped that is the shortest, and keeps its band by a hair; with damping it all but is.
        assert!(ratio <= 1.0 + 2e-5 && ratio > 0.999, "{ratio}");
    }
}

#[test]
fn no_train_of_three_impulses_is_shorter_for_two_modes() {
    // Amplitudes that leave nothing of the first mode, for any two times; what they leave of the second, by a scan.
    let (first, second) = (mode(1.0, 0.02), mode(2.3, 0.02));
    let joint = shortest(&[zero(first, 1), zero(second, 1)], 1.0);
    let least = |end: f64| {
        let mut least = f64::INFINITY;
        for k in 1..600 {
            let middle = end * f64::from(k) / 600.0;
            let phasor = |t: f64| (-first.pole() * t).exp();
            let (b, c) = (phasor(middle), phasor(end));
            // 1 + x b + y c = 0 by Cramer's rule.
            let determinant = b.re * c.im - b.im * c.re;
            let (x, y) = (-c.im / determinant, b.im / determinant);
            let sum = 1.0 + x + y;
            if x >= 0.0 && y >= 0.0 {
                let p = second.pole();
                let left = (p * end).exp() + (p * (end - middle)).exp() * x + y;
                least = least.min(left.norm() / sum);
            }
        }
        least
    };
    // It is found where the train says it is, and nowhere before.
    assert!(least(joint.duration()) < 5e-3);
    for k in 0..400 {
        let end = joint.duration() * 0.99 * f64::from(k) / 400.0;
        assert!(least(end) > 5e-3, "{end}");
    }
}

#[test]
fn zeros_and_ranges_mix_and_more_demand_is_shorter() {
    let (slow, fast) = (mode(10.0, 0.02), range(20.0, 26.0, 0.02, 0.04));
    let requirements = [zero(slow, 1), Requirement::Within { range: fast, tolerance: 0.05 }];
    let mut before = f64::INFINITY;
    for demand in [1.0, 1.5, 2.0, 3.0] {
        let found = shortest_train::<32>(&requirements, demand).expect("a train");
        assert!(found.train.residual(slow) < 1e-12);
        assert!(found.worst_cases[0].bound <= 0.05 && found.train.demand() <= demand + 1e-10);
        assert!(found.train.duration() < before, "{demand}");
        before = found.train.duration();
        // The same question has the same answer.
        assert_eq!(shortest_train::<32>(&requirements, demand).expect("a train"), found);
    }
    // By unity magnitude it is a little shorter than the train of plus and minus one.
    let unity: ImpulseTrain<3> = Shaper::UNITY_MAGNITUDE_ZV.train(slow).expect("shaper");
    assert!(shortest(&[zero(slow, 1)], 3.0).duration() <= unity.duration());
}

#[test]
fn bad_requirements_are_named_with_their_number() {
    let plan = |requirements: &[Requirement], demand| shortest_train::<4>(requirements, demand);
    let one = zero(mode(10.0, 0.1), 1);
    assert_eq!(plan(&[], 1.0), Err(ShortestTrainError::NoRequirement));
    assert_eq!(plan(&[one; 9], 1.0), Err(ShortestTrainError::Requirements { requirements: 9, most: 8 }));
    assert_eq!(plan(&[zero(mode(10.0, 0.1), 0)], 1.0), Err(ShortestTrainError::Order { order: 0, most: 3 }));
    assert_eq!(plan(&[zero(mode(10.0, 0.1), 4)], 1.0), Err(ShortestTrainError::Order { order: 4, most: 3 }));
    assert_eq!(plan(&[one], 0.9), Err(ShortestTrainError::Demand(0.9)));
    assert!(matches!(plan(&[one], f64::NAN), Err(ShortestTrainError::Demand(d)) if d.is_nan()));
    let within = |tolerance| Requirement::Within { range: range(9.0, 11.0, 0.0, 0.1), tolerance };
    assert_eq!(plan(&[within(1.0)], 1.0), Err(ShortestTrainError::Tolerance(1.0)));
    assert_eq!(plan(&[within(0.0)], 1.0), Err(ShortestTrainError::Tolerance(0.0)));
    assert_eq!(
        plan(&[one, zero(mode(2000.0, 0.1), 1)], 1.0),
        Err(ShortestTrainError::Spread { ratio: 200.0, most: 100.0 })
    );
    let four = [1.0, 1.7, 2.3, 3.7].map(|w| zero(mode(w, 0.02), 1));
    assert_eq!(
        plan(&four, 1.0),
        Err(ShortestTrainError::Train(TrainError::Capacity { needed: 5, capacity: 4 }))
    );
}

#[cfg(feature = "serde")]
#[test]
fn requirements_can_be_written_down() {
    let within = Requirement::Within { range: range(9.0, 11.0, 0.0, 0.25), tolerance: 0.05 };
    for requirement in [zero(mode(10.0, 0.125), 2), within] {
        let text = serde_json::to_string(&requirement).expect("writes");
        assert_eq!(serde_json::from_str::<Requirement>(&text).expect(&text), requirement);
    }
    let typo = r#"{"zero": {"mode": {"angular_frequency": 10, "damping_ratio": 0}, "ordre": 1}}"#;
    assert!(serde_json::from_str::<Requirement>(typo).is_err());
}
