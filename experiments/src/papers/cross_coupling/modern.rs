//! Better: two laws of today against DSMC, at its chatter.

use anyhow::{Context as _, Result};

use super::laws::Law;
use super::sampled::{CONDITIONS, Reading, Setting, cost, dsmc, left, readings};
use crate::experiment::Outcome;
use crate::figure::{Figure, Panel, Role};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// Slope of the linear surfaces, 1/s.
const SLOPE: f64 = 60.0;

/// Super-twisting for loads that change by 10 to 10 000 N m/s, and observers of 20 to 2000 rad/s.
fn families(steps: i32) -> [(&'static str, Role, Vec<Law>); 2] {
    let grid = |from: f64, to: f64| {
        (0..=steps).map(move |n| from * (to / from).powf(f64::from(n) / f64::from(steps)))
    };
    let twisting = grid(10.0, 1e4).map(|load_rate| Law::SuperTwisting { slope: SLOPE, load_rate });
    let observed = grid(20.0, 2e3).map(|bandwidth| Law::Observed { slope: SLOPE, bandwidth });
    [("super-twisting", Role::Third, twisting.collect()), ("observer", Role::Second, observed.collect())]
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
            let quiet = found.iter().filter(|reading| reading.as_quiet_as(&dsmc)).map(|r| r.robustness);
            let least =
                quiet.min_by(f64::total_cmp).with_context(|| format!("{family} is never as quiet"))?;
            outcome.measure(format!("better{encoder}/{family}/itse-over-dsmc"), least / dsmc.robustness);
            panel = panel.line(family, role, found.iter().map(Reading::point).collect());
        }
        figure = figure.panel(panel.marks_of("DSMC", vec![(Role::Ours, dsmc.point())]));
    }
    outcome.figure(figure);
    Ok(())
}
