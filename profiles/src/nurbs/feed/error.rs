//! What can be wrong with a feed that is asked for.

use thiserror::Error;

use crate::error::{ClockError, PlanError};
use crate::nurbs::NurbsError;

/// A feed that cannot be, or a curve that has none.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum FeedError {
    /// A feed that is not positive and finite, m/s.
    #[error("a feed must be positive and finite, got {0} m/s")]
    Feed(f64),
    /// A chord error that is not positive, m.
    #[error("a chord error must be positive, got {0} m")]
    ChordError(f64),
    /// A period that is not positive and finite, s.
    #[error("a period must be positive and finite, got {0} s")]
    Period(f64),
    /// A curve without length.
    #[error("the curve is {0} m long, which is no way to go")]
    Length(f64),
    /// A law whose acceleration jumps where jerk is limited.
    #[error("the acceleration of this law jumps, and axis {axis} limits jerk to {limit}")]
    Jumps {
        /// The axis.
        axis: usize,
        /// Its limit, m/s^3.
        limit: f64,
    },
    /// A curve so rough that it needs more cells than there may be.
    #[error("bounding the curve takes more than {most} cells, {parameter} is reached")]
    TooRough {
        /// The most cells.
        most: usize,
        /// Parameter of the curve up to which they reach.
        parameter: f64,
    },
    /// A part of the curve on which no feed is slow enough.
    #[error("no feed keeps the limits between {from} m and {to} m of the curve")]
    NoFeed {
        /// Length along the curve where the part starts, m.
        from: f64,
        /// Where it ends, m.
        to: f64,
    },
    /// A curve whose length cannot be found.
    #[error(transparent)]
    Curve(#[from] NurbsError),
    /// A ramp that cannot be planned.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A period that cannot count through the feed.
    #[error(transparent)]
    Clock(#[from] ClockError),
}
