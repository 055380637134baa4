//! Logs and requests that cannot be met: one line with the number, and nothing written.

use std::fmt::Write;

use plants::{GaussianNoise, Noise};

use super::common::{bench, folder, names};
use super::{EXAMPLE, count, parameters, step, tune};

/// A log that must be refused in one line that says this, with nothing left behind.
fn refused(name: &str, text: impl AsRef<[u8]>, more: &[&str], code: u8, says: &str) {
    let (out, done) = tune(name, text, more);
    assert_eq!((done.code, done.out.as_str()), (code, ""), "{}", done.err);
    assert_eq!(done.err.lines().count(), 1, "{}", done.err);
    assert!(done.err.starts_with("error: ") && done.err.contains(says), "{} lacks {says}", done.err);
    assert_eq!(names(out.parent().unwrap()), ["log.csv"]);
}

#[test]
fn lines_that_cannot_be_used_are_named_with_their_number() {
    let head = "# a remark\ntime,command,response\n";
    let good = step(',', 300);
    let line = |n: usize, text: &str| {
        let mut lines: Vec<&str> = good.lines().collect();
        lines.insert(n, text);
        format!("{head}{}\n", lines.join("\n"))
    };
    // The tenth sample is on line 12.
    for (name, text, says) in [
        ("few", "0.0095,1", "line 12: 2 fields where there are 3 columns"),
        ("many", "0.0095,1,2,3", "line 12: 4 fields where there are 3 columns"),
        ("text", "0.0095,on,2", "line 12: 'on' in column 'command' is not a number"),
        ("empty", "0.0095,,2", "line 12: '' in column 'command' is not a number"),
        ("nan", "0.0095,NaN,2", "line 12: 'NaN' in column 'command' is not a finite number"),
        ("infinite", "0.0095,1,-inf", "line 12: '-inf' in column 'response' is not a finite number"),
        ("back", "0.0085,1,2", "line 12: the time 0.0085 s is not after 0.009 s"),
        ("twice", "0.009,1,2", "line 12: the time 0.009 s is not after 0.009 s"),
    ] {
        refused(&format!("tune-line-{name}"), line(9 + 1, text), &[], 2, &says.replace("12", "13"));
        let (out, done) = tune(&format!("tune-skip-{name}"), line(9 + 1, text), &["--skip-irregular"]);
        assert_eq!(done.code, 0, "{name}: {}", done.err);
        assert!(done.out.contains("line 13 left out: "), "{}", done.out);
        assert_eq!(count(&parameters(&out), "/log/lines_left_out"), Some(1));
    }
    // A recorder that was switched off in the middle of its last line.
    let cut = format!("{head}{good}0.3");
    refused("tune-line-cut", cut, &[], 2, "line 303: 1 fields where there are 3 columns");
}

#[test]
fn logs_that_cannot_be_used_are_one_line_and_code_2() {
    let head = "time,command,response\n";
    let good = step(',', 300);
    refused("tune-empty", "", &[], 2, "no lines of data");
    refused("tune-comments", "# only\n# remarks\n", &[], 2, "no lines of data");
    refused("tune-header", head, &[], 2, "no lines of data");
    refused(
        "tune-column",
        format!("time,u,y\n{good}"),
        &[],
        2,
        "no column 'command' for the command: there are 'time', 'u', 'y'",
    );
    refused(
        "tune-double",
        format!("time,command,Command\n{good}"),
        &["--response", "COMMAND"],
        2,
        "more than one column 'COMMAND'",
    );
    refused("tune-number", format!("{head}{good}"), &["--response", "4"], 2, "no column '4'");
    refused("tune-headless", &good, &[], 2, "no column 'time'");
    refused("tune-blank", good.replace(',', " "), &[], 2, "line 1 is one column only");
    refused("tune-short", format!("{head}{}", step(',', 63)), &[], 2, "63 samples");
    refused("tune-part", format!("{head}{good}"), &["--from", "0.28"], 2, "20 samples");
    // The numbers of the libraries in four digits, however long they are.
    let huge = good.lines().fold(head.to_owned(), |text, line| format!("{text}{line}e200\n"));
    refused("tune-huge", huge, &[], 1, "at most 1e150, got 1.");
    let utf16: Vec<u8> =
        [0xFF, 0xFE].into_iter().chain(good.encode_utf16().flat_map(u16::to_le_bytes)).collect();
    refused("tune-utf16", utf16, &[], 2, "UTF-16");
    let gap: String = step(',', 300)
        .lines()
        .enumerate()
        .filter(|(n, _)| !(150..160).contains(n))
        .map(|(_, line)| format!("{line}\n"))
        .collect();
    refused("tune-gap", format!("{head}{gap}"), &[], 2, "no samples from 0.149 s to 0.16 s");
    let root = folder("tune-missing");
    let done = bench(&[], &root, &["tune", root.join("none.csv").to_str().unwrap()]);
    assert_eq!((done.code, done.err.lines().count()), (2, 1), "{}", done.err);
    assert!(done.err.contains("none.csv") && names(&root).is_empty());
}

#[test]
fn a_log_without_a_mode_says_why() {
    let mut noise = GaussianNoise::new(1e-4, 3).unwrap();
    let mut rigid = String::from("time,command,response\n");
    let mut still = rigid.clone();
    for n in 0..600 {
        let (t, u) = (f64::from(n) * 1e-3, if n < 100 { 0.0 } else { 0.1 });
        writeln!(rigid, "{t},{u},{}", u + noise.sample()).unwrap();
        writeln!(still, "{t},{u},0").unwrap();
    }
    refused(
        "tune-rigid",
        rigid,
        &[],
        1,
        "no mode: no mode stands out where the command rests after a move (1 in the log)",
    );
    refused("tune-still", still, &[], 1, "the response is 0 throughout");
}

#[test]
fn a_foreign_folder_is_never_replaced() {
    let root = folder("tune-foreign");
    std::fs::write(root.join("log.csv"), EXAMPLE).unwrap();
    let log = root.join("log.csv");
    std::fs::create_dir(root.join("mine")).unwrap();
    std::fs::write(root.join("mine").join("notes.txt"), "mine").unwrap();
    let done =
        bench(&[], &root, &["tune", log.to_str().unwrap(), "--out", root.join("mine").to_str().unwrap()]);
    assert_eq!(done.code, 2);
    assert!(done.err.contains("is not a report"), "{}", done.err);
    assert_eq!(names(&root), ["log.csv", "mine", "mine/notes.txt"]);
}
