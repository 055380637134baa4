//! Changes of velocity.

use std::f64::consts::TAU;

use optimize::vibration_free::{Robustness, VibrationFreeError, plan_ramp};
use profiles::{Limits, Mode, Profile, SCurve};
use proptest::prelude::*;

use super::tasks::{at_rest, config, limits, magnitude, sound, zeros};

/// Two velocities within limits, to and from rest and across it among them.
fn velocities() -> impl Strategy<Value = (f64, f64)> {
    let part = || prop_oneof![1 => Just(0.0), 1 => Just(1.0), 1 => Just(-1.0), 3 => -1.0..1.0_f64];
    (part(), part()).prop_filter("a change", |(from, to)| (from - to).abs() > 1e-3)
}

fn of(limits: &Limits, part: f64) -> f64 {
    let bounds = limits.velocity();
    part.abs() * if part < 0.0 { bounds.lower } else { bounds.upper }
}

proptest! {
    #![proptest_config(config(48))]

    #[test]
    fn nothing_is_left_after_a_change_of_velocity(
        (_, _, limits) in limits(true),
        (from, to) in velocities(),
        modes in prop::collection::vec((magnitude(0.3, 8.0), prop_oneof![Just(0.0), 0.0..0.3]), 1..=2),
        robustness in zeros(),
    ) {
        let (from, to) = (of(&limits, from), of(&limits, to));
        let s_curve = SCurve::velocity_ramp(from, to, &limits).expect("plan").duration();
        let mode = |&(periods, z): &(f64, f64)| Mode::new(TAU * periods / s_curve, z).expect("mode");
        let modes: Vec<Mode> = modes.iter().map(mode).collect();
        let planned = plan_ramp(from, to, &limits, &modes, robustness);
        let planned = planned.map_err(|error| TestCaseError::fail(error.to_string()))?;
        sound(&planned, &limits, from, to, None)?;
        at_rest(&planned, &modes, |mode| (to - from).abs() / mode.angular_frequency())?;
        prop_assert!(planned.duration() >= s_curve * (1.0 - 1e-12), "{} {s_curve}", planned.duration());
        let zeros = if robustness == Robustness::DoubleZero { 2.0 } else { 1.0 };
        let pairs: f64 = modes.iter().map(|mode| zeros * 0.5 * mode.damped_period()).sum();
        prop_assert!(planned.duration() <= (s_curve + pairs) * (1.0 + 1e-12),
            "{} {}", planned.duration(), s_curve + pairs);
        prop_assert!(matches!(planned.replanned(1.0), Err(VibrationFreeError::NoDistance(_))));
    }
}

#[test]
fn the_way_back_takes_as_long() {
    let limits = Limits::new(0.5, 5.0, 200.0).expect("limits");
    let modes = [Mode::from_hz(9.0, 0.0).expect("mode")];
    let duration =
        |from, to| plan_ramp(from, to, &limits, &modes, Robustness::None).expect("plan").duration();
    // Without damping the motion can run backwards; and limits are the same for both directions.
    for (from, to) in [(0.0, 0.3), (0.1, 0.5), (-0.2, 0.3), (-0.5, 0.5)] {
        let known = duration(from, to);
        assert!((duration(to, from) - known).abs() < 1e-9 * known);
        assert!((duration(-from, -to) - known).abs() < 1e-9 * known);
    }
}

#[test]
fn velocities_that_cannot_be_are_errors() {
    let limits = Limits::new(0.5, 5.0, 200.0).expect("limits");
    let modes = [Mode::from_hz(9.0, 0.02).expect("mode")];
    let ramp = |from, to| plan_ramp(from, to, &limits, &modes, Robustness::None);
    for (from, to) in [
        (0.0, 0.6),
        (-0.6, 0.0),
        (f64::NAN, 0.1),
        (0.1, f64::NAN),
        (f64::INFINITY, 0.1),
        (0.1, f64::NEG_INFINITY),
    ] {
        assert!(matches!(ramp(from, to), Err(VibrationFreeError::Plan(_))), "{from} {to}");
    }
    for velocity in [0.0, 0.2, -0.5] {
        let nothing = ramp(velocity, velocity).expect("nothing to do");
        assert_eq!(nothing.duration(), 0.0);
        let sample = nothing.sample(0.5);
        assert_eq!((sample.velocity, sample.acceleration), (velocity, 0.0));
    }
}
