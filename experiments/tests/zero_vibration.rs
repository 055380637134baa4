//! The study of zero vibration: the same numbers on any number of threads, and a simulation that agrees with the closed form.

#![expect(clippy::unwrap_used, reason = "helpers of tests fail as tests do")]

use experiments::experiment::{Context, Outcome};
use experiments::progress::Progress;
use experiments::row::Value;
use experiments::studies::zero_vibration::EXPERIMENT;

fn quick(threads: usize) -> Outcome {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let context = Context { seed: 3, seeds: 1, quick: true, progress: Progress::hidden() };
    pool.install(|| (EXPERIMENT.run)(&context)).unwrap()
}

fn number(outcome: &Outcome, metric: &str) -> f64 {
    let found = outcome.measured.iter().find(|(name, _)| name == metric);
    found.and_then(|(_, value)| value.number()).unwrap()
}

#[test]
fn the_threads_do_not_show() {
    let (one, three) = (quick(1), quick(3));
    assert_eq!(one.measured, three.measured);
    assert!(one.measured.iter().all(|(_, value)| !matches!(value, Value::Number(x) if !x.is_finite())));
    for (a, b) in one.figures.iter().zip(&three.figures) {
        a.check().unwrap();
        assert_eq!(experiments::figure::to_csv(a).unwrap(), experiments::figure::to_csv(b).unwrap());
    }
}

#[test]
fn what_is_simulated_is_what_the_closed_form_says() {
    let outcome = quick(2);
    // A state of a few tenths of a metre, a thousand steps of some roundings each.
    assert!(number(&outcome, "simulation/disagreement") < 1e-11);
    // What has a zero on the mode leaves nothing of it, in % of the move.
    for method in ["zv", "zvd", "delay-filter", "chain", "chain-double", "optimum", "optimum-double"] {
        assert!(number(&outcome, &format!("left/nominal/{method}")) < 1e-9, "{method}");
    }
    // The band's tolerance, and a rounding.
    assert!(number(&outcome, "left/off/optimum-band") < 0.1 + 1e-6);
    // Who is shaped is at rest when the S-curve is not: 8 Hz, hardly damped.
    assert!(number(&outcome, "8hz/nominal/zv") < 0.2 * number(&outcome, "8hz/nominal/s-curve"));
    for task in ["8hz", "20hz", "12hz"] {
        let duration = |id: &str| number(&outcome, &format!("computed/{task}/{id}"));
        assert!(duration("s-curve") <= duration("optimum") && duration("optimum") < duration("zv"), "{task}");
        assert!(duration("optimum") <= duration("optimum-double"), "{task}");
        assert!(duration("optimum-double") < duration("zvd"), "{task}");
        assert!(duration("optimum-two-modes") < duration("zv-two-modes"), "{task}");
    }
}
