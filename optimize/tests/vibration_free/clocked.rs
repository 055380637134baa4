//! Motions on a clock: whole ticks, and all that is asked of the others.

use optimize::vibration_free::{ClockedMove, Robustness, VibrationFreeError};
use profiles::{Mode, Profile, residual_vibration};
use proptest::prelude::*;

use super::bands::most_left;
use super::tasks::{Task, a_task, config, sections, zeros};

/// Switches on ticks, limits, and the end.
fn on_ticks(clocked: &ClockedMove, task: &Task) -> Result<(), TestCaseError> {
    prop_assert!(
        (clocked.duration() - clocked.ticks() as f64 * clocked.period()).abs() <= 1e-12 * clocked.duration()
    );
    for section in sections(clocked).iter().filter(|section| section.length() > 0.0) {
        // Roundings of an instant.
        let ticks = section.end / clocked.period();
        prop_assert!((ticks - ticks.round()).abs() <= 1e-9 * ticks.max(1.0), "{ticks}");
    }
    let peaks = clocked.extrema();
    let limits = [task.limits.velocity(), task.limits.acceleration(), task.limits.jerk()];
    for (range, bounds) in [peaks.velocity, peaks.acceleration, peaks.jerk].into_iter().zip(limits) {
        prop_assert!(
            range.upper <= bounds.upper * (1.0 + 1e-12) && range.lower >= bounds.lower * (1.0 + 1e-12)
        );
    }
    prop_assert_eq!(clocked.sample(clocked.duration()).position.to_bits(), task.distance.to_bits());
    Ok(())
}

proptest! {
    #![proptest_config(config(48))]

    #[test]
    fn zeros_are_kept_on_ticks(task in a_task(2, true), robustness in zeros(), ticks in 80.0_f64..2000.0) {
        let planned = task.plan(robustness);
        let period = planned.duration() / ticks;
        let clocked = planned.on_clock(period).map_err(|error| TestCaseError::fail(error.to_string()))?;
        on_ticks(&clocked, &task)?;
        prop_assert!(clocked.duration() >= planned.duration() * (1.0 - 1e-9) || !planned.is_proven());
        for mode in &task.modes {
            let left = residual_vibration(&clocked, *mode) / task.distance.abs();
            prop_assert!(left <= 1e-12, "{left:e}");
        }
    }
}

#[test]
fn typical_moves_take_a_tick_more_at_most() {
    for (distance, hz, z) in [(0.1, 8.0, 0.02), (0.1, 20.0, 0.02), (0.02, 12.0, 0.05)] {
        let task = Task::new(distance, [0.5, 5.0, 200.0], &[(hz, z)]);
        for robustness in [Robustness::None, Robustness::DoubleZero] {
            let planned = task.plan(robustness);
            let clocked = planned.on_clock(1e-3).expect("a motion on ticks");
            on_ticks(&clocked, &task).expect("on ticks");
            assert!(
                clocked.duration() < planned.duration() + 2e-3,
                "{} {}",
                clocked.duration(),
                planned.duration()
            );
        }
    }
}

#[test]
fn bands_are_kept_on_ticks_too() {
    let mode = Mode::from_hz(8.0, 0.02).expect("mode");
    for (distance, half_width, residual) in [(0.4, 0.3, 0.005), (0.1, 0.1, 1e-3), (0.1, 0.2, 0.02)] {
        let task = Task::new(distance, [0.5, 5.0, 200.0], &[(8.0, 0.02)]);
        let planned = task.plan(Robustness::Band { half_width, residual });
        let mut found = 0;
        for period in [4e-3, 1e-3, 2.5e-4] {
            if let Ok(clocked) = planned.on_clock(period) {
                found += 1;
                on_ticks(&clocked, &task).expect("on ticks");
                let most = most_left(&clocked, &mode, half_width) / distance;
                assert!(most <= residual * (1.0 + 1e-9), "{most} of {residual} at {period}");
            }
        }
        assert!(found > 0, "{distance} {half_width}");
    }
}

#[test]
fn periods_that_cannot_be_are_named() {
    let planned = Task::new(0.1, [0.5, 5.0, 200.0], &[(8.0, 0.02)]).plan(Robustness::None);
    for period in [0.0, -1e-3, f64::NAN, f64::INFINITY, 1e-12] {
        let error = planned.on_clock(period).err();
        assert!(
            matches!(error, Some(VibrationFreeError::Period(x)) if x.to_bits() == period.to_bits()),
            "{period} {error:?}"
        );
    }
}
