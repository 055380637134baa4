//! Random moves: all that is asked, and never longer than what they replace.

use std::f64::consts::TAU;

use optimize::vibration_free::{Robustness, VibrationFreeMove};
use profiles::{Chain, Interval, Mode, Profile, SCurve, residual_vibration};
use proptest::prelude::*;

use super::tasks::{Task, a_request, a_task, at_rest, config, sections, sound, zeros};

/// All that is asked of a planned move.
fn all_that_is_asked(task: &Task, robustness: Robustness) -> Result<VibrationFreeMove, TestCaseError> {
    let planned = task.planned(robustness)?;
    sound(&planned, &task.limits, 0.0, 0.0, Some(task.distance))?;
    at_rest(&planned, &task.modes, |_| task.distance.abs())?;
    let (duration, s_curve, shaped) = (planned.duration(), task.s_curve(), task.shaped(robustness));
    // But for rounding: the shortest of all moves is the S-curve, and one with zeros the shaped one.
    prop_assert!(duration >= s_curve * (1.0 - 1e-12), "{duration} below the S-curve's {s_curve}");
    prop_assert!(duration <= shaped * (1.0 + 1e-12), "{duration} beyond the shaped {shaped}");
    prop_assert!((planned.price() - (duration - s_curve)).abs() <= 1e-13 * s_curve);
    Ok(planned)
}

/// A frequency a little off leaves only the square of that.
fn zero_is_double(planned: &VibrationFreeMove, task: &Task) -> Result<(), TestCaseError> {
    for mode in &task.modes {
        let off = |part: f64| {
            let other = Mode::new(mode.angular_frequency() * (1.0 + part), mode.damping_ratio());
            residual_vibration(planned, other.expect("mode")) / task.distance.abs()
        };
        // Of a simple zero ten times the way leaves ten times as much, of a double one a hundred times.
        let (near, far) = (off(1e-5), off(1e-4));
        prop_assert!(near <= 0.02 * far + 1e-12, "{near:e} {far:e} near {mode:?}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn nothing_is_left_limits_hold_and_ends_are_exact((task, robustness) in a_request()) {
        let planned = all_that_is_asked(&task, robustness)?;
        if robustness == Robustness::DoubleZero {
            zero_is_double(&planned, &task)?;
        }
    }
}

proptest! {
    #![proptest_config(config(32))]

    #[test]
    fn never_longer_than_a_chain(task in a_task(3, false)) {
        let planned = all_that_is_asked(&task, Robustness::None)?;
        let chain = Chain::<95>::rest_to_rest(task.distance, &task.limits, &task.modes).expect("plan");
        prop_assert!(planned.duration() <= chain.duration() * (1.0 + 1e-12),
            "{} {}", planned.duration(), chain.duration());
    }

    #[test]
    fn two_zeros_of_a_mode_take_no_less_than_one(task in a_task(1, true)) {
        let one = task.planned(Robustness::None)?;
        let two = task.planned(Robustness::DoubleZero)?;
        prop_assert!(two.duration() >= one.duration() * (1.0 - 1e-9), "{} {}", two.duration(), one.duration());
    }

    #[test]
    fn a_mode_more_never_makes_it_shorter(task in a_task(2, true)) {
        let all = task.planned(Robustness::None)?;
        let fewer = Task { modes: task.modes[1..].to_vec(), ..task.clone() }.planned(Robustness::None)?;
        prop_assert!(all.duration() >= fewer.duration() * (1.0 - 1e-9), "{} {}", all.duration(), fewer.duration());
    }

    #[test]
    fn an_s_curve_that_is_free_by_itself_stays(task in a_task(1, false), waves in 1_u32..5) {
        // An average over a whole number of undamped periods, that of the jerk.
        let s_curve = SCurve::rest_to_rest(task.distance, &task.limits).expect("plan");
        let ramp = sections(&s_curve)[0].length();
        let free = Mode::new(TAU * f64::from(waves) / ramp, 0.0).expect("mode");
        let planned = all_that_is_asked(&Task { modes: vec![free], ..task }, Robustness::None)?;
        prop_assert!(planned.price().abs() <= 1e-13 * s_curve.duration(), "{}", planned.price());
        prop_assert!(planned.switches() <= 8);
        prop_assert!(planned.is_proven());
    }

    #[test]
    fn units_do_not_matter(
        task in a_task(1, true),
        robustness in zeros(),
        length in -30_i32..30,
        time in -20_i32..20,
    ) {
        let (length, time) = (2.0_f64.powi(length), 2.0_f64.powi(time));
        let one = task.planned(robustness)?.duration();
        let scaled = task.scaled(length, time);
        let other = all_that_is_asked(&scaled, robustness)?.duration();
        prop_assert!((one * time - other).abs() <= 1e-9 * other, "{} {}", one * time, other);
    }

    #[test]
    fn directions_do_not_matter(task in a_task(1, true), robustness in zeros()) {
        let one = task.planned(robustness)?.duration();
        let back = Task { distance: -task.distance, limits: task.limits.mirrored(), ..task };
        let other = all_that_is_asked(&back, robustness)?.duration();
        prop_assert!((one - other).abs() <= 1e-9 * one, "{one} {other}");
    }

    #[test]
    fn wider_limits_take_no_longer(task in a_task(1, true), factor in 1.0_f64..2.0, which in 0..3) {
        let wider = |bounds: Interval| Interval::new(bounds.lower * factor, bounds.upper * factor);
        let limits = match which {
            0 => task.limits.with_velocity(wider(task.limits.velocity())),
            1 => task.limits.with_acceleration(wider(task.limits.acceleration())),
            _ => task.limits.with_jerk(wider(task.limits.jerk())),
        };
        let wide = Task { limits: limits.expect("limits"), ..task.clone() }.planned(Robustness::None)?;
        let narrow = task.planned(Robustness::None)?;
        prop_assert!(wide.duration() <= narrow.duration() * (1.0 + 1e-9),
            "{} {}", wide.duration(), narrow.duration());
    }
}
