//! What a current loop is set to, checked once.

use profiles::Real;

use crate::error::CurrentLoopError;
use crate::range::{in_range, not_negative, positive};

/// The gains of a PI controller: of current in volts, of velocity in amperes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct PiGains<F = f64> {
    /// Proportional gain: V/A of current, A s/rad of velocity.
    pub kp: F,
    /// Integral gain: V/(A s) of current, A/rad of velocity; zero freezes the integral.
    pub ki: F,
}

impl<F: Real> PiGains<F> {
    /// Gains that make the current through `resistance` in ohm and `inductance` in H follow its reference as a first-order
    /// lag with `bandwidth` in rad/s.
    ///
    /// `kp = L w`, `ki = R w`: the zero of the controller cancels the pole of the winding, `(L s + R) w / s / (L s + R) = w / s`.
    ///
    /// # Errors
    /// A resistance that is negative, an inductance or bandwidth that is not positive, any of them not finite, or gains
    /// that leave the range of `F`.
    pub fn pole_zero_cancellation(
        resistance: F,
        inductance: F,
        bandwidth: F,
    ) -> Result<Self, CurrentLoopError> {
        not_negative("resistance", resistance)?;
        positive("inductance", inductance)?;
        positive("bandwidth", bandwidth)?;
        let gains = Self { kp: inductance * bandwidth, ki: resistance * bandwidth };
        checked("tuned", gains)
    }
}

/// The electrical properties of a motor in rotor axes, as seen by one phase.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Windings<F = f64> {
    /// Resistance `R`, ohm.
    pub resistance: F,
    /// Inductance `L_d` along the flux of the rotor, H.
    pub d_inductance: F,
    /// Inductance `L_q` across it, H.
    pub q_inductance: F,
    /// Flux linkage `psi` of the magnets, Wb (amplitude of one phase).
    pub flux: F,
}

/// A checked configuration of the current loop of a motor; any number of axes may share it, each with its own
/// [`CurrentLoopState`](crate::CurrentLoopState).
///
/// ```
/// use control::{CurrentLoop, Windings};
///
/// let windings = Windings::<f64> { resistance: 2.875, d_inductance: 8.5e-3, q_inductance: 8.5e-3, flux: 0.175 };
/// let current_loop = CurrentLoop::tuned(windings, 1500.0, 1e-4)?.with_voltage_limit(180.0)?;
/// assert!((current_loop.q_gains().kp - 12.75).abs() < 1e-14); // 8.5 mH times 1500 rad/s
/// # Ok::<(), control::CurrentLoopError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "super::unchecked::UncheckedCurrentLoop<F>",
        into = "super::unchecked::UncheckedCurrentLoop<F>",
        bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
    )
)]
pub struct CurrentLoop<F = f64> {
    pub(super) d_gains: PiGains<F>,
    pub(super) q_gains: PiGains<F>,
    period: F,
    pub(super) d_inductance: F,
    pub(super) q_inductance: F,
    pub(super) flux: F,
    pub(super) voltage_limit: F,
    // What the tick needs, computed once.
    /// `1 - e^(-h ki / kp)` of each axis.
    pub(super) d_reset: F,
    pub(super) q_reset: F,
    pub(super) voltage_limit_squared: F,
}

impl<F: Real> CurrentLoop<F> {
    /// Gains of both axes and sampling period `h` in s; no decoupling, voltage unlimited.
    ///
    /// # Errors
    /// A proportional gain that is not positive and finite, an integral gain that is negative, infinite or NaN, or a
    /// period that is not positive and finite.
    pub fn new(d_gains: PiGains<F>, q_gains: PiGains<F>, period: F) -> Result<Self, CurrentLoopError> {
        if !(period > F::ZERO && period.is_finite()) {
            return Err(CurrentLoopError::Period(period.to_f64()));
        }
        let infinity = F::from_f64(f64::INFINITY);
        Self {
            d_gains,
            q_gains,
            period,
            d_inductance: F::ZERO,
            q_inductance: F::ZERO,
            flux: F::ZERO,
            voltage_limit: infinity,
            d_reset: F::ZERO,
            q_reset: F::ZERO,
            voltage_limit_squared: infinity,
        }
        .with_gains(d_gains, q_gains)
    }

    /// Gains of [`PiGains::pole_zero_cancellation`] for `windings` and a `bandwidth` in rad/s on both axes, and the
    /// decoupling of these windings; voltage unlimited.
    ///
    /// # Errors
    /// Those of [`CurrentLoop::new`], [`PiGains::pole_zero_cancellation`] and [`CurrentLoop::with_decoupling`].
    pub fn tuned(windings: Windings<F>, bandwidth: F, period: F) -> Result<Self, CurrentLoopError> {
        let Windings { resistance, d_inductance, q_inductance, flux } = windings;
        let d_gains = PiGains::pole_zero_cancellation(resistance, d_inductance, bandwidth)?;
        let q_gains = PiGains::pole_zero_cancellation(resistance, q_inductance, bandwidth)?;
        Self::new(d_gains, q_gains, period)?.with_decoupling(d_inductance, q_inductance, flux)
    }

    /// Replaces the gains; [`CurrentLoop::take_over`] makes the change without a bump.
    ///
    /// # Errors
    /// A proportional gain that is not positive and finite, or an integral gain that is negative, infinite or NaN.
    pub fn with_gains(self, d_gains: PiGains<F>, q_gains: PiGains<F>) -> Result<Self, CurrentLoopError> {
        let d_gains = checked("d", d_gains)?;
        let q_gains = checked("q", q_gains)?;
        let reset = |gains: PiGains<F>| F::ONE - (-(self.period * (gains.ki / gains.kp))).exp();
        Ok(Self { d_gains, q_gains, d_reset: reset(d_gains), q_reset: reset(q_gains), ..self })
    }

    /// Replaces the decoupling: inductances `L_d` and `L_q` in H and flux linkage `psi` of the magnets in Wb, by which
    /// `-w L_q i_q` and `w (L_d i_d + psi)` are added to the voltages at the electrical speed `w`; zeros are no decoupling.
    ///
    /// # Errors
    /// An inductance that is negative, infinite or NaN, or a flux that is infinite or NaN.
    pub fn with_decoupling(
        self,
        d_inductance: F,
        q_inductance: F,
        flux: F,
    ) -> Result<Self, CurrentLoopError> {
        not_negative("d inductance", d_inductance)?;
        not_negative("q inductance", q_inductance)?;
        in_range("flux", "of any sign", flux, true)?;
        Ok(Self { d_inductance, q_inductance, flux, ..self })
    }

    /// Replaces the largest length of the voltage vector, V (amplitude of one phase: for sine-triangle modulation half the
    /// link voltage, for space vectors the link voltage over the root of three); infinity means unlimited.
    ///
    /// # Errors
    /// A limit that is not positive, or whose square or inverse square leaves the range of `F`.
    pub fn with_voltage_limit(self, limit: F) -> Result<Self, CurrentLoopError> {
        let positive = limit > F::ZERO;
        if !positive {
            return Err(CurrentLoopError::VoltageLimit(limit.to_f64()));
        }
        let squared = limit * limit;
        let has_square = squared.is_finite() && (F::ONE / squared).is_finite();
        if limit.is_finite() && !has_square {
            let quantity = "the square of the voltage limit";
            return Err(CurrentLoopError::Range { quantity, value: squared.to_f64() });
        }
        Ok(Self { voltage_limit: limit, voltage_limit_squared: squared, ..self })
    }

    /// The gains of the d axis.
    #[must_use]
    pub fn d_gains(&self) -> PiGains<F> {
        self.d_gains
    }

    /// The gains of the q axis.
    #[must_use]
    pub fn q_gains(&self) -> PiGains<F> {
        self.q_gains
    }

    /// The sampling period `h`, s.
    #[must_use]
    pub fn period(&self) -> F {
        self.period
    }

    /// `L_d` in H, `L_q` in H and `psi` in Wb of the decoupling.
    #[must_use]
    pub fn decoupling(&self) -> (F, F, F) {
        (self.d_inductance, self.q_inductance, self.flux)
    }

    /// The largest length of the voltage vector, V.
    #[must_use]
    pub fn voltage_limit(&self) -> F {
        self.voltage_limit
    }
}

fn checked<F: Real>(axis: &'static str, gains: PiGains<F>) -> Result<PiGains<F>, CurrentLoopError> {
    if !(gains.kp > F::ZERO && gains.kp.is_finite()) {
        return Err(CurrentLoopError::ProportionalGain { axis, value: gains.kp.to_f64() });
    }
    if !(gains.ki >= F::ZERO && gains.ki.is_finite()) {
        return Err(CurrentLoopError::IntegralGain { axis, value: gains.ki.to_f64() });
    }
    Ok(gains)
}
