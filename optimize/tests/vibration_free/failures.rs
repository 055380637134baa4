//! What is refused, what is almost refused, and how long that takes.

use std::time::{Duration, Instant};

use optimize::vibration_free::{Robustness, VibrationFreeError, VibrationFreeMove, plan};
use profiles::{Interval, Limits, Mode, PlanError, Profile};

use super::tasks::{Task, at_rest, sound};

/// A hang: on a busy machine the slowest of these takes several seconds.
const SLOW: Duration = Duration::from_secs(60);

const LIMITS: [f64; 3] = [0.5, 5.0, 200.0];

fn timed(what: &str, task: &Task, robustness: Robustness) -> Result<VibrationFreeMove, VibrationFreeError> {
    let start = Instant::now();
    let planned = plan(task.distance, &task.limits, &task.modes, robustness);
    let took = start.elapsed();
    println!(
        "{what}: {took:?} {:?}",
        planned.as_ref().map(|planned| (planned.duration(), planned.is_proven(), planned.switches()))
    );
    assert!(took < SLOW, "{what}: {took:?}");
    planned
}

/// The move, if it is planned at all: which it must be right.
fn right(what: &str, task: &Task, robustness: Robustness) -> Option<VibrationFreeMove> {
    let planned = timed(what, task, robustness).ok()?;
    sound(&planned, &task.limits, 0.0, 0.0, Some(task.distance)).expect(what);
    if !matches!(robustness, Robustness::Band { .. }) {
        at_rest(&planned, &task.modes, |_| task.distance.abs()).expect(what);
        assert!(planned.duration() >= task.s_curve() * (1.0 - 1e-12), "{what}");
        assert!(planned.duration() <= task.shaped(robustness) * (1.0 + 1e-12), "{what}");
    }
    Some(planned)
}

fn one(hz: f64, z: f64) -> Task {
    Task::new(0.1, LIMITS, &[(hz, z)])
}

#[test]
fn bad_requests_are_named_with_their_number() {
    let task = one(8.0, 0.02);
    for distance in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = timed("distance", &Task { distance, ..task.clone() }, Robustness::None);
        assert!(matches!(error, Err(VibrationFreeError::Plan(PlanError::Distance(_)))), "{error:?}");
    }
    let five = Task { modes: vec![task.modes[0]; 5], ..task.clone() };
    let error = timed("five modes", &five, Robustness::None).err();
    assert_eq!(error, Some(VibrationFreeError::Modes { modes: 5, most: 4 }));
    for half_width in [0.0, 1.0, -0.1, 2.0, f64::NAN, f64::INFINITY] {
        let error = timed("half width", &task, Robustness::Band { half_width, residual: 0.02 }).err();
        assert!(
            matches!(error, Some(VibrationFreeError::HalfWidth(x)) if x.to_bits() == half_width.to_bits()),
            "{error:?}"
        );
    }
    // Also where there is no mode to make a band of.
    let none = Task { modes: vec![], ..task.clone() };
    let error = timed("half width", &none, Robustness::Band { half_width: 2.0, residual: 0.02 }).err();
    assert_eq!(error, Some(VibrationFreeError::HalfWidth(2.0)));
    for residual in [0.0, -0.1, 1e-10, 1.0, f64::NAN, f64::INFINITY] {
        let error = timed("residual", &task, Robustness::Band { half_width: 0.1, residual }).err();
        assert!(
            matches!(error, Some(VibrationFreeError::Residual(x)) if x.to_bits() == residual.to_bits()),
            "{error:?}"
        );
    }
    let [up, down] = [Interval::new(-200.0, f64::INFINITY), Interval::new(f64::NEG_INFINITY, 200.0)];
    for jerk in [up, down, Interval::UNBOUNDED] {
        let limits = task.limits.with_jerk(jerk).expect("limits");
        let error = timed("unlimited jerk", &Task { limits, ..task.clone() }, Robustness::None).err();
        assert_eq!(error, Some(PlanError::Unlimited("jerk").into()));
    }
}

#[test]
fn no_distance_takes_no_time() {
    for distance in [0.0, -0.0] {
        for robustness in [Robustness::None, Robustness::DoubleZero] {
            let task = Task { distance, ..one(8.0, 0.02) };
            let nothing = timed("no distance", &task, robustness).expect("nothing to do");
            assert_eq!((nothing.duration(), nothing.price(), nothing.switches()), (0.0, 0.0, 0));
            let rest = nothing.sample(0.1);
            assert_eq!((rest.position, rest.velocity), (0.0, 0.0));
        }
    }
    let band = Robustness::Band { half_width: 0.1, residual: 0.02 };
    let nothing = timed("no distance", &Task { distance: 0.0, ..one(8.0, 0.02) }, band);
    assert_eq!(nothing.expect("nothing to do").duration(), 0.0);
}

#[test]
fn no_modes_are_the_s_curve() {
    let task = Task { modes: vec![], ..one(8.0, 0.0) };
    for robustness in [Robustness::None, Robustness::DoubleZero] {
        let planned = right("no modes", &task, robustness).expect("plan");
        assert!(planned.price().abs() < 1e-15 && planned.switches() == 8);
    }
}

#[test]
fn unlimited_velocity_and_acceleration_work() {
    for (v, a) in [(f64::INFINITY, 5.0), (0.5, f64::INFINITY), (f64::INFINITY, f64::INFINITY)] {
        for robustness in [Robustness::None, Robustness::DoubleZero] {
            let task = Task::new(0.1, [v, a, 200.0], &[(8.0, 0.02)]);
            right("unlimited", &task, robustness).expect("plan");
        }
    }
    // To one side only.
    let limits = Limits::new(0.5, 5.0, 200.0)
        .and_then(|limits| limits.with_velocity(Interval::new(f64::NEG_INFINITY, 0.5)))
        .and_then(|limits| limits.with_acceleration(Interval::new(-5.0, f64::INFINITY)))
        .expect("limits");
    right("unlimited one way", &Task { limits, ..one(8.0, 0.02) }, Robustness::None).expect("plan");
}

#[test]
fn the_same_mode_twice_is_a_double_zero() {
    let single = one(8.0, 0.02);
    let known = single.plan(Robustness::DoubleZero).duration();
    for robustness in [Robustness::None, Robustness::DoubleZero] {
        let twice = Task { modes: vec![single.modes[0]; 2], ..single.clone() };
        let planned = right("twice", &twice, robustness).expect("plan");
        assert!((planned.duration() - known).abs() <= 1e-9 * known, "{} {known}", planned.duration());
    }
}

#[test]
fn modes_that_are_nearly_equal_are_a_double_zero() {
    let known = one(8.0, 0.02).plan(Robustness::DoubleZero).duration();
    for apart in [1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-15] {
        let task = Task::new(0.1, LIMITS, &[(8.0, 0.02), (8.0 * (1.0 + apart), 0.02)]);
        let planned = right(&format!("{apart:e} apart"), &task, Robustness::None);
        if let Some(planned) = planned.filter(|_| apart <= 1e-3) {
            // The second zero is worth less than the first one of it.
            let off = planned.duration() / known - 1.0;
            assert!(off.abs() <= 2.0 * apart + 1e-8, "{apart:e}: {off:e}");
        }
    }
}

#[test]
fn very_fast_and_very_slow_modes_are_right_or_refused() {
    let s_curve = one(8.0, 0.0).s_curve();
    for z in [0.0, 0.05] {
        for periods in [0.01, 0.1, 20.0, 100.0, 500.0] {
            right(&format!("{periods} periods, {z}"), &one(periods / s_curve, z), Robustness::None);
        }
        for periods in [0.1, 20.0] {
            let what = format!("{periods} periods, {z}, twice");
            right(&what, &one(periods / s_curve, z), Robustness::DoubleZero);
        }
    }
}

#[test]
fn a_long_cruise_is_planned() {
    for distance in [1.0, 10.0, 100.0, 1e4] {
        let task = Task { distance, ..one(8.0, 0.02) };
        let planned = right(&format!("{distance} m"), &task, Robustness::None).expect("plan");
        // Half a period and more would be what two ramps cost that know nothing of each other.
        assert!(planned.price() < 0.5 * task.modes[0].damped_period(), "{distance}: {}", planned.price());
    }
}

#[test]
fn modes_that_the_s_curve_nearly_leaves_at_rest_are_planned() {
    // 40 Hz without damping is left at rest by each of the three averages of the S-curve.
    for z in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-9] {
        for hz in [39.9, 40.0, 40.001] {
            right(&format!("{hz} Hz, {z}"), &one(hz, z), Robustness::None).expect("plan");
        }
    }
}

#[test]
fn extreme_numbers_are_right_or_refused() {
    for distance in [1e-300, 1e-150, 1e-30, 1e-12, 1e-6, 1e3, 1e6, 1e12, 1e30, 1e150, 1e300] {
        for sign in [1.0, -1.0] {
            let task = Task { distance: sign * distance, ..one(8.0, 0.02) };
            right(&format!("{distance:e} m"), &task, Robustness::None);
        }
    }
    for [v, a, j] in [[1e-9, 5.0, 200.0], [0.5, 1e-9, 200.0], [0.5, 5.0, 1e-9], [1e9, 5.0, 1e9], [1e9; 3]] {
        right(&format!("{v} {a} {j}"), &Task::new(0.1, [v, a, j], &[(8.0, 0.02)]), Robustness::None);
    }
    let lopsided = Limits::new(0.5, 5.0, 200.0)
        .and_then(|limits| limits.with_acceleration(Interval::new(-0.05, 5.0)))
        .and_then(|limits| limits.with_jerk(Interval::new(-2.0, 200.0)))
        .expect("limits");
    right("lopsided", &Task { limits: lopsided, ..one(8.0, 0.02) }, Robustness::None);
    for mode in [Mode::new(1e300, 0.0), Mode::new(1e-300, 0.0), Mode::new(50.0, 1.0 - 1e-16)] {
        let task = Task { modes: vec![mode.expect("mode")], ..one(8.0, 0.0) };
        right(&format!("{mode:?}"), &task, Robustness::None);
    }
}

#[test]
fn wide_bands_are_right_or_refused() {
    for half_width in [1e-12, 1e-6, 0.5, 0.9, 0.999_999] {
        for residual in [1e-9, 1e-4, 0.1, 0.999] {
            let band = Robustness::Band { half_width, residual };
            right(&format!("{half_width} {residual}"), &one(8.0, 0.02), band);
        }
    }
}
