//! `experiments tune`: what a person's log gives, and what is said of one that cannot be used.

#![expect(clippy::unwrap_used, reason = "helpers of tests fail as tests do")]

#[path = "../common/mod.rs"]
mod common;
mod refusals;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use common::{Done, bench, folder, names};
use plants::{GaussianNoise, Noise, TransferFunction};
use profiles::Mode;
use serde_json::Value;

const EXAMPLE: &str = include_str!("../../data/example-log.csv");
/// A move with limits, as they are typed.
const MOVE: [&str; 8] =
    ["--distance", "0.1", "--max-velocity", "0.5", "--max-acceleration", "5", "--max-jerk", "200"];

/// Runs `tune` on a log of this text in a folder of this name.
fn tune(name: &str, text: impl AsRef<[u8]>, more: &[&str]) -> (PathBuf, Done) {
    let root = folder(name);
    std::fs::write(root.join("log.csv"), text).unwrap();
    let log = root.join("log.csv");
    let out = root.join("report");
    let mut arguments = vec!["tune", log.to_str().unwrap(), "--out", out.to_str().unwrap()];
    arguments.extend(more);
    let done = bench(&[], &root, &arguments);
    (out, done)
}

fn parameters(out: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(out.join("parameters.json")).unwrap()).unwrap()
}

fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or(f64::NAN)
}

fn count(value: &Value, path: &str) -> Option<u64> {
    value.pointer(path).and_then(Value::as_u64)
}

/// The example's lines of data with another head.
fn with_head(head: &str) -> String {
    let data = EXAMPLE.lines().skip_while(|line| !line.starts_with("0.000")).collect::<Vec<_>>().join("\n");
    format!("{head}{data}\n")
}

/// A step of 0.1 and what a load on a spring makes of it, as a table with this separator.
fn step(separator: char, samples: u32) -> String {
    let mut text = String::new();
    let load = TransferFunction::from_coefficients(&[2500.0], &[1.0, 4.0, 2500.0]).unwrap();
    let (mut load, mut noise) = (load.held(1e-3).unwrap(), GaussianNoise::new(1e-5, 1).unwrap());
    for n in 0..samples {
        let u = if n < 100 { 0.0 } else { 0.1 };
        let y = load.update(u) + noise.sample();
        writeln!(text, "{:.3}{separator}{u}{separator}{y:.6}", f64::from(n) * 1e-3).unwrap();
    }
    text
}

#[test]
fn the_example_gives_its_modes_a_move_and_a_shaper() {
    let (out, done) = tune("tune-example", EXAMPLE, &MOVE);
    assert_eq!((done.code, done.err.as_str()), (0, ""));
    let found = parameters(&out);
    assert_eq!(found["class"], "C");
    let modes = found["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 2, "{modes:?}");
    for (mode, (hz, damping)) in modes.iter().zip([(8.0, 0.03), (18.0, 0.02)]) {
        let within = |value: &str, deviation: &str, truth: f64| {
            let (value, deviation) = (number(mode, value), number(mode, deviation));
            assert!((value - truth).abs() < 3.0 * deviation, "{value} ± {deviation}, not {truth}");
        };
        within("/frequency_hz", "/frequency_deviation_hz", hz);
        within("/frequency_rad_s", "/frequency_deviation_rad_s", hz * std::f64::consts::TAU);
        within("/damping_ratio", "/damping_deviation", damping);
    }
    // The first is known to a thousandth.
    assert!(number(&modes[0], "/frequency_deviation_hz") < 8e-3);
    assert_eq!(count(&found, "/log/lines_left_out"), Some(0));
    assert!(found["shaper"]["within"].as_bool().unwrap() && number(&found, "/shaper/worst_part") <= 0.05);

    let mut files: Vec<String> =
        ["move-table.csv", "parameters.json", "report.html"].map(str::to_owned).to_vec();
    for figure in ["fit", "log", "move", "sensitivity", "shapers", "spectrum"] {
        files.extend(["csv", "png", "svg"].map(|ending| format!("{figure}.{ending}")));
    }
    files.sort();
    assert_eq!(names(&out), files);
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    for text in [
        "mode 1",
        "mode 2",
        "Recommended move",
        "S-curve with ZV",
        "--distance 0.1",
        // Sentences with units.
        "put it through ZV at 8.000 Hz and ZV at 18.00 Hz, one after the other",
        "<p>The response goes 0.9994 m for 1 m of the command.</p>",
        "within a velocity of 0.5 m&#x2f;s, an acceleration of 5 m&#x2f;s² and a jerk of 200 m&#x2f;s³",
        "vibration left [m]",
    ] {
        assert!(page.contains(text), "{text}");
    }
    // The first one begins with the name of the file.
    let firsts: Vec<char> = page.split("<p>").skip(2).filter_map(|rest| rest.chars().next()).collect();
    assert!(firsts.len() > 6 && firsts.iter().all(|first| !first.is_lowercase()), "{firsts:?}");
    // Every axis of the move has its unit.
    let table = std::fs::read_to_string(out.join("move.csv")).unwrap();
    let head = table.lines().next().unwrap();
    for column in
        ["velocity S-curve [m/s]", "acceleration S-curve [m/s^2]", "vibration of the response S-curve [m]"]
    {
        assert!(head.contains(column), "{head}");
    }
    assert!(done.out.contains("response class C") && done.out.ends_with("report.html\n"), "{}", done.out);
    // A second run replaces the first, byte for byte.
    let before = std::fs::read(out.join("report.html")).unwrap();
    let arguments =
        ["tune", out.parent().unwrap().join("log.csv").to_str().unwrap(), "--out"].map(str::to_owned);
    let arguments: Vec<&str> =
        arguments.iter().map(String::as_str).chain([out.to_str().unwrap()]).chain(MOVE).collect();
    assert_eq!(bench(&[], out.parent().unwrap(), &arguments).code, 0);
    assert!(std::fs::read(out.join("report.html")).unwrap() == before);
}

#[test]
fn the_recommended_move_leaves_less_than_tolerated_on_the_true_axis() {
    let (out, done) = tune("tune-true", EXAMPLE, &[&MOVE[..], &["--tick", "0.0005"]].concat());
    assert_eq!(done.code, 0, "{}", done.err);
    let found = parameters(&out);
    let (tolerated, best) = (number(&found, "/move/tolerated"), &found["move"]["candidates"][0]);
    assert!((tolerated - 1e-4).abs() < 1e-6);
    assert_eq!(best["kind"], found["move"]["recommended"]);
    assert!(number(best, "/worst_vibration") <= tolerated && number(best, "/settling_s") <= 0.0);
    let plain = found["move"]["candidates"].as_array().unwrap();
    let plain = plain.iter().find(|candidate| candidate["kind"] == "S-curve").unwrap();
    assert!(number(best, "/total_s") < number(plain, "/total_s"));

    // The table of the move, held from tick to tick, drives the axis that wrote the log.
    let text = std::fs::read_to_string(out.join("move-table.csv")).unwrap();
    assert!(text.starts_with("time [s],position [m],velocity [m/s],"), "{}", text.lines().next().unwrap());
    let positions: Vec<f64> =
        text.lines().skip(1).map(|line| line.split(',').nth(1).unwrap().parse().unwrap()).collect();
    let rest = 8000;
    let mut swing = vec![0.0; rest];
    for (hz, damping, part) in [(8.0, 0.03, 0.7), (18.0, 0.02, 0.3)] {
        let mode = Mode::from_hz(hz, damping).unwrap();
        let (w, z) = (mode.angular_frequency(), mode.damping_ratio());
        let load = TransferFunction::from_coefficients(&[part * w * w], &[1.0, 2.0 * z * w, w * w]).unwrap();
        let mut load = load.held(5e-4).unwrap();
        positions.iter().for_each(|x| {
            load.update(*x);
        });
        swing.iter_mut().for_each(|y| *y += load.update(0.1));
    }
    let left = swing.iter().map(|y| (y - 0.1).abs()).fold(0.0, f64::max);
    assert!(left <= tolerated, "{left}");
    // And it is not rest that was asked for: the S-curve leaves thirty times as much.
    assert!(number(plain, "/vibration") > 10.0 * tolerated);
}

#[test]
fn modes_and_shaper_need_no_limits() {
    let (out, done) = tune("tune-modes", EXAMPLE, &[]);
    assert_eq!(done.code, 0, "{}", done.err);
    assert_eq!(parameters(&out)["move"], Value::Null);
    assert!(!names(&out).iter().any(|name| name.starts_with("move")));
    let root = folder("tune-usage");
    std::fs::write(root.join("log.csv"), EXAMPLE).unwrap();
    let log = root.join("log.csv");
    for (more, says) in [
        (&["--distance", "0.1"][..], "--max-velocity"),
        (&["--max-jerk", "5"], "--distance"),
        (
            &["--distance", "0", "--max-velocity", "1", "--max-acceleration", "1", "--max-jerk", "1"],
            "--distance",
        ),
        (&["--distance", "1", "--max-velocity", "-1", "--max-acceleration", "1", "--max-jerk", "1"], "-1"),
        (&["--tolerated-part", "0"], "--tolerated-part"),
        (&["--deviations", "nan"], "--deviations"),
        (&["--from", "nan"], "--from must be finite, got NaN"),
        (&["--to", "inf"], "--to must be finite, got inf"),
        (&[&MOVE[..], &["--tick", "1e-7"]].concat(), "e6 rows, the most is 1e6"),
        (&["--method", "guess"], "guess"),
    ] {
        let done = bench(&[], &root, &[&["tune", log.to_str().unwrap()], more].concat());
        assert_eq!((done.code, done.err.lines().count()), (2, 1), "{}", done.err);
        assert!(done.err.contains(says), "{} lacks {says}", done.err);
    }
    assert_eq!(names(&root), ["log.csv"]);
}

#[test]
fn tables_come_in_many_forms() {
    let plain = step(',', 1500);
    let head = "time,command,response\n";
    let decimal = step(';', 1500).replace('.', ",");
    let forms: [(&str, Vec<u8>, &[&str]); 9] = [
        ("comma", format!("{head}{plain}").into(), &[]),
        ("semicolon", format!("time;command;response\n{decimal}").into(), &[]),
        (
            "tab",
            format!("# a remark\n#t\tu\ty\n{}", step('\t', 1500)).into(),
            &["--time", "t", "--command", "u", "--response", "y"],
        ),
        ("bare", plain.clone().into(), &["--time", "1", "--command", "2", "--response", "3"]),
        ("crlf", format!("{head}{plain}").replace('\n', "\r\n").into(), &[]),
        ("mark", format!("\u{FEFF}{head}\n{plain}\n\n").into(), &[]),
        ("units", format!("Time (ms),Command (m),Response (m)\n{plain}").into(), &["--time-unit", "s"]),
        (
            "latin",
            [b"Zeit [s],Sollwert [\xB0],Istwert [\xB0]\n".as_slice(), plain.as_bytes()].concat(),
            &["--time", "Zeit", "--command", "Sollwert", "--response", "istwert"],
        ),
        (
            "comments",
            plain.lines().fold(head.to_owned(), |text, line| text + line + "\n# between\n").into(),
            &[],
        ),
    ];
    for (name, text, more) in forms {
        let (out, done) = tune(&format!("tune-form-{name}"), text, more);
        assert_eq!(done.code, 0, "{name}: {}", done.err);
        let found = parameters(&out);
        // 50 rad/s, damping ratio 0.04.
        assert!((number(&found, "/modes/0/frequency_rad_s") - 50.0).abs() < 0.05, "{name}: {found}");
        assert!((number(&found, "/modes/0/damping_ratio") - 0.04).abs() < 1e-3, "{name}: {found}");
        assert_eq!(count(&found, "/log/samples"), Some(1500), "{name}");
    }
}

#[test]
fn the_unit_of_time_is_in_the_header() {
    let in_ms: String = step(',', 1500)
        .lines()
        .map(|line| {
            let (time, rest) = line.split_once(',').unwrap();
            format!("{},{rest}\n", (time.parse::<f64>().unwrap() * 1e3).round())
        })
        .collect();
    let (out, done) = tune("tune-ms", format!("time [ms],command,response\n{in_ms}"), &[]);
    assert_eq!(done.code, 0, "{}", done.err);
    assert!((number(&parameters(&out), "/modes/0/frequency_rad_s") - 50.0).abs() < 0.05);
}

#[test]
fn uneven_samples_are_said_to_be_put_on_a_grid() {
    let uneven: String = step(',', 1500)
        .lines()
        .enumerate()
        .map(|(n, line)| {
            let (time, rest) = line.split_once(',').unwrap();
            format!("{:.6},{rest}\n", time.parse::<f64>().unwrap() + 1e-4 * ((n * 7) % 3) as f64)
        })
        .collect();
    let (out, done) = tune("tune-uneven", format!("time,command,response\n{uneven}"), &[]);
    assert_eq!(done.code, 0, "{}", done.err);
    assert!(done.out.contains("put on a grid of 0.001 s by straight lines"), "{}", done.out);
    assert!((number(&parameters(&out), "/modes/0/frequency_rad_s") - 50.0).abs() < 0.05);
}

#[test]
fn a_part_of_the_log_is_chosen_by_time() {
    let (out, done) = tune("tune-from", EXAMPLE, &["--to", "1.9"]);
    assert_eq!(done.code, 0, "{}", done.err);
    assert_eq!(count(&parameters(&out), "/log/samples"), Some(951));
    let (out, done) = tune("tune-to", EXAMPLE, &["--from", "2", "--method", "transfer-function"]);
    assert_eq!(done.code, 0, "{}", done.err);
    assert!((number(&parameters(&out), "/modes/0/frequency_hz") - 8.0).abs() < 0.1);
    assert!((number(&parameters(&out), "/shaper/for_modes_hz/0") - 8.0).abs() < 0.1);
    assert!(parameters(&out)["route"].as_str().unwrap().starts_with("transfer function"));
}

#[test]
fn a_long_log_is_read() {
    // Half a million lines: 500 s at 1 kHz, of which the swing takes a second.
    let (out, done) = tune("tune-long", with_head_of(step(',', 500_000)), &[]);
    assert_eq!(done.code, 0, "{}", done.err);
    let found = parameters(&out);
    assert_eq!(count(&found, "/log/samples"), Some(500_000));
    assert!((number(&found, "/modes/0/frequency_rad_s") - 50.0).abs() < 0.05);
    // Pictures are thinned.
    assert!(std::fs::metadata(out.join("log.csv")).unwrap().len() < 1_000_000);
}

fn with_head_of(data: String) -> String {
    format!("time,command,response\n{data}")
}

#[test]
fn the_last_comment_is_the_header_where_it_fits() {
    let (out, done) = tune(
        "tune-last-comment",
        with_head("# recorded on a Monday, in the rain\n#time,command,response\n"),
        &[],
    );
    assert_eq!(done.code, 0, "{}", done.err);
    assert_eq!(parameters(&out)["log"]["response"], "response");
}
