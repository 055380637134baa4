//! `summary.json`: every row, for other programs.

use anyhow::Result;
use serde::{Deserialize, Serialize};

use crate::bench::Results;
use crate::row::Row;

/// The whole file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Summary {
    /// [`GENERATED_BY`].
    pub generated_by: String,
    /// The seed of the run.
    pub seed: u64,
    /// In the order of the registry and of each `expected.toml`; empty after a quick run.
    pub rows: Vec<Row>,
}

/// Program and version; a folder whose summary begins with the program's name is a report.
pub const GENERATED_BY: &str = concat!("stillpoint experiments ", env!("CARGO_PKG_VERSION"));
const PROGRAM: &str = "stillpoint experiments ";

/// The text of `summary.json`; the same run gives the same bytes.
///
/// # Errors
/// None that a run can cause: every number in a row is finite.
pub fn json(results: &Results<'_>) -> Result<String> {
    let rows = results.findings().map(|finding| finding.row.clone()).collect();
    let summary = Summary { generated_by: GENERATED_BY.to_owned(), seed: results.setting.seed, rows };
    Ok(serde_json::to_string_pretty(&summary)? + "\n")
}

/// Whether `text` is the summary of a report, of this version or another.
#[must_use]
pub fn is_ours(text: &str) -> bool {
    #[derive(Deserialize)]
    struct Head {
        generated_by: String,
    }
    serde_json::from_str(text).is_ok_and(|head: Head| head.generated_by.starts_with(PROGRAM))
}
