//! The pictures of a tuning.

use std::f64::consts::TAU;

use identify::{Route, SpectrumOptions, Window, amplitude_spectrum};
use optimize::{JudgedMove, MoveKind, UncertainMode};
use profiles::{Complex, Profile};

use super::analysis::{Plan, Tuning};
use super::columns::{bare, rate, unit};
use super::words::frequency;
use crate::figure::{Figure, Panel, Quantity, Role};

/// Most points of a line: more are thinned to the least and the largest of a bin.
const MOST_POINTS: usize = 4000;

/// All of them, in the order of the report.
pub(super) fn all(tuning: &Tuning, names: &[String; 3]) -> Vec<Figure> {
    let mut figures = vec![log(tuning, names), fit(tuning, names)];
    figures.extend(spectrum(tuning, names));
    figures.push(shapers(tuning));
    if let Some(plan) = &tuning.plan {
        figures.extend([moves(tuning, plan, names), sensitivity(tuning, plan, names)]);
    }
    figures
}

/// The quantity of a column, `angle [rad]`.
fn quantity(name: &str) -> Quantity {
    Quantity::new(bare(name), "", unit(name).unwrap_or_default())
}

fn log(tuning: &Tuning, [_, command, response]: &[String; 3]) -> Figure {
    let at = |n: usize| tuning.sampled.start + n as f64 * tuning.sampled.period;
    let line = |values: &[f64]| thinned(values.iter().enumerate().map(|(n, y)| (at(n), *y)).collect());
    let mut below =
        Panel::new(quantity(response)).line("response", Role::Ours, line(&tuning.sampled.response));
    for rest in &tuning.found.rests {
        below = below.band(at(rest.first), at(rest.end.saturating_sub(1)), "the command rests");
    }
    Figure::new("log", "The log", Quantity::time())
        .panel(Panel::new(quantity(command)).line("command", Role::Reference, line(&tuning.sampled.command)))
        .panel(below)
}

/// The response with the model's curve, and what that leaves.
fn fit(tuning: &Tuning, [_, _, response]: &[String; 3]) -> Figure {
    let fitted = &tuning.found.fitted;
    let at = |n: usize| tuning.sampled.start + (fitted.first + n) as f64 * tuning.sampled.period;
    let measured = tuning.sampled.response.iter().skip(fitted.first);
    let pairs: Vec<(f64, f64)> = measured.copied().zip(fitted.values.iter().copied()).collect();
    let line = |value: &dyn Fn(&(f64, f64)) -> f64| {
        thinned(pairs.iter().enumerate().map(|(n, pair)| (at(n), value(pair))).collect())
    };
    let y = quantity(response);
    let left = Quantity::new("left over", "", &y.unit);
    Figure::new("fit", "The response and the modes found in it", Quantity::time())
        .panel(Panel::new(y).line("response", Role::Reference, line(&|p| p.0)).line(
            "fit",
            Role::Ours,
            line(&|p| p.1),
        ))
        .panel(Panel::new(left).line("", Role::Reference, line(&|p| p.0 - p.1)))
}

/// Amplitudes of a column where the modes were fitted, by frequency in Hz.
fn amplitudes(tuning: &Tuning, column: &[f64], window: Window) -> Option<Vec<(f64, f64)>> {
    let fitted = &tuning.found.fitted;
    let values: Vec<f64> = column.iter().skip(fitted.first).take(fitted.values.len()).copied().collect();
    let options = SpectrumOptions { window, remove_mean: true, least_length: 4 * values.len() };
    let spectrum = amplitude_spectrum(&values, tuning.sampled.period, &options).ok()?;
    Some(spectrum.bins().map(|(w, amplitude)| (w / TAU, amplitude)).collect())
}

/// Amplitudes of the response over those of the command, where the command drives all modes of a transfer function.
fn quotient(tuning: &Tuning) -> Option<Vec<(f64, f64)>> {
    // Of less of its largest amplitude the skirts of others are left.
    const LEAST: f64 = 0.05;
    if tuning.found.route != Route::TransferFunction {
        return None;
    }
    // A taper would shift what a sweep holds of late frequencies against the answer to it.
    let of = |column: &[f64]| amplitudes(tuning, column, Window::Rectangular);
    let (driven, response) = (of(&tuning.sampled.command)?, of(&tuning.sampled.response)?);
    let least = LEAST * driven.iter().map(|bin| bin.1).fold(0.0, f64::max);
    let shown: Vec<(f64, f64)> =
        response.iter().zip(&driven).filter(|(_, u)| u.1 > least).map(|(y, u)| (y.0, y.1 / u.1)).collect();
    let (first, last) = (shown.first()?.0, shown.last()?.0);
    tuning.found.modes.iter().all(|mode| first < mode.mode.hz() && mode.mode.hz() < last).then_some(shown)
}

/// Amplitudes of the response where the modes were fitted; over those of the command where that shows more.
fn spectrum(tuning: &Tuning, [_, command, response]: &[String; 3]) -> Option<Figure> {
    let units = [response, command].map(|name| unit(name).unwrap_or_default());
    let (title, amplitude, mut shown) = if let Some(quotient) = quotient(tuning) {
        let pure = units[0] == units[1] || units.contains(&"");
        let unit = if pure { String::new() } else { units.join("/") };
        let amplitude = Quantity::new("response over command", "", &unit);
        ("Amplitude of the response over that of the command", amplitude, quotient)
    } else {
        let amplitude = Quantity::new("amplitude", "", units[0]);
        let shown = amplitudes(tuning, &tuning.sampled.response, Window::Hann)?;
        ("Spectrum of the fitted part of the response", amplitude, shown)
    };
    let highest = tuning.found.modes.iter().map(|mode| mode.mode.hz()).fold(0.0, f64::max);
    shown.retain(|(f, amplitude)| *f > 0.0 && *f < 3.0 * highest && *amplitude > 0.0);
    if shown.len() < 2 {
        return None;
    }
    let mut panel = Panel::new(amplitude.logarithmic()).line("", Role::Reference, thinned(shown.clone()));
    // A mode stands on the line, between its neighbours; where there is no line there is no place for it.
    let on_line = |hz: f64| {
        let above = shown.iter().position(|(f, _)| *f >= hz)?;
        let (right, left) = (shown.get(above)?, shown.get(above.checked_sub(1)?)?);
        let part = (hz - left.0) / (right.0 - left.0);
        Some((hz, left.1.powf(1.0 - part) * right.1.powf(part)))
    };
    let modes: Vec<(f64, f64)> =
        tuning.found.modes.iter().filter_map(|mode| on_line(mode.mode.hz())).collect();
    if !modes.is_empty() {
        panel = panel.marks("modes", modes);
    }
    let frequency = Quantity::new("frequency", "f", "Hz");
    Some(Figure::new("spectrum", title, frequency).panel(panel))
}

/// What the shapers for the first mode leave when its frequency is another: the recommended one and the shortest others.
fn shapers(tuning: &Tuning) -> Figure {
    let mut panel = Panel::new(Quantity::new("vibration left of a step", "V", "%"));
    let first = tuning.uncertain.first().zip(tuning.shaper.judged.first()).zip(tuning.shaper.chosen.first());
    if let Some(((mode, judged), chosen)) = first {
        let others = judged.iter().enumerate().filter(|(at, _)| at != chosen);
        let others =
            others.zip([Role::Second, Role::Third, Role::Fourth]).map(|((_, shaper), role)| (shaper, role));
        let recommended = judged.get(*chosen).map(|shaper| (shaper, Role::Ours));
        // The last line drawn is on top.
        for (shaper, role) in others.chain(recommended) {
            let left = |part: f64| 100.0 * shaper.train.sensitivity(mode.mode(), part);
            panel = panel.line(&said(&shaper.name(), role), role, over_errors(left));
        }
        panel = known(panel, mode, tuning.deviations);
    }
    let title = format!("Shapers for the mode at {} when its frequency is off", frequency(tuning, 0));
    Figure::new("shapers", &title, off_by()).panel(panel.limit(100.0 * tuning.tolerated_part, "tolerated"))
}

/// A name in the legend, by its part.
fn said(name: &str, role: Role) -> String {
    if role == Role::Ours { format!("{name} (recommended)") } else { name.to_owned() }
}

/// The recommended move beside the S-curve, and what the response still does after them.
fn moves(tuning: &Tuning, plan: &Plan, [_, command, response]: &[String; 3]) -> Figure {
    let shown = compared(plan);
    let end = shown.iter().map(|(_, judged)| judged.motion.duration()).fold(0.0, f64::max);
    let slowest = tuning.uncertain.iter().map(|mode| mode.mode().damped_period()).fold(0.0, f64::max);
    let end = end + 3.0 * slowest;
    let samples = 1500;
    let times = || (0..=samples).map(|n| end * f64::from(n) / f64::from(samples));
    let per = |order| rate(unit(command).unwrap_or_default(), order);
    let mut velocity = Panel::new(Quantity::new("velocity", "v", &per(1)));
    let mut acceleration = Panel::new(Quantity::new("acceleration", "a", &per(2)));
    let swings = Quantity::new("vibration of the response", "", unit(response).unwrap_or_default());
    let mut vibration = Panel::new(swings);
    for (role, judged) in &shown {
        let name = said(&judged.kind.name(), *role);
        let of = |value: &dyn Fn(profiles::Sample) -> f64| {
            times().map(|t| (t, value(judged.motion.sample(t)))).collect()
        };
        velocity = velocity.line(&name, *role, of(&|s| s.velocity));
        acceleration = acceleration.line(&name, *role, of(&|s| s.acceleration));
        vibration = vibration.line(&name, *role, swing(&judged.motion, &tuning.uncertain, end, samples));
    }
    let tolerated = plan.task.tolerated;
    Figure::new("move", "The recommended move, and what it leaves swinging", Quantity::time())
        .panel(velocity)
        .panel(acceleration)
        .panel(vibration.limit(tolerated, "tolerated").limit(-tolerated, ""))
}

/// What the moves leave when all frequencies are off by the same part.
fn sensitivity(tuning: &Tuning, plan: &Plan, [_, _, response]: &[String; 3]) -> Figure {
    let unit = unit(response).unwrap_or_default();
    let mut panel = Panel::new(Quantity::new("vibration at the end", "", unit).logarithmic());
    for (role, judged) in compared(plan) {
        let left = |part: f64| -> f64 {
            let amplitudes = tuning.uncertain.iter().map(|mode| {
                let pole = mode.mode().pole() * (1.0 + part);
                mode.participation() * judged.motion.response(pole).norm() / pole.im
            });
            // A zero has no place on an axis of decades.
            amplitudes.sum::<f64>().max(1e-2 * plan.task.tolerated)
        };
        panel = panel.line(&said(&judged.kind.name(), role), role, over_errors(left));
    }
    if let Some(mode) = tuning.uncertain.first() {
        panel = known(panel, mode, tuning.deviations);
    }
    Figure::new("sensitivity", "What is left swinging when the frequencies are off", off_by())
        .panel(panel.limit(plan.task.tolerated, "tolerated"))
}

/// The S-curve, the best of other kinds, and the recommended move, which is drawn last: on top.
fn compared(plan: &Plan) -> Vec<(Role, &JudgedMove)> {
    let best = plan.moves.best();
    // Of one mode a chain of averages may be the shaped S-curve: the same line twice.
    let twin = |a: &JudgedMove, b: &JudgedMove| {
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.abs();
        near(a.motion.duration(), b.motion.duration()) && near(a.worst, b.worst)
    };
    let plain = plan.plain().filter(|plain| best.is_none_or(|best| best.kind != plain.kind));
    let mut others: Vec<&JudgedMove> = Vec::new();
    for judged in plan.moves.moves.iter().filter(|judged| judged.kind != MoveKind::SCurve) {
        if !best.into_iter().chain(others.iter().copied()).any(|shown| twin(shown, judged)) {
            others.push(judged);
        }
    }
    let plain = plain.map(|judged| (Role::Reference, judged));
    let others = [Role::Second, Role::Third].into_iter().zip(others);
    plain.into_iter().chain(others).chain(best.map(|judged| (Role::Ours, judged))).collect()
}

fn off_by() -> Quantity {
    Quantity::new("frequency error", "", "%")
}

fn over_errors(left: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    (-200..=200).map(|n| f64::from(n) / 1000.0).map(|part| (100.0 * part, left(part))).collect()
}

/// Shades what the frequency may be.
fn known(panel: Panel, mode: &UncertainMode, deviations: f64) -> Panel {
    let margin = 100.0 * deviations * mode.frequency_deviation() / mode.mode().angular_frequency();
    panel.band(-margin, margin, "what the frequency may be")
}

/// How the modes swing under a move: each as a load on a spring, by its participation.
///
/// With `s` the integral of `a(u) e^(p (t - u)) du` the load is `Im s / w_d` behind. Simpson's rule over a step.
fn swing(motion: &impl Profile, modes: &[UncertainMode], end: f64, samples: u32) -> Vec<(f64, f64)> {
    const FINER: u32 = 8;
    let step = end / f64::from(samples * FINER);
    let mut states = vec![Complex::new(0.0, 0.0); modes.len()];
    let mut line = vec![(0.0, 0.0)];
    for n in 0..samples * FINER {
        let at = |part: f64| motion.sample((f64::from(n) + part) * step).acceleration;
        // From the left at the end of a step would do as well: a jump is a rounding of the picture.
        let [first, middle, last] = [at(0.0), at(0.5), at(1.0)];
        let mut sum = 0.0;
        for (state, mode) in states.iter_mut().zip(modes) {
            let pole = mode.mode().pole();
            let half = (pole * (0.5 * step)).exp();
            *state =
                *state * half * half + (half * half * first + half * (4.0 * middle) + last) * (step / 6.0);
            sum -= mode.participation() * state.im / pole.im;
        }
        if (n + 1) % FINER == 0 {
            line.push((f64::from(n + 1) * step, sum));
        }
    }
    line
}

fn thinned(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    if points.len() <= MOST_POINTS {
        return points;
    }
    let bin = points.len().div_ceil(MOST_POINTS / 2);
    let by_height = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
    points
        .chunks(bin)
        .flat_map(|bin| {
            let ends = [bin.iter().min_by(by_height), bin.iter().max_by(by_height)];
            let mut ends: Vec<(f64, f64)> = ends.into_iter().flatten().copied().collect();
            ends.sort_by(|a, b| a.0.total_cmp(&b.0));
            ends
        })
        .collect()
}
