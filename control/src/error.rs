//! What can be wrong with a configuration, with the number that is wrong.

use thiserror::Error;

use crate::range::OutOfRange;

/// A PID controller that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum PidError {
    /// A gain that is infinite or NaN.
    #[error("the gain {which} must be finite, got {value}")]
    Gain {
        /// Which gain.
        which: &'static str,
        /// The gain given.
        value: f64,
    },
    /// A sampling period that is not positive and finite, s.
    #[error("the sampling period must be positive and finite, got {0} s")]
    Period(f64),
    /// A time constant of the derivative filter that is negative, infinite or NaN, s.
    #[error("the time constant of the derivative filter must be finite and not negative, got {0} s")]
    DerivativeFilter(f64),
    /// Output limits that leave no room between them.
    #[error("the lower output limit must lie below the upper one, got [{lower}, {upper}]")]
    OutputLimits {
        /// The lower limit given.
        lower: f64,
        /// The upper limit given.
        upper: f64,
    },
    /// A tracking time that is not positive and finite, s.
    #[error("the tracking time must be positive and finite, got {0} s")]
    TrackingTime(f64),
    /// Numbers so large or so small that a coefficient has no representation.
    #[error("the configuration leaves the range of its number type: {quantity} would be {value}")]
    Range {
        /// The coefficient.
        quantity: &'static str,
        /// What came out.
        value: f64,
    },
}

/// A feedforward that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum FeedforwardError {
    /// A gain that is infinite or NaN.
    #[error("the {which} gain must be finite, got {value}")]
    Gain {
        /// Which gain.
        which: &'static str,
        /// The gain given.
        value: f64,
    },
    /// A physical parameter outside its range.
    #[error("the {which} must be finite and {range}, got {value}")]
    Parameter {
        /// Which parameter.
        which: &'static str,
        /// What it must be besides finite.
        range: &'static str,
        /// The value given.
        value: f64,
    },
}

/// A current loop that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum CurrentLoopError {
    /// A proportional gain that is not positive and finite, V/A.
    #[error("the proportional gain of the {axis} axis must be positive and finite, got {value} V/A")]
    ProportionalGain {
        /// Which axis.
        axis: &'static str,
        /// The gain given.
        value: f64,
    },
    /// An integral gain that is negative, infinite or NaN, V/(A s).
    #[error("the integral gain of the {axis} axis must be finite and not negative, got {value} V/(A s)")]
    IntegralGain {
        /// Which axis.
        axis: &'static str,
        /// The gain given.
        value: f64,
    },
    /// A sampling period that is not positive and finite, s.
    #[error("the sampling period must be positive and finite, got {0} s")]
    Period(f64),
    /// A voltage limit that is not positive, V.
    #[error("the voltage limit must be positive, got {0} V")]
    VoltageLimit(f64),
    /// A property of the motor, or a bandwidth, outside its range.
    #[error("the {which} must be finite and {range}, got {value}")]
    Parameter {
        /// Which parameter.
        which: &'static str,
        /// What it must be besides finite.
        range: &'static str,
        /// The value given.
        value: f64,
    },
    /// Numbers so large or so small that a coefficient has no representation.
    #[error("the configuration leaves the range of its number type: {quantity} would be {value}")]
    Range {
        /// The coefficient.
        quantity: &'static str,
        /// What came out.
        value: f64,
    },
}

/// A cascade that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum CascadeError {
    /// A position gain that is negative, infinite or NaN, 1/s.
    #[error("the position gain must be finite and not negative, got {0} 1/s")]
    PositionGain(f64),
    /// A share of velocity feedforward outside `[0, 1]`.
    #[error("the velocity feedforward must lie within [0, 1], got {0}")]
    VelocityFeedforward(f64),
    /// A velocity limit that is not positive, rad/s.
    #[error("the velocity limit must be positive, got {0} rad/s")]
    VelocityLimit(f64),
    /// A current limit that is not positive, A.
    #[error("the current limit must be positive, got {0} A")]
    CurrentLimit(f64),
    /// A loop that would run every zero ticks.
    #[error("the divisor of the {0} loop must be at least one")]
    Divisor(&'static str),
    /// Gains, periods or tracking times that the velocity loop cannot have.
    #[error("velocity loop: {0}")]
    VelocityLoop(#[from] PidError),
}

/// A field-oriented control that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum FieldOrientedError {
    /// No pole pairs.
    #[error("a motor has at least one pole pair")]
    PolePairs,
    /// A cascade and a current loop that do not run at the same base tick, s.
    #[error("the cascade runs on a base tick of {cascade} s, the current loop on one of {current_loop} s")]
    Periods {
        /// Base period of the cascade.
        cascade: f64,
        /// Period of the current loop.
        current_loop: f64,
    },
}

impl From<OutOfRange> for FeedforwardError {
    fn from(OutOfRange { which, range, value }: OutOfRange) -> Self {
        Self::Parameter { which, range, value }
    }
}

impl From<OutOfRange> for CurrentLoopError {
    fn from(OutOfRange { which, range, value }: OutOfRange) -> Self {
        Self::Parameter { which, range, value }
    }
}

/// A sliding mode controller that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum SlidingModeError {
    /// A parameter outside its range.
    #[error("the {which} must be finite and {range}, got {value}")]
    Parameter {
        /// Which parameter.
        which: &'static str,
        /// What it must be besides finite.
        range: &'static str,
        /// The value given.
        value: f64,
    },
    /// Exponents that a terminal surface cannot have.
    #[error("a terminal surface takes odd exponents with 0 < q < p, got p = {p}, q = {q}")]
    TerminalExponents {
        /// The `p` given.
        p: u32,
        /// The `q` given.
        q: u32,
    },
    /// Exponents that a non-singular terminal surface cannot have.
    #[error("a non-singular terminal surface takes odd exponents with q < p < 2 q, got p = {p}, q = {q}")]
    NonsingularExponents {
        /// The `p` given.
        p: u32,
        /// The `q` given.
        q: u32,
    },
    /// Implicit sampling of a law for which it has no closed form.
    #[error("implicit sampling takes the constant or the exponential law with the sign itself")]
    NoImplicitForm,
    /// A non-singular surface where an acceleration must change the surface one to one.
    #[error("super-twisting takes a linear or a terminal surface")]
    NonsingularSurface,
    /// A sampling period that is not positive and finite, s.
    #[error("the sampling period must be positive and finite, got {0} s")]
    Period(f64),
    /// Output limits that leave no room between them.
    #[error("the lower output limit must lie below the upper one, got [{lower}, {upper}]")]
    OutputLimits {
        /// The lower limit given.
        lower: f64,
        /// The upper limit given.
        upper: f64,
    },
    /// Numbers so large or so small that a coefficient has no representation.
    #[error("the configuration leaves the range of its number type: {quantity} would be {value}")]
    Range {
        /// The coefficient.
        quantity: &'static str,
        /// What came out.
        value: f64,
    },
}

impl From<OutOfRange> for SlidingModeError {
    fn from(OutOfRange { which, range, value }: OutOfRange) -> Self {
        Self::Parameter { which, range, value }
    }
}

/// A disturbance observer that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ObserverError {
    /// A parameter that is not positive and finite.
    #[error("the {which} must be positive and finite, got {value}")]
    Parameter {
        /// Which parameter.
        which: &'static str,
        /// The value given.
        value: f64,
    },
    /// Numbers so large or so small that a coefficient has no representation.
    #[error("the configuration leaves the range of its number type: {quantity} would be {value}")]
    Range {
        /// The coefficient.
        quantity: &'static str,
        /// What came out.
        value: f64,
    },
}
