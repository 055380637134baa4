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

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::SMatrix;

    const POINTS: [Complex<f64>; 5] = [
        Complex::new(0.0, 1.0),
        Complex::new(0.0, 447.0),
        Complex::new(-3.0, 480.0),
        Complex::new(20.0, 0.0),
        Complex::new(-70.0, -2e4),
    ];

    fn close(found: Result<Complex<f64>, ModelError>, expected: Complex<f64>) {
        let found = found.expect("no pole");
        // Near the resonance the terms of the cubic cancel to about a hundredth.
        assert!((found - expected).norm() <= 1e-13 * expected.norm(), "{found} {expected}");
    }

    #[test]
    fn undamped_they_are_equations_2_to_4() {
        let (m, l, k) = (0.003, 5.066e-4, 100.0);
        let axis = TwoInertia::new(m, l, k).expect("valid");
        for s in POINTS {
            let rigid = (s * (l + m)).inv();
            let flexible = s * s * (m * l / (l + m)) + k;
            close(axis.load_from_motor(s), k / (s * s * l + k));
            close(axis.motor_speed_from_torque(s), rigid * (s * s * l + k) / flexible);
            close(axis.load_speed_from_torque(s), rigid * k / flexible);
        }
    }

    #[test]
    fn damped_they_are_the_state_space() {
        let axis = TwoInertia::new(0.003, 5.066e-4, 100.0)
            .and_then(|a| a.with_damping(0.008, 0.06, 0.02))
            .expect("valid");
        let system = axis.state_space().expect("finite");
        for s in POINTS {
            let resolvent = SMatrix::<Complex<f64>, 4, 4>::from_diagonal_element(s)
                - system.a().map(|entry| Complex::new(entry, 0.0));
            let b = system.b().column(0).map(|entry| Complex::new(entry, 0.0));
            let x = resolvent.lu().solve(&b).expect("no pole");
            close(axis.motor_speed_from_torque(s), x[1]);
            close(axis.load_speed_from_torque(s), x[3]);
            close(axis.load_from_motor(s), x[2] / x[0]);
        }
    }

    #[test]
    fn a_pole_is_an_error() {
        let axis = TwoInertia::new(1.0, 1.0, 1.0).expect("valid");
        let zero = Complex::new(0.0, 0.0);
        assert_eq!(axis.motor_speed_from_torque(zero), Err(ModelError::Pole { re: 0.0, im: 0.0 }));
        // The anti-resonance of the load is at 1 rad/s.
        assert_eq!(axis.load_from_motor(Complex::i()), Err(ModelError::Pole { re: 0.0, im: 1.0 }));
        assert!(axis.load_speed_from_torque(Complex::new(f64::NAN, 0.0)).is_err());
        assert!(axis.load_speed_from_torque(Complex::new(f64::INFINITY, 0.0)).is_err());
    }
}
