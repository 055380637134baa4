//! Why a table cannot be used, or not for this.

use thiserror::Error;

/// A table of moves that is not what it should be, or a move that it does not hold.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum MoveTableError {
    /// More modes than a table deals with.
    #[error("a table can leave {most} modes at rest, not {modes}")]
    Modes {
        /// Modes given.
        modes: usize,
        /// The most there may be.
        most: usize,
    },
    /// A slice of another length than the runs say.
    #[error("the runs of the table need {needed} {what}, it has {given}")]
    Length {
        /// What the slice holds.
        what: &'static str,
        /// How many the runs need.
        needed: usize,
        /// How many there are.
        given: usize,
    },
    /// A run without arcs or with more than there is room for, or with as many contacts.
    #[error(
        "run {run} has {arcs} arcs and {contacts} contacts, there must be 1 to {most}, and fewer contacts"
    )]
    Run {
        /// Index of the run.
        run: usize,
        /// Its arcs.
        arcs: usize,
        /// Its contacts.
        contacts: usize,
        /// Arcs there is room for.
        most: usize,
    },
    /// Distances that do not grow, or are not all in one direction, m.
    #[error("the distances of a table must grow in one direction, {0} does not")]
    Order(f64),
    /// A move of the table that does not end where it should or leaves modes vibrating: the table is that of other modes.
    #[error("the move over {distance} leaves {residual:e} of itself")]
    Residual {
        /// The distance, m.
        distance: f64,
        /// What is left of the modes or of the end, as a part of the distance.
        residual: f64,
    },
    /// A move of the table that passes a limit: the table is that of other limits.
    #[error("the move over {distance} passes the limits by {part:e} of them")]
    Limits {
        /// The distance, m.
        distance: f64,
        /// How far, as a part of the limit.
        part: f64,
    },
    /// A distance that the table does not hold, m.
    #[error("the table holds distances from {shortest} to {longest}, not {distance}")]
    Distance {
        /// The distance asked for, m.
        distance: f64,
        /// The shortest one, m.
        shortest: f64,
        /// The longest one, m.
        longest: f64,
    },
    /// A distance in the other direction, m, for which the limits are others.
    #[error("the limits are not symmetric and the table is of the other direction, got a distance of {0}")]
    Direction(f64),
}
