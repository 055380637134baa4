//! How far an experiment is: a bar on a terminal, plain lines elsewhere, both on standard error.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Where an experiment says how far it is.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
    lines: Option<(String, Instant)>,
}

impl Progress {
    /// A bar named `id` where standard error is a terminal, else a line at the start and one at the end.
    #[must_use]
    pub fn start(id: &str) -> Self {
        if std::io::stderr().is_terminal() {
            let bar = ProgressBar::no_length().with_prefix(id.to_owned());
            if let Ok(style) =
                ProgressStyle::with_template("{spinner} {prefix:24} {wide_bar} {elapsed:>4} {msg}")
            {
                bar.set_style(style.progress_chars("━╸ "));
            }
            bar.enable_steady_tick(Duration::from_millis(100));
            Self { bar, lines: None }
        } else {
            eprintln!("{id}: started");
            Self { bar: ProgressBar::hidden(), lines: Some((id.to_owned(), Instant::now())) }
        }
    }

    /// Says nothing, for tests.
    #[must_use]
    pub fn hidden() -> Self {
        Self { bar: ProgressBar::hidden(), lines: None }
    }

    /// How many steps there will be.
    pub fn steps(&self, steps: u64) {
        self.bar.set_length(steps);
    }

    /// One step is done.
    pub fn step(&self) {
        self.bar.inc(1);
    }

    /// What is being done, in a few words.
    pub fn say(&self, what: &str) {
        self.bar.set_message(what.to_owned());
        if let Some((id, _)) = &self.lines {
            eprintln!("{id}: {what}");
        }
    }

    /// Takes the bar away, or writes the last line.
    pub(crate) fn finish(&self, how: &str) {
        self.bar.finish_and_clear();
        if let Some((id, start)) = &self.lines {
            eprintln!("{id}: {how} after {:.1} s", start.elapsed().as_secs_f64());
        }
    }
}
