//! The five-phase curve against the equations of its paper, and as a step through two equal averages.
#![expect(clippy::expect_used, reason = "helpers of tests may fail loudly")]
#![expect(clippy::float_cmp, reason = "numbers that must be equal to the bit")]

mod common;

use common::{CASES, magnitude, orders, rounding, scales, sections};
use profiles::{Complex, Cursor, FivePhase, Profile, Sectioned, transform, write_csv};
use proptest::prelude::*;

/// The curve of the paper: start speed, jerk, phase time, cruise time.
#[derive(Debug, Clone, Copy)]
struct Paper {
    start: f64,
    jerk: f64,
    phase: f64,
    cruise: f64,
}

impl Paper {
    /// Eq. (6).
    fn acceleration(&self, t: f64) -> f64 {
        let (j, p, u) = (self.jerk, self.phase, t - self.cruise);
        if t < p {
            j * t
        } else if t < 2.0 * p {
            2.0 * j * p - j * t
        } else if u < 2.0 * p {
            0.0
        } else if u < 3.0 * p {
            2.0 * j * p - j * u
        } else {
            -4.0 * j * p + j * u
        }
    }

    /// Eq. (7), its fourth and fifth row as eq. (6) integrates.
    fn velocity(&self, t: f64) -> f64 {
        let (v, j, p, u) = (self.start, self.jerk, self.phase, t - self.cruise);
        if t < p {
            v + 0.5 * j * t * t
        } else if t < 2.0 * p {
            v - j * p * p + 2.0 * j * p * t - 0.5 * j * t * t
        } else if u < 2.0 * p {
            v + j * p * p
        } else if u < 3.0 * p {
            v - j * p * p + 2.0 * j * p * u - 0.5 * j * u * u
        } else {
            v + 8.0 * j * p * p - 4.0 * j * p * u + 0.5 * j * u * u
        }
    }

    fn duration(&self) -> f64 {
        4.0 * self.phase + self.cruise
    }

    fn plan(&self) -> FivePhase {
        FivePhase::new(self.start, self.jerk, self.phase, self.cruise).expect("plan")
    }

    /// Larger than any speed that is added up on the way.
    fn speed(&self) -> f64 {
        self.start.abs() + self.jerk.abs() * self.duration() * self.duration()
    }
}

fn paper() -> impl Strategy<Value = Paper> {
    let signed = |m: std::ops::Range<f64>| {
        (magnitude(m.start, m.end), any::<bool>()).prop_map(|(x, n)| if n { -x } else { x })
    };
    let cruise = prop_oneof![Just(0.0), magnitude(1e-2, 1e1)];
    (prop_oneof![Just(0.0), signed(1e-3..1e3)], signed(1e-3..1e5), magnitude(1e-2, 1e1), cruise)
        .prop_map(|(start, jerk, phase, cruise)| Paper { start, jerk, phase, cruise })
}

/// The instants at which the law changes.
fn joints(p: &Paper) -> [f64; 6] {
    let down = 2.0 * p.phase + p.cruise;
    [0.0, p.phase, 2.0 * p.phase, down, down + p.phase, down + 2.0 * p.phase]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    #[test]
    fn it_is_the_velocity_of_the_paper(p in paper(), place in 0.0..1.0) {
        let profile = p.plan();
        let t = place * p.duration();
        let sample = profile.sample(t);
        // Terms as large as the jerk times the squared duration cancel in the formulas.
        let allowed = 32.0 * f64::EPSILON * p.speed();
        let expected = p.velocity(t);
        prop_assert!((sample.velocity - expected).abs() <= allowed, "{} {expected}", sample.velocity);
        let allowed = 32.0 * f64::EPSILON * p.jerk.abs() * p.duration();
        prop_assert!((sample.acceleration - p.acceleration(t)).abs() <= allowed);
        prop_assert!((profile.duration() - p.duration()).abs() <= 4.0 * f64::EPSILON * p.duration());
    }

    #[test]
    fn the_velocity_of_the_paper_integrates_its_acceleration(p in paper(), place in 0.0..1.0) {
        // The trapezoidal rule is exact for what is linear between the joints; so is Simpson's for the velocity.
        let end = place * p.duration();
        let (mut velocity, mut position) = (p.start, 0.0);
        for pair in joints(&p).windows(2) {
            let (from, to) = (pair[0].min(end), pair[1].min(end));
            // Just inside, where the piece is the one meant.
            let inside = 1e-9 * (to - from);
            let (first, last) = (p.acceleration(from + inside), p.acceleration(to - inside));
            let slope = (last - first) / (to - from - 2.0 * inside);
            if to > from {
                let (a, length) = (first - slope * inside, to - from);
                let middle = velocity + a * 0.5 * length + slope * length * length / 8.0;
                let next = velocity + a * length + 0.5 * slope * length * length;
                position += length / 6.0 * (velocity + 4.0 * middle + next);
                velocity = next;
            }
        }
        // The slope is a quotient over the length of a piece, to 1e-9 of what cancels in it.
        let allowed = 1e-7 * p.speed();
        prop_assert!((velocity - p.velocity(end)).abs() <= allowed, "{velocity} {}", p.velocity(end));
        let sampled = p.plan().sample(end).position;
        prop_assert!((position - sampled).abs() <= allowed * p.duration(), "{position} {sampled}");
    }

    #[test]
    fn it_is_a_step_through_two_equal_averages(p in paper(), phase in magnitude(1e-3, 1e2), damping in 0.0..2.0) {
        // v(s) s = v_s (1 - e^(-s D)) + (v - v_s) ((1 - e^(-s T)) / (s T))^2 (1 - e^(-s (D - 2 T))).
        let s = Complex::new(damping, 1.0) * (phase / p.phase);
        let profile = p.plan();
        let d = p.duration();
        let step = |t: f64| 1.0 - (-s * t).exp();
        let average = step(p.phase) / (s * p.phase);
        let dv = p.jerk * p.phase * p.phase;
        let expected = p.start * step(d) + dv * average * average * step(d - 2.0 * p.phase);
        let found = transform(&profile, s);
        // Rounding of the phase at the end, and the average's own, which cancels where s T is small.
        let speed = f64::EPSILON * (2.0 * p.start.abs() + dv.abs());
        let angle = s.norm() * p.phase;
        let allowed = (64.0 + 8.0 * s.norm() * d + 4.0 / angle) * speed;
        prop_assert!((found - expected).norm() <= allowed, "{found} {expected} {allowed}");
        // And the ramp is the step alone, whatever the speed it starts with.
        let ramp = FivePhase::ramp_with_jerk(p.start, p.jerk, p.phase).expect("plan");
        let (found, expected) = (transform(&ramp, s), dv * average * average);
        let allowed = (64.0 + 8.0 * angle + 4.0 / angle) * speed;
        prop_assert!((found - expected).norm() <= allowed, "{found} {expected} {allowed}");
    }

    #[test]
    fn every_way_to_plan_it_is_the_same(p in paper()) {
        let profile = p.plan();
        let close = |a: f64, b: f64, scale: f64| (a - b).abs() <= 16.0 * f64::EPSILON * scale;
        prop_assert_eq!(profile.start_speed(), p.start);
        prop_assert_eq!(profile.jerk(), p.jerk);
        prop_assert_eq!(profile.phase_time(), p.phase);
        prop_assert!(close(profile.cruise_time(), p.cruise, p.duration()));
        let peak = profile.peak_velocity();
        prop_assert!(close(peak, p.start + p.jerk * p.phase * p.phase, p.speed()));
        let by_peak = FivePhase::with_peak_velocity(p.start, peak, p.phase, p.cruise)?;
        prop_assert!(close(by_peak.jerk(), p.jerk, p.speed() / (p.phase * p.phase)));
        let by_duration = FivePhase::with_duration(p.start, p.jerk, p.phase, p.duration())?;
        prop_assert!(close(by_duration.cruise_time(), p.cruise, 4.0 * p.duration()));
        prop_assert!(close(by_duration.duration(), p.duration(), p.duration()));
        let target = profile.sample(f64::INFINITY).position;
        if p.start * p.jerk >= 0.0 {
            // A little farther, so that rounding does not make the distance too short.
            let distance = target * (1.0 + 1e-12);
            let over = FivePhase::over_distance(distance, p.start.abs(), peak.abs(), p.phase)?;
            prop_assert_eq!(over.sample(over.duration()).position, distance);
            prop_assert!((over.duration() - p.duration()).abs() <= 1e-11 * p.duration());
            prop_assert!(close(over.jerk(), p.jerk, p.speed() / (p.phase * p.phase)));
        }
        let ramp = FivePhase::ramp_between(p.start, peak, p.phase)?;
        prop_assert!(close(ramp.jerk(), p.jerk, p.speed() / (p.phase * p.phase)));
        prop_assert_eq!(ramp.duration(), 2.0 * p.phase);
        prop_assert_eq!(ramp.peak_velocity(), peak);
        let (a, b) = (ramp.sample(1.3 * p.phase).velocity, profile.sample(1.3 * p.phase).velocity);
        prop_assert!(close(a, b, p.speed()));
    }

    #[test]
    fn with_speeds_it_jumps_and_is_continuous_between(p in paper(), ratio in magnitude(1.0, 100.0)) {
        let profile = p.plan();
        let allowed = rounding(&profile);
        // Where the jerk turns the speed about, the extrema see no larger speed than the sections are made of.
        let slack = 16.0 * f64::EPSILON * p.speed();
        for pair in sections(&profile).windows(2) {
            let t = pair[1].start;
            let (left, right) = (orders(pair[0].at(t)), orders(pair[1].at(t)));
            for (k, (a, b)) in left.into_iter().zip(right).take(3).enumerate() {
                let more = slack * [p.duration(), 1.0, 1.0 / p.phase][k];
                prop_assert!((a - b).abs() <= allowed[k] + more, "order {k} at {t}: {a} {b}");
            }
        }
        prop_assert_eq!(orders(profile.sample(-1e-9)), [0.0; 5]);
        prop_assert_eq!(profile.sample(0.0).velocity, p.start);
        let last = profile.section(4).expect("section");
        prop_assert_eq!(last.at_local(last.local_ends().1).velocity, p.start);
        prop_assert_eq!(profile.sample(profile.duration()).velocity, 0.0);
        // Slower, it is the five-phase curve of the slower parameters.
        let slow = profile.stretched_to(ratio * profile.duration())?;
        let ends = [&slow, &profile].map(|p| p.sample(p.duration()).position);
        prop_assert_eq!(ends[0], ends[1]);
        for (found, expected) in [
            (slow.start_speed(), p.start / ratio),
            (slow.jerk(), p.jerk / ratio.powi(3)),
            (slow.phase_time(), p.phase * ratio),
            (slow.cruise_time(), profile.cruise_time() * ratio),
            (slow.peak_velocity(), profile.peak_velocity() / ratio),
        ] {
            prop_assert!((found - expected).abs() <= 1e-14 * expected.abs(), "{found} {expected}");
        }
    }
}

#[test]
fn the_curve_of_the_paper() {
    // J = 38 564 pulse/s^3, T = 1.062 s: constant speed from 2.124 s at 43 490 pulse/s, all as printed.
    let profile = FivePhase::new(0.0, 38_564.0, 1.062, 2.0).expect("plan");
    let [_, _, cruise, ..] = sections(&profile)[..] else { unreachable!("five sections") };
    assert!((cruise.start - 2.124).abs() < 1e-15);
    // Three more digits than the phase time has.
    assert!((profile.peak_velocity() / 43_490.0 - 1.0).abs() < 1e-3);
    // The first zero of its spectrum, 1 / T, lies beside the 1.177 Hz of the belt.
    let at = |hz: f64| transform(&profile, Complex::new(0.0, std::f64::consts::TAU * hz)).norm();
    assert!(at(1.0 / 1.062) < 1e-9 * profile.peak_velocity());
    assert!(at(1.177) > 1e-3 * profile.peak_velocity());
}

#[test]
fn it_is_ticked_and_written_like_any_law() {
    let profile = FivePhase::over_distance(-0.5, 0.05, 0.2, 0.25).expect("plan");
    let mut cursor = Cursor::<_, f32>::new(profile, 1e-3).expect("clock");
    let mut largest = 0.0_f32;
    for k in 0..2000 {
        let (ticked, sampled) = (cursor.tick(), profile.sample(f64::from(k) * 1e-3));
        largest = largest.max((ticked.velocity - sampled.velocity as f32).abs());
    }
    // Single precision of 0.2 m/s, and a millisecond's rounding of the instants at its jumps.
    assert!(largest < 8.0 * f32::EPSILON * 0.2, "{largest}");
    let mut text = String::new();
    write_csv(&profile, 0.5, "m", &mut text).expect("a string takes everything");
    assert!(
        text.starts_with("time [s],position [m]")
            && text.lines().last().is_some_and(|l| l.contains(",-0.5,0,"))
    );
}

#[test]
fn no_jerk_is_the_start_speed() {
    let profile = FivePhase::new(0.5, 0.0, 1.0, 2.0).expect("plan");
    assert!((profile.sample(6.0).position - 3.0).abs() <= 0.0 && scales(&profile)[2] <= 0.0);
    assert!(profile.response(Complex::new(-1.0, 4.0)).norm() > 0.1);
    let nothing = FivePhase::new(0.0, 0.0, 1.0, 2.0).expect("plan");
    assert!(nothing.response(Complex::new(-1.0, 4.0)).norm() <= 0.0);
}
