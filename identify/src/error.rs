//! What can be wrong with a signal or an estimate, with the number that is wrong.

use thiserror::Error;

/// A recorded signal that cannot be, or a question it has no answer to.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum SignalError {
    /// No samples.
    #[error("a signal needs at least one sample")]
    Empty,
    /// Times and values, or two signals to compare, of different lengths.
    #[error("{times} and {values} samples do not fit each other")]
    Lengths {
        /// Number of times, or of the samples of the first signal.
        times: usize,
        /// Number of values, or of the samples of the second signal.
        values: usize,
    },
    /// A value that is infinite or NaN.
    #[error("sample {index} must be finite, got {value}")]
    Value {
        /// Index of the sample, from zero.
        index: usize,
        /// The value.
        value: f64,
    },
    /// A time that is not finite or not after the one before.
    #[error("times must be finite and increase: sample {index} is at {time} s")]
    Time {
        /// Index of the sample, from zero.
        index: usize,
        /// The time, s.
        time: f64,
    },
    /// A sample period that is not positive and finite.
    #[error("a sample period must be positive and finite, got {0} s")]
    Period(f64),
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
    /// A move of no length, of which nothing can be a part.
    #[error("a move needs two different ends, got {0} twice")]
    NoMove(f64),
    /// A number of samples out of range.
    #[error("{quantity} must be {range}, got {length} samples")]
    Length {
        /// Which number.
        quantity: &'static str,
        /// The range it must lie in.
        range: &'static str,
        /// The number given.
        length: usize,
    },
    /// A window that is reversed, or not inside the record.
    #[error("the window from {lower} s to {upper} s must lie within the record, {first} s to {last} s")]
    Window {
        /// Start of the window, s.
        lower: f64,
        /// End of the window, s.
        upper: f64,
        /// The first sample, s.
        first: f64,
        /// The last sample, s.
        last: f64,
    },
    /// A constant signal, of which nothing can be a part.
    #[error("the signal is {0} throughout")]
    Constant(f64),
    /// No samples from an instant on.
    #[error("there is no sample from {instant} s on: the last is at {last} s")]
    NothingAfter {
        /// The instant, s.
        instant: f64,
        /// The last sample, s.
        last: f64,
    },
    /// No bin of a spectrum above its neighbours within a band.
    #[error("the spectrum has no peak from {lower} rad/s to {upper} rad/s")]
    NoPeak {
        /// Lower end of the band, rad/s.
        lower: f64,
        /// Upper end of the band, rad/s.
        upper: f64,
    },
    /// The last sample is outside the band.
    #[error("the signal does not settle: at its end it is {error} from the target, the band is {band}")]
    NotSettled {
        /// The last error.
        error: f64,
        /// Half the width of the band.
        band: f64,
    },
    /// The signal never reaches a level.
    #[error("the signal does not reach {level}, only {extreme}")]
    NotReached {
        /// The level.
        level: f64,
        /// The value nearest to it.
        extreme: f64,
    },
}

/// Peaks from which no decrement follows.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum DecrementError {
    /// No cycles to look at.
    #[error("a decrement needs at least one cycle")]
    Cycles,
    /// Fewer peaks than the cycles need.
    #[error("{needed} peaks are needed, there are {found}")]
    TooFewPeaks {
        /// Peaks needed.
        needed: usize,
        /// Peaks found.
        found: usize,
    },
    /// A peak or a trough on the wrong side of the target, on it, or not finite.
    #[error("the peak at {time} s must stand off the target on its own side, its height is {height}")]
    Height {
        /// Time of the peak, s.
        time: f64,
        /// Height over the target, of a trough below it.
        height: f64,
    },
    /// The later peak is no earlier in time than the first.
    #[error("the peaks must follow each other, the interval is {0} s")]
    Interval(f64),
    /// The later peak is not lower: the damping would not be positive.
    #[error(
        "the peaks do not decay: the ratio of first to last is {ratio}, the damping would be {damping_ratio}"
    )]
    Growing {
        /// Height of the first over that of the last.
        ratio: f64,
        /// The damping ratio that this means, zero or negative.
        damping_ratio: f64,
    },
}

/// Why there is no fit of damped sinusoids.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum SinusoidError {
    /// A signal that cannot be.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// Options out of range.
    #[error("the largest order must be 2 to {most}, got {given}")]
    Order {
        /// The order given.
        given: usize,
        /// The most allowed.
        most: usize,
    },
    /// Fewer samples than a fit of one mode needs.
    #[error("{samples} samples are too few, a fit needs {needed}")]
    TooShort {
        /// Samples given.
        samples: usize,
        /// Samples needed.
        needed: usize,
    },
    /// Nothing that oscillates stands out of the noise.
    #[error("no mode stands out of the noise, which has a standard deviation of {noise}; {decays} decays do")]
    NoMode {
        /// Standard deviation of what the fit leaves.
        noise: f64,
        /// Decays without oscillation that were found.
        decays: usize,
    },
    /// A mode grows by more than its uncertainty allows for.
    #[error(
        "the mode at {angular_frequency} rad/s grows: damping ratio {damping_ratio}, standard deviation {deviation}"
    )]
    Unstable {
        /// Undamped angular frequency, rad/s.
        angular_frequency: f64,
        /// Damping ratio, negative.
        damping_ratio: f64,
        /// Its standard deviation.
        deviation: f64,
    },
}

/// Why there is no fit of a transfer function.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum TransferFunctionError {
    /// A signal that cannot be.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// Input and output of different lengths.
    #[error("{input} samples of the input do not fit {output} of the output")]
    Lengths {
        /// Samples of the input.
        input: usize,
        /// Samples of the output.
        output: usize,
    },
    /// Orders out of range.
    #[error("there must be 1 to {most} poles and at most as many zeros, got {poles} and {zeros}")]
    Order {
        /// Poles asked for.
        poles: usize,
        /// Zeros asked for.
        zeros: usize,
        /// The most poles allowed.
        most: usize,
    },
    /// Fewer samples than the parameters need.
    #[error("{samples} samples are too few, the fit needs {needed}")]
    TooShort {
        /// Samples given.
        samples: usize,
        /// Samples needed.
        needed: usize,
    },
    /// An input or output of zeros.
    #[error("{quantity} has no content: its largest value is {largest}")]
    NoExcitation {
        /// Which signal.
        quantity: &'static str,
        /// Its largest absolute value.
        largest: f64,
    },
    /// The model explains no more of the output than chance would.
    #[error(
        "the output does not follow the input: the variance explained per parameter is {ratio} of the residual's, not {least}"
    )]
    NoResponse {
        /// Variance explained per parameter over that of the residual.
        ratio: f64,
        /// The least ratio that is taken for a response.
        least: f64,
    },
    /// The input does not tell the parameters apart, or there are more of them than the system has.
    #[error(
        "the data do not determine all poles and zeros: the condition of their derivatives is {condition}"
    )]
    Undetermined {
        /// Condition of the derivatives of the output, each of length one; infinite where there are none.
        condition: f64,
    },
    /// A pole that is not in the left half plane.
    #[error("the pole at {real} + {imaginary}i rad/s is not stable, standard deviation {deviation} rad/s")]
    Unstable {
        /// Real part, rad/s, zero or positive.
        real: f64,
        /// Imaginary part, rad/s.
        imaginary: f64,
        /// Standard deviation of the real part, rad/s.
        deviation: f64,
    },
}
