//! Properties of every law over random limits and distances.
#![expect(clippy::expect_used, reason = "helpers of tests may fail loudly")]
#![expect(clippy::float_cmp, reason = "numbers that must be equal to the bit")]

mod common;

use common::{CASES, Law, a_move, balanced_move, lopsided, magnitude, orders, rounding, scales, sections};
use profiles::{Cosine, FivePhase, Limits, Profile, SCurve, Sectioned, SnapLimited, Trapezoid};
use proptest::prelude::*;

/// Neighbouring sections meet, and so do the ends, in every order the law keeps continuous.
fn is_continuous<L: Law>(profile: &L) -> Result<(), TestCaseError> {
    let allowed = rounding(profile);
    let meets = |left: profiles::Sample, right: profiles::Sample, highest: usize, t: f64| {
        for (k, (a, b)) in orders(left).into_iter().zip(orders(right)).enumerate().take(highest + 1) {
            prop_assert!(
                (a - b).abs() <= allowed[k],
                "order {k} at {t}: {a} and {b}, allowed {}",
                allowed[k]
            );
        }
        Ok(())
    };
    let sections = sections(profile);
    for pair in sections.windows(2) {
        let t = pair[1].start;
        prop_assert_eq!(pair[0].end, t);
        // The jerk of the cosine jumps where a ramp meets the cruise, not inside a ramp.
        meets(pair[0].at(t), pair[1].at(t), L::CONTINUOUS, t)?;
    }
    let (first, last) = (sections[0], sections[sections.len() - 1]);
    meets(profile.before(), first.at(0.0), L::CONTINUOUS, 0.0)?;
    meets(last.at(last.end), profile.after(), L::CONTINUOUS, last.end)
}

/// Every derivative is the difference quotient of the one above: a central difference over a step `d` is off by
/// `d^2/6` of the derivative two orders on, and by the rounding of what is subtracted.
fn derives<L: Law>(profile: &L, place: f64) -> Result<(), TestCaseError> {
    for section in sections(profile) {
        let d = 1e-3 * section.length();
        // Too short beside the instant at which it comes: no two instants to subtract.
        if d < 1e4 * f64::EPSILON * section.end {
            continue;
        }
        let t = section.start + (0.1 + 0.8 * place) * section.length();
        // Times on both sides as they are after rounding.
        let (early, late) = (t - d, t + d);
        let (left, here, right) =
            (orders(section.at(early)), orders(section.at(t)), orders(section.at(late)));
        let w = section.angular_frequency;
        let scale = scales(profile);
        for k in 0..4 {
            let quotient = (right[k] - left[k]) / (late - early);
            let curvature = if w > 0.0 {
                section.amplitude.abs() * w.powi(k as i32 + 3)
            } else {
                here.get(k + 3).map_or(0.0, |x| x.abs()) + here.get(k + 4).map_or(0.0, |x| x.abs() * d)
            };
            let lengths = left[k].abs().max(right[k].abs()).max(if w > 0.0 { scale[k] } else { 0.0 });
            let uneven = here.get(k + 2).map_or(0.0, |x| x.abs()) * f64::EPSILON * late;
            let allowed = d * d * curvature
                + (8.0 * f64::EPSILON * lengths + 8.0 * here[k + 1].abs() * f64::EPSILON * late) / d
                + 2.0 * uneven;
            prop_assert!(
                (quotient - here[k + 1]).abs() <= allowed,
                "order {k} at {t}: {quotient} and {}, allowed {allowed}",
                here[k + 1]
            );
        }
    }
    Ok(())
}

/// The exact extrema keep the limits the law knows, to rounding.
fn keeps_limits<L: Law>(profile: &L, limits: &Limits, known: usize) -> Result<(), TestCaseError> {
    let e = profile.extrema();
    let bounds = [
        limits.velocity(),
        limits.acceleration(),
        limits.jerk(),
        profiles::Interval::symmetric(limits.snap()),
    ];
    for (k, (reached, bound)) in
        [e.velocity, e.acceleration, e.jerk, e.snap].into_iter().zip(bounds).enumerate()
    {
        if k < known {
            let slack = 1.0 + 8.0 * f64::EPSILON;
            prop_assert!(
                reached.lower >= bound.lower * slack && reached.upper <= bound.upper * slack,
                "order {}: {reached:?} beyond {bound:?}",
                k + 1
            );
        }
    }
    Ok(())
}

/// What is sampled lies in the range that is reported, to rounding, also where an instant is coarser than a section.
fn samples_lie_within<L: Law>(profile: &L, place: f64) -> Result<(), TestCaseError> {
    let e = profile.extrema();
    let bounds = [e.position, e.velocity, e.acceleration, e.jerk, e.snap];
    let edges =
        sections(profile).into_iter().flat_map(|s| [s.start, s.end, s.start + place * (s.end - s.start)]);
    for t in edges.chain([place * profile.duration()]) {
        for (k, (value, bound)) in orders(profile.sample(t)).into_iter().zip(bounds).enumerate() {
            let slack = 8.0 * f64::EPSILON * bound.magnitude();
            prop_assert!(
                value >= bound.lower.min(0.0) - slack && value <= bound.upper.max(0.0) + slack,
                "order {k} at {t}: {value} beyond {bound:?}"
            );
        }
    }
    Ok(())
}

/// A move is never slower than it must be: it meets one of its limits.
fn meets_a_limit<L: Law>(profile: &L, limits: &Limits, known: usize) -> Result<(), TestCaseError> {
    let scale = scales(profile);
    let bounds = [
        limits.velocity(),
        limits.acceleration(),
        limits.jerk(),
        profiles::Interval::symmetric(limits.snap()),
    ];
    let met = (0..known).any(|k| (scale[k + 1] / bounds[k].upper - 1.0).abs() < 1e-14);
    prop_assert!(met, "{scale:?} within {limits:?}");
    Ok(())
}

/// The end is the target, bit for bit, and nothing on the way lies outside.
fn ends_exactly<L: Law>(profile: &L, distance: f64) -> Result<(), TestCaseError> {
    let end = profile.sample(profile.duration());
    prop_assert_eq!(orders(end), [distance, 0.0, 0.0, 0.0, 0.0]);
    prop_assert_eq!(profile.sample(f64::INFINITY).position, distance);
    prop_assert_eq!(profile.sample(-1.0), profiles::Sample::default());
    let last = sections(profile).last().copied().expect("a section");
    prop_assert!((last.at(last.end).position - distance).abs() <= rounding(profile)[0]);
    Ok(())
}

/// Played backwards from the other end a move is itself.
fn is_symmetric<L: Law>(profile: &L, distance: f64, place: f64) -> Result<(), TestCaseError> {
    let allowed = rounding(profile);
    let t = place * profile.duration();
    let (early, late) = (profile.sample(t), profile.sample(profile.duration() - t));
    prop_assert!((early.position + late.position - distance).abs() <= 2.0 * allowed[0]);
    prop_assert!((early.velocity - late.velocity).abs() <= 2.0 * allowed[1]);
    Ok(())
}

/// The same move in units `length` and `time` times smaller has the same bits, scaled; both are powers of two.
fn is_scale_free<L: Law>(
    distance: f64,
    limits: &Limits,
    l: i32,
    t: i32,
    place: f64,
) -> Result<(), TestCaseError> {
    let (length, time) = (2.0_f64.powi(l), 2.0_f64.powi(t));
    let unit = |k: i32| length / time.powi(k);
    let in_units = |bounds: profiles::Interval, k: i32| {
        profiles::Interval::new(bounds.lower * unit(k), bounds.upper * unit(k))
    };
    let scaled = Limits::UNLIMITED
        .with_velocity(in_units(limits.velocity(), 1))
        .and_then(|s| s.with_acceleration(in_units(limits.acceleration(), 2)))
        .and_then(|s| s.with_jerk(in_units(limits.jerk(), 3)))
        .and_then(|s| s.with_snap(limits.snap() * unit(4)))
        .expect("positive limits");
    let here = L::plan(distance, limits)?;
    let there = L::plan(distance * length, &scaled)?;
    prop_assert_eq!(here.duration() * time, there.duration());
    let at = place * here.duration();
    let (a, b) = (orders(here.sample(at)), orders(there.sample(at * time)));
    for k in 0..5 {
        prop_assert_eq!(a[k] * unit(k as i32), b[k], "order {}", k);
    }
    Ok(())
}

/// A longer time is exact, the end stays, and every derivative shrinks by its power of the ratio.
fn stretches<L: Law>(profile: &L, ratio: f64) -> Result<(), TestCaseError> {
    let duration = profile.duration() * ratio;
    let slow = profile.stretched(duration)?;
    prop_assert_eq!(slow.duration(), duration);
    prop_assert_eq!(slow.sample(duration), profile.sample(profile.duration()));
    is_continuous(&slow)?;
    for (k, (a, b)) in scales(profile).into_iter().zip(scales(&slow)).enumerate() {
        let expected = a / ratio.powi(k as i32);
        prop_assert!((b - expected).abs() <= 1e-13 * expected, "order {k}: {b} instead of {expected}");
    }
    prop_assert!(profile.stretched(profile.duration() * 0.999).is_err());
    Ok(())
}

/// A ramp keeps its speeds in a longer time, and its way grows with it.
fn stretches_as_a_ramp<L: Law>(profile: &L, ratio: f64) -> Result<(), TestCaseError> {
    let duration = profile.duration() * ratio;
    let slow = profile.stretched(duration)?;
    prop_assert_eq!(slow.duration(), duration);
    let (end, before) = (slow.sample(duration), profile.sample(profile.duration()));
    prop_assert_eq!(end.velocity, before.velocity);
    let way = before.position * ratio;
    prop_assert!((end.position - way).abs() <= 4.0 * f64::EPSILON * way.abs(), "{} not {way}", end.position);
    is_continuous(&slow)?;
    for (k, (a, b)) in scales(profile).into_iter().zip(scales(&slow)).enumerate() {
        let expected = a * ratio.powi(1 - k as i32);
        prop_assert!((b - expected).abs() <= 1e-13 * expected, "order {k}: {b} instead of {expected}");
    }
    Ok(())
}

/// All of it for one move.
fn is_sound<L: Law>(distance: f64, limits: &Limits, known: usize, place: f64) -> Result<L, TestCaseError> {
    let profile = L::plan(distance, limits)?;
    is_continuous(&profile)?;
    derives(&profile, place)?;
    keeps_limits(&profile, limits, known)?;
    ends_exactly(&profile, distance)?;
    samples_lie_within(&profile, place)?;
    Ok(profile)
}

/// And what only holds where the limits are symmetric.
fn is_fully_sound<L: Law>(
    distance: f64,
    limits: &Limits,
    known: usize,
    place: f64,
) -> Result<(), TestCaseError> {
    let profile = is_sound::<L>(distance, limits, known, place)?;
    is_symmetric(&profile, distance, place)?;
    meets_a_limit(&profile, limits, known)
}

/// A ramp: both speeds exact, limits kept, everything continuous.
fn ramps<L: Law>(from: f64, to: f64, limits: &Limits, known: usize, place: f64) -> Result<(), TestCaseError> {
    let (from, to) = (from * limits.velocity().upper, to * limits.velocity().upper);
    let profile = L::ramp(from, to, limits)?;
    let start = profile.sample(0.0).velocity;
    prop_assert!(
        (start - from).abs() <= 2.0 * f64::EPSILON * from.abs().max(to.abs()),
        "{start} instead of {from}"
    );
    prop_assert_eq!(profile.sample(profile.duration()).velocity, to);
    prop_assert_eq!(profile.sample(2.0 * profile.duration()).velocity, to);
    if profile.duration() > 0.0 {
        is_continuous(&profile)?;
        derives(&profile, place)?;
        keeps_limits(&profile, limits, known)?;
        // Symmetric about its middle, a ramp covers the mean speed times its duration.
        let way = 0.5 * (from + to) * profile.duration();
        let end = profile.sample(profile.duration()).position;
        prop_assert!((end - way).abs() <= 8.0 * f64::EPSILON * profile.duration() * from.abs().max(to.abs()));
        samples_lie_within(&profile, place)?;
        stretches_as_a_ramp(&profile, 1.0 + 10.0 * place)?;
    }
    Ok(())
}

/// More of any one limit never makes a move longer.
fn is_monotone<L: Law>(distance: f64, limits: &Limits, more: [f64; 4]) -> Result<(), TestCaseError> {
    let mut duration = L::plan(distance, limits)?.duration();
    let mut limit =
        [limits.velocity().upper, limits.acceleration().upper, limits.jerk().upper, limits.snap()];
    for k in 0..4 {
        limit[k] *= more[k];
        let wider =
            Limits::new(limit[0], limit[1], limit[2]).and_then(|l| l.with_snap(limit[3])).expect("limits");
        let shorter = L::plan(distance, &wider)?.duration();
        prop_assert!(
            shorter <= duration * (1.0 + 8.0 * f64::EPSILON),
            "limit {k}: {shorter} after {duration}"
        );
        duration = shorter;
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    #[test]
    fn every_law_is_sound((distance, limits) in a_move(), place in 0.0..1.0) {
        is_fully_sound::<Trapezoid>(distance, &limits, 2, place)?;
        is_fully_sound::<SCurve>(distance, &limits, 3, place)?;
        is_fully_sound::<SnapLimited>(distance, &limits, 4, place)?;
        is_fully_sound::<Cosine>(distance, &limits, 3, place)?;
        is_fully_sound::<FivePhase>(distance, &limits, 3, place)?;
    }

    #[test]
    fn different_bounds_for_the_two_directions_are_sound(
        (distance, limits) in a_move(),
        deceleration in magnitude(0.05, 20.0),
        falling in magnitude(0.05, 20.0),
        place in 0.0..1.0,
    ) {
        let limits = lopsided(&limits, deceleration, falling);
        is_sound::<Trapezoid>(distance, &limits, 2, place)?;
        is_sound::<SCurve>(distance, &limits, 3, place)?;
    }

    #[test]
    fn ramps_are_sound((_, limits) in a_move(), from in -1.0..1.0, to in -1.0..1.0, place in 0.0..1.0) {
        ramps::<Trapezoid>(from, to, &limits, 2, place)?;
        ramps::<SCurve>(from, to, &limits, 3, place)?;
        ramps::<SnapLimited>(from, to, &limits, 4, place)?;
        ramps::<Cosine>(from, to, &limits, 3, place)?;
        ramps::<FivePhase>(from, to, &limits, 3, place)?;
    }

    #[test]
    fn units_of_any_power_of_two_give_the_same_bits(
        (distance, limits) in a_move(),
        length in -60..60,
        time in -30..30,
        place in 0.0..1.2,
    ) {
        is_scale_free::<Trapezoid>(distance, &limits, length, time, place)?;
        is_scale_free::<SCurve>(distance, &limits, length, time, place)?;
        is_scale_free::<SnapLimited>(distance, &limits, length, time, place)?;
        is_scale_free::<Cosine>(distance, &limits, length, time, place)?;
        is_scale_free::<FivePhase>(distance, &limits, length, time, place)?;
        is_scale_free::<SCurve>(distance, &lopsided(&limits, 0.3, 1.7), length, time, place)?;
    }

    #[test]
    fn a_larger_limit_never_lengthens_a_move(
        (distance, limits) in a_move(),
        more in [magnitude(1.0, 10.0), magnitude(1.0, 10.0), magnitude(1.0, 10.0), magnitude(1.0, 10.0)],
    ) {
        is_monotone::<Trapezoid>(distance, &limits, more)?;
        is_monotone::<SCurve>(distance, &limits, more)?;
        is_monotone::<SnapLimited>(distance, &limits, more)?;
        is_monotone::<Cosine>(distance, &limits, more)?;
        is_monotone::<FivePhase>(distance, &limits, more)?;
    }

    #[test]
    fn stretching_keeps_the_path((distance, limits) in balanced_move(), ratio in magnitude(1.0, 100.0)) {
        stretches(&Trapezoid::plan(distance, &limits)?, ratio)?;
        stretches(&SCurve::plan(distance, &limits)?, ratio)?;
        stretches(&SnapLimited::plan(distance, &limits)?, ratio)?;
        stretches(&Cosine::plan(distance, &limits)?, ratio)?;
        stretches(&FivePhase::plan(distance, &limits)?, ratio)?;
    }

    #[test]
    fn trapezoids_start_and_stop_with_their_speeds(
        (distance, limits) in a_move(),
        start in 0.0..1.0,
        stop in 0.0..1.0,
        deceleration in magnitude(0.1, 10.0),
        place in 0.0..1.0,
    ) {
        let limits = lopsided(&limits, deceleration, 1.0);
        let v = limits.velocity().upper;
        // Speeds the distance allows: v^2 <= 2 a d for the weaker of the two accelerations.
        let weaker = limits.acceleration().upper.min(-limits.acceleration().lower);
        let most = v.min((2.0 * weaker * distance.abs()).sqrt());
        let (start, stop) = (start * most, stop * most);
        let profile = Trapezoid::with_speeds(distance, start, stop, &limits)?;
        let allowed = rounding(&profile)[1];
        prop_assert!((profile.sample(0.0).velocity.abs() - start).abs() <= allowed);
        let all = sections(&profile);
        prop_assert_eq!(profile.section(2).expect("section").at(profile.duration()).velocity.abs(), stop);
        prop_assert_eq!(profile.sample(profile.duration()).position, distance);
        derives(&profile, place)?;
        keeps_limits(&profile, &limits, 2)?;
        for pair in all.windows(2) {
            let t = pair[1].start;
            let (a, b) = (pair[0].at(t), pair[1].at(t));
            prop_assert!((a.position - b.position).abs() <= rounding(&profile)[0]);
            prop_assert!((a.velocity - b.velocity).abs() <= allowed);
        }
    }
}
