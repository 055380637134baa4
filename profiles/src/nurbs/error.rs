//! What can be wrong with a curve or with what is asked of it.

use thiserror::Error;

/// A curve that cannot be, or an operation that it does not have.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum NurbsError {
    /// A degree that no curve has here.
    #[error("the degree must lie in [1, {most}], got {degree}")]
    Degree {
        /// The degree asked for.
        degree: usize,
        /// The highest degree.
        most: usize,
    },
    /// Too few control points.
    #[error("this curve takes at least {least} control points, got {points}")]
    PointCount {
        /// Control points given.
        points: usize,
        /// The fewest.
        least: usize,
    },
    /// Not as many weights as control points.
    #[error("{points} control points take as many weights, got {weights}")]
    WeightCount {
        /// Weights given.
        weights: usize,
        /// Control points given.
        points: usize,
    },
    /// Not as many knots as control points plus degree plus one.
    #[error("this curve takes {needed} knots, got {knots}")]
    KnotCount {
        /// Knots given.
        knots: usize,
        /// Knots needed.
        needed: usize,
    },
    /// A control point with another number of coordinates than the curve.
    #[error("control point {index} has {found} coordinates, the curve has {needed}")]
    Dimension {
        /// Which control point, from 0.
        index: usize,
        /// Its coordinates.
        found: usize,
        /// Those of the curve.
        needed: usize,
    },
    /// A coordinate that is NaN or beyond 1e75.
    #[error("coordinate {axis} of point {index} must be at most 1e75 in magnitude, got {value}")]
    Coordinate {
        /// Which point, from 0.
        index: usize,
        /// Which coordinate, from 0.
        axis: usize,
        /// The coordinate given.
        value: f64,
    },
    /// A weight that is not positive, or outside `[1e-30, 1e30]`.
    #[error("weight {index} must lie in [1e-30, 1e30], got {value}")]
    Weight {
        /// Which weight, from 0.
        index: usize,
        /// The weight given.
        value: f64,
    },
    /// A weight that rounding would lose beside the largest one.
    #[error("weight {index} must be at least 1e-15 of the largest, {largest}, got {value}")]
    WeightRatio {
        /// Which weight, from 0.
        index: usize,
        /// The weight given.
        value: f64,
        /// The largest weight.
        largest: f64,
    },
    /// A knot that is NaN, beyond 1e30 in magnitude, or smaller than the one before.
    #[error("knot {index} must be at most 1e30 in magnitude and not below the one before, got {value}")]
    Knot {
        /// Which knot, from 0.
        index: usize,
        /// The knot given.
        value: f64,
    },
    /// Two knots that are different but too close for a parameter to lie between.
    #[error("knot {index} is {gap} above the one before, distinct knots need {least}")]
    KnotGap {
        /// Which knot, from 0.
        index: usize,
        /// Distance from the knot before.
        gap: f64,
        /// The smallest distance.
        least: f64,
    },
    /// A first or last knot without the multiplicity that ties the curve to its end point.
    #[error("the {end} knot must be there {needed} times, it is there {multiplicity} times")]
    Unclamped {
        /// Which end, `"first"` or `"last"`.
        end: &'static str,
        /// How often it is there.
        multiplicity: usize,
        /// How often it must be there.
        needed: usize,
    },
    /// An inner knot that would tear the curve.
    #[error("the inner knot {knot} may be there {most} times, it is there {multiplicity} times")]
    Multiplicity {
        /// The knot.
        knot: f64,
        /// How often it is there.
        multiplicity: usize,
        /// How often it may be there.
        most: usize,
    },
    /// A parameter interval without length, or too short or too long.
    #[error("a parameter interval must be between 1e-30 and 1e30 long, got [{lower}, {upper}]")]
    Domain {
        /// Lower end.
        lower: f64,
        /// Upper end.
        upper: f64,
    },
    /// Two curves with different intervals of the parameter.
    #[error("the other curve must begin or end at the parameter {expected}, not at {value}")]
    OtherDomain {
        /// Where it does.
        value: f64,
        /// Where it must.
        expected: f64,
    },
    /// A parameter that is not inside the curve.
    #[error("the parameter must lie inside ({lower}, {upper}), got {value}")]
    Parameter {
        /// The parameter given.
        value: f64,
        /// Start of the curve.
        lower: f64,
        /// End of the curve.
        upper: f64,
    },
    /// A parameter that is no inner knot of the curve.
    #[error("there is no inner knot at {0}")]
    NoKnot(f64),
    /// A knot without which the curve would be another one.
    #[error("without the knot {knot} the curve could move by {deviation}, allowed are {tolerance}")]
    Removal {
        /// The knot.
        knot: f64,
        /// Bound of the deviation, infinite where a weight would not stay positive.
        deviation: f64,
        /// Deviation allowed.
        tolerance: f64,
    },
    /// A tolerance that is negative or NaN, or not positive where it must be.
    #[error("the tolerance must be positive, got {0}")]
    Tolerance(f64),
    /// A radius that is not positive and finite.
    #[error("the radius must be positive and at most 1e75, got {0}")]
    Radius(f64),
    /// An angle of an arc that is zero, NaN or beyond 1000 turns, rad.
    #[error("the angle of an arc must not be zero and at most 1000 turns, got {0} rad")]
    Sweep(f64),
    /// Two directions that span no plane.
    #[error("the directions of an arc must span a plane, the sine between them is {0}")]
    Plane(f64),
}
