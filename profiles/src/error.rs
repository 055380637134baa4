//! What can be wrong with a request, with the number that is wrong.

use thiserror::Error;

/// Bounds that an axis cannot have.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "{quantity} must be bounded below by a negative and above by a positive number, got [{lower}, {upper}]"
)]
pub struct LimitsError {
    /// The bounded quantity.
    pub quantity: &'static str,
    /// The lower bound given.
    pub lower: f64,
    /// The upper bound given.
    pub upper: f64,
}

/// A vibration mode that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ModeError {
    /// A frequency that is not positive and finite, as given.
    #[error("the frequency of a mode must be positive and finite, got {0}")]
    Frequency(f64),
    /// A damping ratio outside `[0, 1)`.
    #[error("the damping ratio of a vibrating mode must lie in [0, 1), got {0}")]
    DampingRatio(f64),
}

/// A move that cannot be planned.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// A distance that is infinite or NaN.
    #[error("the distance must be finite, got {0}")]
    Distance(f64),
    /// A speed that is infinite, NaN or, where a speed has no sign, negative.
    #[error("the {which} speed must be finite, and not negative where it is a magnitude, got {value}")]
    Speed {
        /// Which speed.
        which: &'static str,
        /// The speed given, m/s.
        value: f64,
    },
    /// A speed beyond the limit of the velocity.
    #[error("the {which} speed {value} is outside the velocity limits [{lower}, {upper}]")]
    SpeedLimit {
        /// Which speed.
        which: &'static str,
        /// The speed given, m/s.
        value: f64,
        /// The lower limit, m/s.
        lower: f64,
        /// The upper limit, m/s.
        upper: f64,
    },
    /// The law needs a finite limit where none is set.
    #[error("this law needs a finite limit of the {0}")]
    Unlimited(&'static str),
    /// The law takes only symmetric limits of a quantity.
    #[error("this law needs symmetric limits of the {quantity}, got [{lower}, {upper}]")]
    Asymmetric {
        /// The quantity.
        quantity: &'static str,
        /// The lower limit.
        lower: f64,
        /// The upper limit.
        upper: f64,
    },
    /// The distance is too short to get from the start speed to the stop speed.
    #[error("changing speed takes at least {needed}, the distance is {distance}")]
    TooShort {
        /// The distance given, m.
        distance: f64,
        /// The shortest distance in which the speeds can be reached, m.
        needed: f64,
    },
    /// A jerk that is infinite or NaN, m/s^3.
    #[error("the jerk must be finite, got {0}")]
    Jerk(f64),
    /// A part of a motion that cannot last so long.
    #[error("the {phase} must last {range}, got {value} s")]
    Phase {
        /// Which part.
        phase: &'static str,
        /// The range its time must lie in.
        range: &'static str,
        /// The time given, s.
        value: f64,
    },
    /// A duration to stretch to that is above 1e75 s or shorter than the profile's own.
    #[error("a profile of {shortest} s cannot last {requested} s")]
    Duration {
        /// The duration asked for, s.
        requested: f64,
        /// The profile's own duration, s.
        shortest: f64,
    },
    /// The numbers are so large or so small that the plan leaves the range of double precision.
    #[error("the plan leaves the range of double precision: its {quantity} would be {value}")]
    Range {
        /// The quantity that has no representation.
        quantity: &'static str,
        /// What came out.
        value: f64,
    },
}

/// A chain that cannot be planned.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ChainError {
    /// More modes than a chain can leave at rest.
    #[error("a chain can leave {most} modes at rest, not {modes}")]
    Modes {
        /// Modes given.
        modes: usize,
        /// The most there may be.
        most: usize,
    },
    /// More sections than the chain has room for.
    #[error("a chain of {needed} sections does not fit into one of {capacity}")]
    Sections {
        /// Sections of the smallest chain there could be.
        needed: usize,
        /// Sections there is room for.
        capacity: usize,
    },
    /// A move that cannot be planned.
    #[error(transparent)]
    Plan(#[from] PlanError),
}

/// A clock that cannot drive a profile.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ClockError {
    /// A period that is not positive and finite, s.
    #[error("a period must be positive and finite, got {0} s")]
    Period(f64),
    /// More ticks than an exact tick count can hold.
    #[error("a profile of {duration} s has too many ticks of {period} s")]
    TooManyTicks {
        /// The period given, s.
        period: f64,
        /// The duration of the profile, s.
        duration: f64,
    },
}

/// A pulse train that cannot be sent.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum PulseError {
    /// A pulse size that is not positive and finite, m or rad.
    #[error("the size of a pulse must be positive and finite, got {0}")]
    Size(f64),
    /// More pulses than instants can be told apart.
    #[error("top speed kept throughout would take {pulses} pulses, the most is {most}")]
    TooManyPulses {
        /// Pulses there would be.
        pulses: f64,
        /// Pulses allowed.
        most: f64,
    },
    /// An interval of the drive that is negative or not finite, s.
    #[error("an interval between pulses must be finite and not negative, got {0} s")]
    Interval(f64),
    /// A profile faster than the drive.
    #[error("the profile reaches {frequency} pulses/s, the drive takes {most}")]
    TooFast {
        /// Peak velocity, pulses/s.
        frequency: f64,
        /// Highest frequency of the drive, pulses/s.
        most: f64,
    },
    /// A profile that turns faster than the drive.
    #[error("the profile turns {interval} s after the pulse at {instant} s, the drive needs {least} s")]
    Reversal {
        /// Instant of the last pulse before the turn, s.
        instant: f64,
        /// Time until the first pulse after it, s.
        interval: f64,
        /// Time the drive needs, s.
        least: f64,
    },
    /// A timer frequency that is not positive and finite, ticks/s.
    #[error("a timer must run at a positive and finite frequency, got {0} ticks/s")]
    Frequency(f64),
    /// A timer too slow for the pulses, or for what the drive needs between them.
    #[error("an interval between pulses could be {ticks} ticks of the timer, it must be at least {needed}")]
    Ticks {
        /// Whole ticks that the shortest interval may be cut to.
        ticks: f64,
        /// Ticks it must have.
        needed: f64,
    },
    /// More pulses in one tick than a count can hold.
    #[error("a tick could hold {pulses} pulses, more than a count can")]
    CountRange {
        /// Pulses there could be.
        pulses: f64,
    },
    /// A clock that cannot drive the profile.
    #[error(transparent)]
    Clock(#[from] ClockError),
}

/// A table that cannot be written.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum TableError {
    /// A clock that cannot drive the profile.
    #[error(transparent)]
    Clock(#[from] ClockError),
    /// More rows than a table may have.
    #[error("the table would have {rows} rows, the most is {most}")]
    TooManyRows {
        /// Rows asked for.
        rows: f64,
        /// Rows allowed.
        most: f64,
    },
    /// The name is no C identifier.
    #[error("a table needs a C identifier as its name")]
    Name,
    /// The unit would break the header.
    #[error("a unit must not hold commas, quotes or line breaks")]
    Unit,
    /// A value that single precision cannot hold.
    #[error("{quantity} reaches {value}, beyond single precision")]
    BeyondSingle {
        /// The quantity.
        quantity: &'static str,
        /// Its largest magnitude.
        value: f64,
    },
    /// The writer reported an error.
    #[error(transparent)]
    Write(#[from] core::fmt::Error),
}
