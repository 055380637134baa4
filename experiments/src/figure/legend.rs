//! The legend: what stands above the panels of a figure.

use kuva::render::color::Color;
use kuva::render::render::{Primitive, Scene, TextAnchor};

use super::render::{Geometry, LETTER, Style, TEXT, Theme, shape, text};
use super::{Panel, Shape};

/// Height of a line of the legend, px.
pub(super) const LINE: f64 = 20.0;

/// What stands before a name in the legend.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Swatch {
    Line(&'static str),
    Mark(Shape, Option<&'static str>),
    Band,
}

/// The legend of some panels, set; x from the left edge of the panels and the line of each.
pub(super) fn of(panels: &[Panel], theme: Theme, geometry: &Geometry) -> Vec<Placed> {
    place(entries(panels, theme), geometry)
}

/// How high a legend is, px.
pub(super) fn height(legend: &[Placed]) -> f64 {
    LINE * legend.last().map_or(0.0, |entry| entry.2 + 1.0)
}

/// Every named thing once; nothing where the labels of the panels say it all.
fn entries(panels: &[Panel], theme: Theme) -> Vec<(Swatch, String)> {
    let mut entries: Vec<(Swatch, String)> = Vec::new();
    for panel in panels {
        let lines = panel.series.iter().map(|s| (Swatch::Line(theme.colour(s.role)), &s.name));
        let marks = panel.marks.iter().enumerate().map(|(n, m)| {
            let colour = m.shape.and(m.roles.first()).map(|role| theme.colour(*role));
            (Swatch::Mark(shape(n, m), colour), &m.name)
        });
        let bands = panel.bands.iter().map(|b| (Swatch::Band, &b.name));
        for (swatch, name) in lines.chain(marks).chain(bands) {
            let entry = (swatch, name.clone());
            if !name.is_empty() && !entries.contains(&entry) {
                entries.push(entry);
            }
        }
    }
    let one_line = matches!(entries.as_slice(), [(Swatch::Line(_), _)]);
    if one_line { Vec::new() } else { entries }
}

pub(super) type Placed = ((Swatch, String), f64, f64);

/// Sets the entries side by side above the panels; x from the left edge of the panels and the line of each.
fn place(entries: Vec<(Swatch, String)>, geometry: &Geometry) -> Vec<Placed> {
    let across = geometry.width - geometry.left - 8.0;
    let (mut x, mut line) = (0.0, 0.0);
    let mut placed = Vec::with_capacity(entries.len());
    for entry in entries {
        let wide = 46.0 + LETTER * f64::from(TEXT) * entry.1.chars().count() as f64;
        if x > 0.0 && x + wide > across + 18.0 {
            (x, line) = (0.0, line + 1.0);
        }
        placed.push((entry, x, line));
        x += wide;
    }
    placed
}

pub(super) fn draw_entry(
    scene: &mut Scene,
    (swatch, name): &(Swatch, String),
    x: f64,
    y: f64,
    style: &Style,
) {
    let square = |x: f64, width: f64, fill: &str, opacity: f64| Primitive::Rect {
        x,
        y: y - width.min(10.0) / 2.0,
        width,
        height: width.min(10.0),
        fill: Color::from(fill),
        stroke: None,
        stroke_width: None,
        opacity: Some(opacity),
    };
    match *swatch {
        Swatch::Line(colour) => scene.add(Primitive::Line {
            x1: x,
            y1: y,
            x2: x + 20.0,
            y2: y,
            stroke: Color::from(colour),
            stroke_width: 2.2,
            stroke_dasharray: None,
        }),
        Swatch::Band => scene.add(square(x, 20.0, style.ink, 0.12)),
        Swatch::Mark(Shape::Square, colour) => {
            scene.add(square(x + 6.0, 8.0, colour.unwrap_or(style.ink), 1.0));
        }
        Swatch::Mark(Shape::Triangle, colour) => {
            let colour = colour.unwrap_or(style.ink);
            text(scene, (x + 10.0, y + 4.5), "▲", TEXT, TextAnchor::Middle, colour);
        }
        Swatch::Mark(Shape::Circle, colour) => scene.add(Primitive::Circle {
            cx: x + 10.0,
            cy: y,
            r: 4.0,
            fill: Color::from(colour.unwrap_or(style.ink)),
            fill_opacity: None,
            stroke: None,
            stroke_width: None,
        }),
    }
    text(scene, (x + 26.0, y + 4.5), name, TEXT, TextAnchor::Start, style.ink);
}
