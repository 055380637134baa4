//! The helix, projected.

use super::bench::Course;
use crate::figure::{Figure, Panel, Quantity, Role};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// What an error is drawn as a multiple of.
const MAGNIFIED: f64 = 20.0;

/// An oblique view of a point in rad: x to the right, z upwards, y towards the upper right.
fn projected([x, y, z]: [f64; 3]) -> (f64, f64) {
    (x + 0.5 * y, z + 8.0 * y)
}

fn axes(id: &str, title: &str) -> (Figure, Panel) {
    let across = Quantity::new("x + y/2", "", "rad");
    (Figure::new(id, title, across), Panel::new(Quantity::new("z + 8 y", "", "rad")))
}

/// Where the robot should be, and where it is.
pub(super) fn helix(id: &str, title: &str, course: &Course<3>) -> Figure {
    let (figure, panel) = axes(id, title);
    let path = |shown: fn(&Course<3>, usize, usize) -> f64| -> Vec<(f64, f64)> {
        course.shown().map(|k| projected([0, 1, 2].map(|axis| shown(course, axis, k)))).collect()
    };
    figure.panel(
        panel.line("wanted", Role::Reference, path(|course, axis, k| course.reference(axis, k))).line(
            "actual",
            Role::Ours,
            path(Course::position),
        ),
    )
}

/// The contour error of every law, magnified along the helix, once the start is over.
pub(super) fn magnified(courses: &[(String, Course<3>)], roles: [Role; 3]) -> Figure {
    let title =
        format!("The helix under load, contour errors drawn {MAGNIFIED:.0} times as large, from 3 s on");
    let (figure, mut panel) = axes("helix-magnified", &title);
    let after = |course: &Course<3>| course.shown().filter(|k| course.time(*k) >= 3.0).collect::<Vec<_>>();
    if let Some((_, course)) = courses.first() {
        let wanted =
            after(course).into_iter().map(|k| projected([0, 1, 2].map(|axis| course.reference(axis, k))));
        panel = panel.line("wanted", Role::Reference, wanted.collect());
    }
    for ((name, course), role) in courses.iter().zip(roles) {
        let drawn = after(course).into_iter().map(|k| {
            let across = course.contour(k);
            projected([0, 1, 2].map(|axis| course.reference(axis, k) - MAGNIFIED * across[axis]))
        });
        panel = panel.line(name, role, drawn.collect());
    }
    figure.panel(panel)
}
