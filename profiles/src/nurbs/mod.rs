//! Rational B-spline curves: exact geometry in homogeneous coordinates.

mod basis;
mod bezier;
mod curve;
mod error;
mod evaluate;
mod homogeneous;
mod insert;
mod knots;
mod raise;
mod shape;

pub use basis::Basis;
pub use bezier::BezierSegment;
pub use curve::NurbsCurve;
pub use error::NurbsError;
pub use homogeneous::Homogeneous;
pub use knots::{Knots, Side};

/// The highest degree of a curve; evaluation keeps its control points on the stack.
pub const MAX_DEGREE: usize = 15;
