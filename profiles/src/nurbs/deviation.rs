//! How far two curves are apart at the same parameter.

use alloc::vec::Vec;

use super::bernstein::Bernstein;
use super::bounds::{Halved, Quotient, largest};
use super::piece::Piece;
use super::{Homogeneous, NurbsCurve, NurbsError};
use crate::quantities::Real;

/// Squared deviation of curves of size one that is rounding.
const ROUNDING: f64 = 1e-30;

/// The largest distance of two curves at the same parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Deviation {
    /// No distance is larger, m, to roundings of the size; at most 0.1 % above the largest one or 1e-15 of the size.
    pub bound: f64,
    /// The largest distance found, m.
    pub reached: f64,
    /// The parameter at which it was found.
    pub parameter: f64,
}

impl<const D: usize> NurbsCurve<D> {
    /// The largest distance `|C(u) - C2(u)|` from another curve over the same domain, of any degree and with any knots:
    /// `A v - B w` and `w v` are polynomials, whose Bernstein coefficients bound it.
    ///
    /// It is never below the Hausdorff distance of the two.
    ///
    /// ```
    /// # use profiles::nurbs::NurbsCurve;
    /// let parabola = NurbsCurve::bezier(&[[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]])?;
    /// let line = NurbsCurve::line([0.0, 0.0], [2.0, 0.0])?;
    /// let deviation = parabola.deviation(&line)?;
    /// assert_eq!((deviation.reached, deviation.parameter), (1.0, 0.5));
    /// assert!(deviation.bound >= 1.0 && deviation.bound < 1.001);
    /// # Ok::<(), profiles::nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// Domains that differ by more than 16 roundings.
    pub fn deviation(&self, other: &Self) -> Result<Deviation, NurbsError> {
        let (ours, theirs) = (self.domain(), other.domain());
        let rounding = self.knots().rounding().max(other.knots().rounding());
        for (value, expected) in [(theirs.lower, ours.lower), (theirs.upper, ours.upper)] {
            if (value - expected).abs() > rounding {
                return Err(NurbsError::OtherDomain { value, expected });
            }
        }
        let mut ends: Vec<f64> =
            [self, other].iter().flat_map(|c| c.knots().distinct().map(|(u, _)| u)).collect();
        ends.sort_by(f64::total_cmp);
        let mut deviation = Deviation { bound: 0.0, reached: 0.0, parameter: ours.lower };
        for (from, to) in ends.iter().zip(ends.iter().skip(1)) {
            if to - from < rounding {
                continue;
            }
            let (gap, scale) = Gap::between(self, other, *from, *to);
            let known = deviation.bound / scale;
            let found = largest(gap, ROUNDING.max(known * known), Gap::squared);
            deviation.bound = deviation.bound.max(Real::sqrt(found.bound) * scale);
            let reached = Real::sqrt(found.reached.max(0.0)) * scale;
            if reached > deviation.reached {
                deviation.reached = reached;
                deviation.parameter = from + found.place * (to - from);
            }
        }
        Ok(deviation)
    }
}

/// `A v - B w` and `w v` between two parameters that no knot lies between.
struct Gap<const D: usize> {
    apart: [Bernstein; D],
    weight: Bernstein,
}

impl<const D: usize> Gap<D> {
    /// In units of the returned length.
    fn between(one: &NurbsCurve<D>, other: &NurbsCurve<D>, from: f64, to: f64) -> (Self, f64) {
        let middle = 0.5 * (from + to);
        let (a, b) = (one.span_segment(middle), other.span_segment(middle));
        let origin = a.points.first().map_or([0.0; D], Homogeneous::point);
        let (a, b) = (Piece::new(&a, &origin), Piece::new(&b, &origin));
        let scale = a.scale.max(b.scale);
        let part = |piece: &Piece<D>, polynomial: &Bernstein| {
            let local = |u: f64| ((u - piece.from) / (piece.to - piece.from)).clamped(0.0, 1.0);
            polynomial.part(local(from), local(to))
        };
        let (w, v) = (part(&a, &a.weight), part(&b, &b.weight));
        let apart = core::array::from_fn(|axis| match (a.weighted.get(axis), b.weighted.get(axis)) {
            (Some(x), Some(y)) => {
                let ours = part(&a, x).times(&v).scaled_by(a.scale / scale);
                ours.plus(-b.scale / scale, &part(&b, y).times(&w))
            }
            _ => Bernstein::new(core::iter::empty()),
        });
        (Self { apart, weight: w.times(&v) }, scale)
    }

    fn squared(&self) -> Quotient {
        let above = Bernstein::sum(self.apart.iter().map(Bernstein::squared));
        Quotient::new(above, self.weight.squared())
    }
}

impl<const D: usize> Halved for Gap<D> {
    fn halves(&self) -> [Self; 2] {
        [false, true].map(|upper| {
            let of = |polynomial: &Bernstein| polynomial.half(upper);
            Self { apart: self.apart.each_ref().map(of), weight: of(&self.weight) }
        })
    }
}
