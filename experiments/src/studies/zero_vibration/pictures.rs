//! What was judged, as figures.

use anyhow::Result;

use super::command::{jerk_of, part_left};
use super::judge::{Judged, Plant, winner};
use super::methods::{FAMILIES, Family, METHODS, Method, index};
use super::setup::{BAND, DAMPINGS, OFF, Task};
use super::simulation::{Watch, course};
use crate::figure::{Figure, Panel, Quantity, Role};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// What is less does not show: vibration in % of the move, a price in ms.
const LEAST_LEFT: f64 = 1e-4;
const LEAST_FAR: f64 = 1e-3;
const LEAST_PRICE: f64 = 0.1;

fn of(family: Family) -> impl Iterator<Item = (usize, &'static Method)> {
    METHODS.iter().enumerate().filter(move |(_, method)| method.family == family)
}

/// Who is at rest soonest, over frequency and length of move.
pub(super) fn map(tasks: &[Task], all: &[Vec<Judged>]) -> Figure {
    let title = "Who is at rest soonest: length of the move over frequency, for damping ratios 0.02 and 0.1, the plant as told and 10 % off";
    let mut figure = Figure::new("map", title, Quantity::new("frequency of the mode", "f", "Hz"));
    for damping in DAMPINGS {
        for (plant, words) in [(Plant::Nominal, "as told"), (Plant::Off, "worse of ±10 %")] {
            let name = format!("length, damping {damping}, {words}");
            let mut panel = Panel::new(Quantity::new(&name, "", "mm").logarithmic());
            for (n, method) in METHODS.iter().enumerate() {
                let won = tasks.iter().zip(all).filter(|(task, judged)| {
                    // The same number that the task was made of.
                    task.mode.damping_ratio().to_bits() == damping.to_bits() && winner(judged, plant) == n
                });
                let points: Vec<_> = won.map(|(task, _)| (task.mode.hz(), 1e3 * task.length)).collect();
                if !points.is_empty() {
                    panel = panel.places(method.name, method.role, method.family.shape(), points);
                }
            }
            figure = figure.panel(panel);
        }
    }
    figure
}

/// What is left of a move by a plant whose frequency is not what was told.
pub(super) fn sensitivity(task: &Task, seed: u64, samples: u32) -> Result<Figure> {
    let parts: Vec<f64> = (0..=samples).map(|k| 0.6 + 0.8 * f64::from(k) / f64::from(samples)).collect();
    let title = "Vibration left at the end of a move of 100 mm, 8 Hz, damping ratio 0.02, in % of the move";
    let x = Quantity::new("frequency of the plant over the told one", "", "");
    let mut figure = Figure::new("sensitivity", title, x).own_legends();
    for family in FAMILIES {
        let name = format!("left, {}", family.name());
        let mut panel = Panel::new(Quantity::new(&name, "", "%").logarithmic())
            .limit(100.0 * BAND, "0.1 %")
            .band(1.0 - OFF, 1.0 + OFF, "");
        // The simplest on top: what is not told of a mode leaves much the same.
        for (_, method) in of(family).collect::<Vec<_>>().into_iter().rev() {
            let command = method.plan(task, seed)?;
            let line = parts.iter().map(|part| {
                let left = part_left(&command, task.mode_at(*part)?, task.length)?;
                Ok((*part, (100.0 * left).max(LEAST_LEFT)))
            });
            panel = panel.line(method.name, method.role, line.collect::<Result<_>>()?);
        }
        figure = figure.panel(panel);
    }
    Ok(figure)
}

/// What a command takes longer than the S-curve, over the frequency of the mode.
pub(super) fn price(tasks: &[Task], durations: &[Vec<f64>]) -> Result<Figure> {
    let plain = index("s-curve")?;
    let title = "The price of no vibration: what a command of 100 mm takes longer than the S-curve";
    let x = Quantity::new("frequency of the mode", "f", "Hz");
    let mut figure = Figure::new("price", title, x).own_legends();
    for family in FAMILIES {
        let name = format!("price, {}", family.name());
        let mut panel = Panel::new(Quantity::new(&name, "", "ms").logarithmic());
        for (n, method) in of(family).filter(|(n, _)| *n != plain) {
            let line = tasks.iter().zip(durations).map(|(task, durations)| {
                (task.mode.hz(), (1e3 * (durations[n] - durations[plain])).max(LEAST_PRICE))
            });
            let line = line.filter(|(_, price)| price.is_finite()).collect();
            panel = panel.line(method.name, method.role, line);
        }
        figure = figure.panel(panel);
    }
    Ok(figure)
}

/// The jerk of some methods, one above the other, with the instants at which it jumps.
pub(super) fn jerk(task: &Task, seed: u64, ids: &[&str]) -> Result<Figure> {
    let title = "The jerk of a move of 100 mm around a mode of 8 Hz, and its switches";
    let mut figure = Figure::new("jerk", title, Quantity::time()).own_legends();
    for id in ids {
        let method = &METHODS[index(id)?];
        let (line, switches) = jerk_of(&method.plan(task, seed)?);
        let marks = switches.iter().map(|t| (*t, 0.0)).collect();
        let name = format!("jerk, {}", method.name);
        let panel = Panel::new(Quantity::new(&name, "j", "m/s^3")).line("", Role::Ours, line);
        figure = figure.panel(panel.marks(&format!("{} switches", switches.len()), marks));
    }
    Ok(figure)
}

/// How far the load is from the target around the end of the command.
pub(super) fn courses(task: &Task, seed: u64, ids: &[&str]) -> Result<Figure> {
    let (from, to) = (0.25, 0.55);
    let title = "How far the load is from the target, 100 mm, 8 Hz, damping ratio 0.02";
    let mut panel = Panel::new(Quantity::new("distance from the target", "", "% of move").logarithmic())
        .limit(100.0 * BAND, "0.1 %");
    let roles = [Role::Reference, Role::Second, Role::Third, Role::Fourth, Role::Fifth, Role::Ours];
    for (id, role) in ids.iter().zip(roles) {
        let method = &METHODS[index(id)?];
        let course = course(&method.plan(task, seed)?, task.mode, Watch { band: task.band(), until: to })?;
        let points = course.times.iter().zip(&course.load);
        let line = points
            .map(|(t, load)| (*t, (100.0 * (load / task.length - 1.0).abs()).max(LEAST_FAR)))
            .filter(|(t, _)| (from..to).contains(t));
        panel = panel.line(method.name, role, line.collect());
    }
    Ok(Figure::new("load", title, Quantity::time()).panel(panel))
}
