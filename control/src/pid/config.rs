//! What a PID controller is set to, checked once.

use profiles::Real;

use crate::error::PidError;

/// The gains of the parallel form, with outputs in `U` and errors in `E`: finite, of any sign.
///
/// A plant with negative gain takes negative gains; anti-windup goes by the output, not by the sign of the error.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct PidGains<F = f64> {
    /// Proportional gain, U/E.
    pub kp: F,
    /// Integral gain, U/(E s); zero freezes the integral, see [`Pid::take_over`].
    pub ki: F,
    /// Derivative gain, U s/E.
    pub kd: F,
}

/// What the derivative term differentiates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum DerivativeOn {
    /// The error `r - y`: a smooth set-point is followed without lag, a step of it kicks.
    #[default]
    Error,
    /// The measurement, as `-dy/dt`: no kick when the set-point steps.
    Measurement,
}

/// How the integral is kept from winding up while the output is limited.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum AntiWindup<F = f64> {
    /// The integral runs on.
    None,
    /// The integral follows the realised output: its excess decays as `(T / (T + h))^k`, which is
    /// `e^(-t / T)` for periods `h` short against the tracking time `T`. Without effect when `ki = 0`.
    BackCalculation {
        /// Tracking time `T`, s.
        tracking_time: F,
    },
    /// Conditional integration: the integral never moves the output beyond a limit, nor further in a direction in
    /// which the actuator realised less than commanded.
    #[default]
    Clamping,
}

/// A checked PID configuration; any number of axes may share it, each with its own [`PidState`](crate::PidState).
///
/// ```
/// use control::{AntiWindup, DerivativeOn, Pid, PidGains};
///
/// let pid = Pid::new(PidGains { kp: 40.0, ki: 200.0, kd: 2.0 }, 1e-3)?
///     .with_derivative_on(DerivativeOn::Measurement)
///     .with_derivative_filter(5e-3)?
///     .with_output_limits(-10.0, 10.0)?
///     .with_anti_windup(AntiWindup::BackCalculation { tracking_time: 0.05 })?;
/// assert_eq!(pid.output_limits(), (-10.0, 10.0));
/// assert!(pid.with_output_limits(1.0, -1.0).is_err());
/// # Ok::<(), control::PidError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "unchecked::UncheckedPid<F>",
        into = "unchecked::UncheckedPid<F>",
        bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
    )
)]
pub struct Pid<F = f64> {
    pub(super) gains: PidGains<F>,
    period: F,
    derivative_on: DerivativeOn,
    derivative_filter: F,
    pub(super) lower: F,
    pub(super) upper: F,
    anti_windup: AntiWindup<F>,
    // What the tick needs, computed once.
    /// `ki h`.
    pub(super) integral_step: F,
    /// `tau / (tau + h)`.
    pub(super) filter_memory: F,
    /// `1 / (tau + h)`.
    pub(super) filter_gain: F,
    /// One or zero: the share of the set-point in what is differentiated.
    pub(super) setpoint_share: F,
    /// `h / (T + h)`, zero without back-calculation.
    pub(super) tracking: F,
    /// Whether the integral stops at the limits.
    pub(super) clamping: bool,
}

impl<F: Real> Pid<F> {
    /// Gains and sampling period `h` in s; derivative on the error and unfiltered, output unlimited, anti-windup by
    /// clamping.
    ///
    /// # Errors
    /// A gain that is not finite, a period that is not positive and finite, or a coefficient `ki h` or `1 / h` that
    /// leaves the range of `F`.
    pub fn new(gains: PidGains<F>, period: F) -> Result<Self, PidError> {
        if !(period > F::ZERO && period.is_finite()) {
            return Err(PidError::Period(period.to_f64()));
        }
        Self {
            gains,
            period,
            derivative_on: DerivativeOn::Error,
            derivative_filter: F::ZERO,
            lower: F::from_f64(f64::NEG_INFINITY),
            upper: F::from_f64(f64::INFINITY),
            anti_windup: AntiWindup::Clamping,
            integral_step: F::ZERO,
            filter_memory: F::ZERO,
            filter_gain: F::ZERO,
            setpoint_share: F::ONE,
            tracking: F::ZERO,
            clamping: true,
        }
        .with_gains(gains)?
        .with_derivative_filter(F::ZERO)
    }

    /// Replaces the gains; [`Pid::take_over`] makes the change without a bump.
    ///
    /// # Errors
    /// A gain that is not finite, or `ki h` beyond the range of `F`.
    pub fn with_gains(self, gains: PidGains<F>) -> Result<Self, PidError> {
        for (which, value) in [("kp", gains.kp), ("ki", gains.ki), ("kd", gains.kd)] {
            if !value.is_finite() {
                return Err(PidError::Gain { which, value: value.to_f64() });
            }
        }
        let integral_step = in_range("ki times the period", gains.ki * self.period)?;
        Self { gains, integral_step, ..self }.with_anti_windup(self.anti_windup)
    }

    /// Replaces what the derivative acts on.
    #[must_use]
    pub fn with_derivative_on(self, derivative_on: DerivativeOn) -> Self {
        let setpoint_share = match derivative_on {
            DerivativeOn::Error => F::ONE,
            DerivativeOn::Measurement => F::ZERO,
        };
        Self { derivative_on, setpoint_share, ..self }
    }

    /// Replaces the time constant `tau` of the derivative filter, s; zero is the plain backward difference.
    ///
    /// # Errors
    /// A time constant that is negative, infinite or NaN, or so small a sum with the period that its inverse leaves
    /// the range of `F`.
    pub fn with_derivative_filter(self, time_constant: F) -> Result<Self, PidError> {
        if !(time_constant >= F::ZERO && time_constant.is_finite()) {
            return Err(PidError::DerivativeFilter(time_constant.to_f64()));
        }
        let sum = in_range("filter time constant plus period", time_constant + self.period)?;
        let filter_gain = in_range("inverse of filter time constant plus period", F::ONE / sum)?;
        Ok(Self { derivative_filter: time_constant, filter_memory: time_constant / sum, filter_gain, ..self })
    }

    /// Replaces the output limits, in the unit of the output; infinity means unlimited.
    ///
    /// # Errors
    /// A lower limit that does not lie below the upper one.
    pub fn with_output_limits(self, lower: F, upper: F) -> Result<Self, PidError> {
        if lower < upper {
            Ok(Self { lower, upper, ..self })
        } else {
            Err(PidError::OutputLimits { lower: lower.to_f64(), upper: upper.to_f64() })
        }
    }

    /// Replaces the anti-windup.
    ///
    /// # Errors
    /// A tracking time that is not positive and finite, or whose sum with the period is not.
    pub fn with_anti_windup(self, anti_windup: AntiWindup<F>) -> Result<Self, PidError> {
        let mut tracking = F::ZERO;
        if let AntiWindup::BackCalculation { tracking_time } = anti_windup {
            if !(tracking_time > F::ZERO && tracking_time.is_finite()) {
                return Err(PidError::TrackingTime(tracking_time.to_f64()));
            }
            let sum = in_range("tracking time plus period", tracking_time + self.period)?;
            // Without an integral gain nothing winds up, and a bias must not drift.
            if self.gains.ki.abs() > F::ZERO {
                tracking = self.period / sum;
            }
        }
        let clamping = matches!(anti_windup, AntiWindup::Clamping);
        Ok(Self { anti_windup, tracking, clamping, ..self })
    }

    /// The gains.
    #[must_use]
    pub fn gains(&self) -> PidGains<F> {
        self.gains
    }

    /// The sampling period `h`, s.
    #[must_use]
    pub fn period(&self) -> F {
        self.period
    }

    /// What the derivative acts on.
    #[must_use]
    pub fn derivative_on(&self) -> DerivativeOn {
        self.derivative_on
    }

    /// The time constant of the derivative filter, s; zero without a filter.
    #[must_use]
    pub fn derivative_filter(&self) -> F {
        self.derivative_filter
    }

    /// The lower and the upper output limit.
    #[must_use]
    pub fn output_limits(&self) -> (F, F) {
        (self.lower, self.upper)
    }

    /// The anti-windup.
    #[must_use]
    pub fn anti_windup(&self) -> AntiWindup<F> {
        self.anti_windup
    }
}

fn in_range<F: Real>(quantity: &'static str, value: F) -> Result<F, PidError> {
    if value.is_finite() { Ok(value) } else { Err(PidError::Range { quantity, value: value.to_f64() }) }
}

#[cfg(feature = "serde")]
mod unchecked {
    //! The configuration as it is written down; an absent limit is infinite, which JSON could not say.

    use super::{AntiWindup, DerivativeOn, Pid, PidError, PidGains, Real};

    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(
        deny_unknown_fields,
        bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
    )]
    pub(super) struct UncheckedPid<F> {
        gains: PidGains<F>,
        period: F,
        #[serde(default)]
        derivative_on: DerivativeOn,
        #[serde(default)]
        derivative_filter: F,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        lower: Option<F>,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        upper: Option<F>,
        #[serde(default)]
        anti_windup: AntiWindup<F>,
    }

    impl<F: Real> TryFrom<UncheckedPid<F>> for Pid<F> {
        type Error = PidError;
        fn try_from(unchecked: UncheckedPid<F>) -> Result<Self, PidError> {
            let pid = Self::new(unchecked.gains, unchecked.period)?
                .with_derivative_on(unchecked.derivative_on)
                .with_derivative_filter(unchecked.derivative_filter)?
                .with_anti_windup(unchecked.anti_windup)?;
            pid.with_output_limits(unchecked.lower.unwrap_or(pid.lower), unchecked.upper.unwrap_or(pid.upper))
        }
    }

    impl<F: Real> From<Pid<F>> for UncheckedPid<F> {
        fn from(pid: Pid<F>) -> Self {
            Self {
                gains: pid.gains,
                period: pid.period,
                derivative_on: pid.derivative_on,
                derivative_filter: pid.derivative_filter,
                lower: Some(pid.lower).filter(|limit| limit.is_finite()),
                upper: Some(pid.upper).filter(|limit| limit.is_finite()),
                anti_windup: pid.anti_windup,
            }
        }
    }
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "numbers that are exact in binary")]
mod tests {
    use super::*;

    const GAINS: PidGains = PidGains { kp: 1.0, ki: 2.0, kd: 3.0 };

    fn pid() -> Pid {
        Pid::new(GAINS, 0.5).expect("valid")
    }

    #[test]
    fn bad_numbers_are_named() {
        assert_eq!(Pid::new(GAINS, 0.0), Err(PidError::Period(0.0)));
        assert_eq!(Pid::new(GAINS, f64::INFINITY), Err(PidError::Period(f64::INFINITY)));
        assert!(matches!(Pid::new(GAINS, f64::NAN), Err(PidError::Period(h)) if h.is_nan()));
        assert_eq!(
            Pid::new(PidGains { kd: f64::INFINITY, ..GAINS }, 1.0),
            Err(PidError::Gain { which: "kd", value: f64::INFINITY })
        );
        assert_eq!(pid().with_derivative_filter(-1.0), Err(PidError::DerivativeFilter(-1.0)));
        assert_eq!(
            pid().with_output_limits(2.0, 2.0),
            Err(PidError::OutputLimits { lower: 2.0, upper: 2.0 })
        );
        assert!(pid().with_output_limits(f64::NAN, 2.0).is_err());
        assert!(pid().with_output_limits(f64::INFINITY, f64::INFINITY).is_err());
        assert_eq!(
            pid().with_anti_windup(AntiWindup::BackCalculation { tracking_time: 0.0 }),
            Err(PidError::TrackingTime(0.0))
        );
    }

    #[test]
    fn coefficients_out_of_range_are_refused() {
        let huge = PidGains { ki: 1e300, ..GAINS };
        assert!(matches!(Pid::new(huge, 1e300), Err(PidError::Range { .. })));
        assert!(matches!(Pid::new(GAINS, 5e-324), Err(PidError::Range { .. })));
    }

    #[test]
    fn what_was_set_is_given_back() {
        let anti_windup = AntiWindup::BackCalculation { tracking_time: 0.5 };
        let pid = pid()
            .with_derivative_on(DerivativeOn::Measurement)
            .with_derivative_filter(0.25)
            .and_then(|p| p.with_anti_windup(anti_windup))
            .expect("valid");
        assert_eq!((pid.gains(), pid.period()), (GAINS, 0.5));
        assert_eq!(pid.derivative_on(), DerivativeOn::Measurement);
        assert_eq!(pid.derivative_filter(), 0.25);
        assert_eq!(pid.anti_windup(), anti_windup);
        assert_eq!(pid.output_limits(), (f64::NEG_INFINITY, f64::INFINITY));
    }
}
