//! Limits of an actuator.

use nalgebra::SVector;
use profiles::Real;

use crate::error::SimulationError;

/// What an actuator realises of an input command.
///
/// ```
/// use plants::{Saturation, nalgebra::{self, vector}};
///
/// let inverter = Saturation::norm(10.0)?;
/// assert_eq!(inverter.apply(&vector![12.0, 16.0]), vector![6.0, 8.0]);
/// let valve = Saturation::bounds(vector![0.0], vector![1.0])?;
/// assert_eq!(valve.apply(&vector![-0.5]), vector![0.0]);
/// # Ok::<(), plants::SimulationError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Saturation<const M: usize> {
    kind: Kind<M>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind<const M: usize> {
    None,
    Bounds { lower: SVector<f64, M>, upper: SVector<f64, M> },
    // Of the first `count` inputs.
    Norm { count: usize, limit: f64 },
}

impl<const M: usize> Saturation<M> {
    /// An actuator without limits.
    #[must_use]
    pub fn none() -> Self {
        Self { kind: Kind::None }
    }

    /// Every input between its lower and its upper bound, which may be infinite.
    ///
    /// # Errors
    /// Bounds that are NaN or in the wrong order.
    pub fn bounds(lower: SVector<f64, M>, upper: SVector<f64, M>) -> Result<Self, SimulationError> {
        for (&lower, &upper) in lower.iter().zip(upper.iter()) {
            // An infinity on the wrong side would leave no finite input.
            if !(lower <= upper && lower < f64::INFINITY && upper > f64::NEG_INFINITY) {
                return Err(SimulationError::Saturation { lower, upper });
            }
        }
        Ok(Self { kind: Kind::Bounds { lower, upper } })
    }

    /// Every input of at most `limit` either way.
    ///
    /// # Errors
    /// A limit that is negative or NaN.
    pub fn symmetric(limit: f64) -> Result<Self, SimulationError> {
        Self::bounds(SVector::repeat(-limit), SVector::repeat(limit))
    }

    /// Inputs of a Euclidean norm of at most `limit`, like the voltage circle of an inverter; a longer vector keeps
    /// its direction.
    ///
    /// # Errors
    /// A limit that is negative or NaN.
    pub fn norm(limit: f64) -> Result<Self, SimulationError> {
        Self::leading_norm(M, limit)
    }

    /// As [`norm`](Self::norm), of the first `count` inputs alone; those that follow pass.
    ///
    /// # Errors
    /// A limit that is negative or NaN.
    ///
    /// ```
    /// use plants::{Saturation, nalgebra::{self, vector}};
    ///
    /// // Two voltages and a load torque.
    /// let inverter = Saturation::leading_norm(2, 10.0)?;
    /// assert_eq!(inverter.apply(&vector![12.0, 16.0, 50.0]), vector![6.0, 8.0, 50.0]);
    /// # Ok::<(), plants::SimulationError>(())
    /// ```
    pub fn leading_norm(count: usize, limit: f64) -> Result<Self, SimulationError> {
        if limit >= 0.0 {
            Ok(Self { kind: Kind::Norm { count, limit } })
        } else {
            Err(SimulationError::Saturation { lower: 0.0, upper: limit })
        }
    }

    /// As [`symmetric`](Self::symmetric), of a limit known to be positive.
    pub(crate) fn symmetric_unchecked(limit: f64) -> Self {
        Self { kind: Kind::Bounds { lower: SVector::repeat(-limit), upper: SVector::repeat(limit) } }
    }

    /// As [`leading_norm`](Self::leading_norm) of two inputs, of a limit known to be positive.
    pub(crate) fn circle_unchecked(limit: f64) -> Self {
        Self { kind: Kind::Norm { count: 2, limit } }
    }

    /// The input realised of a finite command.
    #[inline]
    #[must_use]
    pub fn apply(&self, command: &SVector<f64, M>) -> SVector<f64, M> {
        match &self.kind {
            Kind::None => *command,
            Kind::Bounds { lower, upper } => {
                let mut realised = *command;
                for ((x, lower), upper) in realised.iter_mut().zip(lower.iter()).zip(upper.iter()) {
                    *x = Real::clamped(*x, *lower, *upper);
                }
                realised
            }
            Kind::Norm { count, limit } => {
                let leading = || command.iter().take(*count);
                let largest = leading().fold(0.0_f64, |largest, x| largest.max(x.abs()));
                if largest <= 0.0 {
                    return *command;
                }
                // Scaled, so that the square of a large command does not overflow.
                let square: f64 = leading().map(|x| (x / largest) * (x / largest)).sum();
                let length = Real::sqrt(square);
                let mut realised = *command;
                if largest * length > *limit {
                    realised.iter_mut().take(*count).for_each(|x| *x = *x / largest * (*limit / length));
                }
                realised
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::vector;

    #[test]
    fn bounds_and_circles() {
        let bounds =
            Saturation::bounds(vector![-1.0, f64::NEG_INFINITY], vector![2.0, 0.0]).expect("ordered");
        assert_eq!(bounds.apply(&vector![-3.0, -3.0]), vector![-1.0, -3.0]);
        assert_eq!(bounds.apply(&vector![3.0, 3.0]), vector![2.0, 0.0]);
        assert_eq!(Saturation::none().apply(&vector![1e300]), vector![1e300]);
        let circle = Saturation::norm(5.0).expect("positive");
        assert_eq!(circle.apply(&vector![3.0, -4.0]), vector![3.0, -4.0]);
        assert_eq!(circle.apply(&vector![0.0, 0.0]), vector![0.0, 0.0]);
        assert!((circle.apply(&vector![3e300, 4e300]) - vector![3.0, 4.0]).norm() < 1e-15);
        let leading = Saturation::leading_norm(2, 5.0).expect("positive");
        assert_eq!(leading.apply(&vector![-30.0, 40.0, 1e3]), vector![-3.0, 4.0, 1e3]);
        assert_eq!(leading.apply(&vector![3.0, 4.0, -1e3]), vector![3.0, 4.0, -1e3]);
        assert_eq!(Saturation::circle_unchecked(5.0).apply(&vector![-30.0]), vector![-5.0]);
    }

    #[test]
    fn bad_limits_are_errors() {
        assert!(Saturation::bounds(vector![1.0], vector![-1.0]).is_err());
        assert!(Saturation::bounds(vector![f64::INFINITY], vector![f64::INFINITY]).is_err());
        assert!(Saturation::<1>::symmetric(-1.0).is_err());
        assert!(Saturation::<1>::symmetric(f64::NAN).is_err());
        assert!(Saturation::<2>::norm(f64::NAN).is_err());
    }
}
