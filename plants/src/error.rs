//! What can be wrong with a model, a step or a run, with the number that is wrong.

use profiles::ModeError;
use thiserror::Error;

/// A model that cannot be, or a question it has no answer to.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ModelError {
    /// An entry of a matrix that is infinite or NaN.
    #[error("entry ({row}, {column}) of matrix {matrix} must be finite, got {value}")]
    Entry {
        /// Which matrix.
        matrix: &'static str,
        /// Row, from zero.
        row: usize,
        /// Column, from zero.
        column: usize,
        /// The entry given.
        value: f64,
    },
    /// A parameter outside its range.
    #[error("{parameter} must be {range}, got {value}")]
    Parameter {
        /// Which parameter, with its unit.
        parameter: &'static str,
        /// The range it must lie in.
        range: &'static str,
        /// The value given.
        value: f64,
    },
    /// A period over which the matrix exponential cannot be computed: `|A| T` is beyond 1e11.
    #[error("the dynamics are too fast for an interval of {interval} s: the norm of A T is {norm}")]
    TooStiff {
        /// The interval, s.
        interval: f64,
        /// The 1-norm of `A T`.
        norm: f64,
    },
    /// An unstable model whose motion over one interval leaves the range of double precision.
    #[error("the motion over {interval} s leaves the range of double precision")]
    Range {
        /// The interval, s.
        interval: f64,
    },
    /// The QR iteration for the eigenvalues of a matrix did not converge.
    #[error("the eigenvalues of a {size} by {size} matrix did not converge")]
    Eigenvalues {
        /// Number of rows.
        size: usize,
    },
    /// A point at which a transfer function has no finite value.
    #[error("the transfer function has no finite value at {re} + {im} i rad/s")]
    Pole {
        /// Real part of the point, rad/s.
        re: f64,
        /// Imaginary part of the point, rad/s.
        im: f64,
    },
    /// A coefficient of a polynomial that is not finite, or a highest one that is zero.
    #[error(
        "the coefficient of power {power} must be finite, and not zero where it is the highest, got {value}"
    )]
    Coefficient {
        /// The power it belongs to.
        power: usize,
        /// The coefficient.
        value: f64,
    },
    /// A pole or zero that is not finite, or that lacks its conjugate.
    #[error(
        "the {kind} {re} + {im} i rad/s must be finite, and stand beside its conjugate where it is complex"
    )]
    Unpaired {
        /// `"pole"` or `"zero"`.
        kind: &'static str,
        /// Real part, rad/s.
        re: f64,
        /// Imaginary part, rad/s.
        im: f64,
    },
    /// A transfer function with more zeros than poles, which no state space has.
    #[error("a transfer function has at most as many zeros as poles, got {zeros} and {poles}")]
    Improper {
        /// Number of zeros.
        zeros: usize,
        /// Number of poles.
        poles: usize,
    },
    /// A state space of another order than the transfer function.
    #[error("a transfer function of order {order} takes as many states, not {states}")]
    Order {
        /// Number of poles.
        order: usize,
        /// Number of states asked for.
        states: usize,
    },
    /// An input or output that the model does not have.
    #[error("there is no {kind} {index}, the model has {count}")]
    Channel {
        /// `"input"` or `"output"`.
        kind: &'static str,
        /// The index given, from zero.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A motion that is no vibration.
    #[error(transparent)]
    Mode(#[from] ModeError),
}

/// A step that cannot be made.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum StepError {
    /// An interval that is negative, infinite or NaN.
    #[error("an interval must be finite and not negative, got {0} s")]
    Interval(f64),
    /// A spectral radius that is negative, infinite or NaN, rad/s.
    #[error("a spectral radius must be finite and not negative, got {0} rad/s")]
    SpectralRadius(f64),
    /// A tolerance that is not positive and finite.
    #[error("a tolerance must be positive and finite, got {0}")]
    Tolerance(f64),
    /// A fixed number of substeps with which the method is unstable.
    #[error("substeps of {step} s are unstable: {product} times the spectral radius exceeds {limit}")]
    Unstable {
        /// Length of a substep, s.
        step: f64,
        /// Spectral radius times substep.
        product: f64,
        /// The limit of the method.
        limit: f64,
    },
    /// No substeps, or more than a step may take.
    #[error("an interval of {interval} s takes 1 to {limit} substeps, not {needed}")]
    Substeps {
        /// The interval, s.
        interval: f64,
        /// Substeps needed.
        needed: f64,
        /// The most allowed.
        limit: u32,
    },
    /// The adaptive method cannot meet its tolerance with any representable step.
    #[error("the step fell to {step} s at {time} s: the tolerance cannot be met")]
    Underflow {
        /// Time, s, from the start of the interval for a held input.
        time: f64,
        /// The step refused, s.
        step: f64,
    },
    /// The adaptive method used up its steps.
    #[error("{steps} steps did not reach the end of the interval, only {time} s")]
    TooManySteps {
        /// Steps tried.
        steps: u32,
        /// Time reached, s.
        time: f64,
    },
    /// The model has no transition over the interval.
    #[error(transparent)]
    Model(#[from] ModelError),
}

/// A simulation that cannot be set up.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SimulationError {
    /// A base period of zero, or without a denominator.
    #[error("a base period must be positive, got {numerator}/{denominator} s")]
    Period {
        /// Numerator of the period, s.
        numerator: u64,
        /// Denominator of the period.
        denominator: u64,
    },
    /// A duration that is negative, not finite or too long to count.
    #[error("a duration of {0} s has no number of ticks")]
    Duration(f64),
    /// A rate of zero ticks.
    #[error("{0} must be at least one tick")]
    Every(&'static str),
    /// A task whose period is not a multiple of the control period.
    #[error("a task every {every} ticks does not fit a controller that runs every {control_every} ticks")]
    Task {
        /// Period of the task, ticks.
        every: u32,
        /// Period of the controller, ticks.
        control_every: u32,
    },
    /// A delay outside the range of the simulation.
    #[error("a computation delay must lie in [0, {longest}] control periods, got {periods}")]
    Delay {
        /// The delay given, control periods.
        periods: f64,
        /// The longest delay, control periods.
        longest: f64,
    },
    /// Saturation limits that are NaN or in the wrong order.
    #[error("saturation limits must be in order, got [{lower}, {upper}]")]
    Saturation {
        /// Lower limit.
        lower: f64,
        /// Upper limit.
        upper: f64,
    },
    /// A number that must be finite, or positive where it says so.
    #[error("{quantity} must be {range}, got {value}")]
    Number {
        /// Which number.
        quantity: &'static str,
        /// The range it must lie in.
        range: &'static str,
        /// The value given.
        value: f64,
    },
    /// The recording cannot be set up.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// The run stopped before its end.
    #[error(transparent)]
    Halted(#[from] HaltError),
}

/// Why a run stopped before its end.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum HaltError {
    /// A state beyond the bound, infinite or NaN: the loop diverges.
    #[error("the loop diverges: state {component} is {value} at {time} s, beyond {bound}")]
    Diverged {
        /// Time, s.
        time: f64,
        /// Index of the state, from zero.
        component: usize,
        /// The state.
        value: f64,
        /// The bound.
        bound: f64,
    },
    /// The controller returned an input that is infinite or NaN.
    #[error("the controller returned {value} for input {component} at {time} s")]
    Command {
        /// Time of the call, s.
        time: f64,
        /// Index of the input, from zero.
        component: usize,
        /// The value returned.
        value: f64,
    },
    /// The plant could not be advanced.
    #[error("the plant stopped at {time} s: {source}")]
    Step {
        /// Time at the start of the step, s.
        time: f64,
        /// What went wrong.
        source: StepError,
    },
}

/// A recording that cannot be made or read.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RecordingError {
    /// Two channels with one name.
    #[error("there are two channels named {0:?}")]
    Duplicate(String),
    /// No channel with this name.
    #[error("there is no channel named {0:?}")]
    Unknown(String),
    /// A row with the wrong number of values.
    #[error("a row of {given} values does not fit {channels} channels")]
    Row {
        /// Values given.
        given: usize,
        /// Channels of the recording.
        channels: usize,
    },
    /// More rows than memory can hold.
    #[error("there is no memory for {rows} rows of {channels} channels")]
    Memory {
        /// Rows asked for.
        rows: u64,
        /// Channels.
        channels: usize,
    },
}
