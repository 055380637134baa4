//! Random moves, and what holds of every planned one.

use std::f64::consts::TAU;

use optimize::vibration_free::{Robustness, VibrationFreeMove, plan};
use profiles::{Complex, Interval, Limits, Mode, Profile, SCurve, Section, Sectioned};
use proptest::prelude::*;

/// Cases per property: `VIBRATION_FREE_CASES`, or more where debug assertions are off.
pub(crate) fn config(debug: u32) -> ProptestConfig {
    let asked = std::env::var("VIBRATION_FREE_CASES").ok().and_then(|cases| cases.parse().ok());
    let usual = if cfg!(debug_assertions) { debug } else { 8 * debug };
    // A plan is milliseconds, and a simpler failure worth a second or two.
    ProptestConfig { max_shrink_iters: 60, ..ProptestConfig::with_cases(asked.unwrap_or(usual)) }
}

/// A move, and the modes that it must not excite.
#[derive(Debug, Clone)]
pub(crate) struct Task {
    pub(crate) distance: f64,
    pub(crate) limits: Limits,
    pub(crate) modes: Vec<Mode>,
}

impl Task {
    pub(crate) fn new(distance: f64, [v, a, j]: [f64; 3], modes: &[(f64, f64)]) -> Self {
        let limits = Limits::new(v, a, j).expect("limits");
        let modes = modes.iter().map(|&(hz, z)| Mode::from_hz(hz, z).expect("mode")).collect();
        Self { distance, limits, modes }
    }

    pub(crate) fn s_curve(&self) -> f64 {
        SCurve::rest_to_rest(self.distance, &self.limits).expect("plan").duration()
    }

    /// The S-curve through two impulses half a period apart for every zero.
    pub(crate) fn shaped(&self, robustness: Robustness) -> f64 {
        let zeros = if robustness == Robustness::DoubleZero { 2.0 } else { 1.0 };
        self.s_curve() + self.modes.iter().map(|mode| zeros * 0.5 * mode.damped_period()).sum::<f64>()
    }

    pub(crate) fn plan(&self, robustness: Robustness) -> VibrationFreeMove {
        plan(self.distance, &self.limits, &self.modes, robustness).expect("plan")
    }

    /// The same within a property, which fails with the task.
    pub(crate) fn planned(&self, robustness: Robustness) -> Result<VibrationFreeMove, TestCaseError> {
        plan(self.distance, &self.limits, &self.modes, robustness)
            .map_err(|error| TestCaseError::fail(error.to_string()))
    }

    /// With other units of length and time.
    pub(crate) fn scaled(&self, length: f64, time: f64) -> Self {
        let scale = |bounds: Interval, order: i32| {
            let factor = length / time.powi(order);
            Interval::new(bounds.lower * factor, bounds.upper * factor)
        };
        let limits = Limits::UNLIMITED
            .with_velocity(scale(self.limits.velocity(), 1))
            .and_then(|limits| limits.with_acceleration(scale(self.limits.acceleration(), 2)))
            .and_then(|limits| limits.with_jerk(scale(self.limits.jerk(), 3)))
            .expect("limits");
        let slower =
            |mode: &Mode| Mode::new(mode.angular_frequency() / time, mode.damping_ratio()).expect("mode");
        Self { distance: self.distance * length, limits, modes: self.modes.iter().map(slower).collect() }
    }
}

/// A magnitude whose logarithm is uniform.
pub(crate) fn magnitude(lower: f64, upper: f64) -> impl Strategy<Value = f64> {
    (lower.log2()..upper.log2()).prop_map(f64::exp2)
}

/// Limits of about a length in a time, such that each of them is met in some and in others not; one in two is asymmetric.
pub(crate) fn limits(lopsided: bool) -> impl Strategy<Value = (f64, f64, Limits)> {
    let ratio = || prop_oneof![3 => magnitude(0.15, 6.0), 1 => Just(1.0)];
    let other = || prop_oneof![2 => Just(1.0), 1 => magnitude(0.4, 2.5)];
    let sizes = (magnitude(1e-3, 1e3), magnitude(1e-2, 1e2));
    (sizes, [ratio(), ratio(), ratio()], [other(), other(), other()], any::<bool>()).prop_map(
        move |((length, time), [v, a, j], others, even)| {
            let v = v * length / time;
            let a = a * v / time;
            let j = j * a / time;
            let [v_other, a_other, j_other] = if even || !lopsided { [1.0; 3] } else { others };
            let limits = Limits::UNLIMITED
                .with_velocity(Interval::new(-v * v_other, v))
                .and_then(|limits| limits.with_acceleration(Interval::new(-a * a_other, a)))
                .and_then(|limits| limits.with_jerk(Interval::new(-j * j_other, j)))
                .expect("positive limits");
            (length, time, limits)
        },
    )
}

/// Periods in the S-curve and damping ratios.
fn modes(most: usize) -> impl Strategy<Value = Vec<(f64, f64)>> {
    let damping = prop_oneof![1 => Just(0.0), 3 => 0.0..0.3];
    let count = if most == 1 { 1..=1 } else { 1..=most };
    prop::collection::vec((magnitude(0.3, 8.0), damping), count)
}

/// A move with up to so many modes of 0.3 to 8 periods in the S-curve.
pub(crate) fn a_task(most: usize, lopsided: bool) -> impl Strategy<Value = Task> {
    (limits(lopsided), any::<bool>(), modes(most)).prop_map(|((length, _, limits), negative, modes)| {
        let distance = if negative { -length } else { length };
        let time = SCurve::rest_to_rest(distance, &limits).expect("plan").duration();
        let mode = |&(periods, z): &(f64, f64)| Mode::new(TAU * periods / time, z).expect("mode");
        Task { distance, limits, modes: modes.iter().map(mode).collect() }
    })
}

pub(crate) fn zeros() -> impl Strategy<Value = Robustness> {
    prop_oneof![2 => Just(Robustness::None), 1 => Just(Robustness::DoubleZero)]
}

/// Zeros of up to four modes, or double ones of up to two; mostly of one, which is soon planned.
pub(crate) fn a_request() -> impl Strategy<Value = (Task, Robustness)> {
    prop_oneof![
        4 => (a_task(1, true), Just(Robustness::None)),
        2 => (a_task(2, true), Just(Robustness::None)),
        1 => (a_task(4, true), Just(Robustness::None)),
        2 => (a_task(1, true), Just(Robustness::DoubleZero)),
        1 => (a_task(2, true), Just(Robustness::DoubleZero)),
    ]
}

/// The sections that last.
pub(crate) fn sections<P: Sectioned>(profile: &P) -> Vec<Section> {
    (0..).map_while(|k| profile.section(k)).filter(|s| s.end > s.start).collect()
}

/// The amplitude with which a mode that is driven by the acceleration of the axis goes on, by the classical Runge-Kutta
/// method section by section.
pub(crate) fn simulated<P: Sectioned>(profile: &P, mode: Mode) -> f64 {
    let (w, z) = (mode.angular_frequency(), mode.damping_ratio());
    let (mut x, mut v) = (0.0, 0.0);
    for section in sections(profile) {
        let (from, to) = section.local_ends();
        // Off by (w dt)^4 / 120 of the amplitude a radian: 1e-11 in ten of them.
        let steps = ((to - from) * w / 0.0035).ceil().max(1.0);
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

/// `value` lies within bounds but for rounding.
fn within(what: &str, range: Interval, bounds: Interval) -> Result<(), TestCaseError> {
    let scale = 1e-12 * bounds.lower.abs().min(bounds.upper.abs());
    prop_assert!(range.upper <= bounds.upper + scale, "{what} {} beyond {}", range.upper, bounds.upper);
    prop_assert!(range.lower >= bounds.lower - scale, "{what} {} beyond {}", range.lower, bounds.lower);
    Ok(())
}

/// Limits hold, the motion is continuous, and it goes from where it starts to where it ends exactly.
pub(crate) fn sound(
    motion: &VibrationFreeMove,
    limits: &Limits,
    from: f64,
    to: f64,
    distance: Option<f64>,
) -> Result<(), TestCaseError> {
    let duration = motion.duration();
    prop_assert!(duration.is_finite() && duration > 0.0, "duration {duration}");
    let peaks = motion.extrema();
    within("velocity", peaks.velocity, limits.velocity())?;
    within("acceleration", peaks.acceleration, limits.acceleration())?;
    within("jerk", peaks.jerk, limits.jerk())?;
    let end = motion.sample(duration);
    if let Some(distance) = distance {
        prop_assert_eq!(end.position.to_bits(), distance.to_bits());
    }
    prop_assert_eq!(end.velocity, to);
    prop_assert_eq!(end.acceleration, 0.0);
    let start = motion.sample(0.0);
    prop_assert_eq!(start.position, 0.0);
    prop_assert_eq!(start.velocity, from);
    prop_assert_eq!(start.acceleration, 0.0);
    let sections = sections(motion);
    let last = sections.last().expect("a section");
    let stop = last.at_local(last.local_ends().1);
    prop_assert_eq!((stop.position, stop.velocity, stop.acceleration), (end.position, to, 0.0));
    // What rounding and Newton's method leave, each of its own scale.
    let scales = [peaks.position, peaks.velocity, peaks.acceleration].map(|range| 1e-11 * range.magnitude());
    for pair in sections.windows(2) {
        let before = pair[0].at_local(pair[0].local_ends().1);
        let after = pair[1].at_local(pair[1].local_ends().0);
        let gaps = [
            before.position - after.position,
            before.velocity - after.velocity,
            before.acceleration - after.acceleration,
        ];
        for (gap, scale) in gaps.iter().zip(scales) {
            prop_assert!(gap.abs() <= scale, "gaps {gaps:?}, scales {scales:?} at {}", pair[0].end);
        }
        prop_assert!((pair[0].end - pair[1].start).abs() <= 1e-14 * duration);
    }
    Ok(())
}

/// Nothing is left of any mode, by the closed form and by simulation; `unit` is what a mode's residual is set against.
pub(crate) fn at_rest(
    motion: &VibrationFreeMove,
    modes: &[Mode],
    unit: impl Fn(&Mode) -> f64,
) -> Result<(), TestCaseError> {
    for mode in modes {
        let closed = profiles::residual_vibration(motion, *mode) / unit(mode);
        prop_assert!(closed <= 1e-12, "closed form {closed:e} of {mode:?}");
        // Thousands of periods are left to the closed form: a simulation of them takes minutes.
        if motion.duration() * mode.angular_frequency() > 2e4 {
            continue;
        }
        // A slow mode goes with the axis, which may go far beyond its distance.
        let way = motion.extrema().position.magnitude();
        let left = simulated(motion, *mode) / unit(mode).max(way);
        prop_assert!(left <= 1e-9, "simulated {left:e} of {mode:?}");
    }
    Ok(())
}
