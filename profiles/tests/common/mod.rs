//! Strategies and helpers shared by the property tests.
#![allow(dead_code, reason = "every test file uses a part of it")]

pub(crate) mod swing;

use profiles::{
    Cosine, FivePhase, Interval, Limits, PlanError, Profile, SCurve, Section, Sectioned, SnapLimited,
    Trapezoid,
};
use proptest::prelude::*;

/// Cases per property.
pub(crate) const CASES: u32 = 4096;

/// A magnitude whose logarithm is uniform.
pub(crate) fn magnitude(lower: f64, upper: f64) -> impl Strategy<Value = f64> {
    (lower.log2()..upper.log2()).prop_map(f64::exp2)
}

/// A move: a signed distance and symmetric limits of everything.
pub(crate) type Move = (f64, Limits);

fn limits(v: f64, a: f64, j: f64, s: f64) -> Limits {
    Limits::new(v, a, j).and_then(|l| l.with_snap(s)).expect("positive limits")
}

fn signed(distance: f64, negative: bool) -> f64 {
    if negative { -distance } else { distance }
}

/// Any magnitudes at all: limits from 1e-9 to 1e9, distances from 1e-12 to 1e9, independent of each other.
pub(crate) fn any_move() -> impl Strategy<Value = Move> {
    let limit = || magnitude(1e-9, 1e9);
    (magnitude(1e-12, 1e9), any::<bool>(), limit(), limit(), limit(), limit())
        .prop_map(|(d, negative, v, a, j, s)| (signed(d, negative), limits(v, a, j, s)))
}

/// Moves whose times are of one order of magnitude, so that every regime and every boundary is met.
pub(crate) fn balanced_move() -> impl Strategy<Value = Move> {
    let ratio = || prop_oneof![magnitude(0.05, 20.0), Just(1.0), Just(0.5), Just(2.0)];
    (magnitude(1e-6, 1e6), magnitude(1e-3, 1e3), any::<bool>(), ratio(), ratio(), ratio(), ratio()).prop_map(
        |(length, time, negative, v, a, j, s)| {
            let v = v * length / time;
            let a = a * v / time;
            let j = j * a / time;
            (signed(length, negative), limits(v, a, j, s * j / time))
        },
    )
}

/// Both kinds of moves.
pub(crate) fn a_move() -> impl Strategy<Value = Move> {
    prop_oneof![any_move(), balanced_move(), balanced_move()]
}

/// Different bounds for the two directions, for the laws that take them.
pub(crate) fn lopsided(limits: &Limits, deceleration: f64, falling: f64) -> Limits {
    limits
        .with_deceleration(limits.acceleration().upper * deceleration)
        .and_then(|l| l.with_jerk(Interval::new(-l.jerk().upper * falling, l.jerk().upper)))
        .expect("positive limits")
}

/// What a test asks of a law: everything a profile and its sections answer.
pub(crate) trait Law: Sectioned + Copy {
    /// Orders of derivative that are continuous: 1 for velocity, 2 for acceleration, 3 for jerk.
    const CONTINUOUS: usize;
    /// The move over a distance.
    fn plan(distance: f64, limits: &Limits) -> Result<Self, PlanError>;
    /// The change of velocity.
    fn ramp(from: f64, to: f64, limits: &Limits) -> Result<Self, PlanError>;
    /// The same in a longer time.
    fn stretched(&self, duration: f64) -> Result<Self, PlanError>;
}

macro_rules! law {
    ($law:ident, $continuous:literal) => {
        impl Law for $law {
            const CONTINUOUS: usize = $continuous;
            fn plan(distance: f64, limits: &Limits) -> Result<Self, PlanError> {
                $law::rest_to_rest(distance, limits)
            }
            fn ramp(from: f64, to: f64, limits: &Limits) -> Result<Self, PlanError> {
                $law::velocity_ramp(from, to, limits)
            }
            fn stretched(&self, duration: f64) -> Result<Self, PlanError> {
                self.stretched_to(duration)
            }
        }
    };
}
law!(Trapezoid, 1);
law!(SCurve, 2);
law!(SnapLimited, 3);
law!(Cosine, 2);
law!(FivePhase, 2);

/// The sections that last.
pub(crate) fn sections<P: Sectioned>(profile: &P) -> Vec<Section> {
    (0..).map_while(|k| profile.section(k)).filter(|s| s.end > s.start).collect()
}

/// Position and derivatives as an array, by order.
pub(crate) fn orders(s: profiles::Sample) -> [f64; 5] {
    [s.position, s.velocity, s.acceleration, s.jerk, s.snap]
}

/// Largest magnitude of each order over a profile.
pub(crate) fn scales<P: Profile>(profile: &P) -> [f64; 5] {
    let e = profile.extrema();
    [e.position, e.velocity, e.acceleration, e.jerk, e.snap].map(Interval::magnitude)
}

/// What rounding may do to each order: a few units of its own scale, and the next order times the rounding of an
/// instant of the profile.
pub(crate) fn rounding<P: Profile>(profile: &P) -> [f64; 5] {
    let scale = scales(profile);
    let instant = profile.duration() * f64::EPSILON;
    std::array::from_fn(|k| {
        let next = scale.get(k + 1).copied().unwrap_or(0.0);
        16.0 * (scale[k] * f64::EPSILON + next * instant)
    })
}
