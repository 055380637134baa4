//! The value of a transfer function at a point.

use nalgebra::Complex;

use super::TransferFunction;
use crate::error::ModelError;

impl TransferFunction {
    /// `G(s)` at a point in rad/s, factor by factor: to some roundings for each pole and zero, wherever they are.
    ///
    /// # Errors
    /// A pole at `s`, or an `s` that is not finite.
    pub fn at(&self, s: Complex<f64>) -> Result<Complex<f64>, ModelError> {
        let one = Complex::new(1.0, 0.0);
        let mut value = Complex::new(self.gain, 0.0);
        // A zero for each pole as long as there are some, so that products stay in range.
        for (k, pole) in self.poles.iter().enumerate() {
            let numerator = self.zeros.get(k).map_or(one, |zero| s - zero);
            value = value * numerator / (s - pole);
        }
        if value.re.is_finite() && value.im.is_finite() {
            Ok(value)
        } else {
            Err(ModelError::Pole { re: s.re, im: s.im })
        }
    }

    /// `G(j w)` at an angular frequency `w` in rad/s.
    ///
    /// # Errors
    /// A pole there, or a frequency that is not finite.
    pub fn frequency_response(&self, angular_frequency: f64) -> Result<Complex<f64>, ModelError> {
        self.at(Complex::new(0.0, angular_frequency))
    }

    /// `G(0)`, the output per unit of a constant input.
    ///
    /// # Errors
    /// A pole at the origin.
    pub fn dc_gain(&self) -> Result<f64, ModelError> {
        self.at(Complex::new(0.0, 0.0)).map(|value| value.re)
    }
}
