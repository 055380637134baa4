//! What a profile says about one instant.

use super::Real;

/// Position and its first two derivatives at one instant.
///
/// Lengths may be metres or radians; the unit of every derivative follows (`m`, `m/s`, `m/s^2`).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct State<F = f64> {
    /// Position, m or rad.
    pub position: F,
    /// Velocity, m/s or rad/s.
    pub velocity: F,
    /// Acceleration, m/s^2 or rad/s^2.
    pub acceleration: F,
}

/// Position and its first four derivatives at one instant.
///
/// Where a derivative jumps, the value is the one just after the jump.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sample<F = f64> {
    /// Position, m or rad.
    pub position: F,
    /// Velocity, m/s or rad/s.
    pub velocity: F,
    /// Acceleration, m/s^2 or rad/s^2.
    pub acceleration: F,
    /// Jerk, m/s^3 or rad/s^3.
    pub jerk: F,
    /// Derivative of jerk, m/s^4 or rad/s^4.
    pub snap: F,
}

impl<F: Real> State<F> {
    /// Rest at `position`.
    #[must_use]
    pub fn at_rest(position: F) -> Self {
        Self { position, velocity: F::ZERO, acceleration: F::ZERO }
    }
}

impl<F: Real> Sample<F> {
    /// Rest at `position`.
    #[must_use]
    pub fn at_rest(position: F) -> Self {
        Self { position, velocity: F::ZERO, acceleration: F::ZERO, jerk: F::ZERO, snap: F::ZERO }
    }

    /// The sample without jerk and snap.
    #[must_use]
    pub fn state(self) -> State<F> {
        State { position: self.position, velocity: self.velocity, acceleration: self.acceleration }
    }
}
