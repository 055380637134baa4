//! Points and derivatives, without allocation.

use super::{Homogeneous, MAX_DEGREE, NurbsCurve, Side};
use crate::quantities::Real;

/// De Boor's scheme: `points` are the control points that act, `knots` the local ones from `points.len() - 1` below the
/// parameter to as many above it.
#[inline(always)]
fn de_boor<const D: usize>(points: &mut [Homogeneous<D>], knots: &[f64], u: f64) -> Homogeneous<D> {
    let degree = points.len().saturating_sub(1);
    for level in 0..degree {
        let (below, above) =
            (knots.get(level..degree).unwrap_or_default(), knots.get(degree..).unwrap_or_default());
        let mut above = above.iter();
        let mut rest = &mut points[..];
        for low in below {
            let (Some(high), [here, tail @ ..]) = (above.next(), rest) else { break };
            if let Some(next) = tail.first() {
                *here = here.blended(next, (u - low) / (high - low));
            }
            rest = tail;
        }
    }
    points.first().copied().unwrap_or(Homogeneous::ZERO)
}

/// Derivatives of the curve in homogeneous coordinates: control points are differenced, `degree` times at most.
#[inline(always)]
fn differentiate<const D: usize, const N: usize>(
    points: &mut [Homogeneous<D>],
    scratch: &mut [Homogeneous<D>],
    knots: &[f64],
    u: f64,
) -> [Homogeneous<D>; N] {
    let degree = points.len().saturating_sub(1);
    let mut derivatives = [Homogeneous::ZERO; N];
    for (order, derivative) in derivatives.iter_mut().enumerate().take(degree + 1) {
        let left = degree - order;
        let local = knots.get(order..2 * degree - order).unwrap_or_default();
        if let (Some(points), Some(scratch)) = (points.get(..=left), scratch.get_mut(..=left)) {
            scratch.copy_from_slice(points);
            *derivative = de_boor(scratch, local, u);
        }
        let mut rest = &mut points[..];
        for (low, high) in local.iter().zip(local.get(left..).unwrap_or_default()) {
            let [here, tail @ ..] = rest else { break };
            if let Some(next) = tail.first() {
                *here = here.difference(next, left as f64 / (high - low));
            }
            rest = tail;
        }
    }
    derivatives
}

/// Derivatives of `A / w` from those of `A` and `w`: `C_k = (A_k - sum over i of (k over i) w_i C_(k-i)) / w`.
#[inline(always)]
fn quotient<const D: usize, const N: usize>(homogeneous: &[Homogeneous<D>; N]) -> [[f64; D]; N] {
    let mut derivatives = [[0.0; D]; N];
    let Some(weight) = homogeneous.first().map(|h| h.weight) else { return derivatives };
    let mut binomials = [0.0; N];
    for (order, h) in homogeneous.iter().enumerate() {
        // One more row of Pascal's triangle.
        let mut before = 1.0;
        for binomial in binomials.iter_mut().take(order + 1).skip(1) {
            before = core::mem::replace(binomial, *binomial + before);
        }
        if let Some(first) = binomials.first_mut() {
            *first = 1.0;
        }
        let mut sum = h.weighted;
        let (known, rest) = derivatives.split_at_mut(order);
        let terms = binomials.iter().zip(homogeneous).skip(1).zip(known.iter().rev());
        for ((binomial, h), derivative) in terms {
            for (sum, x) in sum.iter_mut().zip(derivative) {
                *sum -= binomial * h.weight * x;
            }
        }
        if let Some(derivative) = rest.first_mut() {
            *derivative = sum.map(|x| x / weight);
            if order > 3 {
                // Above this order tiny spans and weights can leave the range.
                *derivative = derivative.map(|x| x.clamped(-f64::MAX, f64::MAX));
            }
        }
    }
    derivatives
}

/// The same by constant sizes, so that the loops unroll; `K` is twice the degree `M - 1`.
#[inline(always)]
fn point_of<const D: usize, const M: usize, const K: usize>(
    points: &[Homogeneous<D>],
    knots: &[f64],
    u: f64,
) -> Option<Homogeneous<D>> {
    let mut points = <[Homogeneous<D>; M]>::try_from(points).ok()?;
    Some(de_boor(&mut points, <&[f64; K]>::try_from(knots).ok()?, u))
}

/// The same by constant sizes, so that the loops unroll; `K` is twice the degree `M - 1`.
#[inline(always)]
fn derivatives_of<const D: usize, const N: usize, const M: usize, const K: usize>(
    points: &[Homogeneous<D>],
    knots: &[f64],
    u: f64,
) -> Option<[Homogeneous<D>; N]> {
    let mut points = <[Homogeneous<D>; M]>::try_from(points).ok()?;
    let mut scratch = [Homogeneous::ZERO; M];
    Some(differentiate(&mut points, &mut scratch, <&[f64; K]>::try_from(knots).ok()?, u))
}

impl<const D: usize> NurbsCurve<D> {
    /// The point at `u`, which is brought into the domain; the start for NaN. No allocation.
    #[must_use]
    pub fn point(&self, u: f64) -> [f64; D] {
        self.homogeneous(u, Side::After).point()
    }

    /// The first `N` derivatives at `u`, beginning with the point itself: entry `k` is `d^k C / du^k`. No allocation.
    ///
    /// `u` is brought into the domain; NaN is the start. Where a derivative jumps it is the one just after `u`, at the
    /// end of the curve the one just before. Orders of four and above are cut to the range of double precision.
    ///
    /// ```
    /// # use profiles::nurbs::NurbsCurve;
    /// let parabola = NurbsCurve::bezier(&[[0.0, 0.0], [1.0, 0.0], [2.0, 4.0]])?;
    /// let [point, first, second] = parabola.derivatives(0.5);
    /// assert_eq!((point, first, second), ([1.0, 1.0], [2.0, 4.0], [0.0, 8.0]));
    /// # Ok::<(), profiles::nurbs::NurbsError>(())
    /// ```
    #[must_use]
    pub fn derivatives<const N: usize>(&self, u: f64) -> [[f64; D]; N] {
        self.derivatives_from(u, Side::After)
    }

    /// The first `N` derivatives at `u` seen from one side of a knot; otherwise as [`derivatives`](Self::derivatives).
    #[must_use]
    pub fn derivatives_from<const N: usize>(&self, u: f64, side: Side) -> [[f64; D]; N] {
        quotient(&self.homogeneous_derivatives(u, side))
    }

    /// The point at `u` with its weight; `u` is brought into the domain, NaN is the start.
    #[inline]
    #[must_use]
    pub fn homogeneous(&self, u: f64, side: Side) -> Homogeneous<D> {
        let u = self.knots().within(u);
        let (points, knots) = self.acting(u, side);
        let point = match points.len() {
            2 => point_of::<D, 2, 2>(points, knots, u),
            3 => point_of::<D, 3, 4>(points, knots, u),
            4 => point_of::<D, 4, 6>(points, knots, u),
            5 => point_of::<D, 5, 8>(points, knots, u),
            6 => point_of::<D, 6, 10>(points, knots, u),
            _ => None,
        };
        point.unwrap_or_else(|| {
            let mut buffer = [Homogeneous::ZERO; MAX_DEGREE + 1];
            de_boor(copied(&mut buffer, points), knots, u)
        })
    }

    /// The first `N` derivatives of weighted coordinates and weight, which are those of polynomials.
    #[inline]
    #[must_use]
    pub fn homogeneous_derivatives<const N: usize>(&self, u: f64, side: Side) -> [Homogeneous<D>; N] {
        let u = self.knots().within(u);
        let (points, knots) = self.acting(u, side);
        let derivatives = match points.len() {
            2 => derivatives_of::<D, N, 2, 2>(points, knots, u),
            3 => derivatives_of::<D, N, 3, 4>(points, knots, u),
            4 => derivatives_of::<D, N, 4, 6>(points, knots, u),
            5 => derivatives_of::<D, N, 5, 8>(points, knots, u),
            6 => derivatives_of::<D, N, 6, 10>(points, knots, u),
            _ => None,
        };
        derivatives.unwrap_or_else(|| {
            let mut buffer = [Homogeneous::ZERO; MAX_DEGREE + 1];
            let mut scratch = [Homogeneous::ZERO; MAX_DEGREE + 1];
            differentiate(copied(&mut buffer, points), &mut scratch, knots, u)
        })
    }

    /// The control points that act at `u` and the knots that matter there.
    #[inline]
    fn acting(&self, u: f64, side: Side) -> (&[Homogeneous<D>], &[f64]) {
        let first = self.knots().first_acting(u, side);
        let points = self.homogeneous_points().get(first..=first + self.degree()).unwrap_or_default();
        (points, self.knots().local(first))
    }
}

/// `points` at the start of `buffer`, which is long enough for the highest degree.
fn copied<'a, const D: usize>(
    buffer: &'a mut [Homogeneous<D>],
    points: &[Homogeneous<D>],
) -> &'a mut [Homogeneous<D>] {
    let room = points.len().min(buffer.len());
    let (buffer, _) = buffer.split_at_mut(room);
    buffer.iter_mut().zip(points).for_each(|(to, from)| *to = *from);
    buffer
}
