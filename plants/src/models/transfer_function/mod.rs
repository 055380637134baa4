//! Rational transfer functions.

mod cascade;
mod held;
mod realised;
mod response;

pub use held::HeldTransferFunction;

use nalgebra::Complex;
use profiles::Real;

use crate::error::ModelError;
use crate::linear::{polynomial_roots, quadratic_roots};

/// A rational transfer function with real coefficients, by its zeros `z`, its poles `p` and its gain `k`:
///
/// `G(s) = k (s - z_1) ... (s - z_m) / ((s - p_1) ... (s - p_n))`, `m <= n`
///
/// Poles and zeros are in rad/s. They are what is kept: no polynomial is multiplied out, neither for a frequency
/// response nor for a state space, so that poles as close as rounding allows stay apart.
///
/// ```
/// use plants::{TransferFunction, nalgebra::Complex};
///
/// // A belt drive that vibrates at 1.2 Hz: gain 1.15, a zero at -11 rad/s.
/// let belt = TransferFunction::second_order(1.15, 7.54, 0.2, 1.0 / 11.0)?;
/// assert!((belt.dc_gain()? - 1.15).abs() < 1e-15);
/// assert!((belt.frequency_response(7.54)?.norm() - 3.486).abs() < 1e-3);
///
/// // Exact at the samples under a held input, whatever the order.
/// let step = belt.step_response(0.01, 1000)?;
/// assert!((step[999] - 1.15).abs() < 1e-5);
///
/// // As a state space of the right order, and back.
/// let system = belt.to_state_space::<2>()?;
/// let again = TransferFunction::from_state_space(&system, 0, 0)?;
/// assert!((again.zeros()[0] - Complex::new(-11.0, 0.0)).norm() < 1e-13);
/// # Ok::<(), plants::ModelError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Unchecked", into = "Unchecked"))]
pub struct TransferFunction {
    // Real ones first, then pairs that are conjugate to the bit, the one with positive imaginary part first.
    zeros: Vec<Complex<f64>>,
    poles: Vec<Complex<f64>>,
    gain: f64,
}

/// Real and imaginary parts, as written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct Unchecked {
    zeros: Vec<[f64; 2]>,
    poles: Vec<[f64; 2]>,
    gain: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for TransferFunction {
    type Error = ModelError;
    fn try_from(written: Unchecked) -> Result<Self, ModelError> {
        let roots = |list: Vec<[f64; 2]>| -> Vec<_> {
            list.into_iter().map(|[re, im]| Complex::new(re, im)).collect()
        };
        Self::new(&roots(written.zeros), &roots(written.poles), written.gain)
    }
}

#[cfg(feature = "serde")]
impl From<TransferFunction> for Unchecked {
    fn from(transfer: TransferFunction) -> Self {
        let parts = |list: Vec<Complex<f64>>| list.into_iter().map(|root| [root.re, root.im]).collect();
        Self { zeros: parts(transfer.zeros), poles: parts(transfer.poles), gain: transfer.gain }
    }
}

/// Conjugates may differ by so much of their magnitude, as an eigenvalue solver leaves them.
const CONJUGATE: f64 = 1e-12;

impl TransferFunction {
    /// A transfer function from its zeros and poles in rad/s, in any order, and the gain `k` of the highest powers.
    ///
    /// Complex zeros and poles come in conjugate pairs, to 1e-12 of their magnitude.
    ///
    /// # Errors
    /// A number that is not finite, a complex zero or pole without its conjugate, or more zeros than poles.
    pub fn new(zeros: &[Complex<f64>], poles: &[Complex<f64>], gain: f64) -> Result<Self, ModelError> {
        if !gain.is_finite() {
            return Err(ModelError::Parameter { parameter: "the gain", range: "finite", value: gain });
        }
        if zeros.len() > poles.len() {
            return Err(ModelError::Improper { zeros: zeros.len(), poles: poles.len() });
        }
        Ok(Self { zeros: paired("zero", zeros)?, poles: paired("pole", poles)?, gain })
    }

    /// A transfer function from its zeros and poles in rad/s and its value at `s = 0`:
    ///
    /// `k = G(0) (-p_1) ... (-p_n) / ((-z_1) ... (-z_m))`
    ///
    /// # Errors
    /// As [`new`](Self::new), or a zero or pole at the origin.
    pub fn with_dc_gain(
        zeros: &[Complex<f64>],
        poles: &[Complex<f64>],
        dc_gain: f64,
    ) -> Result<Self, ModelError> {
        let unit = Self::new(zeros, poles, 1.0)?;
        let value = unit.dc_gain()?;
        if value == 0.0 {
            return Err(ModelError::Parameter {
                parameter: "a zero of a transfer function with a gain at s = 0",
                range: "away from the origin",
                value,
            });
        }
        unit.scaled(dc_gain / value)
    }

    /// A transfer function from the coefficients of its numerator and denominator, highest power first.
    ///
    /// Roots as accurate as [`polynomial_roots`] finds them. A numerator of zeros is a transfer function of zero.
    ///
    /// # Errors
    /// As [`polynomial_roots`] for the denominator, or a numerator of higher degree.
    pub fn from_coefficients(numerator: &[f64], denominator: &[f64]) -> Result<Self, ModelError> {
        let leading = numerator.iter().take_while(|value| **value == 0.0).count();
        let numerator = &numerator[leading..];
        let (Some(&last), Some(&first)) = (denominator.first(), numerator.first().or(Some(&0.0))) else {
            return Err(ModelError::Coefficient { power: 0, value: 0.0 });
        };
        let (zeros, poles) = (polynomial_roots(numerator)?, polynomial_roots(denominator)?);
        Self::new(&zeros, &poles, first / last)
    }

    /// A vibration with a lead, from its gain `G(0)`, its undamped angular frequency `w` in rad/s, its damping ratio
    /// `z` (above one for two lags) and the time constant `tau` of its zero in s:
    ///
    /// `G(s) = G(0) w^2 (tau s + 1) / (s^2 + 2 z w s + w^2)`
    ///
    /// # Errors
    /// A frequency that is not positive and finite, or another number that is not finite.
    pub fn second_order(
        dc_gain: f64,
        angular_frequency: f64,
        damping_ratio: f64,
        lead: f64,
    ) -> Result<Self, ModelError> {
        let w = angular_frequency;
        if !(w > 0.0 && w.is_finite()) {
            return Err(ModelError::Parameter {
                parameter: "the angular frequency in rad/s",
                range: "positive and finite",
                value: w,
            });
        }
        let poles = quadratic_roots(2.0 * damping_ratio, 1.0).map(|root| root * w);
        if lead == 0.0 {
            Self::new(&[], &poles, dc_gain * w * w)
        } else {
            Self::new(&[Complex::new(-1.0 / lead, 0.0)], &poles, dc_gain * (w * w * lead))
        }
    }

    /// The zeros, rad/s: real ones first, then conjugate pairs.
    #[must_use]
    pub fn zeros(&self) -> &[Complex<f64>] {
        &self.zeros
    }

    /// The poles, rad/s: real ones first, then conjugate pairs.
    #[must_use]
    pub fn poles(&self) -> &[Complex<f64>] {
        &self.poles
    }

    /// The gain `k` of the highest powers.
    #[must_use]
    pub fn gain(&self) -> f64 {
        self.gain
    }

    /// The number of poles `n`.
    #[must_use]
    pub fn order(&self) -> usize {
        self.poles.len()
    }

    /// Whether every pole has a negative real part.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.poles.iter().all(|pole| pole.re < 0.0)
    }

    /// The coefficients of the numerator, highest power first, the gain included.
    #[must_use]
    pub fn numerator(&self) -> Vec<f64> {
        expanded(&self.zeros).into_iter().map(|value| value * self.gain).collect()
    }

    /// The coefficients of the denominator, highest power first, the first of them one.
    #[must_use]
    pub fn denominator(&self) -> Vec<f64> {
        expanded(&self.poles)
    }

    /// `factor G(s)`.
    ///
    /// # Errors
    /// A gain that is not finite.
    pub fn scaled(mut self, factor: f64) -> Result<Self, ModelError> {
        self.gain *= factor;
        if self.gain.is_finite() {
            Ok(self)
        } else {
            Err(ModelError::Parameter { parameter: "the gain", range: "finite", value: self.gain })
        }
    }

    /// One after the other, `G(s) H(s)`. Nothing is cancelled.
    ///
    /// # Errors
    /// A gain that is not finite.
    pub fn in_series(&self, next: &Self) -> Result<Self, ModelError> {
        let both = |a: &[Complex<f64>], b: &[Complex<f64>]| [a, b].concat();
        Self::new(&both(&self.zeros, &next.zeros), &both(&self.poles, &next.poles), self.gain * next.gain)
    }
}

/// Real roots, then pairs made conjugate to the bit.
fn paired(kind: &'static str, roots: &[Complex<f64>]) -> Result<Vec<Complex<f64>>, ModelError> {
    let unpaired = |root: &Complex<f64>| ModelError::Unpaired { kind, re: root.re, im: root.im };
    if let Some(root) = roots.iter().find(|root| !(root.re.is_finite() && root.im.is_finite())) {
        return Err(unpaired(root));
    }
    let mut all: Vec<_> = roots.iter().filter(|root| root.im == 0.0).copied().collect();
    let upper = roots.iter().filter(|root| root.im > 0.0);
    let mut lower: Vec<_> = roots.iter().filter(|root| root.im < 0.0).copied().collect();
    for root in upper {
        let distance = |other: &Complex<f64>| (other.re - root.re).abs() + (other.im + root.im).abs();
        let nearest = (0..lower.len()).min_by(|&i, &j| distance(&lower[i]).total_cmp(&distance(&lower[j])));
        let conjugate = nearest
            .map(|i| lower.swap_remove(i))
            .filter(|other| distance(other) <= CONJUGATE * (root.re.abs() + root.im));
        let Some(conjugate) = conjugate else { return Err(unpaired(root)) };
        let (re, im) = (0.5 * root.re + 0.5 * conjugate.re, 0.5 * root.im - 0.5 * conjugate.im);
        all.extend([Complex::new(re, im), Complex::new(re, -im)]);
    }
    match lower.first() {
        Some(left) => Err(unpaired(left)),
        None => Ok(all),
    }
}

/// The monic polynomial with these roots, factor by real factor, highest power first.
fn expanded(roots: &[Complex<f64>]) -> Vec<f64> {
    let mut all = vec![1.0];
    for root in roots.iter().filter(|root| root.im >= 0.0) {
        let real = root.im == 0.0;
        let (sum, product) =
            if real { (-root.re, 0.0) } else { (-2.0 * root.re, root.re * root.re + root.im * root.im) };
        all.resize(all.len() + if real { 1 } else { 2 }, 0.0);
        for k in (1..all.len()).rev() {
            let second = if k > 1 { product * all[k - 2] } else { 0.0 };
            all[k] += sum * all[k - 1] + second;
        }
    }
    all
}

/// The magnitude of a pole or zero.
fn magnitude(root: &Complex<f64>) -> f64 {
    let (large, small) = (root.re.abs().max(root.im.abs()), root.re.abs().min(root.im.abs()));
    if large > 0.0 { large * Real::sqrt(1.0 + (small / large) * (small / large)) } else { 0.0 }
}
