//! What can be wrong with a train or a filter, with the number that is wrong.

use thiserror::Error;

/// An impulse train that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum TrainError {
    /// No impulse at all.
    #[error("a train needs at least one impulse")]
    Empty,
    /// More impulses than the train has room for.
    #[error("a train of {needed} impulses does not fit into one of {capacity}")]
    Capacity {
        /// Impulses there would be.
        needed: usize,
        /// Impulses there is room for.
        capacity: usize,
    },
    /// An amplitude that is infinite or NaN.
    #[error("the amplitude of impulse {index} must be finite, got {value}")]
    Amplitude {
        /// Which impulse, from zero.
        index: usize,
        /// Its amplitude.
        value: f64,
    },
    /// A time that is not finite, negative, or before that of the impulse ahead of it, s.
    #[error("the time of impulse {index} must be finite and not before {earliest} s, got {value} s")]
    Time {
        /// Which impulse, from zero.
        index: usize,
        /// Its time, s.
        value: f64,
        /// The earliest time it may have, s.
        earliest: f64,
    },
    /// Amplitudes that add up to nothing, so that no set-point would be reached.
    #[error("the amplitudes must not add up to {0}")]
    Sum(f64),
}

/// A shaper that cannot be, for a mode or at all.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ShaperError {
    /// An order of zero, or one higher than there is.
    #[error("the order of the zero must be 1 to {most}, got {order}")]
    Order {
        /// The order given.
        order: usize,
        /// The highest order there is.
        most: usize,
    },
    /// Too few impulses.
    #[error("there must be at least {least} impulses, got {impulses}")]
    Impulses {
        /// The number given.
        impulses: usize,
        /// The smallest number.
        least: usize,
    },
    /// A span that is not positive, or so long that the first zero is past its own alias, damped periods.
    #[error("impulses can be spread over more than 0 and at most {most} damped periods, got {span}")]
    Span {
        /// The span given, damped periods.
        span: f64,
        /// The longest span, damped periods.
        most: f64,
    },
    /// Equally spaced impulses of which one would be negative.
    #[error("{impulses} impulses over {span} damped periods would not all be positive")]
    Negative {
        /// The number given.
        impulses: usize,
        /// The span given, damped periods.
        span: f64,
    },
    /// No hump, or more than there are.
    #[error("there can be 1 to {most} humps, got {humps}")]
    Humps {
        /// The number given.
        humps: usize,
        /// The largest number.
        most: usize,
    },
    /// A tolerated vibration that is not between nothing and all.
    #[error("the tolerated vibration must lie between 0 and 1, got {0}")]
    Tolerance(f64),
    /// A sum of magnitudes that no such train has.
    #[error("the magnitudes of the impulses can add up to 1 to {most}, got {demand}")]
    Demand {
        /// The sum given.
        demand: f64,
        /// The largest sum.
        most: f64,
    },
    /// A mode so damped that the equations have no solution.
    #[error("no such shaper for a damping ratio of {damping_ratio}; there is one for {reached}")]
    Damping {
        /// Damping ratio of the mode.
        damping_ratio: f64,
        /// The highest damping ratio at which one was found.
        reached: f64,
    },
    /// A train that cannot be.
    #[error(transparent)]
    Train(#[from] TrainError),
}

/// A range of modes that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ModeRangeError {
    /// Frequencies that are not positive, finite and in order, rad/s.
    #[error("the frequencies of a range must be positive, finite and in order, got {lower} to {upper} rad/s")]
    Frequency {
        /// The lower end, rad/s.
        lower: f64,
        /// The upper end, rad/s.
        upper: f64,
    },
    /// Damping ratios outside `[0, 1)` or not in order.
    #[error("the damping ratios of a range must lie in [0, 1) and be in order, got {lower} to {upper}")]
    DampingRatio {
        /// The lower end.
        lower: f64,
        /// The upper end.
        upper: f64,
    },
}

/// A delay filter that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum DelayFilterError {
    /// A delay that is not positive and finite, s.
    #[error("the delay must be positive and finite, got {0} s")]
    Delay(f64),
    /// A delay of so nearly whole periods of a mode with so little damping that the impulses would be huge.
    #[error(
        "a delay of {delay} s is {turns} periods of the mode, whose zeros would need impulses up to {largest:e}"
    )]
    WholePeriods {
        /// The delay, s.
        delay: f64,
        /// The delay in damped periods.
        turns: f64,
        /// The largest amplitude that would be needed.
        largest: f64,
    },
    /// A delay for which the middle impulse is negative.
    #[error(
        "positive impulses need a delay of 1/4 to 3/4 of a period beyond whole ones, {delay} s is {turns} periods"
    )]
    Negative {
        /// The delay, s.
        delay: f64,
        /// The delay in damped periods.
        turns: f64,
    },
}

/// A delay line that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum DelayLineError {
    /// A period that is not positive and finite, s.
    #[error("the period must be positive and finite, got {0} s")]
    Period(f64),
    /// A period too long to see the mode: half a damped period or more.
    #[error("a mode with a damped period of {damped_period} s cannot be sampled every {period} s")]
    Undersampled {
        /// The sampling period, s.
        period: f64,
        /// The damped period of the mode, s.
        damped_period: f64,
    },
    /// A train longer than the history that is kept.
    #[error("the train reaches {needed} samples back, the line keeps {capacity}")]
    History {
        /// Samples needed.
        needed: f64,
        /// Samples kept.
        capacity: usize,
    },
    /// More taps than the line has room for: two an impulse, one where it falls on a sample.
    #[error("the line has room for {capacity} taps, the train needs more")]
    Taps {
        /// Taps there is room for.
        capacity: usize,
    },
    /// Taps that add up to nothing once the delays are split.
    #[error("the taps must not add up to {0}")]
    Sum(f64),
}
