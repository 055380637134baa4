//! A planned move as the drive is given it.

use anyhow::Result;
use profiles::{Complex, Mode, Profile, Section, Sectioned, complex};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// Damping ratio of the low-pass of second order: no peak, and the steepest start behind the corner.
pub(super) const LOW_PASS_DAMPING: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A profile, its sections, and the corner of a low-pass of second order behind it, rad/s.
pub(super) struct Command {
    profile: Box<dyn Profile + Send + Sync>,
    pub(super) sections: Vec<Section>,
    pub(super) low_pass: Option<f64>,
    /// Whether it is proven to be the shortest of its kind.
    pub(super) proven: bool,
}

impl Command {
    pub(super) fn new<P: Sectioned + Send + Sync + 'static>(profile: P) -> Self {
        let sections =
            std::iter::successors(profile.section_at(0.0), |last| profile.section_at(last.end)).collect();
        Self { profile: Box::new(profile), sections, low_pass: None, proven: false }
    }

    pub(super) fn with_low_pass(self, corner: f64) -> Self {
        Self { low_pass: Some(corner), ..self }
    }

    pub(super) fn with_proof(self, proven: bool) -> Self {
        Self { proven, ..self }
    }

    /// When the profile ends, s.
    pub(super) fn end(&self) -> f64 {
        self.profile.duration()
    }

    /// When the command is at rest, s: the end of the profile, behind a low-pass so much later that its own swing has fallen to
    /// `part`.
    pub(super) fn duration(&self, part: f64) -> f64 {
        self.end() + self.low_pass.map_or(0.0, |corner| -part.ln() / (LOW_PASS_DAMPING * corner))
    }

    /// Amplitude of the vibration that `mode` has at the end of the profile, m, and goes on with.
    pub(super) fn left(&self, mode: Mode) -> f64 {
        let pole = mode.pole();
        let passed = self.low_pass.map_or(Complex::new(1.0, 0.0), |corner| low_pass(corner, pole));
        complex::norm(self.profile.response(pole) * passed) / mode.damped_angular_frequency()
    }
}

/// `w^2 / (s^2 + 2 z w s + w^2)`
fn low_pass(corner: f64, s: Complex<f64>) -> Complex<f64> {
    let square = corner * corner;
    Complex::new(square, 0.0) / (s * s + s * (2.0 * LOW_PASS_DAMPING * corner) + square)
}

/// Sections of constant jerk as a line of steps, s and m/s^3, and the instants between them.
pub(super) fn jerk_of(command: &Command) -> (Vec<(f64, f64)>, Vec<f64>) {
    let at = |section: &Section| section.at_local(0.0).jerk;
    let steps = command.sections.iter().flat_map(|s| [(s.start, at(s)), (s.end, at(s))]);
    let jumps = command.sections.windows(2).filter(|pair| at(&pair[0]).to_bits() != at(&pair[1]).to_bits());
    (steps.collect(), jumps.map(|pair| pair[1].start).collect())
}

/// `left` in units of the move, for a distance that is a number.
pub(super) fn part_left(command: &Command, mode: Mode, length: f64) -> Result<f64> {
    let part = command.left(mode) / length;
    anyhow::ensure!(part.is_finite(), "a vibration of {part} of the move");
    Ok(part)
}
