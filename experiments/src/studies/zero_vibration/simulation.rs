//! The two-inertia axis under a command, stepped exactly.
//!
//! The motor is given the force `(m_m + m_l) a(t)` that would move both masses together, without feedback. Their centre of mass
//! then follows the command, and the load swings about it by `e'' + 2 z w e' + w^2 e = -a(t)` in the free mode of the axis: what
//! `residual_vibration` says of a profile is what the load keeps. (A motor that is held to the command gives the same
//! equation in its held mode.)
//!
//! In a section of a profile the acceleration is a polynomial of second degree. It is part of the state, `a' = j`, `j' = snap`,
//! with the snap as the held input, so that a step is exact whatever its length.

use anyhow::Result;
use identify::Signal;
use plants::nalgebra::{self, SMatrix, SVector, vector};
use plants::{Transition, TwoInertia, zero_order_hold};
use profiles::{Complex, Mode};

use super::command::{Command, LOW_PASS_DAMPING};
use super::setup::axis;

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// Longest time between two samples during the command, s: straight lines between them put the end of settling within a few
/// microseconds.
const STEP: f64 = 2.5e-4;
/// Samples of the last period before the load is at rest.
const TAIL: u32 = 1000;
/// What the swing of a low-pass has fallen to, as a part of itself, when nothing but the mode is left: for the settling time, and
/// but for rounding.
const SETTLED: f64 = 1e-5;
const GONE: f64 = 1e-13;

/// What the load does.
pub(super) struct Course {
    /// s
    pub(super) times: Vec<f64>,
    /// m
    pub(super) load: Vec<f64>,
    /// What is simulated less what the closed form says of the vibration once only the mode is left, m.
    pub(super) disagreement: f64,
}

impl Course {
    /// The last time at which the load is farther than `band` from the target, s from the start.
    pub(super) fn settled(&self, target: f64, band: f64) -> Result<f64> {
        Ok(Signal::new(&self.times, &self.load)?.settling_time(target, band)?)
    }
}

/// When to look.
#[derive(Clone, Copy, Debug)]
pub(super) struct Watch {
    /// Until the load stays as near to the target as this, m.
    pub(super) band: f64,
    /// Closely until this instant at least, s.
    pub(super) until: f64,
}

/// The axis with this mode under a command.
pub(super) fn course(command: &Command, mode: Mode, watch: Watch) -> Result<Course> {
    let axis = axis(mode)?;
    match command.low_pass {
        None => driven(&Dynamics::direct(&axis)?, command, &axis, watch),
        Some(corner) => driven(&Dynamics::filtered(&axis, corner)?, command, &axis, watch),
    }
}

/// Positions and speeds of motor and load, what lies between, and last the acceleration and the jerk of the profile; the input
/// is its snap.
struct Dynamics<const N: usize> {
    system: SMatrix<f64, N, N>,
    input: SVector<f64, N>,
}

impl Dynamics<6> {
    /// The profile drives the axis itself.
    fn direct(axis: &TwoInertia) -> Result<Self> {
        let mut system = SMatrix::zeros();
        connect(axis, 4, &mut system)?;
        system[(4, 5)] = 1.0;
        Ok(Self { system, input: vector![0.0, 0.0, 0.0, 0.0, 0.0, 1.0] })
    }
}

impl Dynamics<8> {
    /// The profile goes through a low-pass of second order, whose output drives the axis.
    fn filtered(axis: &TwoInertia, corner: f64) -> Result<Self> {
        let mut system = SMatrix::zeros();
        connect(axis, 4, &mut system)?;
        let square = corner * corner;
        system[(4, 5)] = 1.0;
        system[(5, 4)] = -square;
        system[(5, 5)] = -2.0 * LOW_PASS_DAMPING * corner;
        system[(5, 6)] = square;
        system[(6, 7)] = 1.0;
        Ok(Self { system, input: vector![0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0] })
    }
}

impl<const N: usize> Dynamics<N> {
    fn over(&self, interval: f64) -> Result<Transition<N, 1>> {
        Ok(zero_order_hold(&self.system, &self.input, interval)?)
    }
}

/// Puts the axis in front, its force that of the acceleration in state `driver` on both masses.
fn connect<const N: usize>(axis: &TwoInertia, driver: usize, system: &mut SMatrix<f64, N, N>) -> Result<()> {
    let own = axis.state_space()?;
    let mass = axis.motor_inertia() + axis.load_inertia();
    for row in 0..4 {
        for column in 0..4 {
            system[(row, column)] = own.a()[(row, column)];
        }
        system[(row, driver)] = own.b()[(row, 0)] * mass;
    }
    Ok(())
}

/// Samples as they are taken.
struct Record {
    times: Vec<f64>,
    load: Vec<f64>,
}

impl Record {
    fn take<const N: usize>(&mut self, time: f64, state: &SVector<f64, N>) {
        // Two instants that are one but for rounding are one.
        if self.times.last().is_none_or(|last| time > *last) {
            self.times.push(time);
            self.load.push(state[2]);
        }
    }
}

fn driven<const N: usize>(
    dynamics: &Dynamics<N>,
    command: &Command,
    axis: &TwoInertia,
    watch: Watch,
) -> Result<Course> {
    let mode = axis.free_mode()?;
    let held = |snap: f64| vector![snap];
    let step = dynamics.over(STEP)?;
    let mut state = SVector::<f64, N>::zeros();
    let mut record = Record { times: vec![0.0], load: vec![0.0] };
    for section in &command.sections {
        let start = section.at_local(section.local_ends().0);
        (state[N - 2], state[N - 1]) = (start.acceleration, start.jerk);
        let snap = held(start.snap);
        let whole = (section.length() / STEP).floor();
        for k in 1..=whole as u32 {
            state = step.apply(&state, &snap);
            record.take(section.start + f64::from(k) * STEP, &state);
        }
        state = dynamics.over(section.length() - whole * STEP)?.apply(&state, &snap);
        record.take(section.end, &state);
    }
    (state[N - 2], state[N - 1]) = (0.0, 0.0);
    let mut now = command.end();
    while now < command.duration(SETTLED).max(watch.until) {
        now += STEP;
        state = step.apply(&state, &held(0.0));
        record.take(now, &state);
    }

    // Free from here on: the envelope says when the load is at rest, within the period before it was not.
    let left = vibration(axis, mode, &state);
    let gone = command.duration(GONE).max(now) - now;
    let free = dynamics.over(gone)?.apply(&state, &held(0.0));
    let predicted = command.left(mode) * (mode.pole().re * (now + gone - command.end())).exp();
    let disagreement = vibration(axis, mode, &free) - predicted;

    let quiet = (left / (0.99 * watch.band)).ln() / -mode.pole().re;
    if quiet > 0.0 {
        let skipped = (quiet - mode.damped_period()).max(0.0);
        let part = (quiet - skipped) / f64::from(TAIL);
        state = dynamics.over(skipped)?.apply(&state, &held(0.0));
        record.take(now + skipped, &state);
        let step = dynamics.over(part)?;
        for k in 1..=TAIL {
            state = step.apply(&state, &held(0.0));
            record.take(now + skipped + f64::from(k) * part, &state);
        }
    }
    Ok(Course { times: record.times, load: record.load, disagreement })
}

/// Amplitude of the free vibration of the load about the centre of both masses, m: `|e' - conj(p) e| / w_d`.
fn vibration<const N: usize>(axis: &TwoInertia, mode: Mode, state: &SVector<f64, N>) -> f64 {
    let share = axis.motor_inertia() / (axis.motor_inertia() + axis.load_inertia());
    let (from, speed) = (share * (state[2] - state[0]), share * (state[3] - state[1]));
    let phasor = Complex::new(speed, 0.0) - mode.pole().conj() * from;
    profiles::complex::norm(phasor) / mode.damped_angular_frequency()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studies::zero_vibration::methods::METHODS;
    use crate::studies::zero_vibration::setup::Task;
    use plants::Plant as _;
    use profiles::{Limits, Profile, SCurve, SnapLimited};

    /// The load at some instants by Runge-Kutta's method, without sections, from what a profile samples.
    fn by_runge_kutta(profile: &impl Profile, mode: Mode, times: &[f64]) -> Vec<f64> {
        let axis = axis(mode).unwrap();
        let mass = axis.motor_inertia() + axis.load_inertia();
        let step = 2e-5;
        let (mut now, mut state) = (0.0, SVector::<f64, 4>::zeros());
        let slope = |t: f64, x: &SVector<f64, 4>| {
            axis.derivative(x, &vector![mass * profile.sample(t).acceleration, 0.0])
        };
        times
            .iter()
            .map(|time| {
                let count = ((time - now) / step).ceil().max(1.0);
                let h = (time - now) / count;
                for _ in 0..count as u32 {
                    let a = slope(now, &state);
                    let b = slope(now + 0.5 * h, &(state + 0.5 * h * a));
                    let c = slope(now + 0.5 * h, &(state + 0.5 * h * b));
                    let d = slope(now + h, &(state + h * c));
                    state += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
                    now += h;
                }
                now = *time;
                state[2]
            })
            .collect()
    }

    #[test]
    fn exact_steps_are_what_small_steps_come_to() {
        let limits = Limits::new(0.5, 5.0, 200.0).and_then(|l| l.with_snap(2e4)).unwrap();
        let mode = Mode::from_hz(8.0, 0.02).unwrap();
        let watch = Watch { band: 1e-4, until: 0.5 };
        fn agree(command: &Command, profile: &impl Profile, mode: Mode, watch: Watch) {
            let course = course(command, mode, watch).unwrap();
            let close = course.times.iter().take_while(|t| **t < watch.until).count();
            let small = by_runge_kutta(profile, mode, &course.times[..close]);
            for (exact, small) in course.load.iter().zip(small) {
                // A jump of the jerk inside a step costs J h^3, a jump of the snap less.
                assert!((exact - small).abs() < 200.0 * 2e-5_f64.powi(2) * 1e-2, "{exact} {small}");
            }
        }
        let s_curve = SCurve::rest_to_rest(0.1, &limits).unwrap();
        agree(&Command::new(s_curve), &s_curve, mode, watch);
        let snap_limited = SnapLimited::rest_to_rest(0.1, &limits).unwrap();
        agree(&Command::new(snap_limited), &snap_limited, mode, watch);
    }

    #[test]
    fn the_time_of_settling_is_that_of_a_dense_record() {
        let task = Task::new(0.1, 8.0, 0.1).unwrap();
        for method in METHODS {
            let command = method.plan(&task, 1).unwrap();
            let mode = task.mode_at(0.9).unwrap();
            let settled = |until| {
                course(&command, mode, Watch { band: task.band(), until }).unwrap().settled(0.1, task.band())
            };
            let (jumped, dense) = (settled(0.0).unwrap(), settled(3.0).unwrap());
            // Both are straight lines between samples.
            assert!((jumped - dense).abs() < 1e-5, "{}: {jumped} {dense}", method.id);
        }
    }
}
