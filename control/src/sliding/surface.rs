//! Where the error of an axis is meant to slide.

use profiles::Real;

use super::logarithm::LogMagnitude;
use crate::error::SlidingModeError;
use crate::range::{in_range, not_negative, positive};

/// A function `s(e, e')` of the error `e = r - x` and its rate that a controller drives to zero; with `s = 0` the error
/// decays by itself.
///
/// | surface | `s` | on `s = 0` the error |
/// |---|---|---|
/// | [`linear`](Self::linear) | `e' + c e` | decays as `e^(-c t)` |
/// | [`terminal`](Self::terminal) | `e' + alpha e + beta \|e\|^(q/p) sgn e` | is zero after a finite time |
/// | [`nonsingular_terminal`](Self::nonsingular_terminal) | `e + \|e'\|^(p/q) sgn e' / beta` | is zero after a finite time |
/// | [`fast_nonsingular_terminal`](Self::fast_nonsingular_terminal) | the same, and `+ \|e\|^g sgn e / alpha` | is zero sooner from afar |
///
/// Errors are in m or rad, their rates in m/s or rad/s.
///
/// ```
/// use control::SlidingSurface;
///
/// let surface = SlidingSurface::terminal(10.0, 1.0, 9, 5)?; // 1/s, m^(4/9)/s
/// // From one metre off: p / (alpha (p - q)) ln(1 + alpha / beta)
/// let time = surface.sliding_time(1.0).ok_or("asymptotic")?;
/// assert!((time - 0.225 * 11_f64.ln()).abs() < 1e-12);
/// assert!(SlidingSurface::terminal(10.0, 1.0, 9, 4).is_err(), "an even q has no power of a negative error");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # References
/// M. Zhihong, A. P. Paplinski, H. R. Wu, *A robust MIMO terminal sliding mode control scheme for rigid robotic
/// manipulators*, IEEE Transactions on Automatic Control 39(12), 1994, doi:10.1109/9.362847 (terminal).
///
/// Y. Feng, X. Yu, Z. Man, *Non-singular terminal sliding mode control of rigid manipulators*, Automatica 38(12), 2002,
/// doi:10.1016/S0005-1098(02)00147-4.
///
/// L. Yang, J. Yang, *Nonsingular fast terminal sliding-mode control for nonlinear dynamical systems*, International
/// Journal of Robust and Nonlinear Control 21(16), 2011, doi:10.1002/rnc.1666.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "super::unchecked::UncheckedSurface<F>",
        into = "super::unchecked::UncheckedSurface<F>",
        bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
    )
)]
pub struct SlidingSurface<F = f64>(pub(super) Kind<F>);

/// The parameters as they were given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind<F> {
    Linear { c: F },
    Terminal { alpha: F, beta: F, p: u32, q: u32, guard: Option<F> },
    NonsingularTerminal { beta: F, p: u32, q: u32 },
    FastNonsingularTerminal { alpha: F, g: F, beta: F, p: u32, q: u32 },
}

impl<F: Real> SlidingSurface<F> {
    /// `s = e' + c e` with the slope `c` in 1/s.
    ///
    /// # Errors
    /// A slope that is not positive and finite.
    pub fn linear(c: F) -> Result<Self, SlidingModeError> {
        positive("slope of the surface", c)?;
        Ok(Self(Kind::Linear { c }))
    }

    /// `s = e' + alpha e + beta |e|^(q/p) sgn e`, with `alpha` in 1/s and `beta` in m^(1 - q/p)/s.
    ///
    /// Its slope `ds/de = alpha + beta (q/p) |e|^(q/p - 1)` grows without bound towards `e = 0`, and an input that
    /// keeps `s = 0` holds the term `ds/de e'`. Therefore the power is a straight line within a guard `g`: for
    /// `|e| < g` the surface is `e' + (alpha + beta g^(q/p - 1)) e`, which joins the power at `g` without a jump, and
    /// everywhere
    ///
    /// `|ds/de e'| <= (alpha + beta g^(q/p - 1)) |e'|`.
    ///
    /// A controller with period `h` takes `g = (beta h)^(p / (p - q))` unless [`with_guard`](Self::with_guard) says
    /// otherwise: `beta g^(q/p - 1)` is then `1/h`, the steepest slope at which a sampled error does not swing. With
    /// `beta = 1`, `q/p = 5/9` and 1 ms this is 1.8e-7.
    ///
    /// With `2 q > p` the term vanishes towards `e = 0` along `s = 0`, so that the guard matters only off the surface.
    ///
    /// # Errors
    /// An `alpha` that is negative, a `beta` that is not positive, either infinite or NaN, or exponents that are not odd
    /// with `0 < q < p`.
    pub fn terminal(alpha: F, beta: F, p: u32, q: u32) -> Result<Self, SlidingModeError> {
        not_negative("alpha of the surface", alpha)?;
        positive("beta of the surface", beta)?;
        if p.is_multiple_of(2) || q.is_multiple_of(2) || q >= p {
            return Err(SlidingModeError::TerminalExponents { p, q });
        }
        Ok(Self(Kind::Terminal { alpha, beta, p, q, guard: None }))
    }

    /// `s = e + |e'|^(p/q) sgn e' / beta`: the terminal surface with `alpha = 0` solved for `e`, whose input has no
    /// singular term. `beta` is in (m/s)^(p/q)/m.
    ///
    /// # Errors
    /// A `beta` that is not positive and finite, or exponents that are not odd with `q < p < 2 q`.
    pub fn nonsingular_terminal(beta: F, p: u32, q: u32) -> Result<Self, SlidingModeError> {
        positive("beta of the surface", beta)?;
        nonsingular_exponents(p, q)?;
        Ok(Self(Kind::NonsingularTerminal { beta, p, q }))
    }

    /// `s = e + |e|^g sgn e / alpha + |e'|^(p/q) sgn e' / beta` with `g > p/q`: far off, where the second term outweighs
    /// the first, the error decays faster than any terminal surface alone.
    ///
    /// # Errors
    /// An `alpha` or `beta` that is not positive and finite, exponents that are not odd with `q < p < 2 q`, or a `g` that
    /// is not above `p/q` and finite.
    pub fn fast_nonsingular_terminal(
        alpha: F,
        g: F,
        beta: F,
        p: u32,
        q: u32,
    ) -> Result<Self, SlidingModeError> {
        positive("alpha of the surface", alpha)?;
        positive("beta of the surface", beta)?;
        nonsingular_exponents(p, q)?;
        in_range("exponent g of the surface", "above p/q", g, g > ratio(p, q))?;
        Ok(Self(Kind::FastNonsingularTerminal { alpha, g, beta, p, q }))
    }

    /// Replaces the guard of a terminal surface, m; on others it is without effect.
    ///
    /// # Errors
    /// A guard that is not positive and finite.
    pub fn with_guard(self, guard: F) -> Result<Self, SlidingModeError> {
        positive("guard of the surface", guard)?;
        Ok(match self.0 {
            Kind::Terminal { alpha, beta, p, q, .. } => {
                Self(Kind::Terminal { alpha, beta, p, q, guard: Some(guard) })
            }
            _ => self,
        })
    }

    /// How long the error takes from `error` to zero once `s = 0`, s; `None` where it takes for ever. The guard of a
    /// terminal surface is left out, and for the fast non-singular surface this is an upper bound.
    #[must_use]
    pub fn sliding_time(&self, error: F) -> Option<F> {
        let error = LogMagnitude::of(error);
        match self.0 {
            Kind::Linear { .. } => None,
            Kind::Terminal { alpha, beta, p, q, .. } => {
                let rest = F::ONE - ratio(q, p);
                let power = error.to_power(rest);
                // ln(1 + x)/x written so that alpha = 0 is its limit
                let x = alpha * power / beta;
                Some(power / (beta * rest) * log1p_over(x))
            }
            Kind::NonsingularTerminal { beta, p, q } | Kind::FastNonsingularTerminal { beta, p, q, .. } => {
                let inverse = ratio(q, p);
                let rest = F::ONE - inverse;
                Some(error.to_power(rest) / (beta.powf(inverse) * rest))
            }
        }
    }

    /// What a tick needs, for a controller with `period` in s.
    pub(super) fn prepared(&self, period: F) -> Result<Prepared<F>, SlidingModeError> {
        let prepared = match self.0 {
            Kind::Linear { c } => Prepared::Linear { c },
            Kind::Terminal { alpha, beta, p, q, guard } => {
                let exponent = ratio(q, p);
                let excess = exponent - F::ONE;
                let guard = guard.unwrap_or_else(|| (beta * period).powf(-F::ONE / excess));
                finite("guard of the surface", guard)?;
                let log_guard = LogMagnitude::of(guard);
                finite("slope of the surface within its guard", alpha + beta * log_guard.to_power(excess))?;
                Prepared::Terminal { alpha, beta, exponent, excess, guard, log_guard }
            }
            Kind::NonsingularTerminal { beta, p, q } => nonsingular(F::ZERO, F::ONE, beta, p, q)?,
            Kind::FastNonsingularTerminal { alpha, g, beta, p, q } => {
                nonsingular(finite("inverse of alpha", F::ONE / alpha)?, g, beta, p, q)?
            }
        };
        Ok(prepared)
    }
}

/// A surface with what does not change from tick to tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Prepared<F> {
    Linear {
        c: F,
    },
    /// `excess` is `exponent - 1 = q/p - 1`.
    Terminal {
        alpha: F,
        beta: F,
        exponent: F,
        excess: F,
        guard: F,
        log_guard: LogMagnitude<F>,
    },
    /// `excess` is `p/q - 1`, `rate_gain` is `beta q/p`; without the fast term `error_gain` is zero.
    Nonsingular {
        error_gain: F,
        g: F,
        rate_share: F,
        excess: F,
        rate_gain: F,
    },
}

/// A surface at one error.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point<F> {
    /// `s`.
    pub(super) value: F,
    /// The `w` for which `e'' = -w` keeps `s`, m/s^2.
    pub(super) demand: F,
    /// `ds/de'`, what an acceleration does to `s`.
    pub(super) leverage: F,
}

impl<F: Real> Prepared<F> {
    /// `s` and what keeps it, at an error with the logarithm `log_error`.
    #[inline(always)]
    pub(super) fn at(&self, error: F, error_rate: F, log_error: LogMagnitude<F>) -> Point<F> {
        match *self {
            Self::Linear { c } => {
                Point { value: error_rate + c * error, demand: c * error_rate, leverage: F::ONE }
            }
            Self::Terminal { alpha, beta, exponent, excess, guard, log_guard } => {
                let chord = beta * log_error.at_least(log_guard).to_power(excess);
                let slope = if error.abs() < guard { chord } else { exponent * chord };
                let value = error_rate + (alpha + chord) * error;
                Point { value, demand: (alpha + slope) * error_rate, leverage: F::ONE }
            }
            Self::Nonsingular { error_gain, g, rate_share, excess, rate_gain } => {
                let chord = LogMagnitude::of(error_rate).to_power(excess);
                let fast = error_gain * log_error.to_power(g - F::ONE);
                Point {
                    value: error + fast * error + rate_share * chord * error_rate,
                    demand: rate_gain * (F::ONE + g * fast) * (error_rate / chord),
                    leverage: rate_share * (F::ONE + excess) * chord,
                }
            }
        }
    }
}

fn nonsingular<F: Real>(
    error_gain: F,
    g: F,
    beta: F,
    p: u32,
    q: u32,
) -> Result<Prepared<F>, SlidingModeError> {
    let rate_share = finite("inverse of beta", F::ONE / beta)?;
    Ok(Prepared::Nonsingular {
        error_gain,
        g,
        rate_share,
        excess: ratio::<F>(p, q) - F::ONE,
        rate_gain: beta * ratio(q, p),
    })
}

fn nonsingular_exponents(p: u32, q: u32) -> Result<(), SlidingModeError> {
    let odd = !p.is_multiple_of(2) && !q.is_multiple_of(2);
    if odd && q < p && u64::from(p) < 2 * u64::from(q) {
        Ok(())
    } else {
        Err(SlidingModeError::NonsingularExponents { p, q })
    }
}

/// `over / under`, rounded once.
fn ratio<F: Real>(over: u32, under: u32) -> F {
    F::from_f64(f64::from(over) / f64::from(under))
}

fn finite<F: Real>(quantity: &'static str, value: F) -> Result<F, SlidingModeError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(SlidingModeError::Range { quantity, value: value.to_f64() })
    }
}

/// `ln(1 + x) / x` for `x >= 0`, one at zero.
fn log1p_over<F: Real>(x: F) -> F {
    // With the rounded 1 + x in both places the rounding cancels.
    let sum = F::ONE + x;
    let rounded = sum - F::ONE;
    if rounded > F::ZERO { sum.ln() / rounded } else { F::ONE }
}
