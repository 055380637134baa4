//! Draws a figure. Panels, axes, ticks and lines are the plotting library's; the stacking, the labels above the panels,
//! the legend and the names of the limits are placed here, so that nothing covers data and all panels line up.

use anyhow::{Result, anyhow};
use kuva::backend::raster::RasterBackend;
use kuva::backend::svg::SvgBackend;
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{BandPlot, LinePlot, ScatterPlot};
use kuva::render::annotations::{ReferenceLine, ShadedRegion};
use kuva::render::color::Color;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::{Primitive, Scene, TextAnchor, render_multiple};
use kuva::render::theme::Theme as Chrome;

use super::legend::{self, LINE};
use super::simplify::simplify;
use super::span::Span;
use super::{Figure, Marks, Panel, Role, Shape};

/// Light for paper and for files, dark for a dark page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Theme {
    /// On white.
    Light,
    /// On the dark page of the report.
    Dark,
}

/// Two widths of one figure, with text of the same size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// 720 px.
    Wide,
    /// 360 px, for a phone.
    Narrow,
}

/// The figure as one self-contained SVG with a background.
///
/// # Errors
/// What [`Figure::check`] refuses.
pub fn to_svg(figure: &Figure, width: Width, theme: Theme) -> Result<String> {
    let scene = draw(figure, width, theme)?;
    let svg = SvgBackend::new().render_scene(&scene);
    // Without a view box a picture scaled by a page would be cut instead.
    let view = format!("<svg viewBox=\"0 0 {} {}\" stroke-linejoin=\"round\" ", scene.width, scene.height);
    Ok(svg.replacen("<svg ", &view, 1))
}

/// The figure as a PNG, light, two pixels to a pixel of the SVG.
///
/// # Errors
/// What [`Figure::check`] refuses.
pub fn to_png(figure: &Figure) -> Result<Vec<u8>> {
    let scene = draw(figure, Width::Wide, Theme::Light)?;
    RasterBackend::new()
        .with_scale(2.0)
        .render_scene(&scene)
        .map_err(|error| anyhow!("figure '{}': {error}", figure.id))
}

const FONT: &str = "DejaVu Sans, Verdana, Helvetica, Arial, sans-serif";
pub(super) const TEXT: u32 = 12;
const TICK_TEXT: u32 = 11;
/// Width of a letter over its size, of DejaVu Sans: the widest of the fonts named above.
pub(super) const LETTER: f64 = 0.6;
/// Room above a panel for its label.
const STRIP: f64 = 24.0;
/// Room below the last panel for the ticks and the name of the x axis.
const FOOT: f64 = 44.0;

pub(super) struct Style {
    chrome: Chrome,
    pub(super) ink: &'static str,
    muted: &'static str,
}

impl Theme {
    fn style(self) -> Style {
        let (background, ink, muted, axis, grid) = match self {
            Self::Light => ("#ffffff", "#1a1a1a", "#666666", "#8a8a8a", "#e4e4e4"),
            Self::Dark => ("#16181d", "#e6e6e6", "#a0a4ab", "#6f747c", "#2c3037"),
        };
        let chrome = Chrome {
            background: background.into(),
            axis_color: axis.into(),
            grid_color: grid.into(),
            tick_color: axis.into(),
            text_color: ink.into(),
            ..Chrome::light()
        };
        Style { chrome, ink, muted }
    }

    /// Okabe and Ito's colours; on dark the blue and the vermilion give way to the brighter ones of the set.
    pub(super) fn colour(self, role: Role) -> &'static str {
        match (role, self) {
            (Role::Ours, Self::Light) => "#0072b2",
            (Role::Ours, Self::Dark) => "#56b4e9",
            (Role::Second, Self::Light) => "#d55e00",
            (Role::Second, Self::Dark) => "#e69f00",
            (Role::Third, _) => "#009e73",
            (Role::Fourth, _) => "#cc79a7",
            // The brighter ones of the set stand apart from the first two on either page.
            (Role::Fifth, Self::Light) => "#e69f00",
            (Role::Fifth, Self::Dark) => "#f0e442",
            (Role::Sixth, Self::Light) => "#56b4e9",
            (Role::Sixth, Self::Dark) => "#d55e00",
            (Role::Seventh, Self::Light) => "#1a1a1a",
            (Role::Seventh, Self::Dark) => "#e6e6e6",
            (Role::Reference, Self::Light) => "#767676",
            (Role::Reference, Self::Dark) => "#9a9a9a",
        }
    }
}

/// Where things are, in px.
pub(super) struct Geometry {
    pub(super) width: f64,
    pub(super) left: f64,
    right: f64,
    plot: f64,
}

fn draw(figure: &Figure, width: Width, theme: Theme) -> Result<Scene> {
    figure.check()?;
    let figure = &placed(figure);
    let style = theme.style();
    let geometry = geometry(figure, width);
    let common = if figure.own_legends { &[][..] } else { figure.panels.as_slice() };
    let common = legend::of(common, theme, &geometry);
    let own = |panel| {
        let panels = if figure.own_legends { std::slice::from_ref(panel) } else { &[] };
        legend::of(panels, theme, &geometry)
    };
    let own: Vec<_> = figure.panels.iter().map(own).collect();
    let top = 6.0 + legend::height(&common);
    // A legend of its own stands between a panel and its label.
    let strips: f64 = own.iter().map(|legend| STRIP + legend::height(legend)).sum();
    let height = top + strips + geometry.plot * figure.panels.len() as f64 + FOOT;

    let mut scene = Scene::new(geometry.width, height);
    scene.background_color = Some(style.chrome.background.clone());
    scene.text_color = Some(style.ink.to_owned());
    scene.font_family = Some(FONT.to_owned());
    let show = |scene: &mut Scene, legend: &[legend::Placed], top: f64| {
        for (entry, x, line) in legend {
            legend::draw_entry(scene, entry, geometry.left + x, top + LINE * (line + 0.5), &style);
        }
    };
    show(&mut scene, &common, 6.0);
    let xs = figure.panels.iter().flat_map(|panel| {
        let data = panel.columns().flat_map(|(_, points)| points.iter().map(|(x, _)| *x));
        data.chain(panel.bands.iter().flat_map(|band| [band.from, band.to]))
    });
    let most = if width == Width::Wide { 8.0 } else { 4.0 };
    let x = if figure.x.logarithmic { Span::of_decades(xs, most) } else { Span::of(xs, 0.0, most) };
    // Room for the markers of a map.
    let x = if figure.panels.iter().any(maps) { x.padded(0.02) } else { x };
    let mut start = top;
    for (n, (panel, legend)) in figure.panels.iter().zip(&own).enumerate() {
        let last = n + 1 == figure.panels.len();
        let ticks = if geometry.plot > 200.0 { 7.0 } else { 5.0 };
        let (x, y) = scaled(figure, (x, panel_span(panel, ticks)), (most, ticks), &geometry);
        let label = start + STRIP;
        start += legend::height(legend);
        let plot = render_multiple(
            plots(panel, (x, y), &geometry, theme),
            layout(panel, (x, y), &geometry, &style, last),
        );
        let transform = Some(format!("translate(0,{start})"));
        scene.add(Primitive::GroupStart { transform, title: None, extra_attrs: None });
        // All data are inside the axes. The clips, whose definitions stay behind too, are named from a counter that
        // differs from run to run.
        let clips = |e: &Primitive| matches!(e, Primitive::ClipStart { .. } | Primitive::ClipEnd);
        plot.elements.into_iter().filter(|e| !clips(e)).for_each(|element| scene.add(element));
        scene.add(Primitive::GroupEnd);
        text(&mut scene, (geometry.left, label - 7.0), &panel.y.label(), TEXT, TextAnchor::Start, style.ink);
        show(&mut scene, legend, label - 2.0);
        name_limits(&mut scene, panel, y, start + STRIP, &geometry, &style);
        start += STRIP + geometry.plot;
    }
    let middle = 0.5 * (geometry.left + geometry.width - geometry.right);
    text(&mut scene, (middle, height - 8.0), &figure.x.label(), TEXT, TextAnchor::Middle, style.ink);
    Ok(scene)
}

/// Both axes of a panel, the one with more room to the unit widened where the figure is to scale.
fn scaled(figure: &Figure, (x, y): (Span, Span), ticks: (f64, f64), geometry: &Geometry) -> (Span, Span) {
    if !figure.to_scale {
        return (x, y);
    }
    let across = geometry.width - geometry.left - geometry.right;
    let pixel = ((x.to - x.from) / across).max((y.to - y.from) / geometry.plot);
    (x.widened(across * pixel, ticks.0), y.widened(geometry.plot * pixel, ticks.1))
}

/// The figure with every value where it stands on its axis.
fn placed(figure: &Figure) -> Figure {
    let mut figure = figure.clone();
    let x = figure.x.clone();
    for panel in &mut figure.panels {
        let y = panel.y.clone();
        let series = panel.series.iter_mut().map(|s| &mut s.points);
        let spreads = panel.spreads.iter_mut().flat_map(|s| [&mut s.least, &mut s.greatest]);
        let points = series.chain(panel.marks.iter_mut().map(|m| &mut m.points)).chain(spreads);
        points.flatten().for_each(|point| *point = (x.place(point.0), y.place(point.1)));
        panel.limits.iter_mut().for_each(|limit| limit.value = y.place(limit.value));
        panel.bands.iter_mut().for_each(|b| (b.from, b.to) = (x.place(b.from), x.place(b.to)));
    }
    figure
}

fn geometry(figure: &Figure, width: Width) -> Geometry {
    let stacked = figure.panels.len() > 1;
    let (width, plot) = match width {
        Width::Wide => (720.0, if stacked { 140.0 } else { 300.0 }),
        Width::Narrow => (360.0, if stacked { 110.0 } else { 210.0 }),
    };
    let tick_letters = figure.panels.iter().map(|panel| {
        let y = panel_span(panel, 5.0);
        [y.from, y.to]
            .map(|end| y.tick((end / y.step).trunc() * y.step).chars().count())
            .into_iter()
            .max()
            .unwrap_or(0)
    });
    let letters = tick_letters.max().unwrap_or(0) as f64;
    let limits = figure.panels.iter().flat_map(|panel| &panel.limits);
    let name = limits.map(|limit| limit.label.chars().count()).max().unwrap_or(0) as f64;
    Geometry {
        width,
        left: (letters * LETTER * 1.08 * f64::from(TICK_TEXT) + 14.0).max(34.0),
        right: if name > 0.0 { name * LETTER * f64::from(TICK_TEXT) + 14.0 } else { 16.0 },
        plot,
    }
}

/// The vertical axis of a panel: all data and limits, and a little room.
fn panel_span(panel: &Panel, ticks: f64) -> Span {
    let data = panel.columns().flat_map(|(_, points)| points.iter().map(|(_, y)| *y));
    let values = data.chain(panel.limits.iter().map(|limit| limit.value));
    let span =
        if panel.y.logarithmic { Span::of_decades(values, ticks) } else { Span::of(values, 0.06, ticks) };
    if maps(panel) { span.padded(0.06) } else { span }
}

/// Whether a panel shows places on a map.
fn maps(panel: &Panel) -> bool {
    panel.marks.iter().any(|marks| marks.shape.is_some())
}

fn layout(panel: &Panel, (x, y): (Span, Span), geometry: &Geometry, style: &Style, last: bool) -> Layout {
    let foot = if last { FOOT } else { 0.0 };
    let mut layout = Layout::new((x.from, x.to), (y.from, y.to))
        .with_width(geometry.width)
        .with_height(STRIP + geometry.plot + foot)
        .with_force_margins(geometry.left, geometry.right)
        .with_force_margins_y(STRIP, foot)
        .with_box_axes()
        .with_x_axis_min(x.from)
        .with_x_axis_max(x.to)
        .with_y_axis_min(y.from)
        .with_y_axis_max(y.to)
        .with_x_tick_step(x.step)
        .with_y_tick_step(y.step)
        .with_x_tick_format(ticks(x))
        .with_y_tick_format(ticks(y))
        .with_tick_size(TICK_TEXT)
        .with_tick_length(4.0)
        .with_grid_line_width(0.6)
        .with_theme(style.chrome.clone());
    layout.suppress_x_ticks = !last;
    for band in &panel.bands {
        layout = layout.with_shaded_region(
            ShadedRegion::vertical(band.from, band.to).with_color(style.ink).with_opacity(0.06),
        );
    }
    for limit in &panel.limits {
        let line = ReferenceLine::horizontal(limit.value).with_color(style.muted).with_dasharray("5 4");
        layout = layout.with_reference_line(line);
    }
    layout
}

fn ticks(axis: Span) -> TickFormat {
    TickFormat::Custom(std::sync::Arc::new(move |x| axis.tick(x)))
}

fn plots(panel: &Panel, (x, y): (Span, Span), geometry: &Geometry, theme: Theme) -> Vec<Plot> {
    let across = geometry.width - geometry.left - geometry.right;
    let scale = (across / (x.to - x.from), geometry.plot / (y.to - y.from));
    let mut plots: Vec<Plot> = Vec::new();
    for spread in &panel.spreads {
        let ends =
            spread.least.iter().zip(&spread.greatest).map(|(least, greatest)| (least.0, least.1, greatest.1));
        let (x, (least, greatest)): (Vec<_>, (Vec<_>, Vec<_>)) = ends.map(|(x, a, b)| (x, (a, b))).unzip();
        let band = BandPlot::new(x, least, greatest).with_color(theme.colour(spread.role));
        plots.push(band.with_opacity(0.2).into());
    }
    for series in &panel.series {
        // A fiftieth of a pixel cannot be seen, at twice the size either.
        let points = simplify(&series.points, scale, 0.02);
        let width = if series.role == Role::Reference { 1.4 } else { 1.8 };
        let line =
            LinePlot::new().with_data(points).with_color(theme.colour(series.role)).with_stroke_width(width);
        plots.push(line.into());
    }
    for (n, marks) in panel.marks.iter().enumerate() {
        let dots = |points: Vec<(f64, f64)>, colour: &'static str, size: f64| {
            let plot = ScatterPlot::new().with_data(points).with_color(colour);
            Plot::from(plot.with_marker(marker(shape(n, marks))).with_size(size))
        };
        if marks.shape.is_some() {
            let placed = marks.points.iter().zip(&marks.roles);
            plots.extend(placed.map(|(point, role)| dots(vec![*point], theme.colour(*role), 6.0)));
            continue;
        }
        // In ink first, so that a coloured point keeps a rim where it lies on its own line.
        plots.push(dots(marks.points.clone(), theme.style().ink, 4.5));
        let coloured = marks.points.iter().zip(&marks.roles);
        plots.extend(coloured.map(|(point, role)| dots(vec![*point], theme.colour(*role), 3.0)));
    }
    plots
}

/// The shape of marks, which are the n-th of their panel.
pub(super) fn shape(n: usize, marks: &Marks) -> Shape {
    let in_turn = match n % 3 {
        0 => Shape::Circle,
        1 => Shape::Square,
        _ => Shape::Triangle,
    };
    marks.shape.unwrap_or(in_turn)
}

fn marker(shape: Shape) -> MarkerShape {
    match shape {
        Shape::Circle => MarkerShape::Circle,
        Shape::Square => MarkerShape::Square,
        Shape::Triangle => MarkerShape::Triangle,
    }
}

/// Names the limits at the right edge, where no data are, pushed apart where they would touch.
fn name_limits(scene: &mut Scene, panel: &Panel, y: Span, top: f64, geometry: &Geometry, style: &Style) {
    let place = |value: f64| top + (1.0 - y.fraction(value)) * geometry.plot;
    let mut names: Vec<(f64, &str)> =
        panel.limits.iter().map(|l| (place(l.value), l.label.as_str())).collect();
    names.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut free = f64::NEG_INFINITY;
    for (at, name) in names {
        let at = at.max(free);
        free = at + f64::from(TICK_TEXT) + 1.0;
        let x = geometry.width - geometry.right + 6.0;
        text(scene, (x, at + 4.0), &name.replace('-', "−"), TICK_TEXT, TextAnchor::Start, style.muted);
    }
}

pub(super) fn text(
    scene: &mut Scene,
    (x, y): (f64, f64),
    content: &str,
    size: u32,
    anchor: TextAnchor,
    colour: &str,
) {
    let color = Some(Color::from(colour));
    scene.add(Primitive::Text {
        x,
        y,
        content: content.to_owned(),
        size,
        anchor,
        rotate: None,
        bold: false,
        color,
    });
}
