//! What a cascade is set to, checked once.

use profiles::Real;

use crate::current::PiGains;
use crate::error::CascadeError;
use crate::feedforward::Feedforward;
use crate::pid::{AntiWindup, Pid, PidGains};

/// A checked configuration of a position loop around a velocity loop, from a reference to a current; any number of axes
/// may share it, each with its own [`CascadeState`](crate::CascadeState).
///
/// Position and velocity are those of the motor, rad and rad/s; with m and m/s the units of the gains change alike.
///
/// ```
/// use control::{Cascade, Feedforward, PiGains};
///
/// let gains = PiGains { kp: 2.3, ki: 33.0 }; // A s/rad, A/rad
/// let inertia_over_torque_constant = 4.1e-3 / 0.7875; // A s^2/rad
/// let cascade = Cascade::new(180.0, gains, 1e-4)? // 1/s, s
///     .with_divisors(10, 2)? // position at 1 kHz, velocity at 5 kHz
///     .with_velocity_feedforward(1.0)?
///     .with_feedforward(Feedforward::NONE.with_acceleration(inertia_over_torque_constant)?)
///     .with_current_limit(20.0)?;
/// assert_eq!(cascade.divisors(), (10, 2));
/// assert!(cascade.with_velocity_feedforward(1.5).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "super::unchecked::UncheckedCascade<F>",
        into = "super::unchecked::UncheckedCascade<F>",
        bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
    )
)]
pub struct Cascade<F = f64> {
    period: F,
    position_divisor: u32,
    velocity_divisor: u32,
    position_gain: F,
    velocity_feedforward: F,
    velocity_limit: F,
    feedforward: Feedforward<F>,
    pub(super) velocity_loop: Pid<F>,
}

impl<F: Real> Cascade<F> {
    /// Position gain `k` in 1/s, gains of the velocity loop in A s/rad and A/rad, and base period in s; both loops at every
    /// base tick, no feedforward, velocity and current unlimited, anti-windup by clamping.
    ///
    /// # Errors
    /// A position gain that is negative, infinite or NaN, gains of the velocity loop that are not finite, or a period that
    /// is not positive and finite.
    pub fn new(position_gain: F, velocity_gains: PiGains<F>, period: F) -> Result<Self, CascadeError> {
        Self {
            period,
            position_divisor: 1,
            velocity_divisor: 1,
            position_gain,
            velocity_feedforward: F::ZERO,
            velocity_limit: F::from_f64(f64::INFINITY),
            feedforward: Feedforward::NONE,
            velocity_loop: Pid::new(pid_gains(velocity_gains), period)?,
        }
        .with_gains(position_gain, velocity_gains)
    }

    /// Replaces the gains; [`Cascade::take_over`] makes the change without a bump.
    ///
    /// # Errors
    /// A position gain that is negative, infinite or NaN, or gains of the velocity loop that are not finite.
    pub fn with_gains(self, position_gain: F, velocity_gains: PiGains<F>) -> Result<Self, CascadeError> {
        if !(position_gain >= F::ZERO && position_gain.is_finite()) {
            return Err(CascadeError::PositionGain(position_gain.to_f64()));
        }
        let velocity_loop = self.velocity_loop.with_gains(pid_gains(velocity_gains))?;
        Ok(Self { position_gain, velocity_loop, ..self })
    }

    /// Replaces how many base ticks pass from one run of the position loop and of the velocity loop to the next.
    ///
    /// # Errors
    /// A divisor of zero, or a period of the velocity loop that leaves the range of `F`.
    pub fn with_divisors(self, position: u32, velocity: u32) -> Result<Self, CascadeError> {
        for (which, divisor) in [("position", position), ("velocity", velocity)] {
            if divisor == 0 {
                return Err(CascadeError::Divisor(which));
            }
        }
        let (lower, upper) = self.velocity_loop.output_limits();
        let velocity_loop = Pid::new(self.velocity_loop.gains(), F::from_u32(velocity) * self.period)?
            .with_output_limits(lower, upper)?
            .with_anti_windup(self.velocity_loop.anti_windup())?;
        Ok(Self { position_divisor: position, velocity_divisor: velocity, velocity_loop, ..self })
    }

    /// Replaces the share of the reference's velocity that is added to the command of the position loop: with one a smooth
    /// reference is followed without lag, with zero the lag is the velocity over the position gain.
    ///
    /// # Errors
    /// A share outside `[0, 1]`.
    pub fn with_velocity_feedforward(self, share: F) -> Result<Self, CascadeError> {
        if share >= F::ZERO && share <= F::ONE {
            Ok(Self { velocity_feedforward: share, ..self })
        } else {
            Err(CascadeError::VelocityFeedforward(share.to_f64()))
        }
    }

    /// Replaces the current that the reference needs: as [`Feedforward`], but in A, that is every gain over the torque
    /// constant (A s/rad, A s^2/rad and so on).
    #[must_use]
    pub fn with_feedforward(self, feedforward: Feedforward<F>) -> Self {
        Self { feedforward, ..self }
    }

    /// Replaces the largest speed that the position loop commands, rad/s; infinity means unlimited.
    ///
    /// # Errors
    /// A limit that is not positive.
    pub fn with_velocity_limit(self, limit: F) -> Result<Self, CascadeError> {
        if limit > F::ZERO {
            Ok(Self { velocity_limit: limit, ..self })
        } else {
            Err(CascadeError::VelocityLimit(limit.to_f64()))
        }
    }

    /// Replaces the largest current, A; infinity means unlimited.
    ///
    /// # Errors
    /// A limit that is not positive.
    pub fn with_current_limit(self, limit: F) -> Result<Self, CascadeError> {
        if limit > F::ZERO {
            Ok(Self { velocity_loop: self.velocity_loop.with_output_limits(-limit, limit)?, ..self })
        } else {
            Err(CascadeError::CurrentLimit(limit.to_f64()))
        }
    }

    /// Replaces the anti-windup of the velocity loop.
    ///
    /// # Errors
    /// A tracking time that is not positive and finite, or whose sum with the period is not.
    pub fn with_anti_windup(self, anti_windup: AntiWindup<F>) -> Result<Self, CascadeError> {
        Ok(Self { velocity_loop: self.velocity_loop.with_anti_windup(anti_windup)?, ..self })
    }

    /// The base period, s.
    #[must_use]
    pub fn period(&self) -> F {
        self.period
    }

    /// Base ticks from one run of the position loop, and of the velocity loop, to the next.
    #[must_use]
    pub fn divisors(&self) -> (u32, u32) {
        (self.position_divisor, self.velocity_divisor)
    }

    /// The position gain, 1/s.
    #[must_use]
    pub fn position_gain(&self) -> F {
        self.position_gain
    }

    /// The gains of the velocity loop, A s/rad and A/rad.
    #[must_use]
    pub fn velocity_gains(&self) -> PiGains<F> {
        let PidGains { kp, ki, .. } = self.velocity_loop.gains();
        PiGains { kp, ki }
    }

    /// The share of the reference's velocity in the command of the position loop.
    #[must_use]
    pub fn velocity_feedforward(&self) -> F {
        self.velocity_feedforward
    }

    /// The current that the reference needs, A.
    #[must_use]
    pub fn feedforward(&self) -> Feedforward<F> {
        self.feedforward
    }

    /// The largest speed that the position loop commands, rad/s.
    #[must_use]
    pub fn velocity_limit(&self) -> F {
        self.velocity_limit
    }

    /// The largest current, A.
    #[must_use]
    pub fn current_limit(&self) -> F {
        self.velocity_loop.output_limits().1
    }

    /// The anti-windup of the velocity loop.
    #[must_use]
    pub fn anti_windup(&self) -> AntiWindup<F> {
        self.velocity_loop.anti_windup()
    }

    /// What the position loop commands, rad/s.
    #[inline]
    pub(super) fn commanded_velocity(&self, position_error: F, reference_velocity: F) -> F {
        let command = self.position_gain * position_error + self.velocity_feedforward * reference_velocity;
        if command > self.velocity_limit {
            self.velocity_limit
        } else if command < -self.velocity_limit {
            -self.velocity_limit
        } else {
            command
        }
    }
}

fn pid_gains<F: Real>(PiGains { kp, ki }: PiGains<F>) -> PidGains<F> {
    PidGains { kp, ki, kd: F::ZERO }
}
