//! How fast a surface is approached.

use profiles::Real;

use super::logarithm::LogMagnitude;
use super::sampling::{set_valued_sign, sign};
use crate::error::SlidingModeError;
use crate::range::{in_range, not_negative, positive};

/// What stands for `sgn s`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum Switching<F = f64> {
    /// The sign itself, zero at zero.
    #[default]
    Sign,
    /// `s / width` within `|s| < width`, the sign outside: a boundary layer in which the law is linear.
    Saturation {
        /// Half the width of the layer, in the unit of `s`.
        width: F,
    },
    /// `s / (|s| + width)`: smooth everywhere, and never quite the sign.
    Smooth {
        /// Where it is one half, in the unit of `s`.
        width: F,
    },
}

/// The law `s' = -rate(s, e)` by which a surface is approached; every rate has the sign of `s`, so that
/// `V = s^2 / 2` never grows: `V' = -s rate <= 0`.
///
/// | law | `rate` | zero after |
/// |---|---|---|
/// | [`constant`](Self::constant) | `eps sgn s` | `\|s0\| / eps` |
/// | [`exponential`](Self::exponential) | `k s + eps sgn s` | `ln(1 + k \|s0\| / eps) / k` |
/// | [`power`](Self::power) | `k \|s\|^a sgn s` | `\|s0\|^(1 - a) / (k (1 - a))` |
/// | [`double_power`](Self::double_power) | `(k1 \|s\|^b1 + k2 \|s\|^b2) sgn s` | a time that does not depend on `s0` |
/// | [`improved_double_power`](Self::improved_double_power) | the same with `b1 = 2 - b2`, and `+ k3 \|e\|^b3 s` | `pi / (2 (1 - b2) sqrt(k1 k2))` at most |
///
/// ```
/// use control::{ReachingLaw, Switching};
///
/// let law = ReachingLaw::improved_double_power(20.0, 20.0, 200.0, 1.0 / 3.0, 1.0 / 3.0)?;
/// let rate: f64 = law.rate(8.0, 0.001); // 20 * 32 + 20 * 2 + 200 * 0.1 * 8
/// assert!((rate - 840.0).abs() < 1e-10);
/// assert!(law.reaching_time(f64::INFINITY).is_some_and(|bound| bound < 0.118));
///
/// let quiet = ReachingLaw::exponential(200.0, 33.0)?.with_switching(Switching::Saturation { width: 0.1 })?;
/// assert_eq!(quiet.rate(0.05, 0.0), 26.5);
/// # Ok::<(), control::SlidingModeError>(())
/// ```
///
/// # References
/// W. Gao, J. C. Hung, *Variable structure control of nonlinear systems: a new approach*, IEEE Transactions on Industrial
/// Electronics 40(1), 1993, doi:10.1109/41.184820 (constant, exponential, power).
///
/// W. Wang, Z. Chen, Z. Wang, *Compensation sliding cross coupling control research of Cartesian coordinate robot*,
/// Journal of System Simulation 33(4), 2021, doi:10.16182/j.issn1004731x.joss.19-0646 (improved double power).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "super::unchecked::UncheckedLaw<F>",
        into = "super::unchecked::UncheckedLaw<F>",
        bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
    )
)]
pub struct ReachingLaw<F = f64> {
    pub(super) kind: Kind<F>,
    pub(super) switching: Switching<F>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub(super) enum Kind<F> {
    Constant { eps: F },
    Exponential { k: F, eps: F },
    Power { k: F, a: F },
    DoublePower { k1: F, b1: F, k2: F, b2: F },
    ImprovedDoublePower { k1: F, k2: F, k3: F, b2: F, b3: F },
}

impl<F: Real> ReachingLaw<F> {
    /// `eps sgn s`, with `eps` in the unit of `s` per second.
    ///
    /// # Errors
    /// An `eps` that is not positive and finite.
    pub fn constant(eps: F) -> Result<Self, SlidingModeError> {
        Self::checked(Kind::Constant { eps })
    }

    /// `k s + eps sgn s`, with `k` in 1/s and `eps` in the unit of `s` per second.
    ///
    /// # Errors
    /// A `k` that is not positive, an `eps` that is negative, either infinite or NaN.
    pub fn exponential(k: F, eps: F) -> Result<Self, SlidingModeError> {
        Self::checked(Kind::Exponential { k, eps })
    }

    /// `k |s|^a sgn s` with `0 < a < 1`.
    ///
    /// # Errors
    /// A `k` that is not positive and finite, or an exponent outside its range.
    pub fn power(k: F, a: F) -> Result<Self, SlidingModeError> {
        Self::checked(Kind::Power { k, a })
    }

    /// `(k1 |s|^b1 + k2 |s|^b2) sgn s` with `b1 > 1` for what is far and `0 < b2 < 1` for what is near.
    ///
    /// # Errors
    /// A gain that is not positive and finite, or an exponent outside its range.
    pub fn double_power(k1: F, b1: F, k2: F, b2: F) -> Result<Self, SlidingModeError> {
        Self::checked(Kind::DoublePower { k1, b1, k2, b2 })
    }

    /// `(k1 |s|^(2 - b2) + k2 |s|^b2) sgn s + k3 |e|^b3 s` with `0 < b2 < 1` and `b3 > 0`.
    ///
    /// # Errors
    /// A `k1` or `k2` that is not positive, a `k3` that is negative, any infinite or NaN, or an exponent outside its range.
    pub fn improved_double_power(k1: F, k2: F, k3: F, b2: F, b3: F) -> Result<Self, SlidingModeError> {
        Self::checked(Kind::ImprovedDoublePower { k1, k2, k3, b2, b3 })
    }

    /// Replaces what stands for `sgn s`, everywhere in the law.
    ///
    /// # Errors
    /// A width that is not positive and finite, or whose inverse is not.
    pub fn with_switching(self, switching: Switching<F>) -> Result<Self, SlidingModeError> {
        if let Switching::Saturation { width } | Switching::Smooth { width } = switching {
            let inverse = F::ONE / width;
            in_range(
                "width of the boundary layer",
                "positive",
                width,
                width > F::ZERO && inverse.is_finite(),
            )?;
        }
        Ok(Self { switching, ..self })
    }

    /// What stands for `sgn s`.
    #[must_use]
    pub fn switching(&self) -> Switching<F> {
        self.switching
    }

    /// `rate(s, e)`, in the unit of `s` per second.
    #[must_use]
    pub fn rate(&self, surface: F, error: F) -> F {
        self.rate_at(surface, LogMagnitude::of(error))
    }

    /// An upper bound of the time in s from `s = surface` to `s = 0` where the law holds exactly: without load, with the
    /// linear and the terminal surface; `surface` may be infinite. It is the time itself for the first three laws, and for
    /// the last one with `k3 = 0`.
    ///
    /// With [`Switching::Saturation`] it bounds the time to the edge of the layer. `None` where `s` only tends to zero:
    /// [`Switching::Smooth`], and an exponential law with `eps = 0`.
    #[must_use]
    pub fn reaching_time(&self, surface: F) -> Option<F> {
        if matches!(self.switching, Switching::Smooth { .. }) {
            return None;
        }
        let distance = surface.abs();
        let time = match self.kind {
            Kind::Constant { eps } => distance / eps,
            Kind::Exponential { k, eps } if eps > F::ZERO => (F::ONE + k * distance / eps).ln() / k,
            Kind::Exponential { .. } => return None,
            Kind::Power { k, a } => power_time(distance, k, a),
            Kind::DoublePower { k1, b1, k2, b2 } => {
                // The integral of 1/rate from 0 to infinity is a beta function with these exponents.
                let difference = b1 - b2;
                let share = (F::ONE - b2) / difference;
                let pi = F::from_f64(core::f64::consts::PI);
                let fixed = pi / (difference * k2 * (pi * share).sin()) * (k2 / k1).powf(share);
                fixed.min(power_time(distance, k2, b2))
            }
            Kind::ImprovedDoublePower { k1, k2, b2, .. } => {
                // With z = s^(1 - b2) the integral of 1/rate is that of 1/(1 + k1/k2 z^2).
                let rest = F::ONE - b2;
                let (far, near) = (k1.sqrt(), k2.sqrt());
                (distance.powf(rest) * far).atan2(near) / (rest * far * near)
            }
        };
        (!time.is_nan()).then_some(time)
    }

    /// The law with the logarithm of the error at hand.
    #[inline(always)]
    pub(super) fn rate_at(&self, surface: F, log_error: LogMagnitude<F>) -> F {
        let sign = self.sign(surface);
        match self.kind {
            Kind::Constant { eps } => eps * sign,
            Kind::Exponential { k, eps } => k * surface + eps * sign,
            Kind::Power { k, a } => k * LogMagnitude::of(surface).to_power(a) * sign,
            Kind::DoublePower { k1, b1, k2, b2 } => {
                let log = LogMagnitude::of(surface);
                (k1 * log.to_power(b1) + k2 * log.to_power(b2)) * sign
            }
            Kind::ImprovedDoublePower { k1, k2, k3, b2, b3 } => {
                // |s|^(2 - b2) is s^2 / |s|^b2, and the division costs less than a power.
                let near = LogMagnitude::of(surface).to_power(b2);
                let magnitude = surface.abs();
                let far = magnitude * (magnitude / near);
                (k1 * far + k2 * near) * sign + k3 * log_error.to_power(b3) * surface
            }
        }
    }

    /// `(k, eps)` of a law `k s + eps sgn s`.
    #[inline(always)]
    pub(super) fn signed_linear(&self) -> Option<(F, F)> {
        match (self.kind, self.switching) {
            (Kind::Constant { eps }, Switching::Sign) => Some((F::ZERO, eps)),
            (Kind::Exponential { k, eps }, Switching::Sign) => Some((k, eps)),
            _ => None,
        }
    }

    #[inline(always)]
    fn sign(&self, surface: F) -> F {
        match self.switching {
            Switching::Sign => sign(surface),
            Switching::Saturation { width } => set_valued_sign(surface, width),
            Switching::Smooth { width } => surface / (surface.abs() + width),
        }
    }

    /// The law with these parameters if they are in range.
    pub(super) fn checked(kind: Kind<F>) -> Result<Self, SlidingModeError> {
        match kind {
            Kind::Constant { eps } => positive("eps of the reaching law", eps)?,
            Kind::Exponential { k, eps } => {
                positive("k of the reaching law", k)?;
                not_negative("eps of the reaching law", eps)?;
            }
            Kind::Power { k, a } => {
                positive("k of the reaching law", k)?;
                below_one("exponent a of the reaching law", a)?;
            }
            Kind::DoublePower { k1, b1, k2, b2 } => {
                positive("k1 of the reaching law", k1)?;
                positive("k2 of the reaching law", k2)?;
                in_range("exponent b1 of the reaching law", "above one", b1, b1 > F::ONE)?;
                below_one("exponent b2 of the reaching law", b2)?;
            }
            Kind::ImprovedDoublePower { k1, k2, k3, b2, b3 } => {
                positive("k1 of the reaching law", k1)?;
                positive("k2 of the reaching law", k2)?;
                not_negative("k3 of the reaching law", k3)?;
                below_one("exponent b2 of the reaching law", b2)?;
                positive("exponent b3 of the reaching law", b3)?;
            }
        }
        Ok(Self { kind, switching: Switching::Sign })
    }
}

fn below_one<F: Real>(which: &'static str, exponent: F) -> Result<(), SlidingModeError> {
    Ok(in_range(which, "between zero and one", exponent, exponent > F::ZERO && exponent < F::ONE)?)
}

/// `|s0|^(1 - a) / (k (1 - a))`, the time of `s' = -k |s|^a sgn s` from `distance` to zero.
fn power_time<F: Real>(distance: F, k: F, a: F) -> F {
    let rest = F::ONE - a;
    distance.powf(rest) / (k * rest)
}
