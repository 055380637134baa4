//! Constant jerk in five phases.

use super::{
    covers, finite_distance, finite_limit, polynomial_law, representable, speed_within, symmetric_limits,
};
use crate::error::PlanError;
use crate::polynomial::{Piece, Piecewise, Ramp};
use crate::quantities::{Limits, Real, Sample};

/// The five-phase S-curve: a velocity step through two equal moving averages of the length `T`.
///
/// From the start speed `v_s` the jerk is `J` and `-J` for the time `T` each, then zero for the time `T_3`, then `-J`
/// and `J` for `T` each, down to the stop speed `v_e = v_s`. The peak velocity is `v = v_s + J T^2`, the peak
/// acceleration `J T`, and with `u = t - T_3`
///
/// | `t` in | `a(t)` | `v(t)` |
/// |---|---|---|
/// | `[0, T]` | `J t` | `v_s + J t^2 / 2` |
/// | `[T, 2T]` | `2 J T - J t` | `v_s - J T^2 + 2 J T t - J t^2 / 2` |
/// | `[2T, 2T + T_3]` | `0` | `v_s + J T^2` |
/// | `[2T + T_3, 3T + T_3]` | `2 J T - J u` | `v_s - J T^2 + 2 J T u - J u^2 / 2` |
/// | `[3T + T_3, 4T + T_3]` | `-4 J T + J u` | `v_s + 8 J T^2 - 4 J T u + J u^2 / 2` |
///
/// (the last two velocities are misprinted in the reference, whose accelerations they integrate). The way is
/// `2 (v_s + v) T + v T_3`. Jerk and speeds are signed, rad for m throughout where the axis turns.
///
/// A motion with a start speed rests before it and after it: it jumps to `v_s` and stops dead from it, as a
/// [`Trapezoid`](crate::Trapezoid) with speeds does. [`ramp_with_jerk`](Self::ramp_with_jerk) is the first half
/// alone, on top of a speed that is there before.
///
/// ```
/// use profiles::{FivePhase, Profile};
///
/// // 38 564 pulse/s^3 for twice 1.062 s, then 2 s at the peak velocity
/// let profile = FivePhase::new(0.0, 38_564.0, 1.062, 2.0)?;
/// assert!((profile.peak_velocity() - 43_494.0).abs() < 1.0);
/// assert!((profile.duration() - 6.248).abs() < 1e-15 * 6.248);
/// // and back, from the peak velocity
/// let same = FivePhase::with_peak_velocity(0.0, profile.peak_velocity(), 1.062, 2.0)?;
/// assert!((same.jerk() - 38_564.0).abs() < 1e-11);
/// # Ok::<(), profiles::PlanError>(())
/// ```
///
/// # References
/// Z. Liu, S. Zhang, L. Cai, J. Yang, B. Xu, P. Xu, Five-phase S-curve control method based on particle swarm
/// optimization, Journal of Beijing University of Technology 41 (2015) 641-648, eq. (6) and (7),
/// [doi:10.11936/bjutxb2014060067](https://doi.org/10.11936/bjutxb2014060067).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FivePhase(Piecewise<5>);

polynomial_law!(FivePhase, 5);

impl FivePhase {
    /// The motion of the start speed `v_s` in m/s, the jerk `J` in m/s^3, the phase time `T` and the cruise time
    /// `T_3` in s.
    ///
    /// A jerk of zero is a motion with the start speed.
    ///
    /// # Errors
    /// A number that is not finite, a phase time that is not positive, a negative cruise time, or numbers beyond
    /// double precision.
    pub fn new(start_speed: f64, jerk: f64, phase_time: f64, cruise_time: f64) -> Result<Self, PlanError> {
        let speed = finite_speed("start", start_speed)?;
        let (jerk, time) = (finite_jerk(jerk)?, checked_phase(phase_time)?);
        Self::cruising(Shape { start: speed, peak: speed + jerk * time * time, jerk, time }, cruise_time)
    }

    /// The motion of the start speed `v_s` in m/s, the jerk `J` in m/s^3, the phase time `T` and the whole duration
    /// `4 T + T_3` in s.
    ///
    /// # Errors
    /// As [`FivePhase::new`]; a duration shorter than the four phases.
    pub fn with_duration(
        start_speed: f64,
        jerk: f64,
        phase_time: f64,
        duration: f64,
    ) -> Result<Self, PlanError> {
        let shortest = 4.0 * checked_phase(phase_time)?;
        if !(duration >= shortest && duration.is_finite()) {
            return Err(PlanError::Duration { requested: duration, shortest });
        }
        Self::new(start_speed, jerk, phase_time, duration - shortest)
    }

    /// The motion from the start speed `v_s` to the peak velocity `v`, both in m/s, by the phase time `T` and the
    /// cruise time `T_3` in s: `J = (v - v_s) / T^2`.
    ///
    /// # Errors
    /// As [`FivePhase::new`].
    pub fn with_peak_velocity(
        start_speed: f64,
        peak_velocity: f64,
        phase_time: f64,
        cruise_time: f64,
    ) -> Result<Self, PlanError> {
        Self::cruising(Shape::between(start_speed, peak_velocity, phase_time)?, cruise_time)
    }

    /// The motion over a signed `distance` in m from the start speed to the peak velocity, magnitudes in m/s along
    /// the direction of the move, by the phase time `T` in s: `T_3 = (h - 2 (v_s + v) T) / v`.
    ///
    /// # Errors
    /// As [`FivePhase::new`]; a distance that is not finite, a speed that is negative, a peak velocity below the
    /// start speed, or a distance shorter than the two ramps.
    pub fn over_distance(
        distance: f64,
        start_speed: f64,
        peak_velocity: f64,
        phase_time: f64,
    ) -> Result<Self, PlanError> {
        let length = finite_distance(distance)?.abs();
        for (which, value, least) in
            [("start", start_speed, 0.0), ("peak", peak_velocity, start_speed.max(f64::MIN_POSITIVE))]
        {
            if value.is_nan() || value < least {
                return Err(PlanError::Speed { which, value });
            }
        }
        let sign = 1.0_f64.copysign(distance);
        let shape = Shape::between(sign * start_speed, sign * peak_velocity, phase_time)?;
        let needed = 2.0 * (start_speed + peak_velocity) * phase_time;
        if needed > length {
            return Err(PlanError::TooShort { distance, needed });
        }
        let cruise = (length - needed) / peak_velocity;
        covers(needed + peak_velocity * cruise, length)?;
        shape.motion(2.0 * shape.time + cruise, distance)
    }

    /// The change of velocity from `from` in m/s by the jerk `J` in m/s^3 and the phase time `T` in s: the first
    /// two phases, to `from + J T^2`.
    ///
    /// # Errors
    /// As [`FivePhase::new`].
    pub fn ramp_with_jerk(from: f64, jerk: f64, phase_time: f64) -> Result<Self, PlanError> {
        let from = finite_speed("start", from)?;
        let (jerk, time) = (finite_jerk(jerk)?, checked_phase(phase_time)?);
        Shape { start: from, peak: from + jerk * time * time, jerk, time }.ramp()
    }

    /// The change of velocity from `from` to `to`, both in m/s and signed, by the phase time `T` in s.
    ///
    /// # Errors
    /// As [`FivePhase::new`].
    pub fn ramp_between(from: f64, to: f64, phase_time: f64) -> Result<Self, PlanError> {
        Shape::between(from, to, phase_time)?.ramp()
    }

    /// The fastest move of this law over a signed `distance` in m, from rest to rest within symmetric limits.
    ///
    /// `T` is the longer of `v / A` and `sqrt(v / J)`. A limit of snap has no meaning for the law.
    ///
    /// # Errors
    /// A distance that is not finite, asymmetric limits of acceleration or jerk, an unlimited jerk, or numbers
    /// beyond double precision.
    pub fn rest_to_rest(distance: f64, limits: &Limits) -> Result<Self, PlanError> {
        let length = finite_distance(distance)?.abs();
        let bounds = Bounds::of(limits)?;
        if length == 0.0 {
            return Ok(Self(Piecewise::empty(0.0)));
        }
        let limit = limits.along(distance).velocity().upper;
        let (at_limit, _) = bounds.phase(limit);
        let cruises = limit < f64::INFINITY && 2.0 * limit * at_limit <= length;
        let speed = if cruises { limit } else { bounds.reached(length).min(limit) };
        let (time, jerk) = bounds.phase(speed);
        let time = representable("phase time", time)?;
        let down_start = if cruises { (length / speed).max(2.0 * time) } else { 2.0 * time };
        covers(speed * down_start, length)?;
        let peak = speed.copysign(distance);
        Shape { start: 0.0, peak, jerk: jerk.copysign(distance), time }.motion(down_start, distance)
    }

    /// The fastest change of velocity of this law from `from` to `to`, both in m/s and signed, within symmetric
    /// limits.
    ///
    /// # Errors
    /// A speed that is not finite or outside the limits, asymmetric limits of acceleration or jerk, an unlimited
    /// jerk, or numbers beyond double precision.
    pub fn velocity_ramp(from: f64, to: f64, limits: &Limits) -> Result<Self, PlanError> {
        let from = speed_within("start", from, limits.velocity())?;
        let to = speed_within("stop", to, limits.velocity())?;
        let bounds = Bounds::of(limits)?;
        let change = to - from;
        if change == 0.0 {
            return Ok(Self(Piecewise::empty(from)));
        }
        let (time, jerk) = bounds.phase(change.abs());
        let time = representable("phase time", time)?;
        Shape { start: from, peak: to, jerk: jerk.copysign(change), time }.ramp()
    }

    /// Start speed `v_s`, and stop speed of a motion that is no ramp, m/s.
    #[must_use]
    pub fn start_speed(&self) -> f64 {
        let [first, ..] = &self.0.pieces;
        first.motion.velocity
    }

    /// Peak velocity `v = v_s + J T^2`, m/s; of a ramp the one at its end.
    #[must_use]
    pub fn peak_velocity(&self) -> f64 {
        let [_, _, cruise, ..] = &self.0.pieces;
        cruise.motion.velocity
    }

    /// Jerk `J` of the first phase, m/s^3.
    #[must_use]
    pub fn jerk(&self) -> f64 {
        let [first, ..] = &self.0.pieces;
        first.motion.jerk
    }

    /// Phase time `T`, s: a ramp takes two.
    #[must_use]
    pub fn phase_time(&self) -> f64 {
        let [first, ..] = &self.0.pieces;
        first.reach
    }

    /// Cruise time `T_3`, s; zero for a ramp.
    #[must_use]
    pub fn cruise_time(&self) -> f64 {
        let [_, _, cruise, ..] = &self.0.pieces;
        cruise.reach
    }

    fn cruising(shape: Shape, cruise_time: f64) -> Result<Self, PlanError> {
        if !(cruise_time >= 0.0 && cruise_time.is_finite()) {
            return Err(PlanError::Phase {
                phase: "cruise",
                range: "a finite time that is not negative",
                value: cruise_time,
            });
        }
        let way = 2.0 * shape.ramp_way() + shape.peak * cruise_time;
        shape.motion(2.0 * shape.time + cruise_time, way)
    }
}

/// The two phases of one ramp.
#[derive(Debug, Clone, Copy)]
struct Shape {
    start: f64,
    peak: f64,
    jerk: f64,
    time: f64,
}

impl Shape {
    /// From one speed to another, m/s, in twice the phase time, s.
    fn between(start: f64, peak: f64, time: f64) -> Result<Self, PlanError> {
        let (start, peak) = (finite_speed("start", start)?, finite_speed("peak", peak)?);
        let time = checked_phase(time)?;
        Ok(Self { start, peak, jerk: (peak - start) / (time * time), time })
    }

    /// What one ramp covers, m.
    fn ramp_way(&self) -> f64 {
        (self.start + self.peak) * self.time
    }

    /// Refuses numbers beyond double precision.
    fn checked(self, duration: f64, way: f64) -> Result<Self, PlanError> {
        representable("duration", duration)?;
        let numbers = [("peak velocity", self.peak), ("jerk", self.jerk), ("distance", way)];
        match numbers.into_iter().find(|(_, value)| !value.is_finite()) {
            Some((quantity, value)) => Err(PlanError::Range { quantity, value }),
            None => Ok(self),
        }
    }

    /// Up, on to `down_start`, and down the mirror image to `distance`.
    fn motion(self, down_start: f64, distance: f64) -> Result<FivePhase, PlanError> {
        let ramp_time = 2.0 * self.time;
        let duration = down_start + ramp_time;
        let Self { start, peak, jerk, time } = self.checked(duration, distance)?;
        let way = self.ramp_way();
        let at =
            |position: f64, velocity: f64, jerk: f64| Sample { jerk, ..Sample::cruising(position, velocity) };
        Ok(FivePhase(Piecewise {
            ends: [time, ramp_time, down_start, down_start + time, duration],
            pieces: [
                Piece::new(0.0, time, at(0.0, start, jerk)),
                Piece::new(ramp_time, -time, at(way, peak, -jerk)),
                Piece::new(ramp_time, down_start - ramp_time, at(way, peak, 0.0)),
                Piece::new(down_start, time, at(distance - way, peak, -jerk)),
                Piece::new(duration, -time, at(distance, start, jerk)),
            ],
            before: 0.0,
            target: distance,
            after: 0.0,
            duration,
        }))
    }

    /// Up alone.
    fn ramp(self) -> Result<FivePhase, PlanError> {
        let duration = 2.0 * self.time;
        let Self { start, peak, jerk, time } = self.checked(duration, self.ramp_way())?;
        let change = peak - start;
        let way = change * time;
        let settled = Sample { jerk: -jerk, ..Sample::cruising(way, change) };
        let ramp = Ramp {
            ends: [time, duration],
            pieces: [
                Piece::new(0.0, time, Sample { jerk, ..Sample::default() }),
                Piece::new(duration, -time, settled),
            ],
            duration,
            way,
            speed: change,
        };
        Ok(FivePhase(ramp.on_top_of(start, peak)))
    }
}

/// Magnitudes of the limits; the jerk is finite.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    acceleration: f64,
    jerk: f64,
}

impl Bounds {
    fn of(limits: &Limits) -> Result<Self, PlanError> {
        let (acceleration, jerk) = symmetric_limits(limits)?;
        Ok(Self { acceleration, jerk: finite_limit("jerk", jerk)? })
    }

    /// The speed that a move of `length` reaches without a cruise, `h = 2 v T(v)`, m/s.
    fn reached(&self, length: f64) -> f64 {
        let Self { acceleration, jerk } = *self;
        let to_acceleration = acceleration / jerk;
        if length >= 2.0 * acceleration * (to_acceleration * to_acceleration) {
            Real::sqrt(0.5 * acceleration * length)
        } else {
            Real::cbrt(0.25 * jerk * length * length)
        }
    }

    /// The shortest phase time in which a ramp gains `change`, s, and its jerk, m/s^3.
    fn phase(&self, change: f64) -> (f64, f64) {
        let by_jerk = Real::sqrt(change / self.jerk);
        let by_acceleration = change / self.acceleration;
        if by_acceleration > by_jerk {
            // A/T, not v/T^2: the acceleration then meets its limit to one rounding.
            (by_acceleration, self.acceleration / by_acceleration)
        } else {
            (by_jerk, self.jerk)
        }
    }
}

fn finite_speed(which: &'static str, value: f64) -> Result<f64, PlanError> {
    if value.is_finite() { Ok(value) } else { Err(PlanError::Speed { which, value }) }
}

fn finite_jerk(value: f64) -> Result<f64, PlanError> {
    if value.is_finite() { Ok(value) } else { Err(PlanError::Jerk(value)) }
}

fn checked_phase(value: f64) -> Result<f64, PlanError> {
    if value > 0.0 && value.is_finite() {
        representable("phase time", value)
    } else {
        Err(PlanError::Phase { phase: "phases of constant jerk", range: "a positive and finite time", value })
    }
}
