//! Durations against an independent time-optimal planner, and against brute force where that has none.
#![expect(clippy::expect_used, reason = "helpers of tests may fail loudly")]

mod common;

use common::{CASES, Law, balanced_move, lopsided, magnitude};
use profiles::{Cosine, Interval, Limits, Profile, SCurve, SnapLimited};
use proptest::prelude::*;
use rsruckig::prelude::*;

fn rsruckig(distance: f64, limits: &Limits) -> Option<f64> {
    let mut input = InputParameter::<1>::new(None);
    input.target_position[0] = distance;
    input.max_velocity[0] = limits.velocity().upper;
    input.min_velocity = Some(daov_stack![limits.velocity().lower]);
    input.max_acceleration[0] = limits.acceleration().upper;
    input.min_acceleration = Some(daov_stack![limits.acceleration().lower]);
    input.max_jerk[0] = limits.jerk().upper;
    let mut trajectory = Trajectory::new(None);
    let result = Ruckig::<1, ThrowErrorHandler>::new(None, 1e-3).calculate(&input, &mut trajectory);
    matches!(result, Ok(RuckigResult::Working)).then(|| trajectory.get_duration())
}

proptest! {
    #![proptest_config(ProptestConfig { max_global_rejects: CASES / 10, ..ProptestConfig::with_cases(CASES) })]

    #[test]
    fn s_curves_take_the_optimal_time((distance, limits) in balanced_move(), deceleration in magnitude(0.1, 10.0)) {
        // rsruckig's tolerances are absolute: a move of about one metre in about one second.
        let scale = 1.0 / distance.abs();
        let time = 1.0 / SCurve::plan(distance, &limits)?.duration();
        let unit = |k: i32| scale / time.powi(k);
        let limits = Limits::new(
            limits.velocity().upper * unit(1),
            limits.acceleration().upper * unit(2),
            limits.jerk().upper * unit(3),
        ).expect("limits");
        for limits in [limits, lopsided(&limits, deceleration, 1.0)] {
            let ours = SCurve::plan(1.0_f64.copysign(distance), &limits)?.duration();
            // The peer finds no plan for a few moves; a tenth of them would fail the test.
            let theirs = rsruckig(1.0_f64.copysign(distance), &limits);
            let theirs = theirs.ok_or_else(|| TestCaseError::reject("the peer has no plan"))?;
            prop_assert!((ours - theirs).abs() < 1e-7 * theirs, "{ours} and {theirs}");
        }
    }

    #[test]
    fn different_jerks_leave_no_faster_peak((distance, limits) in balanced_move(), falling in magnitude(0.1, 10.0)) {
        // A move of two ramps is as fast as its peak velocity lets it be: the way of the fastest ramps to a speed a
        // little higher, integrated on their own, is longer than the distance unless the limit is met.
        let limits = limits.with_jerk(Interval::new(-falling * limits.jerk().upper, limits.jerk().upper)).expect("limits");
        let profile = SCurve::plan(distance, &limits)?;
        let e = profile.extrema().velocity;
        let peak = e.magnitude();
        let limit = limits.velocity().upper;
        if peak < limit * (1.0 - 1e-9) {
            let faster = (peak * (1.0 + 1e-6)).min(limit).copysign(distance);
            let up = SCurve::ramp(0.0, faster, &limits)?;
            let down = SCurve::ramp(faster, 0.0, &limits)?;
            let way = up.sample(up.duration()).position + down.sample(down.duration()).position;
            prop_assert!(way.abs() > distance.abs(), "{way} within {distance}");
        }
    }
}

#[test]
fn every_regime_of_the_s_curve_is_its_closed_form() {
    // V, A, J = 1: averages t3 = 1, t2 = 1; boundaries at h = 2 (cruise) coincide, so widen A and V one at a time.
    let plan = |h: f64, v: f64, a: f64, j: f64| {
        SCurve::rest_to_rest(h, &Limits::new(v, a, j).expect("limits")).expect("plan").duration()
    };
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-14 * b, "{a} {b}");
    // Velocity and acceleration reached: h/V + V/A + A/J.
    close(plan(10.0, 2.0, 1.0, 1.0), 5.0 + 2.0 + 1.0);
    // Velocity reached, acceleration not: h/V + 2 sqrt(V/J).
    close(plan(10.0, 1.0, 4.0, 1.0), 10.0 + 2.0);
    // Acceleration reached, velocity not: 2 t2 + 2 t3 with t2 (t2 + t3) = h/A.
    close(plan(6.0, 100.0, 1.0, 1.0), 2.0 * 2.0 + 2.0);
    // Neither: 4 (h / 2J)^(1/3).
    close(plan(16.0, 100.0, 100.0, 1.0), 8.0);
}

#[test]
fn every_regime_of_the_snap_limited_law_is_its_closed_form() {
    let plan = |h: f64, v: f64, a: f64, j: f64, s: f64| {
        let limits = Limits::new(v, a, j).and_then(|l| l.with_snap(s)).expect("limits");
        SnapLimited::rest_to_rest(h, &limits).expect("plan").duration()
    };
    let inf = f64::INFINITY;
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-14 * b, "{a} {b}");
    // All four limits: h/V + V/A + A/J + J/D.
    close(plan(10.0, 2.0, 1.0, 1.0, 1.0), 5.0 + 2.0 + 1.0 + 1.0);
    // Only the snap: 8 (h / 8D)^(1/4).
    close(plan(128.0, inf, inf, inf, 1.0), 8.0 * 2.0);
    // Snap and velocity: t4 = (V / 2D)^(1/3), h/V + 4 t4.
    close(plan(200.0, 16.0, inf, inf, 1.0), 200.0 / 16.0 + 4.0 * 2.0);
    // Snap and acceleration: t3 = t4 = (A/D)^(1/2) = 2, t2 (t2 + 4) = h/A = 60, so t2 = 6: 2 t2 + 4 t4.
    close(plan(240.0, inf, 4.0, inf, 1.0), 12.0 + 8.0);
    // Snap and jerk: x (x + t4)^2 = h / 2J, 4 (x + t4) here with x = 3, t4 = 1.
    close(plan(96.0, inf, inf, 1.0, 1.0), 4.0 * 4.0);
    // Snap, jerk and velocity: x (x + t4) = V/J, x = 3: h/V + 2 (x + t4).
    close(plan(1200.0, 12.0, inf, 1.0, 1.0), 100.0 + 8.0);
}

#[test]
fn every_regime_of_the_cosine_is_its_closed_form() {
    let plan = |h: f64, v: f64, a: f64, j: f64| {
        Cosine::rest_to_rest(h, &Limits::new(v, a, j).expect("limits")).expect("plan").duration()
    };
    let (inf, pi) = (f64::INFINITY, std::f64::consts::PI);
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-14 * b, "{a} {b}");
    // Velocity and acceleration: h/V + pi V / 2A.
    close(plan(10.0, 2.0, 1.0, inf), 5.0 + pi);
    // Velocity and jerk: h/V + pi (V / 2J)^(1/2).
    close(plan(20.0, 2.0, inf, 0.25), 10.0 + 2.0 * pi);
    // Acceleration alone: 2 t1 with a = pi v / 2 t1 and h = v t1, so t1^2 = pi h / 2A.
    close(plan(8.0 * pi, inf, 1.0, inf), 4.0 * pi);
    // Jerk alone: j = pi^2 v / 2 t1^2 and h = v t1, so t1^3 = pi^2 h / 2J.
    close(plan(16.0 * pi, inf, inf, 1.0), 4.0 * pi);
}

#[test]
fn the_missing_jerk_at_half_way_costs_what_the_documentation_says() {
    // The optimum for a snap limit alone switches where Chebyshev's polynomial does, at (1 - cos(k pi / 4)) / 2 of
    // the duration; its snap integrates four times to h.
    let limits = Limits::UNLIMITED.with_snap(1.0).expect("limits");
    let ours = SnapLimited::rest_to_rest(1.0, &limits).expect("plan").duration();
    let switches: Vec<f64> =
        (1..4).map(|k| 0.5 * (1.0 - (f64::from(k) * std::f64::consts::FRAC_PI_4).cos())).collect();
    let reached = |t: f64| {
        let mut sum = t.powi(4);
        for (k, s) in switches.iter().enumerate() {
            let step = if k % 2 == 0 { -2.0 } else { 2.0 };
            sum += step * (t - s * t).powi(4);
        }
        sum / 24.0
    };
    let optimum = (1.0 / reached(1.0)).powf(0.25);
    let shorter = 1.0 - optimum / ours;
    assert!((shorter - 0.069).abs() < 5e-4, "{shorter}");
}
