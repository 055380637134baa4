//! From one move to another.

use optimize::vibration_free::{Robustness, VibrationFreeError};
use profiles::{PlanError, Profile, residual_vibration};
use proptest::prelude::*;

use super::bands::most_left;
use super::tasks::{Task, a_task, at_rest, config, magnitude, sound, zeros};

/// Factors of the distance, most of them near one.
fn factor() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => 0.95..1.05_f64,
        2 => 0.5..2.0_f64,
        1 => magnitude(0.01, 100.0),
        1 => magnitude(0.5, 2.0).prop_map(|factor| -factor),
    ]
}

fn same(one: &Task, factor: f64, robustness: Robustness) -> Result<(), TestCaseError> {
    let other = Task { distance: one.distance * factor, ..one.clone() };
    let warm = one.planned(robustness)?.replanned(other.distance);
    let warm = warm.map_err(|error| TestCaseError::fail(error.to_string()))?;
    sound(&warm, &other.limits, 0.0, 0.0, Some(other.distance))?;
    at_rest(&warm, &other.modes, |_| other.distance.abs())?;
    let cold = other.planned(robustness)?;
    let (warm_t, cold_t) = (warm.duration(), cold.duration());
    if warm.is_proven() && cold.is_proven() {
        prop_assert!((warm_t - cold_t).abs() <= 1e-9 * cold_t, "{warm_t} {cold_t}");
    } else {
        prop_assert!(warm_t <= cold_t * (1.0 + 1e-9), "{warm_t} {cold_t}, not proven");
    }
    prop_assert!((warm.price() - (warm_t - other.s_curve())).abs() <= 1e-12 * warm_t);
    Ok(())
}

proptest! {
    #![proptest_config(config(48))]

    #[test]
    fn it_is_as_planned_anew(task in a_task(1, true), factor in factor(), robustness in zeros()) {
        same(&task, factor, robustness)?;
    }
}

#[test]
fn a_walk_of_distances_stays_at_the_optimum() {
    let task = Task::new(0.1, [0.5, 5.0, 200.0], &[(8.0, 0.02)]);
    for robustness in [Robustness::None, Robustness::DoubleZero] {
        let mut planned = task.plan(robustness);
        // From where velocity and acceleration are limited to where neither is, and back.
        let down = (0..40).map(|k| 0.1 * 0.85_f64.powi(k));
        for distance in down.clone().chain(down.rev()) {
            planned = planned.replanned(distance).expect("plan");
            let anew = Task { distance, ..task.clone() }.plan(robustness);
            assert!(
                (planned.duration() - anew.duration()).abs() <= 1e-9 * anew.duration(),
                "{distance}: {} {}",
                planned.duration(),
                anew.duration()
            );
            assert!(residual_vibration(&planned, task.modes[0]) <= 1e-12 * distance);
        }
    }
}

#[test]
fn a_walk_of_distances_keeps_its_band() {
    let task = Task::new(0.1, [0.5, 5.0, 200.0], &[(8.0, 0.02)]);
    let band = Robustness::Band { half_width: 0.1, residual: 0.02 };
    let mut planned = task.plan(band);
    for distance in [0.09, 0.08, 0.07, 0.075, 0.085, 0.1, 0.12] {
        planned = planned.replanned(distance).expect("plan");
        let most = most_left(&planned, &task.modes[0], 0.1) / distance;
        assert!(most <= 0.02 * (1.0 + 1e-9), "{distance}: {most}");
        let anew = Task { distance, ..task.clone() }.plan(band).duration();
        assert!(
            (planned.duration() - anew).abs() <= 1e-9 * anew,
            "{distance}: {} {anew}",
            planned.duration()
        );
    }
}

#[test]
fn bands_and_free_moves_are_planned_anew() {
    let task = Task::new(0.1, [0.5, 5.0, 200.0], &[(8.0, 0.02)]);
    let band = Robustness::Band { half_width: 0.1, residual: 0.02 };
    let planned = task.plan(band);
    for distance in [0.099, 0.12, 0.05, -0.1] {
        let warm = planned.replanned(distance).expect("plan");
        let cold = Task { distance, ..task.clone() }.plan(band);
        assert!((warm.duration() - cold.duration()).abs() <= 1e-9 * cold.duration(), "{distance}");
    }
    // 40 Hz without damping is free at any distance that reaches full acceleration.
    let free = Task::new(0.1, [0.5, 5.0, 200.0], &[(40.0, 0.0)]);
    let planned = free.plan(Robustness::None);
    assert!(planned.price().abs() < 1e-15);
    for distance in [0.101, 0.2, 0.05, -0.1, 1e-4] {
        let warm = planned.replanned(distance).expect("plan");
        let cold = Task { distance, ..free.clone() }.plan(Robustness::None);
        assert!((warm.duration() - cold.duration()).abs() <= 1e-9 * cold.duration(), "{distance}");
        assert!(residual_vibration(&warm, free.modes[0]) <= 1e-12 * distance.abs());
    }
    let none = Task { modes: vec![], ..free }.plan(Robustness::None);
    assert!(none.replanned(0.3).expect("plan").price().abs() < 1e-14);
}

#[test]
fn bad_distances_are_as_they_are_when_planned() {
    let task = Task::new(0.1, [0.5, 5.0, 200.0], &[(8.0, 0.02)]);
    let planned = task.plan(Robustness::None);
    for distance in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = planned.replanned(distance).expect_err("no distance");
        assert!(matches!(error, VibrationFreeError::Plan(PlanError::Distance(_))), "{error:?}");
    }
    let nothing = planned.replanned(0.0).expect("nothing to do");
    assert_eq!(nothing.duration(), 0.0);
    // And on from nothing.
    let again = nothing.replanned(0.1).expect("plan");
    assert!((again.duration() - planned.duration()).abs() <= 1e-9 * planned.duration());
}
