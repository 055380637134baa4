//! What a disturbance observer is set to, checked once.

use profiles::Real;

use super::transition::Transition;
use crate::error::ObserverError;
use crate::sliding::AxisModel;

/// A checked observer of position, velocity and load of an axis, from its measured position and its input; any number of axes
/// may share it, each with its own [`DisturbanceObserverState`](crate::DisturbanceObserverState).
///
/// The model `x'' = -a x' - b x + k u + d` with a constant load `d`, stepped exactly, is corrected by what the position
/// differs, so that all three errors decay as `m^n` over `n` ticks of period `h`, with `m = e^(-w h)` and the bandwidth `w`
/// (an extended state observer in the form of a current estimator). From the load to its estimate the transfer function is,
/// with any model,
///
/// `D(z) = (1 - m)^3 z (z + c) / ((1 + c) (z - m)^3)`,
///
/// where `c` is one for short periods: the sampled form of `w^3 / (s + w)^3`. An estimate that a controller subtracts from
/// its input rejects loads as `1 - D` does: a constant one altogether, slow ones up to about `w / 3`. What the axis does
/// differently from its model counts as load.
///
/// ```
/// use control::{AxisModel, DisturbanceInput, DisturbanceObserver, DisturbanceObserverState};
///
/// let observer = DisturbanceObserver::new(AxisModel::new(10.0, 0.0, 2.0)?, 400.0, 1e-3)?; // rad/s, s
/// let mut axis = DisturbanceObserverState::new();
/// // An axis that stands still under an input of 3 is held by a load of -6.
/// for _ in 0..100 {
///     let _ = observer.update(&mut axis, DisturbanceInput { position: 0.25, realised: 3.0 });
/// }
/// let estimate = axis.estimate();
/// assert!((estimate.load + 6.0).abs() < 1e-9 && estimate.velocity.abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # References
/// Z. Gao, *Scaling and bandwidth-parameterization based controller tuning*, American Control Conference, 2003,
/// doi:10.1109/ACC.2003.1242516.
///
/// R. Miklosovic, A. Radke, Z. Gao, *Discrete implementation and generalization of the extended state observer*, American
/// Control Conference, 2006, doi:10.1109/ACC.2006.1656547.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "UncheckedObserver<F>",
        into = "UncheckedObserver<F>",
        bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
    )
)]
pub struct DisturbanceObserver<F = f64> {
    pub(super) model: AxisModel<F>,
    bandwidth: F,
    period: F,
    // What the tick needs, computed once.
    /// From position and velocity to position, from both to velocity, from acceleration to position.
    pub(super) persistence: F,
    pub(super) value: F,
    pub(super) restoring: F,
    pub(super) rate: F,
    pub(super) integral: F,
    /// What a difference of position adds to position, velocity and load.
    pub(super) position_gain: F,
    pub(super) velocity_gain: F,
    pub(super) load_gain: F,
}

impl<F: Real> DisturbanceObserver<F> {
    /// A model, the bandwidth `w` in rad/s and the sampling period `h` in s.
    ///
    /// # Errors
    /// A bandwidth or period that is not positive and finite, or gains that leave the range of `F`: with a period in which a
    /// spring without damping swings back and forth exactly, the velocity cannot be seen.
    pub fn new(model: AxisModel<F>, bandwidth: F, period: F) -> Result<Self, ObserverError> {
        for (which, value) in [("bandwidth", bandwidth), ("sampling period", period)] {
            if !(value > F::ZERO && value.is_finite()) {
                return Err(ObserverError::Parameter { which, value: value.to_f64() });
            }
        }
        let (h, w) = (period.to_f64(), bandwidth.to_f64());
        let damping = model.damping().to_f64();
        let step = Transition::over(h, damping, model.stiffness().to_f64());
        let [l1, l2, l3] = gains(&step, damping * h, w * h);
        let finite = |quantity, value: f64| {
            let value = F::from_f64(value);
            if value.is_finite() {
                Ok(value)
            } else {
                Err(ObserverError::Range { quantity, value: value.to_f64() })
            }
        };
        Ok(Self {
            model,
            bandwidth,
            period,
            persistence: finite("effect of position on position", step.persistence())?,
            value: finite("effect of velocity on position", step.value)?,
            restoring: finite("effect of position on velocity", step.restoring())?,
            rate: finite("effect of velocity on velocity", step.rate)?,
            integral: finite("effect of acceleration on position", step.integral)?,
            position_gain: finite("gain of the position", l1)?,
            velocity_gain: finite("gain of the velocity", l2)?,
            load_gain: finite("gain of the load", l3)?,
        })
    }

    /// The model of the axis.
    #[must_use]
    pub fn model(&self) -> AxisModel<F> {
        self.model
    }

    /// The bandwidth `w`, rad/s.
    #[must_use]
    pub fn bandwidth(&self) -> F {
        self.bandwidth
    }

    /// The sampling period `h`, s.
    #[must_use]
    pub fn period(&self) -> F {
        self.period
    }
}

/// The gains for which the errors decay as `m^n`, with `damping = a h` and `bandwidth = w h`.
///
/// With the step `A` of position, velocity and load, and `L` the gains, the errors are stepped by `(I - L C) A`, whose
/// characteristic polynomial is
///
/// `(1 - l1) (z - 1) (z^2 - T z + D) + z (l1 (z - r) (z - 1) + l2 f (z - 1) + l3 (i z + f^2 - i r))`
///
/// with value `f`, rate `r` and integral `i` of the step, `T = 2 r + a f` and `D = e^(-a h)`. It is `(z - m)^3` at `z = 0`
/// for `l1`, at `z = 1` for `l3`, and in the coefficient of `z^2` for `l2`.
fn gains(step: &Transition, damping: f64, bandwidth: f64) -> [f64; 3] {
    let Transition { value, rate, integral, .. } = *step;
    // One minus m, and so on: short periods leave little of them.
    let missing = one_minus_exp(-bandwidth);
    let l1 = one_minus_exp(damping - 3.0 * bandwidth);
    let l3 = missing * missing * missing / (integral * (1.0 - rate) + value * value);
    let lost = step.lost_persistence() + step.lost_rate();
    let l2 = (3.0 * missing - lost - l1 * step.persistence() - l3 * integral) / value;
    [l1, l2, l3]
}

/// `1 - e^x` to rounding: with the rounded `e^x` in numerator and denominator its error cancels.
fn one_minus_exp(x: f64) -> f64 {
    let exp = Real::exp(x);
    let (difference, log) = (1.0 - exp, Real::ln(exp));
    if difference.abs() > 0.0 {
        if log.is_finite() { difference * (x / log) } else { difference }
    } else {
        -x
    }
}

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(
    deny_unknown_fields,
    bound(serialize = "F: serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
)]
struct UncheckedObserver<F> {
    model: AxisModel<F>,
    bandwidth: F,
    period: F,
}

#[cfg(feature = "serde")]
impl<F: Real> TryFrom<UncheckedObserver<F>> for DisturbanceObserver<F> {
    type Error = ObserverError;
    fn try_from(unchecked: UncheckedObserver<F>) -> Result<Self, ObserverError> {
        Self::new(unchecked.model, unchecked.bandwidth, unchecked.period)
    }
}

#[cfg(feature = "serde")]
impl<F: Real> From<DisturbanceObserver<F>> for UncheckedObserver<F> {
    fn from(observer: DisturbanceObserver<F>) -> Self {
        let DisturbanceObserver { model, bandwidth, period, .. } = observer;
        Self { model, bandwidth, period }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_minus_the_exponential_keeps_its_digits() {
        for x in [-1e-18, -1e-9, -0.3, -40.0, 1e-12, 2.0] {
            let exact = -f64::exp_m1(x);
            assert!((one_minus_exp(x) / exact - 1.0).abs() < 4.0 * f64::EPSILON, "{x}");
        }
        assert!((one_minus_exp(-1e4) - 1.0).abs() < f64::EPSILON);
        assert!(one_minus_exp(1e4).is_infinite());
    }

    /// The characteristic polynomial of `(I - L C) A` at `z`, from the matrix itself.
    fn polynomial(observer: &DisturbanceObserver, z: f64) -> f64 {
        let o = observer;
        let a = [[o.persistence, o.value, o.integral], [o.restoring, o.rate, o.value], [0.0, 0.0, 1.0]];
        let gains = [o.position_gain, o.velocity_gain, o.load_gain];
        let entry = |i: usize, j: usize| {
            let diagonal = if i == j { z } else { 0.0 };
            diagonal - a[i][j] + gains[i] * a[0][j]
        };
        let minor = |i: usize, j: usize| entry(1, i) * entry(2, j) - entry(1, j) * entry(2, i);
        entry(0, 0) * minor(1, 2) - entry(0, 1) * minor(0, 2) + entry(0, 2) * minor(0, 1)
    }

    #[test]
    fn every_pole_is_where_the_bandwidth_says() {
        for (damping, stiffness, bandwidth, period) in [
            (10.0, 1.0, 400.0, 1e-3),
            (0.0, 0.0, 50.0, 1e-3),
            (90.0, 4e3, 30.0, 1e-2),
            (0.3, 900.0, 5e3, 1e-3),
        ] {
            let model = AxisModel::new(damping, stiffness, 2.0).expect("valid");
            let observer = DisturbanceObserver::new(model, bandwidth, period).expect("valid");
            let pole = (-bandwidth * period).exp();
            for z in [-1.0_f64, 0.0, 0.5, 1.0, 2.0] {
                let exact = (z - pole).powi(3);
                // Some twenty products of entries up to the gains, of terms up to 8.
                let scale = 8.0 * (1.0 + observer.position_gain.abs());
                assert!((polynomial(&observer, z) - exact).abs() < 32.0 * f64::EPSILON * scale, "{z}");
            }
        }
    }

    #[test]
    fn bad_parameters_are_named() {
        let model = AxisModel::new(0.0, 1.0, 1.0).expect("valid");
        assert_eq!(
            DisturbanceObserver::new(model, 0.0, 1.0),
            Err(ObserverError::Parameter { which: "bandwidth", value: 0.0 })
        );
        assert_eq!(
            DisturbanceObserver::new(model, 1.0, f64::INFINITY),
            Err(ObserverError::Parameter { which: "sampling period", value: f64::INFINITY })
        );
        assert!(matches!(
            DisturbanceObserver::<f32>::new(AxisModel::new(0.0, 0.0, 1.0).expect("valid"), 1e20, 1e-20),
            Err(ObserverError::Range { quantity: "gain of the load", .. })
        ));
    }
}
