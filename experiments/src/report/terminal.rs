//! The table at the end of a run.

use crate::bench::Results;
use crate::number::pretty_unit;
use crate::row::{Finding, Status};

/// The table as text, an experiment after the other, and a line that counts; empty where there are no rows.
#[must_use]
pub fn table(results: &Results<'_>) -> String {
    let mut text = String::new();
    for section in results.sections.iter().filter(|section| !section.findings.is_empty()) {
        let head =
            [section.experiment.id, "paper", "ours", "error", "tolerance", "status"].map(str::to_owned);
        let lines: Vec<[String; 6]> =
            std::iter::once(head).chain(section.findings.iter().map(cells)).collect();
        text.push_str(&aligned(&lines));
        text.push('\n');
    }
    if !text.is_empty() {
        text.push_str(&counts(results));
        text.push('\n');
    }
    text
}

/// `12 rows: 9 match, 2 deviate, 1 ours`, and how many are not as expected.
#[must_use]
pub fn counts(results: &Results<'_>) -> String {
    let count = |status| results.findings().filter(|f| f.row.status == status).count();
    let rows = results.findings().count();
    let surprises = results.findings().filter(|f| f.surprise.is_some()).count();
    let mut text = format!(
        "{rows} row{}: {} match, {} deviate, {} ours",
        if rows == 1 { "" } else { "s" },
        count(Status::Match),
        count(Status::Deviates),
        count(Status::Ours),
    );
    if surprises > 0 {
        text.push_str(&format!("; {surprises} not as expected"));
    }
    text
}

fn cells(finding: &Finding) -> [String; 6] {
    let row = &finding.row;
    let unit = pretty_unit(&row.unit);
    let metric = if unit.is_empty() { row.metric.clone() } else { format!("{} [{unit}]", row.metric) };
    let status = match finding.surprise {
        Some(_) => format!("{} (!)", row.status.word()),
        None => row.status.word().to_owned(),
    };
    [
        format!("  {metric}"),
        row.published.as_ref().map_or("-".to_owned(), |value| value.published()),
        row.measured.as_ref().map_or("-".to_owned(), |value| value.measured()),
        row.error().unwrap_or_default(),
        row.tolerance.map_or(String::new(), |tolerance| tolerance.show(&row.unit)),
        status,
    ]
}

/// Columns two spaces apart, the numbers to the right.
fn aligned(lines: &[[String; 6]]) -> String {
    let mut widths = [0; 6];
    for line in lines {
        for (width, cell) in widths.iter_mut().zip(line) {
            *width = cell.chars().count().max(*width);
        }
    }
    let mut text = String::new();
    for line in lines {
        let mut row = String::new();
        for (column, (cell, width)) in line.iter().zip(widths).enumerate() {
            let cell = if (1..4).contains(&column) {
                format!("{cell:>width$}  ")
            } else {
                format!("{cell:<width$}  ")
            };
            row.push_str(&cell);
        }
        text.push_str(row.trim_end());
        text.push('\n');
    }
    text
}
