//! A shaped profile as sections: what a cursor, a pulse train and another train see of it.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]
#![expect(clippy::float_cmp, reason = "ends that must be equal to the bit")]

use profiles::{
    Cosine, Cursor, Extrema, Interval, Limits, Mode, Profile, PulseError, PulseTrain, Real, SCurve, Sample,
    Section, Sectioned, SnapLimited, Trapezoid, residual_vibration,
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

/// Filters with positive impulses and with a negative one.
fn filter() -> impl Strategy<Value = DelayFilter> {
    (1.0..20.0, 0.0..0.3, prop_oneof![0.3..0.7, 0.1..0.9_f64]).prop_map(|(hz, z, turns)| {
        let mode = Mode::from_hz(hz, z).expect("mode");
        DelayFilter::new(mode, turns * mode.damped_period()).expect("filter")
    })
}

fn orders(s: Sample) -> [f64; 5] {
    [s.position, s.velocity, s.acceleration, s.jerk, s.snap]
}

fn scales(e: Extrema) -> [f64; 5] {
    [e.position, e.velocity, e.acceleration, e.jerk, e.snap].map(Interval::magnitude)
}

/// What rounding may do to each order of a sum of copies: a few units of the copies' own scale, and the next order times
/// the rounding of an instant.
fn rounding<P: Sectioned>(profile: &P, filter: &DelayFilter, duration: f64) -> [f64; 5] {
    let gain: f64 = filter.amplitudes().iter().map(|a| a.abs()).sum();
    let scale = scales(profile.extrema());
    let w = profile.section(0).map_or(0.0, |section| section.angular_frequency);
    std::array::from_fn(|k| {
        // That of the snap of a sine is its angular frequency times the snap.
        let next = scale.get(k + 1).copied().unwrap_or(w * scale[4]);
        32.0 * f64::EPSILON * gain * (scale[k] + next * duration)
    })
}

fn sections<P: Sectioned>(profile: &P) -> Vec<Section> {
    (0..).map_while(|k| profile.section(k)).collect()
}

/// Sections follow each other without a gap, each says what the sum of the copies says, and all are found by time.
fn sections_are_the_motion<P: Sectioned>(profile: P, filter: &DelayFilter) -> Result<(), TestCaseError> {
    let shaped = Shaped::new(&profile, *filter.train());
    let sections = sections(&shaped);
    let allowed = rounding(&profile, filter, shaped.duration());
    prop_assert_eq!(sections[0].start, 0.0);
    prop_assert_eq!(sections[sections.len() - 1].end, shaped.duration());
    prop_assert!(sections.windows(2).all(|pair| pair[0].end == pair[1].start && pair[0].start < pair[0].end));
    for section in &sections {
        // Boundaries that are one but for rounding leave a section where a derivative may be either of two.
        if section.length() < 1e-12 * shaped.duration() {
            continue;
        }
        for place in [0.01, 0.3, 0.77, 0.99] {
            let t = section.start + place * section.length();
            prop_assert_eq!(shaped.section_at(t), Some(*section));
            for (k, (a, b)) in orders(section.at(t)).into_iter().zip(orders(shaped.sample(t))).enumerate() {
                prop_assert!(
                    (a - b).abs() <= allowed[k],
                    "order {k} at {t}: {a} {b}, allowed {}",
                    allowed[k]
                );
            }
        }
    }
    prop_assert_eq!(shaped.section_at(-1.0), Some(sections[0]));
    prop_assert_eq!(shaped.section_at(shaped.duration()), None);
    Ok(())
}

/// A cursor ticks the samples and ends at the target, to the bit.
fn cursors_reach_the_target<P: Sectioned, F: Real>(
    profile: P,
    filter: &DelayFilter,
    divisions: f64,
) -> Result<(), TestCaseError> {
    let shaped = Shaped::new(&profile, *filter.train());
    let period = shaped.duration() / divisions;
    let mut cursor = Cursor::<_, F>::new(&shaped, period)?;
    let gain: f64 = filter.amplitudes().iter().map(|a| a.abs()).sum();
    let scale = scales(profile.extrema());
    let allowed = 16.0 * F::EPSILON.to_f64() * gain * (scale[0] + scale[1] * shaped.duration());
    while !cursor.is_finished() {
        let t = cursor.next_tick() as f64 * period;
        let (ticked, sampled) = (cursor.tick().position.to_f64(), shaped.sample(t).position);
        prop_assert!((ticked - sampled).abs() <= allowed, "{ticked} {sampled} at {t}, allowed {allowed}");
    }
    prop_assert!((cursor.next_tick() as f64 - divisions).abs() < 1.0 + 1e-9);
    let end = cursor.tick();
    prop_assert_eq!(end.position, F::from_f64(profile.after().position));
    prop_assert_eq!((end.velocity, end.acceleration), (F::ZERO, F::ZERO));
    Ok(())
}

/// Pulses add up to the distance, stay within half a pulse, and agree with counts and periods.
fn pulses_add_up<P: Sectioned>(profile: P, filter: &DelayFilter, pulses: f64) -> Result<(), TestCaseError> {
    let shaped = Shaped::new(&profile, *filter.train());
    let size = profile.after().position.abs() / pulses;
    let train = PulseTrain::new(&shaped, size)?;
    // An instant is rounded to its own size, a position to that of the copies.
    let slack = rounding(&profile, filter, shaped.duration())[0] / size;
    prop_assert!(slack < 1e-9);
    let (mut sum, mut last) = (0_i64, 0.0);
    for pulse in train.pulses() {
        let position = shaped.sample(pulse.instant).position / size;
        prop_assert!((position - sum as f64).abs() <= 0.5 + slack, "{position} {sum}");
        sum += i64::from(pulse.direction.sign());
        prop_assert!((position - sum as f64).abs() <= 0.5 + slack, "{position} {sum}");
        prop_assert!(pulse.instant >= last);
        last = pulse.instant;
    }
    prop_assert_eq!(sum, (profile.after().position / size).round() as i64);
    prop_assert_eq!(train.counts(shaped.duration() / 77.7)?.map(i64::from).sum::<i64>(), sum);
    // Between the pulses none is missing.
    let mut sent = train.pulses().peekable();
    let mut sum = 0_i64;
    for k in 0..=1000 {
        let t = shaped.duration() * f64::from(k) / 1000.0;
        while let Some(pulse) = sent.next_if(|pulse| pulse.instant <= t) {
            sum += i64::from(pulse.direction.sign());
        }
        prop_assert!((shaped.sample(t).position / size - sum as f64).abs() <= 0.5 + slack);
    }
    match train.periods(1e9) {
        Ok(periods) => {
            let sent: Vec<_> = train.pulses().collect();
            let ticks: u64 = periods.map(|period| period.ticks).sum();
            prop_assert!((ticks as f64 - sent.last().map_or(0.0, |p| p.instant) * 1e9).abs() < 0.5 + 1e-3);
        }
        // Only a turn just beyond a crossing can be that fast.
        Err(error) => {
            let turned = matches!(error, PulseError::Ticks { .. });
            prop_assert!(turned && train.with_reversal_time(1e-9).is_err());
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn sections_say_what_the_sum_of_the_copies_says(limits in limits(), filter in filter()) {
        sections_are_the_motion(Trapezoid::rest_to_rest(1.0, &limits)?, &filter)?;
        sections_are_the_motion(SCurve::rest_to_rest(-1.0, &limits)?, &filter)?;
        sections_are_the_motion(SnapLimited::rest_to_rest(1.0, &limits)?, &filter)?;
        sections_are_the_motion(Cosine::rest_to_rest(1.0, &limits)?, &filter)?;
    }

    #[test]
    fn a_cursor_over_a_shaped_profile_ends_at_the_target(
        limits in limits(),
        filter in filter(),
        divisions in prop_oneof![1.0..40.0, 40.0..400.0, (1_u32..100).prop_map(f64::from)],
    ) {
        cursors_reach_the_target::<_, f64>(Trapezoid::rest_to_rest(1.0, &limits)?, &filter, divisions)?;
        cursors_reach_the_target::<_, f64>(SCurve::rest_to_rest(-0.7, &limits)?, &filter, divisions)?;
        cursors_reach_the_target::<_, f32>(SnapLimited::rest_to_rest(0.3, &limits)?, &filter, divisions)?;
        cursors_reach_the_target::<_, f32>(Cosine::rest_to_rest(0.1, &limits)?, &filter, divisions)?;
        cursors_reach_the_target::<_, f64>(Cosine::rest_to_rest(0.1, &limits)?, &filter, divisions)?;
    }

    #[test]
    fn pulses_of_a_shaped_profile_add_up(
        limits in limits(),
        filter in filter(),
        pulses in prop_oneof![(0.1_f64.ln()..2000.0_f64.ln()).prop_map(f64::exp), (1_u32..100).prop_map(|k| 0.5 * f64::from(k))],
    ) {
        pulses_add_up(Trapezoid::rest_to_rest(1.0, &limits)?, &filter, pulses)?;
        pulses_add_up(Trapezoid::with_speeds(1.0, 0.1 * limits.velocity().upper, 0.05, &limits)?, &filter, pulses)?;
        pulses_add_up(SCurve::rest_to_rest(-0.7, &limits)?, &filter, pulses)?;
        pulses_add_up(SnapLimited::rest_to_rest(0.3, &limits)?, &filter, pulses)?;
        pulses_add_up(Cosine::rest_to_rest(0.1, &limits)?, &filter, pulses)?;
    }

    #[test]
    fn what_is_shaped_can_be_shaped_again(limits in limits(), first in filter(), second in filter()) {
        let profile = Cosine::rest_to_rest(1.0, &limits)?;
        let twice = Shaped::new(Shaped::new(profile, *first.train()), *second.train());
        let once = Shaped::new(profile, first.train().convolved::<3, 9>(second.train())?);
        prop_assert!((twice.duration() - once.duration()).abs() < 1e-15 * once.duration() * 4.0);
        let gain = |f: &DelayFilter| f.amplitudes().iter().map(|a| a.abs()).sum::<f64>();
        let scale = scales(profile.extrema());
        let allowed = 64.0 * f64::EPSILON * gain(&first) * gain(&second) * (scale[0] + scale[1] * once.duration());
        for k in 0..=100 {
            let t = once.duration() * f64::from(k) / 100.0;
            prop_assert!((twice.sample(t).position - once.sample(t).position).abs() <= allowed);
            if let Some(section) = twice.section_at(t) {
                prop_assert!((section.at(t).position - once.sample(t).position).abs() <= allowed);
            }
        }
        prop_assert_eq!(twice.after().position, 1.0);
    }
}

#[test]
fn the_published_pulse_axis_is_sent_through_its_filter() {
    // J. Wu, Y. Zhang 2019: 4000 pulses, from 10 kHz, at most 300 kHz, 10 000 kHz/s; a filter of 20 ms for the pole with
    // 0.2123 times 117 1/s and 104.8 rad/s.
    let limits = Limits::new(300e3, 1e7, f64::INFINITY).expect("limits");
    let profile = Trapezoid::with_speeds(4000.0, 10e3, 10e3, &limits).expect("plan");
    let (decay, damped) = (0.2123 * 117.0, 104.8_f64);
    let w = damped.hypot(decay);
    let mode = Mode::new(w, decay / w).expect("mode");
    let shaped = Shaped::new(profile, *DelayFilter::positive(mode, 0.02).expect("filter").train());
    assert!(residual_vibration(&profile, mode) > 100.0 && residual_vibration(&shaped, mode) < 1e-11);
    assert!((shaped.duration() - profile.duration() - 0.04).abs() < 1e-15);
    // The filter never asks for more than the drive takes, and starts with its share of the start frequency.
    let train = PulseTrain::new(&shaped, 1.0).expect("train");
    let train = train.with_shortest_interval(1.0 / 300e3).expect("drive");
    let first = DelayFilter::positive(mode, 0.02).expect("filter").amplitudes()[0];
    assert!((shaped.sample(0.0).velocity - first * 10e3).abs() < 1e-9);
    let sent: Vec<_> = train.pulses().collect();
    assert_eq!((sent.len(), train.total()), (4000, 4000));
    // The first one by hand: first (f0 t + a t^2 / 2) = 1/2.
    let by_hand = (-10e3 + (1e8 + 1e7 / first).sqrt()) / 1e7;
    assert!((sent[0].instant - by_hand).abs() < 1e-17);
    let ticks: u64 = train.periods(72e6).expect("clock").map(|period| period.ticks).sum();
    assert_eq!(ticks, (sent[3999].instant * 72e6).round() as u64);
}

#[test]
fn ramps_count_from_their_start_and_go_on_from_their_end() {
    let limits = Limits::new(1.0, 4.0, 40.0).expect("limits");
    let mode = Mode::from_hz(5.0, 0.1).expect("mode");
    let train = *DelayFilter::zvd(mode).expect("filter").train();
    for (from, to) in [(0.0, 0.8), (0.8, -0.3), (-0.4, 0.0)] {
        let ramp = SCurve::velocity_ramp(from, to, &limits).expect("plan");
        let shaped = Shaped::new(ramp, train);
        assert!(
            shaped.sample(0.0).position.abs() < 1e-16 && (shaped.sample(0.0).velocity - from).abs() < 1e-15
        );
        assert!((shaped.sample(-2.0).position + 2.0 * from).abs() < 1e-15);
        let (end, after) = (shaped.duration(), shaped.after());
        let last = shaped.sample(end * (1.0 - 1e-15));
        assert!(
            (last.position - after.position).abs() < 1e-14 && (last.velocity - after.velocity).abs() < 1e-13
        );
        for k in 0..200 {
            let t = end * f64::from(k) / 200.0;
            let section = shaped.section_at(t).expect("section");
            assert!((section.at(t).position - shaped.sample(t).position).abs() < 1e-14);
            assert!((section.at(t).velocity - shaped.sample(t).velocity).abs() < 1e-14);
        }
        // The way is the integral of the velocity, by Simpson's rule over 4000 steps.
        let velocity = |k: i32| shaped.sample(end * f64::from(k) / 4000.0).velocity;
        let simpson = |k: i32| velocity(2 * k) + 4.0 * velocity(2 * k + 1) + velocity(2 * k + 2);
        let way = (0..2000).map(simpson).sum::<f64>() * end / 12_000.0;
        assert!((way - after.position).abs() < 1e-9, "{way} {}", after.position);
        assert!((shaped.sample(end + 1.0).position - after.position - to).abs() < 1e-15);
        assert!(
            shaped.sample(f64::INFINITY).position.is_finite() && shaped.sample(f64::NAN).position.is_finite()
        );
        assert!(residual_vibration(&shaped, mode) < 1e-15);
    }
}
