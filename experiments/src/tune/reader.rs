//! Reads a log: three columns of numbers out of a table.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use csv::ByteRecord;

use super::columns::{Columns, Layout, cells, number, separator};
use super::error::{LineProblem, LogFileError};

/// A log as it was written.
#[derive(Clone, Debug, PartialEq)]
pub struct LogFile {
    /// Times in s, increasing.
    pub time: Vec<f64>,
    /// Commands.
    pub command: Vec<f64>,
    /// Responses.
    pub response: Vec<f64>,
    /// Names of the three columns.
    pub names: [String; 3],
    /// Lines that were left out, from one, with what is wrong with them; the first hundred.
    pub irregular: Vec<(u64, LineProblem)>,
    /// How many were left out.
    pub left_out: usize,
}

/// How a log is read.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The columns.
    pub columns: Columns,
    /// Seconds to a unit of the time column; none for what its header says, else one.
    pub time_unit: Option<f64>,
    /// Whether lines that cannot be used are left out.
    pub skip_irregular: bool,
}

/// Lines before the data: comments, empty ones and the header.
struct Head {
    header: Option<String>,
    /// The first line that is neither comment nor empty.
    first: String,
    /// Its number, from one.
    line: u64,
}

/// Reads the file at `path`.
///
/// Lines that begin with `#` are comments. The header is the first line that is none, where it holds a text in a wanted
/// column; else the last comment before the data, where it has as many columns as they.
///
/// # Errors
/// A file that cannot be read, columns that are not there, and the first line that cannot be used unless such lines are
/// to be left out.
pub fn read(path: &Path, reading: &Reading) -> Result<LogFile, LogFileError> {
    let io = |source| LogFileError::Io { path: path.to_owned(), source };
    let mut reader = BufReader::with_capacity(1 << 16, File::open(path).map_err(io)?);
    let head = head(&mut reader).map_err(io)?.ok_or(LogFileError::Empty)?;
    if head.first.starts_with('\u{FFFE}') || head.first.contains('\0') {
        return Err(LogFileError::Utf16);
    }
    let separator = separator(&head.first).ok_or(LogFileError::OneColumn { line: head.line })?;
    let first = cells(&head.first, separator);
    let is_header = first.iter().all(|cell| number(cell, separator).is_none());
    let comment = head.header.as_deref().map(|comment| cells(comment, separator));
    let comment = comment.filter(|comment| comment.len() == first.len());
    let header = if is_header { Some(first.as_slice()) } else { comment.as_deref() };
    let layout = Layout::of(header, &first, separator, &reading.columns)?;

    let unit = reading.time_unit.or(layout.time_unit).unwrap_or(1.0);
    let names = layout.names.clone();
    let mut log = LogFile {
        time: Vec::new(),
        command: Vec::new(),
        response: Vec::new(),
        names,
        irregular: Vec::new(),
        left_out: 0,
    };
    let again = if is_header { "" } else { head.first.as_str() };
    let before = if is_header { head.line } else { head.line - 1 };
    let mut table = csv::ReaderBuilder::new()
        .delimiter(separator)
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .from_reader(again.as_bytes().chain(reader));
    let mut record = ByteRecord::new();
    while table.read_byte_record(&mut record).map_err(|error| io(error.into()))? {
        let line = before + record.position().map_or(0, csv::Position::line);
        let previous = log.time.last().copied();
        match sample(&record, &layout, unit, previous) {
            Ok(None) => {}
            Ok(Some([time, command, response])) => {
                log.time.push(time);
                log.command.push(command);
                log.response.push(response);
            }
            Err(problem) if reading.skip_irregular => {
                const SHOWN: usize = 100;
                log.left_out += 1;
                if log.irregular.len() < SHOWN {
                    log.irregular.push((line, problem));
                }
            }
            Err(problem) => return Err(LogFileError::Line { line, problem }),
        }
    }
    if log.time.is_empty() { Err(LogFileError::Empty) } else { Ok(log) }
}

/// Reads up to the first line that is neither comment nor empty.
fn head(reader: &mut impl BufRead) -> std::io::Result<Option<Head>> {
    let (mut header, mut line, mut bytes) = (None, 0, Vec::new());
    loop {
        bytes.clear();
        // A file without line breaks is not read whole for its head.
        if reader.by_ref().take(1 << 20).read_until(b'\n', &mut bytes)? == 0 {
            return Ok(None);
        }
        line += 1;
        if bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]) {
            return Ok(Some(Head { header, first: '\u{FFFE}'.to_string(), line }));
        }
        let text = String::from_utf8_lossy(&bytes);
        let text = text.trim_start_matches('\u{FEFF}');
        match text.trim_start().strip_prefix('#') {
            Some(comment) => header = Some(comment.trim_end_matches(['\r', '\n']).to_owned()),
            None if text.trim().is_empty() => {}
            None => return Ok(Some(Head { header, first: text.to_owned(), line })),
        }
    }
}

/// Time, command and response of a line; none of one that is blank.
fn sample(
    record: &ByteRecord,
    layout: &Layout,
    unit: f64,
    before: Option<f64>,
) -> Result<Option<[f64; 3]>, LineProblem> {
    if record.len() == 1 && record.get(0).is_some_and(|field| field.trim_ascii().is_empty()) {
        return Ok(None);
    }
    if record.len() != layout.width {
        return Err(LineProblem::Fields { found: record.len(), expected: layout.width });
    }
    let mut sample = [0.0; 3];
    for ((value, at), name) in sample.iter_mut().zip(layout.at).zip(&layout.names) {
        let text = String::from_utf8_lossy(record.get(at).unwrap_or_default());
        let (column, text) = (name.clone(), text.trim());
        let shown = || text.chars().take(40).collect::<String>();
        *value = number(text, layout.separator)
            .ok_or_else(|| LineProblem::NotANumber { column: column.clone(), text: shown() })?;
        if !value.is_finite() {
            return Err(LineProblem::NotFinite { column, text: shown() });
        }
    }
    sample[0] *= unit;
    match before {
        Some(before) if sample[0] <= before => Err(LineProblem::Time { time: sample[0], before }),
        _ => Ok(Some(sample)),
    }
}
