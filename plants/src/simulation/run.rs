//! The course of a simulation.

use std::collections::VecDeque;

use nalgebra::SVector;

use super::{Channel, Recording, Simulation, Task};
use crate::error::{HaltError, RecordingError, SimulationError};
use crate::signals::DisturbanceSource;
use crate::steppers::Stepper;

/// What a controller is given when it runs.
#[derive(Debug, Clone, Copy)]
pub struct ControlTick<'a, const N: usize, const M: usize> {
    /// Time, s.
    pub time: f64,
    /// Tick of the clock.
    pub tick: u64,
    /// The state of the plant; what a sensor makes of it is the controller's affair.
    pub state: &'a SVector<f64, N>,
    /// The input that acts now, without its disturbance.
    pub input: SVector<f64, M>,
    /// What the actuator realises of the controller's previous output, whether it already acts or not.
    pub realised_previous: SVector<f64, M>,
}

impl<const N: usize, const M: usize> ControlTick<'_, N, M> {
    /// Whether a task is due.
    #[must_use]
    pub fn runs(&self, task: Task) -> bool {
        task.runs_at(self.tick)
    }
}

/// What there is to record at an instant.
#[derive(Debug, Clone, Copy)]
pub struct Probe<'a, const N: usize, const M: usize> {
    /// Time, s.
    pub time: f64,
    /// Tick of the clock.
    pub tick: u64,
    /// The state of the plant.
    pub state: &'a SVector<f64, N>,
    /// The input that acts from now on, without its disturbance.
    pub input: SVector<f64, M>,
    /// The last output of the controller, before saturation and delay.
    pub command: SVector<f64, M>,
    /// The disturbance that is added to the input over the coming tick; at the end, over the last.
    pub disturbance: SVector<f64, M>,
}

/// What became of a run: a recording up to where it stopped, and why it stopped if that was before its end.
#[derive(Debug, Clone, PartialEq)]
#[must_use = "a run may have diverged"]
pub struct Outcome<const N: usize> {
    recording: Recording,
    state: SVector<f64, N>,
    halt: Option<HaltError>,
}

impl<const N: usize> Outcome<N> {
    /// The recording of a run that reached its end.
    ///
    /// # Errors
    /// Why it did not.
    pub fn completed(self) -> Result<Recording, HaltError> {
        match self.halt {
            None => Ok(self.recording),
            Some(halt) => Err(halt),
        }
    }

    /// The recording, of a run that stopped early up to there.
    #[must_use]
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// The state in which the run ended.
    #[must_use]
    pub fn state(&self) -> &SVector<f64, N> {
        &self.state
    }

    /// Why the run stopped before its end, if it did.
    #[must_use]
    pub fn halt(&self) -> Option<&HaltError> {
        self.halt.as_ref()
    }
}

impl<const M: usize> Simulation<M> {
    /// Runs the simulation from an initial state.
    ///
    /// `memory` is whatever the controller keeps between its ticks; it is handed to `controller`, which returns the
    /// input command, and to `probe`, which returns the value of every channel. The loop allocates nothing but the
    /// recording, before it starts. A run that diverges is no error here but an [`Outcome`] that says so.
    ///
    /// # Errors
    /// An initial state that is not finite, two channels of one name, or a recording beyond memory.
    pub fn run<const N: usize, const C: usize, S, H: Into<Channel>>(
        &self,
        stepper: &mut impl Stepper<N, M>,
        initial_state: SVector<f64, N>,
        memory: &mut S,
        controller: impl FnMut(&mut S, &ControlTick<'_, N, M>) -> SVector<f64, M>,
        channels: [H; C],
        probe: impl FnMut(&S, &Probe<'_, N, M>) -> [f64; C],
    ) -> Result<Outcome<N>, SimulationError> {
        if let Some(&value) = initial_state.iter().find(|x| !x.is_finite()) {
            return Err(SimulationError::Number { quantity: "an initial state", range: "finite", value });
        }
        // The points on the grid, the first at tick zero, and the end.
        let rows = (self.ticks / u64::from(self.record_every)).saturating_add(2);
        let rows = usize::try_from(rows).map_err(|_| RecordingError::Memory { rows, channels: C })?;
        let recording = Recording::new(channels, rows)?;
        let (delay, delay_fraction) = self.delay_ticks();
        let waiting = delay / u64::from(self.control_every) + 2;
        let mut course = Course {
            setup: self,
            stepper,
            state: initial_state,
            now: Instant { tick: 0, fraction: 0.0 },
            input: self.initial_input,
            realised: self.initial_input,
            command: self.initial_input,
            disturbance: SVector::zeros(),
            waiting: VecDeque::with_capacity(waiting as usize),
            delay,
            delay_fraction,
        };
        let mut recording = recording;
        let halt = course.run(memory, controller, probe, &mut recording).err();
        let state = course.state;
        Ok(Outcome { recording, state, halt })
    }
}

/// A tick and a fraction of one, in [0, 1).
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
struct Instant {
    tick: u64,
    fraction: f64,
}

struct Course<'a, const N: usize, const M: usize, T> {
    setup: &'a Simulation<M>,
    stepper: &'a mut T,
    state: SVector<f64, N>,
    now: Instant,
    input: SVector<f64, M>,
    realised: SVector<f64, M>,
    command: SVector<f64, M>,
    disturbance: SVector<f64, M>,
    // Inputs on their way, the next to act first.
    waiting: VecDeque<(Instant, SVector<f64, M>)>,
    delay: u64,
    delay_fraction: f64,
}

impl<const N: usize, const M: usize, T: Stepper<N, M>> Course<'_, N, M, T> {
    fn run<const C: usize, S>(
        &mut self,
        memory: &mut S,
        mut controller: impl FnMut(&mut S, &ControlTick<'_, N, M>) -> SVector<f64, M>,
        mut probe: impl FnMut(&S, &Probe<'_, N, M>) -> [f64; C],
        recording: &mut Recording,
    ) -> Result<(), HaltError> {
        let setup = self.setup;
        let end = setup.ticks;
        let (control_every, record_every) = (u64::from(setup.control_every), u64::from(setup.record_every));
        let (mut next_control, mut next_record) = (0_u64, 0_u64);
        let disturbed = setup.disturbances.iter().any(|d| !d.is_none());
        let mut sources: [DisturbanceSource; M] = setup.disturbances.map(|d| d.source());
        let mut tick = 0;
        loop {
            let time = setup.clock.time(tick);
            self.act_before(Instant { tick, fraction: f64::MIN_POSITIVE })?;
            if tick == next_control && tick < end {
                next_control = next_control.saturating_add(control_every);
                let command = controller(
                    memory,
                    &ControlTick {
                        time,
                        tick,
                        state: &self.state,
                        input: self.input,
                        realised_previous: self.realised,
                    },
                );
                self.take(command, time)?;
            }
            if disturbed && tick < end {
                let middle = setup.clock.middle(tick);
                for (value, source) in self.disturbance.iter_mut().zip(sources.iter_mut()) {
                    *value = source.value(middle);
                }
            }
            if tick == next_record || tick == end {
                next_record = next_record.saturating_add(record_every);
                let values = probe(
                    memory,
                    &Probe {
                        time,
                        tick,
                        state: &self.state,
                        input: self.input,
                        command: self.command,
                        disturbance: self.disturbance,
                    },
                );
                // The row has as many values as there are channels, by its type.
                let _ = recording.push(time, values);
            }
            if tick == end {
                return Ok(());
            }
            let next = if disturbed { tick + 1 } else { next_control.min(next_record).min(end) };
            let next_instant = Instant { tick: next, fraction: 0.0 };
            self.act_before(next_instant)?;
            self.advance(next_instant)?;
            tick = next;
        }
    }

    /// Takes an output of the controller on its way to the plant.
    fn take(&mut self, command: SVector<f64, M>, time: f64) -> Result<(), HaltError> {
        if let Some((component, &value)) = command.iter().enumerate().find(|(_, x)| !x.is_finite()) {
            return Err(HaltError::Command { time, component, value });
        }
        self.command = command;
        self.realised = self.setup.saturation.apply(&command);
        if self.delay == 0 && self.delay_fraction <= 0.0 {
            self.input = self.realised;
        } else {
            let due =
                Instant { tick: self.now.tick.saturating_add(self.delay), fraction: self.delay_fraction };
            self.waiting.push_back((due, self.realised));
        }
        Ok(())
    }

    /// Lets every input due before `until` act, moving the plant up to it.
    fn act_before(&mut self, until: Instant) -> Result<(), HaltError> {
        while let Some(&(due, input)) = self.waiting.front() {
            if due >= until {
                break;
            }
            self.waiting.pop_front();
            self.advance(due)?;
            self.input = input;
        }
        Ok(())
    }

    /// Moves the plant to an instant.
    #[inline]
    fn advance(&mut self, to: Instant) -> Result<(), HaltError> {
        let clock = &self.setup.clock;
        let ticks = to.tick - self.now.tick;
        // Lengths depend on differences only, so that those that come again have the same bits.
        let split = to.fraction - self.now.fraction;
        let interval =
            if split.abs() > 0.0 { (ticks as f64 + split) * clock.period() } else { clock.time(ticks) };
        if interval <= 0.0 {
            return Ok(());
        }
        let input = self.input + self.disturbance;
        self.state = self
            .stepper
            .advance(&self.state, &input, interval)
            .map_err(|source| HaltError::Step { time: self.time(self.now), source })?;
        self.now = to;
        let bound = self.setup.bound;
        // Infinity and NaN fail the comparison, whatever the bound.
        let within = |x: f64| x.abs() <= bound && x.is_finite();
        match self.state.iter().position(|&x| !within(x)) {
            None => Ok(()),
            Some(component) => {
                let (time, value) = (self.time(to), self.state[component]);
                Err(HaltError::Diverged { time, component, value, bound })
            }
        }
    }

    fn time(&self, instant: Instant) -> f64 {
        self.setup.clock.time(instant.tick) + instant.fraction * self.setup.clock.period()
    }
}
