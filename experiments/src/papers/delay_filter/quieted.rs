//! Figures 5 and 6: the vibration with the delay filter, with the low-pass, with the filter of another system.

use anyhow::{Context as _, Result};
use identify::Signal;
use plants::nalgebra::{self, vector};
use plants::{HeldLinear, LowPass};
use profiles::{Profile, Trapezoid};
use shaping::{DelayFilter, Shaped};

use super::reading::nearest;
use super::search::Found;
use super::servo::{Response, Servo};
use super::setup::{CONTROL_RATE, HORIZON, LOW_PASS, SYSTEMS};
use super::{late, move_and_target, position};
use crate::experiment::Outcome;
use crate::figure::{Figure, Panel, Quantity, Role};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// The instant from which the vibration is compared, s: five time constants of the low-pass after the command.
const QUIET: f64 = 0.025 + 5.0 * LOW_PASS;

/// A move through the low-pass, sampled by the controller.
fn low_passed(command: &Trapezoid) -> Result<impl FnMut(f64) -> f64> {
    let step = LowPass::new(LOW_PASS)?.transition(1.0 / CONTROL_RATE as f64)?;
    let command = *command;
    let mut output = vector![0.0];
    Ok(move |t: f64| {
        let now = output[0];
        output = step.apply(&output, &vector![command.sample(t).position]);
        now
    })
}

/// One line of figures 5 and 6.
struct Quieted {
    id: &'static str,
    name: &'static str,
    role: Role,
    response: Response,
}

/// Figures 5 and 6, and what a filter on the true pole does.
pub(super) fn figures(found: &Found, outcome: &mut Outcome) -> Result<()> {
    let (command, target) = move_and_target()?;
    let filter = |k: usize| -> Result<DelayFilter> {
        let mode = SYSTEMS[k].printed_mode()?.context("a mode")?;
        Ok(DelayFilter::positive(mode, SYSTEMS[k].filter_delay.context("a delay")?)?)
    };
    for (figure, k, other) in [("fig5", 1, None), ("fig6", 2, Some(1))] {
        let system = &SYSTEMS[k];
        let servo = Servo::new(system, &found.loops)?;
        let plain = servo.run(|t| command.sample(t).position, HORIZON, 1)?;
        let printed = system.vibration.context("a mode")?;
        let true_mode = nearest(&servo.modes()?, printed).context("no mode")?;
        let shaped = |filter: DelayFilter| {
            let command = Shaped::new(command, *filter.train());
            servo.run(move |t| command.sample(t).position, HORIZON, 1)
        };
        let own = shaped(filter(k)?)?;
        let better = shaped(DelayFilter::positive(true_mode, system.filter_delay.context("a delay")?)?)?;
        let mut lines = vec![
            Quieted { id: "none", name: "no filter", role: Role::Reference, response: plain },
            Quieted { id: "filter", name: "filter of table 3", role: Role::Ours, response: own },
        ];
        if let Some(other) = other {
            let response = shaped(filter(other)?)?;
            lines.push(Quieted { id: "cross", name: "filter of system 2", role: Role::Second, response });
        } else {
            let response = servo.run(low_passed(&command)?, HORIZON, 1)?;
            lines.push(Quieted { id: "low-pass", name: "low-pass", role: Role::Second, response });
        }
        lines.push(Quieted {
            id: "true-pole",
            name: "filter on the true pole",
            role: Role::Third,
            response: better,
        });
        let title = match figure {
            "fig5" => "Fig. 5: system 2 with the delay filter and with the low-pass",
            _ => "Fig. 6: system 3 with its own filter and with that of system 2",
        };
        outcome.figure(compared(figure, title, &lines, (target, found.band)));
        for line in &lines {
            let signal = Signal::sampled(&line.response.load, line.response.period)?;
            let settling = signal.settling_time(target, found.band * target)?;
            outcome.measure(format!("{figure}/{}/settling", line.id), 1e3 * settling);
            outcome.measure(format!("{figure}/{}/twist", line.id), 1e6 * twist(&line.response));
        }
        if figure == "fig5" {
            let mut order: Vec<_> =
                lines.iter().filter(|l| l.id != "true-pole").map(|l| (twist(&l.response), l.id)).collect();
            order.sort_by(|a, b| a.0.total_cmp(&b.0));
            let order: Vec<_> = order.iter().map(|(_, id)| *id).collect();
            outcome.measure("fig5/order", order.join(" < "));
        }
    }
    Ok(())
}

/// The largest twist of the spring once the command is at rest, rad: the vibration without the slow approach to the target.
fn twist(response: &Response) -> f64 {
    response.twist.iter().skip(response.index(QUIET)).map(|twist| twist.abs()).fold(0.0, f64::max)
}

fn compared(id: &str, title: &str, lines: &[Quieted], (target, band): (f64, f64)) -> Figure {
    let mut whole = Panel::new(position()).limit(target, "target");
    let mut close = Panel::new(Quantity::new("distance from the target", "", "mrad"));
    let mut twists = Panel::new(Quantity::new("twist of the spring", "", "mrad"));
    for Quieted { name, role, response, .. } in lines {
        whole = whole.line(name, *role, response.points(|k| response.load[k]));
        close = close.line(name, *role, response.points(|k| 1e3 * (response.load[k] - target)));
        twists = twists.line(name, *role, response.points(|k| 1e3 * response.twist[k]));
    }
    let band = 1e3 * band * target;
    let close = late(close, 0.035).limit(band, "band").limit(-band, "−band");
    Figure::new(id, title, Quantity::time()).panel(whole).panel(close).panel(twists)
}
