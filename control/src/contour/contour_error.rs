//! How far a position is from a path.

use profiles::Real;

use super::error::ContourFault;
use super::frame::PathFrame;
use super::vector::{add_scaled, check, dot, in_range, norm, subtract};

/// What a path was taken for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ContourBasis {
    /// The commanded point: there is no direction, and the whole tracking error is contour error.
    Point,
    /// The line through the commanded point.
    Line,
    /// The circle through the commanded point.
    Circle,
}

/// The contour error `e` of `N` axes: the shortest way from the actual position `P` to the path, `e = Q - P`.
///
/// It points from the actual position to the path, as the tracking error `E = R - P` points from the actual position
/// to the commanded one, `R`. Adding more of it to `E` pulls the axes towards the path; see
/// [`CrossCoupling`](super::CrossCoupling).
///
/// What it is worth depends on what is known of the path. With a lag `l` along a path of curvature `k`, and `h`
/// between commanded points, the path leaves
///
/// - the line through the last two commanded points, [`from_points`](Self::from_points), by `k l (l - h) / 2`: second
///   order in lag and spacing together, first in each;
/// - its tangent, [`from_tangent`](Self::from_tangent), by `k l^2 / 2`: second order in the lag;
/// - its osculating circle, [`from_circle`](Self::from_circle), by `l^3 / 6` times the change of the curvature vector
///   per length: third order in the lag. On a circle it is exact.
///
/// On a straight path all three are exact.
///
/// ```
/// use control::{ContourBasis, ContourError};
///
/// // Two commanded points along x: what counts is the distance in y.
/// let error = ContourError::from_points([0.0, 0.0], [1.0, 0.0], [0.75, -0.25])?;
/// assert_eq!(error.vector(), [0.0, 0.25]);
/// assert_eq!((error.magnitude(), error.basis()), (0.25, ContourBasis::Line));
/// // Two that coincide: the path is a point.
/// let error = ContourError::from_points([1.0, 0.0], [1.0, 0.0], [0.75, -0.25])?;
/// assert_eq!((error.vector(), error.basis()), ([0.25, 0.25], ContourBasis::Point));
/// # Ok::<(), control::ContourFault>(())
/// ```
///
/// # References
/// W. Wang, Z. Chen, Z. Wang, "Compensation sliding cross coupling control research of Cartesian coordinate robot",
/// Journal of System Simulation 33 (2021), eq. (6) to (14), doi:10.16182/j.issn1004731x.joss.19-0646.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContourError<const N: usize, F = f64> {
    vector: [F; N],
    /// The tangent where the path is nearest; zero of a point.
    tangent: [F; N],
    basis: ContourBasis,
}

impl<const N: usize, F: Real> ContourError<N, F> {
    /// From the tracking error `E = R - P` and the path about `R`, with the guard for a path without a direction: it
    /// is then the point `R`, and `e = E`. Of a line it is what is across, of a circle the way to its nearest point:
    ///
    /// ```text
    /// line     e = E - p t                                          p = t . E
    /// circle   e = E - p t - s n + m (k p t + (1 + k s) n) / g      s = n . E
    ///          g^2 = (k p)^2 + (1 + k s)^2,  m = (2 s + k (p^2 + s^2)) / (1 + g)
    /// ```
    ///
    /// `g` is the distance from the axis of the circle and `m` that from its rim, beyond it positive, in its plane. At
    /// the axis all of the rim is equally near, and `e = E`.
    ///
    /// # Errors
    /// An error that is not finite, or one so large that `e` is not.
    #[inline(always)]
    pub fn new(error: [F; N], path: Option<&PathFrame<N, F>>) -> Result<Self, ContourFault> {
        check("tracking error", error)?;
        let Some(path) = path else {
            return Ok(Self { vector: error, tangent: [F::ZERO; N], basis: ContourBasis::Point });
        };
        let along = dot(path.tangent, error);
        if path.curvature <= F::ZERO {
            let vector = in_range("contour error", add_scaled(error, -along, path.tangent))?;
            return Ok(Self { vector, tangent: path.tangent, basis: ContourBasis::Line });
        }
        let inwards = dot(path.normal, error);
        let (x, y) = (path.curvature * along, F::ONE + path.curvature * inwards);
        let radius = (x * x + y * y).sqrt();
        let beyond =
            (inwards + inwards + path.curvature * (along * along + inwards * inwards)) / (F::ONE + radius);
        // The way to the axis; on it, the way back to the commanded point.
        let (x, y) = if radius > F::ZERO { (x / radius, y / radius) } else { (F::ZERO, F::ONE) };
        let vector = add_scaled(error, beyond * x - along, path.tangent);
        let vector = in_range("contour error", add_scaled(vector, beyond * y - inwards, path.normal))?;
        let tangent = path.tangent.map(|t| y * t);
        Ok(Self { vector, tangent: add_scaled(tangent, -x, path.normal), basis: ContourBasis::Circle })
    }

    /// The paper's: from the last two commanded points and the actual position, eq. (14),
    ///
    /// `e = E - R (E . R) / |R|^2` with `R = R1 - R0` and `E = R1 - P`
    ///
    /// It divides by zero where the points coincide: there the path is the point, and `e = E`.
    /// [`CommandedPath`](super::CommandedPath) keeps the last direction instead.
    ///
    /// # Errors
    /// A coordinate that is not finite, or points so far apart that the error has no representation.
    #[inline]
    pub fn from_points(previous: [F; N], current: [F; N], actual: [F; N]) -> Result<Self, ContourFault> {
        let path = PathFrame::between(previous, current)?;
        check("actual position", actual)?;
        Self::new(in_range("tracking error", subtract(current, actual))?, path.as_ref())
    }

    /// From the tracking error and the velocity of the reference, which is tangential.
    ///
    /// # Errors
    /// An input that is not finite, or an error so large that `e` is not.
    #[inline]
    pub fn from_tangent(error: [F; N], velocity: [F; N]) -> Result<Self, ContourFault> {
        Self::new(error, PathFrame::along(velocity)?.as_ref())
    }

    /// From the tracking error and the osculating circle, see [`PathFrame::osculating`].
    ///
    /// # Errors
    /// An input that is not finite, a curvature beyond the range of `F`, or an error so large that `e` is not finite.
    #[inline]
    pub fn from_circle(error: [F; N], velocity: [F; N], acceleration: [F; N]) -> Result<Self, ContourFault> {
        Self::new(error, PathFrame::osculating(velocity, acceleration)?.as_ref())
    }

    /// The vector `e`, in the unit of the positions.
    #[must_use]
    pub fn vector(&self) -> [F; N] {
        self.vector
    }

    /// The distance `|e|` in the unit of the positions; at most the largest finite number.
    #[must_use]
    pub fn magnitude(&self) -> F {
        norm(self.vector)
    }

    /// What the path was taken for.
    #[must_use]
    pub fn basis(&self) -> ContourBasis {
        self.basis
    }

    /// The part of a vector across the path where it is nearest; all of it where the path is a point. Of the rate of
    /// the tracking error it is the rate of `e`, but for the turn of the path, of the order of `k |E|` of it.
    #[inline(always)]
    #[must_use]
    pub fn across(&self, vector: [F; N]) -> [F; N] {
        add_scaled(vector, -dot(self.tangent, vector), self.tangent)
    }
}
