//! The README's table: written, read back, and every kind of difference found.

#![expect(clippy::unwrap_used, reason = "helpers of tests fail as tests do")]

mod common;

use common::{BROKEN, DEMO, OTHER, bench, folder};
use experiments::bench::{Results, Setting, run};
use experiments::experiment::Experiment;
use experiments::readme::{BEGIN, END, ReadmeError, check, rewrite};

fn results(experiments: &'static [&'static Experiment]) -> Results<'static> {
    run(experiments, Setting::default()).unwrap()
}

fn both() -> Results<'static> {
    results(&[&DEMO, &OTHER])
}

fn empty() -> String {
    format!("# Title\n\n{BEGIN}\n{END}\n\nMore.\n")
}

#[test]
fn what_is_written_agrees_and_is_not_written_twice() {
    let written = rewrite(&empty(), &both()).unwrap();
    assert!(written.starts_with("# Title\n\n") && written.ends_with(&format!("{END}\n\nMore.\n")));
    assert!(written.contains("| demo-ramps | `error/peak` | µm | 6.5 | 6.41 | deviates |\n"), "{written}");
    assert!(
        written.contains("| demo-ramps | `printed-gains` |  | stable | unstable | deviates |\n"),
        "{written}"
    );
    assert!(written.contains("| other | `sum` |  | – | 2 | ours |\n"), "{written}");
    assert_eq!(check(&written, &both()).unwrap(), Vec::<String>::new());
    assert_eq!(rewrite(&written, &both()).unwrap(), written);
}

#[test]
fn numbers_are_compared_within_the_rows_tolerance() {
    let written = rewrite(&empty(), &both()).unwrap();
    let problems = |from: &str, to: &str| {
        assert!(written.contains(from), "{from}");
        check(&written.replace(from, to), &both()).unwrap()
    };
    // Of 6.5, 1 % is 0.065.
    assert_eq!(problems("| 6.41 |", "| 6.350 |"), Vec::<String>::new());
    assert_eq!(
        problems("| 6.41 |", "| 6.34 |"),
        ["README.md: demo-ramps error/peak: ours is '6.34', the bench has '6.41'"]
    );
    // The tolerance of 1e-9 s is finer than the print, whose half digit is 5e-6.
    assert_eq!(problems("| 0.07 | 0.07 |", "| 0.07 | 0.070004 |"), Vec::<String>::new());
    assert_eq!(problems("| 0.07 | 0.07 |", "| 0.07 | 0.07001 |").len(), 1);
    // A row without a tolerance: 1 %.
    assert_eq!(problems("| – | 2 | ours |\n<", "| – | 2.02 | ours |\n<"), Vec::<String>::new());
    assert_eq!(problems("| – | 2 | ours |\n<", "| – | 2.03 | ours |\n<").len(), 1);
    // The paper's number, a word, a status.
    assert_eq!(problems("| 6.5 |", "| 6.50 |"), Vec::<String>::new());
    assert_eq!(problems("| 6.5 |", "| 6.51 |").len(), 1);
    assert_eq!(problems("| 6.5 |", "| – |").len(), 1);
    assert_eq!(problems("| unstable |", "| stable |").len(), 1);
    assert_eq!(problems("| deviates |", "| match |").len(), 2);
    assert_eq!(problems("| 6.41 |", "| about 6 |").len(), 1);
}

#[test]
fn rows_missing_made_up_or_twice_are_found() {
    let written = rewrite(&empty(), &both()).unwrap();
    let line = "| other | `sum` |  | – | 2 | ours |\n";
    assert_eq!(
        check(&written.replace(line, ""), &both()).unwrap(),
        ["README.md: no row other sum; run 'readme'"]
    );
    let more = written.replace(line, &format!("{line}{}", line.replace("sum", "product")));
    assert_eq!(check(&more, &both()).unwrap(), ["README.md: row other product is not made by the bench"]);
    assert_eq!(check(&more, &results(&[&DEMO])).unwrap(), Vec::<String>::new());
    assert_eq!(check(&written.replace(line, &format!("{line}{line}")), &both()).unwrap().len(), 1);
    assert_eq!(check(&written.replace(line, &format!("{line}| other | x |\n")), &both()).unwrap().len(), 1);
}

#[test]
fn without_its_comments_there_is_no_table() {
    for text in ["", BEGIN, END, &format!("{END}{BEGIN}"), &format!("{0}{0}", empty())] {
        assert_eq!(check(text, &both()).unwrap_err(), ReadmeError::Markers);
        assert_eq!(rewrite(text, &both()).unwrap_err(), ReadmeError::Markers);
    }
}

#[test]
fn the_commands_write_and_check_it() {
    let root = folder("readme");
    let path = root.join("README.md");
    assert_eq!(bench(&[DEMO], &root, &["readme"]).code, 2, "there is no README.md");
    std::fs::write(&path, "no comments").unwrap();
    assert_eq!(bench(&[DEMO], &root, &["readme"]).code, 2);
    assert_eq!(bench(&[DEMO], &root, &["check"]).code, 1);

    std::fs::write(&path, empty()).unwrap();
    let missing = bench(&[DEMO, OTHER], &root, &["check"]);
    assert_eq!(missing.code, 1);
    assert_eq!(missing.err.lines().count(), 6, "{}", missing.err);

    assert_eq!(bench(&[DEMO, OTHER], &root, &["readme"]).code, 0);
    let written = std::fs::read_to_string(&path).unwrap();
    for picture in ["docs/demo-ramps-fig7.svg", "docs/demo-ramps-fig7-dark.svg"] {
        assert!(std::fs::read_to_string(root.join(picture)).unwrap().contains("cosine"));
    }
    let checked = bench(&[DEMO, OTHER], &root, &["check"]);
    assert_eq!((checked.code, checked.err.as_str()), (0, ""));
    assert!(checked.out.ends_with("6 rows: 2 match, 2 deviate, 2 ours\n"), "{}", checked.out);
    assert_eq!(bench(&[DEMO, OTHER], &root, &["check", "demo"]).code, 0);

    std::fs::write(&path, written.replace("| 6.41 |", "| 6.3 |")).unwrap();
    assert_eq!(bench(&[DEMO, OTHER], &root, &["check", "demo"]).code, 1);
    assert_eq!(bench(&[DEMO, OTHER], &root, &["check", "other"]).code, 0);

    let before = std::fs::read_to_string(&path).unwrap();
    assert_eq!(bench(&[DEMO, BROKEN], &root, &["readme"]).code, 1);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), before);
}
