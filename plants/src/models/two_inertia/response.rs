//! Transfer functions of a two-inertia axis.

use nalgebra::Complex;

use super::TwoInertia;
use crate::error::ModelError;

impl TwoInertia {
    /// From motor torque to motor speed at `s` in rad/s, rad/s per N m:
    ///
    /// `w_m / T_m = (J_l s^2 + (c_l + c_s) s + K) / d(s)`
    ///
    /// with `d(s)`, the cubic of [`poles`](Self::poles). Undamped it is the paper's eq. (3),
    /// `1 / ((J_l + J_m) s) (J_l s^2 + K) / (J_m J_l / (J_l + J_m) s^2 + K)`.
    ///
    /// # Errors
    /// A pole at `s`, or an `s` that is not finite.
    pub fn motor_speed_from_torque(&self, s: Complex<f64>) -> Result<Complex<f64>, ModelError> {
        ratio(self.load_on_spring(s), self.cubic(s), s)
    }

    /// From motor torque to load speed at `s` in rad/s, rad/s per N m:
    ///
    /// `w_l / T_m = (c_s s + K) / d(s)`
    ///
    /// Undamped it is the paper's eq. (4), `1 / ((J_l + J_m) s) K / (J_m J_l / (J_l + J_m) s^2 + K)`.
    ///
    /// # Errors
    /// A pole at `s`, or an `s` that is not finite.
    pub fn load_speed_from_torque(&self, s: Complex<f64>) -> Result<Complex<f64>, ModelError> {
        ratio(self.spring(s), self.cubic(s), s)
    }

    /// From the angle, or the speed, of the motor to that of the load at `s` in rad/s:
    ///
    /// `theta_l / theta_m = (c_s s + K) / (J_l s^2 + (c_l + c_s) s + K)`
    ///
    /// Undamped it is the paper's eq. (2), `K / (J_l s^2 + K)`.
    ///
    /// # Errors
    /// A pole at `s`, or an `s` that is not finite.
    pub fn load_from_motor(&self, s: Complex<f64>) -> Result<Complex<f64>, ModelError> {
        ratio(self.spring(s), self.load_on_spring(s), s)
    }

    fn spring(&self, s: Complex<f64>) -> Complex<f64> {
        s * self.spring_damping + self.stiffness
    }

    fn load_on_spring(&self, s: Complex<f64>) -> Complex<f64> {
        (s * self.load_inertia + (self.load_damping + self.spring_damping)) * s + self.stiffness
    }

    /// The determinant of the equations of motion over `s`.
    fn cubic(&self, s: Complex<f64>) -> Complex<f64> {
        let (motor, load) =
            (s * self.motor_inertia + self.motor_damping, s * self.load_inertia + self.load_damping);
        motor * load * s + (motor + load) * self.spring(s)
    }
}

fn ratio(
    numerator: Complex<f64>,
    denominator: Complex<f64>,
    s: Complex<f64>,
) -> Result<Complex<f64>, ModelError> {
    let value = numerator / denominator;
    if value.re.is_finite() && value.im.is_finite() {
        Ok(value)
    } else {
        Err(ModelError::Pole { re: s.re, im: s.im })
    }
}
