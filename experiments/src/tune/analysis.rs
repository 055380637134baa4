//! What the libraries say of a log: read, ask, keep.

use std::f64::consts::TAU;

use anyhow::{Result, anyhow, bail};
use identify::{Log, LogFigures, LogModes, LogOptions, ResponseClass, Route, identify_log};
use optimize::{
    MoveKind, MoveRecommendation, MoveTask, ShaperRecommendation, UncertainMode, recommend_move,
    recommend_shaper,
};
use profiles::Limits;

use super::sampling::Sampled;

/// What is asked besides the modes.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// Where modes are looked for.
    pub route: Route,
    /// The move, if one is asked for.
    pub wanted: Option<Wanted>,
    /// Part of the vibration of a step that a shaper may leave.
    pub tolerated_part: f64,
    /// Standard deviations to reckon with.
    pub deviations: f64,
}

/// A move that is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    /// Signed distance, in the unit of the command.
    pub distance: f64,
    /// What the axis can do.
    pub limits: Limits,
    /// Tolerated vibration, in the unit of the response; none for a thousandth of the move.
    pub tolerated: Option<f64>,
}

/// Everything that a log says.
#[derive(Clone, Debug)]
pub struct Tuning {
    /// The log.
    pub sampled: Sampled,
    /// Noise, resolution, gain and class.
    pub figures: LogFigures,
    /// The modes.
    pub found: LogModes,
    /// The modes as a plan takes them.
    pub uncertain: Vec<UncertainMode>,
    /// The shaper for a command that cannot be planned.
    pub shaper: ShaperRecommendation,
    /// Part of the vibration of a step that it may leave.
    pub tolerated_part: f64,
    /// The move, if one was asked for.
    pub plan: Option<Plan>,
    /// Standard deviations that were reckoned with.
    pub deviations: f64,
    /// What had to be assumed, one sentence each.
    pub remarks: Vec<String>,
}

/// A recommended move.
#[derive(Clone, Debug)]
pub struct Plan {
    /// What it had to do.
    pub task: MoveTask,
    /// The moves, the best first.
    pub moves: MoveRecommendation,
}

/// Asks `identify` for the modes and `optimize` for shaper and move.
///
/// # Errors
/// A log without modes, with the reason; a move that cannot be planned.
pub fn tune(sampled: Sampled, question: &Question) -> Result<Tuning> {
    let log = Log::new(sampled.period, &sampled.command, &sampled.response)?;
    let figures = log.figures();
    let found = match identify_log(&log, &LogOptions { route: question.route, ..LogOptions::default() }) {
        Ok(found) => found,
        Err(why) => bail!("no mode: {}", in_hertz(&why.to_string())),
    };
    let mut remarks: Vec<String> = sampled.remark.iter().cloned().collect();
    if found.block > 1 {
        remarks.push(format!(
            "{} samples were averaged to one for the fit: modes above {} Hz are not looked for",
            found.block,
            crate::number::short(0.25 / (found.block as f64 * sampled.period))
        ));
    }
    let gain = figures.gain.or(found.dc_gain).map(f64::abs);
    let uncertain = found
        .modes
        .iter()
        .enumerate()
        .map(|(n, mode)| {
            let participation = mode.participation.unwrap_or_else(|| {
                remarks.push(format!(
                    "the command of the log does not show how strongly it drives mode {}: taken as a load on a spring",
                    n + 1
                ));
                gain.unwrap_or(1.0)
            });
            UncertainMode::new(mode.mode, mode.frequency_deviation, mode.damping_deviation)?
                .with_participation(participation)
        })
        .collect::<Result<Vec<_>, _>>()?;
    let told = |error: optimize::RecommendError| anyhow!(in_hertz(&error.to_string()));
    let shaper = recommend_shaper(&uncertain, question.tolerated_part, question.deviations).map_err(told)?;
    let plan = question
        .wanted
        .map(|wanted| -> Result<Plan> {
            let tolerated = match (wanted.tolerated, gain) {
                (Some(tolerated), _) => tolerated,
                (None, Some(gain)) if gain > 1e-6 => 1e-3 * wanted.distance.abs() * gain,
                (None, None) => 1e-3 * wanted.distance.abs(),
                (None, Some(_)) => bail!(
                    "the response does not go where the command goes: say with --tolerated-vibration which vibration \
                     of it is tolerated"
                ),
            };
            let Wanted { distance, limits, .. } = wanted;
            let task = MoveTask { distance, limits, tolerated, deviations: question.deviations };
            Ok(Plan { task, moves: recommend_move(&uncertain, &task).map_err(told)? })
        })
        .transpose()?;
    let Question { tolerated_part, deviations, .. } = *question;
    Ok(Tuning { sampled, figures, found, uncertain, shaper, tolerated_part, plan, deviations, remarks })
}

impl Plan {
    /// The S-curve: the move without any of this.
    #[must_use]
    pub fn plain(&self) -> Option<&optimize::JudgedMove> {
        self.moves.of_kind(MoveKind::SCurve)
    }
}

/// The class in words.
#[must_use]
pub(super) fn class_words(class: Option<ResponseClass>) -> &'static str {
    match class {
        Some(ResponseClass::A) => "A: no overshoot",
        Some(ResponseClass::B) => "B: overshoot without a steady decay",
        Some(ResponseClass::C) => "C: a decaying oscillation",
        None => "none: the log shows no move from rest to rest",
    }
}

/// Where the modes were found, in words.
#[must_use]
pub(super) fn route_words(found: &LogModes) -> String {
    let views = found.views;
    match (found.route, found.order) {
        (Route::TransferFunction, Some((poles, zeros))) => format!(
            "transfer function from command to response, {views} orders compared, the best with {poles} poles and {zeros} \
             zeros"
        ),
        _ => format!(
            "free decay after {} of the command, {views} windows",
            if found.rests.len() == 1 { "a move".to_owned() } else { format!("{} moves", found.rests.len()) }
        ),
    }
}

/// A reason of the library with its frequencies in Hz too: `12.6 rad/s` becomes `12.6 rad/s (2 Hz)`.
fn in_hertz(text: &str) -> String {
    let words: Vec<&str> = text.split(' ').collect();
    let mut told = Vec::with_capacity(words.len());
    for (n, word) in words.iter().enumerate() {
        let unit = word.trim_end_matches([':', ',']);
        let end = word.get(unit.len()..).unwrap_or_default();
        let number = n.checked_sub(1).and_then(|before| words.get(before)?.parse::<f64>().ok());
        match number {
            Some(w) if unit == "rad/s" => {
                told.push(format!("rad/s ({} Hz){end}", crate::number::short(w / TAU)));
            }
            // A whole number is a count, unless it is longer than any.
            _ => match unit.parse::<f64>() {
                Ok(x) if unit.contains('.') || unit.len() > 12 => {
                    told.push(format!("{}{end}", crate::number::short(x)));
                }
                _ => told.push((*word).to_owned()),
            },
        }
    }
    told.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_are_told_in_hertz_too_and_in_four_digits() {
        let long = format!("at most 1e150, got {}", 5.25e200);
        assert_eq!(in_hertz(&long), "at most 1e150, got 5.25e200");
        assert_eq!(in_hertz("damping ratio -0.0399657285, 17 views"), "damping ratio -0.03997, 17 views");
        assert_eq!(
            in_hertz("a mode at 12.566370614359172 rad/s swings by 0.123456 only, 3 views: at 5.1 rad/s, no"),
            "a mode at 12.57 rad/s (2 Hz) swings by 0.1235 only, 3 views: at 5.1 rad/s (0.8117 Hz), no"
        );
    }
}
