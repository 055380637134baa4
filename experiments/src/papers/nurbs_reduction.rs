//! Nan and Zhang 2013: the degree of a curve reduced by a swarm with a genetic pool, and the reduced curve driven.

mod curves;
mod path;
mod pictures;
mod search;

use anyhow::Result;
use optimize::reduction::Freed;
use profiles::nurbs::{CoordinateList, NurbsCurve};

use self::curves::{Named, Shape, read};
use self::path::{Driven, drive_planar, drive_spatial, interpolate};
use self::search::{Compared, METHODS, SETTINGS, compare, median};
use crate::experiment::{Context, Experiment, Outcome, Source};
use crate::figure::Role;

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    id: "nurbs-reduction",
    title: "From a curve to pulses: degree reduction by a swarm with a genetic pool",
    citation: "Nan Y., Zhang X., Motion control system for NURBS curve degree reduction and interpolation, patent CN103345201A \
               (2013, in Chinese)",
    sources: &[
        Source { path: file!(), text: include_str!("nurbs_reduction.rs") },
        Source { path: curves::FILE, text: include_str!("nurbs_reduction/curves.rs") },
        Source { path: search::FILE, text: include_str!("nurbs_reduction/search.rs") },
        Source { path: path::FILE, text: include_str!("nurbs_reduction/path.rs") },
        Source { path: pictures::FILE, text: include_str!("nurbs_reduction/pictures.rs") },
    ],
    expected: include_str!("../../papers/nurbs-reduction/expected.toml"),
    readme_figure: None,
    run,
};

/// The curve that is reduced under every setting.
const EVERY_SETTING: &str = "knotted";
/// The setting of the others.
const SETTING: &str = "points-weights";

fn run(context: &Context) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let curves = read()?;
    context.progress.steps(curves.len() as u64);
    for named in &curves {
        context.progress.say(&named.id);
        match &named.shape {
            Shape::Planar(curve) => carry(named, curve, drive_planar, context, &mut outcome)?,
            Shape::Spatial(curve) => carry(named, curve, drive_spatial, context, &mut outcome)?,
        }
        context.progress.step();
    }
    outcome.note(
        "The patent gives no curve, figure or number. The curves are ours, in curves.toml; arc and circle are raised before they \
         are reduced, so that a reduction exists that leaves nothing.",
    );
    outcome.note(
        "Its step 8 returns to the random start, which would throw the swarm away: it returns to the evaluation. Its rules and \
         rates of crossing and mutation, its bounds and its sampling are not given; ours are those of GeneticOptions, but for the \
         mates, which are from the pool, as published. Results scatter from seed to seed, by a factor of two on some curves: \
         one seed does not rank the searches, --seeds N does. They look at 201 parameters, the deviation in the rows is \
         certified between them.",
    );
    outcome.note(
        "The three searches evaluate equally often: the swarm has 1500 iterations, the genetic algorithm 3000 generations of 200 \
         children, the hybrid 1000 iterations with 200 children each.",
    );
    Ok(outcome)
}

type DriveAlong<const D: usize> = fn(&CoordinateList<D>, &NurbsCurve<D>) -> Result<Driven>;

/// One curve: reduced in every way, the deterministic reduction interpolated and driven.
fn carry<const D: usize>(
    named: &Named,
    curve: &NurbsCurve<D>,
    drive: DriveAlong<D>,
    context: &Context,
    outcome: &mut Outcome,
) -> Result<()> {
    let id = &named.id;
    let seeds = context.seed..context.seed + context.seeds;
    for (setting, freed) in SETTINGS {
        if setting != SETTING && id != EVERY_SETTING {
            continue;
        }
        let compared = compare(curve, named.to, freed, seeds.clone(), context.quick)?;
        let place = if setting == SETTING { id.clone() } else { format!("{id}/{setting}") };
        measure(&place, &compared, outcome);
        let words = setting.replace('-', ", ");
        let title = format!("Degree {} to {} of {}, free: {words}", curve.degree(), named.to, named.title);
        let figure =
            if setting == SETTING { format!("search-{id}") } else { format!("search-{id}-{setting}") };
        outcome.figure(pictures::convergence(&figure, &title, &compared));
        if freed == Freed::PointsAndWeights {
            interpolated(named, curve, &compared, drive, outcome)?;
        }
        let [swarm, genetic, hybrid] = &compared.searches;
        let seconds = |runs: &[search::Searched<D>]| median(runs.iter().map(|run| run.time.as_secs_f64()));
        outcome.note(format!(
            "{place}: the deterministic way took {:.2} ms, swarm {:.2} s, genetic algorithm {:.2} s, hybrid {:.2} s on the \
             machine of this report. No curve with these knots and weights in their box deviates by less than {:.4} um.",
            1e3 * compared.time.as_secs_f64(),
            seconds(swarm),
            seconds(genetic),
            seconds(hybrid),
            1e6 * compared.deterministic.optimum
        ));
    }
    Ok(())
}

fn measure<const D: usize>(place: &str, compared: &Compared<D>, outcome: &mut Outcome) {
    for (method, runs) in METHODS.into_iter().zip(&compared.searches) {
        let largest = median(runs.iter().map(|run| 1e6 * run.deviation));
        outcome.measure(format!("reduction/{place}/{method}/max-error"), largest);
        let evaluations = median(runs.iter().map(|run| run.evaluations as f64));
        outcome.measure(format!("reduction/{place}/{method}/evaluations"), evaluations);
    }
    let found = &compared.deterministic;
    outcome.measure(format!("reduction/{place}/deterministic/max-error"), 1e6 * found.deviation.at_most);
    outcome.measure(format!("reduction/{place}/deterministic/evaluations"), 0.0);
}

/// The reduced curve as a path.
fn interpolated<const D: usize>(
    named: &Named,
    curve: &NurbsCurve<D>,
    compared: &Compared<D>,
    drive: DriveAlong<D>,
    outcome: &mut Outcome,
) -> Result<()> {
    let (id, title) = (&named.id, &named.title);
    let reduced = &compared.deterministic;
    let mut drawn = vec![("deterministic", Role::Ours, &reduced.curve, reduced.deviation.at_most)];
    let [.., hybrid] = &compared.searches;
    drawn.extend(hybrid.first().map(|run| ("hybrid", Role::Second, &run.curve, run.deviation)));
    outcome.figure(pictures::overlay(
        &format!("curve-{id}"),
        &format!("The reductions of {title}"),
        curve,
        &drawn,
    ));

    let path = interpolate(&reduced.curve)?;
    let driven = drive(&path.list, &reduced.curve)?;
    outcome.measure(format!("interpolation/{id}/chord-error"), 1e6 * path.report.chord_error.value);
    outcome.measure(format!("interpolation/{id}/feed-fluctuation"), path.report.fluctuation.value);
    outcome.measure(format!("interpolation/{id}/pulse-error"), 1e6 * driven.pulse_error);
    outcome.measure(format!("interpolation/{id}/contour-error"), 1e6 * driven.largest());
    outcome.measure(format!("interpolation/{id}/at-limit"), path.report.at_limit);
    outcome.figure(pictures::feed(
        &format!("feed-{id}"),
        &format!("Feed along the reduction of {title}"),
        &path,
    ));
    let title = format!("The mechanism along the reduction of {title}");
    outcome.figure(pictures::driven(&format!("drive-{id}"), &title, &driven));
    Ok(())
}
