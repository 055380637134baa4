//! The command line: exit codes, one line per error, and nothing half-written.

#![expect(clippy::unwrap_used, reason = "helpers of tests fail as tests do")]

mod common;

use std::path::Path;
use std::process::{Command, Output};

use common::{BROKEN, DEMO, EXPECTED, OTHER, bench, folder, names};
use experiments::experiment::Experiment;

/// The program itself, with the experiments it has.
fn program(root: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_experiments")).current_dir(root).args(arguments).output().unwrap()
}

fn refused(root: &Path, arguments: &[&str], says: &str) {
    let before = names(root);
    let output = program(root, arguments);
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{err}");
    assert_eq!(err.lines().count(), 1, "{err}");
    assert!(err.starts_with("error: ") && err.contains(says), "{err}");
    assert!(output.stdout.is_empty());
    assert_eq!(names(root), before);
}

#[test]
fn what_cannot_be_met_is_one_line_and_code_2() {
    let root = folder("refused");
    std::fs::write(root.join("file"), "mine").unwrap();
    refused(&root, &["run", "no-such-paper"], "no-such-paper");
    refused(&root, &["check", "no-such-paper"], "no-such-paper");
    refused(&root, &["run", "--seed", "twelve"], "twelve");
    refused(&root, &["run", "--seed", "-1"], "-1");
    refused(&root, &["run", "--seeds", "0"], "0");
    refused(&root, &["run", "--fast"], "--fast");
    refused(&root, &["walk"], "walk");
    refused(&root, &["run", "--out", "file/report"], "file/report");
    refused(&root, &["run", "--out", "file"], "file");
    refused(&root, &["run", "--out", "/"], "/");
    refused(&root, &["run", "--out", ""], "--out");
    // Not through the program, which would find the repository's own README above this folder.
    let done = bench(&[DEMO], &root, &["readme"]);
    assert_eq!((done.code, done.err.lines().count()), (2, 1), "{}", done.err);
    assert!(done.err.contains("README.md"));
    assert_eq!(std::fs::read_to_string(root.join("file")).unwrap(), "mine");
}

#[test]
#[cfg(target_os = "linux")]
fn an_unwritable_folder_is_refused() {
    // Not even root makes folders there.
    refused(&folder("unwritable"), &["run", "--out", "/proc/new/report"], "/proc/new/report");
}

#[test]
fn a_foreign_folder_is_never_replaced() {
    let root = folder("foreign");
    for (name, file, text) in [
        ("notes", "notes.txt", "mine"),
        ("summary", "summary.json", "{\"generated_by\": \"another program\"}"),
        ("broken", "summary.json", "{"),
    ] {
        std::fs::create_dir(root.join(name)).unwrap();
        std::fs::write(root.join(name).join(file), text).unwrap();
        refused(&root, &["run", "--out", name], "is not a report");
        assert_eq!(std::fs::read_to_string(root.join(name).join(file)).unwrap(), text);
    }
}

#[test]
fn help_lists_the_commands() {
    let output = program(&folder("help"), &["--help"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0));
    for command in ["list", "run", "check", "readme", "tune"] {
        assert!(text.contains(&format!("\n  {command}")), "{text}");
    }
}

#[test]
fn no_experiments_are_nothing_to_do() {
    let root = folder("none");
    assert_eq!(bench(&[], &root, &["list"]).out, "");
    for arguments in [&["run"][..], &["check"], &[]] {
        let done = bench(&[], &root, arguments);
        assert_eq!(
            (done.code, done.out.as_str(), done.err.as_str()),
            (0, "there are no experiments yet\n", "")
        );
    }
    assert!(names(&root).is_empty());
}

#[test]
fn list_shows_ids_and_titles() {
    let done = bench(&[DEMO, OTHER], Path::new("."), &["list"]);
    assert_eq!(done.out, "demo-ramps  Ramps of velocity, for the tests\nother       One number of our own\n");
}

#[test]
fn without_a_command_everything_runs_into_target_report() {
    let root = folder("everything");
    assert_eq!(bench(&[DEMO, OTHER], &root, &[]).code, 0);
    let found = names(&root.join("target"));
    assert!(
        found.contains(&"report/demo-ramps/fig7.svg".to_owned())
            && found.contains(&"report/other".to_owned())
    );
    assert!(found.iter().all(|name| name.starts_with("report")), "{found:?}");
}

#[test]
fn a_new_report_replaces_the_old_as_a_whole() {
    let root = folder("replace");
    let target = root.join("new").join("report");
    let run = |ids: &[&str]| {
        let mut arguments = vec!["run", "--out", target.to_str().unwrap()];
        arguments.extend(ids);
        bench(&[DEMO, OTHER], &root, &arguments).code
    };
    assert_eq!(run(&["demo"]), 0);
    assert!(target.join("demo-ramps").is_dir());
    assert_eq!(run(&["other"]), 0);
    assert!(!target.join("demo-ramps").exists() && target.join("other").is_dir());
    assert_eq!(
        names(&root).iter().filter(|name| name.matches('/').count() == 1).count(),
        1,
        "{:?}",
        names(&root)
    );
    // An empty folder is anybody's.
    std::fs::remove_dir_all(&target).unwrap();
    std::fs::create_dir(&target).unwrap();
    assert_eq!(run(&["other"]), 0);
}

#[test]
fn a_failing_experiment_leaves_the_earlier_report_whole() {
    let root = folder("failing");
    assert_eq!(bench(&[DEMO], &root, &["run"]).code, 0);
    let before = names(&root);
    let page = std::fs::read(root.join("target/report/report.html")).unwrap();
    let done = bench(&[BROKEN, DEMO], &root, &["run", "--seed", "5"]);
    assert_eq!((done.code, done.out.as_str()), (1, ""));
    assert_eq!(done.err, "error: broken: the plant ran away\n");
    assert_eq!(names(&root), before);
    assert!(std::fs::read(root.join("target/report/report.html")).unwrap() == page);

    let fresh = folder("failing-fresh");
    assert_eq!(bench(&[BROKEN], &fresh, &["run", "--out", fresh.join("a/b").to_str().unwrap()]).code, 1);
    assert!(names(&fresh).is_empty());
}

#[test]
fn a_panic_leaves_the_earlier_report_whole() {
    let root = folder("panic");
    assert_eq!(bench(&[OTHER], &root, &["run"]).code, 0);
    let before = names(&root);
    let panicking = Experiment { run: |_| panic!("a bug"), ..OTHER };
    assert!(std::panic::catch_unwind(|| bench(&[panicking], &root, &["run"]).code).is_err());
    assert_eq!(names(&root), before);
}

#[test]
fn a_report_that_cannot_be_drawn_leaves_nothing() {
    let root = folder("drawn");
    let empty = Experiment {
        run: |_| {
            let mut outcome = experiments::experiment::Outcome::default();
            outcome.figure(experiments::figure::Figure::new(
                "fig1",
                "",
                experiments::figure::Quantity::time(),
            ));
            outcome.measure("sum", 1.0);
            Ok(outcome)
        },
        ..OTHER
    };
    let done = bench(&[empty], &root, &["run"]);
    assert_eq!((done.code, done.err.as_str()), (1, "error: other: figure 'fig1' has no panels\n"));
    assert!(names(&root).is_empty());
}

/// The demo with another `expected.toml`, whose readme rows are out of the way.
fn checked(name: &str, expected: &str) -> common::Done {
    // The demo's rows that do not match, as its first seed gives them.
    let recorded = |text: &str, status: &str, ours: &str| {
        text.replacen(&format!("status = \"{status}\""), &format!("ours = {ours}\nstatus = '{status}'"), 1)
    };
    let text = recorded(expected, "deviates", "6.41");
    let text = recorded(&recorded(&text, "deviates", "\"unstable\""), "ours", "2.0");
    let text = text.replace("status =", "readme = false\nstatus =");
    let expected: &'static str = Box::leak(text.into_boxed_str());
    bench(&[Experiment { expected, ..DEMO }], &folder(name), &["check"])
}

#[test]
fn a_check_fails_when_a_row_leaves_or_returns() {
    let good = checked("check-good", EXPECTED);
    assert_eq!((good.code, good.err.as_str()), (0, ""));
    let left = checked("check-left", &EXPECTED.replace("published = 0.08", "published = 0.09"));
    assert_eq!((left.code, left.err.as_str()), (1, "demo-ramps ramp-time/cosine has left its tolerance\n"));
    assert!(left.out.contains("1 not as expected"), "{}", left.out);
    let now = checked("check-now", &EXPECTED.replace("rel = 0.01", "rel = 0.02"));
    assert_eq!(
        (now.code, now.err.as_str()),
        (1, "demo-ramps error/peak is listed as deviating and now matches\n")
    );
}

#[test]
fn a_check_keeps_its_verdict_when_nobody_reads() {
    struct Closed;
    impl std::io::Write for Closed {
        fn write(&mut self, _: &[u8]) -> std::io::Result<usize> {
            Err(std::io::ErrorKind::BrokenPipe.into())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    let root = folder("closed");
    let code = |arguments: &[&str]| {
        let arguments = std::iter::once("experiments").chain(arguments.iter().copied());
        let arguments = arguments.map(std::ffi::OsString::from);
        experiments::cli::main(&[DEMO], &root, arguments, &mut Closed, &mut Closed)
    };
    // There is no README to agree with, so a check fails; a list has nothing to fail at.
    assert_eq!((code(&["check"]), code(&["list"])), (1, 0));
}

#[test]
fn a_wrong_expected_file_is_said_before_the_run() {
    let wrong = Experiment { expected: "[[row]]\nmetric = \"Sum\"\nstatus = \"ours\"\n", ..BROKEN };
    let done = bench(&[wrong], &folder("wrong"), &["check"]);
    assert_eq!(done.code, 1);
    assert!(done.err.starts_with("error: broken: expected.toml: metric 'Sum' is not"), "{}", done.err);
    let short = Experiment { expected: "", ..OTHER };
    let done = bench(&[short], &folder("short"), &["run"]);
    assert_eq!(done.err, "error: other: metric 'sum' was measured and has no row in expected.toml\n");
}
