//! Hou, Zhou, Li 2010: four ways to ramp a linear motor up to speed, and what they cost in position error.

mod loops;
mod setup;

use anyhow::Result;
use profiles::{Cosine, Profile, SCurve, Sectioned, SnapLimited, Trapezoid};

use self::loops::{ErrorCourse, Sampled, continuous};
use self::setup::{
    ACCELERATION, DISTANCE, FEEDFORWARD, JERK, Law, MASS, MOVE_HORIZON, READINGS, SNAP, STEP, VELOCITY,
    WHOLE_MOVE, limits,
};
use crate::experiment::{Context, Experiment, Outcome, Source};
use crate::figure::{Figure, Panel, Quantity, Role};

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    id: "acceleration-curves",
    title: "Trapezoid, S-curve, snap-limited and cosine ramps on a linear motor",
    citation: "Hou B., Zhou Y., Li X., Research on effects of accelerating/decelerating curve to the performance of \
               linear motor system, 2010 (in Chinese)",
    sources: &[
        Source { path: file!(), text: include_str!("acceleration_curves.rs") },
        Source { path: setup::FILE, text: include_str!("acceleration_curves/setup.rs") },
        Source { path: loops::FILE, text: include_str!("acceleration_curves/loops.rs") },
    ],
    expected: include_str!("../../papers/acceleration-curves/expected.toml"),
    readme_figure: Some("fig7"),
    run,
};

fn run(context: &Context) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    context.progress.steps(3 + READINGS.len() as u64 * 3);
    laws(&mut outcome)?;
    context.progress.step();
    ramp_times(&mut outcome)?;
    context.progress.step();
    position_errors(context, &mut outcome)?;
    sampled_errors(context, &mut outcome)?;
    better(&mut outcome)?;
    context.progress.step();
    outcome.note(format!(
        "Jerk and its derivative are not printed: {JERK} m/s^3 and {SNAP} m/s^4 follow from the printed ramp times of \
         the S-curve and the cubic curve."
    ));
    outcome.note(format!(
        "Which move figure 8 shows is not printed: a whole move of {:.0} mm, the gains K_P and K_D exchanged, comes \
         closest of the readings tried.",
        1e3 * DISTANCE
    ));
    outcome.note(
        "Figures 3 to 6 draw every derivative that is a function. The next one is impulses: where the acceleration of \
         the trapezoid, the jerk of the S-curve and the derivative of jerk of the cubic curve jump, and at both ends of \
         each ramp of the cosine.",
    );
    outcome
        .note("The discussion of figure 8 names the quadratic curve twice; 6.3 um belongs to the cubic one.");
    outcome.note(
        "Equation (10) lists the phase of constant jerk under J = 0; the phase of constant acceleration is meant.",
    );
    Ok(outcome)
}

fn velocity() -> Quantity {
    Quantity::new("velocity", "v", "m/s")
}

fn acceleration() -> Quantity {
    Quantity::new("acceleration", "a", "m/s^2")
}

fn error() -> Quantity {
    Quantity::new("position error", "e", "um")
}

/// Figures 3 to 6: every law over a whole move, with as many of its derivatives as the paper draws.
fn laws(outcome: &mut Outcome) -> Result<()> {
    let limits = limits()?;
    let trapezoid = Trapezoid::rest_to_rest(DISTANCE, &limits)?;
    // As many derivatives as are functions; the next one would be a row of impulses.
    outcome.figure(law("fig3", "Fig. 3: trapezoid, velocity linear in time", &trapezoid, 2, 2));
    let s_curve = SCurve::rest_to_rest(DISTANCE, &limits)?;
    outcome.figure(law("fig4", "Fig. 4: S-curve, velocity quadratic in time", &s_curve, 3, 3));
    let snap_limited = SnapLimited::rest_to_rest(DISTANCE, &limits)?;
    outcome.figure(law("fig5", "Fig. 5: snap-limited, velocity cubic in time", &snap_limited, 4, 4));
    let cosine = Cosine::rest_to_rest(DISTANCE, &limits)?;
    outcome.figure(law("fig6", "Fig. 6: cosine", &cosine, 4, 3));
    // The paper calls the cosine free of jerk steps; this is the step from rest.
    outcome.measure("jerk-step/cosine", cosine.sample(0.0).jerk.abs());
    Ok(())
}

/// One law: the highest of `orders` derivatives on top, the velocity at the bottom, the limits of the first `limited`,
/// sections shaded in turn.
fn law<P: Sectioned>(id: &str, title: &str, profile: &P, orders: usize, limited: usize) -> Figure {
    let rows = [
        (velocity(), VELOCITY, "v_max"),
        (acceleration(), ACCELERATION, "a_max"),
        (Quantity::new("jerk", "j", "m/s^3"), JERK, "j_max"),
        (Quantity::new("derivative of jerk", "dj", "m/s^4"), SNAP, "dj_max"),
    ];
    let sections: Vec<_> =
        (0..).map_while(|k| profile.section(k)).filter(|section| section.length() > 0.0).collect();
    let mut figure = Figure::new(id, title, Quantity::time());
    for (order, (quantity, limit, name)) in rows.into_iter().enumerate().take(orders).rev() {
        let value = |s: profiles::Sample| [s.velocity, s.acceleration, s.jerk, s.snap][order];
        // Both sides of every boundary, so that a jump is drawn as one.
        let mut points = vec![(0.0, value(profile.before()))];
        for section in &sections {
            let instants =
                (0..=100).map(|k| section.start + (section.end - section.start) * f64::from(k) / 100.0);
            points.extend(instants.map(|t| (t, value(section.at(t)))));
        }
        points.push((profile.duration(), value(profile.after())));
        let mut panel = Panel::new(quantity).line("", Role::Ours, points);
        if order < limited {
            panel = panel.limit(limit, name);
        }
        if order > 0 && order < limited {
            panel = panel.limit(-limit, &format!("−{name}"));
        }
        for section in sections.iter().step_by(2) {
            panel = panel.band(section.start, section.end, "");
        }
        figure = figure.panel(panel);
    }
    figure
}

/// Figure 7: from rest to top speed.
fn ramp_times(outcome: &mut Outcome) -> Result<()> {
    let mut speeds = Panel::new(velocity()).limit(VELOCITY, "v_max");
    let mut accelerations = Panel::new(acceleration()).limit(ACCELERATION, "a_max");
    let mut jerks = Panel::new(Quantity::new("jerk", "j", "m/s^3"));
    let mut printed = Vec::new();
    let s_curve = Law::SCurve.ramp()?.duration();
    for law in Law::ALL {
        let ramp = law.ramp()?;
        let instants = || (0..=1000).map(|k| 0.1 * f64::from(k) / 1000.0);
        let line =
            |value: fn(&profiles::Sample) -> f64| instants().map(|t| (t, value(&ramp.sample(t)))).collect();
        speeds = speeds.line(law.id(), law.role(), line(|s| s.velocity));
        accelerations = accelerations.line(law.id(), law.role(), line(|s| s.acceleration));
        if law != Law::Trapezoid {
            jerks = jerks.line(law.id(), law.role(), line(|s| s.jerk));
        }
        outcome.measure(format!("ramp-time/{}", law.id()), ramp.duration());
        if let Some((time, _)) = law.printed() {
            printed.push((law.role(), (time, VELOCITY)));
        }
        if matches!(law, Law::SnapLimited | Law::Cosine) {
            outcome.measure(format!("longer/{}", law.id()), ramp.duration() / s_curve - 1.0);
        }
    }
    let figure = Figure::new("fig7", "Fig. 7: ramps to 0.2 m/s at up to 4 m/s²", Quantity::time());
    outcome.figure(
        figure.panel(speeds.marks_of("printed end of ramp", printed)).panel(accelerations).panel(jerks),
    );
    Ok(())
}

/// Adds the three errors of a reading and their printed peaks to a panel.
fn error_panel(courses: &[(Law, ErrorCourse)]) -> Panel {
    let mut printed = Vec::new();
    let mut panel = Panel::new(error());
    for (law, course) in courses {
        panel = panel.line(law.id(), law.role(), course.in_micrometres());
        if let Some((_, peak)) = law.printed() {
            let (t, ours) = course.peak();
            printed.push((law.role(), (t, 1e6 * peak.copysign(ours))));
        }
    }
    panel.marks_of("printed peak", printed)
}

/// Figure 8 in continuous time, for every reading of its gains and of its move.
fn position_errors(context: &Context, outcome: &mut Outcome) -> Result<()> {
    let mut readings =
        Figure::new("fig8-readings", "Fig. 8 read in three other ways, continuous control", Quantity::time());
    let step = if context.quick { 5.0 * STEP } else { STEP };
    for reading in &READINGS {
        context.progress.say(reading.title);
        let mut courses = Vec::new();
        for law in Law::COMPARED {
            let reference = reading.reference(law)?;
            let course = continuous(reading.gains, &*reference, reading.horizon(), step)?;
            outcome.measure(format!("peak-error/{}/{}", reading.id, law.id()), course.peak().1.abs());
            courses.push((law, course));
        }
        context.progress.step();
        let peaks: Vec<f64> = courses.iter().map(|(_, course)| course.peak().1.abs()).collect();
        if reading.id.starts_with("exchanged") {
            let [largest, .., smallest] = peaks[..] else { continue };
            outcome.measure(format!("spread/{}", reading.id), 1.0 - smallest / largest);
            outcome.measure(format!("order/{}", reading.id), order(&courses));
        }
        let panel = error_panel(&courses);
        if reading.whole_move {
            let title = "Fig. 8: position error over a move of 40 mm, continuous control";
            let mut reference = Panel::new(velocity()).limit(VELOCITY, "v_max");
            for law in Law::COMPARED {
                let profile = law.whole_move()?;
                let points = (0..=1000).map(|k| MOVE_HORIZON * f64::from(k) / 1000.0);
                reference = reference.line(
                    law.id(),
                    law.role(),
                    points.map(|t| (t, profile.sample(t).velocity)).collect(),
                );
            }
            outcome.figure(Figure::new("fig8", title, Quantity::time()).panel(panel).panel(reference));
        } else {
            readings = readings
                .panel(Panel { y: Quantity::new(&format!("{}: error", reading.title), "e", "um"), ..panel });
        }
    }
    outcome.figure(readings);
    Ok(())
}

/// The laws from the largest peak to the smallest.
fn order(courses: &[(Law, ErrorCourse)]) -> String {
    let mut peaks: Vec<_> = courses.iter().map(|(law, course)| (course.peak().1.abs(), law.id())).collect();
    peaks.sort_by(|a, b| b.0.total_cmp(&a.0));
    peaks.iter().map(|(_, id)| *id).collect::<Vec<_>>().join(" > ")
}

/// The same at 2.5 kHz, with an ideal sensor and through the encoder.
fn sampled_errors(context: &Context, outcome: &mut Outcome) -> Result<()> {
    let title = "The move of 40 mm under control at 2.5 kHz";
    let mut figure = Figure::new("fig8-2500hz", title, Quantity::time());
    for (prefix, encoder, name) in [
        ("peak-error-2500hz", false, "error, ideal sensor"),
        ("peak-error-2500hz-encoder", true, "error, 1 µm encoder"),
    ] {
        for reading in &READINGS {
            context.progress.say(&format!("{}, 2.5 kHz", reading.title));
            let mut courses = Vec::new();
            for law in Law::COMPARED {
                let reference = reading.reference(law)?;
                let loop_ = Sampled::of(reading.gains, encoder);
                let metric = format!("{prefix}/{}/{}", reading.id, law.id());
                match loop_.run(&*reference, reading.horizon())? {
                    Some(course) => {
                        outcome.measure(metric, course.peak().1.abs());
                        courses.push((law, course));
                    }
                    None => outcome.measure(metric, "unstable"),
                }
            }
            context.progress.step();
            if reading.whole_move {
                figure = figure.panel(Panel { y: Quantity::new(name, "e", "um"), ..error_panel(&courses) });
            }
        }
    }
    outcome.figure(figure);
    Ok(())
}

/// What remains when the feedforward knows the mass and looks half a sample ahead.
fn better(outcome: &mut Outcome) -> Result<()> {
    let gains = WHOLE_MOVE.gains;
    let title = "Better: feedforward of the true mass, half a sample ahead, 2.5 kHz";
    let mut figure = Figure::new("better", title, Quantity::time());
    let controllers = [
        ("better", MASS, 0.5, false, "error, ideal sensor"),
        ("better-encoder", MASS, 0.5, true, "error, 1 µm encoder"),
        ("better-mass-only", MASS, 0.0, false, "error, mass alone"),
        ("better-preview-only", FEEDFORWARD, 0.5, false, "error, preview alone"),
    ];
    for (id, feedforward, preview, encoder, name) in controllers {
        let mut panel = Panel::new(Quantity::new(name, "e", "um"));
        for law in Law::COMPARED {
            let reference = law.whole_move()?;
            let controller = Sampled { gains, feedforward, preview, encoder };
            if let Some(course) = controller.run(&*reference, MOVE_HORIZON)? {
                outcome.measure(format!("{id}/{}", law.id()), course.peak().1.abs());
                panel = panel.line(law.id(), law.role(), course.in_micrometres());
            }
        }
        figure = figure.panel(panel);
    }
    outcome.figure(figure);
    Ok(())
}
