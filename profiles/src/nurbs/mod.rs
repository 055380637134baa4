//! Rational B-spline curves: exact geometry in homogeneous coordinates.

mod arc_length;
mod basis;
mod bernstein;
mod bezier;
mod bounds;
mod closest;
mod conics;
mod curve;
mod deviation;
mod error;
mod evaluate;
mod feed;
mod gauss;
mod geometry;
mod homogeneous;
mod insert;
mod knots;
mod motion;
mod piece;
mod raise;
mod reach;
mod remove;
mod shape;
#[cfg(feature = "serde")]
mod unchecked;

pub use arc_length::ArcLength;
pub use basis::Basis;
pub use bezier::BezierSegment;
pub use closest::Nearest;
pub use curve::NurbsCurve;
pub use deviation::Deviation;
pub use error::NurbsError;
pub use feed::{
    AxisMotion, CoordinateList, FeedError, FeedInterpolator, FeedLaw, FeedLimits, FeedProfile, FeedReport,
    FeedSample, Peak, PolynomialLaw, Ticks,
};
pub use geometry::Corner;
pub use homogeneous::Homogeneous;
pub use knots::{Knots, Side};

/// The highest degree of a curve; evaluation keeps its control points on the stack.
pub const MAX_DEGREE: usize = 15;
