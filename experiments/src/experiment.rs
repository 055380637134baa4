//! What an experiment is, what it is given and what it returns.

use crate::figure::Figure;
use crate::progress::Progress;
use crate::row::Value;

/// A paper or study: what the report says about it, what is published, and how to compute ours.
#[derive(Clone, Copy, Debug)]
pub struct Experiment {
    /// Name on the command line and of its folder in the report: `a-z`, `0-9` and `-`.
    pub id: &'static str,
    /// One line.
    pub title: &'static str,
    /// Authors, title, venue, year and DOI where there is one; empty for a study of our own.
    pub citation: &'static str,
    /// The files that compute it, copied into the report beside the figures.
    pub sources: &'static [Source],
    /// Text of its `expected.toml`, see [`crate::expected`].
    pub expected: &'static str,
    /// The figure, if any, that `readme` copies into `docs/`.
    pub readme_figure: Option<&'static str>,
    /// Computes every figure and every number.
    pub run: fn(&Context) -> anyhow::Result<Outcome>,
}

/// A source file as it was when the bench was built.
#[derive(Clone, Copy, Debug)]
pub struct Source {
    /// Path from the root of the repository: `file!()`.
    pub path: &'static str,
    /// Its text: `include_str!`.
    pub text: &'static str,
}

impl Source {
    /// Name of its copy in the report; a text file, so that a browser shows it.
    #[must_use]
    pub fn copy_name(&self) -> String {
        let path = self.path.replace('\\', "/");
        let below = path.strip_prefix("experiments/src/").unwrap_or(&path);
        format!("{}.txt", below.replace('/', "-"))
    }
}

/// What an experiment is given.
#[derive(Debug)]
pub struct Context {
    /// Seed of every random number.
    pub seed: u64,
    /// How many seeds, from that one on, to run a search with where results are compared over several.
    pub seeds: u64,
    /// Shorten the run; its numbers are not compared with anything.
    pub quick: bool,
    /// Where to say how far the run is.
    pub progress: Progress,
}

/// What an experiment returns.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// Figures, in the order of the report.
    pub figures: Vec<Figure>,
    /// Metric id and our value; a full run gives one for every row of `expected.toml` and no other.
    pub measured: Vec<(String, Value)>,
    /// Assumptions and remarks, one sentence or two each.
    pub notes: Vec<String>,
}

impl Outcome {
    /// Adds a figure.
    pub fn figure(&mut self, figure: Figure) {
        self.figures.push(figure);
    }

    /// Adds a number or a word for the row named `metric`.
    pub fn measure(&mut self, metric: impl Into<String>, value: impl Into<Value>) {
        self.measured.push((metric.into(), value.into()));
    }

    /// Adds a remark.
    pub fn note(&mut self, note: impl Into<String>) {
        self.notes.push(note.into());
    }
}
