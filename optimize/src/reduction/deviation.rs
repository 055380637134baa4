//! How far apart two curves are, with a bound that holds between all samples.

use profiles::nurbs::{BezierSegment, Homogeneous, NurbsCurve};

use super::error::ReductionError;
use super::pieces::{pieces, split};

/// Bound and attained value are brought as close as this.
const CLOSE: f64 = 1e-6;

/// Halvings of a piece: 2^-50 of it is a rounding of the parameter.
const HALVINGS: usize = 50;

/// The largest distance of two curves at equal parameters, in the unit of their coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// No parameter has a larger one: a bound by control points, roundings included.
    pub at_most: f64,
    /// The distance at [`Deviation::at`]; within a millionth of the bound, but for roundings.
    pub attained: f64,
    /// Where it occurs.
    pub at: f64,
}

/// The largest distance `max |a(u) - b(u)|` of two curves over the same interval of the parameter.
///
/// Between two neighbouring knots of either curve the difference of `A / w` and `B / v` is the rational polynomial
/// `(A v - B w) / (w v)` of the sum of both degrees, whose Bernstein coefficients `e_i` and `d_i > 0` bound it by
/// `max |e_i| / d_i`. Pieces are halved until no bound is more than a millionth above the largest distance met.
///
/// ```
/// use optimize::reduction::deviation;
/// use profiles::nurbs::NurbsCurve;
///
/// // The parabola y = x (1 - x) and its chord.
/// let parabola = NurbsCurve::bezier(&[[0.0, 0.0], [0.5, 0.5], [1.0, 0.0]])?;
/// let chord = NurbsCurve::bezier(&[[0.0, 0.0], [1.0, 0.0]])?;
/// let deviation = deviation(&parabola, &chord)?;
/// assert!(deviation.at_most >= 0.25 && deviation.at_most < 0.25 + 1e-6);
/// assert!((deviation.at - 0.5).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Curves over different intervals.
///
/// # References
/// G. Farin, "Curves and surfaces for CAGD", 5th ed., Morgan Kaufmann, 2002,
/// <https://doi.org/10.1016/B978-1-55860-737-8.X5000-5>: products of Bernstein polynomials, subdivision.
pub fn deviation<const D: usize>(a: &NurbsCurve<D>, b: &NurbsCurve<D>) -> Result<Deviation, ReductionError> {
    Ok(Difference::new(a, b)?.largest())
}

/// The difference of two curves, piece by piece, as control points that lie one after the other.
pub(super) struct Difference<const D: usize> {
    /// Start and end of each piece.
    spans: Vec<(f64, f64)>,
    points: Vec<Homogeneous<D>>,
    /// Control points of a piece.
    count: usize,
    /// What roundings may have added, in the unit of the curves.
    rounding: f64,
}

impl<const D: usize> Difference<D> {
    pub(super) fn new(a: &NurbsCurve<D>, b: &NurbsCurve<D>) -> Result<Self, ReductionError> {
        check_domain(a, b.domain())?;
        let (left, right) = (pieces(a, b), pieces(b, a));
        let products = products(a.degree(), b.degree());
        let count = a.degree() + b.degree() + 1;
        let mut points = Vec::with_capacity(left.len() * count);
        for (left, right) in left.iter().zip(&right) {
            difference(&products, left, right, &mut points);
        }
        let largest = |curve: &NurbsCurve<D>| {
            curve.control_points().flatten().fold(0.0, |most: f64, x| most.max(x.abs()))
        };
        // A rounding for each of the convex combinations, products and sums that a coefficient comes from.
        let rounding = 8.0 * (count + 1) as f64 * f64::EPSILON * largest(a).max(largest(b));
        let spans = left.iter().map(|piece| (piece.from, piece.to)).collect();
        Ok(Self { spans, points, count, rounding })
    }

    /// The largest distance of all pieces.
    pub(super) fn largest(mut self) -> Deviation {
        let first = self.spans.first().map_or(0.0, |span| span.0);
        let mut found = Deviation { at_most: 0.0, attained: 0.0, at: first };
        for _ in 0..HALVINGS {
            self.meet_ends(&mut found);
            let enough = found.attained * (1.0 + CLOSE) + self.rounding;
            let (mut spans, mut points) = (Vec::new(), Vec::new());
            for (span, piece) in self.spans.iter().zip(self.points.chunks_exact(self.count)) {
                let bound = piece.iter().map(distance).fold(0.0, f64::max);
                if bound <= enough {
                    found.at_most = found.at_most.max(bound);
                } else {
                    let middle = 0.5 * (span.0 + span.1);
                    spans.extend([(span.0, middle), (middle, span.1)]);
                    halve(piece, &mut points);
                }
            }
            (self.spans, self.points) = (spans, points);
            if self.spans.is_empty() {
                break;
            }
        }
        let left = self.points.iter().map(distance).fold(0.0, f64::max);
        let bound = found.at_most.max(left).max(found.attained);
        // Halving costs a rounding of the small difference itself, each time.
        Deviation { at_most: bound * (1.0 + 1e-13) + self.rounding, ..found }
    }

    /// Every piece with the bound of its distance.
    pub(super) fn deviations(&self) -> Vec<((f64, f64), f64)> {
        let piece = |(span, points): (&(f64, f64), &[Homogeneous<D>])| {
            let (spans, points) = (vec![*span], points.to_vec());
            (*span, Self { spans, points, count: self.count, rounding: self.rounding }.largest().at_most)
        };
        self.spans.iter().zip(self.points.chunks_exact(self.count)).map(piece).collect()
    }

    /// Looks at the ends of all pieces.
    fn meet_ends(&self, found: &mut Deviation) {
        for (span, piece) in self.spans.iter().zip(self.points.chunks_exact(self.count)) {
            for (at, point) in [(span.0, piece.first()), (span.1, piece.last())] {
                let attained = point.map_or(0.0, distance);
                if attained > found.attained {
                    (found.attained, found.at) = (attained, at);
                }
            }
        }
    }
}

/// Whether a curve has the interval of the parameter that another has.
pub(super) fn check_domain<const D: usize>(
    curve: &NurbsCurve<D>,
    other: profiles::Interval,
) -> Result<(), ReductionError> {
    let domain = curve.domain();
    // Knots closer than 16 roundings are one.
    let least = 16.0 * f64::EPSILON * domain.magnitude();
    if (domain.lower - other.lower).abs() <= least && (domain.upper - other.upper).abs() <= least {
        return Ok(());
    }
    let (from, to) = (other.lower, other.upper);
    Err(ReductionError::Domain { lower: domain.lower, upper: domain.upper, from, to })
}

/// `products[i][j]`: the share of the product of coefficients `i` and `j` in coefficient `i + j`.
fn products(a: usize, b: usize) -> Vec<Vec<f64>> {
    let binomials = |n: usize| -> Vec<f64> {
        let mut row = vec![1.0];
        for k in 0..n {
            row.push(row[k] * (n - k) as f64 / (k + 1) as f64);
        }
        row
    };
    let (of_a, of_b, of_sum) = (binomials(a), binomials(b), binomials(a + b));
    let share =
        |(i, x): (usize, &f64)| of_b.iter().zip(of_sum.iter().skip(i)).map(|(y, sum)| x * y / sum).collect();
    of_a.iter().enumerate().map(share).collect()
}

/// Appends the Bernstein coefficients of `a - b`.
fn difference<const D: usize>(
    products: &[Vec<f64>],
    a: &BezierSegment<D>,
    b: &BezierSegment<D>,
    into: &mut Vec<Homogeneous<D>>,
) {
    // About a point of the piece, so that nothing large cancels.
    let centre = a.points.first().map_or([0.0; D], Homogeneous::point);
    let about = |h: &Homogeneous<D>| {
        let mut weighted = h.weighted;
        weighted.iter_mut().zip(&centre).for_each(|(x, c)| *x -= c * h.weight);
        Homogeneous { weighted, weight: h.weight }
    };
    let (a, b): (Vec<_>, Vec<_>) =
        (a.points.iter().map(about).collect(), b.points.iter().map(about).collect());
    let start = into.len();
    into.resize(start + a.len() + b.len() - 1, Homogeneous { weighted: [0.0; D], weight: 0.0 });
    for (i, (a, shares)) in a.iter().zip(products).enumerate() {
        for ((b, share), sum) in b.iter().zip(shares).zip(into.iter_mut().skip(start + i)) {
            for ((sum, x), y) in sum.weighted.iter_mut().zip(&a.weighted).zip(&b.weighted) {
                *sum += share * (x * b.weight - y * a.weight);
            }
            sum.weight += share * a.weight * b.weight;
        }
    }
}

/// Appends the control points of both halves of a piece.
fn halve<const D: usize>(piece: &[Homogeneous<D>], into: &mut Vec<Homogeneous<D>>) {
    let start = into.len();
    into.extend_from_slice(piece);
    into.extend_from_slice(piece);
    let (left, right) = into[start..].split_at_mut(piece.len());
    split(left, right, 0.5);
}

/// Length of the point.
fn distance<const D: usize>(h: &Homogeneous<D>) -> f64 {
    // Without hypot: coordinates are at most 1e75, and what underflows is far below a rounding.
    h.weighted.iter().map(|x| x * x).sum::<f64>().sqrt() / h.weight
}
