//! Constant jerk in seven sections.

use super::{covers, finite_distance, finite_limit, polynomial_law, representable, speed_within};
use crate::error::PlanError;
use crate::polynomial::{Piece, Piecewise, Ramp};
use crate::quantities::{Limits, Real, Sample};

/// The S-curve: the fastest motion within limits of velocity, acceleration and jerk.
///
/// All bounds may differ for the two directions. With symmetric ones a move of length `h` is a step through three
/// moving averages of lengths `t1 >= t2 + t3`, `t2 >= t3`:
///
/// `h = v t1`, `v = a t2`, `a = J t3`, duration `t1 + t2 + t3`
///
/// with the averages as short as the limits allow. With different bounds a ramp to the speed `v` with the peak
/// acceleration `A`, rising with `Jr` and falling with `Jf` in `tr = A/Jr`, `tf = A/Jf`, covers
///
/// `v^2 / (2 A) + v tf / 2 + A (tr^2 - tf^2) / 24`
///
/// and where two ramps do not reach the velocity limit their common speed is solved for. Limits of snap have no
/// meaning for the law.
///
/// # References
/// L. Biagiotti, C. Melchiorri, FIR filters for online trajectory planning with time- and frequency-domain
/// specifications, Control Engineering Practice 20 (2012) 1385-1399,
/// [doi:10.1016/j.conengprac.2012.08.005](https://doi.org/10.1016/j.conengprac.2012.08.005).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SCurve(Piecewise<7>);

polynomial_law!(SCurve, 7);

impl SCurve {
    /// The fastest move over a signed `distance` in m.
    ///
    /// # Errors
    /// A distance that is not finite, an unlimited jerk, or numbers beyond double precision.
    pub fn rest_to_rest(distance: f64, limits: &Limits) -> Result<Self, PlanError> {
        let distance = finite_distance(distance)?;
        let along = limits.along(distance);
        let jerk = Jerk::of(&along)?;
        if distance == 0.0 {
            return Ok(Self(Piecewise::empty(0.0)));
        }
        let (velocity, up, down) =
            (along.velocity().upper, along.acceleration().upper, -along.acceleration().lower);
        let plan = if along.acceleration().is_symmetric() && along.jerk().is_symmetric() {
            symmetric_move(distance, velocity, up, jerk.rising)
        } else {
            asymmetric_move(distance, velocity, up, down, jerk)
        };
        // Every candidate is verified: the sections must add up to the distance.
        representable("duration", plan.duration)?;
        let [_, _, _, cruise, falling, ..] = &plan.pieces;
        let met = cruise.motion.position + cruise.motion.velocity * cruise.reach;
        // What is left between them is a part of the distance, not of where they meet.
        covers(distance + (met - falling.motion.position), distance)?;
        Ok(Self(plan))
    }

    /// The fastest change of velocity from `from` to `to`, both in m/s and signed.
    ///
    /// # Errors
    /// A speed that is not finite or outside the limits, an unlimited jerk, or numbers beyond double precision.
    pub fn velocity_ramp(from: f64, to: f64, limits: &Limits) -> Result<Self, PlanError> {
        let from = speed_within("start", from, limits.velocity())?;
        let to = speed_within("stop", to, limits.velocity())?;
        let change = to - from;
        let along = limits.along(change);
        let jerk = Jerk::of(&along)?;
        if change == 0.0 {
            return Ok(Self(Piecewise::empty(from)));
        }
        let ramp = ramp(change, along.acceleration().upper, jerk);
        representable("duration", ramp.duration)?;
        Ok(Self(ramp.on_top_of(from, to)))
    }
}

/// Magnitudes of the jerk with which the acceleration rises and falls on the way to the peak velocity.
#[derive(Debug, Clone, Copy)]
struct Jerk {
    rising: f64,
    falling: f64,
}

impl Jerk {
    fn of(along: &Limits) -> Result<Self, PlanError> {
        Ok(Self {
            rising: finite_limit("jerk", along.jerk().upper)?,
            falling: finite_limit("jerk", -along.jerk().lower)?,
        })
    }

    /// `(1/Jr + 1/Jf) / 2`: a triangle of the acceleration with peak `A` gains the speed `A^2` times this.
    fn mean_inverse(self) -> f64 {
        0.5 * (1.0 / self.rising + 1.0 / self.falling)
    }
}

/// The ramp from rest to the signed velocity `change` with at most the acceleration `limit`.
fn ramp(change: f64, limit: f64, jerk: Jerk) -> Ramp<3> {
    let speed = change.abs();
    let inverse = jerk.mean_inverse();
    let triangular = Real::sqrt(speed / inverse);
    let (peak, hold) = if triangular > limit {
        (limit, (speed / limit - limit * inverse).max(0.0))
    } else {
        (triangular, 0.0)
    };
    let (rise, fall) = (peak / jerk.rising, peak / jerk.falling);
    let sign = 1.0_f64.copysign(change);
    let risen = Sample { jerk: sign * jerk.rising, ..Sample::default() }.advanced(rise);
    let steady = Sample { acceleration: sign * peak, jerk: 0.0, ..risen };
    // Centroid form of the distance: the speed gained in each part times the time left from its centroid.
    let rest = hold + fall;
    let way = 0.5 * peak * rise * (rest + rise / 3.0)
        + peak * hold * (fall + 0.5 * hold)
        + peak * fall * fall / 3.0;
    let duration = rise + rest;
    let signed_way = sign * way;
    let settled = Sample::cruising(signed_way, change);
    Ramp {
        ends: [rise, rise + hold, duration],
        pieces: [
            Piece::new(0.0, rise, Sample { jerk: sign * jerk.rising, ..Sample::default() }),
            Piece::new(rise, hold, steady),
            Piece::new(duration, -fall, Sample { jerk: -sign * jerk.falling, ..settled }),
        ],
        duration,
        way: signed_way,
        speed: change,
    }
}

/// The move as a step through three averages.
fn symmetric_move(distance: f64, velocity: f64, acceleration: f64, jerk: f64) -> Piecewise<7> {
    let length = distance.abs();
    let (to_acceleration, to_velocity) = (acceleration / jerk, velocity / acceleration);
    let (mut t3, mut t2) = if to_acceleration <= to_velocity {
        (to_acceleration, to_velocity)
    } else {
        let both = Real::sqrt(velocity / jerk);
        (both, both)
    };
    // Without a cruise t1 = t2 + t3, and h = a t2 (t2 + t3) or, with t2 = t3, h = 2 J t3^3.
    let mut t1 = length / velocity;
    if t1 < t2 + t3 {
        if length >= 2.0 * acceleration * (to_acceleration * to_acceleration) {
            t3 = to_acceleration;
            let half = 0.5 * t3;
            t2 = (Real::sqrt(half * half + length / acceleration) - half).max(t3);
        } else {
            t3 = Real::cbrt(length / (2.0 * jerk));
            t2 = t3;
        }
        t1 = t2 + t3;
    }
    let sign = 1.0_f64.copysign(distance);
    let peak = (jerk * t3).min(acceleration);
    let speed = (peak * t2).min(velocity);
    let signed_jerk = sign * jerk;
    let signed_peak = sign * peak;
    let duration = t2 + t3;
    let (velocity, way) = (sign * speed, 0.5 * sign * speed * duration);
    let gained = 0.5 * signed_peak * t3;
    let steady = Sample { acceleration: signed_peak, ..Sample::cruising(gained * t3 * (1.0 / 3.0), gained) };
    let settled = Sample { jerk: -signed_jerk, ..Sample::cruising(way, velocity) };
    let ramp = Ramp {
        ends: [t3, t2, duration],
        pieces: [
            Piece::new(0.0, t3, Sample { jerk: signed_jerk, ..Sample::default() }),
            Piece::new(t3, t2 - t3, steady),
            Piece::new(duration, -t3, settled),
        ],
        duration,
        way,
        speed: velocity,
    };
    ramp.move_to(&ramp, t1, distance)
}

/// The move with ramps of different acceleration or with jerk that rises and falls differently.
fn asymmetric_move(distance: f64, velocity: f64, up: f64, down: f64, jerk: Jerk) -> Piecewise<7> {
    let length = distance.abs();
    let way = |speed: f64| {
        let (first, second) = (ramp(speed, up, jerk), ramp(speed, down, jerk));
        first.way + second.way
    };
    let speed = if velocity < f64::INFINITY && way(velocity) <= length {
        velocity
    } else {
        common_speed(length, up, down, jerk).min(velocity)
    };
    let sign = 1.0_f64.copysign(distance);
    let (rising, falling) = (ramp(sign * speed, up, jerk), ramp(sign * speed, down, jerk));
    let cruise = (length - rising.way.abs() - falling.way.abs()).max(0.0) / speed;
    rising.move_to(&falling, rising.duration + cruise, distance)
}

/// The speed to which two ramps rise that cover `length` together.
///
/// A triangular ramp with the peak `a` gains `v = R a^2`, `R = (1/Jr + 1/Jf) / 2`, and covers `R K a^3`,
/// `K = (1/Jr + 2/Jf) / 3`; a ramp that reaches its acceleration covers the quadratic in `v` of the type's
/// documentation. In the peak of the stronger ramp both rise and are convex.
fn common_speed(length: f64, up: f64, down: f64, jerk: Jerk) -> f64 {
    let (weaker, stronger) = (up.min(down), up.max(down));
    let r = jerk.mean_inverse();
    let k = (1.0 / jerk.rising + 2.0 / jerk.falling) / 3.0;
    // Both triangular: 2 R K a^3 = h.
    let triangular = Real::cbrt(length / (2.0 * r * k));
    if triangular <= weaker {
        return r * triangular * triangular;
    }
    // Coefficients of v^2, v and 1 in the way of a ramp that reaches its acceleration.
    let quadratic = |a: f64| {
        let (rise, fall) = (a / jerk.rising, a / jerk.falling);
        [0.5 / a, 0.5 * fall, a * (rise - fall) * (rise + fall) / 24.0]
    };
    let [w2, w1, w0] = quadratic(weaker);
    if stronger < f64::INFINITY {
        let [s2, s1, s0] = quadratic(stronger);
        let (c2, c1, c0) = (w2 + s2, w1 + s1, w0 + s0 - length);
        // c0 <= 0 where both ramps are trapezoidal, so this form has no cancellation.
        let trapezoidal = -2.0 * c0 / (c1 + Real::sqrt(c1 * c1 - 4.0 * c2 * c0));
        if trapezoidal >= stronger * stronger * r {
            return trapezoidal;
        }
    }
    // One of each: Newton's method from above falls monotonically on a convex function.
    let mut a = Real::cbrt(length / (r * k));
    for _ in 0..64 {
        let v = r * a * a;
        let excess = v * (k * a + w2 * v + w1) + w0 - length;
        let slope = r * a * (3.0 * k * a + 4.0 * w2 * v + 2.0 * w1);
        let next = a - excess / slope;
        if next.is_nan() || next >= a {
            break;
        }
        a = next;
    }
    r * a * a
}
