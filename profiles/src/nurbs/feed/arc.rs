//! Length along a curve and its inverse within a cell.

use super::cell::norm;
use super::path::Cell;
use crate::nurbs::NurbsCurve;

/// Abscissas and weights of Gauss's quadrature with sixteen points, the positive half.
const GAUSS: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_56),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_64),
    (0.458_016_777_657_227_37, 0.169_156_519_395_002_65),
    (0.617_876_244_402_643_8, 0.149_595_988_816_576_7),
    (0.755_404_408_355_003, 0.124_628_971_255_533_71),
    (0.865_631_202_387_831_8, 0.095_158_511_682_492_5),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_456),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_176),
];

/// Newton's steps from a guess that is good to a percent take three; bisection takes over where they would not end.
const MOST_STEPS: u32 = 64;

/// Length of the curve between two parameters of one cell, m.
pub(super) fn arc_length<const D: usize>(curve: &NurbsCurve<D>, from: f64, to: f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let speed = |u: f64| {
        let [_, first] = curve.derivatives::<2>(u);
        norm(&first)
    };
    let sum: f64 = GAUSS.iter().map(|(x, w)| w * (speed(middle - half * x) + speed(middle + half * x))).sum();
    half * sum
}

/// The parameter at the way `s` from the start of the curve, which lies in `cell`.
pub(super) fn parameter_at<const D: usize>(curve: &NurbsCurve<D>, cell: &Cell<D>, s: f64) -> f64 {
    let (length, way) = (cell.end - cell.start, s - cell.start);
    if way <= 0.0 {
        return cell.from;
    }
    if way >= length {
        return cell.to;
    }
    let (mut low, mut high) = (cell.from, cell.to);
    let mut u = low + (high - low) * (way / length);
    let mut done = (cell.from, 0.0);
    let resolution = 2.0 * f64::EPSILON * cell.from.abs().max(cell.to.abs());
    for _ in 0..MOST_STEPS {
        // Short steps are added to what is known.
        let (at, length) = done;
        done = (u, length + arc_length(curve, at, u));
        let miss = done.1 - way;
        if miss.abs() <= 2.0 * f64::EPSILON * (cell.end - cell.start) {
            return u;
        }
        if miss < 0.0 {
            low = u
        } else {
            high = u
        }
        let [_, first] = curve.derivatives::<2>(u);
        let next = u - miss / norm(&first);
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        if (next - u).abs() <= resolution {
            return next;
        }
        u = next;
    }
    u
}
