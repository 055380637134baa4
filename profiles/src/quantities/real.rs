//! The scalar of a control tick.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A real scalar, `f32` or `f64`.
///
/// Every elementary function calls `libm` directly, so a result does not depend on the platform or on which
/// crate of a build enables `std`.
///
/// ```
/// use profiles::Real;
///
/// fn hypotenuse<F: Real>(a: F, b: F) -> F {
///     (a * a + b * b).sqrt()
/// }
/// assert_eq!(hypotenuse(3.0_f32, 4.0), 5.0);
/// ```
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialEq
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
    + Send
    + Sync
    + 'static
{
    /// Zero.
    const ZERO: Self;
    /// One.
    const ONE: Self;
    /// One half.
    const HALF: Self;
    /// Distance from one to the next larger number.
    const EPSILON: Self;
    /// Largest finite number.
    const MAX: Self;

    /// The nearest number of this type.
    fn from_f64(value: f64) -> Self;
    /// The nearest number of this type.
    fn from_u32(value: u32) -> Self;
    /// The same number in double precision.
    fn to_f64(self) -> f64;
    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// NaN.
    fn is_nan(self) -> bool;
    /// Magnitude.
    fn abs(self) -> Self;
    /// The magnitude of `self` with the sign of `sign`.
    fn copysign(self, sign: Self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Cube root, also of negative numbers.
    fn cbrt(self) -> Self;
    /// Sine of an angle in rad.
    fn sin(self) -> Self;
    /// Cosine of an angle in rad.
    fn cos(self) -> Self;
    /// Sine and cosine of an angle in rad.
    fn sin_cos(self) -> (Self, Self);
    /// Angle in rad of the point `(x, self)`.
    fn atan2(self, x: Self) -> Self;
    /// Natural exponential.
    fn exp(self) -> Self;
    /// Two to the power of `self`.
    fn exp2(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Real power.
    fn powf(self, exponent: Self) -> Self;
    /// Largest integer not above `self`.
    fn floor(self) -> Self;
    /// Smallest integer not below `self`.
    fn ceil(self) -> Self;
    /// Nearest integer, halves away from zero.
    fn round(self) -> Self;

    /// The smaller of two numbers; the other one if one of them is NaN.
    #[inline]
    fn min(self, other: Self) -> Self {
        if self < other || other.is_nan() { self } else { other }
    }

    /// The larger of two numbers; the other one if one of them is NaN.
    #[inline]
    fn max(self, other: Self) -> Self {
        if self > other || other.is_nan() { self } else { other }
    }

    /// `self` brought into `[lower, upper]`; never panics, and gives `lower` for NaN.
    #[inline]
    fn clamped(self, lower: Self, upper: Self) -> Self {
        self.max(lower).min(upper)
    }
}

macro_rules! real {
    ($float:ident, $($name:ident => $libm:ident),* ; $sqrt:ident $sincos:ident $atan2:ident $pow:ident) => {
        impl Real for $float {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const HALF: Self = 0.5;
            const EPSILON: Self = $float::EPSILON;
            const MAX: Self = $float::MAX;

            #[inline]
            fn from_f64(value: f64) -> Self {
                value as $float
            }
            #[inline]
            fn from_u32(value: u32) -> Self {
                value as $float
            }
            #[inline]
            fn to_f64(self) -> f64 {
                self as f64
            }
            #[inline]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }
            #[inline]
            fn is_nan(self) -> bool {
                $float::is_nan(self)
            }
            #[inline]
            fn abs(self) -> Self {
                $float::abs(self)
            }
            #[inline]
            fn copysign(self, sign: Self) -> Self {
                $float::copysign(self, sign)
            }
            #[inline]
            fn sqrt(self) -> Self {
                libm::$sqrt(self)
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                libm::$sincos(self)
            }
            #[inline]
            fn atan2(self, x: Self) -> Self {
                libm::$atan2(self, x)
            }
            #[inline]
            fn powf(self, exponent: Self) -> Self {
                libm::$pow(self, exponent)
            }
            $(
                #[inline]
                fn $name(self) -> Self {
                    libm::$libm(self)
                }
            )*
        }
    };
}

real!(f64, cbrt => cbrt, sin => sin, cos => cos, exp => exp, exp2 => exp2, ln => log, floor => floor, ceil => ceil, round => round; sqrt sincos atan2 pow);
real!(f32, cbrt => cbrtf, sin => sinf, cos => cosf, exp => expf, exp2 => exp2f, ln => logf, floor => floorf, ceil => ceilf, round => roundf; sqrtf sincosf atan2f powf);

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "numbers that are exact in binary")]
mod tests {
    use super::Real;

    #[test]
    fn clamping_never_panics() {
        assert_eq!(Real::clamped(f64::NAN, -1.0, 2.0), -1.0);
        assert_eq!(Real::clamped(5.0, 2.0, -1.0), -1.0);
        assert_eq!(Real::clamped(0.5_f32, -1.0, 2.0), 0.5);
    }

    #[test]
    fn minimum_and_maximum_ignore_nan() {
        assert_eq!(Real::min(f64::NAN, 1.0), 1.0);
        assert_eq!(Real::max(1.0, f64::NAN), 1.0);
    }
}
