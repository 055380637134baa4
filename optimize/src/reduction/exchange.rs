//! Samples where the distance is largest, and the optimum over all of them.

use profiles::nurbs::Homogeneous;

use super::bound::lower_bound;
use super::minimax::minimax;
use super::problem::{Problem, Sample};

/// Rounds of adding samples; two or three are enough.
const ROUNDS: usize = 8;

/// A peak counts if it is so much above the level of the samples.
const ABOVE: f64 = 2e-4;

/// The control points of the least largest distance over the whole curve, and a bound that no others fall below, both for
/// a curve of size one.
pub(super) fn least_largest<const D: usize>(
    problem: &Problem<D>,
    mut points: Vec<Homogeneous<D>>,
) -> (Vec<Homogeneous<D>>, f64) {
    let grid = grid(problem);
    let mut samples: Vec<Sample<D>> = grid.iter().skip(1).step_by(2).copied().collect();
    samples.extend(peaks(problem, &grid, &points, 0.0));
    let mut bound = 0.0;
    for _ in 0..ROUNDS {
        let centre = minimax(problem, &samples, points);
        bound = lower_bound(problem, &samples, &centre).max(bound);
        let more = peaks(problem, &grid, &centre.points, centre.level * (1.0 + ABOVE));
        points = centre.points;
        if more.is_empty() {
            break;
        }
        samples.extend(more);
    }
    (points, bound)
}

/// Parameters closer at the ends of each span, where a polynomial is steeper.
fn grid<const D: usize>(problem: &Problem<D>) -> Vec<Sample<D>> {
    let count = 3 * (problem.curve.degree() + problem.knots.degree());
    let spans = problem.spans();
    let place =
        |index: usize| 0.5 - 0.5 * profiles::Real::cos(std::f64::consts::PI * index as f64 / count as f64);
    let places: Vec<f64> = (0..count).map(place).collect();
    let inside = spans.iter().flat_map(|(from, to)| places.iter().map(move |t| from + (to - from) * t));
    // The ends coincide.
    let last = spans.last().map(|span| span.1);
    inside.chain(last).map(|u| problem.sample(u)).collect()
}

/// Where the distance has a peak above a level, as new samples.
fn peaks<const D: usize>(
    problem: &Problem<D>,
    grid: &[Sample<D>],
    points: &[Homogeneous<D>],
    level: f64,
) -> Vec<Sample<D>> {
    let distances: Vec<f64> = grid.iter().map(|sample| sample.distance(points)).collect();
    let mut found = Vec::new();
    for (near, at) in grid.windows(3).zip(distances.windows(3)) {
        let ([before, here, after], [low, high, next]) = (near, at) else { continue };
        if !(high >= low && high > next) {
            continue;
        }
        // The top of the parabola through the three.
        let (left, right) = (here.u - before.u, after.u - here.u);
        let (fall, rise) = ((high - low) / left, (high - next) / right);
        let u = here.u + 0.5 * (right * fall - left * rise) / (fall + rise);
        let top = if u > before.u && u < after.u { problem.sample(u) } else { *here };
        let best = if top.distance(points) > *high { top } else { *here };
        if best.distance(points) > level {
            found.push(best);
        }
    }
    found
}
