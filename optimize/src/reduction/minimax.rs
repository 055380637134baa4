//! The least largest distance.

use profiles::nurbs::Homogeneous;

use super::problem::{Problem, Sample, dot, norm};
use super::system::{Curvature, System, stepped};

/// How far above the optimum of the samples the level may lie, as a part of it.
const GAP: f64 = 2e-4;

/// Newton steps in all, several times what it takes.
const STEPS: usize = 400;

/// Control points in the middle of all whose distance is below a level.
pub(super) struct Centre<const D: usize> {
    pub(super) points: Vec<Homogeneous<D>>,
    pub(super) level: f64,
}

/// Looks for the least `t` with `|C W - N| <= t W` at every sample, weights and reaches inside their bounds. For every `t`
/// these control points are a convex set, also where weights are free, so what is found is the global optimum.
///
/// The analytic centre of the set, the minimum of `- sum log (t^2 W^2 - |C W - N|^2)` minus the logarithms of the
/// distances to the bounds, is followed as `t` falls: a step along the tangent of its path, and Newton's method back to
/// it. The optimum lies at most two per sample and bound over the slope of the barrier below `t`.
///
/// # References
/// - S. Boyd, L. Vandenberghe, "Convex optimization", Cambridge University Press, 2004, sections 4.2.5 and 11.3,
///   <https://doi.org/10.1017/CBO9780511804441>: quasiconvex problems, the barrier.
/// - P. Huard, "Resolution of mathematical programming with nonlinear constraints by the method of centres", in:
///   J. Abadie (ed.), Nonlinear programming, North-Holland, 1967.
pub(super) fn minimax<const D: usize>(
    problem: &Problem<D>,
    samples: &[Sample<D>],
    points: Vec<Homogeneous<D>>,
) -> Centre<D> {
    let largest = samples.iter().map(|sample| sample.distance(&points)).fold(0.0, f64::max);
    let mut now = Centre { points, level: 1.2 * largest };
    if !(largest > 0.0 && problem.inside(&now.points)) {
        return now;
    }
    let mut path = Path { problem, samples, system: System::new(problem) };
    let bounds = problem.tied.len() + if problem.weights_free { 2 * now.points.len() } else { 0 };
    let count = (2 * samples.len() + bounds) as f64;
    for _ in 0..STEPS {
        let Some(Step { decrement, slope, along }) = path.newton(&mut now) else { break };
        // Near the centre, where the tangent is that of the path.
        if decrement < 0.2 && (count <= GAP * now.level * slope || !path.descend(&mut now, &along)) {
            break;
        }
    }
    now
}

struct Path<'a, const D: usize> {
    problem: &'a Problem<D>,
    samples: &'a [Sample<D>],
    system: System<D>,
}

struct Step<const D: usize> {
    /// Of the Newton step that was made.
    decrement: f64,
    /// Of the barrier by the level, downwards.
    slope: f64,
    /// The way of the centre as the level falls.
    along: Vec<Homogeneous<D>>,
}

impl<const D: usize> Path<'_, D> {
    /// A Newton step to the centre; none where no step leads down.
    fn newton(&mut self, now: &mut Centre<D>) -> Option<Step<D>> {
        let level = now.level;
        self.system.clear();
        let (mut gradient, mut along) = (self.system.right(), self.system.right());
        let mut slope = 0.0;
        for sample in self.samples {
            let (residual, weight) = sample.residual(&now.points);
            let radius = level * weight;
            let size = norm(&residual);
            let slack = (radius - size) * (radius + size);
            let (by_residual, by_radius) = (residual.map(|r| 2.0 * r / slack), -2.0 * radius / slack);
            let twice_radius = by_radius * by_radius - 2.0 / slack;
            let mixed = by_residual.map(|r| r * by_radius);
            // The chain rule: residual = C W - N, radius = t W.
            let mut curvature = Curvature { points: [[0.0; D]; D], mixed: [0.0; D], weights: 0.0 };
            for (row, (entries, a)) in curvature.points.iter_mut().zip(&by_residual).enumerate() {
                entries.iter_mut().zip(&by_residual).for_each(|(entry, b)| *entry = a * b);
                entries[row] += 2.0 / slack;
            }
            let inward = |row: &[f64; D]| dot(row, &sample.point);
            for ((entry, row), cross) in curvature.mixed.iter_mut().zip(&curvature.points).zip(&mixed) {
                *entry = -(inward(row) + level * cross);
            }
            let square: f64 =
                curvature.points.iter().zip(&sample.point).map(|(row, c)| inward(row) * c).sum();
            curvature.weights = square + 2.0 * level * inward(&mixed) + level * level * twice_radius;
            self.system.add(sample, &curvature);
            let by_weight = inward(&by_residual) + level * by_radius;
            let by = Homogeneous { weighted: by_residual.map(|r| -r), weight: by_weight };
            self.system.add_right(&mut gradient, sample, &by);
            // The derivative of that by the level, with which the radius grows as the weight.
            let by_both = by_radius + weight * (inward(&mixed) + level * twice_radius);
            let by = Homogeneous { weighted: mixed.map(|r| -r * weight), weight: by_both };
            self.system.add_right(&mut along, sample, &by);
            slope -= by_radius * weight;
        }
        self.system.tie();
        self.system.tie_right(&mut gradient);
        self.system.tie_right(&mut along);
        self.add_bounds(now, &mut gradient);
        self.system.factor();
        // As the level falls the centre moves by the inverse of the Hessian times this.
        self.system.solve(&mut along);
        let mut solution = gradient.clone();
        self.system.solve(&mut solution);
        let square: f64 = solution.iter().zip(&gradient).map(|(s, g)| s * g).sum();
        if !(square >= 0.0 && square.is_finite()) {
            return None;
        }
        solution.iter_mut().for_each(|x| *x = -*x);
        let step = self.system.step(&solution);
        let made = self.search(now, &step, square);
        let along = self.system.step(&along);
        made.then_some(Step { decrement: square.sqrt(), slope, along })
    }

    /// Adds the barriers of weights and reaches.
    fn add_bounds(&mut self, now: &Centre<D>, gradient: &mut [f64]) {
        let (least, most) = self.problem.weight_range;
        let Self { problem, system, .. } = self;
        for (index, point) in now.points.iter().enumerate() {
            let tied = problem.tied.iter().find(|tied| tied.index == index);
            if problem.weights_free && tied.is_none_or(|tied| tied.through.is_some()) {
                let (low, high) = (1.0 / (point.weight - least), 1.0 / (most - point.weight));
                gradient[system.unknown(index, D)] += high - low;
                system.add_diagonal(index, D, low * low + high * high);
            }
            if let Some(reach) = tied.and_then(|tied| tied.reach(&now.points)) {
                gradient[system.unknown(index, 0)] -= 1.0 / reach;
                system.add_diagonal(index, 0, 1.0 / (reach * reach));
            }
        }
    }

    /// The barrier, none outside.
    fn barrier(&self, points: &[Homogeneous<D>], level: f64) -> Option<f64> {
        if !self.problem.inside(points) {
            return None;
        }
        // A product of a few slacks per logarithm.
        let (mut sum, mut product) = (0.0, 1.0);
        let mut log = |slack: f64| {
            product *= slack;
            if !(1e-100..=1e100).contains(&product) {
                sum += profiles::Real::ln(std::mem::replace(&mut product, 1.0));
            }
        };
        for sample in self.samples {
            let (residual, weight) = sample.residual(points);
            let radius = level * weight;
            // As a product: the difference of squares would lose what is left near the bound.
            let size = norm(&residual);
            let slack = (radius - size) * (radius + size);
            if !(radius > size && slack > 0.0) {
                return None;
            }
            log(slack);
        }
        let (least, most) = self.problem.weight_range;
        if self.problem.weights_free {
            points.iter().for_each(|point| log((point.weight - least) * (most - point.weight)));
        }
        self.problem.tied.iter().filter_map(|tied| tied.reach(points)).for_each(log);
        let barrier = -(sum + profiles::Real::ln(product));
        barrier.is_finite().then_some(barrier)
    }

    /// Halves the step until it stays inside and leads down.
    fn search(&self, now: &mut Centre<D>, step: &[Homogeneous<D>], square: f64) -> bool {
        let Some(before) = self.barrier(&now.points, now.level) else { return false };
        let mut part = 1.0;
        for _ in 0..40 {
            let next = stepped(&now.points, step, part);
            if let Some(after) = self.barrier(&next, now.level)
                && after <= before - 0.1 * part * square + 1e-12 * before.abs()
            {
                now.points = next;
                return true;
            }
            part *= 0.5;
        }
        false
    }

    /// Lowers the level as far as the tangent of the path stays well inside; whether that was any further.
    fn descend(&self, now: &mut Centre<D>, along: &[Homogeneous<D>]) -> bool {
        let fits = |fall: f64| {
            let points = stepped(&now.points, along, fall);
            self.barrier(&points, now.level - fall).is_some()
        };
        let largest = self.samples.iter().map(|sample| sample.distance(&now.points)).fold(0.0, f64::max);
        // Without moving the level could fall to the largest distance; along the path further.
        let (mut low, mut high) = (0.0, now.level);
        let mut guess = (2.0 * (now.level - largest)).min(0.5 * now.level);
        for _ in 0..8 {
            if fits(guess) {
                low = guess;
            } else {
                high = guess;
            }
            guess = if high < now.level { 0.5 * (low + high) } else { (2.0 * low).min(0.5 * (low + high)) };
        }
        let fall = 0.8 * low;
        now.points = stepped(&now.points, along, fall);
        now.level -= fall;
        fall > 0.0
    }
}
