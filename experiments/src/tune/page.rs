//! `report.html` of a tuning: one file that needs no other and no network.

use anyhow::Result;
use minijinja::Environment;
use minijinja::value::Serde;
use serde::Serialize;

use super::analysis::Tuning;
use super::parameters::About;
use super::words::{self, Table};
use crate::figure::Figure;
use crate::report::html::{FigureView, figure_view};
use crate::report::summary::GENERATED_BY;

#[derive(Serialize)]
struct Page {
    style: &'static str,
    generated_by: &'static str,
    title: String,
    about: String,
    answer: Vec<String>,
    remarks: Vec<String>,
    sections: Vec<Section>,
    command: String,
    has_move: bool,
}

#[derive(Serialize)]
struct Section {
    id: &'static str,
    title: &'static str,
    paragraphs: Vec<String>,
    tables: Vec<Table>,
    figures: Vec<FigureView>,
}

/// The page as text.
///
/// # Errors
/// A figure that cannot be drawn.
pub(super) fn page(tuning: &Tuning, about: &About, figures: &[Figure], command: &str) -> Result<String> {
    let mut environment = Environment::new();
    environment.add_template("tune.html", include_str!("../../templates/tune.html"))?;
    let views = |ids: &[&str]| -> Result<Vec<FigureView>> {
        figures.iter().filter(|figure| ids.contains(&figure.id.as_str())).map(figure_view).collect()
    };
    let mut sections = vec![Section {
        id: "modes",
        title: "The modes",
        paragraphs: words::response(tuning, about).iter().map(|words| words::sentence(words)).collect(),
        tables: vec![words::modes(tuning, about)],
        figures: views(&["log", "fit", "spectrum"])?,
    }];
    if let Some(plan) = &tuning.plan {
        sections.push(Section {
            id: "moves",
            title: "The move",
            paragraphs: vec![words::task(plan, about)],
            tables: vec![words::moves(plan, about)],
            figures: views(&["move", "sensitivity"])?,
        });
    }
    sections.push(Section {
        id: "shaper",
        title: "The shaper",
        paragraphs: vec!["For a profile that cannot be changed, one for every mode, one after the other; * is recommended.".to_owned()],
        tables: vec![words::shapers(tuning), words::impulses(tuning)],
        figures: views(&["shapers"])?,
    });
    let page = Page {
        style: include_str!("../../templates/style.css"),
        generated_by: GENERATED_BY,
        title: about.file.clone(),
        about: words::about(tuning, about),
        answer: words::answer(tuning, about),
        remarks: tuning.remarks.iter().map(|remark| words::sentence(remark)).collect(),
        sections,
        command: command.to_owned(),
        has_move: tuning.plan.is_some(),
    };
    Ok(environment.get_template("tune.html")?.render(Serde(page))?)
}
