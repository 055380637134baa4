//! The drive whose transfer function is lost, found again from what is printed of its response.

use anyhow::{Context as _, Result};
use identify::Signal;
use optimize::{Cost, simplex};
use plants::nalgebra::{SVector, Vector1};
use plants::{DiscreteStateSpace, TransferFunction};
use profiles::Real;

use super::setup::{
    BAND, COMMAND, JERK, PEAK, PHASE, SETTLINGS, STEP, TARGET, TRAPEZOID_PEAK, held, s_curve, speed,
    trapezoid,
};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// Drive, motor and belt, from the speed commanded to that of the load: a vibration with a lead.
#[derive(Clone, Debug)]
pub(super) struct Drive {
    pub(super) damping: f64,
    /// Time constant of the zero, s.
    pub(super) lead: f64,
    pub(super) transfer: TransferFunction,
    sampled: DiscreteStateSpace<2, 1, 1>,
}

impl Drive {
    /// The drive with the printed gain and the printed peak as its damped frequency.
    pub(super) fn new(damping: f64, lead: f64) -> Result<Self> {
        let frequency = PEAK / Real::sqrt((1.0 - damping) * (1.0 + damping));
        let transfer = TransferFunction::second_order(TARGET / COMMAND, frequency, damping, lead)?;
        let sampled = transfer.to_state_space::<2>()?.discretise(STEP)?;
        Ok(Self { damping, lead, transfer, sampled })
    }

    /// What the load does under a command held over every step, pulse/s.
    pub(super) fn respond(&self, command: &[f64]) -> Vec<f64> {
        let mut state = SVector::<f64, 2>::zeros();
        let step = |input: &f64| {
            let input = Vector1::new(*input);
            let output = self.sampled.output(&state, &input)[0];
            state = self.sampled.step(&state, &input);
            output
        };
        command.iter().map(step).collect()
    }
}

/// Overshoot as a part of what is wanted, and settling time in s.
pub(super) fn figures(output: &[f64]) -> Result<(f64, f64)> {
    figures_in(output, BAND)
}

fn figures_in(output: &[f64], band: f64) -> Result<(f64, f64)> {
    let signal = Signal::sampled(output, STEP)?;
    Ok((signal.overshoot(0.0, TARGET)?, signal.settling_time(TARGET, band * TARGET)?))
}

/// The search settles into a band this much narrower: at its best the drive would otherwise stand where a swing just touches
/// the band, and its settling time would hang on a rounding.
const MARGIN: f64 = 0.99;

/// A reconstruction: the drive, how much later than the record the move starts, s, and what the search left.
pub(super) struct Reconstruction {
    pub(super) drive: Drive,
    pub(super) start: f64,
    pub(super) cost: f64,
    pub(super) evaluations: u64,
}

/// What an overshoot, in parts, and a settling time in s may be off by to cost one.
const SLACK: (f64, f64) = (0.01, 0.05);

/// The reconstruction from overshoot and settling under the trapezoid; with `late`, from the settling under the S-curve too,
/// and with a record that starts before the move.
pub(super) fn reconstruct(late: bool) -> Result<Reconstruction> {
    let near_step = held(trapezoid(COMMAND));
    let curve = s_curve(JERK, PHASE)?;
    let smooth = held(speed(&curve));
    let cost = |unknowns: &[f64]| -> Result<f64> {
        let [damping, lead] = [unknowns.first(), unknowns.get(1)].map(|x| x.copied().unwrap_or(f64::NAN));
        let start = unknowns.get(2).copied().unwrap_or(0.0);
        let drive = Drive::new(damping, lead)?;
        let (overshoot, settling) = figures_in(&drive.respond(&near_step), MARGIN * BAND)?;
        let mut cost = ((overshoot - (TRAPEZOID_PEAK / TARGET - 1.0)) / SLACK.0).powi(2)
            + ((settling + start - SETTLINGS[0]) / SLACK.1).powi(2);
        if late {
            let (_, settling) = figures(&drive.respond(&smooth))?;
            cost += ((settling + start - SETTLINGS[1]) / SLACK.1).powi(2);
        }
        Ok(cost)
    };
    let start = [0.25, 0.12, 0.4];
    let unknowns = if late { 3 } else { 2 };
    let found = simplex(
        |unknowns| cost(unknowns).map_or(Cost::Failed, Cost::Ok),
        &start[..unknowns],
        &[0.05, 0.03, 0.1][..unknowns],
        400,
    )?;
    let [damping, lead] = [0, 1].map(|k| found.best.get(k).copied());
    Ok(Reconstruction {
        drive: Drive::new(damping.context("a damping")?, lead.context("a lead")?)?,
        start: found.best.get(2).copied().unwrap_or(0.0),
        cost: found.cost.value().context("no drive found")?,
        evaluations: found.evaluations,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The step response of a vibration with a lead in closed form, about the command as a step at half its rise.
    #[test]
    fn the_response_is_that_of_the_closed_form() {
        let drive = Drive::new(0.2014, 0.0921).expect("drive");
        let output = drive.respond(&held(trapezoid(COMMAND)));
        let frequency = PEAK / (1.0_f64 - 0.2014 * 0.2014).sqrt();
        let (decay, lead) = (0.2014 * frequency, 0.0921);
        // y = T (1 - e^(-d t) (cos w t + (d - lead W^2) / w sin w t))
        let sine = (decay - lead * frequency * frequency) / PEAK;
        for (k, y) in output.iter().enumerate().skip(10) {
            let t = k as f64 * STEP - 0.5e-3;
            let exact = TARGET * (1.0 - (-decay * t).exp() * ((PEAK * t).cos() + sine * (PEAK * t).sin()));
            // A ramp of h instead of a step is h^2 / 24 of the second derivative off.
            assert!((y - exact).abs() < 1e-5 * TARGET, "{t}: {y} and {exact}");
        }
    }

    #[test]
    fn the_reconstruction_does_not_hang_on_a_rounding() {
        let Drive { damping, lead, .. } = reconstruct(false).expect("found").drive;
        let near_step = held(trapezoid(COMMAND));
        let settling = |damping: f64, lead: f64| {
            figures(&Drive::new(damping, lead).expect("drive").respond(&near_step)).expect("figures").1
        };
        let there = settling(damping, lead);
        for part in [1e-4, -1e-4] {
            assert!((settling(damping * (1.0 + part), lead) - there).abs() < 1e-3);
            assert!((settling(damping, lead * (1.0 + part)) - there).abs() < 1e-3);
        }
    }

    #[test]
    fn the_figures_are_those_recomputed_for_the_printed_response() {
        let drive = Drive::new(0.2014, 0.0921).expect("drive");
        let (overshoot, settling) = figures(&drive.respond(&held(trapezoid(COMMAND)))).expect("figures");
        assert!(
            (overshoot - 0.660).abs() < 5e-4 && (settling - 1.755).abs() < 2e-3,
            "{overshoot} {settling}"
        );
        let curve = s_curve(JERK, PHASE).expect("curve");
        let (overshoot, settling) = figures(&drive.respond(&held(speed(&curve)))).expect("figures");
        assert!(
            (overshoot - 0.0173).abs() < 5e-4 && (settling - 1.690).abs() < 3e-3,
            "{overshoot} {settling}"
        );
    }
}
