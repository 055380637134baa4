//! Wu, Zhang 2019: a servo that vibrates at the end of a move, what its response says of the vibration, and a filter with
//! three impulses that quiets it.

mod pole_map;
mod pulse_axis;
mod quieted;
mod reading;
mod search;
mod servo;
mod setup;

use anyhow::{Context as _, Result, ensure};
use profiles::{Mode, Profile, Trapezoid};
use shaping::{DelayFilter, Shaped};

use self::pole_map::{PoleMap, listed, vibration_of};
use self::reading::{Reading, fitted, nearest, other_classes, read};
use self::search::{Found, search};
use self::servo::{LoopParameters, Servo};
use self::setup::{HORIZON, LOW_PASS, SYSTEMS, System, command, letter};
use crate::experiment::{Context, Experiment, Outcome, Source};
use crate::figure::{Figure, Panel, Quantity, Role};
use crate::row::Value;

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    id: "delay-filter",
    title: "A PMSM servo that vibrates, is identified, and is quieted by a delay filter",
    citation: "Wu J., Zhang H., Residual vibration suppression of servo system based on time delay filter, Journal of \
               Mechanical & Electrical Engineering 36 (2019) 919-924 (in Chinese), doi:10.3969/j.issn.1001-4551.2019.09.007",
    sources: &[
        Source { path: file!(), text: include_str!("delay_filter.rs") },
        Source { path: setup::FILE, text: include_str!("delay_filter/setup.rs") },
        Source { path: servo::FILE, text: include_str!("delay_filter/servo.rs") },
        Source { path: reading::FILE, text: include_str!("delay_filter/reading.rs") },
        Source { path: search::FILE, text: include_str!("delay_filter/search.rs") },
        Source { path: pole_map::FILE, text: include_str!("delay_filter/pole_map.rs") },
        Source { path: quieted::FILE, text: include_str!("delay_filter/quieted.rs") },
        Source { path: pulse_axis::FILE, text: include_str!("delay_filter/pulse_axis.rs") },
    ],
    expected: include_str!("../../papers/delay-filter/expected.toml"),
    readme_figure: None,
    run,
};

/// The fit that the search starts from, and others to start from.
const STARTS: [(LoopParameters, f64); 3] = [
    (
        LoopParameters {
            velocity_integral: 3.45,
            current_bandwidth: 1970.0,
            spring_damping: 0.006,
            load_damping: 1e-5,
        },
        9.2e-4,
    ),
    (
        LoopParameters {
            velocity_integral: 2.0,
            current_bandwidth: 4000.0,
            spring_damping: 0.002,
            load_damping: 1e-3,
        },
        3e-3,
    ),
    (
        LoopParameters {
            velocity_integral: 6.0,
            current_bandwidth: 3000.0,
            spring_damping: 0.001,
            load_damping: 1e-4,
        },
        2e-3,
    ),
];

fn run(context: &Context) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let iterations = if context.quick { 5 } else { 120 };
    context.progress.say("search for the loops");
    let found = search(&STARTS, iterations, &|| context.progress.step())?;
    cancelling(&mut outcome)?;
    filters(&mut outcome)?;
    context.progress.say("responses");
    responses(&found, &mut outcome)?;
    energy(&found, &mut outcome)?;
    quieted::figures(&found, &mut outcome)?;
    context.progress.say("pulse axis");
    pulses(&mut outcome)?;
    assumptions(&found, &mut outcome);
    Ok(outcome)
}

fn assumptions(found: &Found, outcome: &mut Outcome) {
    let LoopParameters { velocity_integral, current_bandwidth, spring_damping, load_damping } = found.loops;
    outcome.note(format!(
        "Not printed, and found by a search over {} sets of loops (simplex method, three starts): velocity integral \
         {velocity_integral:.6} A min/(r s), bandwidth of the current {current_bandwidth:.4} rad/s, damping of the spring \
         {spring_damping:.8} N m s, of the load {load_damping:.8} N m s, settling band {:.7} % of the move. It minimises the \
         sum of ln(1 + d^2) over table 2, d the distance from print over 10 % of a damping ratio or settling time or 5 % of a \
         frequency: {:.2}, and {:.2} at its first start. The bandwidth is kept below half a radian to a tick.",
        found.evaluations,
        100.0 * found.band,
        found.cost,
        found.start_cost
    ));
    outcome.note(
        "Chosen where the paper is silent: three pole pairs (only gain times torque constant shows), all loops at 10 kHz, the \
         position of the motor fed back, velocity gain in A per r/min, the position of the load looked at. The paper has PI in \
         all three loops; the position loop here is P alone: no integral gain is printed, and the integral of the velocity \
         loop leaves no standing error.",
    );
    outcome.note(
        "A settling time jumps by half a swing where a peak leaves the band: loops that differ in the fourth digit may differ by \
         10 ms there.",
    );
    outcome.note(
        "The half-cycle formulas (13)-(14) read the first peak, which the command and every mode shape: damping-half-cycle \
         beside the poles shows how far off they are. On these loops none comes out negative.",
    );
    outcome.note(
        "Every frequency the paper prints in Hz is in rad/s: only so does its equation (8) give its table 3. Equation (6) lacks \
         a minus sign in its exponent, and so does the denominator of (8) ahead of its cosine; table 3 prints its delays in \
         seconds under a head of milliseconds.",
    );
    outcome.note(
        "Equations (9) and (13) take the logarithmic decrement itself for the damping ratio: a true 0.4583 reads 0.5156. The \
         exact form, a fit of damped sinusoids to what follows the command and the poles of the linearised loop stand beside.",
    );
    outcome.note(
        "Pulse axis: the printed 117 rad/s, 0.21 and 104 rad/s contradict each other. The amplitudes follow from a decay of \
         0.2123 x 117 and an oscillation of 104.8 rad/s, which is the mode used. Pulses to a revolution (10 000) and the time \
         constant of the drive's low-pass (that of equation 17) are not printed.",
    );
}

fn position() -> Quantity {
    Quantity::new("position of the load", "", "rad")
}

/// Figure 2: two impulses that cancel, on the printed mode of system 2.
fn cancelling(outcome: &mut Outcome) -> Result<()> {
    let mode = SYSTEMS[1].printed_mode()?.context("a mode")?;
    // A quarter of a period between three impulses: the middle one vanishes, which leaves zero vibration with two.
    let filter = DelayFilter::new(mode, 0.25 * mode.damped_period())?;
    let ([first, _, second], half, pole) = (filter.amplitudes(), 2.0 * filter.delay(), mode.pole());
    let swing = |amplitude: f64, start: f64| {
        move |t: f64| if t < start { 0.0 } else { amplitude * (pole * (t - start)).exp().im }
    };
    let (one, two) = (swing(first, 0.0), swing(second, half));
    let line = |value: &dyn Fn(f64) -> f64| -> Vec<(f64, f64)> {
        (0..=800).map(|k| 0.05 * f64::from(k) / 800.0).map(|t| (t, value(t))).collect()
    };
    let both = line(&|t| one(t) + two(t));
    let left = both.iter().filter(|(t, _)| *t > half).map(|(_, y)| y.abs()).fold(0.0, f64::max);
    ensure!(left < 1e-12, "two impulses leave {left}");
    let panel = Panel::new(Quantity::new("swing over that of one impulse", "y", ""))
        .line("first impulse", Role::Ours, line(&one))
        .line("second impulse", Role::Second, line(&two))
        .line("both", Role::Reference, both);
    outcome.figure(
        Figure::new("fig2", "Fig. 2: two impulses half a period apart cancel", Quantity::time()).panel(panel),
    );
    Ok(())
}

/// Table 3: the filters of the printed modes.
fn filters(outcome: &mut Outcome) -> Result<()> {
    for system in &SYSTEMS {
        let (Some(mode), Some(delay)) = (system.printed_mode()?, system.filter_delay) else { continue };
        let amplitudes = DelayFilter::positive(mode, delay)?.amplitudes();
        for (k, amplitude) in (1..).zip(amplitudes) {
            outcome.measure(format!("table3/{}/a{k}", system.number), amplitude);
        }
    }
    let mode = pulse_axis::mode()?;
    outcome.measure("pulse-axis/frequency", mode.angular_frequency());
    outcome.measure("pulse-axis/damping", mode.damping_ratio());
    outcome.measure("pulse-axis/damped-frequency", mode.damped_angular_frequency());
    let amplitudes = DelayFilter::positive(mode, pulse_axis::DELAY)?.amplitudes();
    for (k, amplitude) in (1..).zip(amplitudes) {
        outcome.measure(format!("pulse-axis/a{k}"), amplitude);
    }
    Ok(())
}

/// A number, or the word for none.
fn number_or_none(value: Option<f64>) -> Value {
    value.map_or_else(|| "none".into(), Value::from)
}

/// The move of the paper and its length, rad.
fn move_and_target() -> Result<(Trapezoid, f64)> {
    let command = command()?;
    let target = command.sample(command.duration()).position;
    Ok((command, target))
}

/// Table 2 and figure 3: the four systems, read in four ways.
fn responses(found: &Found, outcome: &mut Outcome) -> Result<()> {
    let (command, target) = move_and_target()?;
    let mut whole = Panel::new(position());
    let mut close = Panel::new(Quantity::new("distance from the target", "", "mrad"));
    let end = command.duration();
    let mut map = PoleMap::default();
    for system in &SYSTEMS {
        let servo = Servo::new(system, &found.loops)?;
        let response = servo.run(|t| command.sample(t).position, HORIZON, 1)?;
        let reading = read(&response, target, found.band)?;
        table2(system, &reading, outcome);
        for (name, class) in other_classes(&response, target)? {
            outcome.measure(format!("table2/{}/class-{name}", system.number), letter(class));
        }
        let n = system.number;
        let (found, loops) = (fitted(&response, end), servo.modes()?);
        let of = |modes: &[Mode]| match reading.exact {
            Some(vibration) => nearest(modes, vibration),
            None => nearest(modes, vibration_of(*found.first()?)),
        };
        let vibrations = [
            ("exact", reading.exact),
            ("fit", of(&found).map(vibration_of)),
            ("pole", of(&loops).map(vibration_of)),
        ];
        for (name, vibration) in vibrations {
            outcome.measure(format!("table2/{n}/damping-{name}"), number_or_none(vibration.map(|v| v.0)));
            outcome.measure(format!("table2/{n}/frequency-{name}"), number_or_none(vibration.map(|v| v.1)));
        }
        outcome
            .note(format!("Modes of the loop of system {n}, damping ratio and rad/s: {}.", listed(&loops)));
        map.add(system.role, &loops, &found, reading.printed);
        let name = format!("system {n}");
        whole = whole.line(&name, system.role, response.points(|k| response.load[k]));
        close = close.line(&name, system.role, response.points(|k| 1e3 * (response.load[k] - target)));
    }
    let asked = (0..=500).map(|k| HORIZON * f64::from(k) / 500.0).map(|t| (t, command.sample(t).position));
    whole = whole.line("command", Role::Reference, asked.collect()).limit(target, "target");
    let band = 1e3 * found.band * target;
    close = late(close, 0.04).limit(band, "band").limit(-band, "−band");
    let title = "Fig. 3: the responses of four servo systems";
    outcome.figure(Figure::new("fig3", title, Quantity::time()).panel(whole).panel(close));
    outcome.figure(map.figure());
    Ok(())
}

/// A panel from `instant` in s on.
fn late(mut panel: Panel, instant: f64) -> Panel {
    for series in &mut panel.series {
        series.points.retain(|(t, _)| *t >= instant);
    }
    panel
}

fn table2(system: &System, reading: &Reading, outcome: &mut Outcome) {
    let n = system.number;
    outcome.measure(format!("table2/{n}/damping"), number_or_none(reading.printed.map(|v| v.0)));
    outcome.measure(format!("table2/{n}/frequency"), number_or_none(reading.printed.map(|v| v.1)));
    outcome.measure(format!("table2/{n}/damping-half-cycle"), number_or_none(reading.half_cycle));
    outcome.measure(format!("table2/{n}/class"), letter(reading.class));
    outcome.measure(format!("table2/{n}/settling"), number_or_none(reading.settling.map(|t| 1e3 * t)));
}

/// What the ledger leaves open, at a step of one tick and of half of it.
fn energy(found: &Found, outcome: &mut Outcome) -> Result<()> {
    let (command, _) = move_and_target()?;
    for system in &SYSTEMS {
        let servo = Servo::new(system, &found.loops)?;
        let imbalance = |substeps| -> Result<f64> {
            let response = servo.run(|t| command.sample(t).position, HORIZON, substeps)?;
            Ok(response.ledger.relative_imbalance())
        };
        let (whole, half) = (imbalance(1)?, imbalance(2)?);
        let n = system.number;
        outcome.measure(format!("energy/{n}/imbalance"), whole);
        outcome.measure(format!("energy/{n}/order"), (whole / half).log2());
    }
    Ok(())
}

/// Figures 8 and 9: the axis under pulses.
fn pulses(outcome: &mut Outcome) -> Result<()> {
    let command = pulse_axis::command()?;
    let filter = DelayFilter::positive(pulse_axis::mode()?, pulse_axis::DELAY)?;
    let shaped = Shaped::new(command, *filter.train());
    let end = shaped.duration();
    let plain = pulse_axis::run(command, None)?;
    let filtered = pulse_axis::run(shaped, None)?;
    let low_passed = pulse_axis::run(command, Some(LOW_PASS))?;
    for (id, course) in [("none", &plain), ("filter", &filtered), ("low-pass", &low_passed)] {
        outcome.measure(format!("pulse-axis/{id}/residual"), course.residual(end)?);
        outcome.measure(format!("pulse-axis/{id}/ripple"), course.ripple(end));
        outcome.measure(format!("pulse-axis/{id}/settling"), 1e3 * course.settling(4.0)?);
    }
    let count = Quantity::new("position", "", "pulses");
    let speed = Quantity::new("speed", "n", "r/min");
    let panel = Panel::new(count.clone())
        .line("position", Role::Ours, plain.points(&plain.position))
        .line("pulses sent", Role::Reference, plain.points(&plain.sent))
        .limit(pulse_axis::PULSES, "target");
    let speeds = Panel::new(speed.clone()).line("", Role::Ours, plain.points(&plain.speed));
    let title = "Fig. 8: the axis without a filter, 4000 pulses";
    outcome.figure(Figure::new("fig8", title, Quantity::time()).panel(panel).panel(speeds));

    let mut whole = Panel::new(count).limit(pulse_axis::PULSES, "target");
    let mut close = Panel::new(Quantity::new("distance from the target", "", "pulses"));
    let mut speeds = Panel::new(speed);
    for (name, role, course) in
        [("delay filter", Role::Ours, &filtered), ("low-pass of the drive", Role::Second, &low_passed)]
    {
        let errors: Vec<f64> = course.position.iter().map(|p| p - pulse_axis::PULSES).collect();
        whole = whole.line(name, role, course.points(&course.position));
        close = close.line(name, role, course.points(&errors));
        speeds = speeds.line(name, role, course.points(&course.speed));
    }
    // So late that the printed 4 pulses show.
    let close = late(close, 0.25).limit(4.0, "4").limit(-4.0, "−4");
    let title = "Fig. 9: the axis with the delay filter and with the low-pass";
    let figure = Figure::new("fig9", title, Quantity::time());
    outcome.figure(figure.panel(whole).panel(close).panel(late(speeds, 0.25)));
    Ok(())
}
