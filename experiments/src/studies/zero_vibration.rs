//! What it costs to leave no vibration: every way of making a move, judged by when the load is at rest.

mod command;
mod judge;
mod methods;
mod pictures;
mod setup;
mod simulation;
mod tuning;

use anyhow::{Context as _, Result};
use rayon::prelude::*;

use self::judge::{Judged, Plant, judge, judge_all, saved, winner};
use self::methods::{METHODS, index, two_modes};
use self::setup::{Task, computed, grid};
use crate::experiment::{Context, Experiment, Outcome, Source};

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    id: "zero-vibration",
    title: "What it costs to leave no vibration, and who is at rest soonest",
    citation: "",
    sources: &[
        Source { path: file!(), text: include_str!("zero_vibration.rs") },
        Source { path: setup::FILE, text: include_str!("zero_vibration/setup.rs") },
        Source { path: methods::FILE, text: include_str!("zero_vibration/methods.rs") },
        Source { path: tuning::FILE, text: include_str!("zero_vibration/tuning.rs") },
        Source { path: command::FILE, text: include_str!("zero_vibration/command.rs") },
        Source { path: simulation::FILE, text: include_str!("zero_vibration/simulation.rs") },
        Source { path: judge::FILE, text: include_str!("zero_vibration/judge.rs") },
        Source { path: pictures::FILE, text: include_str!("zero_vibration/pictures.rs") },
    ],
    expected: include_str!("../../studies/zero-vibration/expected.toml"),
    readme_figure: None,
    run,
};

/// Moves whose duration was computed before.
const COMPUTED: [&str; 5] = ["s-curve", "zv", "zvd", "optimum", "optimum-double"];

fn run(context: &Context) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let tasks = grid(context.quick)?;
    context.progress.steps(tasks.len() as u64);
    let all = judge_all(&tasks, context.seed, || context.progress.step())?;
    outcome.figure(pictures::map(&tasks, &all));
    over_the_grid(&all, &mut outcome)?;
    context.progress.say("single moves");
    single_moves(context, &mut outcome)?;
    prices(context, &mut outcome)?;
    notes(&mut outcome);
    Ok(outcome)
}

/// Who wins how often, by how much, and what is left at worst.
fn over_the_grid(all: &[Vec<Judged>], outcome: &mut Outcome) -> Result<()> {
    for (n, method) in METHODS.iter().enumerate() {
        for plant in [Plant::Nominal, Plant::Off] {
            let won = all.iter().filter(|judged| winner(judged, plant) == n).count();
            outcome.measure(format!("wins/{}/{}", plant.id(), method.id), won);
        }
        let worst = |of: fn(&Judged) -> f64| all.iter().map(|judged| of(&judged[n])).fold(0.0, f64::max);
        outcome.measure(format!("left/nominal/{}", method.id), 100.0 * worst(|j| j.left.0));
        outcome.measure(format!("left/off/{}", method.id), 100.0 * worst(|j| j.left.1));
    }
    for plant in [Plant::Nominal, Plant::Off] {
        let won = all.iter().filter(|judged| METHODS[winner(judged, plant)].is_optimum()).count();
        outcome.measure(format!("wins/{}/any-optimum", plant.id()), won);
    }
    let pairs = [
        (Plant::Nominal, "optimum", "zv"),
        (Plant::Nominal, "optimum", "chain"),
        (Plant::Off, "optimum-double", "zvd"),
        (Plant::Off, "optimum-band", "zvd"),
        (Plant::Off, "optimum-band", "ei"),
    ];
    for (plant, by, over) in pairs {
        let (mean, median) = saved(all, plant, index(by)?, index(over)?);
        let name = format!("saved/{}/{by}-over-{over}", plant.id());
        outcome.measure(format!("{name}/mean"), 1e3 * mean);
        outcome.measure(format!("{name}/median"), 1e3 * median);
    }
    let optima = METHODS.iter().enumerate().filter(|(_, method)| method.is_optimum());
    for (n, method) in optima {
        let of = |found: Option<bool>| all.iter().filter(|judged| judged[n].proven == found).count();
        outcome.measure(format!("planned/proven/{}", method.id), of(Some(true)));
        outcome.measure(format!("planned/missing/{}", method.id), of(None));
    }
    let apart = all.iter().flatten().map(|judged| judged.disagreement).fold(0.0, f64::max);
    outcome.measure("simulation/disagreement", apart);
    Ok(())
}

/// The three tasks that were computed before, and one of them in pictures.
fn single_moves(context: &Context, outcome: &mut Outcome) -> Result<()> {
    let seed = context.seed;
    for (name, task) in computed()? {
        for (method, judged) in METHODS.iter().zip(judge(&task, seed)?) {
            if COMPUTED.contains(&method.id) {
                outcome.measure(format!("computed/{name}/{}", method.id), judged.duration);
            }
            outcome.measure(format!("{name}/nominal/{}", method.id), 1e3 * judged.nominal);
            outcome.measure(format!("{name}/off/{}", method.id), 1e3 * judged.off);
        }
        let (optimum, shaped) = two_modes(&task)?;
        outcome.measure(format!("computed/{name}/optimum-two-modes"), optimum);
        outcome.measure(format!("computed/{name}/zv-two-modes"), shaped);
    }
    let [(_, task), ..] = computed()?;
    outcome.figure(pictures::sensitivity(&task, seed, if context.quick { 40 } else { 400 })?);
    outcome.figure(pictures::jerk(&task, seed, &["s-curve", "optimum", "optimum-double", "optimum-band"])?);
    outcome.figure(pictures::courses(
        &task,
        seed,
        &["s-curve", "five-phase", "zv", "zvd", "chain", "optimum"],
    )?);
    Ok(())
}

/// What every method takes longer than the S-curve.
fn prices(context: &Context, outcome: &mut Outcome) -> Result<()> {
    let every = if context.quick { 12 } else { 2 };
    let tasks: Vec<Task> =
        (4..=40_u32).step_by(every).map(|hz| Task::new(0.1, f64::from(hz), 0.02)).collect::<Result<_>>()?;
    let durations = |task: &Task| -> Result<Vec<f64>> {
        METHODS
            .iter()
            .map(|method| judge::duration(method, task, context.seed))
            .collect::<Result<_>>()
            .with_context(|| format!("{task:?}"))
    };
    let durations: Vec<Vec<f64>> = tasks.par_iter().map(durations).collect::<Result<_>>()?;
    outcome.figure(pictures::price(&tasks, &durations)?);
    Ok(())
}

fn notes(outcome: &mut Outcome) {
    outcome.note(
        "A move is done when the load last comes within 0.1 % of its length of the target, counted from the start of the move: with a \
         slow end that may be before the command is at rest. With a plant that is off by 10 % the slower of both sides counts.",
    );
    outcome.note(
        "Limits of every command: 0.5 m/s, 5 m/s^2, 200 m/s^3; the snap-limited move 20 000 m/s^4 besides. Shapers, delay filter and \
         low-pass work on the S-curve. The axis is 10 kg of motor and 5 kg of load on a spring, driven by the force of the command \
         alone: only the mode counts, not the masses.",
    );
    outcome.note(
        "The time optimum is planned for the mode as told; with a double zero; or with at most 0.1 % left over all frequencies within \
         10 %. Its price is what the limits ask for, not half a period: shapers and chains convolve a finished move, the optimum sets \
         its switches anew. Alone it is no more robust than ZV. Where the load is slow to reach the band, a band's tolerance may be \
         worth more than the zero, and a fast mode needs nothing: there the S-curve is as good.",
    );
    outcome.note(
        "The five-phase curve is tuned by a swarm in one unknown, its phase time, the rest as fast as the limits allow; the low-pass \
         is of second order without a peak, its corner the best of 25. Both are judged on the axis as it is told, by what is \
         compared here. The delay filter's delay is 3/8 of a damped period; EI tolerates 5 % of the vibration of a step.",
    );
    outcome.note(
        "In the picture of the price the command behind the low-pass counts as at rest when the filter's own swing has fallen to \
         0.1 %, and a price below 0.1 ms is drawn there. EI is as long as ZVD.",
    );
}
