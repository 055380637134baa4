//! What a reduction may be told.

use profiles::nurbs::Knots;

/// How a curve is reduced: to what, and what may change on the way.
///
/// ```
/// use optimize::reduction::{Ends, Reduction, Weights};
///
/// let reduction = Reduction { weights: Weights::Ones, ends: Ends::Tangents, ..Reduction::to(3) };
/// # let _ = reduction;
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Reduction {
    /// The degree and the knots of the reduced curve.
    pub target: Target,
    /// Its weights.
    pub weights: Weights,
    /// What is kept at both ends.
    pub ends: Ends,
    /// What is made small.
    pub criterion: Criterion,
}

impl Reduction {
    /// To a degree, with the knots that the curve has; all weights free, end points kept, the largest deviation made
    /// small.
    #[must_use]
    pub const fn to(degree: usize) -> Self {
        Self::with(Target::Degree(degree))
    }

    /// The same onto knots of one's own, which bring their degree.
    #[must_use]
    pub const fn onto(knots: Knots) -> Self {
        Self::with(Target::Knots(knots))
    }

    /// The same to a degree and a tolerance in the unit of the curve, with as many knots as that takes; without a degree
    /// to the one that takes the fewest control points.
    #[must_use]
    pub const fn within(tolerance: f64, degree: Option<usize>) -> Self {
        Self::with(Target::Tolerance { tolerance, degree })
    }

    const fn with(target: Target) -> Self {
        Self { target, weights: Weights::Free, ends: Ends::Points, criterion: Criterion::Largest }
    }
}

/// The degree and the knots of a reduced curve.
#[derive(Debug, Clone, PartialEq)]
pub enum Target {
    /// This degree, with the inner knots of the curve. One that is there `m` times is kept `max(1, m - (p - q))` times,
    /// from degree `p` to `q`: the curve stays as smooth there as it is.
    Degree(usize),
    /// These knots, over the interval of the curve.
    Knots(Knots),
    /// From the knots of [`Target::Degree`] on, the spans that deviate most are halved until none deviates by more than the
    /// tolerance.
    Tolerance {
        /// The largest deviation allowed, in the unit of the curve.
        tolerance: f64,
        /// The degree; none for the one that takes the fewest control points, the lowest of equals.
        degree: Option<usize>,
    },
}

/// The weights of a reduced curve, which are those of its control points up to a common factor.
#[derive(Debug, Clone, PartialEq)]
pub enum Weights {
    /// All one: a polynomial spline.
    Ones,
    /// These.
    Given(Vec<f64>),
    /// Free but for the first and the last, which are the curve's.
    Inner,
    /// All free, from a tenth of the smallest to ten times the largest of the curve where both have the same mean.
    Free,
}

/// What a reduction keeps at both ends: the first point to the bit, the last one to a rounding where its weight changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// The end points.
    Points,
    /// The end points and the directions of the curve there.
    Tangents,
}

/// What a reduction makes small.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Criterion {
    /// The mean square distance in weighted coordinates: a single linear system, which finds a curve that is reducible
    /// without loss to rounding.
    MeanSquare,
    /// The largest distance, from there on.
    Largest,
}
