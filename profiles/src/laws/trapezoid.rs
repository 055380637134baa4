//! Constant acceleration, constant velocity, constant deceleration.

use super::{covers, finite_distance, finite_limit, polynomial_law, representable, speed_within};
use crate::error::PlanError;
use crate::polynomial::{Piece, Piecewise};
use crate::quantities::{Limits, Real, Sample};

/// The trapezoid of the velocity: the fastest motion within limits of velocity and acceleration.
///
/// It uses the limits of velocity and acceleration, which may differ for speeding up and slowing down; its
/// acceleration jumps, so jerk and snap limits have no meaning for it.
///
/// ```
/// use profiles::{Limits, Profile, Trapezoid};
///
/// let limits = Limits::new(0.2, 4.0, f64::INFINITY)?;
/// let profile = Trapezoid::rest_to_rest(0.04, &limits)?;
/// assert!((profile.duration() - 0.25).abs() < 1e-15); // d/V + V/A
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trapezoid(Piecewise<3>);

polynomial_law!(Trapezoid, 3);

impl Trapezoid {
    /// The fastest move over a signed `distance` in m.
    ///
    /// # Errors
    /// A distance that is not finite, an unlimited acceleration, or numbers beyond double precision.
    pub fn rest_to_rest(distance: f64, limits: &Limits) -> Result<Self, PlanError> {
        Self::with_speeds(distance, 0.0, 0.0, limits)
    }

    /// The fastest move over a signed `distance` in m that jumps to `start_speed` and stops dead from `stop_speed`.
    ///
    /// Speeds are magnitudes in m/s along the direction of the move, as a stepper's start and stop frequencies are.
    /// The peak velocity `v` covers the distance `(v^2 - v0^2) / (2 A) + (v^2 - v1^2) / (2 D)` or is the limit.
    ///
    /// # Errors
    /// As [`Trapezoid::rest_to_rest`]; a speed that is negative or above the limit; a distance too short for the
    /// change from one speed to the other.
    pub fn with_speeds(
        distance: f64,
        start_speed: f64,
        stop_speed: f64,
        limits: &Limits,
    ) -> Result<Self, PlanError> {
        let length = finite_distance(distance)?.abs();
        let along = limits.along(distance);
        let limit = along.velocity().upper;
        for (which, value) in [("start", start_speed), ("stop", stop_speed)] {
            if value.is_nan() || value < 0.0 {
                return Err(PlanError::Speed { which, value });
            }
            speed_within(which, value, along.velocity())?;
        }
        let up = finite_limit("acceleration", along.acceleration().upper)?;
        let down = finite_limit("acceleration", -along.acceleration().lower)?;
        if length == 0.0 && start_speed == 0.0 && stop_speed == 0.0 {
            return Ok(Self(Piecewise::empty(0.0)));
        }

        let faster = start_speed.max(stop_speed);
        // Lengths of the ramps from each end to a speed v; the product form keeps the digits of a small change.
        let ramp = |v: f64, from: f64, a: f64| (v - from) * (v + from) / (2.0 * a);
        let needed = ramp(faster, start_speed, up) + ramp(faster, stop_speed, down);
        if needed > length || length == 0.0 {
            return Err(PlanError::TooShort { distance, needed });
        }
        let room = length - needed;
        let together = 2.0 * (up / (1.0 + up / down));
        let unlimited = Real::sqrt(faster * faster + together * room);
        let (speed, cruise_length) = if unlimited > limit {
            (limit, length - ramp(limit, start_speed, up) - ramp(limit, stop_speed, down))
        } else {
            (unlimited, 0.0)
        };
        let (rise, fall) = ((speed - start_speed) / up, (speed - stop_speed) / down);
        let cruise = cruise_length.max(0.0) / speed;
        let duration = representable("duration", rise + cruise + fall)?;

        let sign = 1.0_f64.copysign(distance);
        let risen = ramp(speed, start_speed, up);
        covers(risen + speed * cruise + ramp(speed, stop_speed, down), length)?;
        let motion = |position: f64, velocity: f64, acceleration: f64| Sample {
            position,
            velocity: sign * velocity,
            acceleration: sign * acceleration,
            jerk: 0.0,
            snap: 0.0,
        };
        Ok(Self(Piecewise {
            ends: [rise, rise + cruise, duration],
            pieces: [
                Piece::new(0.0, rise, motion(0.0, start_speed, up)),
                Piece::new(rise, cruise, motion(sign * risen, speed, 0.0)),
                Piece::new(duration, -fall, motion(distance, stop_speed, -down)),
            ],
            before: 0.0,
            target: distance,
            after: 0.0,
            duration,
        }))
    }

    /// The fastest change of velocity from `from` to `to`, both in m/s and signed.
    ///
    /// # Errors
    /// A speed that is not finite or outside the limits, an unlimited acceleration, or numbers beyond double
    /// precision.
    pub fn velocity_ramp(from: f64, to: f64, limits: &Limits) -> Result<Self, PlanError> {
        let from = speed_within("start", from, limits.velocity())?;
        let to = speed_within("stop", to, limits.velocity())?;
        let change = to - from;
        let limit = finite_limit("acceleration", limits.along(change).acceleration().upper)?;
        if change == 0.0 {
            return Ok(Self(Piecewise::empty(from)));
        }
        let duration = representable("duration", change.abs() / limit)?;
        let target = 0.5 * (from + to) * duration;
        let motion = Sample { acceleration: limit.copysign(change), ..Sample::cruising(0.0, from) };
        let rest = Piece::new(duration, 0.0, Sample::cruising(target, to));
        Ok(Self(Piecewise {
            ends: [duration; 3],
            pieces: [Piece::new(0.0, duration, motion), rest, rest],
            before: from,
            target,
            after: to,
            duration,
        }))
    }
}
