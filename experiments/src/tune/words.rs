//! A tuning in sentences and tables, for the terminal and the page alike.

use std::f64::consts::TAU;

use optimize::{JudgedMove, JudgedShaper};
use profiles::Profile;
use serde::Serialize;

use super::analysis::{Plan, Tuning, class_words, route_words};
use super::columns::{rate, unit};
use super::parameters::{About, chosen};
use crate::number::{pretty_unit, short};

/// A table of texts.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Table {
    pub(super) head: Vec<String>,
    pub(super) rows: Vec<Vec<String>>,
}

fn head<const N: usize>(names: [&str; N]) -> Vec<String> {
    names.map(str::to_owned).into()
}

/// Units of command and response, empty where the log does not say.
fn units(about: &About) -> [&str; 2] {
    let [_, command, response] = &about.names;
    [command, response].map(|name| unit(name).unwrap_or_default())
}

/// A number with its unit.
fn with(x: f64, unit: &str) -> String {
    if unit.is_empty() { short(x) } else { format!("{} {}", short(x), pretty_unit(unit)) }
}

/// The head of a column with its unit.
fn column(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.to_owned() } else { format!("{name} [{}]", pretty_unit(unit)) }
}

/// Words that stand in a line of their own as a sentence.
pub(super) fn sentence(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(|letter| letter.to_uppercase().to_string()).unwrap_or_default();
    let end = if words.ends_with('.') { "" } else { "." };
    format!("{first}{}{end}", letters.as_str())
}

/// `a, b and c`.
fn listed(items: &[String]) -> String {
    match items {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => items.concat(),
    }
}

/// What was read.
pub(super) fn about(tuning: &Tuning, about: &About) -> String {
    let [_, command, response] = &about.names;
    format!(
        "{}: {} samples of '{command}' and '{response}', {} ms apart",
        about.file,
        tuning.sampled.response.len(),
        short(1e3 * tuning.sampled.period)
    )
}

/// What the response is like.
pub(super) fn response(tuning: &Tuning, about: &About) -> Vec<String> {
    let [command, unit] = units(about);
    let (figures, found) = (&tuning.figures, &tuning.found);
    let class = class_words(figures.class.as_ref().map(|class| class.class));
    let resolution = if figures.quantum > 0.0 {
        format!(", resolution {}", with(figures.quantum, unit))
    } else {
        String::new()
    };
    let mut lines = vec![format!("response class {class}")];
    match figures.gain.or(found.dc_gain) {
        // An accelerometer, say.
        Some(gain) if figures.class.is_none() && gain.abs() < 0.01 => {
            lines.push("after a move the response is where it was before".to_owned());
        }
        Some(gain) => lines.push({
            format!("the response goes {} for {} of the command", with(gain, unit), with(1.0, command))
        }),
        None => {}
    }
    lines.push(format!("noise {} (standard deviation){resolution}", with(figures.noise, unit)));
    lines.push(format!("modes from the {}", route_words(found)));
    lines.push(format!(
        "they reproduce {} % of it and leave a standard deviation of {}",
        short(found.fit),
        with(found.residual, unit)
    ));
    lines
}

/// A number to two digits of its deviation.
fn pm(value: f64, deviation: f64) -> String {
    if !(deviation > 0.0 && deviation.is_finite()) {
        return short(value);
    }
    let decimals = (1.0 - deviation.log10().floor()).clamp(0.0, 12.0) as usize;
    format!("{value:.decimals$} ± {deviation:.decimals$}")
}

/// A frequency in the digits that its deviation leaves, four at most: `8.000 Hz`.
fn hertz(hz: f64, deviation: f64) -> String {
    let digits = |x: f64| -x.log10().floor();
    let most = 3.0 + digits(hz);
    let known = if deviation > 0.0 && deviation.is_finite() { digits(deviation).min(most) } else { most };
    format!("{hz:.*} Hz", known.clamp(0.0, 12.0) as usize)
}

/// The frequency of the mode with this number, from zero.
pub(super) fn frequency(tuning: &Tuning, n: usize) -> String {
    tuning
        .found
        .modes
        .get(n)
        .map_or(String::new(), |mode| hertz(mode.mode.hz(), mode.frequency_deviation / TAU))
}

/// The modes with their deviations.
pub(super) fn modes(tuning: &Tuning, about: &About) -> Table {
    let [_, unit] = units(about);
    let rows = tuning.found.modes.iter().enumerate().map(|(n, mode)| {
        let w = mode.mode.angular_frequency();
        vec![
            format!("mode {}", n + 1),
            pm(mode.mode.hz(), mode.frequency_deviation / TAU),
            pm(w, mode.frequency_deviation),
            pm(mode.mode.damping_ratio(), mode.damping_deviation),
            short(mode.amplitude),
        ]
    });
    let mut head = head(["", "frequency [Hz]", "frequency [rad/s]", "damping ratio"]);
    head.push(column("largest amplitude", unit));
    Table { head, rows: rows.collect() }
}

pub(super) fn moves(plan: &Plan, about: &About) -> Table {
    let [_, unit] = units(about);
    let row = |judged: &JudgedMove| {
        let ms = |seconds: Option<f64>| seconds.map_or("never".to_owned(), |s| short(1e3 * s));
        vec![
            judged.kind.name(),
            short(1e3 * judged.motion.duration()),
            // Roundings of a zero.
            short(if judged.nominal < 1e-9 * plan.task.tolerated { 0.0 } else { judged.nominal }),
            short(judged.worst),
            ms(judged.settling),
            ms(Some(judged.total()).filter(|total| total.is_finite())),
        ]
    };
    let mut names = head(["move", "duration [ms]"]);
    names.extend([column("vibration left", unit), column("at worst", unit)]);
    names.extend(head(["settling [ms]", "at rest after [ms]"]));
    Table { head: names, rows: plan.moves.moves.iter().map(row).collect() }
}

pub(super) fn shapers(tuning: &Tuning) -> Table {
    // Roundings of a zero are one.
    let percent = |part: f64| format!("{} %", short(if part < 1e-12 { 0.0 } else { 100.0 * part }));
    let rows = tuning.shaper.judged.iter().zip(&tuning.shaper.chosen).enumerate().flat_map(
        |(n, (judged, chosen))| {
            judged.iter().enumerate().map(move |(at, shaper)| {
                let mark = if at == *chosen { " *" } else { "" };
                vec![
                    format!("{}: {}{mark}", frequency(tuning, n), shaper.name()),
                    short(1e3 * shaper.train.duration()),
                    percent(shaper.nominal),
                    percent(shaper.worst),
                ]
            })
        },
    );
    Table { head: head(["shaper", "duration [ms]", "leaves of a step", "at worst"]), rows: rows.collect() }
}

/// The impulses of the recommended shaper.
pub(super) fn impulses(tuning: &Tuning) -> Table {
    let impulses = tuning.shaper.train.impulses().iter().enumerate();
    let row = |(n, impulse): (usize, &shaping::Impulse)| {
        vec![format!("impulse {}", n + 1), short(1e3 * impulse.time), short(impulse.amplitude)]
    };
    Table { head: head(["", "time [ms]", "amplitude"]), rows: impulses.map(row).collect() }
}

/// The task of the move in a sentence.
pub(super) fn task(plan: &Plan, about: &About) -> String {
    let [command, response] = units(about);
    let limits = plan.task.limits;
    let limit = |x: f64, order| with(x, &rate(command, order));
    format!(
        "A distance of {} within a velocity of {}, an acceleration of {} and a jerk of {}; a vibration of {} is tolerated.",
        with(plan.task.distance, command),
        limit(limits.velocity().upper, 1),
        limit(limits.acceleration().upper, 2),
        limit(limits.jerk().upper, 3),
        with(plan.task.tolerated, response)
    )
}

/// What to do, a sentence each.
pub(super) fn answer(tuning: &Tuning, about: &About) -> Vec<String> {
    let [_, unit] = units(about);
    let mut lines = Vec::new();
    let k = short(tuning.deviations);
    if let Some((plan, best)) = tuning.plan.as_ref().and_then(|plan| Some((plan, plan.moves.best()?))) {
        let tolerated = with(plan.task.tolerated, unit);
        let whatever = format!("whatever the modes within {k} standard deviations");
        let name = best.kind.name();
        lines.push(match best.settling {
            Some(settling) if settling <= 0.0 => format!(
                "Recommended move: {name}, {} ms; at its end no more than {} is left swinging ({tolerated} tolerated), \
                 {whatever}.",
                short(1e3 * best.motion.duration()),
                with(best.worst, unit)
            ),
            Some(settling) => format!(
                "Recommended move: {name}, {} ms, and {} ms more until no more than {tolerated} is left swinging, \
                 {whatever}.",
                short(1e3 * best.motion.duration()),
                short(1e3 * settling)
            ),
            None => format!(
                "No move comes to {tolerated} of vibration by itself; {name} leaves least: {} at worst.",
                with(best.worst, unit)
            ),
        });
        if let Some(plain) = plan.plain().filter(|plain| plain.kind != best.kind) {
            let settling = plain.settling.map_or("never settles".to_owned(), |settling| {
                format!("settles {} ms later", short(1e3 * settling))
            });
            lines.push(format!(
                "The S-curve within the same limits takes {} ms, leaves {} at worst and {settling}.",
                short(1e3 * plain.motion.duration()),
                with(plain.worst, unit)
            ));
        }
    }
    let named =
        |(n, judged): (usize, &JudgedShaper)| format!("{} at {}", judged.name(), frequency(tuning, n));
    let names: Vec<String> = chosen(tuning).enumerate().map(named).collect();
    let shaper = &tuning.shaper;
    let all = if names.len() > 1 { ", one after the other" } else { "" };
    let falls = if shaper.within { "" } else { ", which is more than tolerated; no shaper here leaves less" };
    lines.push(format!(
        "Where the profile cannot be changed, put it through {}{all}: {} ms longer, of a step it leaves {} % of the \
         vibration at worst ({} % tolerated){falls}.",
        listed(&names),
        short(1e3 * shaper.train.duration()),
        short(100.0 * shaper.worst),
        short(100.0 * tuning.tolerated_part)
    ));
    lines
}

/// The first rows of a table, and the one of this name.
pub(super) fn shortened(table: Table, rows: usize, kept: &str) -> Table {
    let keep = |(n, row): &(usize, Vec<String>)| *n < rows || row.first().is_some_and(|name| name == kept);
    let rows = table.rows.into_iter().enumerate().filter(keep).map(|(_, row)| row).collect();
    Table { rows, ..table }
}

/// A table for the terminal: columns two blanks apart, the numbers to the right.
pub(super) fn aligned(table: &Table) -> String {
    let lines: Vec<&Vec<String>> = std::iter::once(&table.head).chain(&table.rows).collect();
    let width = |column: usize| {
        lines.iter().filter_map(|line| line.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..table.head.len()).map(width).collect();
    let mut text = String::new();
    for line in lines {
        let mut row = String::new();
        for (column, (cell, width)) in line.iter().zip(&widths).enumerate() {
            let blanks = " ".repeat(width - cell.chars().count());
            row.push_str(&if column == 0 {
                format!("  {cell}{blanks}")
            } else {
                format!("  {blanks}{cell}")
            });
        }
        text.push_str(row.trim_end());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frequency_has_the_digits_that_are_known() {
        for (hz, deviation, text) in [
            (7.999_92, 0.000_35, "8.000 Hz"),
            (18.4, 0.3, "18.4 Hz"),
            (2.147, 0.027, "2.15 Hz"),
            (113.13, 1.26, "113 Hz"),
            (0.012_345, 0.0, "0.01235 Hz"),
            (240.0, f64::INFINITY, "240.0 Hz"),
        ] {
            assert_eq!(hertz(hz, deviation), text);
        }
    }

    #[test]
    fn words_become_sentences_and_lists() {
        assert_eq!(sentence("noise 1e-5 m"), "Noise 1e-5 m.");
        assert_eq!((sentence("Ends."), sentence("")), ("Ends.".to_owned(), ".".to_owned()));
        let items = ["a", "b", "c"].map(str::to_owned);
        assert_eq!(
            [listed(&items), listed(&items[..2]), listed(&items[..1])],
            ["a, b and c", "a and b", "a"]
        );
    }

    #[test]
    fn a_number_has_the_digits_of_its_deviation() {
        for (value, deviation, text) in [
            (8.000_12, 0.000_26, "8.00012 ± 0.00026"),
            (113.13, 1.26, "113.1 ± 1.3"),
            (0.0195, 0.000_38, "0.01950 ± 0.00038"),
            (1234.5, 31.0, "1234 ± 31"),
            (2.5, 0.0, "2.5"),
        ] {
            assert_eq!(pm(value, deviation), text);
        }
    }
}
