//! Three phases, two fixed axes, and two axes that turn with the rotor.
//!
//! All transforms are amplitude-invariant: a balanced set of phase amplitude `A` is a vector of length `A`. The alpha axis
//! lies on phase a, beta leads it by 90 degrees electrical; b follows a and c follows b in the positive sense of rotation.
//! The electrical angle is measured from the axis of phase a to the d axis, which lies on the flux of the rotor; the q axis
//! leads it by 90 degrees electrical. A result is finite where the inputs are ordinary numbers, and not where one of them is not.

use profiles::Real;

/// Three phase quantities, V or A.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Phases<F = f64> {
    /// Phase a.
    pub a: F,
    /// Phase b, a third of a turn after a.
    pub b: F,
    /// Phase c, a third of a turn after b.
    pub c: F,
}

/// A vector in the axes of the stator, V or A.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AlphaBeta<F = f64> {
    /// Along the axis of phase a.
    pub alpha: F,
    /// 90 degrees electrical ahead.
    pub beta: F,
}

/// A vector in the axes of the rotor, V or A.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dq<F = f64> {
    /// Along the flux of the rotor.
    pub d: F,
    /// 90 degrees electrical ahead: the axis of the torque.
    pub q: F,
}

/// Where the rotor stands: sine and cosine of the electrical angle, computed once for all transforms of a tick.
///
/// ```
/// use control::{Dq, Phases, Rotation};
///
/// let rotor = Rotation::<f64>::by(0.7); // rad, electrical
/// let current = Phases { a: 1.0, b: -3.0, c: 2.0 }.to_dq(rotor); // A
/// let back = current.to_phases(rotor);
/// assert!((back.a - 1.0).abs() + (back.b + 3.0).abs() + (back.c - 2.0).abs() < 1e-14);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rotation<F = f64> {
    sin: F,
    cos: F,
}

impl<F: Real> Rotation<F> {
    /// The rotor at an electrical `angle` in rad.
    #[inline]
    #[must_use]
    pub fn by(angle: F) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { sin, cos }
    }

    /// The rotor at the angle with this sine and cosine, as a resolver or a table gives them; they are not normalised.
    #[inline]
    #[must_use]
    pub fn from_sin_cos(sin: F, cos: F) -> Self {
        Self { sin, cos }
    }

    /// Sine of the electrical angle.
    #[inline]
    #[must_use]
    pub fn sin(&self) -> F {
        self.sin
    }

    /// Cosine of the electrical angle.
    #[inline]
    #[must_use]
    pub fn cos(&self) -> F {
        self.cos
    }

    /// Whether sine and cosine are those of an angle, give or take what a resolver or a table may be off by.
    #[inline]
    pub(crate) fn is_turn(&self) -> bool {
        let squared = self.sin * self.sin + self.cos * self.cos;
        squared >= F::HALF && squared <= F::from_f64(2.0)
    }
}

/// The rotor on the axis of phase a.
impl<F: Real> Default for Rotation<F> {
    fn default() -> Self {
        Self { sin: F::ZERO, cos: F::ONE }
    }
}

impl<F: Real> Phases<F> {
    /// Clarke transform: `alpha = (2 a - b - c) / 3`, `beta = (b - c) / sqrt 3`.
    ///
    /// The zero sequence `(a + b + c) / 3` is dropped: it makes no field and, without a neutral wire, no current.
    #[inline]
    #[must_use]
    pub fn to_alpha_beta(self) -> AlphaBeta<F> {
        AlphaBeta {
            alpha: F::from_f64(1.0 / 3.0) * ((self.a - self.b) + (self.a - self.c)),
            beta: F::from_f64(INVERSE_SQRT_3) * (self.b - self.c),
        }
    }

    /// Clarke and Park transform in one.
    #[inline]
    #[must_use]
    pub fn to_dq(self, rotor: Rotation<F>) -> Dq<F> {
        self.to_alpha_beta().to_dq(rotor)
    }
}

impl<F: Real> AlphaBeta<F> {
    /// Inverse Clarke transform: `a = alpha`, `b = (-alpha + sqrt 3 beta) / 2`, `c = (-alpha - sqrt 3 beta) / 2`; their sum
    /// is zero.
    #[inline]
    #[must_use]
    pub fn to_phases(self) -> Phases<F> {
        let (along, across) = (F::HALF * self.alpha, F::from_f64(HALF_SQRT_3) * self.beta);
        Phases { a: self.alpha, b: across - along, c: -across - along }
    }

    /// Park transform: `d = alpha cos + beta sin`, `q = beta cos - alpha sin`.
    #[inline]
    #[must_use]
    pub fn to_dq(self, rotor: Rotation<F>) -> Dq<F> {
        let Rotation { sin, cos } = rotor;
        Dq { d: self.alpha * cos + self.beta * sin, q: self.beta * cos - self.alpha * sin }
    }
}

impl<F: Real> Dq<F> {
    /// Inverse Park transform: `alpha = d cos - q sin`, `beta = d sin + q cos`.
    #[inline]
    #[must_use]
    pub fn to_alpha_beta(self, rotor: Rotation<F>) -> AlphaBeta<F> {
        let Rotation { sin, cos } = rotor;
        AlphaBeta { alpha: self.d * cos - self.q * sin, beta: self.d * sin + self.q * cos }
    }

    /// Inverse Park and inverse Clarke transform in one.
    #[inline]
    #[must_use]
    pub fn to_phases(self, rotor: Rotation<F>) -> Phases<F> {
        self.to_alpha_beta(rotor).to_phases()
    }

    #[inline]
    pub(crate) fn is_finite(&self) -> bool {
        self.d.is_finite() & self.q.is_finite()
    }
}

/// `1 / sqrt 3`.
const INVERSE_SQRT_3: f64 = 0.577_350_269_189_625_8;
/// `sqrt 3 / 2`.
const HALF_SQRT_3: f64 = 0.866_025_403_784_438_6;
