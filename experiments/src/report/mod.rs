//! What a run leaves behind: a page, a summary, and for every figure a picture and a table.

pub mod folder;
pub mod html;
pub mod summary;
pub mod terminal;

use std::path::Path;

use anyhow::{Context, Result};

use crate::bench::Results;
use crate::figure::{Figure, Theme, Width, to_csv, to_png, to_svg};

/// Name of the page.
pub const PAGE: &str = "report.html";
/// Name of the summary, by which a folder is known as a report.
pub const SUMMARY: &str = "summary.json";
/// Name of the parameters that a tuning leaves, by which its folder is known.
pub const PARAMETERS: &str = "parameters.json";

/// Writes everything into `folder`, which is there and empty.
///
/// # Errors
/// A figure that cannot be drawn, or a file that cannot be written.
pub fn write(results: &Results<'_>, folder: &Path) -> Result<()> {
    for section in &results.sections {
        let sub = folder.join(section.experiment.id);
        std::fs::create_dir(&sub).with_context(|| format!("cannot make {}", sub.display()))?;
        for figure in &section.outcome.figures {
            write_figure(figure, &sub)?;
        }
        for source in section.experiment.sources {
            put(&sub.join(source.copy_name()), source.text.as_bytes())?;
        }
        put(&sub.join("expected.toml"), section.experiment.expected.as_bytes())?;
    }
    put(&folder.join(PAGE), html::page(results)?.as_bytes())?;
    put(&folder.join(SUMMARY), summary::json(results)?.as_bytes())
}

/// Writes the picture of a figure as SVG and PNG and the table behind it.
///
/// # Errors
/// A figure that cannot be drawn, or a file that cannot be written.
pub(crate) fn write_figure(figure: &Figure, folder: &Path) -> Result<()> {
    let path = |ending: &str| folder.join(format!("{}.{ending}", figure.id));
    put(&path("svg"), to_svg(figure, Width::Wide, Theme::Light)?.as_bytes())?;
    put(&path("png"), &to_png(figure)?)?;
    put(&path("csv"), to_csv(figure)?.as_bytes())
}

pub(crate) fn put(path: &Path, bytes: &[u8]) -> Result<()> {
    std::fs::write(path, bytes).with_context(|| format!("cannot write {}", path.display()))
}
