//! Pulse trains against the position they stand for, their own tables and a brute-force count.
#![expect(clippy::expect_used, reason = "helpers of tests may fail loudly")]
#![expect(clippy::float_cmp, reason = "numbers that must be equal to the bit")]

mod common;

use common::swing::Swing;
use common::{CASES, Law, any_move, balanced_move, lopsided, magnitude};
use profiles::{
    Cosine, Direction, FivePhase, Limits, Profile, Pulse, PulseError, PulseTrain, SCurve, Sectioned,
    SnapLimited, Trapezoid,
};
use proptest::prelude::*;

/// How far the rounded position may be from half a pulse, in pulses: where an instant of rounding `eps T` meets the
/// top speed, in pulses/s, and where a position is rounded itself.
fn slack<P: Sectioned>(train: &PulseTrain<P>) -> f64 {
    let extrema = train.profile().extrema();
    let pulses = extrema.position.magnitude() / train.size();
    32.0 * f64::EPSILON * (pulses + train.peak_frequency() * train.profile().duration()) + 1e-15
}

/// Just before and just after a pulse the position is half a pulse from the sum; the sum is exact in the end.
fn stays_within_half_a_pulse<P: Sectioned>(train: &PulseTrain<P>) -> Result<Vec<Pulse>, TestCaseError> {
    let profile = train.profile();
    let slack = slack(train);
    prop_assert!(slack < 1e-9, "a test of too many pulses");
    let mut sum = 0_i64;
    let mut last = 0.0;
    let pulses: Vec<Pulse> = train.pulses().collect();
    for (k, pulse) in pulses.iter().enumerate() {
        let position = profile.sample(pulse.instant).position / train.size();
        prop_assert!((position - sum as f64).abs() <= 0.5 + slack, "before {k}: {position} {sum}");
        sum += i64::from(pulse.direction.sign());
        prop_assert!((position - sum as f64).abs() <= 0.5 + slack, "after {k}: {position} {sum}");
        prop_assert!(pulse.interval > 0.0 || k == 0, "pulse {k}: {pulse:?}");
        prop_assert_eq!(pulse.interval, pulse.instant - last);
        last = pulse.instant;
    }
    prop_assert!(last <= profile.duration());
    prop_assert_eq!(sum, train.total());
    prop_assert_eq!(train.total(), (profile.after().position / train.size()).round() as i64);
    prop_assert!(train.end_error().abs() <= (0.5 + slack) * train.size());
    Ok(pulses)
}

/// Between two pulses nothing is missed: a dense sampling never leaves the half pulse around the sum.
fn misses_nothing<P: Sectioned>(train: &PulseTrain<P>, pulses: &[Pulse]) -> Result<(), TestCaseError> {
    let (duration, slack) = (train.profile().duration(), slack(train));
    let mut sent = pulses.iter().peekable();
    let mut sum = 0_i64;
    for k in 0..=2000 {
        let t = duration * f64::from(k) / 2000.0;
        while let Some(pulse) = sent.next_if(|pulse| pulse.instant <= t) {
            sum += i64::from(pulse.direction.sign());
        }
        let position = train.profile().sample(t).position / train.size();
        prop_assert!((position - sum as f64).abs() <= 0.5 + slack, "at {t}: {position} {sum}");
    }
    Ok(())
}

/// Counts are the pulses of each tick, but for those within rounding of its end.
fn counts_agree<P: Sectioned>(
    train: &PulseTrain<P>,
    pulses: &[Pulse],
    divisions: f64,
) -> Result<(), TestCaseError> {
    let (duration, slack) = (train.profile().duration(), slack(train));
    let period = duration / divisions;
    let mut sent = pulses.iter().peekable();
    let (mut sum, mut counted) = (0_i64, 0_i64);
    let counts: Vec<i32> = train.counts(period)?.collect();
    prop_assert_eq!(train.counts(period)?.size_hint(), (counts.len(), Some(counts.len())));
    prop_assert!((counts.len() as f64 - divisions).abs() < 1.0 + 1e-9);
    for (k, count) in counts.iter().enumerate() {
        let end = (k + 1) as f64 * period;
        while let Some(pulse) = sent.next_if(|pulse| pulse.instant <= end) {
            sum += i64::from(pulse.direction.sign());
        }
        counted += i64::from(*count);
        let position = train.profile().sample(end.min(duration)).position / train.size();
        let tie = ((position.abs()).fract() - 0.5).abs() <= 2.0 * slack;
        prop_assert!(sum == counted || tie, "tick {k}: {sum} {counted} {position}");
        prop_assert!((position - counted as f64).abs() <= 0.5 + slack);
    }
    prop_assert_eq!(counted, train.total());
    Ok(())
}

/// Periods add up to rounded instants and are never shorter than the drive allows.
fn periods_agree<P: Sectioned>(
    train: &PulseTrain<P>,
    pulses: &[Pulse],
    clock: f64,
) -> Result<(), TestCaseError> {
    let periods = match train.periods(clock) {
        Ok(periods) => periods,
        Err(PulseError::Ticks { ticks, needed }) => {
            prop_assert!(ticks < needed);
            return Ok(());
        }
        Err(other) => return Err(other.into()),
    };
    let periods: Vec<_> = periods.collect();
    prop_assert_eq!(periods.len(), pulses.len());
    let mut elapsed = 0_u64;
    for (k, (period, pulse)) in periods.iter().zip(pulses).enumerate() {
        elapsed += period.ticks;
        let exact = pulse.instant * clock;
        let tie = ((exact.fract()) - 0.5).abs() < 1e-6;
        prop_assert!(elapsed == exact.round() as u64 || tie && (exact - elapsed as f64).abs() < 0.5 + 1e-6);
        prop_assert!(period.ticks >= 1 || k == 0);
        prop_assert_eq!(period.direction, pulse.direction);
    }
    Ok(())
}

fn holds<L: Law>(distance: f64, limits: &Limits, pulses: f64, divisions: f64) -> Result<(), TestCaseError> {
    let profile = L::plan(distance, limits)?;
    let train = PulseTrain::new(&profile, distance.abs() / pulses)?;
    let sent = stays_within_half_a_pulse(&train)?;
    let expected = if distance < 0.0 { Direction::Backward } else { Direction::Forward };
    prop_assert!(sent.iter().all(|pulse| pulse.direction == expected));
    prop_assert_eq!(sent.len() as i64, train.total().abs());
    misses_nothing(&train, &sent)?;
    counts_agree(&train, &sent, divisions)?;
    periods_agree(&train, &sent, 1.5 * train.peak_frequency())?;
    periods_agree(&train, &sent, 997.3 * train.peak_frequency())?;
    // Planned within the highest frequency of the drive it is within it, and just outside it is not.
    let shortest = 1.0 / train.peak_frequency();
    let allowed = train.with_shortest_interval(shortest)?;
    prop_assert!(sent.iter().skip(1).all(|pulse| pulse.interval >= shortest * (1.0 - 1e-9)));
    let beyond = allowed.with_shortest_interval(shortest * (1.0 + 1e-12));
    let told = |e: PulseError| matches!(e, PulseError::TooFast { most, .. } if most * shortest < 1.0);
    prop_assert!(beyond.is_err_and(told));
    let periods = allowed.periods(1000.0 / shortest)?;
    prop_assert!(periods.skip(1).all(|period| period.ticks >= 1000));
    // The other way the same instants.
    let back = L::plan(-distance, &limits.mirrored())?;
    let back = PulseTrain::new(&back, distance.abs() / pulses)?;
    prop_assert!(back.pulses().zip(&sent).all(|(b, a)| b.instant == a.instant && b.direction != a.direction));
    prop_assert_eq!(back.total(), -train.total());
    Ok(())
}

/// Nothing but what must hold whatever the magnitudes are.
fn is_sent<L: Law>(profile: &L, pulses: f64) -> Result<(), TestCaseError> {
    let train = PulseTrain::new(profile, profile.after().position.abs() / pulses)?;
    stays_within_half_a_pulse(&train)?;
    let counts = train.counts(profile.duration() / 9.9)?;
    prop_assert_eq!(counts.map(i64::from).sum::<i64>(), train.total());
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES / 16))]

    #[test]
    fn the_sum_is_exact_and_the_error_below_half_a_pulse(
        (distance, limits) in balanced_move(),
        pulses in prop_oneof![magnitude(0.1, 3000.0), (1_u32..200).prop_map(|k| 0.5 * f64::from(k))],
        divisions in prop_oneof![magnitude(0.3, 300.0), (1_u32..40).prop_map(f64::from)],
    ) {
        holds::<Trapezoid>(distance, &limits, pulses, divisions)?;
        holds::<SCurve>(distance, &limits, pulses, divisions)?;
        holds::<SnapLimited>(distance, &limits, pulses, divisions)?;
        holds::<Cosine>(distance, &limits, pulses, divisions)?;
        holds::<FivePhase>(distance, &limits, pulses, divisions)?;
        holds::<SCurve>(distance, &lopsided(&limits, 0.3, 1.7), pulses, divisions)?;
    }

    #[test]
    fn any_magnitudes_at_all_are_sent((distance, limits) in any_move(), pulses in magnitude(0.1, 100.0)) {
        is_sent(&Trapezoid::plan(distance, &limits)?, pulses)?;
        is_sent(&SCurve::plan(distance, &limits)?, pulses)?;
        is_sent(&SnapLimited::plan(distance, &limits)?, pulses)?;
        is_sent(&Cosine::plan(distance, &limits)?, pulses)?;
        is_sent(&FivePhase::plan(distance, &limits)?, pulses)?;
    }

    #[test]
    fn trapezoids_are_solved_by_hand(
        (distance, limits) in balanced_move(),
        pulses in magnitude(1.0, 3000.0),
        start in 0.01..0.9,
        stop in 0.01..0.9,
    ) {
        let most = limits.velocity().upper.min((2.0 * limits.acceleration().upper * distance.abs()).sqrt());
        let (start, stop) = (start * most, stop * most);
        let profile = Trapezoid::with_speeds(distance, start, stop, &limits)?;
        let size = distance.abs() / pulses;
        let train = PulseTrain::new(&profile, size)?;
        let sent = stays_within_half_a_pulse(&train)?;
        // Ways up, on and down, and the time to a level in each.
        let a = limits.acceleration().upper;
        let speed = profile.extrema().velocity.magnitude();
        let (up, down) = ((speed * speed - start * start) / (2.0 * a), (speed * speed - stop * stop) / (2.0 * a));
        let flat = distance.abs() - up - down;
        for (k, pulse) in sent.iter().enumerate() {
            let way = (k as f64 + 0.5) * size;
            let left = distance.abs() - way;
            let by_hand = if way < up {
                2.0 * way / (start + (start * start + 2.0 * a * way).sqrt())
            } else if left > down {
                (speed - start) / a + (way - up) / speed
            } else {
                profile.duration() - 2.0 * left / (stop + (stop * stop + 2.0 * a * left.max(0.0)).sqrt())
            };
            // The ways cancel where there is no cruise.
            let allowed = 1e-13 * profile.duration() * (1.0 + (up + down + flat.abs()) / (size.min(up + down)));
            prop_assert!((pulse.instant - by_hand).abs() <= allowed, "{k}: {} {by_hand}", pulse.instant);
        }
    }

    #[test]
    fn what_goes_back_is_counted_back(
        pulses in magnitude(0.6, 500.0),
        slope in prop_oneof![Just(0.0), -3.0..3.0],
        half_waves in 1_usize..7,
        divisions in magnitude(1.0, 300.0),
    ) {
        let swing = Swing { distance: 0.02, slope: 0.02 * slope, half_waves };
        let train = PulseTrain::new(swing, 0.02 / pulses)?;
        let sent = stays_within_half_a_pulse(&train)?;
        misses_nothing(&train, &sent)?;
        counts_agree(&train, &sent, divisions)?;
        periods_agree(&train, &sent, 1e7)?;
        let turned = sent.windows(2).filter(|pair| pair[0].direction != pair[1].direction);
        let shortest = turned.map(|pair| pair[1].interval).fold(f64::INFINITY, f64::min);
        if shortest.is_finite() {
            // Near its turn the position is flat, and an instant known to the square root of its rounding.
            let allowed = 1e-9;
            prop_assert!(train.with_reversal_time((shortest - allowed).max(0.0)).is_ok());
            let beyond = train.with_reversal_time(shortest + allowed);
            let told = |e: PulseError| match e {
                PulseError::Reversal { interval, .. } => (interval - shortest).abs() < allowed,
                _ => false,
            };
            prop_assert!(beyond.is_err_and(told));
        } else {
            prop_assert!(train.with_reversal_time(1e9).is_ok());
        }
    }
}

#[test]
fn the_pulse_axis_is_the_published_one() {
    // J. Wu, Y. Zhang 2019: 4000 pulses, start 10 kHz, limit 300 kHz, 10 000 kHz/s; in pulses and seconds.
    let limits = Limits::new(300e3, 1e7, f64::INFINITY).expect("limits");
    let profile = Trapezoid::with_speeds(4000.0, 10e3, 10e3, &limits).expect("plan");
    let train = PulseTrain::new(profile, 1.0).expect("train");
    // 2000 = (f^2 - 10e3^2) / 2e7: the limit is not reached, the peak is sqrt(4.01e10) = 200.2 kHz, at 19.02 ms.
    assert!((train.peak_frequency() - 4.01e10_f64.sqrt()).abs() < 1e-6 && train.peak_frequency() < 200.3e3);
    assert!((profile.duration() - 2.0 * 0.019_025).abs() < 1e-6);
    assert_eq!((train.total(), train.end_error()), (4000, 0.0));
    let sent: Vec<Pulse> = train.pulses().collect();
    assert_eq!(sent.len(), 4000);
    // The first two pulses by hand, (-f0 + sqrt(f0^2 + 2 a k)) / a: half an interval of the start frequency, then one,
    // each shorter by what the axis speeds up meanwhile.
    let by_hand = |level: f64| (-10e3 + (1e8 + 2e7 * level).sqrt()) / 1e7;
    assert!((sent[0].interval - by_hand(0.5)).abs() < 1e-17 && (sent[0].interval - 48.8e-6).abs() < 0.1e-6);
    assert!((sent[1].interval - (by_hand(1.5) - by_hand(0.5))).abs() < 1e-17);
    assert!((sent[1].interval - 91.3e-6).abs() < 0.1e-6, "{}", sent[1].interval);
    // Down as up.
    let last = &sent[3999];
    assert!((profile.duration() - last.instant - sent[0].instant).abs() < 1e-16);
    assert!((last.interval - sent[1].interval).abs() < 1e-15);
    // At 72 MHz no period is shorter than 359 ticks, 72e6 / 200.2e3 = 359.6.
    let periods: Vec<u64> = train.periods(72e6).expect("clock").map(|p| p.ticks).collect();
    assert_eq!(periods.iter().copied().min(), Some(359));
    assert_eq!(periods.iter().sum::<u64>(), (last.instant * 72e6).round() as u64);
    assert_eq!(train.counts(1e-4).expect("clock").map(i64::from).sum::<i64>(), 4000);
    assert!(train.with_shortest_interval(1.0 / 300e3).is_ok());
    assert!(matches!(
        train.with_shortest_interval(1.0 / 200e3),
        Err(PulseError::TooFast { frequency, most }) if (frequency - 200_249.8).abs() < 0.1 && (most - 200e3).abs() < 1e-6
    ));
}

#[test]
fn moves_in_a_row_keep_the_spacing() {
    // Start and stop at 1 kHz without a ramp: every interval is 1 ms, across the joint too.
    let limits = Limits::new(1.0, 10.0, f64::INFINITY).expect("limits");
    let profile = Trapezoid::with_speeds(0.1, 1.0, 1.0, &limits).expect("plan");
    let train = PulseTrain::new(profile, 1e-3).expect("train");
    let sent: Vec<Pulse> = train.pulses().collect();
    assert_eq!(sent.len(), 100);
    assert!((sent[0].interval - 0.5e-3).abs() < 1e-17);
    assert!(sent[1..].iter().all(|pulse| (pulse.interval - 1e-3).abs() < 1e-16));
    assert!((profile.duration() - sent[99].instant - 0.5e-3).abs() < 1e-16);
    // Every instant half way between two ticks of 1 kHz: still one tick a pulse, never none or two.
    assert!(train.periods(1e3).expect("clock").skip(1).all(|period| period.ticks == 1));
}

#[test]
fn what_is_no_whole_pulse_is_told() {
    let limits = Limits::new(1.0, 10.0, 100.0).expect("limits");
    for (distance, total, left) in
        [(2.4, 2, 0.4), (2.5, 3, -0.5), (-2.5, -3, 0.5), (0.3, 0, 0.3), (0.0, 0, 0.0)]
    {
        let profile = SCurve::rest_to_rest(distance, &limits).expect("plan");
        let train = PulseTrain::new(profile, 1.0).expect("train");
        assert_eq!(train.total(), total);
        assert!((train.end_error() - left).abs() < 1e-15);
        assert_eq!(train.pulses().count() as i64, total.abs());
        assert_eq!(train.counts(0.01).expect("clock").map(i64::from).sum::<i64>(), total);
        // Half a pulse at the very end is sent at the very end.
        if (distance.abs() - 2.5).abs() < 0.01 {
            assert!(train.pulses().last().is_some_and(|p| p.instant == profile.duration()));
        }
    }
}

#[test]
fn a_crossing_that_is_only_touched_is_not_sent() {
    let sent = |pulses: f64| {
        let swing = Swing { distance: pulses, slope: 0.0, half_waves: 2 };
        PulseTrain::new(swing, 1.0).expect("train").pulses().count()
    };
    // There and back: the last pulse is sent and taken back, or neither.
    assert_eq!((sent(20.4), sent(20.5 - 1e-12), sent(20.5)), (40, 40, 40));
    assert_eq!((sent(20.5 + 1e-12), sent(20.6), sent(21.0)), (42, 42, 42));
    // What is that near is refused by a drive that needs time to turn: 2 acos(1 - 2e-12 / 20.5) / pi for a cosine.
    let swing = Swing { distance: 20.5 + 1e-12, slope: 0.0, half_waves: 2 };
    let train = PulseTrain::new(swing, 1.0).expect("train");
    assert!(matches!(
        train.with_reversal_time(1e-6),
        // The rounding of 20.5, 4e-15, is 0.4 % of 1e-12 and 0.2 % of its root; that of an instant less.
        Err(PulseError::Reversal { interval, .. }) if (interval / 2.81e-7 - 1.0).abs() < 0.01
    ));
}

#[test]
fn velocity_ramps_are_sent_until_they_end() {
    let limits = Limits::new(1.0, 10.0, 100.0).expect("limits");
    let ramp = SCurve::velocity_ramp(-0.5, 0.8, &limits).expect("plan");
    let train = PulseTrain::new(&ramp, 1e-3).expect("train");
    let sent = stays_within_half_a_pulse(&train).expect("holds");
    assert!(sent[0].direction == Direction::Backward && (sent[0].interval - 1e-3).abs() < 1e-5);
    assert!(sent.iter().any(|pulse| pulse.direction == Direction::Forward));
}

#[test]
fn bad_requests_are_named_with_their_number() {
    let limits = Limits::new(1.0, 10.0, 100.0).expect("limits");
    let profile = SCurve::rest_to_rest(1.0, &limits).expect("plan");
    assert_eq!(PulseTrain::new(profile, 0.0), Err(PulseError::Size(0.0)));
    assert!(matches!(PulseTrain::new(profile, f64::NAN), Err(PulseError::Size(size)) if size.is_nan()));
    assert!(matches!(PulseTrain::new(profile, 1e-13), Err(PulseError::TooManyPulses { .. })));
    let train = PulseTrain::new(profile, 1e-3).expect("train");
    assert_eq!(train.with_shortest_interval(-1.0), Err(PulseError::Interval(-1.0)));
    assert!(matches!(train.with_reversal_time(f64::INFINITY), Err(PulseError::Interval(_))));
    assert!(matches!(train.periods(0.0), Err(PulseError::Frequency(f)) if f == 0.0));
    assert!(matches!(train.periods(1e300), Err(PulseError::Clock(_))));
    // One pulse a millisecond at top speed.
    assert!(
        matches!(train.periods(900.0), Err(PulseError::Ticks { ticks, needed }) if (ticks, needed) == (0.0, 1.0))
    );
    let allowed = train.with_shortest_interval(1e-3).expect("drive");
    assert!(matches!(allowed.periods(1500.0), Err(PulseError::Ticks { ticks, .. }) if ticks == 1.0));
    assert!(matches!(train.counts(-1.0), Err(PulseError::Clock(_))));
    let fine = PulseTrain::new(profile, 1e-11).expect("train");
    assert!(matches!(fine.counts(1.0), Err(PulseError::CountRange { pulses }) if pulses > 1e9));
}
