//! Curves and what happens along them, as figures.

use profiles::nurbs::NurbsCurve;

use super::path::{AXIS, CHORD, Driven, FEED, Interpolated};
use super::search::{Compared, METHODS, median};
use crate::figure::{Figure, Panel, Quantity, Role};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// The colours of swarm, genetic algorithm and hybrid.
const ROLES: [Role; 3] = [Role::Third, Role::Second, Role::Ours];
/// Below this an error is rounding, m.
const ROUNDING: f64 = 1e-18;

/// The best deviation so far against the evaluations, in um; median and span of all seeds.
pub(super) fn convergence<const D: usize>(id: &str, title: &str, compared: &Compared<D>) -> Figure {
    let mut panel = Panel::new(Quantity::new("largest deviation", "", "um").logarithmic());
    for ((name, runs), role) in METHODS.into_iter().zip(&compared.searches).zip(ROLES) {
        let Some(first) = runs.first() else { continue };
        // About 300 points: every seed has as many generations.
        let every = first.history.len().div_ceil(300);
        let at = |pick: fn(&[f64]) -> f64| -> Vec<(f64, f64)> {
            let picked = first.history.iter().enumerate().filter(|(n, _)| n % every == 0);
            picked
                .map(|(n, point)| {
                    let values: Vec<f64> =
                        runs.iter().filter_map(|run| run.history.get(n)).map(|p| p.1).collect();
                    (1e-3 * point.0, 1e6 * pick(&values).max(ROUNDING))
                })
                .collect()
        };
        panel = panel.line(name, role, at(|values| median(values.iter().copied())));
        if runs.len() > 1 {
            let least = at(|values| values.iter().copied().fold(f64::INFINITY, f64::min));
            let greatest = at(|values| values.iter().copied().fold(0.0, f64::max));
            panel = panel.spread(name, role, least, greatest);
        }
    }
    let deterministic = compared.deterministic.deviation.at_most.max(ROUNDING);
    Figure::new(id, title, Quantity::new("evaluations", "", "1000"))
        .panel(panel.limit(1e6 * deterministic, "determ."))
}

/// What is smaller is not magnified, m.
const VISIBLE: f64 = 1e-9;

/// A point in mm as it is drawn: planar as it is, in space obliquely.
fn projected<const D: usize>(point: [f64; D]) -> (f64, f64) {
    let [x, y, z] = std::array::from_fn(|axis| 1e3 * point.get(axis).copied().unwrap_or(0.0));
    (x + 0.4 * z, y + 0.4 * z)
}

/// The curve, and every reduction with its deviation magnified so that the largest is a tenth of the picture.
pub(super) fn overlay<const D: usize>(
    id: &str,
    title: &str,
    curve: &NurbsCurve<D>,
    reductions: &[(&str, Role, &NurbsCurve<D>, f64)],
) -> Figure {
    let domain = curve.domain();
    let parameters: Vec<f64> =
        (0..=600).map(|n| domain.lower + (domain.upper - domain.lower) * f64::from(n) / 600.0).collect();
    let line =
        |at: &dyn Fn(f64) -> [f64; D]| parameters.iter().map(|u| projected(at(*u))).collect::<Vec<_>>();
    let drawn = line(&|u| curve.point(u));
    let size = drawn.iter().map(|p| p.1).fold(f64::NEG_INFINITY, f64::max)
        - drawn.iter().map(|p| p.1).fold(f64::INFINITY, f64::min);
    let names = if D == 2 { ["x", "y"] } else { ["x + 0.4 z", "y + 0.4 z"] };
    let mut panel = Panel::new(Quantity::new(names[1], "", "mm"));
    for (name, role, reduced, deviation) in reductions {
        // One digit is enough for a factor; roundings are not magnified, nor what is large already.
        let rough = if *deviation > VISIBLE { 1e-4 * size / deviation } else { 1.0 };
        let power = 10f64.powf(rough.log10().floor());
        let factor = ((rough / power).floor() * power).max(1.0);
        let magnified = |u: f64| {
            let (exact, reduced) = (curve.point(u), reduced.point(u));
            std::array::from_fn(|axis| exact[axis] + factor * (reduced[axis] - exact[axis]))
        };
        let label =
            if factor > 1.0 { format!("{name}, deviation ×{factor:.0}") } else { (*name).to_owned() };
        panel = panel.line(&label, *role, line(&magnified));
    }
    let panel = panel.line("curve", Role::Reference, drawn);
    Figure::new(id, title, Quantity::new(names[0], "", "mm")).panel(panel).to_scale()
}

/// Feed, and velocity, acceleration and jerk of every axis, against their limits.
pub(super) fn feed<const D: usize>(id: &str, title: &str, path: &Interpolated<D>) -> Figure {
    let roles = [Role::Ours, Role::Second, Role::Third];
    let along = path.samples.iter().map(|s| (s.time, 1e3 * s.along.velocity)).collect();
    let mut figure = Figure::new(id, title, Quantity::time()).panel(
        Panel::new(Quantity::new("feed", "", "mm/s"))
            .line("along the path", Role::Fourth, along)
            .limit(1e3 * FEED, "command"),
    );
    type Of<const D: usize> = fn(&profiles::nurbs::FeedSample<D>) -> [f64; D];
    let quantities: [(&str, &str, f64, Of<D>); 3] = [
        ("velocity", "mm/s", 1e3, |s| s.velocity),
        ("acceleration", "m/s^2", 1.0, |s| s.acceleration),
        ("jerk", "m/s^3", 1.0, |s| s.jerk),
    ];
    for ((name, unit, scale, of), limit) in quantities.into_iter().zip(AXIS) {
        let mut panel = Panel::new(Quantity::new(name, "", unit));
        for (axis, (letter, role)) in ["x", "y", "z"].into_iter().zip(roles).take(D).enumerate() {
            let line = path.samples.iter().map(|s| (s.time, scale * of(s)[axis])).collect();
            panel = panel.line(letter, role, line);
        }
        figure = figure.panel(panel.limit(scale * limit, "limit").limit(-scale * limit, "−limit"));
    }
    figure
}

/// How far the mechanism is from the curve and from its coordinates.
pub(super) fn driven(id: &str, title: &str, driven: &Driven) -> Figure {
    let micro = |points: &[(f64, f64)]| points.iter().map(|(t, e)| (*t, 1e6 * e)).collect::<Vec<_>>();
    let panel = |name: &str| Panel::new(Quantity::new(name, "", "um"));
    Figure::new(id, title, Quantity::time())
        .panel(
            panel("distance from the curve")
                .line("", Role::Ours, micro(&driven.contour))
                .limit(1e6 * CHORD, "chord"),
        )
        .panel(panel("farthest axis from its coordinate").line("", Role::Second, micro(&driven.tracking)))
}
