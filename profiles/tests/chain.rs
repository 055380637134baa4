//! Chains of averages: nothing left of their modes, limits held, never longer than what they replace.
#![expect(
    clippy::expect_used,
    clippy::float_cmp,
    reason = "helpers fail as tests do; ends and scalings are exact"
)]

mod common;

use common::{a_move, balanced_move, magnitude, orders, rounding, sections};
use profiles::{
    Chain, ChainError, Complex, Cursor, Interval, Limits, Link, Mode, PlanError, Profile, PulseTrain, SCurve,
    Sectioned, residual_vibration,
};
use proptest::prelude::*;

/// Room for three modes.
type Any = Chain<95>;

/// Up to three modes whose periods are a part of the duration of the S-curve.
fn modes() -> impl Strategy<Value = Vec<(f64, f64)>> {
    prop::collection::vec((magnitude(0.02, 5.0), prop_oneof![Just(0.0), 0.0..0.5]), 0..=3)
}

fn of(modes: &[(f64, f64)], s_curve: &SCurve) -> Vec<Mode> {
    let mode = |&(part, z): &(f64, f64)| {
        Mode::new(std::f64::consts::TAU / (part * s_curve.duration()), z).expect("mode")
    };
    modes.iter().map(mode).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1024))]

    #[test]
    fn nothing_is_left_and_limits_hold((distance, limits) in a_move(), modes in modes()) {
        let s_curve = SCurve::rest_to_rest(distance, &limits).expect("plan");
        let modes = of(&modes, &s_curve);
        let chain = Any::rest_to_rest(distance, &limits, &modes).expect("plan");

        let peaks = chain.extrema();
        // Roundings of a sum of products of up to seven weights.
        let most = |bound: f64| bound * (1.0 + 64.0 * f64::EPSILON);
        prop_assert!(peaks.velocity.magnitude() <= most(limits.velocity().magnitude()));
        prop_assert!(peaks.acceleration.magnitude() <= most(limits.acceleration().magnitude()));
        prop_assert!(peaks.jerk.magnitude() <= most(limits.jerk().magnitude()));

        for mode in &modes {
            // Relative to the amplitude of a step of the same length.
            prop_assert!(residual_vibration(&chain, *mode) <= 1e-14 * distance.abs());
            // The sections say the same, to the roundings of a response.
            let turns = mode.pole().norm() * chain.duration();
            let rounding = f64::EPSILON * (64.0 + 8.0 * turns) * peaks.velocity.magnitude();
            let left = chain.as_piecewise().response(mode.pole()).norm();
            prop_assert!(left <= 4.0 * rounding, "{left:e} {rounding:e} {turns}");
        }
        for (k, mode) in modes.iter().enumerate() {
            let links: Vec<_> = chain.links().iter().filter(|link| link.mode() == Some(k)).collect();
            prop_assert!(links.len() == 1 && links[0].response(mode.pole()).norm() < 1e-15);
        }
        let sum: f64 = chain.links().iter().map(Link::duration).sum();
        prop_assert!((sum - chain.duration()).abs() <= 1e-14 * sum);

        // A pair for every mode is one of the choices: the S-curve through zero-vibration shapers.
        let pairs: f64 = modes.iter().map(|mode| 0.5 * mode.damped_period()).sum();
        prop_assert!(chain.price() <= pairs + 1e-12 * s_curve.duration(), "{} {pairs}", chain.price());
        prop_assert!(chain.price() >= -1e-12 * s_curve.duration());
    }

    #[test]
    fn it_ends_at_its_target_and_is_continuous((distance, limits) in balanced_move(), modes in modes()) {
        let s_curve = SCurve::rest_to_rest(distance, &limits).expect("plan");
        let chain = Any::rest_to_rest(distance, &limits, &of(&modes, &s_curve)).expect("plan");
        let end = chain.sample(chain.duration());
        prop_assert_eq!(orders(end), [distance, 0.0, 0.0, 0.0, 0.0]);
        prop_assert_eq!(chain.sample(-1.0).position.to_bits(), 0.0_f64.to_bits());
        let sections = sections(&chain);
        let tolerance = rounding(&chain);
        let gap = |k: usize, before: f64, after: f64| (before - after).abs() <= tolerance[k];
        for pair in sections.windows(2) {
            let before = orders(pair[0].at_local(pair[0].local_ends().1));
            let after = orders(pair[1].at_local(pair[1].local_ends().0));
            for k in 0..3 {
                prop_assert!(gap(k, before[k], after[k]), "{k} {} {} {}", before[k], after[k], tolerance[k]);
            }
        }
        let last = sections.last().expect("a section");
        let stop = orders(last.at_local(last.local_ends().1));
        prop_assert_eq!(&stop[..3], &[distance, 0.0, 0.0]);
    }

    #[test]
    fn without_modes_it_is_the_s_curve((distance, limits) in balanced_move()) {
        let s_curve = SCurve::rest_to_rest(distance, &limits).expect("plan");
        let chain = Chain::<7>::rest_to_rest(distance, &limits, &[]).expect("plan");
        prop_assert!((chain.duration() - s_curve.duration()).abs() <= 1e-13 * s_curve.duration());
        for k in 0..=40 {
            let t = s_curve.duration() * f64::from(k) / 40.0;
            let (ours, known) = (chain.sample(t), s_curve.sample(t));
            prop_assert!((ours.position - known.position).abs() <= 1e-12 * distance.abs());
            let fastest = s_curve.extrema().velocity.magnitude();
            prop_assert!((ours.velocity - known.velocity).abs() <= 1e-12 * fastest);
        }
    }

    #[test]
    fn the_product_of_the_links_is_the_response_of_the_sections(
        (distance, limits) in balanced_move(),
        modes in modes(),
        turns in magnitude(1e-3, 300.0),
        z in 0.0..0.9,
    ) {
        let s_curve = SCurve::rest_to_rest(distance, &limits).expect("plan");
        let chain = Any::rest_to_rest(distance, &limits, &of(&modes, &s_curve)).expect("plan");
        let pole = Mode::new(turns / chain.duration(), z).expect("mode").pole();
        let (product, sections) = (chain.response(pole), chain.as_piecewise().response(pole));
        let scale = chain.extrema().velocity.magnitude();
        let rounding = f64::EPSILON * (64.0 + 8.0 * turns) * scale;
        prop_assert!((product - sections).norm() <= 4.0 * rounding, "{product} {sections}");
    }

    #[test]
    fn units_do_not_matter((distance, limits) in balanced_move(), modes in modes(), power in -40_i32..40) {
        let s_curve = SCurve::rest_to_rest(distance, &limits).expect("plan");
        let modes = of(&modes, &s_curve);
        let unit = 2.0_f64.powi(power);
        let scaled = Limits::new(
            limits.velocity().upper * unit,
            limits.acceleration().upper * unit,
            limits.jerk().upper * unit,
        )
        .expect("limits");
        let one = Any::rest_to_rest(distance, &limits, &modes).expect("plan");
        let other = Any::rest_to_rest(distance * unit, &scaled, &modes).expect("plan");
        prop_assert_eq!(one.duration(), other.duration());
        let t = 0.37 * one.duration();
        prop_assert_eq!(one.sample(t).velocity * unit, other.sample(t).velocity);
    }
}

/// The amplitude with which a mode that is driven by the acceleration of the axis goes on, by the classical Runge-Kutta
/// method section by section.
fn simulated<P: Sectioned>(profile: &P, mode: Mode) -> f64 {
    let (w, z) = (mode.angular_frequency(), mode.damping_ratio());
    let (mut x, mut v) = (0.0, 0.0);
    for section in sections(profile) {
        let (from, to) = section.local_ends();
        // Off by (w dt)^4 / 120 of the amplitude a radian: 1e-11 in a hundred of them.
        let steps = ((to - from) * w / 0.01).ceil().max(1.0);
        let dt = (to - from) / steps;
        let rate =
            |x: f64, v: f64, at: f64| (v, -section.at_local(at).acceleration - 2.0 * z * w * v - w * w * x);
        for k in 0..steps as u32 {
            let at = from + f64::from(k) * dt;
            let a = rate(x, v, at);
            let b = rate(x + 0.5 * dt * a.0, v + 0.5 * dt * a.1, at + 0.5 * dt);
            let c = rate(x + 0.5 * dt * b.0, v + 0.5 * dt * b.1, at + 0.5 * dt);
            let d = rate(x + dt * c.0, v + dt * c.1, at + dt);
            x += dt / 6.0 * (a.0 + 2.0 * (b.0 + c.0) + d.0);
            v += dt / 6.0 * (a.1 + 2.0 * (b.1 + c.1) + d.1);
        }
    }
    let p = mode.pole();
    // Of x = Re(c e^(p t)) the amplitude is |c|.
    (Complex::new(v, 0.0) - p.conj() * x).norm() / p.im
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn a_simulated_mode_is_at_rest_after_it((distance, limits) in balanced_move(), modes in modes()) {
        let s_curve = SCurve::rest_to_rest(distance, &limits).expect("plan");
        let modes = of(&modes, &s_curve);
        let chain = Any::rest_to_rest(distance, &limits, &modes).expect("plan");
        for mode in modes {
            let left = simulated(&chain, mode);
            prop_assert!(left <= 1e-9 * distance.abs(), "{left}");
        }
    }
}

fn typical(modes: &[(f64, f64)]) -> (Limits, Vec<Mode>) {
    let limits = Limits::new(0.5, 5.0, 200.0).expect("limits");
    (limits, modes.iter().map(|&(hz, z)| Mode::from_hz(hz, z).expect("mode")).collect())
}

#[test]
fn the_durations_of_the_readme_hold() {
    for (distance, modes, known, pairs) in [
        (0.1, vec![(8.0, 0.02)], 0.3456, 0.3875),
        (0.1, vec![(20.0, 0.02)], 0.3500, 0.3500),
        (0.1, vec![(20.0, 0.0)], 0.3250, 0.3500),
        (0.1, vec![(40.0, 0.02)], 0.3281, 0.3375),
        (0.02, vec![(12.0, 0.05)], 0.1851, 0.1957),
        (0.02, vec![(12.0, 0.05), (27.6, 0.05)], 0.1966, 0.2138),
    ] {
        let (limits, modes) = typical(&modes);
        let chain = Any::rest_to_rest(distance, &limits, &modes).expect("plan");
        // Four digits are printed.
        assert!((chain.duration() - known).abs() < 5.1e-5, "{}", chain.duration());
        let plain = SCurve::rest_to_rest(distance, &limits).expect("plan").duration();
        let shaped = plain + modes.iter().map(|mode| 0.5 * mode.damped_period()).sum::<f64>();
        assert!((shaped - pairs).abs() < 5.1e-5, "{shaped}");
        assert!((chain.duration() - plain - chain.price()).abs() < 1e-15);
    }
}

#[test]
fn an_undamped_mode_in_place_of_the_jerk_average_costs_only_the_difference() {
    // The jerk asks for an average of 25 ms; the mode of 32 Hz has a period of 31.25 ms.
    let (limits, modes) = typical(&[(32.0, 0.0)]);
    let chain = Chain::<7>::rest_to_rest(0.1, &limits, &modes).expect("plan");
    assert!((chain.price() - (1.0 / 32.0 - 0.025)).abs() < 1e-15, "{}", chain.price());
    assert_eq!(chain.links().len(), 3);
    // One of 40 Hz is at rest after the S-curve already.
    let (limits, modes) = typical(&[(40.0, 0.0)]);
    let chain = Chain::<7>::rest_to_rest(0.1, &limits, &modes).expect("plan");
    assert!(chain.price().abs() < 1e-15, "{}", chain.price());
}

#[test]
fn cursors_and_pulse_trains_take_it() {
    let (limits, modes) = typical(&[(8.0, 0.02), (18.4, 0.02)]);
    let chain = Chain::<47>::rest_to_rest(-0.1, &limits, &modes).expect("plan");
    let mut cursor = Cursor::<_, f32>::new(&chain, 1e-3).expect("clock");
    let mut tick = 0;
    while !cursor.is_finished() {
        let (ours, exact) = (cursor.tick(), chain.sample(1e-3 * f64::from(tick)));
        assert!((f64::from(ours.position) - exact.position).abs() < 2e-8);
        tick += 1;
    }
    assert_eq!(cursor.tick().position.to_bits(), (-0.1_f32).to_bits());
    assert_eq!(PulseTrain::new(&chain, 1e-5).expect("train").pulses().count(), 10_000);
}

#[test]
fn bad_requests_are_named_with_their_number() {
    let (limits, modes) = typical(&[(8.0, 0.02); 5]);
    let plan = |distance, limits: &Limits, modes: &[Mode]| Chain::<7>::rest_to_rest(distance, limits, modes);
    assert_eq!(plan(0.1, &limits, &modes), Err(ChainError::Modes { modes: 5, most: 4 }));
    // A pair takes the seven sections of an S-curve to fifteen, an average in its place to eleven.
    assert_eq!(plan(0.1, &limits, &modes[..1]), Err(ChainError::Sections { needed: 11, capacity: 7 }));
    assert!(Chain::<11>::rest_to_rest(0.1, &limits, &modes[..1]).is_ok());
    assert_eq!(plan(f64::INFINITY, &limits, &[]), Err(PlanError::Distance(f64::INFINITY).into()));
    let unlimited = Limits::new(0.5, 5.0, f64::INFINITY).expect("limits");
    assert_eq!(plan(0.1, &unlimited, &[]), Err(PlanError::Unlimited("jerk").into()));
    let lopsided = limits.with_deceleration(3.0).expect("limits");
    assert!(matches!(plan(0.1, &lopsided, &[]), Err(ChainError::Plan(PlanError::Asymmetric { .. }))));
    // No distance takes no time, whatever the modes.
    let nothing = plan(0.0, &limits, &modes[..4]).expect("nothing");
    assert_eq!((nothing.duration(), nothing.links().len(), nothing.price()), (0.0, 0, 0.0));
    // No limit of velocity or acceleration is no error.
    for (v, a) in [(f64::INFINITY, 5.0), (0.5, f64::INFINITY), (f64::INFINITY, f64::INFINITY)] {
        let limits = Limits::new(v, a, 200.0).expect("limits");
        let chain = Any::rest_to_rest(0.1, &limits, &modes[..2]).expect("plan");
        assert!(chain.extrema().jerk.magnitude() <= 200.0 * (1.0 + 1e-14));
        assert!(residual_vibration(&chain, modes[0]) < 1e-15);
        let none = Any::rest_to_rest(0.1, &limits, &[]).expect("plan");
        assert!(none.price().abs() < 1e-14);
    }
    let uneven = limits.with_velocity(Interval::new(-0.2, 0.5)).expect("limits");
    let back = Any::rest_to_rest(-0.1, &uneven, &modes[..1]).expect("plan");
    assert!((back.extrema().velocity.magnitude() - 0.2).abs() < 1e-12);
}
