//! What the drives get: coordinates and pulses.

use profiles::nurbs::{FeedInterpolator, FeedLimits, NurbsCurve};
use profiles::{Profile, PulseTrain};

use crate::checks::{drawing, limits, spatial};

/// A pulse, m.
const PULSE: f64 = 1e-6;

/// Checks the list of a feed and the pulses of every axis, counted `parts` times a period.
fn gets<const D: usize>(curve: NurbsCurve<D>, limits: FeedLimits<D>, parts: u32) {
    let feed = FeedInterpolator::new(curve, limits).expect("feed");
    let list = feed.coordinates().expect("clock");
    let samples: Vec<_> = feed.ticks().expect("clock").collect();
    assert_eq!(list.points().len(), samples.len());
    for ((sample, point), velocity) in samples.iter().zip(list.points()).zip(list.velocities()) {
        assert_eq!((sample.position, sample.velocity), (*point, *velocity));
    }
    let (Some(first), Some(last)) = (list.points().first(), list.points().last()) else {
        panic!("no points")
    };
    assert_eq!((*first, *last), (feed.curve().start(), feed.curve().end()));

    let (period, size) = (list.period(), feed.length());
    for (axis, motion) in list.axes().into_iter().enumerate() {
        let jerk = limits.axes()[axis].jerk().magnitude();
        // The cubic through values and slopes is off by at most sqrt(3) / 216 of the third derivative times the step cubed,
        // and by a 61st of a jump of the second times the step squared; where the curvature jumps the feed leaves one of
        // at most the jerk over a period.
        let off = (3.0_f64.sqrt() / 216.0 + 1.0 / 61.0) * jerk * period.powi(3);
        for (tick, sample) in samples.iter().enumerate() {
            let t = tick as f64 * period;
            assert!((motion.sample(t).position - (sample.position[axis] - first[axis])).abs() < 1e-14 * size);
            for part in [0.21, 0.5, 0.79] {
                let t = t + part * period;
                let wanted = feed.sample(t).position[axis] - first[axis];
                let apart = (motion.sample(t).position - wanted).abs();
                assert!(apart <= off + 1e-14 * size, "axis {axis} at {t} s: {apart} of {off}");
            }
        }
        let train = PulseTrain::new(motion, PULSE).expect("pulses");
        let mut sum = 0_i64;
        let step = period / f64::from(parts);
        for (tick, count) in (1_u32..).zip(train.counts(step).expect("counts")) {
            sum += i64::from(count);
            let way = motion.sample(f64::from(tick) * step).position;
            // Half a pulse, and a rounding of where it is due.
            assert!(
                (sum as f64 * PULSE - way).abs() <= 0.5 * PULSE * (1.0 + 1e-9),
                "axis {axis}: {sum}, {way}"
            );
        }
        assert_eq!(sum, train.total());
        assert!((sum as f64 * PULSE - (last[axis] - first[axis])).abs() <= 0.5 * PULSE * (1.0 + 1e-9));
    }
}

#[test]
fn a_drawing_comes_back_to_where_it_began() {
    let limits = limits(0.1, (0.3, 5.0, 100.0), 1e-6, 1e-3);
    gets(drawing(), limits, 10);
    let feed = FeedInterpolator::new(drawing(), limits).expect("feed");
    let list = feed.coordinates().expect("clock");
    // As many pulses forth as back, and thousands of them.
    for motion in list.axes() {
        let train = PulseTrain::new(motion, PULSE).expect("pulses");
        assert_eq!(train.total(), 0);
        assert!(train.pulses().count() > 50_000);
    }
}

#[test]
fn three_axes_get_their_coordinates_and_pulses() {
    gets(spatial(), limits(0.15, (0.12, 3.0, 150.0), 2e-6, 1e-3), 4);
    gets(spatial(), limits(0.15, (0.12, 3.0, 150.0), 2e-4, 4e-3), 40);
}
