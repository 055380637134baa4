//! Recommendations: what is promised holds for every mode that was reckoned with.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use optimize::vibration_free::Robustness;
use optimize::{
    MoveKind, MoveRecommendation, MoveTask, RecommendError, UncertainMode, recommend_move, recommend_shaper,
};
use profiles::{Limits, Mode, Profile, residual_vibration};
use proptest::prelude::*;

/// A mode with deviations of a part of its frequency and of a damping ratio.
fn uncertain(hz: f64, damping: f64, part: f64, damping_deviation: f64) -> UncertainMode {
    let mode = Mode::from_hz(hz, damping).expect("valid");
    UncertainMode::new(mode, part * mode.angular_frequency(), damping_deviation).expect("valid")
}

/// What the mode turns out to be: `x` and `y` from -1 to 1 are the ends of what is reckoned with.
fn truth(mode: &UncertainMode, deviations: f64, x: f64, y: f64) -> Mode {
    let w = mode.mode().angular_frequency() + x * deviations * mode.frequency_deviation();
    let z = mode.mode().damping_ratio() + y * deviations * mode.damping_deviation();
    Mode::new(w, z.max(0.0)).expect("valid")
}

fn task(distance: f64, tolerated: f64) -> MoveTask {
    let limits = Limits::new(0.5, 5.0, 200.0).expect("valid");
    MoveTask { distance, limits, tolerated, deviations: 3.0 }
}

fn of(modes: &[UncertainMode], task: &MoveTask) -> MoveRecommendation {
    recommend_move(modes, task).expect("plans")
}

proptest! {
    // Each plans three time optima for two modes, one of them for bands.
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_bound_holds_for_every_mode_reckoned_with(
        hz in 3.0..40.0_f64,
        other in 1.3..3.0_f64,
        damping in 0.0..0.2_f64,
        part in 0.0..0.03_f64,
        damping_deviation in 0.0..0.02_f64,
        distance in -0.3..0.3_f64,
        tolerance in 1e-5..1e-2_f64,
        (x, y) in (-1.0..1.0_f64, -1.0..1.0_f64),
    ) {
        prop_assume!(distance.abs() > 1e-3);
        let second = uncertain(hz * other, damping, part, damping_deviation);
        let modes =
            [uncertain(hz, damping, part, damping_deviation), second.with_participation(0.3).expect("valid")];
        let task = task(distance, tolerance * distance.abs());
        let found = of(&modes, &task);
        let truths = modes.map(|mode| truth(&mode, task.deviations, x, y));
        let best = found.best().expect("a move");
        for judged in &found.moves {
            let left: f64 = modes
                .iter()
                .zip(truths)
                .map(|(mode, truth)| mode.participation() * residual_vibration(&judged.motion, truth))
                .sum();
            // Roundings of a response of metres per second over a slow mode.
            let rounding = 1e-12 * distance.abs();
            prop_assert!(left <= judged.worst + rounding, "{:?} {left} {}", judged.kind, judged.worst);
            prop_assert!(judged.nominal <= judged.worst + rounding);
            // Whatever the order of ties, nothing is sooner than the best by a thousandth of the S-curve.
            let tie = 1e-3 * found.of_kind(MoveKind::SCurve).expect("always there").motion.duration();
            prop_assert!(judged.total() >= best.total() - tie);
            // The decay of the slowest mode at least: after the settling time it is within.
            if let Some(settling) = judged.settling {
                let later: f64 = modes
                    .iter()
                    .zip(truths)
                    .map(|(mode, truth)| {
                        let decay = (truth.pole().re * settling).exp();
                        mode.participation() * residual_vibration(&judged.motion, truth) * decay
                    })
                    .sum();
                prop_assert!(later <= task.tolerated * (1.0 + 1e-9) + rounding);
            }
            // Limits hold: a part in 1e9 for the roundings of a sum of shaped copies.
            let extrema = judged.motion.extrema();
            prop_assert!(extrema.velocity.magnitude() <= 0.5 * (1.0 + 1e-9));
            prop_assert!(extrema.acceleration.magnitude() <= 5.0 * (1.0 + 1e-9));
            prop_assert!(extrema.jerk.magnitude() <= 200.0 * (1.0 + 1e-9));
            prop_assert!((judged.motion.sample(judged.motion.duration()).position - distance).abs() <= 0.0);
        }
    }
}

proptest! {
    #[test]
    fn a_shaper_leaves_no_more_than_it_says(
        hz in 1.0..100.0_f64,
        damping in 0.0..0.3_f64,
        part in 0.0..0.06_f64,
        tolerated in 0.01..0.2_f64,
        (x, y) in (-1.0..1.0_f64, -1.0..1.0_f64),
    ) {
        let modes = [uncertain(hz, damping, part, 0.01), uncertain(2.7 * hz, damping, 0.5 * part, 0.01)];
        let found = recommend_shaper(&modes, tolerated, 3.0).expect("a shaper");
        for mode in &modes {
            let left = found.train.residual(truth(mode, 3.0, x, y));
            prop_assert!(left <= found.worst + 1e-12, "{left} {}", found.worst);
        }
        prop_assert_eq!(found.within, found.worst <= tolerated);
        for (judged, chosen) in found.judged.iter().zip(&found.chosen) {
            // None of the shorter ones would have done.
            prop_assert!(judged.iter().take(*chosen).all(|shaper| shaper.worst > tolerated));
        }
    }
}

#[test]
fn the_time_optimum_is_recommended_where_it_is_first() {
    // A mode that is known exactly, and one that is known to 3 % (three deviations).
    for (part, robust) in [(0.0, false), (0.01, true)] {
        let best = of(&[uncertain(8.0, 0.02, part, 0.0)], &task(0.1, 1e-4)).best().expect("a move").clone();
        let banded = matches!(best.kind, MoveKind::Optimum(Robustness::Band { .. }));
        assert!(matches!(best.kind, MoveKind::Optimum(_)) && banded == robust, "{:?}", best.kind);
        assert_eq!(best.settling, Some(0.0));
    }
}

#[test]
fn the_surer_the_mode_the_sooner_it_is_at_rest() {
    let mut before = 0.0;
    for part in [0.0, 0.002, 0.01, 0.03, 0.08] {
        let best = of(&[uncertain(8.0, 0.02, part, 0.0)], &task(0.1, 1e-4)).best().expect("a move").total();
        // Ties are a thousandth of the S-curve's 325 ms.
        assert!(best >= before - 4e-4, "{part}: {best} after {before}");
        before = best;
    }
}

#[test]
fn a_mode_that_hardly_swings_or_none_at_all_leaves_the_s_curve() {
    for modes in [vec![], vec![uncertain(8.0, 0.02, 0.01, 0.0).with_participation(1e-6).expect("valid")]] {
        let found = of(&modes, &task(0.1, 1e-4));
        let best = found.best().expect("a move");
        assert_eq!((best.kind, best.settling), (MoveKind::SCurve, Some(0.0)));
    }
}

#[test]
fn a_mode_without_damping_that_no_move_can_quieten_never_settles() {
    // Known to 12 % only, and tolerated is a part in a million.
    let found = of(&[uncertain(8.0, 0.0, 0.04, 0.0)], &task(0.1, 1e-7));
    let best = found.best().expect("a move");
    assert!(best.settling.is_none() && best.total().is_infinite() && best.worst.is_finite());
}

#[test]
fn bad_requests_are_named() {
    let mode = uncertain(8.0, 0.02, 0.01, 0.0);
    let number = |result: Result<MoveRecommendation, RecommendError>, what: &str| {
        assert!(
            matches!(&result, Err(RecommendError::Number { quantity, .. }) if quantity.contains(what)),
            "{result:?}"
        );
    };
    number(recommend_move(&[mode], &task(0.1, 0.0)), "tolerated");
    number(recommend_move(&[mode], &task(0.1, f64::NAN)), "tolerated");
    number(recommend_move(&[mode], &task(0.0, 1e-4)), "length");
    number(recommend_move(&[mode], &MoveTask { deviations: -1.0, ..task(0.1, 1e-4) }), "deviations");
    let vague = uncertain(8.0, 0.02, 0.3, 0.0);
    assert!(matches!(recommend_move(&[vague], &task(0.1, 1e-4)), Err(RecommendError::Vague { .. })));
    let unlimited = MoveTask { limits: Limits::UNLIMITED, ..task(0.1, 1e-4) };
    assert!(matches!(recommend_move(&[mode], &unlimited), Err(RecommendError::Plan(_))));
    assert!(matches!(recommend_shaper(&[], 0.05, 3.0), Err(RecommendError::NoModes)));
    assert!(matches!(recommend_shaper(&[mode], 0.0, 3.0), Err(RecommendError::Number { .. })));
}
