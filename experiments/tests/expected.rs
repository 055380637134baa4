//! `expected.toml`: every mistake has its error, and what was measured finds its row.

#![expect(clippy::unwrap_used, reason = "helpers of tests fail as tests do")]

use experiments::expected::{ExpectedError, compare, parse};
use experiments::experiment::Outcome;
use experiments::figure::{Figure, Panel, Quantity, Role};
use experiments::row::{Finding, Status, Surprise, Tolerance, Value};

const GOOD: &str = r#"
[[row]]
metric = "error/0.01"
unit = "um"
source = "fig. 8"
published = 6
tolerance = { rel = 0.01 }
status = "match"
why = "a reason"
figure = "fig8"
readme = false
"#;

fn outcome(values: &[(&str, Value)]) -> Outcome {
    let mut outcome = Outcome::default();
    let panel = Panel::new(Quantity::time()).line("", Role::Ours, vec![(0.0, 0.0)]);
    outcome.figure(Figure::new("fig8", "", Quantity::time()).panel(panel));
    for (metric, value) in values {
        outcome.measure(*metric, value.clone());
    }
    outcome
}

/// The one finding of a file, and a measured value for its row.
fn find(text: &str, value: impl Into<Value>) -> Finding {
    let rows = parse(text).unwrap();
    let mut findings = compare("demo", &rows, &outcome(&[(&rows[0].metric, value.into())])).unwrap();
    assert_eq!(findings.len(), 1);
    findings.remove(0)
}

#[test]
fn a_row_is_read_whole() {
    let rows = parse(GOOD).unwrap();
    let row = &rows[0];
    assert_eq!((row.metric.as_str(), row.unit.as_str()), ("error/0.01", "um"));
    assert_eq!(row.source.as_deref(), Some("fig. 8"));
    assert_eq!(row.published, Some(Value::Number(6.0)));
    assert_eq!(row.tolerance, Some(Tolerance::Rel(0.01)));
    assert_eq!(row.status, Status::Match);
    assert_eq!(
        (row.why.as_deref(), row.figure.as_deref(), row.readme),
        (Some("a reason"), Some("fig8"), false)
    );
    assert!(parse("").unwrap().is_empty());
    assert!(parse("[[row]]\nmetric = \"n\"\nstatus = \"ours\"").unwrap()[0].readme);
}

#[test]
fn what_is_not_the_format_is_an_error_with_a_line() {
    let line = |text: &str| match parse(text) {
        Err(ExpectedError::Toml { line, .. }) => line,
        other => panic!("{other:?}"),
    };
    assert_eq!(line(&GOOD.replace("source", "sorce")), 5);
    assert_eq!(line(&GOOD.replace("\"match\"", "\"matches\"")), 8);
    assert!(line(&GOOD.replace("rel =", "relative =")) > 0);
    assert!(line(&GOOD.replace("rel = 0.01", "rel = 0.01, abs = 1")) > 0);
    assert!(line(&GOOD.replace("= 6\n", "= true\n")) > 0);
    assert!(line(&GOOD.replace("metric = \"error/0.01\"\n", "")) > 0);
    assert!(line(&format!("{GOOD}\n[other]\n")) > 0);
}

#[test]
fn every_rule_has_its_error() {
    let fails = |from: &str, to: &str| parse(&GOOD.replace(from, to)).unwrap_err();
    let metric = || "error/0.01".to_owned();
    for name in ["", "Error/peak", "error//peak", "/error", "error peak", "error_peak"] {
        assert_eq!(fails("error/0.01", name), ExpectedError::Metric(name.to_owned()));
    }
    assert_eq!(parse(&format!("{GOOD}{GOOD}")).unwrap_err(), ExpectedError::Twice(metric()));
    assert_eq!(
        parse(&GOOD.replace("match", "deviates").replace("a reason", " ")).unwrap_err(),
        ExpectedError::NoWhy(metric())
    );
    assert_eq!(fails("published = 6\n", ""), ExpectedError::NoPublished(metric()));
    assert_eq!(fails("tolerance = { rel = 0.01 }\n", ""), ExpectedError::NoTolerance(metric()));
    assert_eq!(fails("= 6\n", "= nan\n"), ExpectedError::PublishedNotFinite(metric()));
    for (from, to) in [
        ("rel = 0.01", "rel = -0.01"),
        ("rel = 0.01", "rel = inf"),
        ("rel = 0.01", "abs = nan"),
        ("rel = 0.01", "at_least = inf"),
        ("rel = 0.01", "exact = false"),
        ("= 6\n", "= 0.0\n"),
        ("= 6\n", "= \"six\"\n"),
    ] {
        assert!(matches!(fails(from, to), ExpectedError::Tolerance { .. }), "{to}");
    }
    // A bound alone can judge a number where a word is printed.
    assert!(parse(&GOOD.replace("= 6\n", "= \"below 6\"\n").replace("rel = 0.01", "at_most = 6")).is_ok());
}

#[test]
fn a_row_out_of_the_readme_is_recorded_or_matches() {
    let deviating = GOOD.replace("match", "deviates");
    assert_eq!(parse(&deviating).unwrap_err(), ExpectedError::NotRecorded("error/0.01".into()));
    assert!(parse(&deviating.replace("readme = false\n", "")).is_ok());
    let recorded = format!("{deviating}ours = 9.0\n");
    assert!(parse(&recorded.replace("9.0", "inf")).is_err());
    // Within 1 % of what was recorded, whatever the tolerance of the published value.
    assert_eq!(find(&recorded, 9.05).surprise, None);
    assert_eq!(find(&recorded, 9.2).surprise, Some(Surprise::Drifted));
    assert_eq!(find(&recorded, "unstable").surprise, Some(Surprise::Drifted));
    let word = format!("{deviating}ours = \"unstable\"\n");
    assert_eq!(find(&word, "unstable").surprise, None);
    assert_eq!(find(&word, 9.0).surprise, Some(Surprise::Drifted));
    // A row of our own has its own tolerance.
    let ours = format!("{}ours = 100.0\n", GOOD.replace("match", "ours").replace("0.01 }", "0.05 }"));
    assert_eq!(find(&ours, 104.0).surprise, None);
    assert_eq!(find(&ours, 106.0).surprise, Some(Surprise::Drifted));
}

#[test]
fn rows_and_measurements_are_one_to_one() {
    let rows = parse(GOOD).unwrap();
    let number = |x: f64| Value::Number(x);
    let fails = |values: &[(&str, Value)]| compare("demo", &rows, &outcome(values)).unwrap_err();
    assert_eq!(fails(&[]), ExpectedError::NotMeasured("error/0.01".into()));
    assert_eq!(
        fails(&[("error/0.01", number(6.0)), ("error/0.02", number(6.0))]),
        ExpectedError::NotExpected("error/0.02".into())
    );
    assert_eq!(
        fails(&[("error/0.01", number(6.0)), ("error/0.01", number(6.0))]),
        ExpectedError::MeasuredTwice("error/0.01".into())
    );
    assert_eq!(
        fails(&[("error/0.01", number(f64::INFINITY))]),
        ExpectedError::NotFinite { metric: "error/0.01".into(), value: f64::INFINITY }
    );
    let elsewhere = parse(&GOOD.replace("fig8", "fig9")).unwrap();
    assert_eq!(
        compare("demo", &elsewhere, &outcome(&[("error/0.01", number(6.0))])).unwrap_err(),
        ExpectedError::NoFigure { metric: "error/0.01".into(), figure: "fig9".into() }
    );
}

#[test]
fn a_row_says_what_was_found() {
    let matching = find(GOOD, 6.05);
    assert_eq!((matching.row.status, matching.surprise), (Status::Match, None));
    assert_eq!(matching.row.why.as_deref(), Some("a reason"));

    let left = find(GOOD, 6.07);
    assert_eq!((left.row.status, left.surprise), (Status::Deviates, Some(Surprise::Left)));
    assert!(left.row.why.unwrap().contains("has left its tolerance"));

    let deviating = GOOD.replace("match", "deviates").replace("readme = false\n", "");
    let found = find(&deviating, 6.07);
    assert_eq!((found.row.status, found.surprise), (Status::Deviates, None));
    let now = find(&deviating, 6.05);
    assert_eq!((now.row.status, now.surprise), (Status::Match, Some(Surprise::NowMatches)));

    let ours = find(&GOOD.replace("match", "ours").replace("readme = false\n", ""), 100.0);
    assert_eq!((ours.row.status, ours.surprise), (Status::Ours, None));
}
