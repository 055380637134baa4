//! Shaped profiles against the sum they stand for and against an oscillator.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]
#![expect(clippy::float_cmp, reason = "ends that must be equal to the bit")]

use profiles::{
    Cosine, Limits, Mode, Profile, SCurve, Sectioned, SnapLimited, Trapezoid, residual_vibration,
};
use proptest::prelude::*;
use shaping::{DelayFilter, Shaped};

/// Moves of one metre or so in one second or so, of every regime.
fn limits() -> impl Strategy<Value = Limits> {
    let factor = || (0.2_f64.ln()..5.0_f64.ln()).prop_map(f64::exp);
    (factor(), factor(), factor(), factor()).prop_map(|(v, a, j, s)| {
        Limits::new(v, 4.0 * a, 40.0 * j).and_then(|l| l.with_snap(800.0 * s)).expect("limits")
    })
}

fn orders(s: profiles::Sample) -> [f64; 5] {
    [s.position, s.velocity, s.acceleration, s.jerk, s.snap]
}

fn bounds(e: profiles::Extrema) -> [profiles::Interval; 5] {
    [e.position, e.velocity, e.acceleration, e.jerk, e.snap]
}

/// The extrema bound every sample, and a sample comes near each of them.
fn ranges_are_exact<P: Sectioned + std::fmt::Debug>(
    profile: P,
    filter: &DelayFilter,
) -> Result<(), TestCaseError> {
    let shaped = Shaped::new(&profile, *filter.train());
    let bounds = bounds(shaped.extrema());
    let duration = shaped.duration();
    let mut reached = [profiles::Interval::new(f64::INFINITY, f64::NEG_INFINITY); 5];
    let steps = 4000;
    for k in 0..=steps {
        let sample = orders(shaped.sample(duration * f64::from(k) / f64::from(steps)));
        for order in 0..5 {
            let slack = 1e-13 * bounds[order].magnitude();
            prop_assert!(
                sample[order] >= bounds[order].lower - slack && sample[order] <= bounds[order].upper + slack,
                "order {order} at {k}: {} beyond {:?} {profile:?}",
                sample[order],
                bounds[order]
            );
            let (lower, upper) =
                (reached[order].lower.min(sample[order]), reached[order].upper.max(sample[order]));
            reached[order] = profiles::Interval::new(lower, upper);
        }
    }
    // Orders that do not jump come within a step times the next order.
    for order in 0..2 {
        let near = duration / f64::from(steps) * bounds[order + 1].magnitude();
        prop_assert!(reached[order].lower - bounds[order].lower <= near, "order {order}");
        prop_assert!(bounds[order].upper - reached[order].upper <= near, "order {order}");
    }
    Ok(())
}

/// The amplitude left in `x'' + 2 z w x' + w^2 x = -a(t)`, by Runge-Kutta steps of 1/400 of the shorter of period and
/// move, none of them across a corner of the acceleration.
fn simulated<P: Profile>(profile: &P, mode: Mode, corners: &[f64]) -> f64 {
    let (w, z) = (mode.angular_frequency(), mode.damping_ratio());
    let (mut x, mut v) = (0.0_f64, 0.0_f64);
    for pair in corners.windows(2) {
        let length = pair[1] - pair[0];
        let steps = (400.0 * w * length).ceil().max(8.0);
        let h = length / steps;
        for k in 0..steps as usize {
            // From inside the section: the ends belong to neighbours.
            let t = |part: f64| (pair[0] + (k as f64 + part) * h).clamp(pair[0] + 1e-12, pair[1] - 1e-12);
            let f =
                |t: f64, x: f64, v: f64| (v, -profile.sample(t).acceleration - 2.0 * z * w * v - w * w * x);
            let (k1, l1) = f(t(0.0), x, v);
            let (k2, l2) = f(t(0.5), x + 0.5 * h * k1, v + 0.5 * h * l1);
            let (k3, l3) = f(t(0.5), x + 0.5 * h * k2, v + 0.5 * h * l2);
            let (k4, l4) = f(t(1.0), x + h * k3, v + h * l3);
            x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
            v += h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
        }
    }
    let pole = mode.pole();
    (v - pole.re * x).hypot(pole.im * x) / mode.damped_angular_frequency()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn extrema_are_exact(limits in limits(), hz in 1.0..20.0, z in 0.0..0.3, turns in 0.3..0.7) {
        let mode = Mode::from_hz(hz, z).expect("mode");
        let filter = DelayFilter::new(mode, turns * mode.damped_period()).expect("filter");
        ranges_are_exact(Trapezoid::rest_to_rest(1.0, &limits)?, &filter)?;
        ranges_are_exact(SCurve::rest_to_rest(-1.0, &limits)?, &filter)?;
        ranges_are_exact(SnapLimited::rest_to_rest(1.0, &limits)?, &filter)?;
        ranges_are_exact(Cosine::rest_to_rest(1.0, &limits)?, &filter)?;
        // A delay with a negative impulse, which reverses what it delays.
        let overshooting = DelayFilter::new(mode, 0.9 * mode.damped_period()).expect("filter");
        ranges_are_exact(SCurve::rest_to_rest(1.0, &limits)?, &overshooting)?;
        ranges_are_exact(Cosine::rest_to_rest(1.0, &limits)?, &overshooting)?;
    }

    #[test]
    fn what_is_left_is_what_the_response_says(
        limits in limits(),
        hz in 1.0..10.0,
        z in prop_oneof![Just(0.0), 0.0..0.3],
        detuned in 0.7..1.3,
        turns in 0.3..0.7,
    ) {
        let mode = Mode::from_hz(hz, z).expect("mode");
        let filter = DelayFilter::new(mode, turns * mode.damped_period()).expect("filter");
        let profile = SCurve::rest_to_rest(1.0, &limits)?;
        let shaped = Shaped::new(profile, *filter.train());
        prop_assert!(residual_vibration(&shaped, mode) < 1e-14);
        let beside = Mode::from_hz(hz * detuned, z).expect("mode");
        let mut corners = vec![];
        for impulse in filter.train().impulses() {
            corners.push(impulse.time);
            corners.extend((0..7).filter_map(|k| profile.section(k)).map(|s| s.end + impulse.time));
        }
        corners.sort_by(f64::total_cmp);
        corners.dedup_by(|a, b| *a - *b < 1e-9);
        let (closed, simulated) = (residual_vibration(&shaped, beside), simulated(&shaped, beside, &corners));
        prop_assert!((closed - simulated).abs() < 1e-9, "{closed} and {simulated}");
    }
}

#[test]
fn a_shaped_move_ends_where_it_would() {
    let limits = Limits::new(0.2, 4.0, 200.0).expect("limits");
    let mode = Mode::from_hz(33.0, 0.02).expect("mode");
    let train = *DelayFilter::zvd(mode).expect("filter").train();
    let profile = SCurve::rest_to_rest(-0.04, &limits).expect("plan");
    let shaped = Shaped::new(profile, train);
    assert!((shaped.duration() - profile.duration() - mode.damped_period()).abs() < 1e-15);
    assert_eq!(shaped.sample(shaped.duration()), profile.sample(profile.duration()));
    assert_eq!(shaped.sample(f64::INFINITY).position, -0.04);
    assert_eq!(shaped.sample(-1.0), profiles::Sample::default());
    // A ramp goes on with its speed.
    let ramp = Shaped::new(SCurve::velocity_ramp(0.0, 0.2, &limits).expect("plan"), train);
    assert!((ramp.sample(ramp.duration() + 1.0).velocity - 0.2).abs() < 1e-16);
}
