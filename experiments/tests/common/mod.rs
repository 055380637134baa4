//! An experiment small enough to check by hand, and a folder for what it leaves.

#![allow(dead_code, reason = "every test file uses its own part")]

use std::f64::consts::PI;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use experiments::cli;
use experiments::experiment::{Context, Experiment, Outcome, Source};
use experiments::figure::{Figure, Panel, Quantity, Role};

pub(crate) const EXPECTED: &str = include_str!("demo.toml");

/// A trapezoid, a smooth ramp, and numbers that depend on the seed alone.
pub(crate) const DEMO: Experiment = Experiment {
    id: "demo-ramps",
    title: "Ramps of velocity, for the tests",
    citation: "A. Author & B. Author, A paper <that is not there>, 2010.",
    sources: &[Source { path: "experiments/tests/common/mod.rs", text: include_str!("mod.rs") }],
    expected: EXPECTED,
    readme_figure: Some("fig7"),
    run: demo,
};

/// Another of the same kind, without figures.
pub(crate) const OTHER: Experiment = Experiment {
    id: "other",
    title: "One number of our own",
    citation: "",
    sources: &[],
    expected: "[[row]]\nmetric = \"sum\"\nstatus = \"ours\"\n",
    readme_figure: None,
    run: |context| {
        let mut outcome = Outcome::default();
        outcome.measure("sum", 1.0 + context.seed as f64);
        Ok(outcome)
    },
};

/// Fails after half its work.
pub(crate) const BROKEN: Experiment = Experiment {
    id: "broken",
    run: |context| {
        context.progress.step();
        anyhow::bail!("the plant\nran away")
    },
    ..OTHER
};

fn demo(context: &Context) -> anyhow::Result<Outcome> {
    let mut outcome = Outcome::default();
    context.progress.steps(2);
    let samples = if context.quick { 41 } else { 2001 };
    let time = |end: f64| (0..samples).map(move |n| end * f64::from(n) / f64::from(samples - 1));

    let (a, v, j) = (4.0, 0.2, 200.0);
    let (tj, t) = (a / j, v / a + a / j);
    // Velocity, acceleration, jerk of a ramp of three phases.
    let s_curve = move |x: f64| {
        if x < tj {
            [0.5 * j * x * x, j * x, j]
        } else if x < t - tj {
            [0.5 * a * tj + a * (x - tj), a, 0.0]
        } else if x < t {
            let y = t - x;
            [v - 0.5 * j * y * y, j * y, -j]
        } else {
            [v, 0.0, 0.0]
        }
    };
    let tc = PI * v / (2.0 * a);
    let cosine = move |x: f64| {
        let w = PI / tc;
        let y = w * x.min(tc);
        let moving = f64::from(u8::from(x <= tc));
        [0.5 * v * (1.0 - y.cos()), 0.5 * v * w * y.sin() * moving, 0.5 * v * w * w * y.cos() * moving]
    };
    let pick = |f: &dyn Fn(f64) -> [f64; 3], k: usize, end: f64, scale: f64| -> Vec<(f64, f64)> {
        time(end).map(|x| (x, scale * f(x)[k])).collect()
    };
    context.progress.step();

    // Four panels, as the papers stack them.
    let move_end = 0.24;
    let whole = move |x: f64| {
        if x < 0.5 * move_end {
            let s = s_curve(x);
            [s[0], s[1], s[2]]
        } else {
            let s = s_curve(move_end - x);
            [s[0], -s[1], s[2]]
        }
    };
    outcome.figure(
        Figure::new("fig4", "Fig. 4: the S-curve over a whole move", Quantity::time())
            .panel(
                Panel::new(Quantity::new("snap", "s", "m/s^4"))
                    .line("", Role::Ours, pick(&whole, 2, move_end, -62.5))
                    .limit(12_500.0, "s_max")
                    .limit(-12_500.0, "-s_max"),
            )
            .panel(
                Panel::new(Quantity::new("jerk", "j", "m/s^3"))
                    .line("", Role::Ours, pick(&whole, 2, move_end, 1.0))
                    .limit(200.0, "j_max")
                    .limit(-200.0, "-j_max"),
            )
            .panel(
                Panel::new(Quantity::new("acceleration", "a", "m/s^2"))
                    .line("", Role::Ours, pick(&whole, 1, move_end, 1.0))
                    .limit(4.0, "a_max")
                    .limit(-4.0, "-a_max"),
            )
            .panel(
                Panel::new(Quantity::new("velocity", "v", "m/s"))
                    .line("", Role::Ours, pick(&whole, 0, move_end, 1.0))
                    .limit(0.2, "v_max")
                    .band(0.0, t, "")
                    .band(move_end - t, move_end, ""),
            ),
    );
    outcome.figure(
        Figure::new("fig7", "Fig. 7: ramps from 0 to 0.2 m/s", Quantity::time()).panel(
            Panel::new(Quantity::new("velocity", "v", "m/s"))
                .line("S-curve", Role::Ours, pick(&s_curve, 0, 0.1, 1.0))
                .line("cosine", Role::Second, pick(&cosine, 0, 0.1, 1.0))
                .line("cubic velocity", Role::Third, pick(&cosine, 0, 0.1, 0.9))
                .line("trapezoid", Role::Fourth, vec![(0.0, 0.0), (0.05, 0.2), (0.1, 0.2)])
                .line("command", Role::Reference, vec![(0.0, 0.2), (0.1, 0.2)])
                .marks("published ramp times", vec![(0.07, 0.2), (0.08, 0.2), (0.086, 0.2)])
                .limit(0.2, "v_max"),
        ),
    );
    let error = |x: f64| 6.5e-6 * (-(x / 0.03)).exp() * (x * 300.0).sin();
    outcome.figure(
        Figure::new("fig8", "Fig. 8: position error of the controlled motor", Quantity::time()).panel(
            Panel::new(Quantity::new("position error", "e", "um"))
                .line("S-curve", Role::Ours, time(0.24).map(|x| (x, 1e6 * error(x))).collect())
                .line("cosine", Role::Second, time(0.24).map(|x| (x, 0.8e6 * error(1.1 * x))).collect()),
        ),
    );
    if !context.quick {
        outcome.measure("ramp-time/s-curve", t);
        outcome.measure("ramp-time/cosine", tc);
        outcome.measure("error/peak", 6.41);
        outcome.measure("printed-gains", "unstable");
        outcome.measure("order", 2.0 * context.seed as f64);
    }
    outcome.note("Jerk limits are not printed; 200 m/s³ follows from the ramp time.");
    outcome.note("Fitted, not published: a & b < c.");
    context.progress.step();
    Ok(outcome)
}

/// What a command did.
pub(crate) struct Done {
    pub(crate) code: u8,
    pub(crate) out: String,
    pub(crate) err: String,
}

/// Runs a command line as the program would, in `root`.
pub(crate) fn bench(experiments: &[Experiment], root: &Path, arguments: &[&str]) -> Done {
    let arguments = std::iter::once("experiments").chain(arguments.iter().copied()).map(OsString::from);
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let code = cli::main(experiments, root, arguments, &mut out, &mut err);
    Done { code, out: String::from_utf8(out).unwrap(), err: String::from_utf8(err).unwrap() }
}

/// An empty folder of this name among the build's files.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Names of all files and folders below, sorted.
pub(crate) fn names(folder: &Path) -> Vec<String> {
    let mut names = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(next) = open.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            names.push(path.strip_prefix(folder).unwrap().to_str().unwrap().to_owned());
            if path.is_dir() {
                open.push(path);
            }
        }
    }
    names.sort();
    names
}
