//! The axis of figures 8 and 9: a drive that is given pulses, one at a time.

use anyhow::{Context as _, Result};
use identify::Signal;
use plants::nalgebra::{self, SVector, matrix, vector};
use plants::{Clock, Encoder, Simulation, StateSpace, ZeroOrderHold};
use profiles::{Direction, Limits, Mode, PulseTrain, Sectioned, Trapezoid};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

// Section 4.2 of the paper.
/// Length of the move, pulses.
pub(super) const PULSES: f64 = 4000.0;
/// Start and stop frequency, Hz.
const START: f64 = 10e3;
/// Highest frequency, Hz.
const HIGHEST: f64 = 300e3;
/// Acceleration, Hz/s.
const ACCELERATION: f64 = 10e6;
/// Delay between the impulses of the filter, s.
pub(super) const DELAY: f64 = 0.020;

// Not printed.
/// Pulses of one revolution, for the speed in r/min: a common setting of the drive's gear.
const REVOLUTION: f64 = 10_000.0;
/// Rate of the timer that sends the pulses, Hz.
const TIMER: u64 = 10_000_000;
/// How long the axis is looked at, s.
const HORIZON: f64 = 0.4;
/// Ticks of the timer from one record to the next: 10 kHz.
const RECORD: u32 = 1000;

/// The mode behind the printed amplitudes, whose printed numbers contradict each other: 117 rad/s and a damping ratio of
/// 0.2123 in the decay, 104.8 rad/s in the oscillation.
pub(super) fn mode() -> Result<Mode> {
    let (decay, oscillation): (f64, f64) = (0.2123 * 117.0, 104.8);
    let frequency = decay.hypot(oscillation);
    Ok(Mode::new(frequency, decay / frequency)?)
}

/// The move before any filter, in pulses.
pub(super) fn command() -> Result<Trapezoid> {
    let limits = Limits::new(HIGHEST, ACCELERATION, f64::INFINITY)?;
    Ok(Trapezoid::with_speeds(PULSES, START, START, &limits)?)
}

/// What the axis did.
pub(super) struct Course {
    pub(super) time: Vec<f64>,
    /// Pulses sent.
    pub(super) sent: Vec<f64>,
    /// Position, pulses.
    pub(super) position: Vec<f64>,
    /// Speed of the motor, r/min.
    pub(super) speed: Vec<f64>,
}

impl Course {
    pub(super) fn points(&self, values: &[f64]) -> Vec<(f64, f64)> {
        self.time.iter().copied().zip(values.iter().copied()).collect()
    }

    fn after<'a>(&'a self, values: &'a [f64], instant: f64) -> impl Iterator<Item = f64> + 'a {
        self.time.iter().zip(values).filter(move |(t, _)| **t >= instant).map(|(_, value)| *value)
    }

    /// The largest distance from the target that an encoder of one pulse shows from `instant` in s on, pulses.
    pub(super) fn residual(&self, instant: f64) -> Result<f64> {
        let encoder = Encoder::new(1.0)?;
        let errors = self.after(&self.position, instant).map(|p| (encoder.quantise(p) - PULSES).abs());
        Ok(errors.fold(0.0, f64::max))
    }

    /// The largest speed from `instant` in s on, r/min.
    pub(super) fn ripple(&self, instant: f64) -> f64 {
        self.after(&self.speed, instant).map(f64::abs).fold(0.0, f64::max)
    }

    /// When the axis stays within `pulses` of the target, s.
    pub(super) fn settling(&self, pulses: f64) -> Result<f64> {
        Ok(Signal::new(&self.time, &self.position)?.settling_time(PULSES, pulses)?)
    }
}

/// Sends `profile` pulse by pulse to the axis, whose drive may have a low-pass filter of this time constant in s.
pub(super) fn run<P: Sectioned>(profile: P, low_pass: Option<f64>) -> Result<Course> {
    let train = PulseTrain::new(profile, 1.0)?.with_shortest_interval(1.0 / HIGHEST)?;
    let mode = mode()?;
    let (stiffness, damping) =
        (mode.angular_frequency().powi(2), 2.0 * mode.damping_ratio() * mode.angular_frequency());
    match low_pass {
        None => {
            let axis = StateSpace::new(
                matrix![0.0, 1.0; -stiffness, -damping],
                matrix![0.0; stiffness],
                matrix![1.0, 0.0],
                matrix![0.0],
            )?;
            follow(&train, axis, |x| [x[0], x[1]])
        }
        Some(tau) => {
            let axis = StateSpace::new(
                matrix![0.0, 1.0, 0.0; -stiffness, -damping, stiffness; 0.0, 0.0, -1.0 / tau],
                matrix![0.0; 0.0; 1.0 / tau],
                matrix![1.0, 0.0, 0.0],
                matrix![0.0],
            )?;
            follow(&train, axis, |x| [x[0], x[1]])
        }
    }
}

fn follow<P: Sectioned, const N: usize>(
    train: &PulseTrain<P>,
    axis: StateSpace<N, 1, 1>,
    motion: impl Fn(&SVector<f64, N>) -> [f64; 2],
) -> Result<Course> {
    let clock = Clock::from_frequency(TIMER)?;
    let simulation = Simulation::new(clock, clock.ticks(HORIZON)?).record_every(RECORD)?;
    let mut periods = train.periods(TIMER as f64)?;
    let mut next = periods.next();
    let mut due = next.map_or(0, |period| period.ticks);
    let outcome = simulation.run(
        &mut ZeroOrderHold::new(axis),
        SVector::zeros(),
        &mut 0_i64,
        |sent, tick| {
            while let Some(period) = next.filter(|_| due <= tick.tick) {
                *sent += if period.direction == Direction::Forward { 1 } else { -1 };
                next = periods.next();
                due += next.map_or(0, |period| period.ticks);
            }
            vector![*sent as f64]
        },
        [("sent", ""), ("position", ""), ("speed", "r/min")],
        |_, probe| {
            let [position, velocity] = motion(probe.state);
            [probe.input[0], position, 60.0 * velocity / REVOLUTION]
        },
    )?;
    let recording = outcome.completed().context("the axis")?;
    let column = |name| recording.column(name).map(<[f64]>::to_vec);
    Ok(Course {
        time: recording.time().to_vec(),
        sent: column("sent")?,
        position: column("position")?,
        speed: column("speed")?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use profiles::{Profile, residual_vibration};

    /// Pulses are the move but for half a pulse: the axis goes on as the response of its mode says.
    #[test]
    fn what_the_pulses_leave_is_what_the_profile_leaves() {
        let command = command().expect("command");
        let course = run(command, None).expect("course");
        let mode = mode().expect("mode");
        // The relative motion of the mode about the command; half a pulse all along the way at most adds this.
        let predicted = residual_vibration(&command, mode);
        let end = command.duration();
        let decay = |t: f64| (-mode.damping_ratio() * mode.angular_frequency() * (t - end)).exp();
        let envelope = course
            .time
            .iter()
            .zip(&course.position)
            .filter(|(t, _)| **t > end && **t < end + mode.damped_period())
            .map(|(t, p)| (p - PULSES).abs() / decay(*t))
            .fold(0.0, f64::max);
        assert!((envelope / predicted - 1.0).abs() < 0.01, "{envelope} and {predicted}");
    }
}
