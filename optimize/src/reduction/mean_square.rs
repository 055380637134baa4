//! Least squares in homogeneous coordinates.

use profiles::nurbs::Homogeneous;

use super::problem::{Problem, Sample};
use super::system::{Curvature, System, stepped};

/// The control points of the least mean square distance from there, with the ends tied: over the parameter, of
/// `(x w, y w, ..., w)` where weights are free, else of the points `(x, y, ...)`.
///
/// Exact for polynomials: the quadrature has one node per span more than the degree of the curve.
pub(super) fn mean_square<const D: usize>(
    problem: &Problem<D>,
    mut points: Vec<Homogeneous<D>>,
    weights_free: bool,
) -> Vec<Homogeneous<D>> {
    let mut system = System::new(problem);
    let nodes = gauss(problem.curve.degree() + 1);
    let mut samples: Vec<(Sample<D>, f64)> = Vec::new();
    for (from, to) in problem.spans() {
        for (t, share) in &nodes {
            samples
                .push((problem.sample(0.5 * (from + to) + 0.5 * (to - from) * t), 0.5 * (to - from) * share));
        }
    }
    let identity = |factor: f64, weights: f64| {
        let mut points = [[0.0; D]; D];
        points.iter_mut().enumerate().for_each(|(row, entries)| entries[row] = factor);
        Curvature { points, mixed: [0.0; D], weights }
    };
    for (sample, share) in &samples {
        let weight = sample.homogeneous(&points).weight;
        let factor = if weights_free { *share } else { share / (weight * weight) };
        system.add(sample, &identity(factor, if weights_free { factor } else { 0.0 }));
    }
    system.tie();
    let pinned = pinned(problem, weights_free);
    pinned.iter().for_each(|index| system.add_diagonal(*index, D, 1e30));
    system.factor();
    // Twice: the second solution takes away what roundings of the first have left.
    for _ in 0..2 {
        let mut right = system.right();
        for (sample, share) in &samples {
            let now = sample.homogeneous(&points);
            let own = if weights_free { sample.weight } else { now.weight };
            let factor = if weights_free { *share } else { share / (now.weight * now.weight) };
            let mut weighted = sample.point;
            weighted.iter_mut().zip(&now.weighted).for_each(|(c, n)| *c = factor * (*c * own - n));
            let weight = if weights_free { factor * (own - now.weight) } else { 0.0 };
            system.add_right(&mut right, sample, &Homogeneous { weighted, weight });
        }
        system.tie_right(&mut right);
        pinned.iter().for_each(|index| right[system.unknown(*index, D)] = 0.0);
        system.solve(&mut right);
        points = stepped(&points, &system.step(&right), 1.0);
    }
    points
}

/// The control points whose weights are unknowns of the system and stay where they are.
fn pinned<const D: usize>(problem: &Problem<D>, weights_free: bool) -> Vec<usize> {
    let last = problem.knots.points() - 1;
    match (problem.weights_free, weights_free, problem.last_weight) {
        (true, false, _) => (0..=last).collect(),
        (true, true, Some(_)) => vec![0, last],
        _ => Vec::new(),
    }
}

/// Nodes and weights of the Gauss-Legendre quadrature over `[-1, 1]`.
fn gauss(count: usize) -> Vec<(f64, f64)> {
    use profiles::Real;
    let n = count as f64;
    let node = |k: usize| {
        let mut x = Real::cos(std::f64::consts::PI * (k as f64 + 0.75) / (n + 0.5));
        let mut slope = 1.0;
        // Newton's method from this guess has converged after four steps, whatever the count.
        for _ in 0..6 {
            let (mut before, mut value) = (1.0, x);
            for m in 2..=count {
                let m = m as f64;
                (before, value) = (value, ((2.0 * m - 1.0) * x * value - (m - 1.0) * before) / m);
            }
            slope = n * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(node).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quadrature_is_exact_for_polynomials() {
        for count in 2..17 {
            let nodes = gauss(count);
            for power in 0..2 * count {
                let sum: f64 = nodes.iter().map(|(x, w)| w * x.powi(power as i32)).sum();
                let exact = if power % 2 == 0 { 2.0 / (power as f64 + 1.0) } else { 0.0 };
                assert!((sum - exact).abs() < 1e-14, "{count} {power}: {sum}");
            }
        }
    }
}
