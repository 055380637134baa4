//! Figures as the papers know them: panels stacked over one axis, lines, limits, published points.
//!
//! The plotting library is named in `render.rs` and nowhere else.

mod csv;
mod legend;
mod render;
mod simplify;
mod span;

pub use csv::to_csv;
pub use render::{Theme, Width, to_png, to_svg};

use anyhow::{Result, bail, ensure};

/// What an axis or a column holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// In words, for the columns of the table: `velocity`.
    pub name: String,
    /// The letter, for the picture: `v`; may be empty.
    pub symbol: String,
    /// ASCII (`m/s^2`, `um`); empty for a pure number.
    pub unit: String,
    /// Whether the axis runs in decades; all its values are then positive.
    pub logarithmic: bool,
}

impl Quantity {
    /// `Quantity::new("velocity", "v", "m/s")`.
    #[must_use]
    pub fn new(name: &str, symbol: &str, unit: &str) -> Self {
        let [name, symbol, unit] = [name, symbol, unit].map(str::to_owned);
        Self { name, symbol, unit, logarithmic: false }
    }

    /// The same on an axis of decades.
    #[must_use]
    pub fn logarithmic(self) -> Self {
        Self { logarithmic: true, ..self }
    }

    /// Where a value stands on the axis: itself, or its decimal logarithm.
    pub(crate) fn place(&self, value: f64) -> f64 {
        if self.logarithmic { value.log10() } else { value }
    }

    /// Whether the axis has a place for a value.
    fn takes(&self, value: f64) -> bool {
        value.is_finite() && (!self.logarithmic || value > 0.0)
    }

    /// Time t in seconds.
    #[must_use]
    pub fn time() -> Self {
        Self::new("time", "t", "s")
    }

    /// As it stands at an axis: `velocity v [m/s]`.
    #[must_use]
    pub fn label(&self) -> String {
        let mut label = self.name.clone();
        if !self.symbol.is_empty() {
            label = format!("{label} {}", self.symbol);
        }
        if !self.unit.is_empty() {
            label = format!("{label} [{}]", crate::number::pretty_unit(&self.unit));
        }
        label
    }
}

/// The part a line plays; every figure draws a part in the same colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Our result, or the first of several compared.
    Ours,
    /// The second of several compared.
    Second,
    /// The third.
    Third,
    /// The fourth.
    Fourth,
    /// The fifth.
    Fifth,
    /// The sixth.
    Sixth,
    /// The seventh.
    Seventh,
    /// What the others are measured against: a set point, a rigid plant, no shaper.
    Reference,
}

/// A line through points.
#[derive(Clone, Debug)]
pub struct Series {
    /// Name in the legend and in the table; may be empty where a panel has one line.
    pub name: String,
    /// Decides the colour.
    pub role: Role,
    /// x and y, in the units of the axes.
    pub points: Vec<(f64, f64)>,
}

/// The shape of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A disc.
    Circle,
    /// A square.
    Square,
    /// A triangle.
    Triangle,
}

/// Published points, or places on a map: markers without a line.
#[derive(Clone, Debug)]
pub struct Marks {
    /// Name in the legend and in the table.
    pub name: String,
    /// x and y, in the units of the axes.
    pub points: Vec<(f64, f64)>,
    /// The line each point belongs to, whose colour it has; none where they belong to no line.
    pub roles: Vec<Role>,
    /// On a map, whose markers are larger: their shape, which the legend shows in their colour. Elsewhere the shapes take turns.
    pub shape: Option<Shape>,
}

/// What several runs span: the stretch from the least to the greatest, lightly filled.
#[derive(Clone, Debug)]
pub struct Spread {
    /// Names of both ends in the table; they stand in no legend.
    pub names: [String; 2],
    /// The line it belongs to, whose colour it has.
    pub role: Role,
    /// The least values, x and y.
    pub least: Vec<(f64, f64)>,
    /// The greatest, at the same x.
    pub greatest: Vec<(f64, f64)>,
}

/// A horizontal dashed line with its name at the right edge.
#[derive(Clone, Debug)]
pub struct Limit {
    /// In the unit of the panel.
    pub value: f64,
    /// A few letters: `v_max`.
    pub label: String,
}

/// A stretch of the x axis, lightly shaded.
#[derive(Clone, Debug)]
pub struct Band {
    /// Where it starts, in the unit of the x axis.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Name in the legend; may be empty.
    pub name: String,
}

/// One pair of axes.
#[derive(Clone, Debug)]
pub struct Panel {
    /// The vertical axis.
    pub y: Quantity,
    /// Lines.
    pub series: Vec<Series>,
    /// Published points.
    pub marks: Vec<Marks>,
    /// Spreads of several runs.
    pub spreads: Vec<Spread>,
    /// Limits.
    pub limits: Vec<Limit>,
    /// Shaded stretches.
    pub bands: Vec<Band>,
}

impl Panel {
    /// An empty panel.
    #[must_use]
    pub fn new(y: Quantity) -> Self {
        let (series, marks, spreads) = (Vec::new(), Vec::new(), Vec::new());
        Self { y, series, marks, spreads, limits: Vec::new(), bands: Vec::new() }
    }

    /// Adds a line.
    #[must_use]
    pub fn line(mut self, name: &str, role: Role, points: Vec<(f64, f64)>) -> Self {
        self.series.push(Series { name: name.to_owned(), role, points });
        self
    }

    /// Adds published points.
    #[must_use]
    pub fn marks(mut self, name: &str, points: Vec<(f64, f64)>) -> Self {
        self.marks.push(Marks { name: name.to_owned(), points, roles: Vec::new(), shape: None });
        self
    }

    /// Adds published points, each in the colour of the line it belongs to.
    #[must_use]
    pub fn marks_of(mut self, name: &str, points: Vec<(Role, (f64, f64))>) -> Self {
        let (roles, points) = points.into_iter().unzip();
        self.marks.push(Marks { name: name.to_owned(), points, roles, shape: None });
        self
    }

    /// Adds places on a map, all of one colour and shape.
    #[must_use]
    pub fn places(mut self, name: &str, role: Role, shape: Shape, points: Vec<(f64, f64)>) -> Self {
        let roles = vec![role; points.len()];
        self.marks.push(Marks { name: name.to_owned(), points, roles, shape: Some(shape) });
        self
    }

    /// Fills the stretch between the least and the greatest of several runs, both at the same x, behind the lines.
    #[must_use]
    pub fn spread(
        mut self,
        name: &str,
        role: Role,
        least: Vec<(f64, f64)>,
        greatest: Vec<(f64, f64)>,
    ) -> Self {
        let names = [format!("{name} least"), format!("{name} greatest")];
        self.spreads.push(Spread { names, role, least, greatest });
        self
    }

    /// Adds a limit.
    #[must_use]
    pub fn limit(mut self, value: f64, label: &str) -> Self {
        self.limits.push(Limit { value, label: label.to_owned() });
        self
    }

    /// Shades a stretch of the x axis.
    #[must_use]
    pub fn band(mut self, from: f64, to: f64, name: &str) -> Self {
        self.bands.push(Band { from, to, name: name.to_owned() });
        self
    }

    /// Names and points of the lines, of the published points, then of the ends of spreads.
    fn columns(&self) -> impl Iterator<Item = (&str, &[(f64, f64)])> {
        let lines = self.series.iter().map(|s| (s.name.as_str(), s.points.as_slice()));
        let marks = self.marks.iter().map(|m| (m.name.as_str(), m.points.as_slice()));
        let ends = self.spreads.iter().flat_map(|s| {
            let [least, greatest] = &s.names;
            [(least.as_str(), s.least.as_slice()), (greatest.as_str(), s.greatest.as_slice())]
        });
        lines.chain(marks).chain(ends)
    }
}

/// A picture and the table behind it.
///
/// ```
/// use experiments::figure::{Figure, Panel, Quantity, Role, Theme, Width, to_csv, to_svg};
///
/// let velocity = Panel::new(Quantity::new("velocity", "v", "m/s"))
///     .line("", Role::Ours, vec![(0.0, 0.0), (0.05, 0.2)])
///     .limit(0.2, "v_max");
/// let figure = Figure::new("fig7", "A ramp to 0.2 m/s", Quantity::time()).panel(velocity);
/// assert_eq!(to_csv(&figure).unwrap(), "time [s],velocity [m/s]\n0.0,0.0\n0.05,0.2\n");
/// assert!(to_svg(&figure, Width::Wide, Theme::Light).unwrap().contains("velocity v [m/s]"));
/// ```
#[derive(Clone, Debug)]
pub struct Figure {
    /// Name of its files and in `expected.toml`: `a-z`, `0-9` and `-`.
    pub id: String,
    /// One line, with the paper's figure number where it has one.
    pub title: String,
    /// The axis all panels share.
    pub x: Quantity,
    /// From top to bottom.
    pub panels: Vec<Panel>,
    /// Whether a unit is as long along y as along x, as on a map.
    pub to_scale: bool,
    /// Whether every panel has a legend of its own, so that a colour may name another line in another panel.
    pub own_legends: bool,
}

impl Figure {
    /// A figure without panels.
    #[must_use]
    pub fn new(id: &str, title: &str, x: Quantity) -> Self {
        let (id, title) = (id.to_owned(), title.to_owned());
        Self { id, title, x, panels: Vec::new(), to_scale: false, own_legends: false }
    }

    /// Draws a unit as long along y as along x.
    #[must_use]
    pub fn to_scale(self) -> Self {
        Self { to_scale: true, ..self }
    }

    /// Gives every panel a legend of its own.
    #[must_use]
    pub fn own_legends(self) -> Self {
        Self { own_legends: true, ..self }
    }

    /// Adds a panel below the others.
    #[must_use]
    pub fn panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// Checks that the figure can be drawn and tabulated.
    ///
    /// # Errors
    /// An id that is no file name, no panels, a panel without points, a number that is not finite, a band that ends
    /// before it starts, or two columns of one name.
    pub fn check(&self) -> Result<()> {
        let id = &self.id;
        ensure!(is_file_name(id), "figure '{id}': an id is made of a-z, 0-9 and '-'");
        ensure!(!self.panels.is_empty(), "figure '{id}' has no panels");
        let mut names = std::collections::BTreeSet::new();
        for panel in &self.panels {
            let y = &panel.y.name;
            ensure!(panel.columns().next().is_some(), "figure '{id}', panel '{y}' has no series");
            for (name, points) in panel.columns() {
                ensure!(!points.is_empty(), "figure '{id}', panel '{y}', series '{name}' has no points");
                if let Some(n) = points.iter().position(|p| !self.x.takes(p.0) || !panel.y.takes(p.1)) {
                    bail!(
                        "figure '{id}', panel '{y}', series '{name}': point {n} is not finite, or not above zero on an \
                         axis of decades"
                    );
                }
                ensure!(names.insert((y, name)), "figure '{id}': two series '{name}' of '{y}'");
            }
            let paired = |s: &Spread| {
                s.least.len() == s.greatest.len()
                    && s.least.iter().zip(&s.greatest).all(|(a, b)| a.0.to_bits() == b.0.to_bits())
            };
            ensure!(
                panel.spreads.iter().all(paired),
                "figure '{id}', panel '{y}': a spread whose ends differ in x"
            );
            let placed = panel.limits.iter().all(|l| panel.y.takes(l.value));
            ensure!(placed, "figure '{id}', panel '{y}': a limit has no place on its axis");
            let ordered =
                panel.bands.iter().all(|b| self.x.takes(b.from) && self.x.takes(b.to) && b.from <= b.to);
            ensure!(ordered, "figure '{id}', panel '{y}': a band does not end after it starts");
        }
        Ok(())
    }
}

/// Whether `id` is safe as the name of a file everywhere: `a-z`, `0-9` and `-`, at least one.
#[must_use]
pub fn is_file_name(id: &str) -> bool {
    !id.is_empty() && id.bytes().all(|b| matches!(b, b'a'..=b'z' | b'0'..=b'9' | b'-'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn velocity() -> Panel {
        Panel::new(Quantity::new("velocity", "v", "m/s")).line("", Role::Ours, vec![(0.0, 0.0), (1.0, 1.0)])
    }

    fn problem(figure: &Figure) -> String {
        figure.check().unwrap_err().to_string()
    }

    #[test]
    fn labels_leave_out_what_is_empty() {
        assert_eq!(Quantity::new("jerk", "j", "m/s^3").label(), "jerk j [m/s³]");
        assert_eq!(Quantity::new("iteration", "", "").label(), "iteration");
    }

    #[test]
    fn a_figure_that_cannot_be_drawn_says_why() {
        let figure = |panel| Figure::new("fig1", "", Quantity::time()).panel(panel);
        assert!(figure(velocity()).check().is_ok());
        assert!(problem(&Figure::new("Fig 1", "", Quantity::time())).contains("'Fig 1'"));
        assert!(problem(&Figure::new("fig1", "", Quantity::time())).contains("no panels"));
        assert!(problem(&figure(Panel::new(Quantity::time()))).contains("no series"));
        assert!(problem(&figure(velocity().line("b", Role::Second, vec![]))).contains("no points"));
        let infinite = velocity().line("b", Role::Second, vec![(0.0, 0.0), (1.0, f64::INFINITY)]);
        assert!(problem(&figure(infinite)).contains("point 1 is not finite"));
        assert!(problem(&figure(velocity()).panel(velocity())).contains("two series"));
        assert!(problem(&figure(velocity().limit(f64::NAN, ""))).contains("limit"));
        assert!(problem(&figure(velocity().band(1.0, 0.0, ""))).contains("band"));
        let zero = Panel::new(Quantity::new("error", "", "m").logarithmic()).line(
            "",
            Role::Ours,
            vec![(0.0, 1.0), (1.0, 0.0)],
        );
        assert!(problem(&figure(zero)).contains("point 1"));
    }
}
