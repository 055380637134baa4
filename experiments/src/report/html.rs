//! `report.html`: one file that needs no other and no network.

use anyhow::Result;
use minijinja::Environment;
use minijinja::value::Serde;
use serde::Serialize;

use crate::bench::{Results, Section};
use crate::figure::{Figure, Theme, Width, to_svg};
use crate::number::pretty_unit;
use crate::row::Finding;

use super::{summary, terminal};

#[derive(Serialize)]
struct Page {
    style: &'static str,
    generated_by: &'static str,
    seed: u64,
    quick: bool,
    counts: String,
    sections: Vec<SectionView>,
}

#[derive(Serialize)]
struct SectionView {
    id: &'static str,
    title: &'static str,
    citation: &'static str,
    command: String,
    sources: Vec<Link>,
    notes: Vec<String>,
    figures: Vec<FigureView>,
    rows: Vec<RowView>,
    rows_total: usize,
}

#[derive(Serialize)]
struct Link {
    name: String,
    href: String,
}

/// A figure as a page shows it.
#[derive(Serialize)]
pub(crate) struct FigureView {
    id: String,
    title: String,
    alt: String,
    wide: Picture,
    narrow: Picture,
    rows: Vec<RowView>,
}

#[derive(Serialize)]
struct Picture {
    light: String,
    dark: String,
}

#[derive(Serialize)]
struct RowView {
    metric: String,
    unit: String,
    source: Option<String>,
    paper: Option<String>,
    ours: Option<String>,
    error: Option<String>,
    tolerance: Option<String>,
    status: &'static str,
    surprise: Option<&'static str>,
    why: Option<String>,
}

/// The page as text.
///
/// # Errors
/// A figure that cannot be drawn.
pub fn page(results: &Results<'_>) -> Result<String> {
    let mut environment = Environment::new();
    environment.add_template("report.html", include_str!("../../templates/report.html"))?;
    let sections = results.sections.iter().map(|section| view(section, results)).collect::<Result<_>>()?;
    let page = Page {
        style: include_str!("../../templates/style.css"),
        generated_by: summary::GENERATED_BY,
        seed: results.setting.seed,
        quick: results.setting.quick,
        counts: terminal::counts(results),
        sections,
    };
    Ok(environment.get_template("report.html")?.render(Serde(page))?)
}

fn view(section: &Section<'_>, results: &Results<'_>) -> Result<SectionView> {
    let experiment = section.experiment;
    let rows = |figure: Option<&str>| {
        section.findings.iter().filter(|f| f.figure.as_deref() == figure).map(row).collect::<Vec<_>>()
    };
    let figure = |figure: &Figure| Ok(FigureView { rows: rows(Some(&figure.id)), ..figure_view(figure)? });
    let mut command =
        format!("cargo run -p experiments -- run {} --seed {}", experiment.id, results.setting.seed);
    if results.setting.seeds != 1 {
        command.push_str(&format!(" --seeds {}", results.setting.seeds));
    }
    if results.setting.quick {
        command.push_str(" --quick");
    }
    Ok(SectionView {
        id: experiment.id,
        title: experiment.title,
        citation: experiment.citation,
        command,
        sources: experiment
            .sources
            .iter()
            .map(|s| Link { name: s.path.to_owned(), href: format!("{}/{}", experiment.id, s.copy_name()) })
            .collect(),
        notes: section.outcome.notes.clone(),
        figures: section.outcome.figures.iter().map(figure).collect::<Result<_>>()?,
        rows: rows(None),
        rows_total: section.findings.len(),
    })
}

/// A figure without rows.
///
/// # Errors
/// A figure that cannot be drawn.
pub(crate) fn figure_view(figure: &Figure) -> Result<FigureView> {
    let picture = |width| -> Result<Picture> {
        let uri = |theme| to_svg(figure, width, theme).map(|svg| data_uri(&svg));
        Ok(Picture { light: uri(Theme::Light)?, dark: uri(Theme::Dark)? })
    };
    let panels: Vec<String> = figure.panels.iter().map(|panel| panel.y.label()).collect();
    Ok(FigureView {
        id: figure.id.clone(),
        title: figure.title.clone(),
        alt: format!("{} over {}", panels.join(", "), figure.x.label()),
        wide: picture(Width::Wide)?,
        narrow: picture(Width::Narrow)?,
        rows: Vec::new(),
    })
}

fn row(finding: &Finding) -> RowView {
    let row = &finding.row;
    RowView {
        metric: row.metric.clone(),
        unit: pretty_unit(&row.unit),
        source: row.source.clone(),
        paper: row.published.as_ref().map(|value| value.published()),
        ours: row.measured.as_ref().map(|value| value.measured()),
        error: row.error().map(|error| error.replace('-', "−")),
        tolerance: row.tolerance.map(|tolerance| tolerance.show(&row.unit)),
        status: row.status.word(),
        surprise: finding.surprise.map(|surprise| surprise.words()),
        why: row.why.clone(),
    }
}

/// The picture inside an attribute: everything but letters, digits and what URLs leave alone is escaped.
fn data_uri(svg: &str) -> String {
    let mut uri = String::with_capacity(svg.len() + svg.len() / 2);
    uri.push_str("data:image/svg+xml,");
    for byte in svg.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'_' | b'.' | b'/' | b':' | b'=' | b';' => {
                uri.push(char::from(byte));
            }
            _ => uri.push_str(&format!("%{byte:02X}")),
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_survives_an_attribute() {
        assert_eq!(
            data_uri("<a b='ü' c=\"#1, 2\"/>"),
            "data:image/svg+xml,%3Ca%20b=%27%C3%BC%27%20c=%22%231%2C%202%22/%3E"
        );
    }
}
