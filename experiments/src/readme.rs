//! The results table in the README of the repository, written and checked by the bench.

use std::collections::BTreeMap;

use thiserror::Error;

use crate::bench::Results;
use crate::number;
use crate::row::{Finding, Row, Tolerance, Value};

/// The line before the table.
pub const BEGIN: &str = "<!-- results: begin -->";
/// The line after it.
pub const END: &str = "<!-- results: end -->";

/// What the README's number may be off by, in parts of ours, where the row has no tolerance that says it.
pub const SLACK: f64 = 0.01;

const HEAD: &str = "| experiment | result | unit | paper | ours | status |";
const NOTHING: &str = "–";

/// Why a README cannot be written or read.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum ReadmeError {
    /// One of the two comments is missing, stands twice, or they stand in the wrong order.
    #[error("README.md needs the lines '{BEGIN}' and '{END}', once each and in this order")]
    Markers,
}

/// `readme` with the table between the two comments replaced by one of `results`.
///
/// # Errors
/// The comments are not there.
pub fn rewrite(readme: &str, results: &Results<'_>) -> Result<String, ReadmeError> {
    let (before, _, after) = split(readme)?;
    let mut text = format!("{before}{BEGIN}\n{HEAD}\n|---|---|---|---:|---:|---|\n");
    for finding in results.findings().filter(|finding| finding.readme) {
        let row = &finding.row;
        let cells = [
            row.experiment.clone(),
            format!("`{}`", row.metric),
            number::pretty_unit(&row.unit),
            row.published.as_ref().map_or(NOTHING.to_owned(), |value| cell(&value.published())),
            row.measured.as_ref().map_or(NOTHING.to_owned(), |value| cell(&value.measured())),
            row.status.word().to_owned(),
        ];
        text.push_str(&format!("| {} |\n", cells.join(" | ")));
    }
    Ok(text + END + after)
}

/// What the README says that the bench does not, one line each; none where they agree.
///
/// Numbers are compared, not text: the paper's as printed, ours within the row's tolerance, or within [`SLACK`] where that
/// is no distance, and half a digit of the print. Only the experiments in `results` are looked at.
///
/// # Errors
/// The comments are not there.
pub fn check(readme: &str, results: &Results<'_>) -> Result<Vec<String>, ReadmeError> {
    let (_, table, _) = split(readme)?;
    let mut rows: BTreeMap<(String, String), [String; 3]> = BTreeMap::new();
    let mut problems = Vec::new();
    for line in table
        .lines()
        .map(str::trim)
        .filter(|line| line.starts_with('|') && *line != HEAD && !line.starts_with("|---"))
    {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [experiment, metric, _, paper, ours, status] = cells.as_slice() else {
            problems.push(format!("README.md: not six cells: {line}"));
            continue;
        };
        let key = ((*experiment).to_owned(), metric.trim_matches('`').to_owned());
        if rows.insert(key, [*paper, *ours, *status].map(str::to_owned)).is_some() {
            problems.push(format!("README.md: {experiment} {metric} stands twice"));
        }
    }
    for finding in results.findings().filter(|finding| finding.readme) {
        let key = (finding.row.experiment.clone(), finding.row.metric.clone());
        match rows.remove(&key) {
            Some(cells) => problems.extend(differences(finding, &cells)),
            None => problems.push(format!("README.md: no row {} {}; run 'readme'", key.0, key.1)),
        }
    }
    let ran = |id: &str| results.sections.iter().any(|section| section.experiment.id == id);
    for (experiment, metric) in rows.into_keys().filter(|(experiment, _)| ran(experiment)) {
        problems.push(format!("README.md: row {experiment} {metric} is not made by the bench"));
    }
    Ok(problems)
}

fn differences(finding: &Finding, [paper, ours, status]: &[String; 3]) -> Vec<String> {
    let row = &finding.row;
    let mut problems = Vec::new();
    let mut differ = |what: &str, theirs: &str, our_text: String| {
        let name = format!("{} {}", row.experiment, row.metric);
        problems.push(format!("README.md: {name}: {what} is '{theirs}', the bench has '{our_text}'"));
    };
    let text =
        |value: &Option<Value>, show: fn(&Value) -> String| value.as_ref().map_or(NOTHING.to_owned(), show);
    if !agrees(paper, row.published.as_ref(), |x| 1e-12 * x.abs()) {
        differ("the paper's value", paper, text(&row.published, Value::published));
    }
    if !agrees(ours, row.measured.as_ref(), |x| slack(row, x)) {
        differ("ours", ours, text(&row.measured, Value::measured));
    }
    if status != row.status.word() {
        differ("the status", status, row.status.word().to_owned());
    }
    problems
}

/// The distance from ours, `x`, within which the README's number must be.
fn slack(row: &Row, x: f64) -> f64 {
    let distance = match row.tolerance {
        Some(Tolerance::Abs(abs)) => abs,
        Some(Tolerance::Rel(rel)) => rel * row.published.as_ref().and_then(Value::number).unwrap_or(x).abs(),
        Some(Tolerance::Exact(_)) => 0.0,
        Some(Tolerance::AtLeast(_) | Tolerance::AtMost(_)) | None => SLACK * x.abs(),
    };
    // One part in 1e9 of the digit: a number printed exactly half a digit off is not a mistake.
    distance + (1.0 + 1e-9) * number::half_digit(x)
}

fn agrees(text: &str, value: Option<&Value>, slack: impl Fn(f64) -> f64) -> bool {
    match value {
        None => text == NOTHING,
        Some(Value::Text(word)) => text == cell(word),
        Some(Value::Number(x)) => text.parse::<f64>().is_ok_and(|printed| (printed - x).abs() <= slack(*x)),
    }
}

/// A word in a table: no bar, no line break.
fn cell(text: &str) -> String {
    text.replace(['|', '\n'], "/")
}

fn split(readme: &str) -> Result<(&str, &str, &str), ReadmeError> {
    let (before, rest) = readme.split_once(BEGIN).ok_or(ReadmeError::Markers)?;
    let (table, after) = rest.split_once(END).ok_or(ReadmeError::Markers)?;
    let again = [before, table, after].iter().any(|part| part.contains(BEGIN) || part.contains(END));
    if again { Err(ReadmeError::Markers) } else { Ok((before, table, after)) }
}
