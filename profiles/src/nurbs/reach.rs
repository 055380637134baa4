//! How far into the complex plane the speed of a curve stays what it is: the error of a quadrature rule.

use super::geometry::distance;
use super::{MAX_DEGREE, NurbsCurve, Side, gauss};
use crate::quantities::Real;

/// Radii in half lengths of a piece that are tried, the largest first.
const RADII: [f64; 8] = [12.0, 8.0, 5.6, 4.0, 2.8, 2.0, 1.6, 1.3];

/// Coefficients of products of two polynomials of the highest degree.
const PRODUCT: usize = 2 * MAX_DEGREE;

/// What is known of the length of a piece.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach {
    /// A bound of the error of [`gauss::sixteen`], cut to `most`, over any part that begins where the piece does, m.
    pub(super) error: f64,
    /// A bound of the length itself, m.
    pub(super) most: f64,
}

impl Reach {
    /// For the part between two parameters of one span.
    ///
    /// About the middle, in half lengths, `|dC/ds| = sqrt(G) / w^2` with `G = H . H`, `H = A' w - A w'`. In a disc in which
    /// the higher terms of `G` and of `w` stay below the constant ones the root is analytic and at most
    /// `M = sqrt(G_0 + rest) / (w_0 - rest)^2`; with the ellipse of foci -1 and 1 inside that disc, whose semi-axes add up
    /// to `r`, a rule of `n` nodes is off by `64/15 M r^(2 - 2n) / (r^2 - 1)` at most. About the middle of a part of the
    /// piece the disc is larger in half lengths of that part, and `M` is the same.
    pub(super) fn new<const D: usize>(curve: &NurbsCurve<D>, from: f64, to: f64) -> Self {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let series = curve.homogeneous_derivatives::<{ MAX_DEGREE + 1 }>(middle, Side::After);
        let origin = series.first().map_or([0.0; D], |h| h.point());
        let count = curve.degree() + 1;
        // Taylor coefficients about the middle, moved to the origin: differences do not cancel.
        let mut weight = [0.0; MAX_DEGREE + 1];
        let mut moved = [[0.0; MAX_DEGREE + 1]; D];
        let mut factor = 1.0;
        for (k, h) in series.iter().enumerate().take(count) {
            if let Some(w) = weight.get_mut(k) {
                *w = h.weight * factor;
            }
            for ((row, x), o) in moved.iter_mut().zip(h.weighted).zip(origin) {
                if let Some(entry) = row.get_mut(k) {
                    *entry = (x - o * h.weight) * factor;
                }
            }
            factor *= half / (k + 1) as f64;
        }
        let mut square = [0.0; 2 * PRODUCT];
        let mut steep = [0.0; PRODUCT];
        for row in &moved {
            let hodograph = wronskian(row, &weight, count);
            let known = hodograph.get(..2 * count - 3).unwrap_or(&hodograph);
            for (k, a) in known.iter().enumerate() {
                square.iter_mut().skip(k).zip(known).for_each(|(sum, b)| *sum += a * b);
            }
            steep.iter_mut().zip(known).for_each(|(sum, h)| *sum += h.abs());
        }
        let square = square.get(..4 * count - 7).unwrap_or(&square);
        let weight = weight.get(..count).unwrap_or(&weight);
        let most = {
            let (constant, rest) = tail(weight, 1.0);
            let by_series = 2.0 * steep.iter().sum::<f64>() / ((constant - rest) * (constant - rest));
            let by_points = polygon(curve, middle);
            if constant > rest && by_series < by_points { by_series } else { by_points }
        };
        let mut error = most;
        for radius in RADII {
            let (speed, speed_rest) = tail(square, radius);
            let (constant, rest) = tail(weight, radius);
            if speed_rest < 0.9 * speed && rest < 0.9 * constant {
                let bound = Real::sqrt(speed + speed_rest) / ((constant - rest) * (constant - rest));
                let axes = radius + Real::sqrt(radius * radius - 1.0);
                let shrink = libm::pow(axes, 2.0 - 2.0 * gauss::NODES as f64) / (axes * axes - 1.0);
                let by_rule = 64.0 / 15.0 * bound * shrink;
                error = if by_rule < error { by_rule } else { error };
                break;
            }
        }
        Self { error, most }
    }
}

/// `x' w - x w'` of two polynomials with `count` coefficients.
fn wronskian(x: &[f64; MAX_DEGREE + 1], w: &[f64; MAX_DEGREE + 1], count: usize) -> [f64; PRODUCT] {
    let mut product = [0.0; PRODUCT];
    for (i, a) in x.iter().enumerate().take(count) {
        for (j, b) in w.iter().enumerate().take(count) {
            // (i - j) a b s^(i + j - 1); the largest power cancels.
            if let Some(entry) = (i + j).checked_sub(1).and_then(|k| product.get_mut(k)) {
                *entry += (i as f64 - j as f64) * a * b;
            }
        }
    }
    product
}

/// The constant term, and the most that the other ones add up to in a disc.
fn tail(coefficients: &[f64], radius: f64) -> (f64, f64) {
    let mut power = 1.0;
    let mut rest = 0.0;
    for coefficient in coefficients.iter().skip(1) {
        power *= radius;
        rest += coefficient.abs() * power;
    }
    (coefficients.first().copied().unwrap_or(0.0), rest)
}

/// The length of the control polygon of the span.
fn polygon<const D: usize>(curve: &NurbsCurve<D>, u: f64) -> f64 {
    let (points, _) = curve.acting(u, Side::After);
    points.iter().zip(points.iter().skip(1)).map(|(a, b)| distance(&a.point(), &b.point())).sum()
}
