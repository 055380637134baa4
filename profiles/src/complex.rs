//! Complex functions through `libm`, so that they do not depend on the platform or on who enables `std`.

use num_complex::Complex;

use crate::quantities::Real;

/// `e^z`.
#[must_use]
pub fn exp(z: Complex<f64>) -> Complex<f64> {
    let magnitude = Real::exp(z.re);
    let (sine, cosine) = Real::sin_cos(z.im);
    Complex::new(magnitude * cosine, magnitude * sine)
}

/// `|z|`.
#[must_use]
pub fn norm(z: Complex<f64>) -> f64 {
    libm::hypot(z.re, z.im)
}
