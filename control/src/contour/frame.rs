//! Which way a path goes, and how it bends.

use profiles::Real;

use super::error::ContourFault;
use super::vector::{add_scaled, check, dot, scaled, subtract, zip};

/// A path in `N` axes about one of its points: unit tangent `t`, unit normal `n` and curvature `k`.
///
/// All there is to know of a straight path is its tangent; its curvature is zero. A curved one is locally the circle
/// of radius `1 / k` about the point at `n / k` from it, its osculating circle.
///
/// Every constructor answers `None` where there is no direction, at two points that coincide or a velocity of zero:
/// the path is then a point, see [`ContourError::new`](super::ContourError::new). Lengths may have any size, the
/// smallest and the largest included.
///
/// ```
/// use control::PathFrame;
///
/// // A circle of 0.5 m, with its point on the x axis, at 2 m/s and with 3 m/s^2 along the path.
/// let frame = PathFrame::osculating([0.0_f64, 2.0], [-8.0, 3.0])?.ok_or("at rest")?;
/// assert_eq!((frame.tangent(), frame.normal()), ([0.0, 1.0], [-1.0, 0.0]));
/// assert!((frame.curvature() - 2.0).abs() < 1e-15); // 8 m/s^2 over 4 m^2/s^2
/// assert_eq!(PathFrame::between([1.0, 2.0], [1.0, 2.0]), Ok(None));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathFrame<const N: usize, F = f64> {
    pub(super) tangent: [F; N],
    pub(super) normal: [F; N],
    pub(super) curvature: F,
}

// What is left of an acceleration across a straight path is rounding: of the tangent, of two products and of two sums.
const ROUNDINGS: f64 = 8.0;

impl<const N: usize, F: Real> PathFrame<N, F> {
    /// The straight line from a commanded point to the next, `t = (R1 - R0) / |R1 - R0|`.
    ///
    /// # Errors
    /// A coordinate that is not finite.
    #[inline]
    pub fn between(previous: [F; N], current: [F; N]) -> Result<Option<Self>, ContourFault> {
        check("previous point", previous)?;
        check("current point", current)?;
        let mut step = subtract(current, previous);
        if !step.iter().all(|x| x.is_finite()) {
            // Points at opposite ends of the range: half of their distance has the same direction.
            step = zip(current, previous, |b, a| F::HALF * b - F::HALF * a);
        }
        Ok(Self::straight(step))
    }

    /// The tangent along a velocity, or along any other derivative of the path with respect to its parameter.
    ///
    /// # Errors
    /// A component that is not finite.
    #[inline]
    pub fn along(velocity: [F; N]) -> Result<Option<Self>, ContourFault> {
        check("velocity", velocity)?;
        Ok(Self::straight(velocity))
    }

    /// Tangent and osculating circle from velocity `v` and acceleration `a`:
    ///
    /// `t = v / |v|`, `k n = (a - t (t . a)) / |v|^2`
    ///
    /// Both may be derivatives with respect to any parameter, the same for both: the circle does not depend on it. A
    /// parameter of the path itself does not come to rest where the motion does, so that the circle is known there
    /// too; near rest the curvature is otherwise the difference of two large numbers. An acceleration across the path
    /// that is no more than the rounding of `a` counts as none.
    ///
    /// # Errors
    /// A component that is not finite, or a curvature beyond the range of `F`.
    #[inline]
    pub fn osculating(velocity: [F; N], acceleration: [F; N]) -> Result<Option<Self>, ContourFault> {
        check("velocity", velocity)?;
        check("acceleration", acceleration)?;
        let Some(speed) = scaled(velocity) else { return Ok(None) };
        let straight = Self { tangent: speed.unit, normal: [F::ZERO; N], curvature: F::ZERO };
        let Some(change) = scaled(acceleration) else { return Ok(Some(straight)) };
        let across = add_scaled(change.unit, -dot(change.unit, speed.unit), speed.unit);
        let Some(bend) = scaled(across) else { return Ok(Some(straight)) };
        let share = bend.scale * bend.length;
        if share <= F::from_f64(ROUNDINGS) * F::EPSILON {
            return Ok(Some(straight));
        }
        // Where it is a small share of the acceleration it kept some of the tangent.
        let normal = add_scaled(bend.unit, -dot(bend.unit, speed.unit), speed.unit);
        let curvature = (change.scale / speed.scale)
            * (share * change.length / (speed.length * speed.length))
            / speed.scale;
        if curvature.is_finite() {
            Ok(Some(Self { tangent: speed.unit, normal, curvature }))
        } else {
            Err(ContourFault::Range { quantity: "curvature", value: curvature.to_f64() })
        }
    }

    #[inline(always)]
    fn straight(step: [F; N]) -> Option<Self> {
        scaled(step).map(|step| Self { tangent: step.unit, normal: [F::ZERO; N], curvature: F::ZERO })
    }

    /// Unit tangent `t`.
    #[must_use]
    pub fn tangent(&self) -> [F; N] {
        self.tangent
    }

    /// Unit normal `n`, towards the centre of the circle; zero where the path is straight.
    #[must_use]
    pub fn normal(&self) -> [F; N] {
        self.normal
    }

    /// Curvature `k`, the reciprocal of the radius, in the reciprocal of the unit of length; zero where the path is
    /// straight.
    #[must_use]
    pub fn curvature(&self) -> F {
        self.curvature
    }
}
