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
    /// Constant velocity through `position`.
    #[must_use]
    pub fn cruising(position: F, velocity: F) -> Self {
        Self { velocity, ..Self::at_rest(position) }
    }

    /// Rest at `position`.
    #[must_use]
    pub fn at_rest(position: F) -> Self {
        Self { position, velocity: F::ZERO, acceleration: F::ZERO, jerk: F::ZERO, snap: F::ZERO }
    }

    /// The motion `dt` seconds later (earlier, where negative) if snap keeps its value.
    #[inline]
    #[must_use]
    pub fn advanced(self, dt: F) -> Self {
        // Nested Taylor series: p + dt (v + dt/2 (a + dt/3 (j + dt/4 s))) and its derivatives.
        let half = dt * F::HALF;
        let third = dt * F::from_f64(1.0 / 3.0);
        let quarter = half * F::HALF;
        Self {
            position: self.position
                + dt * (self.velocity
                    + half * (self.acceleration + third * (self.jerk + quarter * self.snap))),
            velocity: self.velocity + dt * (self.acceleration + half * (self.jerk + third * self.snap)),
            acceleration: self.acceleration + dt * (self.jerk + half * self.snap),
            jerk: self.jerk + dt * self.snap,
            snap: self.snap,
        }
    }

    /// The motion `dt` seconds later if velocity keeps its value, finite also where `dt` is not.
    #[inline]
    #[must_use]
    pub fn coasted(self, dt: F) -> Self {
        let dt = dt.clamped(-F::MAX, F::MAX);
        Self::cruising((self.position + self.velocity * dt).clamped(-F::MAX, F::MAX), self.velocity)
    }

    /// The sample without jerk and snap.
    #[must_use]
    pub fn state(self) -> State<F> {
        State { position: self.position, velocity: self.velocity, acceleration: self.acceleration }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn advancing_is_the_taylor_series() {
        let now = Sample { position: 1.0, velocity: -2.0, acceleration: 3.0, jerk: 5.0, snap: -7.0 };
        // Summed by hand at dt = 2: 1 - 4 + 6 + 40/6 - 112/24, -2 + 6 + 10 - 56/6, 3 + 10 - 14, 5 - 14.
        let later = now.advanced(2.0);
        assert!((later.position - 5.0).abs() < 1e-14);
        assert!((later.velocity - 14.0 / 3.0).abs() < 1e-14);
        assert!((later.acceleration + 1.0).abs() < 1e-14);
        assert!((later.jerk + 9.0).abs() < 1e-14);
        let back = later.advanced(-2.0);
        assert!((back.position - now.position).abs() < 1e-13 && (back.velocity - now.velocity).abs() < 1e-13);
    }
}
