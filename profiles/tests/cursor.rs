//! The cursor against the profile it runs.
#![expect(clippy::expect_used, reason = "helpers of tests may fail loudly")]

mod common;

use common::{CASES, Law, balanced_move, orders, scales};
use profiles::{ClockError, Cosine, Cursor, FivePhase, Profile, Real, SCurve, SnapLimited, Trapezoid};
use proptest::prelude::*;

/// Every tick is the sample at its instant, to a few roundings of the tick's own precision.
fn follows<L: Law, F: Real>(profile: L, divisions: f64) -> Result<(), TestCaseError> {
    let period = profile.duration() / divisions;
    let mut cursor = Cursor::<_, F>::new(profile, period)?;
    let scale = scales(&profile);
    let epsilon = F::EPSILON.to_f64();
    for k in 0..=(divisions as u64 + 3) {
        prop_assert_eq!(cursor.next_tick(), k);
        let t = k as f64 * period;
        if (t - profile.duration()).abs() > 1e-14 * t {
            prop_assert_eq!(cursor.is_finished(), t > profile.duration());
        }
        let (ticked, sampled) = (orders64(cursor.tick()), orders(profile.sample(t)));
        for order in 0..L::CONTINUOUS {
            // A block of 4096 ticks spans at most so much time, in which the period's rounding adds up.
            let block = (period * 4096.0).min(profile.duration());
            let allowed = 8.0 * epsilon * (scale[order] + scale[order + 1] * block)
                + 16.0 * f64::EPSILON * scale[order + 1] * profile.duration();
            prop_assert!(
                (ticked[order] - sampled[order]).abs() <= allowed,
                "order {order} at tick {k}: {} and {}, allowed {allowed}",
                ticked[order],
                sampled[order]
            );
        }
    }
    let end = profile.sample(profile.duration()).position;
    prop_assert_eq!(cursor.tick().position, F::from_f64(end));
    Ok(())
}

fn orders64<F: Real>(s: profiles::Sample<F>) -> [f64; 5] {
    [s.position, s.velocity, s.acceleration, s.jerk, s.snap].map(F::to_f64)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    #[test]
    fn ticks_are_samples((distance, limits) in balanced_move(), divisions in prop_oneof![1.0..40.0, 40.0..400.0]) {
        follows::<_, f64>(Trapezoid::plan(distance, &limits)?, divisions)?;
        follows::<_, f64>(SCurve::plan(distance, &limits)?, divisions)?;
        follows::<_, f64>(SnapLimited::plan(distance, &limits)?, divisions)?;
        follows::<_, f64>(Cosine::plan(distance, &limits)?, divisions)?;
        follows::<_, f64>(FivePhase::plan(distance, &limits)?, divisions)?;
        follows::<_, f32>(Trapezoid::plan(distance, &limits)?, divisions)?;
        follows::<_, f32>(SCurve::plan(distance, &limits)?, divisions)?;
        follows::<_, f32>(SnapLimited::plan(distance, &limits)?, divisions)?;
        follows::<_, f32>(Cosine::plan(distance, &limits)?, divisions)?;
        follows::<_, f32>(FivePhase::plan(distance, &limits)?, divisions)?;
    }

    #[test]
    fn ticks_of_slower_moves_and_of_moves_with_speeds_are_samples(
        (distance, limits) in balanced_move(),
        divisions in prop_oneof![1.0..40.0, 40.0..400.0],
        slower in 1.0..10.0,
        speed in 0.0..1.0,
    ) {
        let profile = SnapLimited::plan(distance, &limits)?;
        follows::<_, f64>(profile.stretched(slower * profile.duration())?, divisions)?;
        let profile = Cosine::plan(distance, &limits)?;
        follows::<_, f64>(profile.stretched(slower * profile.duration())?, divisions)?;
        let most = limits.velocity().upper.min((2.0 * limits.acceleration().upper * distance.abs()).sqrt());
        let profile = Trapezoid::with_speeds(distance, speed * most, 0.5 * speed * most, &limits)?;
        follows::<_, f64>(profile.stretched(slower * profile.duration())?, divisions)?;
    }
}

#[test]
fn single_precision_keeps_its_digits_through_a_long_move() {
    // 1000 s at 20 kHz: absolute time in f32 would be off by 60 us, 1.2 ticks.
    let limits = profiles::Limits::new(0.001, 0.5, 10.0).expect("limits");
    let profile = SCurve::rest_to_rest(1.0, &limits).expect("plan");
    let mut cursor = Cursor::<_, f32>::new(&profile, 5e-5).expect("clock");
    let mut worst = 0.0_f64;
    while !cursor.is_finished() {
        let t = cursor.next_tick() as f64 * 5e-5;
        worst = worst.max((f64::from(cursor.tick().position) - profile.sample(t).position).abs());
    }
    assert!(worst < 2.0 * f64::from(f32::EPSILON), "{worst}");
}

#[test]
fn a_tick_within_rounding_of_the_end_is_the_end() {
    // 0.27 s in ticks of 1 ms: 270 times 0.001 is one rounding off 0.27.
    let limits = profiles::Limits::new(0.2, 4.0, 200.0).expect("limits");
    for (distance, ticks) in [(0.04, 270), (0.05, 320), (0.06, 370), (0.1, 570)] {
        let profile = SCurve::rest_to_rest(distance, &limits).expect("plan");
        let mut cursor = Cursor::<_, f64>::new(profile, 1e-3).expect("clock");
        while !cursor.is_finished() {
            let _ = cursor.tick();
        }
        assert_eq!(cursor.next_tick(), ticks);
        assert_eq!(cursor.tick(), profiles::Sample::at_rest(distance));
    }
}

#[test]
fn seeking_is_the_same_as_ticking() {
    let limits = profiles::Limits::new(0.2, 4.0, 200.0).expect("limits");
    let profile = SCurve::rest_to_rest(0.04, &limits).expect("plan");
    let mut running = Cursor::<_, f64>::new(&profile, 1e-3).expect("clock");
    for k in 0..300 {
        let mut sought = Cursor::<_, f64>::new(&profile, 1e-3).expect("clock");
        sought.seek(k);
        let (a, b) = (running.tick(), sought.tick());
        assert!((a.position - b.position).abs() < 1e-16 && (a.velocity - b.velocity).abs() < 1e-15);
    }
}

#[test]
fn a_clock_must_tick() {
    let limits = profiles::Limits::new(0.2, 4.0, 200.0).expect("limits");
    let profile = SCurve::rest_to_rest(0.04, &limits).expect("plan");
    assert!(matches!(Cursor::<_, f64>::new(profile, 0.0), Err(ClockError::Period(_))));
    assert!(matches!(Cursor::<_, f64>::new(profile, f64::NAN), Err(ClockError::Period(_))));
    assert!(matches!(Cursor::<_, f64>::new(profile, 1e-18), Err(ClockError::TooManyTicks { .. })));
}
