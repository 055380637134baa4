//! A vibration mode.

use num_complex::Complex;

use super::Real;
use crate::error::ModeError;

/// A vibration mode: undamped angular frequency `w` in rad/s and damping ratio `z`, with `0 <= z < 1`.
///
/// Its pole in the upper half plane is `-z w + i w sqrt(1 - z^2)`.
///
/// ```
/// use profiles::Mode;
///
/// let mode = Mode::from_hz(40.0, 0.1)?;
/// assert!((mode.hz() - 40.0).abs() < 1e-12);
/// assert!(Mode::from_hz(40.0, 1.0).is_err());
/// # Ok::<(), profiles::ModeError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedMode"))]
pub struct Mode {
    angular_frequency: f64,
    damping_ratio: f64,
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct UncheckedMode {
    angular_frequency: f64,
    damping_ratio: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<UncheckedMode> for Mode {
    type Error = ModeError;
    fn try_from(mode: UncheckedMode) -> Result<Self, ModeError> {
        Self::new(mode.angular_frequency, mode.damping_ratio)
    }
}

impl Mode {
    /// A mode from its undamped angular frequency in rad/s and its damping ratio.
    ///
    /// # Errors
    /// A frequency that is not positive and finite, or a damping ratio outside `[0, 1)`.
    pub fn new(angular_frequency: f64, damping_ratio: f64) -> Result<Self, ModeError> {
        // A subnormal frequency has too few digits for its damped one.
        if !(angular_frequency >= f64::MIN_POSITIVE && angular_frequency.is_finite()) {
            return Err(ModeError::Frequency(angular_frequency));
        }
        if !(0.0..1.0).contains(&damping_ratio) {
            return Err(ModeError::DampingRatio(damping_ratio));
        }
        Ok(Self { angular_frequency, damping_ratio })
    }

    /// A mode from its undamped frequency in Hz and its damping ratio.
    ///
    /// # Errors
    /// As [`Mode::new`].
    pub fn from_hz(frequency: f64, damping_ratio: f64) -> Result<Self, ModeError> {
        Self::new(frequency * core::f64::consts::TAU, damping_ratio)
    }

    /// Undamped angular frequency `w`, rad/s.
    #[must_use]
    pub fn angular_frequency(&self) -> f64 {
        self.angular_frequency
    }

    /// Undamped frequency, Hz.
    #[must_use]
    pub fn hz(&self) -> f64 {
        self.angular_frequency / core::f64::consts::TAU
    }

    /// Damping ratio `z`.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        self.damping_ratio
    }

    /// Damped angular frequency `w sqrt(1 - z^2)`, rad/s.
    #[must_use]
    pub fn damped_angular_frequency(&self) -> f64 {
        // (1 - z)(1 + z) keeps its digits where 1 - z^2 would not.
        self.angular_frequency * Real::sqrt((1.0 - self.damping_ratio) * (1.0 + self.damping_ratio))
    }

    /// Period of the damped oscillation, s.
    #[must_use]
    pub fn damped_period(&self) -> f64 {
        core::f64::consts::TAU / self.damped_angular_frequency()
    }

    /// The pole with positive imaginary part, rad/s.
    #[must_use]
    pub fn pole(&self) -> Complex<f64> {
        Complex::new(-self.damping_ratio * self.angular_frequency, self.damped_angular_frequency())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pole_has_the_frequency_and_the_damping() {
        let mode = Mode::new(12.0, 0.3).expect("valid");
        let pole = mode.pole();
        assert!((pole.norm() - 12.0).abs() < 1e-14);
        assert!((-pole.re / pole.norm() - 0.3).abs() < 1e-15);
        assert!((mode.damped_period() * pole.im - core::f64::consts::TAU).abs() < 1e-14);
    }

    #[test]
    fn bad_numbers_are_named() {
        assert_eq!(Mode::new(-1.0, 0.1), Err(ModeError::Frequency(-1.0)));
        assert_eq!(Mode::new(1.0, 1.0), Err(ModeError::DampingRatio(1.0)));
        assert!(matches!(Mode::new(1.0, f64::NAN), Err(ModeError::DampingRatio(z)) if z.is_nan()));
        assert!(matches!(Mode::from_hz(f64::INFINITY, 0.1), Err(ModeError::Frequency(_))));
    }
}
