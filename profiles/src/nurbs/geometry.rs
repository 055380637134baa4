//! Tangent, curvature and corners: what does not depend on the parameter.

use alloc::vec::Vec;

use super::{MAX_DEGREE, NurbsCurve, Side};
use crate::quantities::Real;

/// A place where the direction of a curve jumps.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Corner {
    /// Its parameter, a knot of the curve.
    pub parameter: f64,
    /// The angle between the directions before and after, rad, up to pi.
    pub angle: f64,
}

impl<const D: usize> NurbsCurve<D> {
    /// The direction in which the curve is run through, of length one, seen from one side; where the first derivative
    /// vanishes the limit from that side. None where the curve stands still for a whole span.
    #[must_use]
    pub fn tangent(&self, u: f64, side: Side) -> Option<[f64; D]> {
        let side = self.inner_side(u, side);
        let derivatives = self.derivatives_from::<{ MAX_DEGREE + 1 }>(u, side);
        let negligible = self.negligible_derivatives(u, side);
        let orders = derivatives.iter().zip(negligible).enumerate().skip(1).take(self.degree());
        for (order, (derivative, negligible)) in orders {
            let length = norm(derivative);
            if length > negligible {
                // Seen from before, an even order points back.
                let sign = if side == Side::Before && order % 2 == 0 { -1.0 } else { 1.0 };
                return Some(derivative.map(|x| sign * x / length));
            }
        }
        None
    }

    /// The curve and its first three derivatives by arc length, `[C, C_s, C_ss, C_sss]` in m, 1, 1/m, 1/m^2, seen from
    /// one side. None where `dC/du` vanishes to rounding, as in a cusp: there they do not exist; and none where they leave
    /// the range of double precision.
    ///
    /// A motion `s(t)` along the curve has the velocity `C_s v`, the acceleration `C_ss v^2 + C_s a` and the jerk
    /// `C_sss v^3 + 3 C_ss v a + C_s j`.
    #[must_use]
    pub fn by_length(&self, u: f64, side: Side) -> Option<[[f64; D]; 4]> {
        let [point, first, second, third] = self.derivatives_from::<4>(u, side);
        let speed = norm(&first);
        if speed <= self.negligible_derivatives(u, side)[1] {
            return None;
        }
        // Derivatives of u by s, from |C'| u_s = 1.
        let along = dot(&first, &second) / (speed * speed);
        let across = (dot(&second, &second) + dot(&first, &third)) / (speed * speed);
        let once = 1.0 / speed;
        let twice = -along * once * once;
        let thrice = (4.0 * along * along - across) * once * once * once;
        let mut derivatives = [point, first, second, third];
        let [_, c_s, c_ss, c_sss] = &mut derivatives;
        for (((x, y), z), ((a, b), c)) in
            c_s.iter_mut().zip(c_ss).zip(c_sss).zip(first.iter().zip(&second).zip(&third))
        {
            *x = a * once;
            *y = b * once * once + a * twice;
            *z = c * once * once * once + 3.0 * b * once * twice + a * thrice;
        }
        Some(derivatives).filter(|all| all.iter().flatten().all(|x| x.is_finite()))
    }

    /// Curvature seen from one side, 1/m, not negative: `|C' x C''| / |C'|^3`. None where `C'` vanishes to rounding.
    #[must_use]
    pub fn curvature(&self, u: f64, side: Side) -> Option<f64> {
        let [_, first, second] = self.derivatives_from::<3>(u, side);
        let speed = norm(&first);
        if speed <= self.negligible_derivatives(u, side)[1] {
            return None;
        }
        // The part of C'' across C', which does not cancel as the difference of squares would.
        let direction = first.map(|x| x / speed);
        let along = dot(&direction, &second);
        let mut across = second;
        across.iter_mut().zip(direction).for_each(|(x, d)| *x -= along * d);
        Some(norm(&across) / speed / speed).filter(|curvature| curvature.is_finite())
    }

    /// The knots at which the direction jumps by more than `angle` in rad, in ascending order.
    ///
    /// Inside a span the direction can only turn back, in a cusp, where [`speed_bounds`](Self::speed_bounds) finds zero.
    #[must_use]
    pub fn corners(&self, angle: f64) -> Vec<Corner> {
        let inner = self.knots().distinct().map(|(knot, _)| knot);
        let count = self.knots().distinct().count();
        inner
            .take(count.saturating_sub(1))
            .skip(1)
            .filter_map(|parameter| {
                let before = self.tangent(parameter, Side::Before)?;
                let after = self.tangent(parameter, Side::After)?;
                Some(Corner { parameter, angle: angle_between(&before, &after) })
            })
            .filter(|corner| corner.angle > angle)
            .collect()
    }

    /// At an end of the curve the side that there is.
    fn inner_side(&self, u: f64, side: Side) -> Side {
        let domain = self.domain();
        match self.knots().within(u) {
            u if u <= domain.lower => Side::After,
            u if u >= domain.upper => Side::Before,
            _ => side,
        }
    }

    /// Up to these magnitudes derivatives of each order are roundings of coordinates and weights of the span.
    pub(super) fn negligible_derivatives(&self, u: f64, side: Side) -> [f64; MAX_DEGREE + 1] {
        let u = self.knots().within(u);
        let (points, knots) = self.acting(u, side);
        let degree = points.len().saturating_sub(1);
        let span = match (knots.get(degree.wrapping_sub(1)), knots.get(degree)) {
            (Some(low), Some(high)) => high - low,
            _ => 1.0,
        };
        let (mut size, mut light, mut heavy) = (0.0_f64, f64::INFINITY, 0.0_f64);
        for h in points {
            size = h.point().iter().fold(size, |most, x| most.max(x.abs()));
            (light, heavy) = (light.min(h.weight), heavy.max(h.weight));
        }
        let mut negligible = [0.0; MAX_DEGREE + 1];
        // Every order divides the differences by a span, and the quotient multiplies by a ratio of weights.
        let mut bound = 16.0 * f64::EPSILON * size;
        for entry in &mut negligible {
            *entry = bound.min(f64::MAX);
            bound *= degree as f64 * (heavy / light) / span;
        }
        negligible
    }
}

impl NurbsCurve<2> {
    /// Curvature with its sign, 1/m, positive where the curve turns left: `(C' x C'') / |C'|^3`. None where `C'` vanishes
    /// to rounding.
    #[must_use]
    pub fn signed_curvature(&self, u: f64, side: Side) -> Option<f64> {
        let magnitude = self.curvature(u, side)?;
        let [_, [ax, ay], [bx, by]] = self.derivatives_from::<3>(u, side);
        Some(magnitude.copysign(ax * by - ay * bx))
    }
}

impl NurbsCurve<3> {
    /// Torsion seen from one side, 1/m: `((C' x C'') . C''') / |C' x C''|^2`, positive for a right-handed helix. None where
    /// the curvature vanishes to rounding, where there is no osculating plane.
    #[must_use]
    pub fn torsion(&self, u: f64, side: Side) -> Option<f64> {
        let [_, first, second, third] = self.derivatives_from::<4>(u, side);
        let (speed, bend) = (norm(&first), norm(&second));
        let negligible = self.negligible_derivatives(u, side);
        let [ax, ay, az] = first;
        let [bx, by, bz] = second;
        let binormal = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
        let area = norm(&binormal);
        if area <= negligible[1] * bend + negligible[2] * speed {
            return None;
        }
        let binormal = binormal.map(|x| x / area);
        Some(dot(&binormal, &third) / area).filter(|torsion| torsion.is_finite())
    }
}

pub(super) fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

pub(super) fn norm<const D: usize>(a: &[f64; D]) -> f64 {
    let square = dot(a, a);
    if square > f64::MIN_POSITIVE && square < f64::MAX {
        return Real::sqrt(square);
    }
    // The square has left the range, the length has not.
    let most = a.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if most > 0.0 { most * Real::sqrt(a.iter().map(|x| (x / most) * (x / most)).sum::<f64>()) } else { 0.0 }
}

pub(super) fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let mut difference = *a;
    difference.iter_mut().zip(b).for_each(|(x, y)| *x -= y);
    norm(&difference)
}

/// The angle between two directions of length one, exact also near zero and near pi.
pub(super) fn angle_between<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let mut sum = *a;
    sum.iter_mut().zip(b).for_each(|(x, y)| *x += y);
    2.0 * Real::atan2(distance(a, b), norm(&sum))
}
