//! Samples where the distance is largest, and the optimum over all of them.

use profiles::nurbs::{Homogeneous, NurbsCurve};

use super::bound::lower_bound;
use super::error::ReductionError;
use super::minimax::{Centre, minimax};
use super::problem::{Problem, Sample};
use super::reduce::{Reduced, judged};

/// How close to their optimum the samples are brought from round to round; the last one until no peak is left.
const GAPS: [f64; 3] = [3e-2, 3e-3, 3e-4];

/// Rounds of adding samples; four or five are enough.
const ROUNDS: usize = 12;

/// The reduction with the least largest distance over the whole curve, and a bound that no other falls below.
pub(super) fn least_largest<const D: usize>(
    curve: &NurbsCurve<D>,
    problem: &Problem<D>,
    points: Vec<Homogeneous<D>>,
) -> Result<Reduced<D>, ReductionError> {
    let grid = grid(problem);
    let mut points = problem.scaled(points);
    let mut samples: Vec<Sample<D>> = grid.iter().skip(1).step_by(2).copied().collect();
    samples.extend(peaks(problem, &grid, &points, 0.0));
    let mut start = Centre { points: points.clone(), level: 0.0 };
    let mut bound = 0.0_f64;
    for round in 0..ROUNDS {
        let [.., last] = GAPS;
        let gap = GAPS.get(round).copied().unwrap_or(last);
        let (centre, near) = minimax(problem, &samples, &start, gap);
        bound = lower_bound(problem, &samples, &centre).max(bound);
        // Peaks that are about to rise come along, until the last rounds.
        let above = if gap > last { 1.0 - gap } else { 1.0 + last };
        let more = peaks(problem, &grid, &centre.points, centre.level * above);
        if more.is_empty() && gap <= last {
            // Between the grid there may be another one yet.
            let found = judged(curve, problem, &centre.points, bound * problem.size)?;
            if found.deviation.attained <= centre.level * above * problem.size {
                return Ok(found);
            }
            samples.push(problem.sample(found.deviation.at));
        }
        samples.extend(more);
        (start, points) = (near, centre.points);
    }
    judged(curve, problem, &points, bound * problem.size)
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
