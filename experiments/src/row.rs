//! A row: what is published, what we measured, how far apart they may be, and why.

use serde::{Deserialize, Serialize};

use crate::number;

/// A published or measured value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// In the row's unit.
    Number(f64),
    /// A word, such as `unstable`.
    Text(String),
}

impl Value {
    /// The number, if it is one.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(x) => Some(*x),
            Self::Text(_) => None,
        }
    }

    /// A published value, every digit kept.
    #[must_use]
    pub fn published(&self) -> String {
        match self {
            Self::Number(x) => number::shortest(*x),
            Self::Text(text) => text.clone(),
        }
    }

    /// A measured value, in [`number::DIGITS`] digits.
    #[must_use]
    pub fn measured(&self) -> String {
        match self {
            Self::Number(x) => number::short(*x),
            Self::Text(text) => text.clone(),
        }
    }
}

impl From<f64> for Value {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}

impl From<u32> for Value {
    fn from(n: u32) -> Self {
        Self::Number(f64::from(n))
    }
}

impl From<usize> for Value {
    /// Counts are far below 2^53, above which this would round.
    fn from(n: usize) -> Self {
        Self::Number(n as f64)
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

/// How far a measured value may be from the published one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tolerance {
    /// `|measured - published| <= abs`, in the row's unit.
    Abs(f64),
    /// `|measured - published| <= rel |published|`.
    Rel(f64),
    /// `measured >= at_least`, in the row's unit.
    AtLeast(f64),
    /// `measured <= at_most`, in the row's unit.
    AtMost(f64),
    /// `measured = published`; always `true`.
    Exact(bool),
}

impl Tolerance {
    /// Whether `measured` may stand for `published`; a number never may for a word.
    #[must_use]
    pub fn holds(&self, published: Option<&Value>, measured: &Value) -> bool {
        let distance = || Some((measured.number()? - published?.number()?).abs());
        match *self {
            Self::Abs(abs) => distance().is_some_and(|d| d <= abs),
            Self::Rel(rel) => {
                let scale = published.and_then(Value::number).map_or(0.0, f64::abs);
                distance().is_some_and(|d| d <= rel * scale)
            }
            Self::AtLeast(bound) => measured.number().is_some_and(|x| x >= bound),
            Self::AtMost(bound) => measured.number().is_some_and(|x| x <= bound),
            Self::Exact(_) => published == Some(measured),
        }
    }

    /// As it is shown; `unit` is the row's.
    #[must_use]
    pub fn show(&self, unit: &str) -> String {
        let unit = number::pretty_unit(unit);
        let with_unit =
            |sign: &str, x: f64| format!("{sign}{} {unit}", number::shortest(x)).trim_end().to_owned();
        match *self {
            Self::Abs(abs) => with_unit("±", abs),
            // In parts, 0.07 * 100 is 7.000000000000001.
            Self::Rel(rel) => format!("±{} %", number::short(rel * 100.0)),
            Self::AtLeast(bound) => with_unit("≥ ", bound),
            Self::AtMost(bound) => with_unit("≤ ", bound),
            Self::Exact(_) => "exact".to_owned(),
        }
    }
}

/// What a row says about the published value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Ours is within the tolerance.
    Match,
    /// Ours is outside the tolerance.
    Deviates,
    /// Nothing is published, or what is published is shown for reference.
    Ours,
}

impl Status {
    /// The word in `expected.toml` and `summary.json`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Match => "match",
            Self::Deviates => "deviates",
            Self::Ours => "ours",
        }
    }
}

/// One row of `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// Id of the experiment.
    pub experiment: String,
    /// Lower-case, slash-separated.
    pub metric: String,
    /// ASCII; empty for a pure number or a word.
    pub unit: String,
    /// Where in the paper the value stands.
    pub source: Option<String>,
    /// The paper's value.
    pub published: Option<Value>,
    /// Ours.
    pub measured: Option<Value>,
    /// How far apart they may be.
    pub tolerance: Option<Tolerance>,
    /// What this run found, whatever was expected.
    pub status: Status,
    /// Why it deviates, or what was assumed.
    pub why: Option<String>,
}

impl Row {
    /// The error as it is shown: in the unit under an absolute tolerance, else in percent of the published value.
    #[must_use]
    pub fn error(&self) -> Option<String> {
        let published = self.published.as_ref()?.number()?;
        let difference = self.measured.as_ref()?.number()? - published;
        if matches!(self.tolerance, Some(Tolerance::Abs(_))) || published == 0.0 {
            let text = format!("{} {}", number::signed(difference), number::pretty_unit(&self.unit));
            Some(text.trim_end().to_owned())
        } else {
            Some(format!("{} %", number::signed(100.0 * difference / published.abs())))
        }
    }
}

/// Why a row does not say what `expected.toml` says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surprise {
    /// Expected to match, and outside the tolerance.
    Left,
    /// Expected to deviate, and inside the tolerance.
    NowMatches,
    /// Not the value recorded as ours.
    Drifted,
}

impl Surprise {
    /// For a list of problems.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Left => "has left its tolerance",
            Self::NowMatches => "is listed as deviating and now matches",
            Self::Drifted => "is no longer the value recorded as ours",
        }
    }
}

/// A row, where it is shown, and whether it is as expected.
#[derive(Clone, Debug)]
pub struct Finding {
    /// What goes into `summary.json`.
    pub row: Row,
    /// The figure it is shown with.
    pub figure: Option<String>,
    /// Whether the README's table has it.
    pub readme: bool,
    /// Set where the row is not what `expected.toml` says.
    pub surprise: Option<Surprise>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn holds(tolerance: Tolerance, published: impl Into<Value>, measured: impl Into<Value>) -> bool {
        tolerance.holds(Some(&published.into()), &measured.into())
    }

    #[test]
    fn a_tolerance_includes_its_edge() {
        assert!(holds(Tolerance::Abs(0.5), 6.5, 6.0));
        assert!(!holds(Tolerance::Abs(0.5), 6.5, 5.99));
        assert!(holds(Tolerance::Rel(0.25), -4.0, -5.0));
        assert!(!holds(Tolerance::Rel(0.25), -4.0, -5.01));
        assert!(holds(Tolerance::AtLeast(20.0), 20.0, 22.9));
        assert!(!holds(Tolerance::AtLeast(20.0), 20.0, 12.2));
        assert!(holds(Tolerance::AtMost(1.0), "below 1", 1.0));
        assert!(!holds(Tolerance::AtMost(1.0), "below 1", 1.1));
    }

    #[test]
    fn words_match_exactly_and_never_a_number() {
        assert!(holds(Tolerance::Exact(true), "unstable", "unstable"));
        assert!(!holds(Tolerance::Exact(true), "unstable", "stable"));
        assert!(!holds(Tolerance::Exact(true), "unstable", 1.0));
        assert!(!holds(Tolerance::Abs(1.0), 1.0, "unstable"));
        assert!(!holds(Tolerance::AtLeast(1.0), 1.0, "unstable"));
        assert!(!Tolerance::Abs(1.0).holds(None, &Value::Number(1.0)));
    }

    #[test]
    fn nan_is_in_no_tolerance() {
        for tolerance in [
            Tolerance::Abs(1.0),
            Tolerance::Rel(1.0),
            Tolerance::AtLeast(0.0),
            Tolerance::AtMost(0.0),
            Tolerance::Exact(true),
        ] {
            assert!(!holds(tolerance, f64::NAN, f64::NAN));
        }
    }

    #[test]
    fn the_error_is_shown_in_the_tolerances_terms() {
        let mut row = Row {
            experiment: "demo".into(),
            metric: "error/peak".into(),
            unit: "um".into(),
            source: None,
            published: Some(6.5.into()),
            measured: Some(6.45.into()),
            tolerance: Some(Tolerance::Rel(0.01)),
            status: Status::Match,
            why: None,
        };
        assert_eq!(row.error().unwrap(), "-0.77 %");
        row.tolerance = Some(Tolerance::Abs(0.1));
        assert_eq!(row.error().unwrap(), "-0.05 µm");
        row.measured = Some("unstable".into());
        assert_eq!(row.error(), None);
        assert_eq!(Tolerance::Rel(0.07).show("um"), "±7 %");
        assert_eq!(Tolerance::AtLeast(0.1).show("um"), "≥ 0.1 µm");
        assert_eq!(Tolerance::Abs(3.0).show(""), "±3");
    }
}
