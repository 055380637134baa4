//! Which way a path goes, and how it bends.

use profiles::Real;

use super::error::ContourFault;
use super::vector::{add_scaled, check, dot, is_ordinary, scaled, subtract, unit, zip};

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
        let step = subtract(current, previous);
        let square = dot(step, step);
        if is_ordinary(square) {
            Ok(Some(Self::straight(unit(step, square))))
        } else {
            between(previous, current)
        }
    }

    /// The tangent along a velocity, or along any other derivative of the path with respect to its parameter.
    ///
    /// # Errors
    /// A component that is not finite.
    #[inline]
    pub fn along(velocity: [F; N]) -> Result<Option<Self>, ContourFault> {
        let square = dot(velocity, velocity);
        if is_ordinary(square) { Ok(Some(Self::straight(unit(velocity, square)))) } else { along(velocity) }
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
        let (speed, change) = (dot(velocity, velocity), dot(acceleration, acceleration));
        if !(is_ordinary(speed) & is_ordinary(change)) {
            return osculating(velocity, acceleration);
        }
        let frame = Self::bent(velocity, speed, acceleration, change);
        if frame.curvature.is_finite() { Ok(Some(frame)) } else { Err(too_bent(frame.curvature)) }
    }

    #[inline(always)]
    fn straight(tangent: [F; N]) -> Self {
        Self { tangent, normal: [F::ZERO; N], curvature: F::ZERO }
    }

    /// From velocity, acceleration and their squares, which are ordinary.
    #[inline(always)]
    fn bent(velocity: [F; N], speed: F, acceleration: [F; N], change: F) -> Self {
        let tangent = unit(velocity, speed);
        let across = add_scaled(acceleration, -dot(acceleration, tangent), tangent);
        let bend = dot(across, across);
        let rounding = F::from_f64(ROUNDINGS) * F::EPSILON;
        if bend <= rounding * rounding * change {
            return Self::straight(tangent);
        }
        let normal = unit(across, bend);
        // Where it is a small share of the acceleration it kept some of the tangent.
        let normal = add_scaled(normal, -dot(normal, tangent), tangent);
        Self { tangent, normal, curvature: bend.sqrt() / speed }
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

/// Points whose distance is not ordinary, or that are not finite.
#[cold]
fn between<const N: usize, F: Real>(
    previous: [F; N],
    current: [F; N],
) -> Result<Option<PathFrame<N, F>>, ContourFault> {
    check("previous point", previous)?;
    check("current point", current)?;
    // Points at opposite ends of the range: half of their distance has the same direction, and others lose nothing.
    let far = !subtract(current, previous).iter().all(|x| x.is_finite());
    let share = if far { F::HALF } else { F::ONE };
    along(zip(current, previous, |b, a| share * b - share * a))
}

/// A velocity whose square is not ordinary, or that is not finite.
#[cold]
fn along<const N: usize, F: Real>(velocity: [F; N]) -> Result<Option<PathFrame<N, F>>, ContourFault> {
    check("velocity", velocity)?;
    Ok(scaled(velocity).map(|(velocity, _)| PathFrame::straight(unit(velocity, dot(velocity, velocity)))))
}

/// The circle of the same vectors over their sizes is as much flatter.
#[cold]
fn osculating<const N: usize, F: Real>(
    velocity: [F; N],
    acceleration: [F; N],
) -> Result<Option<PathFrame<N, F>>, ContourFault> {
    check("velocity", velocity)?;
    check("acceleration", acceleration)?;
    let (Some((velocity, speed)), Some((acceleration, change))) = (scaled(velocity), scaled(acceleration))
    else {
        return along(velocity);
    };
    let mut frame =
        PathFrame::bent(velocity, dot(velocity, velocity), acceleration, dot(acceleration, acceleration));
    if frame.curvature > F::ZERO {
        frame.curvature = frame.curvature * (change / speed) / speed;
    }
    if frame.curvature.is_finite() { Ok(Some(frame)) } else { Err(too_bent(frame.curvature)) }
}

#[cold]
fn too_bent<F: Real>(curvature: F) -> ContourFault {
    ContourFault::Range { quantity: "curvature", value: curvature.to_f64() }
}
