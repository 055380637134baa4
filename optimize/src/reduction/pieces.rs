//! The polynomial pieces of curves, between the knots of both.

use profiles::nurbs::{BezierSegment, Homogeneous, NurbsCurve};

/// The pieces of `curve` between its own knots and those of `other`, by convex combinations only and in linear time.
pub(super) fn pieces<const D: usize>(curve: &NurbsCurve<D>, other: &NurbsCurve<D>) -> Vec<BezierSegment<D>> {
    let own = curve.knots().distinct().map(|(knot, _)| knot).collect::<Vec<f64>>();
    // A knot that the curve has too, within rounding, is its own.
    let shared = |knot: &f64| {
        let above = own.partition_point(|k| k < knot);
        let near = own.get(above.saturating_sub(1)..own.len().min(above + 1)).unwrap_or_default();
        let least = 16.0 * f64::EPSILON * curve.domain().magnitude();
        near.iter().any(|k| (k - knot).abs() < least)
    };
    let cuts: Vec<f64> =
        other.knots().distinct().map(|(knot, _)| knot).filter(|knot| !shared(knot)).collect();
    let mut left = &cuts[..];
    let mut pieces = Vec::new();
    for segment in segments(curve) {
        let (here, rest) = left.split_at(left.partition_point(|cut| *cut < segment.to));
        left = rest;
        cut(segment, here, &mut pieces);
    }
    pieces
}

/// The pieces between the knots of a curve. Control point `k` of a piece from `a` to `b` is the blossom of the curve at
/// `degree - k` times `a` and `k` times `b`.
fn segments<const D: usize>(curve: &NurbsCurve<D>) -> impl Iterator<Item = BezierSegment<D>> + '_ {
    let degree = curve.degree();
    let knots = curve.knots().as_slice();
    curve.homogeneous_points().windows(degree + 1).enumerate().filter_map(move |(first, acting)| {
        let local = knots.get(first + 1..first + 1 + 2 * degree)?;
        let (from, to) = (*local.get(degree - 1)?, *local.get(degree)?);
        let blossom = |k: usize| blossom(acting, local, (from, to), k);
        // Between copies of a knot there is nothing.
        (to > from).then(|| BezierSegment { from, to, points: (0..=degree).map(blossom).collect() })
    })
}

/// De Boor's scheme with the end of the piece at the last `k` levels and its start before.
fn blossom<const D: usize>(
    acting: &[Homogeneous<D>],
    local: &[f64],
    (from, to): (f64, f64),
    k: usize,
) -> Homogeneous<D> {
    let degree = acting.len() - 1;
    let mut points = acting.to_vec();
    for level in 0..degree {
        let at = if level < degree - k { from } else { to };
        let knots = local.iter().skip(level).zip(local.iter().skip(degree));
        for (index, (low, high)) in knots.enumerate().take(degree - level) {
            points[index] = blended(&points[index], &points[index + 1], (at - low) / (high - low));
        }
    }
    points[0]
}

/// Appends the parts of a piece between cuts: from the middle one on, so that roundings grow with their logarithm.
fn cut<const D: usize>(segment: BezierSegment<D>, cuts: &[f64], into: &mut Vec<BezierSegment<D>>) {
    let (before, rest) = cuts.split_at(cuts.len() / 2);
    let Some((at, after)) = rest.split_first() else {
        into.push(segment);
        return;
    };
    let BezierSegment { from, to, points: mut right } = segment;
    let mut left = right.clone();
    split(&mut left, &mut right, (at - from) / (to - from));
    cut(BezierSegment { from, to: *at, points: left }, before, into);
    cut(BezierSegment { from: *at, to, points: right }, after, into);
}

/// De Casteljau in place: of two copies of a piece, the left one becomes its part before `t`, the right one that after.
pub(super) fn split<const D: usize>(left: &mut [Homogeneous<D>], right: &mut [Homogeneous<D>], t: f64) {
    let count = right.len();
    // The left ends of the levels are the left part, what is left of them is the right part.
    for (level, left) in (1..count).zip(left.iter_mut().skip(1)) {
        for index in 0..count - level {
            right[index] = blended(&right[index], &right[index + 1], t);
        }
        *left = right[0];
    }
}

fn blended<const D: usize>(a: &Homogeneous<D>, b: &Homogeneous<D>, t: f64) -> Homogeneous<D> {
    let mut weighted = a.weighted;
    weighted.iter_mut().zip(&b.weighted).for_each(|(x, y)| *x = (1.0 - t) * *x + t * y);
    Homogeneous { weighted, weight: (1.0 - t) * a.weight + t * b.weight }
}

#[cfg(test)]
mod tests {
    use super::*;
    use profiles::nurbs::Knots;

    #[test]
    fn pieces_are_the_curve() {
        let points: Vec<[f64; 2]> = (0..9).map(|k| [f64::from(k), f64::from(k * k % 5)]).collect();
        let weights: Vec<f64> = (0..9).map(|k| 1.0 + 0.3 * f64::from(k % 4)).collect();
        let knots = Knots::clamped(3, 0.0, &[0.5, 0.5, 0.5, 1.0, 1.0], 2.0).expect("valid");
        let curve = NurbsCurve::with_knots(knots, &points, &weights).expect("valid");
        // Every tenth; 0.5 and 1 but for a rounding.
        let inner: Vec<f64> = (1..20).map(|k| 0.1 * f64::from(k)).collect();
        let fine = Knots::clamped(1, 0.0, &inner, 2.0).expect("valid");
        let other = NurbsCurve::with_knots(fine, &[[0.0; 2]; 21], &[1.0; 21]).expect("valid");
        let pieces = pieces(&curve, &other);
        assert_eq!(pieces.len(), 20);
        for (index, piece) in (0..).zip(&pieces) {
            assert!((piece.from - 0.1 * f64::from(index)).abs() < 1e-15);
            let knots = Knots::bezier(3, piece.from, piece.to).expect("valid");
            let own = NurbsCurve::from_homogeneous(knots, piece.points.clone()).expect("valid");
            for part in [0.0, 0.3, 0.9] {
                let u = piece.from + part * (piece.to - piece.from);
                let (p, q) = (own.point(u), curve.point(u));
                // Roundings of coordinates up to 8.
                assert!((p[0] - q[0]).hypot(p[1] - q[1]) < 2e-14, "{u}: {p:?} {q:?}");
            }
        }
    }
}
