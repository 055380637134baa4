//! What can be wrong with a search, with the number that is wrong.

use identify::SignalError;
use thiserror::Error;

/// A swarm that cannot be, or costs that do not fit it.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum SwarmError {
    /// No dimension to search.
    #[error("a search needs at least one dimension")]
    NoDimension,
    /// A bound that is not finite, or a lower one that is not below the upper.
    #[error("the bounds of dimension {dimension} must be finite and in order, got {lower} to {upper}")]
    Bounds {
        /// The dimension, from zero.
        dimension: usize,
        /// The lower bound.
        lower: f64,
        /// The upper bound.
        upper: f64,
    },
    /// A count that is too small or too large.
    #[error("{quantity} must be {least} to {most}, got {given}")]
    Count {
        /// What is counted.
        quantity: &'static str,
        /// The smallest count that makes sense.
        least: u64,
        /// The largest count allowed.
        most: u64,
        /// The count given.
        given: u64,
    },
    /// An option out of range.
    #[error("{quantity} must be {range}, got {value}")]
    Number {
        /// Which number.
        quantity: &'static str,
        /// The range it must lie in.
        range: &'static str,
        /// The value given.
        value: f64,
    },
    /// A first guess with the wrong number of coordinates.
    #[error("a guess has {given} coordinates, the search {dimensions}")]
    GuessLength {
        /// Coordinates of the guess.
        given: usize,
        /// Dimensions of the search.
        dimensions: usize,
    },
    /// A first guess outside the bounds.
    #[error("a guess lies outside the bounds of dimension {dimension}: {value}")]
    Guess {
        /// The dimension, from zero.
        dimension: usize,
        /// The coordinate.
        value: f64,
    },
    /// More first guesses than particles.
    #[error("{given} guesses are more than the {particles} particles that are left")]
    Guesses {
        /// Guesses given.
        given: usize,
        /// Particles that can take one.
        particles: usize,
    },
    /// A first guess for a swarm that has already moved.
    #[error("a guess comes too late: {0} generations have been evaluated")]
    Late(u64),
    /// Another number of costs than of candidates.
    #[error("{given} costs do not fit {particles} candidates")]
    Costs {
        /// Costs given.
        given: usize,
        /// Candidates asked for.
        particles: usize,
    },
    /// A written swarm whose parts do not fit.
    #[error("a written swarm has {given} entries of {quantity}, its options need {needed}")]
    Written {
        /// Which part.
        quantity: &'static str,
        /// Entries found.
        given: usize,
        /// Entries needed.
        needed: usize,
    },
}

/// A search of the simplex method that cannot be.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SimplexError {
    /// No unknowns, or steps that do not fit them.
    #[error("{steps} steps do not fit {unknowns} unknowns, or there are none")]
    Lengths {
        /// Unknowns.
        unknowns: usize,
        /// Steps.
        steps: usize,
    },
    /// A start or a step that is not finite, or a step of zero.
    #[error("unknown {index} must start and step by finite numbers, and step at all, got {value} and {step}")]
    Number {
        /// Index of the unknown, from zero.
        index: usize,
        /// Its start.
        value: f64,
        /// Its step.
        step: f64,
    },
    /// No candidate that could be evaluated.
    #[error("none of {evaluations} candidates has a cost")]
    NoCandidate {
        /// Candidates evaluated.
        evaluations: u64,
    },
    /// What argmin says.
    #[error("the solver stopped: {0}")]
    Solver(String),
}

/// A response that has no fitness.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum FitnessError {
    /// A weight out of range.
    #[error("{quantity} must be finite and not negative, got {value}")]
    Weight {
        /// Which weight.
        quantity: &'static str,
        /// The value given.
        value: f64,
    },
    /// Another number of efforts than of outputs.
    #[error("{efforts} samples of the effort do not fit {outputs} of the output")]
    Lengths {
        /// Samples of the effort.
        efforts: usize,
        /// Samples of the output.
        outputs: usize,
    },
    /// An effort that is infinite or NaN.
    #[error("sample {index} of the effort must be finite, got {value}")]
    Effort {
        /// Index of the sample, from zero.
        index: usize,
        /// The value.
        value: f64,
    },
    /// A sum beyond the range of numbers.
    #[error("the fitness must be finite, got {0}")]
    Overflow(f64),
    /// A move that cannot be.
    #[error(transparent)]
    Signal(#[from] SignalError),
}
