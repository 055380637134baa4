//! Where the modes of the loops lie, where a fit sees them, and what the paper's formulas read.

use profiles::Mode;

use super::reading::Vibration;
use crate::figure::{Figure, Panel, Quantity, Role};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// Faster modes are those of the current loop, which no response of the load shows, rad/s.
const FASTEST: f64 = 2000.0;

/// Damping ratio and undamped angular frequency of a mode.
pub(super) fn vibration_of(mode: Mode) -> Vibration {
    (mode.damping_ratio(), mode.angular_frequency())
}

/// Modes in words.
pub(super) fn listed(modes: &[Mode]) -> String {
    let one = |mode: &Mode| format!("{:.4} at {:.1}", mode.damping_ratio(), mode.angular_frequency());
    modes.iter().map(one).collect::<Vec<_>>().join(", ")
}

type Points = Vec<(Role, (f64, f64))>;

/// Decay rate and oscillation of every mode.
#[derive(Default)]
pub(super) struct PoleMap {
    loops: Points,
    found: Points,
    read: Points,
}

impl PoleMap {
    /// Adds the modes of a system's loop, those found by the fit and the paper's reading.
    pub(super) fn add(&mut self, role: Role, loops: &[Mode], found: &[Mode], read: Option<Vibration>) {
        let read: Vec<Mode> = read.and_then(|(z, w)| Mode::new(w, z).ok()).into_iter().collect();
        for (points, modes) in [(&mut self.loops, loops), (&mut self.found, found), (&mut self.read, &read)] {
            let slow = modes.iter().filter(|mode| mode.angular_frequency() < FASTEST);
            points.extend(slow.map(|mode| (role, (-mode.pole().re, mode.pole().im))));
        }
    }

    /// The map as a figure.
    pub(super) fn figure(self) -> Figure {
        let mut panel = Panel::new(Quantity::new("oscillation", "", "rad/s"));
        // Rays to the poles of the loop: they name the colours.
        for role in [Role::Ours, Role::Second, Role::Third, Role::Fourth] {
            let ends = self.loops.iter().filter(|(of, _)| *of == role);
            let ray: Vec<_> = ends.flat_map(|(_, end)| [(0.0, 0.0), *end, (0.0, 0.0)]).collect();
            let number = match role {
                Role::Ours => 1,
                Role::Second => 2,
                Role::Third => 3,
                _ => 4,
            };
            panel = panel.line(&format!("system {number}"), role, ray);
        }
        let panel = panel
            .marks_of("pole of the loop", self.loops)
            .marks_of("found by the fit", self.found)
            .marks_of("read by the paper's formulas", self.read);
        let title = "Modes of the loops, what a fit finds of them, and what the paper's formulas read";
        Figure::new("poles", title, Quantity::new("decay rate", "", "1/s")).panel(panel)
    }
}
