//! What is wrong with a log or with what is asked of it, in one line, with the line or the number.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

/// Why a log cannot be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LogFileError {
    /// The system refused.
    #[error("cannot read {}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
    /// A text in two bytes to a letter.
    #[error("the log is no text, or text in UTF-16: save it as UTF-8")]
    Utf16,
    /// Nothing but comments and empty lines.
    #[error("the log has no lines of data")]
    Empty,
    /// A line of data that does not fall into columns.
    #[error("line {line} is one column only: columns are separated by commas, semicolons or tabs")]
    OneColumn {
        /// The line, from one.
        line: u64,
    },
    /// No column of this name or number.
    #[error("{problem} '{wanted}' for the {role}: there {}; --{role} takes a name or a number from 1", listed(.there))]
    Column {
        /// `no column` or `more than one column`.
        problem: &'static str,
        /// What was looked for.
        wanted: String,
        /// `time`, `command` or `response`.
        role: &'static str,
        /// The names of the columns, or their numbers where there is no header.
        there: Vec<String>,
    },
    /// A line that cannot be used.
    #[error("line {line}: {problem}; --skip-irregular leaves such lines out")]
    Line {
        /// The line, from one.
        line: u64,
        /// What is wrong with it.
        problem: LineProblem,
    },
    /// Fewer samples than anything can be said of.
    #[error("the log has {0} samples, at least 64 are needed")]
    TooShort(usize),
    /// Samples are missing.
    #[error(
        "no samples from {from} s to {to} s, where they are {period} s apart else: use --from and --to for a part \
         without a gap"
    )]
    Gap {
        /// The last sample before the gap, s.
        from: f64,
        /// The first one after it, s.
        to: f64,
        /// Median distance of samples, s.
        period: f64,
    },
}

fn listed(there: &[String]) -> String {
    const MOST: usize = 12;
    let named: Vec<String> = there.iter().take(MOST).map(|name| format!("'{name}'")).collect();
    let more = if there.len() > MOST { ", ..." } else { "" };
    match named.len() {
        0 => "is none".to_owned(),
        1 => format!("is {}", named.join("")),
        _ => format!("are {}{more}", named.join(", ")),
    }
}

/// What is wrong with a line.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LineProblem {
    /// Too few or too many fields.
    #[error("{found} fields where there are {expected} columns")]
    Fields {
        /// Fields of the line.
        found: usize,
        /// Columns of the log.
        expected: usize,
    },
    /// Text where a number belongs.
    #[error("'{text}' in column '{column}' is not a number")]
    NotANumber {
        /// Name of the column.
        column: String,
        /// What stands there.
        text: String,
    },
    /// An infinity or NaN.
    #[error("'{text}' in column '{column}' is not a finite number")]
    NotFinite {
        /// Name of the column.
        column: String,
        /// What stands there.
        text: String,
    },
    /// A time that is not after the one before.
    #[error("the time {time} s is not after {before} s, the one before")]
    Time {
        /// The time, s.
        time: f64,
        /// The time before, s.
        before: f64,
    },
}
