//! What no choice of control points and weights can fall below.

use profiles::nurbs::Homogeneous;

use super::minimax::Centre;
use super::problem::{Problem, Sample, dot, norm};
use super::system::{Curvature, System};

/// A lower bound of the largest distance over all control points that are tied in the same way and all weights inside
/// their bounds, from the multipliers of a central point.
///
/// If `|C W - N| <= t W` at all samples, then `sum y (C W - N) <= t sum |y| W` for any vectors `y`. With those that are
/// orthogonal to every free control point both sides are linear in the weights, and the least of their difference over
/// the box of the weights is above zero for every `t` below the bound.
///
/// # References
/// S. Boyd, L. Vandenberghe, "Convex optimization", Cambridge University Press, 2004, section 5.8,
/// <https://doi.org/10.1017/CBO9780511804441>: theorems of alternatives.
pub(super) fn lower_bound<const D: usize>(
    problem: &Problem<D>,
    samples: &[Sample<D>],
    centre: &Centre<D>,
) -> f64 {
    let multipliers = orthogonal(problem, samples, multipliers(samples, centre));
    let count = problem.knots.points();
    // Of X and w of every control point: sum N y, sum N y C and sum N |y|.
    let mut sums = vec![([0.0; D], 0.0, 0.0); count];
    for (sample, y) in samples.iter().zip(&multipliers) {
        let (inward, size) = (dot(y, &sample.point), norm(y));
        for (basis, (vector, point, length)) in sample.basis().iter().zip(sums.iter_mut().skip(sample.first))
        {
            vector.iter_mut().zip(y).for_each(|(sum, y)| *sum += basis * y);
            *point += basis * inward;
            *length += basis * size;
        }
    }
    let (least, most) = problem.weight_range;
    let violation = |t: f64| -> f64 {
        let terms =
            sums.iter().zip(&centre.points).enumerate().map(|(index, ((vector, point, length), at))| {
                let tied = problem.tied.iter().find(|tied| tied.index == index);
                // The part of a point that goes with its weight; free directions are orthogonal to all multipliers.
                let through = tied.map_or([0.0; D], |tied| tied.from);
                let slope = point - dot(&through, vector) - t * length;
                let free = problem.weights_free && tied.is_none_or(|tied| tied.through.is_some());
                if free { (least * slope).min(most * slope) } else { at.weight * slope }
            });
        terms.sum()
    };
    let (mut low, mut high) = (0.0, centre.level);
    if !(violation(low) > 0.0) {
        return 0.0;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if violation(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    // Sums of so many terms, each as large as the curve.
    (low - 1e-13).max(0.0)
}

/// The multipliers of the samples, up to a common factor.
fn multipliers<const D: usize>(samples: &[Sample<D>], centre: &Centre<D>) -> Vec<[f64; D]> {
    let multiplier = |sample: &Sample<D>| {
        let (residual, weight) = sample.residual(&centre.points);
        let radius = centre.level * weight;
        let size = norm(&residual);
        let slack = (radius - size) * (radius + size);
        residual.map(|r| r / slack)
    };
    samples.iter().map(multiplier).collect()
}

/// Takes from the multipliers what is not orthogonal to a free control point, most where they are large.
fn orthogonal<const D: usize>(
    problem: &Problem<D>,
    samples: &[Sample<D>],
    mut multipliers: Vec<[f64; D]>,
) -> Vec<[f64; D]> {
    let mut system = System::new(problem);
    let most = multipliers.iter().map(norm).fold(0.0, f64::max);
    let share = |y: &[f64; D]| norm(y) / most + 1e-9;
    for (sample, y) in samples.iter().zip(&multipliers) {
        let mut points = [[0.0; D]; D];
        points.iter_mut().enumerate().for_each(|(row, entries)| entries[row] = share(y));
        system.add(sample, &Curvature { points, mixed: [0.0; D], weights: 1e-9 });
    }
    system.tie();
    if problem.weights_free {
        (0..problem.knots.points()).for_each(|index| system.add_diagonal(index, D, 1e30));
    }
    system.factor();
    let shares: Vec<f64> = multipliers.iter().map(share).collect();
    for _ in 0..2 {
        let mut right = system.right();
        for (sample, y) in samples.iter().zip(&multipliers) {
            system.add_right(&mut right, sample, &Homogeneous { weighted: *y, weight: 0.0 });
        }
        system.tie_right(&mut right);
        system.solve(&mut right);
        let steps = system.step(&right);
        for ((sample, y), share) in samples.iter().zip(&mut multipliers).zip(&shares) {
            let excess = sample.homogeneous(&steps).weighted;
            y.iter_mut().zip(&excess).for_each(|(y, x)| *y -= share * x);
        }
    }
    multipliers
}
