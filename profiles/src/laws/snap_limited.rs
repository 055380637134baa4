//! Constant derivative of jerk in fifteen sections.

use super::{
    covers, finite_distance, finite_limit, polynomial_law, representable, speed_within, symmetric_limits,
};
use crate::error::PlanError;
use crate::polynomial::{Piece, Piecewise, Ramp};
use crate::quantities::{Limits, Real, Sample};

/// The motion with a velocity cubic in time, within limits of velocity, acceleration, jerk and derivative of jerk.
///
/// A move of length `h` is a step through four moving averages, each at least as long as the later ones together:
///
/// `h = v t1`, `v = a t2`, `a = j t3`, `j = D t4`, duration `t1 + t2 + t3 + t4`
///
/// and every average is as short as its limit and the ones before it allow. Limits must be symmetric.
///
/// The jerk vanishes where the acceleration does. A velocity ramp is the fastest one within the limits; a move
/// that cruises is made of two such ramps. A move too short to cruise could be faster if its jerk need not vanish
/// half way: by 6.9 % where no limit but that of snap is met.
///
/// # References
/// P. Lambrechts, M. Boerlage, M. Steinbuch, Trajectory planning and feedforward design for electromechanical
/// motion systems, Control Engineering Practice 13 (2005) 145-157,
/// [doi:10.1016/j.conengprac.2004.02.010](https://doi.org/10.1016/j.conengprac.2004.02.010).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SnapLimited(Piecewise<15>);

polynomial_law!(SnapLimited, 15);

impl SnapLimited {
    /// The move over a signed `distance` in m.
    ///
    /// # Errors
    /// A distance that is not finite, asymmetric limits of acceleration or jerk, an unlimited snap, or numbers
    /// beyond double precision.
    pub fn rest_to_rest(distance: f64, limits: &Limits) -> Result<Self, PlanError> {
        let distance = finite_distance(distance)?;
        let bounds = Bounds::of(limits, limits.along(distance).velocity().upper)?;
        if distance == 0.0 {
            return Ok(Self(Piecewise::empty(0.0)));
        }
        let length = distance.abs();
        let averages = bounds.averages(length);
        let ramp = bounds.ramp(averages, 1.0_f64.copysign(distance));
        let t1 = (length / bounds.velocity).max(ramp.duration);
        representable("duration", t1 + ramp.duration)?;
        covers(ramp.speed * t1, distance)?;
        Ok(Self(ramp.move_to(&ramp, t1, distance)))
    }

    /// The fastest change of velocity from `from` to `to`, both in m/s and signed.
    ///
    /// # Errors
    /// A speed that is not finite or outside the limits, asymmetric limits of acceleration or jerk, an unlimited
    /// snap, or numbers beyond double precision.
    pub fn velocity_ramp(from: f64, to: f64, limits: &Limits) -> Result<Self, PlanError> {
        let from = speed_within("start", from, limits.velocity())?;
        let to = speed_within("stop", to, limits.velocity())?;
        let change = to - from;
        let bounds = Bounds::of(limits, change.abs())?;
        if change == 0.0 {
            return Ok(Self(Piecewise::empty(from)));
        }
        let ramp = bounds.ramp(bounds.averages(f64::INFINITY), 1.0_f64.copysign(change));
        representable("duration", ramp.duration)?;
        if (ramp.speed - change).abs() <= 1e-12 * change.abs() {
            Ok(Self(ramp.on_top_of(from, to)))
        } else {
            Err(PlanError::Range { quantity: "speed", value: ramp.speed })
        }
    }
}

/// Magnitudes of the limits; only the snap must be finite.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    velocity: f64,
    acceleration: f64,
    jerk: f64,
    snap: f64,
}

impl Bounds {
    fn of(limits: &Limits, velocity: f64) -> Result<Self, PlanError> {
        let (acceleration, jerk) = symmetric_limits(limits)?;
        Ok(Self { velocity, acceleration, jerk, snap: finite_limit("snap", limits.snap())? })
    }

    /// The averages `t2`, `t3`, `t4` of a move of `length`, as long as every limit allows.
    ///
    /// `t4` is the shortest of `J/D`, `(A/D)^(1/2)`, `(V/2D)^(1/3)`, `(h/8D)^(1/4)`: the peaks of jerk,
    /// acceleration, velocity and length when all later choices are at their boundary. `t3` and `t2` follow in
    /// the same way, each clamped to the sum of the later ones where its limit would make it shorter.
    #[inline]
    fn averages(&self, length: f64) -> [f64; 3] {
        let Self { velocity, acceleration, jerk, snap } = *self;
        let mut t4 = jerk / snap;
        // Comparing powers spares the roots that are not needed.
        let mut by_jerk = true;
        if snap * (t4 * t4) > acceleration {
            t4 = Real::sqrt(acceleration / snap);
            by_jerk = false;
        }
        if 2.0 * snap * (t4 * t4 * t4) > velocity {
            t4 = Real::cbrt(velocity / (2.0 * snap));
            by_jerk = false;
        }
        if 8.0 * snap * (t4 * t4) * (t4 * t4) > length {
            t4 = Real::sqrt(Real::sqrt(length / (8.0 * snap)));
            by_jerk = false;
        }
        let mut t3 = t4;
        let half = 0.5 * t4;
        if by_jerk {
            t3 = acceleration / jerk;
            if jerk * t3 * (t3 + t4) > velocity || !t3.is_finite() {
                t3 = Real::sqrt(half * half + velocity / jerk) - half;
            }
            if 2.0 * jerk * t3 * ((t3 + t4) * (t3 + t4)) > length || !t3.is_finite() {
                t3 = root_without_plateau(length / (2.0 * jerk), t4);
            }
            t3 = t3.max(t4);
        }
        let later = t3 + t4;
        let mut t2 = velocity / acceleration;
        if !t2.is_finite() || acceleration * t2 * (t2 + later) > length {
            let half = 0.5 * later;
            t2 = Real::sqrt(half * half + length / acceleration) - half;
        }
        [t2.max(later), t3, t4]
    }

    /// The ramp through the averages, in the direction `sign`.
    #[inline]
    fn ramp(&self, [t2, t3, t4]: [f64; 3], sign: f64) -> Ramp<7> {
        let snap = sign * self.snap;
        let jerk = sign * (self.snap * t4).min(self.jerk);
        let acceleration = sign * (jerk.abs() * t3).min(self.acceleration);
        let speed = sign * (acceleration.abs() * t2).min(self.velocity);
        let duration = t2 + t3 + t4;
        let way = 0.5 * speed * duration;

        let rising = Sample { snap, ..Sample::default() };
        let risen = Sample { jerk, snap: 0.0, ..rising.advanced(t4) };
        let held = risen.advanced(t3 - t4);
        // The acceleration reaches its peak; its centroid is half way through the rise.
        let top = Sample {
            acceleration,
            jerk: 0.0,
            snap: -snap,
            ..Sample { jerk, snap: -snap, ..held }.advanced(t4)
        };
        let steady = Sample { snap: 0.0, ..top };
        // The ramp is the same seen from its end: v(T - x) = V - v(x), p(T - x) = P - V x + p(x).
        let mirrored = |motion: Sample, x: f64| Sample {
            position: way - speed * x + motion.position,
            velocity: speed - motion.velocity,
            acceleration: motion.acceleration,
            jerk: -motion.jerk,
            snap: motion.snap,
        };
        let (rise, late, plateau) = (t3 + t4, t2 + t4, t3 - t4);
        let falling = mirrored(Sample { jerk, snap: 0.0, ..held }, t3);
        let settled = Sample { snap, ..Sample::cruising(way, speed) };
        Ramp {
            ends: [t4, t3, rise, t2, late, t2 + t3, duration],
            pieces: [
                Piece::new(0.0, t4, rising),
                Piece::new(t4, plateau, risen),
                Piece::new(rise, -t4, top),
                Piece::new(rise, t2 - rise, steady),
                Piece::new(t2, t4, mirrored(top, rise)),
                Piece::new(late, plateau, falling),
                Piece::new(duration, -t4, settled),
            ],
            duration,
            way,
            speed,
        }
    }
}

/// The `x` with `x (x + t)^2 = c`, for `c >= 4 t^3`: where acceleration and velocity stay below their limits.
///
/// Cardano's formula on `y = x + 2t/3`, `y^3 - t^2 y / 3 = c + 2 t^3 / 27`, whose other two roots are complex,
/// and one step of Newton's method.
fn root_without_plateau(c: f64, t: f64) -> f64 {
    let third = t / 3.0;
    let cube = third * third * third;
    let sum = 0.5 * c + cube;
    let u = Real::cbrt(sum + Real::sqrt(0.5 * c * (0.5 * c + 2.0 * cube)));
    let x = u + third * third / u - 2.0 * third;
    let s = x + t;
    x - (x * s * s - c) / (s * (s + 2.0 * x))
}
