//! `parameters.json`: every number of a tuning, for other programs.

use std::f64::consts::TAU;

use anyhow::Result;
use optimize::{JudgedMove, JudgedShaper};
use profiles::Profile;
use serde::Serialize;

use super::analysis::{Plan, Tuning};
use crate::report::summary::GENERATED_BY;

#[derive(Serialize)]
struct Parameters {
    generated_by: &'static str,
    log: LogPart,
    class: Option<String>,
    noise: f64,
    quantum: f64,
    gain: Option<f64>,
    route: String,
    views: usize,
    fit_percent: f64,
    residual: f64,
    deviations: f64,
    modes: Vec<ModePart>,
    shaper: ShaperPart,
    #[serde(rename = "move")]
    plan: Option<MovePart>,
}

#[derive(Serialize)]
struct LogPart {
    file: String,
    samples: usize,
    start_s: f64,
    period_s: f64,
    time: String,
    command: String,
    response: String,
    lines_left_out: usize,
    remarks: Vec<String>,
}

#[derive(Serialize)]
struct ModePart {
    frequency_hz: f64,
    frequency_deviation_hz: f64,
    frequency_rad_s: f64,
    frequency_deviation_rad_s: f64,
    damping_ratio: f64,
    damping_deviation: f64,
    amplitude: f64,
    participation: f64,
    found_in_views: usize,
}

#[derive(Serialize)]
struct ShaperPart {
    kinds: Vec<String>,
    for_modes_hz: Vec<f64>,
    tolerated_part: f64,
    worst_part: f64,
    within: bool,
    duration_s: f64,
    impulses: Vec<ImpulsePart>,
}

#[derive(Serialize)]
struct ImpulsePart {
    time_s: f64,
    amplitude: f64,
}

#[derive(Serialize)]
struct MovePart {
    distance: f64,
    limits: LimitsPart,
    tolerated: f64,
    recommended: String,
    candidates: Vec<CandidatePart>,
}

#[derive(Serialize)]
struct CandidatePart {
    kind: String,
    duration_s: f64,
    vibration: f64,
    worst_vibration: f64,
    settling_s: Option<f64>,
    total_s: Option<f64>,
}

#[derive(Serialize)]
struct LimitsPart {
    velocity: f64,
    acceleration: f64,
    jerk: f64,
}

/// What is known of the file besides its samples.
#[derive(Clone, Debug)]
pub struct About {
    /// Name of the file.
    pub file: String,
    /// Names of time, command and response.
    pub names: [String; 3],
    /// Lines left out.
    pub left_out: usize,
}

/// The text of the file; the same log and question give the same bytes.
///
/// # Errors
/// None that a tuning can cause.
pub fn json(tuning: &Tuning, about: &About) -> Result<String> {
    let found = &tuning.found;
    let [time, command, response] = about.names.clone();
    let parameters = Parameters {
        generated_by: GENERATED_BY,
        log: LogPart {
            file: about.file.clone(),
            samples: tuning.sampled.response.len(),
            start_s: tuning.sampled.start,
            period_s: tuning.sampled.period,
            time,
            command,
            response,
            lines_left_out: about.left_out,
            remarks: tuning.remarks.clone(),
        },
        class: tuning.figures.class.as_ref().map(|class| format!("{:?}", class.class)),
        noise: tuning.figures.noise,
        quantum: tuning.figures.quantum,
        gain: tuning.figures.gain.or(found.dc_gain),
        route: super::analysis::route_words(found),
        views: found.views,
        fit_percent: found.fit,
        residual: found.residual,
        deviations: tuning.deviations,
        modes: modes(tuning),
        shaper: shaper(tuning),
        plan: tuning.plan.as_ref().map(plan),
    };
    Ok(serde_json::to_string_pretty(&parameters)? + "\n")
}

fn modes(tuning: &Tuning) -> Vec<ModePart> {
    let part = |(mode, uncertain): (&identify::LogMode, &optimize::UncertainMode)| ModePart {
        frequency_hz: mode.mode.hz(),
        frequency_deviation_hz: mode.frequency_deviation / TAU,
        frequency_rad_s: mode.mode.angular_frequency(),
        frequency_deviation_rad_s: mode.frequency_deviation,
        damping_ratio: mode.mode.damping_ratio(),
        damping_deviation: mode.damping_deviation,
        amplitude: mode.amplitude,
        participation: uncertain.participation(),
        found_in_views: mode.found,
    };
    tuning.found.modes.iter().zip(&tuning.uncertain).map(part).collect()
}

fn shaper(tuning: &Tuning) -> ShaperPart {
    let shaper = &tuning.shaper;
    ShaperPart {
        kinds: chosen(tuning).map(JudgedShaper::name).collect(),
        for_modes_hz: tuning.found.modes.iter().map(|mode| mode.mode.hz()).collect(),
        tolerated_part: tuning.tolerated_part,
        worst_part: shaper.worst,
        within: shaper.within,
        duration_s: shaper.train.duration(),
        impulses: shaper
            .train
            .impulses()
            .iter()
            .map(|impulse| ImpulsePart { time_s: impulse.time, amplitude: impulse.amplitude })
            .collect(),
    }
}

/// The chosen shaper of every mode.
pub(super) fn chosen(tuning: &Tuning) -> impl Iterator<Item = &JudgedShaper> {
    tuning.shaper.judged.iter().zip(&tuning.shaper.chosen).filter_map(|(judged, at)| judged.get(*at))
}

fn plan(plan: &Plan) -> MovePart {
    let limits = plan.task.limits;
    let candidate = |judged: &JudgedMove| CandidatePart {
        kind: judged.kind.name(),
        duration_s: judged.motion.duration(),
        vibration: judged.nominal,
        worst_vibration: judged.worst,
        settling_s: judged.settling,
        total_s: Some(judged.total()).filter(|total| total.is_finite()),
    };
    MovePart {
        distance: plan.task.distance,
        limits: LimitsPart {
            velocity: limits.velocity().upper,
            acceleration: limits.acceleration().upper,
            jerk: limits.jerk().upper,
        },
        tolerated: plan.task.tolerated,
        recommended: plan.moves.best().map_or(String::new(), |best| best.kind.name()),
        candidates: plan.moves.moves.iter().map(candidate).collect(),
    }
}
