//! Better: laws of today against DSMC, at its chatter, on a controller that has an encoder.

use anyhow::{Context as _, Result};

use super::bench::Case;
use super::laws::Law;
use super::sampled::{CONDITIONS, Reading, SLOW, Setting, cost, dsmc, left, readings};
use super::setup::{COUNT, COUPLING, HORIZON, ON_PATH, STARTED};
use crate::experiment::Outcome;
use crate::figure::{Figure, Panel, Role};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// Slope of the linear surfaces, 1/s.
const SLOPE: f64 = 60.0;
/// Bandwidth of the observer on the robot, rad/s.
const BANDWIDTH: f64 = 400.0;

/// DSMC on surfaces of slopes 5 to 100, super-twisting for loads that change by 1 to 10 000 N m/s, observers of 20 to 2000
/// rad/s.
fn families(steps: i32) -> [(&'static str, Role, Vec<Law>); 3] {
    let grid = |from: f64, to: f64| {
        (0..=steps).map(move |n| from * (to / from).powf(f64::from(n) / f64::from(steps)))
    };
    let retuned = grid(5.0, 100.0).map(|alpha| Law::DsmcOn { alpha });
    let twisting = grid(1.0, 1e4).map(|load_rate| Law::SuperTwisting { slope: SLOPE, load_rate });
    let observed = grid(20.0, 2e3).map(|bandwidth| Law::Observed { slope: SLOPE, bandwidth });
    [
        ("dsmc-retuned", Role::Ours, retuned.collect()),
        ("super-twisting", Role::Third, twisting.collect()),
        ("observer", Role::Second, observed.collect()),
    ]
}

/// What each leaves of the load where it chatters no more than DSMC.
pub(super) fn better(quick: bool, outcome: &mut Outcome) -> Result<()> {
    let title = "Better: what laws of today leave of the load against what they cost in chatter";
    let mut figure = Figure::new("better", title, cost());
    for (condition, encoder, every, count) in CONDITIONS {
        let dsmc = dsmc(every, count)?;
        let mut panel = Panel::new(left(condition));
        for (family, role, laws) in families(if quick { 4 } else { 16 }) {
            let settings: Vec<Setting> = laws.into_iter().map(|law| (law, every, count)).collect();
            let found: Vec<Reading> = readings(&settings)?.into_iter().flatten().collect();
            // With the state known nothing bounds the gains but the rate, and the least is at the end of the grid.
            if count.is_some() {
                let quiet = found.iter().filter(|reading| reading.as_quiet_as(&dsmc)).map(|r| r.robustness);
                let least =
                    quiet.min_by(f64::total_cmp).with_context(|| format!("{family} is never as quiet"))?;
                outcome.measure(format!("better/{family}/load-itse-over-dsmc"), least / dsmc.robustness);
            }
            panel = panel.line(family, role, found.iter().map(Reading::point).collect());
        }
        let matched = readings(&[(Law::DsmcMatched, every, count)])?.into_iter().flatten().next();
        let matched = matched.context("matched DSMC is unstable")?;
        outcome.measure(
            format!("better{encoder}/dsmc-matched/variation-over-dsmc"),
            matched.chatter / dsmc.chatter,
        );
        outcome.measure(
            format!("better{encoder}/dsmc-matched/load-itse-over-dsmc"),
            matched.robustness / dsmc.robustness,
        );
        panel = panel.marks_of("DSMC", vec![(Role::Ours, dsmc.point())]);
        figure = figure.panel(panel.marks_of("DSMC, matched", vec![(Role::Ours, matched.point())]));
    }
    outcome.figure(figure);
    robot(outcome)
}

/// The robot under load at 1 kHz with encoders: the way off the path and the chatter of x, over those of DSMC.
fn robot(outcome: &mut Outcome) -> Result<()> {
    let run = |law| -> Result<[f64; 2]> {
        let case = Case {
            loaded: true,
            coupling: COUPLING,
            every: SLOW,
            count: Some(COUNT),
            ..Case::new(law, ON_PATH)
        };
        let course = case.run()?;
        Ok([course.contour_itse()?, course.chatter(0, STARTED, HORIZON)?])
    };
    let [across, chatter] = run(Law::Observed { slope: SLOPE, bandwidth: BANDWIDTH })?;
    let [of_dsmc, chatter_of_dsmc] = run(Law::Dsmc)?;
    outcome.measure("better/robot/contour-itse-over-dsmc", across / of_dsmc);
    outcome.measure("better/robot/variation-over-dsmc", chatter / chatter_of_dsmc);
    Ok(())
}
