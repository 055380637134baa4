//! What a run leaves: summary, tables, pictures and page.

#![expect(clippy::unwrap_used, reason = "helpers of tests fail as tests do")]

mod common;

use common::{DEMO, OTHER, bench, folder, names};
use experiments::figure::{Figure, Panel, Quantity, Role, Shape, Theme, Width, to_png, to_svg};
use experiments::report::summary::Summary;
use serde_json::{Value, json};

/// A report of the demo in a folder of this name.
fn report(name: &str, more: &[&str]) -> (std::path::PathBuf, String) {
    let root = folder(name);
    let target = root.join("report");
    let mut arguments = vec!["run", "--out", target.to_str().unwrap()];
    arguments.extend(more);
    let done = bench(&[DEMO, OTHER], &root, &arguments);
    assert_eq!((done.code, done.err.as_str()), (0, ""));
    (target, done.out)
}

fn read(folder: &std::path::Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}

#[test]
fn the_summary_keeps_its_form() {
    let (folder, _) = report("summary", &["--seed", "7"]);
    let text = read(&folder, "summary.json");
    let value: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(value["generated_by"], concat!("stillpoint experiments ", env!("CARGO_PKG_VERSION")));
    assert_eq!(value["seed"], 7);
    assert_eq!(value.as_object().unwrap().len(), 3);
    let rows = value["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 6);
    assert_eq!(
        rows[2],
        json!({
            "experiment": "demo-ramps", "metric": "error/peak", "unit": "um", "source": "fig. 8",
            "published": 6.5, "measured": 6.41, "tolerance": {"rel": 0.01}, "status": "deviates",
            "why": "Which move the figure shows is not printed; a whole move of 40 mm, fitted, comes nearest."
        })
    );
    assert_eq!(
        rows[5],
        json!({
            "experiment": "other", "metric": "sum", "unit": "", "source": null, "published": null,
            "measured": 8.0, "tolerance": null, "status": "ours", "why": null
        })
    );
    let typed: Summary = serde_json::from_str(&text).unwrap();
    assert_eq!(serde_json::to_value(&typed).unwrap(), value);
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    let (first, _) = report("bytes-1", &["--seed", "3"]);
    let (second, _) = report("bytes-2", &["--seed", "3"]);
    assert_eq!(names(&first), names(&second));
    for name in names(&first).iter().filter(|name| first.join(name).is_file()) {
        assert!(
            std::fs::read(first.join(name)).unwrap() == std::fs::read(second.join(name)).unwrap(),
            "{name}"
        );
    }
    let (other, _) = report("bytes-3", &["--seed", "4"]);
    assert_ne!(read(&first, "summary.json"), read(&other, "summary.json"));
}

#[test]
fn every_figure_has_its_files() {
    let (folder, out) = report("files", &[]);
    let mut expected = vec!["demo-ramps".to_owned(), "other".into(), "other/expected.toml".into()];
    for name in ["expected.toml", "experiments-tests-common-mod.rs.txt"] {
        expected.push(format!("demo-ramps/{name}"));
    }
    for figure in ["fig4", "fig7", "fig8"] {
        expected.extend(["csv", "png", "svg"].map(|ending| format!("demo-ramps/{figure}.{ending}")));
    }
    expected.extend(["report.html".to_owned(), "summary.json".to_owned()]);
    expected.sort();
    assert_eq!(names(&folder), expected);
    assert!(
        out.lines().any(|line| line.split_whitespace().eq([
            "error/peak",
            "[µm]",
            "6.5",
            "6.41",
            "-1.4",
            "%",
            "±1",
            "%",
            "deviates"
        ])),
        "{out}"
    );
    assert!(out.ends_with("report.html\n"));
}

#[test]
fn tables_have_names_units_and_numbers() {
    let (folder, _) = report("tables", &[]);
    let text = read(&folder, "demo-ramps/fig4.csv");
    let mut lines = text.lines();
    assert_eq!(
        lines.next().unwrap(),
        "time [s],snap [m/s^4],jerk [m/s^3],acceleration [m/s^2],velocity [m/s]"
    );
    assert_eq!(lines.clone().count(), 2001);
    for line in lines {
        assert!(line.split(',').all(|cell| cell.parse::<f64>().is_ok()), "{line}");
    }
    let header = read(&folder, "demo-ramps/fig7.csv").lines().next().unwrap().to_owned();
    assert!(header.starts_with("time [s],velocity S-curve [m/s],velocity cosine [m/s],"), "{header}");
    assert!(header.contains(",time of velocity trapezoid [s],velocity trapezoid [m/s],"), "{header}");
}

#[test]
fn pictures_are_xml_with_their_labels() {
    let (folder, _) = report("xml", &[]);
    for (figure, labels) in [
        ("fig4", vec!["snap s [m/s⁴]", "velocity v [m/s]", "time t [s]", "−j_max", "−200", "0.15"]),
        ("fig7", vec!["S-curve", "published ramp times", "v_max", "0.05"]),
        ("fig8", vec!["position error e [µm]", "cosine"]),
    ] {
        let text = read(&folder, &format!("demo-ramps/{figure}.svg"));
        let svg = roxmltree::Document::parse(&text).unwrap();
        let root = svg.root_element();
        assert_eq!(root.tag_name().name(), "svg");
        assert!(root.attribute("viewBox").unwrap().starts_with("0 0 720 "));
        let texts: Vec<&str> = svg.descendants().filter(|n| n.is_text()).filter_map(|n| n.text()).collect();
        for label in labels {
            assert!(texts.iter().any(|text| text.trim() == label), "{label} in {figure}: {texts:?}");
        }
        for node in svg.descendants() {
            let links = node.attributes().any(|a| a.name() == "href" || a.value().contains("url("));
            assert!(!links && !["script", "style", "image"].contains(&node.tag_name().name()), "{node:?}");
        }
        let png = std::fs::read(folder.join(format!("demo-ramps/{figure}.png"))).unwrap();
        assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!(u32::from_be_bytes([png[16], png[17], png[18], png[19]]), 1440);
    }
}

#[test]
fn stacked_panels_line_up() {
    let (folder, _) = report("margins", &[]);
    let text = read(&folder, "demo-ramps/fig4.svg");
    let svg = roxmltree::Document::parse(&text).unwrap();
    let edges: std::collections::BTreeSet<String> = svg
        .descendants()
        .filter(|n| n.tag_name().name() == "path" && n.attribute("stroke-width") == Some("1.8"))
        .map(|n| n.attribute("d").unwrap().split_whitespace().nth(1).unwrap().to_owned())
        .collect();
    assert_eq!(edges.len(), 1, "lines start at {edges:?}");
}

#[test]
fn odd_figures_are_drawn_too() {
    let quantity = || Quantity::new("ratio <&>", "", "");
    let panel = Panel::new(quantity())
        .line("flat & \"quoted\"", Role::Reference, vec![(1.0, 3.0), (2.0, 3.0)])
        .marks("a", vec![(1.5, 3.0)])
        .marks("b", vec![(1.5, 3.0)])
        .marks("c", vec![(1.5, 3.0)])
        .band(1.2, 1.4, "band")
        .limit(3.0, "upper")
        .limit(3.0, "lower");
    let point = Panel::new(Quantity::new("y", "", "")).line("", Role::Ours, vec![(1.0, -2e9)]);
    let decades = Panel::new(Quantity::new("error", "e", "m").logarithmic())
        .line("median", Role::Second, vec![(1.0, 1e-9), (2.0, 3e-13)])
        .spread("", Role::Second, vec![(1.0, 1e-10), (2.0, 1e-13)], vec![(1.0, 1e-6), (2.0, 1e-12)])
        .limit(1e-12, "rounding");
    let figure = Figure::new("odd", "", quantity()).panel(panel).panel(point).panel(decades);
    assert!(experiments::figure::to_csv(&figure).unwrap().contains("error  greatest [m]"));
    for width in [Width::Wide, Width::Narrow] {
        for theme in [Theme::Light, Theme::Dark] {
            let text = to_svg(&figure, width, theme).unwrap();
            roxmltree::Document::parse(&text).unwrap();
            assert!(!text.contains("NaN") && !text.contains("inf\""), "{text}");
        }
    }
    assert!(!to_png(&figure).unwrap().is_empty());
}

#[test]
fn a_map_and_a_panel_with_its_own_legend() {
    let quantity = |name: &str| Quantity::new(name, "", "mm");
    let places = Panel::new(quantity("length").logarithmic())
        .places("chosen", Role::Fifth, Shape::Square, vec![(1.0, 10.0), (2.0, 100.0)])
        .places("other", Role::Sixth, Shape::Triangle, vec![(1.0, 100.0)]);
    let line = |name: &str, role| Panel::new(quantity(name)).line(name, role, vec![(1.0, 0.0), (2.0, 1.0)]);
    let second = line("low", Role::Seventh).line("high", Role::Second, vec![(1.0, 1.0), (2.0, 2.0)]);
    let figure = Figure::new("map", "", quantity("x")).panel(places).panel(second);
    let texts = |figure: &Figure| -> Vec<(String, f64)> {
        let svg = to_svg(figure, Width::Wide, Theme::Light).unwrap();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let texts = document.descendants().filter(|n| n.tag_name().name() == "text");
        texts
            .map(|n| (n.text().unwrap_or("").to_owned(), n.attribute("y").unwrap().parse().unwrap()))
            .collect()
    };
    let place = |figure: &Figure, name: &str| texts(figure).iter().find(|t| t.0 == name).unwrap().1;
    // In common: one line above everything.
    assert_eq!(place(&figure, "chosen").to_bits(), place(&figure, "high").to_bits());
    assert!(place(&figure, "high") < place(&figure, "length [mm]"));
    // Each between its label and its panel.
    let own = figure.own_legends();
    assert!(place(&own, "length [mm]") < place(&own, "chosen"));
    assert!(place(&own, "chosen") < place(&own, "low [mm]") && place(&own, "low [mm]") < place(&own, "high"));
    let svg = to_svg(&own, Width::Narrow, Theme::Dark).unwrap();
    // In colour, and twice on the map and once in the legend.
    assert_eq!(svg.matches("#f0e442").count(), 3, "{svg}");
}

#[test]
fn the_page_stands_alone() {
    let (folder, _) = report("page", &["--seed", "9"]);
    let page = read(&folder, "report.html");
    // Every address is a picture inside the page, a place on it, or a file of the report.
    for attribute in ["src=\"", "srcset=\"", "href=\""] {
        for rest in page.split(attribute).skip(1) {
            let address = rest.split('"').next().unwrap().replace("&#x2f;", "/");
            let inside = address.starts_with("data:image/svg+xml,")
                || page.contains(&format!("id=\"{}\"", address.trim_start_matches('#')));
            assert!(inside || folder.join(&address).is_file(), "{address}");
        }
    }
    assert!(!page.contains("<script") && !page.contains("@import") && !page.contains("url("));
    assert!(page.contains("prefers-color-scheme: dark") && page.contains("width=device-width"));
    assert!(page.contains("A paper &lt;that is not there&gt;, 2010."));
    assert!(page.contains("cargo run -p experiments -- run demo-ramps --seed 9"));
    for text in
        ["ramp-time", "6.41", "Two of the gains are exchanged in print.", "status deviates", "±1 %", "−1.4 %"]
    {
        assert!(page.contains(text), "{text}");
    }
}

#[test]
fn a_quick_run_compares_nothing() {
    let (folder, out) = report("quick", &["--quick"]);
    let summary: Value = serde_json::from_str(&read(&folder, "summary.json")).unwrap();
    assert_eq!(summary["rows"], json!([]));
    assert!(!read(&folder, "report.html").contains("<table>"));
    assert_eq!(out.lines().count(), 1);
    assert_eq!(read(&folder, "demo-ramps/fig4.csv").lines().count(), 42);
}
