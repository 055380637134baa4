//! Poles that a motion must not excite.

use num_complex::Complex;

use super::Arc;
use crate::complex;
use crate::polynomial::response::phi_1_2;
use crate::quantities::Mode;

/// A pole `p` at which the transform of a motion must vanish, once or twice.
///
/// With `q(t) = integral of j(u) e^(p (t - u)) du` the first zero is `q(T) = 0`, and the second one
/// `r(T) = |p| integral of j(u) (T - u) e^(p (T - u)) du = 0`, the derivative by the pole: then a mode that differs a
/// little is left vibrating with the square of the difference only.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Zero {
    pole: Complex<f64>,
    double: bool,
    size: f64,
    /// What the response may be left with.
    rest: Complex<f64>,
}

impl Zero {
    /// A zero at a mode's pole.
    #[must_use]
    pub fn new(mode: Mode, double: bool) -> Self {
        Self::at(mode.pole(), double)
    }

    /// A zero at a pole, rad/s.
    #[must_use]
    pub fn at(pole: Complex<f64>, double: bool) -> Self {
        Self { pole, double, size: complex::norm(pole), rest: Complex::default() }
    }

    /// With a response `q(T) = rest`, m/s^2, instead of none.
    #[must_use]
    pub fn with_rest(self, rest: Complex<f64>) -> Self {
        Self { rest, ..self }
    }

    /// What the response is to be at the end, m/s^2.
    #[must_use]
    pub fn rest(&self) -> Complex<f64> {
        self.rest
    }

    /// The pole, rad/s.
    #[must_use]
    pub fn pole(&self) -> Complex<f64> {
        self.pole
    }

    /// Whether the derivative vanishes too.
    #[must_use]
    pub fn is_double(&self) -> bool {
        self.double
    }

    /// Real conditions that it stands for.
    #[must_use]
    pub fn conditions(&self) -> usize {
        if self.double { 4 } else { 2 }
    }

    /// `[q, r]` after an arc that starts with them; `r` is zero where the zero is not double.
    #[must_use]
    pub fn after(&self, response: [Complex<f64>; 2], arc: &Arc) -> [Complex<f64>; 2] {
        self.advanced(response, arc.jerk, arc.duration)
    }

    /// `[q, r]` after a time `d` with the jerk `c`.
    pub(super) fn advanced(&self, [q, r]: [Complex<f64>; 2], c: f64, d: f64) -> [Complex<f64>; 2] {
        let turn = complex::exp(self.pole * d);
        let (phi_1, phi_2) = phi_1_2(self.pole * d);
        // integral of s e^(p s) ds = d^2 (phi_1 - phi_2)
        let later = turn * q + phi_1 * (c * d);
        let slope = if self.double {
            turn * (r + q * (self.size * d)) + (phi_1 - phi_2) * (self.size * c * d * d)
        } else {
            Complex::default()
        };
        [later, slope]
    }

    /// The derivative of `[q(T), r(T)]` by the duration of an arc of jerk `c` that ends with `[q, r]` a time `rest` before
    /// the end.
    pub(super) fn column(&self, [q, r]: [Complex<f64>; 2], c: f64, rest: f64) -> [Complex<f64>; 2] {
        let turn = complex::exp(self.pole * rest);
        let dq = self.pole * q + c;
        let dr = self.pole * r + q * self.size;
        [turn * dq, turn * (dr + dq * (self.size * rest))]
    }

    /// The derivative of `[q, r]` by time where there is no jerk.
    pub(super) fn turned(&self, [q, r]: [Complex<f64>; 2]) -> [Complex<f64>; 2] {
        [self.pole * q, self.pole * r + q * self.size]
    }
}
