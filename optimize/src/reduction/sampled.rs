//! The largest distance at samples, for many candidates: several samples at a time.

use profiles::nurbs::{Knots, NurbsCurve, Side};

/// Samples that are worked on together.
const LANES: usize = 4;

type Lanes = [f64; LANES];

/// Evenly spaced parameters with the points of a curve.
fn samples<const D: usize>(curve: &NurbsCurve<D>, count: usize) -> Vec<(f64, [f64; D])> {
    let domain = curve.domain();
    let place = |index: usize| {
        let t = index as f64 / (count - 1) as f64;
        let u = domain.lower * (1.0 - t) + domain.upper * t;
        (u, curve.point(u))
    };
    (0..count).map(place).collect()
}

/// The square of the distance of `N / W` from `C`, each in lanes.
#[inline(always)]
fn largest_square<const D: usize>(
    point: &[Lanes; D],
    sums: &[Lanes; D],
    weight: &Lanes,
    largest: &mut Lanes,
) {
    let mut square = [0.0; LANES];
    for (c, n) in point.iter().zip(sums) {
        for lane in 0..LANES {
            let residual = c[lane] * weight[lane] - n[lane];
            square[lane] += residual * residual;
        }
    }
    for lane in 0..LANES {
        let distance = square[lane] / (weight[lane] * weight[lane]);
        // The order of the comparison lets a NaN in, and lets it stay.
        largest[lane] = if distance <= largest[lane] { largest[lane] } else { distance };
    }
}

/// The largest of all lanes; NaN if there is one.
fn over_lanes(largest: Lanes) -> f64 {
    largest.iter().fold(0.0_f64, |most, x| if *x <= most { most } else { *x }).sqrt()
}

/// Samples of a curve and the basis functions of fixed knots there.
#[derive(Debug, Clone)]
pub(super) struct FixedKnots<const D: usize> {
    groups: Vec<Group<D>>,
    /// Of all groups, one after the other.
    basis: Vec<Lanes>,
    order: usize,
}

/// Samples of one span.
#[derive(Debug, Clone)]
struct Group<const D: usize> {
    first: usize,
    point: [Lanes; D],
}

impl<const D: usize> FixedKnots<D> {
    pub(super) fn new(curve: &NurbsCurve<D>, knots: &Knots, count: usize) -> Self {
        let order = knots.degree() + 1;
        let (mut groups, mut basis) = (Vec::new(), Vec::new());
        let all: Vec<_> = samples(curve, count)
            .into_iter()
            .map(|(u, point)| (knots.basis(u, Side::After), point))
            .collect();
        for span in all.chunk_by(|a, b| a.0.first() == b.0.first()) {
            for chunk in span.chunks(LANES) {
                let mut point = [[0.0; LANES]; D];
                let start = basis.len();
                basis.resize(start + order, [0.0; LANES]);
                // A last sample stands for those that are missing.
                let filled = chunk.iter().chain(chunk.last().into_iter().cycle());
                let mut first = 0;
                for (lane, (values, at)) in (0..LANES).zip(filled) {
                    point.iter_mut().zip(at).for_each(|(lanes, x)| lanes[lane] = *x);
                    let entries = basis.iter_mut().skip(start).zip(values.values());
                    entries.for_each(|(lanes, value)| lanes[lane] = *value);
                    first = values.first();
                }
                groups.push(Group { first, point });
            }
        }
        Self { groups, basis, order }
    }

    /// The largest distance from the curve of these control points: weighted coordinates and weight, one after the other.
    pub(super) fn largest(&self, row: &[f64]) -> f64 {
        let mut largest = [0.0; LANES];
        for (group, basis) in self.groups.iter().zip(self.basis.chunks_exact(self.order)) {
            let (mut sums, mut weight) = ([[0.0; LANES]; D], [0.0; LANES]);
            for (point, basis) in row.chunks_exact(D + 1).skip(group.first).zip(basis) {
                let Some((w, coordinates)) = point.split_last() else { continue };
                for (sum, x) in sums.iter_mut().zip(coordinates) {
                    for lane in 0..LANES {
                        sum[lane] += basis[lane] * x;
                    }
                }
                for lane in 0..LANES {
                    weight[lane] += basis[lane] * w;
                }
            }
            largest_square(&group.point, &sums, &weight, &mut largest);
        }
        over_lanes(largest)
    }
}

/// Samples of a curve, for knots that every candidate brings.
#[derive(Debug, Clone)]
pub(super) struct FreeKnots<const D: usize> {
    samples: Vec<(f64, [f64; D])>,
}

impl<const D: usize> FreeKnots<D> {
    pub(super) fn new(curve: &NurbsCurve<D>, count: usize) -> Self {
        Self { samples: samples(curve, count) }
    }

    /// The largest distance from the curve of these control points over these knots, clamped, in order, without repeated
    /// inner ones.
    pub(super) fn largest(&self, degree: usize, knots: &[f64], row: &[f64]) -> f64 {
        let width = D + 1;
        let mut largest = [0.0; LANES];
        let mut left = &self.samples[..];
        let mut powers = vec![0.0; (degree + 1) * width];
        let mut scratch = vec![0.0; (degree + 1) * width];
        for (span, points) in row.windows((degree + 1) * width).step_by(width).enumerate() {
            let Some(local) = knots.get(span + 1..span + 1 + 2 * degree) else { break };
            let (Some(from), Some(to)) = (local.get(degree - 1), local.get(degree)) else { break };
            let last = span + 1 == row.len() / width - degree;
            let inside = if last { left.len() } else { left.partition_point(|(u, _)| u < to) };
            let (here, rest) = left.split_at(inside);
            left = rest;
            if here.is_empty() {
                continue;
            }
            power_form(degree, width, local, points, &mut scratch, &mut powers);
            let rate = 1.0 / (to - from);
            for chunk in here.chunks(LANES) {
                let (mut place, mut point) = ([0.0; LANES], [[0.0; LANES]; D]);
                let filled = chunk.iter().chain(chunk.last().into_iter().cycle());
                for (lane, (u, at)) in (0..LANES).zip(filled) {
                    place[lane] = (u - from) * rate;
                    point.iter_mut().zip(at).for_each(|(lanes, x)| lanes[lane] = *x);
                }
                let (mut sums, mut weight) = ([[0.0; LANES]; D], [0.0; LANES]);
                for coefficients in powers.chunks_exact(width).rev() {
                    let Some((w, coordinates)) = coefficients.split_last() else { continue };
                    for (sum, x) in sums.iter_mut().zip(coordinates) {
                        for lane in 0..LANES {
                            sum[lane] = sum[lane] * place[lane] + x;
                        }
                    }
                    for lane in 0..LANES {
                        weight[lane] = weight[lane] * place[lane] + w;
                    }
                }
                largest_square(&point, &sums, &weight, &mut largest);
            }
        }
        over_lanes(largest)
    }
}

/// The coefficients of `1, t, t^2, ...` of a span, with `t` from 0 to 1 in it, from its control points and the `2 degree`
/// knots around: Bezier points are blossoms at its ends, and the coefficients their differences.
fn power_form(
    degree: usize,
    width: usize,
    local: &[f64],
    points: &[f64],
    scratch: &mut [f64],
    powers: &mut [f64],
) {
    let (from, to) = (local[degree - 1], local[degree]);
    for index in 0..=degree {
        scratch.copy_from_slice(points);
        for level in 0..degree {
            let at = if level < degree - index { from } else { to };
            for k in 0..degree - level {
                let (low, high) = (local[k + level], local[k + degree]);
                let t = (at - low) / (high - low);
                let (here, next) = scratch.split_at_mut((k + 1) * width);
                for (x, y) in here[k * width..].iter_mut().zip(&next[..width]) {
                    *x += t * (y - *x);
                }
            }
        }
        powers[index * width..(index + 1) * width].copy_from_slice(&scratch[..width]);
    }
    // Differences in place, then times the binomials.
    for order in 1..=degree {
        for index in (order..=degree).rev() {
            let (before, here) = powers.split_at_mut(index * width);
            here[..width].iter_mut().zip(&before[(index - 1) * width..]).for_each(|(x, y)| *x -= y);
        }
    }
    let mut binomial = 1.0;
    for (index, coefficients) in powers.chunks_exact_mut(width).enumerate() {
        coefficients.iter_mut().for_each(|x| *x *= binomial);
        binomial *= (degree - index) as f64 / (index + 1) as f64;
    }
}
