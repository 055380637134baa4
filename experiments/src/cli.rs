//! The command line: what was asked, in which order it is done, and the exit code.

use std::ffi::OsString;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::{Args, Parser, Subcommand};
use thiserror::Error;

use crate::bench::{self, Results, Setting};
use crate::experiment::Experiment;
use crate::figure::{Theme, Width, to_svg};
use crate::report::folder::{FolderError, Staging};
use crate::report::{self, PAGE, terminal};
use crate::{readme, registry, tune};

/// Reproduces published results and shows them beside ours. Without a command, runs everything.
#[derive(Debug, Parser)]
#[command(name = "experiments", version, disable_help_subcommand = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Lists the experiments: id and title
    List,
    /// Runs experiments and writes a report
    Run(Run),
    /// Runs experiments and compares with expected.toml and with the README; exit code 1 where they differ
    Check {
        /// Ids, or beginnings of ids; all without one
        ids: Vec<String>,
    },
    /// Runs everything and rewrites the results table of README.md and its picture in docs/
    Readme,
    /// Reads a log of an axis; reports its modes, the move and the shaper to use
    Tune(Box<tune::Arguments>),
}

#[derive(Debug, Args)]
struct Run {
    /// Ids, or beginnings of ids; all without one
    ids: Vec<String>,
    /// Folder of the report [default: target/report of the workspace]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Seed of every random number
    #[arg(long, value_name = "N", default_value_t = Setting::default().seed)]
    seed: u64,
    /// Runs the searches that are compared with so many seeds, from that one on; rows are their medians
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=1000))]
    seeds: u64,
    /// Shortens the runs; nothing is compared
    #[arg(long)]
    quick: bool,
}

/// A mistake of the caller: exit code 2.
#[derive(Debug, Error)]
#[error("{0}")]
struct Usage(String);

/// Does what `arguments` (the first is the program's name) ask and returns the exit code: 0, 1 where a run failed or a
/// check found differences, 2 where the request cannot be met. An error is one line on `err`. `root` is the folder that
/// holds README.md, `docs/` and `target/`.
pub fn main(
    experiments: &[Experiment],
    root: &Path,
    arguments: impl IntoIterator<Item = OsString>,
    out: &mut dyn Write,
    err: &mut dyn Write,
) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let typed = typed(&arguments);
    let result = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => Bench { experiments, root }.act(arguments, &typed, out, err),
        Err(error) if !error.use_stderr() => write!(out, "{error}").map(|()| 0).map_err(Into::into),
        Err(error) => {
            let text = error.to_string();
            let line = text.lines().next().unwrap_or_default();
            Err(Usage(line.strip_prefix("error: ").unwrap_or(line).to_owned()).into())
        }
    };
    result.unwrap_or_else(|error| {
        // Whoever reads the output may have seen enough.
        if is_broken_pipe(&error) {
            return 0;
        }
        let line = format!("{error:#}").split_whitespace().collect::<Vec<_>>().join(" ");
        // If standard error is closed too, the exit code is all that is left.
        let _ = writeln!(err, "error: {line}");
        let request = error.is::<tune::RequestError>() || error.is::<tune::LogFileError>();
        let usage = request || error.is::<Usage>() || error.is::<FolderError>();
        if usage { 2 } else { 1 }
    })
}

/// The command as it is typed again.
fn typed(arguments: &[OsString]) -> String {
    let mut typed = "cargo run -p experiments --".to_owned();
    for argument in arguments.iter().skip(1) {
        let argument = argument.to_string_lossy();
        let plain = argument.bytes().all(|b| b.is_ascii_alphanumeric() || b"-_./=,:+".contains(&b));
        let quoted =
            if plain { argument.into_owned() } else { format!("'{}'", argument.replace('\'', "'\\''")) };
        typed.push(' ');
        typed.push_str(&quoted);
    }
    typed
}

fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error.downcast_ref::<io::Error>().is_some_and(|e| e.kind() == io::ErrorKind::BrokenPipe)
}

struct Bench<'a> {
    experiments: &'a [Experiment],
    root: &'a Path,
}

impl Bench<'_> {
    fn act(&self, arguments: Arguments, typed: &str, out: &mut dyn Write, err: &mut dyn Write) -> Result<u8> {
        let Setting { seed, seeds, quick } = Setting::default();
        let all = Run { ids: Vec::new(), out: None, seed, seeds, quick };
        match arguments.command.unwrap_or(Command::Run(all)) {
            Command::List => {
                let width = self.experiments.iter().map(|e| e.id.len()).max().unwrap_or(0);
                for experiment in self.experiments {
                    writeln!(out, "{:width$}  {}", experiment.id, experiment.title)?;
                }
                Ok(0)
            }
            Command::Run(run) => self.write_report(&run, out),
            Command::Check { ids } => self.check(&ids, out, err),
            Command::Readme => self.write_readme(out),
            Command::Tune(arguments) => tune::run(&arguments, self.root, typed, out),
        }
    }

    fn select(&self, ids: &[String]) -> Result<Vec<&Experiment>> {
        Ok(registry::select(self.experiments, ids).map_err(Usage)?)
    }

    fn write_report(&self, run: &Run, out: &mut dyn Write) -> Result<u8> {
        let selected = self.select(&run.ids)?;
        let target = run.out.clone().unwrap_or_else(|| self.root.join("target").join("report"));
        // Opened before the runs: what cannot be written is known at once.
        let staging = Staging::open(&target)?;
        if selected.is_empty() {
            writeln!(out, "there are no experiments yet")?;
            return Ok(0);
        }
        let results = bench::run(&selected, Setting { seed: run.seed, seeds: run.seeds, quick: run.quick })?;
        report::write(&results, staging.folder())?;
        let folder = staging.finish()?;
        write!(out, "{}", terminal::table(&results))?;
        writeln!(out, "{}", folder.join(PAGE).display())?;
        Ok(0)
    }

    fn check(&self, ids: &[String], out: &mut dyn Write, err: &mut dyn Write) -> Result<u8> {
        let selected = self.select(ids)?;
        if selected.is_empty() {
            writeln!(out, "there are no experiments yet")?;
            return Ok(0);
        }
        let results = bench::run(&selected, Setting::default())?;
        // A verdict does not depend on who reads the table.
        if let Err(error) = write!(out, "{}", terminal::table(&results)).map_err(anyhow::Error::from)
            && !is_broken_pipe(&error)
        {
            return Err(error);
        }
        let mut problems: Vec<String> = results
            .findings()
            .filter_map(|f| {
                f.surprise.map(|s| format!("{} {} {}", f.row.experiment, f.row.metric, s.words()))
            })
            .collect();
        if results.findings().any(|finding| finding.readme) {
            match std::fs::read_to_string(self.root.join("README.md")) {
                Ok(text) => match readme::check(&text, &results) {
                    Ok(found) => problems.extend(found),
                    Err(error) => problems.push(error.to_string()),
                },
                Err(error) => problems.push(format!("README.md: {error}")),
            }
        }
        for problem in &problems {
            // If standard error is closed too, the exit code is all that is left.
            let _ = writeln!(err, "{problem}");
        }
        Ok(u8::from(!problems.is_empty()))
    }

    fn write_readme(&self, out: &mut dyn Write) -> Result<u8> {
        let selected = self.select(&[])?;
        let path = self.root.join("README.md");
        let text = std::fs::read_to_string(&path).map_err(|error| Usage(format!("README.md: {error}")))?;
        // Before the runs: a README without its two comments is known at once.
        let nothing = Results { setting: Setting::default(), sections: Vec::new() };
        readme::rewrite(&text, &nothing).map_err(|error| Usage(error.to_string()))?;
        let results = bench::run(&selected, Setting::default())?;
        let mut files = vec![(path, readme::rewrite(&text, &results)?)];
        for section in &results.sections {
            let Some(id) = section.experiment.readme_figure else { continue };
            let figure = section.outcome.figures.iter().find(|figure| figure.id == id);
            let figure = figure
                .with_context(|| format!("{}: no figure '{id}' for the README", section.experiment.id))?;
            let name = format!("{}-{id}", section.experiment.id);
            for (ending, theme) in [("", Theme::Light), ("-dark", Theme::Dark)] {
                let path = self.root.join("docs").join(format!("{name}{ending}.svg"));
                files.push((path, to_svg(figure, Width::Wide, theme)?));
            }
        }
        for (path, text) in files {
            replace(&path, &text).with_context(|| format!("cannot write {}", path.display()))?;
            writeln!(out, "{}", path.display())?;
        }
        Ok(0)
    }
}

/// Writes a file beside and renames it, so that a README is never half a README.
fn replace(path: &Path, text: &str) -> io::Result<()> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let partial = path.with_extension(format!("partial-{}", std::process::id()));
    std::fs::write(&partial, text).and_then(|()| std::fs::rename(&partial, path)).inspect_err(|_| {
        let _ = std::fs::remove_file(&partial);
    })
}

/// The root of the workspace: the nearest folder from here upwards with `experiments/Cargo.toml`, else here.
#[must_use]
pub fn workspace() -> PathBuf {
    let here = std::env::current_dir().unwrap_or_default();
    let root = here.ancestors().find(|folder| folder.join("experiments").join("Cargo.toml").is_file());
    root.unwrap_or(&here).to_owned()
}
