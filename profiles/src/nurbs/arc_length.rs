//! Arc length with a bound of its error, and the parameter at an arc length.

use alloc::vec::Vec;

use super::gauss::Series;
use super::geometry::{distance, norm};
use super::reach::Reach;
use super::{NurbsCurve, NurbsError, Side, gauss};
use crate::quantities::Real;

/// Steps of Newton's method, halved intervals included: these leave nothing of any interval.
const MOST_STEPS: u32 = 100;

/// A curve with a table of its arc length.
///
/// The speed `|dC/du|` is integrated over pieces by 16 Gauss-Legendre nodes. A piece is small enough when the bound of the
/// error that holds in the complex neighbourhood of the piece is: no difference of two estimates, which can both be wrong.
///
/// ```
/// use profiles::nurbs::{ArcLength, NurbsCurve};
///
/// let circle = NurbsCurve::<2>::circle([0.0, 0.0], 2.0)?;
/// let path = ArcLength::new(circle, 1e-12)?;
/// assert!((path.length() - 4.0 * std::f64::consts::PI).abs() <= path.error_bound());
/// assert!(path.error_bound() < 1e-12);
/// // a fifth of the way is a fifth of the turn
/// let [x, y] = path.curve().point(path.parameter_at(0.2 * path.length()));
/// assert!((y.atan2(x) - 0.4 * std::f64::consts::PI).abs() < 1e-14);
/// # Ok::<(), profiles::nurbs::NurbsError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ArcLength<const D: usize> {
    curve: NurbsCurve<D>,
    pieces: Vec<Piece>,
    length: f64,
    error_bound: f64,
}

/// A part of the domain over which the rule is accurate.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    from: f64,
    to: f64,
    /// Length before it, and its own, m.
    before: f64,
    length: f64,
    /// The speed over it, from -1 to 1.
    speed: Series,
}

impl<const D: usize> ArcLength<D> {
    /// The table for a curve; the error of any length between two parameters will be below `tolerance`, m, as far as
    /// rounding allows, and below [`error_bound`](Self::error_bound) for certain.
    ///
    /// # Errors
    /// A tolerance that is not positive.
    ///
    /// # References
    /// L. N. Trefethen, Is Gauss quadrature better than Clenshaw-Curtis?, SIAM Review 50, 2008,
    /// <https://doi.org/10.1137/060659831>, theorem 4.5
    pub fn new(curve: NurbsCurve<D>, tolerance: f64) -> Result<Self, NurbsError> {
        if tolerance.is_nan() || tolerance <= 0.0 {
            return Err(NurbsError::Tolerance(tolerance));
        }
        let domain = curve.domain();
        let whole = domain.upper - domain.lower;
        let narrow = 4.0 * curve.knots().rounding();
        let ends: Vec<f64> = curve.knots().distinct().map(|(knot, _)| knot).collect();
        let mut open: Vec<(f64, f64)> = ends.iter().copied().zip(ends.iter().copied().skip(1)).collect();
        open.reverse();
        let mut table = Self { curve, pieces: Vec::new(), length: 0.0, error_bound: 0.0 };
        while let Some((from, to)) = open.pop() {
            let reach = Reach::new(&table.curve, from, to);
            let middle = 0.5 * (from + to);
            let share = tolerance * ((to - from) / whole);
            let closed = to - from <= narrow || middle <= from || middle >= to;
            // What rounding moves the piece by need not be halved: nothing would come of it but more pieces.
            if reach.error <= share.max(table.rounding(from, to, reach.most)) || closed {
                table.push(from, to, reach);
            } else {
                open.push((middle, to));
                open.push((from, middle));
            }
        }
        // The sum of the pieces.
        table.error_bound += 4.0 * f64::EPSILON * table.length;
        Ok(table)
    }

    fn push(&mut self, from: f64, to: f64, reach: Reach) {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let speed = Series::new(|x| self.speed(middle + half * x));
        let length = (half * speed.whole()).clamped(0.0, reach.most);
        self.pieces.push(Piece { from, to, before: self.length, length, speed });
        self.length += length;
        self.error_bound += reach.error + self.rounding(from, to, length);
    }

    /// An allowance for the roundings of a piece: all its nodes lie in one span, where derivatives round alike.
    fn rounding(&self, from: f64, to: f64, length: f64) -> f64 {
        let [_, slope, ..] = self.curve.negligible_derivatives(0.5 * (from + to), Side::After);
        slope * (to - from) + 4.0 * f64::EPSILON * length
    }

    /// The curve.
    #[must_use]
    pub fn curve(&self) -> &NurbsCurve<D> {
        &self.curve
    }

    /// Length of the whole curve, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// By so much at most in m a length from here differs from the true one: the bound of the rule's error, and an
    /// allowance for roundings.
    #[must_use]
    pub fn error_bound(&self) -> f64 {
        self.error_bound
    }

    /// Length from the start to the parameter `u`, m; `u` is brought into the domain, NaN is the start.
    #[must_use]
    pub fn length_at(&self, u: f64) -> f64 {
        let u = self.curve.knots().within(u);
        let index = self.pieces.partition_point(|piece| piece.from <= u).saturating_sub(1);
        match self.pieces.get(index) {
            Some(piece) if u >= piece.to => piece.before + piece.length,
            Some(piece) => piece.before + self.until(piece, u),
            None => 0.0,
        }
    }

    /// The parameter at the length `s` from the start, m; `s` is brought into `[0, length]`, NaN is the start.
    #[must_use]
    pub fn parameter_at(&self, s: f64) -> f64 {
        let s = s.clamped(0.0, self.length);
        let index = self.pieces.partition_point(|piece| piece.before <= s).saturating_sub(1);
        match self.pieces.get(index) {
            Some(piece) => self.parameter_in(piece, s - piece.before),
            None => self.curve.domain().lower,
        }
    }

    /// Length from the start of a piece to a parameter in it. A rule that is far off, which a loose tolerance allows, is
    /// held within the piece.
    fn until(&self, piece: &Piece, u: f64) -> f64 {
        gauss::sixteen(piece.from, u, |u| self.speed(u)).clamped(0.0, piece.length)
    }

    /// The parameter `rest` after the start of a piece: Newton's method within a bracket.
    fn parameter_in(&self, piece: &Piece, rest: f64) -> f64 {
        if rest <= 0.0 {
            return piece.from;
        }
        if rest >= piece.length {
            return piece.to;
        }
        let width = piece.to - piece.from;
        let speed = |u| self.speed(u);
        let (mut low, mut high) = (piece.from, piece.to);
        let place = piece.speed.place(rest / piece.length);
        let mut u = (0.5 * (low + high) + 0.5 * width * place).clamped(low, high);
        let mut length = self.until(piece, u);
        for _ in 0..MOST_STEPS {
            let missing = rest - length;
            if missing > 0.0 {
                low = u;
            } else {
                high = u;
            }
            let step = missing / speed(u);
            if step.abs() <= 1e-8 * width {
                // The next step would be the square of this one.
                return (u + step).clamped(low, high);
            }
            let next = if u + step > low && u + step < high { u + step } else { 0.5 * (low + high) };
            if next <= low || next >= high {
                break;
            }
            // A short step is exact to rounding by fewer nodes: the neighbourhood reaches a thousand times further.
            length = if (next - u).abs() <= 1e-3 * width {
                length + gauss::four(u, next, speed)
            } else {
                self.until(piece, next)
            };
            u = next;
        }
        u
    }

    fn speed(&self, u: f64) -> f64 {
        let [_, derivative] = self.curve.derivatives::<2>(u);
        norm(&derivative)
    }
}

impl<const D: usize> NurbsCurve<D> {
    /// Length of the curve and a bound of its error, m.
    ///
    /// # Errors
    /// A tolerance that is not positive.
    pub fn length(&self, tolerance: f64) -> Result<(f64, f64), NurbsError> {
        let table = ArcLength::new(self.clone(), tolerance)?;
        Ok((table.length, table.error_bound))
    }

    /// The sum of the distances between the control points: never below the length, for positive weights.
    #[must_use]
    pub fn polygon_length(&self) -> f64 {
        let points = self.homogeneous_points();
        points.iter().zip(points.iter().skip(1)).map(|(a, b)| distance(&a.point(), &b.point())).sum()
    }
}
