//! The same laws on a controller: four rates, with and without an encoder, and where SMC and DSMC change places.

use std::f64::consts::TAU;

use anyhow::{Context as _, Result};
use rayon::prelude::*;

use super::ROLES;
use super::bench::Case;
use super::laws::Law;
use super::setup::{COUNT, RATE};
use crate::experiment::Outcome;
use crate::figure::{Figure, Panel, Quantity, Role};
use crate::row::Value;

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// Control periods of 10, 5, 2 and 1 kHz in ticks.
const PERIODS: [u32; 4] = [1, 2, 5, 10];
/// The period at which encoders and boundary layers are compared, in ticks: 1 kHz.
const SLOW: u32 = 10;
/// Laws whose torques vary by up to a quarter more than another's are as quiet.
const AS_QUIET: f64 = 1.25;

/// What a controller has to work with, in words and for the name of a row: its period in ticks and its encoder.
pub(super) const CONDITIONS: [(&str, &str, u32, Option<f64>); 2] =
    [("10 kHz, state known", "", 1, None), ("1 kHz, encoder of 17 bits", "-encoder", SLOW, Some(COUNT))];

/// What is read off x of the helix, from rest on the path, loaded.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reading {
    /// ITSE from the load on, rad^2 s^2.
    pub(super) robustness: f64,
    /// Total variation of the torque from the load on, N m/s.
    pub(super) chatter: f64,
}

impl Reading {
    /// Whether the torque is no more restless than another's.
    pub(super) fn as_quiet_as(&self, other: &Self) -> bool {
        self.chatter <= AS_QUIET * other.chatter
    }

    /// What it costs and what it leaves, as a point.
    pub(super) fn point(&self) -> (f64, f64) {
        (self.chatter, self.robustness)
    }
}

/// A law at a period in ticks, with an encoder or the state known.
pub(super) type Setting = (Law, u32, Option<f64>);

/// The readings of many settings; none where a loop diverges.
pub(super) fn readings(settings: &[Setting]) -> Result<Vec<Option<Reading>>> {
    let reading = |&(law, every, count): &Setting| {
        let case = Case { loaded: true, every, count, ..Case::new(law, [0.0]) };
        let Ok(course) = case.run() else { return Ok(None) };
        Ok(Some(Reading { robustness: course.robustness(0)?, chatter: course.chatter(0)? }))
    };
    settings.par_iter().map(reading).collect()
}

/// DSMC in a condition.
pub(super) fn dsmc(every: u32, count: Option<f64>) -> Result<Reading> {
    readings(&[(Law::Dsmc, every, count)])?.into_iter().flatten().next().context("DSMC is unstable")
}

/// The axis of what is left of the load.
pub(super) fn left(condition: &str) -> Quantity {
    let name = ["ITSE from 10 s on", condition].into_iter().filter(|part| !part.is_empty());
    Quantity::new(&name.collect::<Vec<_>>().join(", "), "", "rad^2 s^2").logarithmic()
}

/// The axis of what it costs.
pub(super) fn cost() -> Quantity {
    Quantity::new("total variation of the torque", "", "N m/s").logarithmic()
}

/// Robustness and chatter at four rates.
pub(super) fn rates(outcome: &mut Outcome) -> Result<()> {
    for (count, encoder, title) in [
        (None, "", "Four control rates, state known"),
        (Some(COUNT), "-encoder", "Four control rates, encoder of 17 bits, velocity from its counts"),
    ] {
        let mut errors = Panel::new(left(""));
        let mut restless = Panel::new(cost());
        for ((name, law), role) in Law::SINGLE.into_iter().zip(ROLES) {
            let (mut error_line, mut chatter_line) = (Vec::new(), Vec::new());
            let found = readings(&PERIODS.map(|every| (law, every, count)))?;
            for (every, reading) in PERIODS.into_iter().zip(found) {
                let rate = 1e-3 * RATE as f64 / f64::from(every);
                let Reading { robustness, chatter } = reading.context("unstable")?;
                let row = format!("sampled{encoder}/{name}/{rate:.0}khz");
                outcome.measure(format!("{row}/robustness"), robustness);
                outcome.measure(format!("{row}/variation"), chatter);
                error_line.push((rate, robustness));
                chatter_line.push((rate, chatter));
            }
            let name = name.to_uppercase();
            errors = errors.line(&name, role, error_line);
            restless = restless.line(&name, role, chatter_line);
        }
        let x = Quantity::new("control rate", "", "kHz").logarithmic();
        outcome.figure(Figure::new(&format!("rates{encoder}"), title, x).panel(errors).panel(restless));
    }
    Ok(())
}

/// A value of SMC and of DSMC at every abscissa, none where a loop diverges or holds the load no better than PID.
struct Comparison {
    at: Vec<f64>,
    smc: Vec<Option<f64>>,
    dsmc: Vec<Option<f64>>,
}

impl Comparison {
    fn new(at: Vec<f64>, settings: &[(u32, Option<f64>)], of_pid: f64) -> Result<Self> {
        let of = |law| -> Result<Vec<Option<f64>>> {
            let all: Vec<Setting> = settings.iter().map(|(every, count)| (law, *every, *count)).collect();
            let found = readings(&all)?.into_iter();
            Ok(found.map(|r| r.map(|r| r.robustness).filter(|left| *left < of_pid)).collect())
        };
        Ok(Self { at, smc: of(Law::Smc)?, dsmc: of(Law::Dsmc)? })
    }

    /// The first abscissa where SMC leaves more.
    fn turn(&self) -> Value {
        let mut pairs = self.at.iter().zip(self.smc.iter().zip(&self.dsmc));
        let turned = pairs.find(|(_, (smc, dsmc))| dsmc.is_some_and(|d| smc.is_none_or(|s| s > d)));
        turned.map_or(Value::from("none"), |(at, _)| (*at).into())
    }

    /// The last abscissa before a law fails.
    fn last(&self, values: &[Option<f64>]) -> f64 {
        self.at.iter().zip(values).take_while(|(_, value)| value.is_some()).last().map_or(0.0, |(at, _)| *at)
    }

    fn figure(&self, id: &str, title: &str, x: Quantity) -> Figure {
        let line = |values: &[Option<f64>]| -> Vec<(f64, f64)> {
            self.at.iter().zip(values).filter_map(|(at, value)| Some((*at, (*value)?))).collect()
        };
        let panel = Panel::new(left("")).line("SMC", ROLES[1], line(&self.smc)).line(
            "DSMC",
            ROLES[2],
            line(&self.dsmc),
        );
        Figure::new(id, title, x).panel(panel)
    }
}

/// Where SMC leaves more than DSMC: at which period, with which encoder, and in which boundary layer.
pub(super) fn order(quick: bool, outcome: &mut Outcome) -> Result<()> {
    let pid = readings(&[(Law::Pid, 1, None)])?.into_iter().flatten().next().context("PID is unstable")?;
    let periods: Vec<u32> = (1..10).chain((10..=200).step_by(if quick { 20 } else { 5 })).collect();
    let milliseconds = periods.iter().map(|every| 1e3 * f64::from(*every) / RATE as f64).collect();
    let settings: Vec<_> = periods.iter().map(|every| (*every, None)).collect();
    let by_period = Comparison::new(milliseconds, &settings, pid.robustness)?;
    outcome.measure("order/period-of-turn", by_period.turn());
    outcome.measure("order/longest-period/smc", by_period.last(&by_period.smc));
    outcome.measure("order/longest-period/dsmc", by_period.last(&by_period.dsmc));
    let title =
        "What SMC and DSMC leave of the load against the control period, where it is less than PID leaves";
    let x = Quantity::new("control period", "h", "ms").logarithmic();
    outcome.figure(by_period.figure("order-period", title, x));

    let bits: Vec<i32> = (6..=20).rev().collect();
    let settings: Vec<_> = bits.iter().map(|bits| (SLOW, Some(TAU / 2f64.powi(*bits)))).collect();
    let by_count = Comparison::new(bits.into_iter().map(f64::from).collect(), &settings, pid.robustness)?;
    outcome.measure("order/bits-of-turn", by_count.turn());
    let title =
        "What SMC and DSMC leave of the load against the encoder at 1 kHz, where it is less than PID leaves";
    outcome.figure(by_count.figure("order-encoder", title, Quantity::new("bits of the encoder", "", "")));
    layer(quick, outcome)
}

/// SMC in boundary layers of many widths: what it leaves where it chatters no more than DSMC.
fn layer(quick: bool, outcome: &mut Outcome) -> Result<()> {
    let widths = (0..=16).step_by(if quick { 4 } else { 1 }).map(|n| 10f64.powf(-4.0 + f64::from(n) / 4.0));
    let laws: Vec<Law> = widths.map(Law::SmcInLayer).collect();
    let title = "SMC in a boundary layer, from 0.1 mrad/s to 1 rad/s wide, against DSMC";
    let mut figure = Figure::new("order-chatter", title, cost());
    for (condition, encoder, every, count) in CONDITIONS {
        let dsmc = dsmc(every, count)?;
        let settings: Vec<Setting> = laws.iter().map(|law| (*law, every, count)).collect();
        let found: Vec<Reading> = readings(&settings)?.into_iter().flatten().collect();
        let quiet =
            found.iter().filter(|reading| reading.as_quiet_as(&dsmc)).map(|reading| reading.robustness);
        let ratio = quiet.min_by(f64::total_cmp).map(|least| (least / dsmc.robustness).into());
        outcome.measure(
            format!("order{encoder}/smc-over-dsmc-at-equal-chatter"),
            ratio.unwrap_or(Value::from("never as quiet")),
        );
        figure = figure.panel(
            Panel::new(left(condition))
                .line("SMC in a layer", ROLES[1], found.iter().map(Reading::point).collect())
                .marks_of("DSMC", vec![(Role::Ours, dsmc.point())]),
        );
    }
    outcome.figure(figure);
    Ok(())
}
