//! What can be wrong with a reduction, with the number that is wrong.

use profiles::nurbs::NurbsError;
use thiserror::Error;

/// A reduction that cannot be, or a curve that it cannot be judged by.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ReductionError {
    /// A degree that is none, or not below the curve's.
    #[error("the degree must be at least 1 and below the curve's, {curve}, got {degree}")]
    Degree {
        /// The degree asked for.
        degree: usize,
        /// The degree of the curve.
        curve: usize,
    },
    /// Curves or knots over different intervals of the parameter.
    #[error("the parameter must run from {lower} to {upper}, as that of the curve does, got {from} to {to}")]
    Domain {
        /// Start of the curve.
        lower: f64,
        /// End of the curve.
        upper: f64,
        /// Start of the other one.
        from: f64,
        /// End of the other one.
        to: f64,
    },
    /// A tolerance that is not positive and finite.
    #[error("the tolerance must be positive and finite, got {0}")]
    Tolerance(f64),
    /// A tolerance that is not met with the most knots that are tried.
    #[error("with {points} control points the curve still deviates by {deviation}, allowed are {tolerance}")]
    NotReached {
        /// Control points of the last attempt.
        points: usize,
        /// Its deviation, in the unit of the curve.
        deviation: f64,
        /// The deviation allowed.
        tolerance: f64,
    },
    /// Weights given for knots that the reduction chooses.
    #[error("{0} weights were given for knots that are not known yet")]
    WeightsWithoutKnots(usize),
    /// A curve that stands still at an end, where its tangent is to be kept.
    #[error("the curve has no tangent at the parameter {0}")]
    NoTangent(f64),
    /// Tangents at both ends of a curve whose control points are all tied by them.
    #[error("tangents at both ends take at least four control points, there are {0}")]
    TooFewForTangents(usize),
    /// Fewer than two samples, or more than a million.
    #[error("a search takes 2 to 1000000 samples, got {0}")]
    Samples(usize),
    /// A bound of a search out of range.
    #[error("{quantity} must be {range}, got {value}")]
    Number {
        /// Which number.
        quantity: &'static str,
        /// The range it must lie in.
        range: &'static str,
        /// The value given.
        value: f64,
    },
    /// A candidate with another number of coordinates than the search has unknowns.
    #[error("a candidate has {given} coordinates, the search {unknowns} unknowns")]
    Candidate {
        /// Coordinates of the candidate.
        given: usize,
        /// Unknowns of the search.
        unknowns: usize,
    },
    /// Nothing to search: every point, weight and knot is fixed.
    #[error("all of the curve is fixed, there is nothing to search")]
    NoUnknowns,
    /// Knots, points or weights that make no curve.
    #[error(transparent)]
    Curve(#[from] NurbsError),
}
