//! `experiments tune LOG.csv`: from a person's log to modes, a move and a shaper.
//!
//! It reads the log, calls `identify` and `optimize`, and shows what they say; it decides nothing itself.

mod analysis;
mod columns;
mod error;
mod figures;
mod page;
mod parameters;
mod reader;
mod sampling;
mod words;

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use identify::Route;
use optimize::MoveKind;
use profiles::{Limits, Profile, write_csv};
use thiserror::Error;

pub use analysis::{Plan, Question, Tuning, Wanted, tune};
pub use columns::Columns;
pub use error::{LineProblem, LogFileError};
pub use parameters::{About, json};
pub use reader::{LogFile, Reading, read};
pub use sampling::{Sampled, evenly};

use crate::report::folder::Staging;
use crate::report::{PAGE, PARAMETERS, put, write_figure};

/// Name of the recommended move's table.
pub const MOVE: &str = "move-table.csv";

/// What `experiments tune` takes.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The log: a table with columns separated by commas, semicolons or tabs; lines that begin with # are comments
    log: PathBuf,
    /// Column of the time: its name, with or without the unit behind it, or its number from 1
    #[arg(long, value_name = "COLUMN", default_value = "time")]
    time: String,
    /// Column of the command
    #[arg(long, value_name = "COLUMN", default_value = "command")]
    command: String,
    /// Column of the response
    #[arg(long, value_name = "COLUMN", default_value = "response")]
    response: String,
    /// Unit of the time column [default: what its header says, else s]
    #[arg(long, value_name = "UNIT")]
    time_unit: Option<TimeUnit>,
    /// Only samples from this time on, s
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    from: Option<f64>,
    /// Only samples up to this time, s
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    to: Option<f64>,
    /// Leaves out lines that cannot be used, and says which
    #[arg(long)]
    skip_irregular: bool,
    /// Where modes are looked for
    #[arg(long, value_name = "METHOD", default_value = "either")]
    method: Method,
    /// Length of the move to recommend, in the unit of the command; needs the three limits
    #[arg(long, value_name = "D", allow_negative_numbers = true)]
    distance: Option<f64>,
    /// Largest velocity of the move, in the unit of the command per second
    #[arg(long, value_name = "V")]
    max_velocity: Option<f64>,
    /// Largest acceleration of the move
    #[arg(long, value_name = "A")]
    max_acceleration: Option<f64>,
    /// Largest jerk of the move
    #[arg(long, value_name = "J")]
    max_jerk: Option<f64>,
    /// Amplitude of vibration that counts as rest, in the unit of the response [default: a thousandth of the move]
    #[arg(long, value_name = "X")]
    tolerated_vibration: Option<f64>,
    /// Part of the vibration of a step that a shaper may leave
    #[arg(long, value_name = "PART", default_value_t = 0.05)]
    tolerated_part: f64,
    /// Standard deviations of frequency and damping to reckon with
    #[arg(long, value_name = "N", default_value_t = 3.0)]
    deviations: f64,
    /// Time between rows of the move's table, s [default: that between samples of the log]
    #[arg(long, value_name = "S")]
    tick: Option<f64>,
    /// Folder of the report [default: target/tune of the workspace]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// A unit of time.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum TimeUnit {
    S,
    Ms,
    Us,
    Ns,
}

/// Where modes are looked for.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Method {
    /// In what goes on swinging while the command rests; where nothing does, in the transfer function
    Either,
    /// In what goes on swinging while the command rests
    FreeDecay,
    /// In the transfer function from command to response
    TransferFunction,
}

/// A request that cannot be met, apart from the log: exit code 2.
#[derive(Debug, Error)]
#[error("{0}")]
pub struct RequestError(String);

/// Reads the log, tunes, and writes the report; the exit code is 0.
///
/// # Errors
/// A log that cannot be read, one without modes, a request that makes no sense, a folder that cannot be written.
pub fn run(arguments: &Arguments, root: &Path, typed: &str, out: &mut dyn Write) -> Result<u8> {
    let question = arguments.question()?;
    let target = arguments.out.clone().unwrap_or_else(|| root.join("target").join("tune"));
    // Opened before the work: what cannot be written is known at once.
    let staging = Staging::open(&target)?;
    let name = arguments.log.file_name().unwrap_or(arguments.log.as_os_str()).to_string_lossy().into_owned();
    let log = read(&arguments.log, &arguments.reading()).with_context(|| name.clone())?;
    let sampled = evenly(&log, arguments.from, arguments.to).with_context(|| name.clone())?;
    let mut tuning = tune(sampled, &question).with_context(|| name.clone())?;
    tuning.remarks.extend(left_out(&log));
    let about = About { file: name, names: log.names, left_out: log.left_out };

    let figures = figures::all(&tuning, &about.names);
    for figure in &figures {
        write_figure(figure, staging.folder())?;
    }
    if let Some(best) = tuning.plan.as_ref().and_then(|plan| plan.moves.best()) {
        let mut table = String::new();
        let (unit, tick) = (unit_of(&about.names[1]), arguments.tick.unwrap_or(tuning.sampled.period));
        check_rows(best.motion.duration(), tick)?;
        write_csv(&best.motion, tick, &unit, &mut table).map_err(|error| RequestError(error.to_string()))?;
        put(&staging.folder().join(MOVE), table.as_bytes())?;
    }
    let page = page::page(&tuning, &about, &figures, typed)?;
    put(&staging.folder().join(PAGE), page.as_bytes())?;
    put(&staging.folder().join(PARAMETERS), json(&tuning, &about)?.as_bytes())?;
    let folder = staging.finish()?;

    writeln!(out, "{}", words::about(&tuning, &about))?;
    for line in words::response(&tuning, &about).iter().chain(&tuning.remarks) {
        writeln!(out, "  {line}")?;
    }
    write!(out, "\n{}", words::aligned(&words::modes(&tuning, &about)))?;
    if let Some(plan) = &tuning.plan {
        let few = words::shortened(words::moves(plan, &about), 4, &MoveKind::SCurve.name());
        write!(out, "\n{}", words::aligned(&few))?;
    }
    writeln!(out, "\n{}", words::answer(&tuning, &about).join("\n"))?;
    writeln!(out, "{}", folder.join(PAGE).display())?;
    Ok(0)
}

impl Arguments {
    fn reading(&self) -> Reading {
        let [time, command, response] = [&self.time, &self.command, &self.response].map(Clone::clone);
        let time_unit = self.time_unit.map(|unit| match unit {
            TimeUnit::S => 1.0,
            TimeUnit::Ms => 1e-3,
            TimeUnit::Us => 1e-6,
            TimeUnit::Ns => 1e-9,
        });
        Reading {
            columns: Columns { time, command, response },
            time_unit,
            skip_irregular: self.skip_irregular,
        }
    }

    fn question(&self) -> Result<Question, RequestError> {
        let positive = |name: &str, value: f64| {
            let fine = value > 0.0 && value.is_finite();
            if fine {
                Ok(value)
            } else {
                Err(RequestError(format!("{name} must be positive and finite, got {value}")))
            }
        };
        let asked = [
            ("--distance", self.distance),
            ("--max-velocity", self.max_velocity),
            ("--max-acceleration", self.max_acceleration),
            ("--max-jerk", self.max_jerk),
        ];
        let missing: Vec<&str> =
            asked.iter().filter(|(_, value)| value.is_none()).map(|(name, _)| *name).collect();
        let rest = [("--tolerated-vibration", self.tolerated_vibration), ("--tick", self.tick)];
        let given = asked.iter().chain(&rest).find(|(_, value)| value.is_some());
        if let (Some((name, _)), false) = (given, missing.is_empty()) {
            return Err(RequestError(format!(
                "{name} asks for a move, which needs {} too",
                missing.join(", ")
            )));
        }
        let wanted = match asked.map(|(_, value)| value) {
            [Some(distance), Some(velocity), Some(acceleration), Some(jerk)] => {
                positive("the length of --distance", distance.abs())?;
                positive("--max-velocity", velocity)?;
                positive("--max-acceleration", acceleration)?;
                positive("--max-jerk", jerk)?;
                let tolerated =
                    self.tolerated_vibration.map(|x| positive("--tolerated-vibration", x)).transpose()?;
                let limits = Limits::new(velocity, acceleration, jerk)
                    .map_err(|error| RequestError(error.to_string()))?;
                Some(Wanted { distance, limits, tolerated })
            }
            _ => None,
        };
        if let Some(tick) = self.tick {
            positive("--tick", tick)?;
        }
        for (name, time) in [("--from", self.from), ("--to", self.to)] {
            if let Some(time) = time.filter(|time| !time.is_finite()) {
                return Err(RequestError(format!("{name} must be finite, got {time}")));
            }
        }
        if !(self.deviations >= 0.0 && self.deviations.is_finite()) {
            return Err(RequestError(format!("--deviations must not be negative, got {}", self.deviations)));
        }
        let route = match self.method {
            Method::Either => Route::Either,
            Method::FreeDecay => Route::FreeDecay,
            Method::TransferFunction => Route::TransferFunction,
        };
        let tolerated_part = positive("--tolerated-part", self.tolerated_part)?;
        Ok(Question { route, wanted, tolerated_part, deviations: self.deviations })
    }
}

/// The lines that were left out, in words.
fn left_out(log: &LogFile) -> Vec<String> {
    const SHOWN: usize = 10;
    let mut remarks: Vec<String> = log
        .irregular
        .iter()
        .take(SHOWN)
        .map(|(line, problem)| format!("line {line} left out: {problem}"))
        .collect();
    if log.left_out > SHOWN {
        remarks.push(format!("{} lines left out in all", log.left_out));
    }
    remarks
}

/// A table that fits on a disk and into a spreadsheet.
fn check_rows(duration: f64, tick: f64) -> Result<(), RequestError> {
    const MOST: f64 = 1e6;
    let rows = (duration / tick).ceil() + 1.0;
    if rows <= MOST {
        return Ok(());
    }
    Err(RequestError(format!(
        "the table of the move, {} s in ticks of {tick} s, would have {rows:e} rows, the most is {MOST:e}: choose a longer \
         --tick",
        crate::number::short(duration)
    )))
}

/// The unit behind a column's name, as a table may bear it.
fn unit_of(name: &str) -> String {
    columns::unit(name)
        .filter(|unit| !unit.is_empty() && !unit.contains([',', '"']))
        .unwrap_or("unit")
        .to_owned()
}
