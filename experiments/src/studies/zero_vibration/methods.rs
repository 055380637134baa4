//! Every way of making a move that is compared.

use anyhow::Result;
use optimize::vibration_free::{Robustness, plan};
use profiles::{Chain, Mode, Profile, SCurve, SnapLimited};
use shaping::{DelayFilter, ImpulseTrain, Shaped, Shaper};

use super::command::Command;
use super::setup::{BAND, OFF, Task, limits, limits_of_snap};
use super::tuning;
use crate::figure::{Role, Shape};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// Sections of a chain with zeros of order two on one mode.
const SECTIONS: usize = 47;
/// What the extra-insensitive shaper tolerates, as a part of the vibration of a step.
const TOLERATED: f64 = 0.05;
/// Delay of the delay filter in damped periods. A quarter would be ZV and a half ZVD; the paper on it takes 0.27 to 0.44.
const DELAY: f64 = 0.375;

/// What a method is one of; each has a panel of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Family {
    /// A law that is not shaped, and the low-pass.
    Plain,
    /// The S-curve through a train of impulses.
    Shaper,
    /// A step through averages, some of which are as long as the mode asks for.
    Chain,
    /// The shortest move without vibration.
    Optimum,
}

impl Family {
    pub(super) fn shape(self) -> Shape {
        match self {
            Self::Plain => Shape::Circle,
            Self::Shaper => Shape::Triangle,
            Self::Chain | Self::Optimum => Shape::Square,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Plain => "laws and low-pass",
            Self::Shaper => "shapers",
            Self::Chain => "chains of averages",
            Self::Optimum => "time optima",
        }
    }
}

pub(super) const FAMILIES: [Family; 4] = [Family::Plain, Family::Shaper, Family::Chain, Family::Optimum];

/// One of them.
pub(super) struct Method {
    /// In rows.
    pub(super) id: &'static str,
    /// In pictures.
    pub(super) name: &'static str,
    pub(super) family: Family,
    pub(super) role: Role,
    /// The move for a task; the number is the seed of a search.
    plan: fn(&Task, u64) -> Result<Command>,
}

impl Method {
    /// Whether it is the time optimum, with any robustness.
    pub(super) fn is_optimum(&self) -> bool {
        self.family == Family::Optimum
    }

    pub(super) fn plan(&self, task: &Task, seed: u64) -> Result<Command> {
        (self.plan)(task, seed)
    }
}

const fn method(
    id: &'static str,
    name: &'static str,
    (family, role): (Family, Role),
    plan: fn(&Task, u64) -> Result<Command>,
) -> Method {
    Method { id, name, family, role, plan }
}

/// The simplest first: of two that are done at the same time the first has won.
pub(super) const METHODS: &[Method] = &[
    method("s-curve", "S-curve", (Family::Plain, Role::Reference), |task, _| {
        Ok(Command::new(s_curve(task)?))
    }),
    method("snap-limited", "snap-limited", (Family::Plain, Role::Seventh), |task, _| {
        Ok(Command::new(SnapLimited::rest_to_rest(task.length, &limits_of_snap()?)?))
    }),
    method("five-phase", "five-phase, swarm", (Family::Plain, Role::Third), |task, seed| {
        tuning::five_phase(task, seed)
    }),
    method("low-pass", "low-pass", (Family::Plain, Role::Second), |task, _| {
        tuning::low_pass(task, || Ok(Command::new(s_curve(task)?)))
    }),
    method("zv", "ZV", (Family::Shaper, Role::Second), |task, _| shaped(task, Shaper::ZV)),
    method("zvd", "ZVD", (Family::Shaper, Role::Third), |task, _| shaped(task, Shaper::ZVD)),
    method("ei", "EI 5 %", (Family::Shaper, Role::Fourth), |task, _| {
        shaped(task, Shaper::extra_insensitive(TOLERATED))
    }),
    method("delay-filter", "delay filter", (Family::Shaper, Role::Fifth), |task, _| {
        let filter = DelayFilter::positive(task.mode, DELAY * task.mode.damped_period())?;
        Ok(Command::new(Shaped::new(s_curve(task)?, *filter.train())))
    }),
    method("chain", "chain", (Family::Chain, Role::Fourth), |task, _| chain(task, &[task.mode])),
    method("chain-double", "chain, double zero", (Family::Chain, Role::Fifth), |task, _| {
        chain(task, &[task.mode; 2])
    }),
    method("optimum", "optimum", (Family::Optimum, Role::Ours), |task, _| optimum(task, Robustness::None)),
    method("optimum-double", "optimum, double zero", (Family::Optimum, Role::Third), |task, _| {
        optimum(task, Robustness::DoubleZero)
    }),
    method("optimum-band", "optimum, band", (Family::Optimum, Role::Second), |task, _| {
        optimum(task, Robustness::Band { half_width: OFF, residual: BAND })
    }),
];

/// The method with this id.
pub(super) fn index(id: &str) -> Result<usize> {
    METHODS.iter().position(|m| m.id == id).ok_or_else(|| anyhow::anyhow!("no method '{id}'"))
}

fn s_curve(task: &Task) -> Result<SCurve> {
    Ok(SCurve::rest_to_rest(task.length, &limits()?)?)
}

fn shaped(task: &Task, shaper: Shaper) -> Result<Command> {
    let train: ImpulseTrain<3> = shaper.train(task.mode)?;
    Ok(Command::new(Shaped::new(s_curve(task)?, train)))
}

fn optimum(task: &Task, robustness: Robustness) -> Result<Command> {
    let planned = plan(task.length, &limits()?, &[task.mode], robustness)?;
    let proven = planned.is_proven();
    Ok(Command::new(planned).with_proof(proven))
}

/// Durations of the time optimum without vibration of the mode and of one of 2.3 times its frequency, and of the S-curve through
/// a ZV shaper for each, s.
pub(super) fn two_modes(task: &Task) -> Result<(f64, f64)> {
    let other = task.mode_at(2.3)?;
    let optimum = plan(task.length, &limits()?, &[task.mode, other], Robustness::None)?;
    let [first, second]: [ImpulseTrain<2>; 2] = [Shaper::ZV.train(task.mode)?, Shaper::ZV.train(other)?];
    let shaped = Shaped::new(Shaped::new(s_curve(task)?, first), second);
    Ok((optimum.duration(), shaped.duration()))
}

fn chain(task: &Task, modes: &[Mode]) -> Result<Command> {
    Ok(Command::new(Chain::<SECTIONS>::rest_to_rest(task.length, &limits()?, modes)?))
}
