//! `expected.toml`: the rows of an experiment before it has run.
//!
//! ```
//! let rows = experiments::expected::parse(
//!     r#"
//!     [[row]]
//!     metric = "time/s-curve"
//!     unit = "s"
//!     source = "fig. 7"
//!     published = 0.07
//!     tolerance = { abs = 1e-9 }
//!     status = "match"
//!     figure = "fig7"
//!     "#,
//! )
//! .unwrap();
//! assert_eq!(rows[0].metric, "time/s-curve");
//! ```

use std::collections::BTreeMap;

use serde::Deserialize;
use thiserror::Error;

use crate::experiment::Outcome;
use crate::row::{Finding, Row, Status, Surprise, Tolerance, Value};

/// One `[[row]]` of `expected.toml`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// Lower-case words separated by slashes, unique in the file: `a-z`, `0-9`, `.`, `-`.
    pub metric: String,
    /// ASCII (`m/s^2`, `um`); left out for a pure number or a word.
    #[serde(default)]
    pub unit: String,
    /// Where in the paper: `fig. 7`, `table 2, row 3`.
    pub source: Option<String>,
    /// The paper's value.
    pub published: Option<Value>,
    /// Needed by `match` and `deviates`; under `ours` it bounds the README's number.
    pub tolerance: Option<Tolerance>,
    /// `match`, `deviates` or `ours`.
    pub status: Status,
    /// Needed by `deviates`.
    pub why: Option<String>,
    /// Our value as recorded, for a row that neither matches nor stands in the README: what is measured must be within
    /// the tolerance of an `ours` row, or within 1 %, of it; a word must be the same.
    pub ours: Option<Value>,
    /// Id of the figure the row is shown with.
    pub figure: Option<String>,
    /// Whether the README's table has the row; `true` unless it says otherwise.
    #[serde(default = "shown")]
    pub readme: bool,
}

fn shown() -> bool {
    true
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(default)]
    row: Vec<Expectation>,
}

/// What is wrong with an `expected.toml` or with the numbers measured for it.
#[derive(Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ExpectedError {
    /// Not the format.
    #[error("line {line}: {message}")]
    Toml {
        /// Counted from 1; 0 where the parser gives no place.
        line: usize,
        /// The parser's words.
        message: String,
    },
    /// Not lower-case words separated by slashes.
    #[error("metric '{0}' is not lower-case words (a-z, 0-9, '.', '-') separated by slashes")]
    Metric(String),
    /// Two rows of one name.
    #[error("metric '{0}' stands twice")]
    Twice(String),
    /// `deviates` without a reason.
    #[error("metric '{0}' deviates without a why")]
    NoWhy(String),
    /// `match` or `deviates` with nothing to compare with.
    #[error("metric '{0}' is to be compared and has no published value")]
    NoPublished(String),
    /// `match` or `deviates` without a tolerance.
    #[error("metric '{0}' is to be compared and has no tolerance")]
    NoTolerance(String),
    /// A tolerance that is no bound: negative, infinite, `exact = false`, or relative to zero or to a word.
    #[error("metric '{metric}': {tolerance:?} is no bound on {published:?}")]
    Tolerance {
        /// The row.
        metric: String,
        /// Its tolerance.
        tolerance: Tolerance,
        /// What it should bound.
        published: Option<Value>,
    },
    /// A row that nothing would hold: it does not match, and is neither in the README nor recorded.
    #[error(
        "metric '{0}' neither matches nor stands in the README, so it needs a recorded value: ours = ..."
    )]
    NotRecorded(String),
    /// A published or recorded number that is infinite or NaN.
    #[error("metric '{0}': the published or recorded value is not finite")]
    PublishedNotFinite(String),
    /// A row that the run gave no value for.
    #[error("nothing was measured for metric '{0}'")]
    NotMeasured(String),
    /// A measured value without a row.
    #[error("metric '{0}' was measured and has no row in expected.toml")]
    NotExpected(String),
    /// Two measured values of one name.
    #[error("metric '{0}' was measured twice")]
    MeasuredTwice(String),
    /// A measured number that is infinite or NaN.
    #[error("metric '{metric}' was measured as {value}")]
    NotFinite {
        /// The row.
        metric: String,
        /// What the run gave.
        value: f64,
    },
    /// A row shown with a figure that the run did not make.
    #[error("metric '{metric}' belongs to figure '{figure}', which was not made")]
    NoFigure {
        /// The row.
        metric: String,
        /// Its figure.
        figure: String,
    },
}

/// Reads and checks an `expected.toml`.
///
/// # Errors
/// The first thing wrong with the text; see [`ExpectedError`].
pub fn parse(text: &str) -> Result<Vec<Expectation>, ExpectedError> {
    let file: File = toml::from_str(text).map_err(|error| ExpectedError::Toml {
        line: error
            .span()
            .map_or(0, |span| text.bytes().take(span.start).filter(|byte| *byte == b'\n').count() + 1),
        message: error.message().to_owned(),
    })?;
    let mut seen = std::collections::BTreeSet::new();
    for row in &file.row {
        check(row)?;
        if !seen.insert(row.metric.as_str()) {
            return Err(ExpectedError::Twice(row.metric.clone()));
        }
    }
    Ok(file.row)
}

fn check(row: &Expectation) -> Result<(), ExpectedError> {
    let metric = || row.metric.clone();
    let word = |word: &str| {
        !word.is_empty() && word.bytes().all(|b| matches!(b, b'a'..=b'z' | b'0'..=b'9' | b'.' | b'-'))
    };
    if !row.metric.split('/').all(word) {
        return Err(ExpectedError::Metric(metric()));
    }
    if row.published.as_ref().and_then(Value::number).is_some_and(|x| !x.is_finite()) {
        return Err(ExpectedError::PublishedNotFinite(metric()));
    }
    if row.status == Status::Deviates && row.why.as_deref().is_none_or(|why| why.trim().is_empty()) {
        return Err(ExpectedError::NoWhy(metric()));
    }
    if row.status != Status::Ours && row.published.is_none() {
        return Err(ExpectedError::NoPublished(metric()));
    }
    if row.status != Status::Ours && row.tolerance.is_none() {
        return Err(ExpectedError::NoTolerance(metric()));
    }
    if row.ours.as_ref().and_then(Value::number).is_some_and(|x| !x.is_finite()) {
        return Err(ExpectedError::PublishedNotFinite(metric()));
    }
    if row.status != Status::Match && !row.readme && row.ours.is_none() {
        return Err(ExpectedError::NotRecorded(metric()));
    }
    let published = row.published.as_ref();
    let compared = row.status != Status::Ours;
    let bound = row.tolerance.is_none_or(|tolerance| match tolerance {
        Tolerance::Abs(abs) => {
            abs.is_finite() && abs >= 0.0 && (!compared || published.is_some_and(|p| p.number().is_some()))
        }
        Tolerance::Rel(rel) => {
            rel.is_finite()
                && rel >= 0.0
                && (!compared || published.and_then(Value::number).is_some_and(|p| p != 0.0))
        }
        Tolerance::AtLeast(bound) | Tolerance::AtMost(bound) => bound.is_finite(),
        Tolerance::Exact(exact) => exact,
    });
    match row.tolerance {
        Some(tolerance) if !bound => {
            Err(ExpectedError::Tolerance { metric: metric(), tolerance, published: row.published.clone() })
        }
        _ => Ok(()),
    }
}

/// Puts what a run measured beside what was expected, in the order of `expected`.
///
/// # Errors
/// A row without a value, a value without a row, a number that is not finite, or a row of a figure that was not made.
pub fn compare(
    experiment: &str,
    expected: &[Expectation],
    outcome: &Outcome,
) -> Result<Vec<Finding>, ExpectedError> {
    let mut measured = BTreeMap::new();
    for (metric, value) in &outcome.measured {
        if let Some(value) = value.number().filter(|x| !x.is_finite()) {
            return Err(ExpectedError::NotFinite { metric: metric.clone(), value });
        }
        if measured.insert(metric.as_str(), value).is_some() {
            return Err(ExpectedError::MeasuredTwice(metric.clone()));
        }
    }
    let mut findings = Vec::with_capacity(expected.len());
    for row in expected {
        let value = measured
            .remove(row.metric.as_str())
            .ok_or_else(|| ExpectedError::NotMeasured(row.metric.clone()))?;
        if let Some(figure) = &row.figure
            && !outcome.figures.iter().any(|made| made.id == *figure)
        {
            return Err(ExpectedError::NoFigure { metric: row.metric.clone(), figure: figure.clone() });
        }
        findings.push(find(experiment, row, value));
    }
    match measured.into_keys().next() {
        Some(metric) => Err(ExpectedError::NotExpected(metric.to_owned())),
        None => Ok(findings),
    }
}

/// Whether `value` is what was recorded as ours.
fn as_recorded(expected: &Expectation, ours: &Value, value: &Value) -> bool {
    let bound = match expected.tolerance {
        Some(tolerance) if expected.status == Status::Ours => tolerance,
        _ => Tolerance::Rel(crate::readme::SLACK),
    };
    ours == value || bound.holds(Some(ours), value)
}

fn find(experiment: &str, expected: &Expectation, value: &Value) -> Finding {
    let within = expected.tolerance.is_some_and(|t| t.holds(expected.published.as_ref(), value));
    let drifted = expected.ours.as_ref().is_some_and(|ours| !as_recorded(expected, ours, value));
    let (status, surprise) = match (expected.status, within) {
        (Status::Match, false) => (Status::Deviates, Some(Surprise::Left)),
        (Status::Deviates, true) => (Status::Match, Some(Surprise::NowMatches)),
        (status, _) => (status, drifted.then_some(Surprise::Drifted)),
    };
    let why = match (surprise, &expected.why) {
        (None, why) => why.clone(),
        (Some(surprise), None) => Some(format!("Not as expected: it {}.", surprise.words())),
        (Some(surprise), Some(why)) => Some(format!("Not as expected: it {}. {why}", surprise.words())),
    };
    Finding {
        row: Row {
            experiment: experiment.to_owned(),
            metric: expected.metric.clone(),
            unit: expected.unit.clone(),
            source: expected.source.clone(),
            published: expected.published.clone(),
            measured: Some(value.clone()),
            tolerance: expected.tolerance,
            status,
            why,
        },
        figure: expected.figure.clone(),
        readme: expected.readme,
        surprise,
    }
}
