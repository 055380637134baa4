//! Runs experiments and puts what they measured beside what was expected.

use anyhow::{Context as _, Result, anyhow, ensure};

use crate::expected;
use crate::experiment::{Context, Experiment, Outcome};
use crate::progress::Progress;
use crate::row::Finding;

/// One experiment after its run.
#[derive(Clone, Debug)]
pub struct Section<'a> {
    /// What was run.
    pub experiment: &'a Experiment,
    /// What it made.
    pub outcome: Outcome,
    /// Its rows, in the order of `expected.toml`; none after a quick run.
    pub findings: Vec<Finding>,
}

/// How experiments are run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setting {
    /// The seed of every random number, or the first of several.
    pub seed: u64,
    /// How many seeds the searches that compare several are run with.
    pub seeds: u64,
    /// Whether runs are shortened.
    pub quick: bool,
}

impl Default for Setting {
    /// What a run, a check and the README take that are told nothing: one seed, 1, in full.
    fn default() -> Self {
        Self { seed: 1, seeds: 1, quick: false }
    }
}

/// Everything a run made.
#[derive(Clone, Debug)]
pub struct Results<'a> {
    /// How it was run.
    pub setting: Setting,
    /// In the order of the registry.
    pub sections: Vec<Section<'a>>,
}

impl Results<'_> {
    /// All rows of all experiments.
    pub fn findings(&self) -> impl Iterator<Item = &Finding> {
        self.sections.iter().flat_map(|section| &section.findings)
    }
}

/// Runs `experiments` one after the other.
///
/// All of them are run, also after one has failed.
///
/// # Errors
/// What went wrong, in all experiments that failed, each after its id.
pub fn run<'a>(experiments: &[&'a Experiment], setting: Setting) -> Result<Results<'a>> {
    let mut sections = Vec::with_capacity(experiments.len());
    let mut failures = Vec::new();
    for experiment in experiments {
        match run_one(experiment, setting) {
            Ok(section) => sections.push(section),
            Err(error) => failures.push(format!("{}: {error:#}", experiment.id)),
        }
    }
    if failures.is_empty() { Ok(Results { setting, sections }) } else { Err(anyhow!(failures.join("; "))) }
}

fn run_one<'a>(experiment: &'a Experiment, setting: Setting) -> Result<Section<'a>> {
    // Before the run, which may be long.
    let expected = expected::parse(experiment.expected).context("expected.toml")?;
    let Setting { seed, seeds, quick } = setting;
    let context = Context { seed, seeds, quick, progress: Progress::start(experiment.id) };
    let outcome = (experiment.run)(&context);
    context.progress.finish(if outcome.is_ok() { "done" } else { "failed" });
    let outcome = outcome?;
    for (n, figure) in outcome.figures.iter().enumerate() {
        figure.check()?;
        let twice = outcome.figures.iter().skip(n + 1).any(|other| other.id == figure.id);
        ensure!(!twice, "two figures '{}'", figure.id);
    }
    let findings = if quick { Vec::new() } else { expected::compare(experiment.id, &expected, &outcome)? };
    Ok(Section { experiment, outcome, findings })
}
