//! The point of a curve nearest to another point.

use alloc::vec::Vec;

use super::bernstein::Bernstein;
use super::curve::check_point;
use super::geometry::{distance, dot};
use super::piece::Piece;
use super::{NurbsCurve, NurbsError, Side};
use crate::quantities::Real;

/// Roundings of the coefficients that bound a piece, relative to the largest.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Halvings after which a piece is a point.
const MOST_HALVINGS: u32 = 52;

/// Halvings in all. Only a curve that stays equally far from the target almost to rounding comes near it.
const MOST_WORK: u32 = 65_536;

/// A point of a curve, and how far it is from the one asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest<const D: usize> {
    /// Its parameter.
    pub parameter: f64,
    /// The point, m.
    pub point: [f64; D],
    /// The distance, m.
    pub distance: f64,
}

impl<const D: usize> NurbsCurve<D> {
    /// The point of the whole curve nearest to `target`; the first one found where several are equally near.
    ///
    /// A piece is left out only when the Bernstein coefficients of the squared distance show that all of it is farther
    /// away, and searched by Newton's method only when those of its derivative show that it has one minimum: no nearer
    /// branch is overlooked, unless by roundings of the size of the piece.
    ///
    /// ```
    /// # use profiles::nurbs::NurbsCurve;
    /// let circle = NurbsCurve::<2>::circle([0.0, 0.0], 5.0)?;
    /// let nearest = circle.closest([-6.0, 8.0])?;
    /// assert!((nearest.distance - 5.0).abs() < 1e-14);
    /// assert!((nearest.point[0] + 3.0).abs() < 1e-14 && (nearest.point[1] - 4.0).abs() < 1e-14);
    /// # Ok::<(), profiles::nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// A coordinate of the target that is not finite or beyond 1e75.
    pub fn closest(&self, target: [f64; D]) -> Result<Nearest<D>, NurbsError> {
        check_point(0, &target)?;
        let mut best = self.candidate(self.domain().lower, &target);
        let mut open: Vec<Part<D>> = Vec::new();
        for segment in self.bezier_segments() {
            best = nearer(best, self.candidate(segment.to, &target));
            open.push(Part::new(Piece::new(&segment, &target), 0));
        }
        // The nearest last, so that it is searched first.
        open.sort_by(|a, b| b.bound().total_cmp(&a.bound()));
        let mut work = 0;
        while let Some(part) = open.pop() {
            if part.is_beyond(best.distance) {
                continue;
            }
            match part.minima() {
                Minima::AtAnEnd => {}
                Minima::OneInside => {
                    let u = self.foot(part.piece.from, part.piece.to, &target);
                    best = nearer(best, self.candidate(u, &target));
                }
                Minima::Some if part.halvings < MOST_HALVINGS && work < MOST_WORK => {
                    work += 1;
                    let (left, right) = part.piece.split();
                    best = nearer(best, self.candidate(left.to, &target));
                    let [left, right] = [left, right].map(|piece| Part::new(piece, part.halvings + 1));
                    open.extend(if left.least < right.least { [right, left] } else { [left, right] });
                }
                Minima::Some => {}
            }
        }
        Ok(best)
    }

    fn candidate(&self, u: f64, target: &[f64; D]) -> Nearest<D> {
        let point = self.point(u);
        Nearest { parameter: u, point, distance: distance(&point, target) }
    }

    /// Where `(C - target) . C'` changes from falling to rising between two parameters: Newton's method in a bracket.
    fn foot(&self, from: f64, to: f64, target: &[f64; D]) -> f64 {
        let (mut low, mut high) = (from, to);
        let mut u = 0.5 * (from + to);
        for _ in 0..100 {
            let [point, first, second] = self.derivatives_from::<3>(u, Side::After);
            let mut apart = point;
            apart.iter_mut().zip(target).for_each(|(x, t)| *x -= t);
            let slope = dot(&apart, &first);
            if slope < 0.0 {
                low = u;
            } else {
                high = u;
            }
            let step = -slope / (dot(&first, &first) + dot(&apart, &second));
            if step.abs() <= 0.5 * f64::EPSILON * u.abs() {
                break;
            }
            let next = if u + step > low && u + step < high { u + step } else { 0.5 * (low + high) };
            if next <= low || next >= high {
                break;
            }
            u = next;
        }
        u
    }
}

fn nearer<const D: usize>(a: Nearest<D>, b: Nearest<D>) -> Nearest<D> {
    if b.distance < a.distance { b } else { a }
}

/// What the coefficients of the derivative say about the minima of the distance.
enum Minima {
    AtAnEnd,
    OneInside,
    Some,
}

/// A part of the curve, with the target as origin.
struct Part<const D: usize> {
    piece: Piece<D>,
    /// A bound below the squared distance, and the rounding of it, in units of the piece.
    least: f64,
    rounding: f64,
    halvings: u32,
}

impl<const D: usize> Part<D> {
    fn new(piece: Piece<D>, halvings: u32) -> Self {
        let (above, below) = (piece.squared_distance(), piece.weight.squared());
        let missing = above.degree().saturating_sub(below.degree());
        let below = below.raised(missing);
        let quotients = || above.coefficients().iter().zip(below.coefficients()).map(|(s, w)| s / w);
        let least = quotients().fold(f64::INFINITY, f64::min).max(0.0);
        let rounding = ROUNDING * piece.farthest();
        Self { piece, least, rounding, halvings }
    }

    /// The bound in m.
    fn bound(&self) -> f64 {
        Real::sqrt(self.least) * self.piece.scale
    }

    /// Whether nothing here is nearer than that.
    fn is_beyond(&self, distance: f64) -> bool {
        let known = distance / self.piece.scale;
        self.least >= known * known - self.rounding
    }

    /// By Descartes' rule: a polynomial has at most as many zeros as its coefficients change their sign.
    fn minima(&self) -> Minima {
        // The derivative of the squared distance is 2 B . H / w^3.
        let slope =
            Bernstein::sum(self.piece.weighted.iter().zip(self.piece.hodograph()).map(|(b, h)| b.times(&h)));
        // A coefficient goes with three weights, and so does its rounding: where they are small it is not negligible.
        let weight = &self.piece.weight;
        let light = weight.coefficients().iter().any(|w| *w < 0.5);
        let cubed = light.then(|| weight.squared().times(weight));
        let weights = cubed.iter().flat_map(|cubed| cubed.coefficients().iter().skip(1).copied());
        let sizes = weights.chain(core::iter::repeat(1.0));
        let felt = |(c, size): &(&f64, f64)| c.abs() > self.rounding * size;
        let mut signs = slope.coefficients().iter().zip(sizes).filter(felt).map(|(c, _)| *c > 0.0);
        let Some(first) = signs.next() else { return Minima::AtAnEnd };
        let (changes, _) =
            signs.fold((0, first), |(changes, last), sign| (changes + u32::from(sign != last), sign));
        match changes {
            0 => Minima::AtAnEnd,
            // From rising to falling is a maximum.
            1 if first => Minima::AtAnEnd,
            1 => Minima::OneInside,
            _ => Minima::Some,
        }
    }
}
