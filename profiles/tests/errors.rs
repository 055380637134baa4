//! Bad requests are answered with the number that is wrong.
#![expect(clippy::expect_used, reason = "helpers of tests may fail loudly")]
#![expect(clippy::float_cmp, reason = "numbers that must be equal to the bit")]

use profiles::{
    Cosine, FivePhase, Interval, Limits, PlanError, Profile, SCurve, Sample, SnapLimited, Trapezoid,
};

fn limits() -> Limits {
    Limits::new(0.2, 4.0, 200.0).and_then(|l| l.with_snap(12_500.0)).expect("limits")
}

#[test]
fn a_distance_must_be_finite() {
    for distance in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let same = |e: PlanError| matches!(e, PlanError::Distance(d) if d.to_bits() == distance.to_bits());
        assert!(same(Trapezoid::rest_to_rest(distance, &limits()).expect_err("no distance")));
        assert!(same(SCurve::rest_to_rest(distance, &limits()).expect_err("no distance")));
        assert!(same(SnapLimited::rest_to_rest(distance, &limits()).expect_err("no distance")));
        assert!(same(Cosine::rest_to_rest(distance, &limits()).expect_err("no distance")));
        assert!(same(FivePhase::rest_to_rest(distance, &limits()).expect_err("no distance")));
    }
}

#[test]
fn the_limits_a_law_lives_by_must_be_finite() {
    let none = Limits::UNLIMITED;
    assert_eq!(Trapezoid::rest_to_rest(1.0, &none), Err(PlanError::Unlimited("acceleration")));
    assert_eq!(SCurve::rest_to_rest(1.0, &none), Err(PlanError::Unlimited("jerk")));
    assert_eq!(FivePhase::rest_to_rest(1.0, &none), Err(PlanError::Unlimited("jerk")));
    assert_eq!(SnapLimited::rest_to_rest(1.0, &none), Err(PlanError::Unlimited("snap")));
    assert!(matches!(Cosine::rest_to_rest(1.0, &none), Err(PlanError::Unlimited(_))));
}

#[test]
fn laws_that_need_symmetric_limits_say_so() {
    let lopsided = limits().with_deceleration(3.0).expect("limits");
    let expected = PlanError::Asymmetric { quantity: "acceleration", lower: -3.0, upper: 4.0 };
    assert_eq!(SnapLimited::rest_to_rest(0.1, &lopsided), Err(expected));
    assert_eq!(Cosine::rest_to_rest(0.1, &lopsided), Err(expected));
    assert_eq!(FivePhase::rest_to_rest(0.1, &lopsided), Err(expected));
    let jerk = limits().with_jerk(Interval::new(-100.0, 200.0)).expect("limits");
    assert!(matches!(
        SnapLimited::velocity_ramp(0.0, 0.1, &jerk),
        Err(PlanError::Asymmetric { quantity: "jerk", .. })
    ));
}

#[test]
fn the_five_phases_name_what_they_cannot_have() {
    let nan = f64::NAN;
    assert!(matches!(FivePhase::new(nan, 1.0, 1.0, 1.0), Err(PlanError::Speed { which: "start", .. })));
    assert_eq!(FivePhase::new(0.0, f64::INFINITY, 1.0, 1.0), Err(PlanError::Jerk(f64::INFINITY)));
    assert!(matches!(FivePhase::new(0.0, nan, 1.0, 1.0), Err(PlanError::Jerk(_))));
    for time in [0.0, -2.0, nan, f64::INFINITY] {
        let same =
            |e: PlanError| matches!(e, PlanError::Phase { value, .. } if value.to_bits() == time.to_bits());
        assert!(same(FivePhase::new(0.0, 1.0, time, 1.0).expect_err("no phase")));
        assert!(same(FivePhase::ramp_with_jerk(0.0, 1.0, time).expect_err("no phase")));
        assert!(same(FivePhase::ramp_between(0.0, 1.0, time).expect_err("no phase")));
        assert!(same(FivePhase::over_distance(9.0, 0.0, 1.0, time).expect_err("no phase")));
        assert!(same(FivePhase::with_duration(0.0, 1.0, time, 9.0).expect_err("no phase")));
    }
    for time in [-1.0, nan, f64::INFINITY] {
        assert!(matches!(
            FivePhase::with_peak_velocity(0.0, 1.0, 1.0, time),
            Err(PlanError::Phase { phase: "cruise", value, .. }) if value.to_bits() == time.to_bits()
        ));
    }
    let short = FivePhase::with_duration(0.0, 1.0, 2.0, 7.0);
    assert_eq!(short, Err(PlanError::Duration { requested: 7.0, shortest: 8.0 }));
    assert!(matches!(FivePhase::over_distance(nan, 0.0, 1.0, 1.0), Err(PlanError::Distance(_))));
    let backwards = FivePhase::over_distance(9.0, 0.5, 0.25, 1.0);
    assert_eq!(backwards, Err(PlanError::Speed { which: "peak", value: 0.25 }));
    let negative = FivePhase::over_distance(9.0, -0.5, 0.25, 1.0);
    assert_eq!(negative, Err(PlanError::Speed { which: "start", value: -0.5 }));
    let near = FivePhase::over_distance(-2.0, 0.5, 1.0, 1.0);
    assert_eq!(near, Err(PlanError::TooShort { distance: -2.0, needed: 3.0 }));
    assert!(matches!(
        FivePhase::new(0.0, 1e160, 1e70, 0.0),
        Err(PlanError::Range { quantity: "distance", .. })
    ));
    assert!(matches!(FivePhase::new(0.0, 1e308, 1e70, 0.0), Err(PlanError::Range { .. })));
    assert!(matches!(
        FivePhase::new(0.0, 1.0, 1e-80, 0.0),
        Err(PlanError::Range { quantity: "phase time", .. })
    ));
}

#[test]
fn speeds_must_lie_within_their_limits() {
    assert!(matches!(
        SCurve::velocity_ramp(0.0, 0.3, &limits()),
        Err(PlanError::SpeedLimit { which: "stop", value, .. }) if value == 0.3
    ));
    assert!(matches!(
        Cosine::velocity_ramp(f64::NAN, 0.1, &limits()),
        Err(PlanError::Speed { which: "start", .. })
    ));
    assert!(matches!(
        Trapezoid::with_speeds(1.0, -0.1, 0.0, &limits()),
        Err(PlanError::Speed { which: "start", value }) if value == -0.1
    ));
    assert!(matches!(
        Trapezoid::with_speeds(1.0, 0.0, 0.5, &limits()),
        Err(PlanError::SpeedLimit { which: "stop", .. })
    ));
}

#[test]
fn a_distance_too_short_for_its_speeds_says_what_is_needed() {
    assert!(matches!(Trapezoid::with_speeds(0.0, 0.1, 0.0, &limits()), Err(PlanError::TooShort { .. })));
    assert!(matches!(Trapezoid::with_speeds(0.0, 0.1, 0.1, &limits()), Err(PlanError::TooShort { .. })));
    // 0.2 m/s to rest at 4 m/s^2 takes 5 mm.
    match Trapezoid::with_speeds(0.004, 0.2, 0.0, &limits()) {
        Err(PlanError::TooShort { distance, needed }) => {
            assert_eq!(distance, 0.004);
            assert!((needed - 0.005).abs() < 1e-18);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn no_distance_is_no_motion() {
    for profile in [
        &Trapezoid::rest_to_rest(0.0, &limits()).expect("plan") as &dyn Profile,
        &SCurve::rest_to_rest(-0.0, &limits()).expect("plan"),
        &SnapLimited::rest_to_rest(0.0, &limits()).expect("plan"),
        &Cosine::rest_to_rest(0.0, &limits()).expect("plan"),
        &FivePhase::rest_to_rest(0.0, &limits()).expect("plan"),
    ] {
        assert_eq!(profile.duration(), 0.0);
        assert_eq!(profile.sample(0.0), Sample::default());
        assert_eq!(profile.extrema(), Default::default());
        assert_eq!(profile.response(profiles::Complex::new(-1.0, 10.0)).norm(), 0.0);
    }
}

#[test]
fn any_instant_has_an_answer() {
    let ramp = SCurve::velocity_ramp(0.1, -0.2, &limits()).expect("plan");
    for t in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 5e-324] {
        let s = ramp.sample(t);
        assert!(s.position.is_finite() && s.velocity.is_finite() && s.acceleration.is_finite(), "{t}: {s:?}");
    }
}

#[test]
fn numbers_beyond_double_precision_are_refused() {
    let tiny = Limits::new(1e-300, 1e-300, 1e300).expect("limits");
    assert!(matches!(SCurve::rest_to_rest(1e300, &tiny), Err(PlanError::Range { .. })));
    assert!(matches!(Trapezoid::rest_to_rest(1e300, &tiny), Err(PlanError::Range { .. })));
    // Powers on the way under- or overflow, the duration alone would not show it.
    let slow = Limits::new(1e-300, 1e-300, 1e-30).and_then(|l| l.with_snap(1e200)).expect("limits");
    assert!(matches!(SnapLimited::rest_to_rest(1.0, &slow), Err(PlanError::Range { .. })));
    let short = Limits::new(9e-54, 4e67, f64::INFINITY).expect("limits");
    assert!(matches!(Cosine::rest_to_rest(1.0, &short), Err(PlanError::Range { .. })));
    assert!(matches!(FivePhase::rest_to_rest(1e300, &tiny), Err(PlanError::Range { .. })));
    let fast = Limits::new(1e200, 1e200, f64::INFINITY).expect("limits");
    assert!(matches!(Trapezoid::rest_to_rest(1e200, &fast), Err(PlanError::Range { .. })));
}

#[test]
fn a_profile_only_stretches() {
    let profile = SCurve::rest_to_rest(0.04, &limits()).expect("plan");
    for duration in [0.1, f64::NAN, f64::INFINITY, 1e300] {
        assert!(matches!(profile.stretched_to(duration), Err(PlanError::Duration { .. })));
    }
    assert_eq!(profile.stretched_to(profile.duration()).map(|p| p.duration()), Ok(profile.duration()));
}
