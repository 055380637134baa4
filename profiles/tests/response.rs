//! The closed-form response against quadrature, and against the simulation of an oscillator.
#![expect(clippy::expect_used, reason = "helpers of tests may fail loudly")]

mod common;

use common::{CASES, Law, balanced_move, lopsided, magnitude, sections};
use profiles::{
    Complex, Cosine, FivePhase, Mode, Profile, SCurve, Sectioned, SnapLimited, Trapezoid, residual_vibration,
    transform,
};
use proptest::prelude::*;

/// Nodes and weights of the Gauss-Legendre rule with five points on [-1, 1].
const GAUSS: [(f64, f64); 5] = [
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
    (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
];

/// `integral of a(u) e^(p (T - u)) du` by Gauss's rule on panels of at most a quarter radian.
fn quadrature<P: Sectioned>(profile: &P, p: Complex<f64>) -> Complex<f64> {
    let duration = profile.duration();
    let mut sum = Complex::new(0.0, 0.0);
    for section in sections(profile) {
        let fastest = p.norm().max(section.angular_frequency);
        let panels = (4.0 * fastest * section.length()).ceil().max(1.0);
        let half = 0.5 * section.length() / panels;
        // In local time, where an instant far from zero has not lost its digits.
        let (from, to) = section.local_ends();
        for panel in 0..panels as usize {
            let middle = from + (2.0 * panel as f64 + 1.0) * half;
            for (node, weight) in GAUSS {
                let x = middle + node * half;
                let left = (duration - section.end) + (to - x);
                sum += section.at_local(x).acceleration * (p * left).exp() * (weight * half);
            }
        }
    }
    sum
}

/// Closed form and quadrature differ by the rounding of the sum: a few units of `integral |a|`, and the rounding of
/// the phase at every instant.
fn equals_quadrature<L: Law>(profile: &L, p: Complex<f64>) -> Result<(), TestCaseError> {
    let (closed, summed) = (profile.response(p), quadrature(profile, p));
    let speeds = common::scales(profile)[1];
    let allowed = (64.0 + 8.0 * p.norm() * profile.duration()) * f64::EPSILON * speeds;
    prop_assert!((closed - summed).norm() <= allowed, "{closed} and {summed}, allowed {allowed}");
    Ok(())
}

/// A mode with a phase of `phase` radians over the profile.
fn mode(phase: f64, damping: f64, duration: f64) -> Mode {
    Mode::new(phase / duration, damping).expect("mode")
}

/// The amplitude left in an oscillator `x'' + 2 z w x' + w^2 x = -a(t)`: Runge-Kutta steps of 1/200 radian, none
/// across a boundary of sections.
fn simulated<P: Sectioned>(profile: &P, mode: Mode) -> f64 {
    let (w, z) = (mode.angular_frequency(), mode.damping_ratio());
    let (mut x, mut v) = (0.0_f64, 0.0_f64);
    for section in sections(profile) {
        let steps = (200.0 * w * section.length()).ceil().max(50.0);
        let h = section.length() / steps;
        for k in 0..steps as usize {
            let t = section.start + k as f64 * h;
            let f = |t: f64, x: f64, v: f64| (v, -section.at(t).acceleration - 2.0 * z * w * v - w * w * x);
            let (k1, l1) = f(t, x, v);
            let (k2, l2) = f(t + 0.5 * h, x + 0.5 * h * k1, v + 0.5 * h * l1);
            let (k3, l3) = f(t + 0.5 * h, x + 0.5 * h * k2, v + 0.5 * h * l2);
            let (k4, l4) = f(t + h, x + h * k3, v + h * l3);
            x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
            v += h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
        }
    }
    // Amplitude of the free decay: |v - conj(p) x| / w_d.
    let pole = mode.pole();
    (Complex::new(v, 0.0) - pole.conj() * x).norm() / mode.damped_angular_frequency()
}

/// Phases from far below one radian (where a move nearly cancels) to hundreds of turns, undamped ones included.
fn phase() -> impl Strategy<Value = f64> {
    magnitude(1e-6, 2e3)
}

fn damping() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), magnitude(1e-5, 0.9)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    #[test]
    fn response_is_the_integral((distance, limits) in balanced_move(), phase in phase(), damping in damping()) {
        let of = |duration: f64| mode(phase, damping, duration).pole();
        let profile = Trapezoid::plan(distance, &limits)?;
        equals_quadrature(&profile, of(profile.duration()))?;
        let profile = SCurve::plan(distance, &limits)?;
        equals_quadrature(&profile, of(profile.duration()))?;
        let profile = SnapLimited::plan(distance, &limits)?;
        equals_quadrature(&profile, of(profile.duration()))?;
        let profile = Cosine::plan(distance, &limits)?;
        equals_quadrature(&profile, of(profile.duration()))?;
        let profile = FivePhase::plan(distance, &limits)?;
        equals_quadrature(&profile, of(profile.duration()))?;
        let profile = SCurve::plan(distance, &lopsided(&limits, 0.3, 2.0))?;
        equals_quadrature(&profile, of(profile.duration()))?;
    }

    #[test]
    fn response_of_a_ramp_is_the_integral(
        (_, limits) in balanced_move(),
        from in -1.0..1.0,
        phase in phase(),
        damping in damping(),
    ) {
        let to = limits.velocity().upper;
        let of = |duration: f64| mode(phase, damping, duration).pole();
        let profile = Trapezoid::ramp(from * to, to, &limits)?;
        equals_quadrature(&profile, of(profile.duration()))?;
        let profile = SCurve::ramp(from * to, to, &limits)?;
        equals_quadrature(&profile, of(profile.duration()))?;
        let profile = SnapLimited::ramp(from * to, to, &limits)?;
        equals_quadrature(&profile, of(profile.duration()))?;
        let profile = Cosine::ramp(from * to, to, &limits)?;
        equals_quadrature(&profile, of(profile.duration()))?;
        let profile = FivePhase::ramp(from * to, to, &limits)?;
        equals_quadrature(&profile, of(profile.duration()))?;
    }

    #[test]
    fn a_slow_mode_is_thrown_by_the_whole_move((distance, limits) in balanced_move(), phase in magnitude(1e-9, 1e-4)) {
        // response(p) / (p h) -> 1 as p T -> 0, with every digit although the acceleration cancels.
        let profile = SCurve::plan(distance, &limits)?;
        let pole = mode(phase, 0.3, profile.duration()).pole();
        let relative = profile.response(pole) / (pole * distance);
        prop_assert!((relative - 1.0).norm() <= phase + 1e-14, "{relative}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn residual_vibration_is_what_an_oscillator_keeps(
        (distance, limits) in balanced_move(),
        phase in magnitude(0.1, 60.0),
        damping in prop_oneof![Just(0.0), 0.0..0.5],
    ) {
        let profile = SnapLimited::plan(distance, &limits)?;
        let mode = mode(phase, damping, profile.duration());
        let (closed, simulated) = (residual_vibration(&profile, mode), simulated(&profile, mode));
        // Runge-Kutta at 1/200 radian: (1/200)^4 / 120 a radian.
        prop_assert!((closed - simulated).abs() <= 1e-9 * distance.abs(), "{closed} and {simulated}");
    }
}

#[test]
fn an_average_of_whole_periods_leaves_nothing() {
    // t2 + t3 of a long S-curve are averages too: an undamped mode of period V/A is nulled.
    let limits = profiles::Limits::new(0.2, 4.0, 200.0).expect("limits");
    let profile = SCurve::rest_to_rest(0.1, &limits).expect("plan");
    let nulled = Mode::from_hz(4.0 / 0.2, 0.0).expect("mode");
    assert!(residual_vibration(&profile, nulled) < 1e-16);
    let beside = Mode::from_hz(23.0, 0.0).expect("mode");
    assert!(residual_vibration(&profile, beside) > 1e-6);
}

#[test]
fn transform_is_the_product_of_the_averages() {
    // A step through averages of lengths t1, t2, t3: A(s) = s h prod (1 - e^(-s t)) / (s t).
    let (v, a, j, h) = (0.2, 4.0, 200.0, 0.1);
    let profile = SCurve::rest_to_rest(h, &profiles::Limits::new(v, a, j).expect("limits")).expect("plan");
    let everywhere = [
        (-3.0, 40.0),
        (0.0, 200.0),
        (0.1, 0.2),
        (2.0, 7.0),
        (30.0, 0.0),
        (700.0, 900.0),
        (1e4, -3e3),
        (1e9, 0.0),
    ];
    for s in everywhere.map(|(re, im)| Complex::new(re, im)) {
        let average = |t: f64| (1.0 - (-s * t).exp()) / (s * t);
        let expected = s * h * average(h / v) * average(v / a) * average(a / j);
        assert!((transform(&profile, s) - expected).norm() < 1e-14 * (1.0 + expected.norm()), "{s}");
    }
    // Far to the right only the start of the first section counts, J / s^2, less the rounding of its end: |s| A/J units.
    let s = Complex::new(1e9, 0.0);
    let allowed = 1e9 * a / j * f64::EPSILON;
    assert!((transform(&profile, s).re / (j / 1e18) - 1.0).abs() < 4.0 * allowed);
}

#[test]
fn the_transform_joins_on_the_imaginary_axis() {
    // From the right no exponential of the response is used, from the left all of them are.
    let limits = profiles::Limits::new(0.2, 4.0, 200.0).expect("limits");
    let move_ = Cosine::rest_to_rest(0.05, &limits).expect("plan");
    let ramp = Cosine::velocity_ramp(-0.1, 0.2, &limits).expect("plan");
    let jumping = Trapezoid::with_speeds(0.05, 0.1, 0.15, &limits).expect("plan");
    for w in [7.0, 40.0, 300.0] {
        let sides = [Complex::new(1e-30, w), Complex::new(0.0, w)];
        for [right, left] in [
            sides.map(|s| transform(&move_, s)),
            sides.map(|s| transform(&ramp, s)),
            sides.map(|s| transform(&jumping, s)),
        ] {
            assert!((right - left).norm() < 1e-14, "{right} and {left}");
        }
    }
}

#[test]
fn jumps_of_the_velocity_count_as_impulses() {
    // Constant speed from start to stop: two impulses, v e^(p T) - v.
    let limits = profiles::Limits::new(0.5, 1.0, f64::INFINITY).expect("limits");
    let profile = Trapezoid::with_speeds(2.0, 0.5, 0.5, &limits).expect("plan");
    for p in [Complex::new(-0.1, 3.0), Complex::new(0.0, 0.01)] {
        let expected = 0.5 * ((p * profile.duration()).exp() - 1.0);
        assert!((profile.response(p) - expected).norm() < 1e-15);
    }
}
