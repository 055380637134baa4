//! The robot under a law: what is run, and what is read off it.

use std::array::from_fn;

use anyhow::Result;
use control::{CommandedPath, ContourError, CrossCoupling};
use identify::Signal;
use plants::nalgebra::SVector;
use plants::{
    BallScrewAxis, CartesianRobot, Channel, Clock, ControlTick, Disturbance, Encoder, HeldLinear, LowPass,
    Probe, Simulation, Transition,
};
use profiles::Interval;

use super::laws::{Axis, Law, Told};
use super::setup::{AXIS, HORIZON, LOAD, RATE, VELOCITY_FILTER, helix};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// What is run: the first `N` axes of the helix.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case<const N: usize> {
    pub(super) law: Law,
    /// Where the axes start, at rest, rad.
    pub(super) start: [f64; N],
    /// Whether the load comes.
    pub(super) loaded: bool,
    /// The gain of the coupling.
    pub(super) coupling: f64,
    /// Control period in ticks of the base rate.
    pub(super) every: u32,
    /// One count of the encoder in rad; none where the controller sees the state.
    pub(super) count: Option<f64>,
}

/// What a controller sees of an axis through an encoder: the counts, and a velocity made from them.
#[derive(Clone, Copy, Debug)]
struct Counted {
    encoder: Encoder,
    filter: Transition<1, 1>,
    period: f64,
    before: Option<f64>,
    velocity: SVector<f64, 1>,
}

impl Counted {
    fn see(&mut self, angle: f64) -> (f64, f64) {
        let now = self.encoder.quantise(angle);
        let rate = (now - self.before.replace(now).unwrap_or(now)) / self.period;
        self.velocity = self.filter.apply(&self.velocity, &SVector::from([rate]));
        (now, self.velocity[0])
    }
}

/// What the controller keeps between its ticks.
struct Memory<const N: usize> {
    axes: [Axis; N],
    counted: Option<[Counted; N]>,
    path: CommandedPath<N>,
}

impl<const N: usize> Case<N> {
    /// From a start, at the base rate, with the state known, unloaded and uncoupled.
    pub(super) fn new(law: Law, start: [f64; N]) -> Self {
        Self { law, start, loaded: false, coupling: 0.0, every: 1, count: None }
    }

    fn memory(&self, period: f64) -> Result<Memory<N>> {
        let counted = match self.count {
            None => None,
            Some(count) => {
                let (encoder, velocity) = (Encoder::new(count)?, SVector::zeros());
                let filter = LowPass::new(VELOCITY_FILTER)?.transition(period)?;
                Some([Counted { encoder, filter, period, before: None, velocity }; N])
            }
        };
        Ok(Memory { axes: [self.law.axis(period)?; N], counted, path: CommandedPath::new() })
    }

    /// Runs it; `STATES` are two to an axis.
    fn course<const STATES: usize>(&self) -> Result<Course<N>> {
        let [a, b, k] = AXIS;
        let robot = CartesianRobot::new([BallScrewAxis::from_coefficients(a, b, k)?; N]);
        let clock = Clock::from_frequency(RATE)?;
        let mut loads = [Disturbance::none(); STATES];
        if self.loaded {
            loads[N] = Disturbance::step(LOAD.1, LOAD.0)?;
        }
        let simulation =
            Simulation::new(clock, clock.ticks(HORIZON)?).control_every(self.every)?.disturbances(loads);
        let coupling = CrossCoupling::uniform(self.coupling)?;
        let controller = |memory: &mut Memory<N>, tick: &ControlTick<'_, STATES, STATES>| {
            let references: [_; N] = wanted(tick.time);
            let (angles, speeds) = (robot.angles(tick.state), robot.speeds(tick.state));
            let mut seen: [_; N] = match &mut memory.counted {
                None => from_fn(|i| (angles[i], speeds[i])),
                Some(counted) => from_fn(|i| counted[i].see(angles[i])),
            };
            seen.iter_mut().zip(&mut memory.axes).for_each(|(seen, axis)| *seen = axis.observe(*seen));
            let path = memory.path.update(references.map(|r| r.position));
            let errors = from_fn(|i| references[i].position - seen[i].0);
            let rates = from_fn(|i| references[i].velocity - seen[i].1);
            let coupled = coupling.couple(errors, rates, path.as_ref());
            SVector::from_fn(|i, _| {
                memory.axes.get_mut(i).map_or(0.0, |axis| {
                    axis.update(&Told {
                        reference: references[i],
                        position: seen[i].0,
                        velocity: seen[i].1,
                        error: coupled.errors[i],
                        error_rate: coupled.rates[i],
                    })
                })
            })
        };
        let mut state = SVector::zeros();
        self.start.iter().enumerate().for_each(|(i, start)| state[i] = *start);
        let channels: [_; STATES] = from_fn(|i| {
            Channel::new(if i < N { format!("angle {i}") } else { format!("torque {}", i - N) }, "")
        });
        let outcome = simulation.run(
            &mut robot.stepper(),
            state,
            &mut self.memory(simulation.control_period())?,
            controller,
            channels,
            |_, probe: &Probe<'_, STATES, STATES>| {
                from_fn(|i| if i < N { probe.state[i] } else { probe.input[i - N] })
            },
        )?;
        let recording = outcome.completed()?;
        let columns = |what: &str| -> Result<Vec<Vec<f64>>> {
            (0..N).map(|i| Ok(recording.column(&format!("{what} {i}"))?.to_vec())).collect()
        };
        Ok(Course { period: clock.period(), angles: columns("angle")?, torques: columns("torque")? })
    }
}

impl Case<1> {
    pub(super) fn run(&self) -> Result<Course<1>> {
        self.course::<2>()
    }
}

impl Case<3> {
    pub(super) fn run(&self) -> Result<Course<3>> {
        self.course::<6>()
    }
}

fn wanted<const N: usize>(time: f64) -> [profiles::Sample; N] {
    let helix = helix(time);
    from_fn(|i| helix[i])
}

/// The course of a run.
pub(super) struct Course<const N: usize> {
    period: f64,
    angles: Vec<Vec<f64>>,
    torques: Vec<Vec<f64>>,
}

impl<const N: usize> Course<N> {
    pub(super) fn time(&self, k: usize) -> f64 {
        k as f64 * self.period
    }

    pub(super) fn reference(&self, axis: usize, k: usize) -> f64 {
        wanted::<N>(self.time(k))[axis].position
    }

    pub(super) fn position(&self, axis: usize, k: usize) -> f64 {
        self.angles[axis][k]
    }

    pub(super) fn error(&self, axis: usize, k: usize) -> f64 {
        self.reference(axis, k) - self.position(axis, k)
    }

    pub(super) fn torque(&self, axis: usize, k: usize) -> f64 {
        self.torques[axis][k]
    }

    /// A value as points of a figure, between two instants in s: the least and the greatest of every stretch, so that a
    /// torque that switches shows how far.
    pub(super) fn points(&self, from: f64, to: f64, value: impl Fn(usize) -> f64) -> Vec<(f64, f64)> {
        let index = |t: f64| ((t / self.period).round() as usize).min(self.angles[0].len() - 1);
        let samples: Vec<_> = (index(from)..=index(to)).map(|k| (self.time(k), value(k))).collect();
        let stretches = samples.chunks(samples.len().div_ceil(1500).max(1));
        let ends = stretches.flat_map(|stretch| {
            let order = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
            let ends = stretch.iter().min_by(order).zip(stretch.iter().max_by(order));
            ends.map(
                |(least, greatest)| {
                    if least.0 <= greatest.0 { [*least, *greatest] } else { [*greatest, *least] }
                },
            )
        });
        ends.flatten().collect()
    }

    /// The samples that a path is drawn through.
    pub(super) fn shown(&self) -> impl Iterator<Item = usize> {
        (0..self.angles[0].len()).step_by(100)
    }

    /// The way from the robot to the path, rad: to the osculating circle, which a helix leaves with the third power of
    /// the lag.
    pub(super) fn contour(&self, k: usize) -> [f64; N] {
        let references: [_; N] = wanted(self.time(k));
        let error = from_fn(|axis| self.error(axis, k));
        let (velocity, acceleration) = (references.map(|r| r.velocity), references.map(|r| r.acceleration));
        ContourError::from_circle(error, velocity, acceleration).map_or(error, |contour| contour.vector())
    }

    /// `integral of t e^2` over the run, rad^2 s^2.
    pub(super) fn itse(&self, axis: usize) -> Result<f64> {
        self.time_square(HORIZON, |k| self.error(axis, k))
    }

    /// The part of it from the load on.
    pub(super) fn robustness(&self, axis: usize) -> Result<f64> {
        Ok(self.itse(axis)? - self.time_square(LOAD.1, |k| self.error(axis, k))?)
    }

    /// The same of the distance to the path.
    pub(super) fn contour_itse(&self) -> Result<f64> {
        self.time_square(HORIZON, |k| self.contour(k).iter().map(|e| e * e).sum::<f64>().sqrt())
    }

    fn time_square(&self, end: f64, value: impl Fn(usize) -> f64) -> Result<f64> {
        let values: Vec<f64> = (0..self.angles[0].len()).map(value).collect();
        let signal = Signal::sampled(&values, self.period)?;
        Ok(signal.integral_time_square_error(Some(Interval { lower: 0.0, upper: end }))?)
    }

    /// Total variation of a torque from the load to the end, N m/s.
    pub(super) fn chatter(&self, axis: usize) -> Result<f64> {
        let window = Interval { lower: LOAD.1, upper: HORIZON };
        Ok(Signal::sampled(&self.torques[axis], self.period)?.total_variation_rate(Some(window))?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::papers::cross_coupling::setup::START;

    /// Without coupling the robot is three single axes, to the bit.
    #[test]
    fn uncoupled_axes_do_not_know_each_other() {
        for law in [Law::Pid, Law::Dsmc, Law::Traditional] {
            let robot = Case { loaded: true, ..Case::new(law, START) }.run().expect("runs");
            let alone = Case { loaded: true, ..Case::new(law, [START[0]]) }.run().expect("runs");
            assert!(robot.angles[0].iter().zip(&alone.angles[0]).all(|(a, b)| a.to_bits() == b.to_bits()));
            assert!(robot.torques[0].iter().zip(&alone.torques[0]).all(|(a, b)| a.to_bits() == b.to_bits()));
        }
    }

    /// A picture of a torque that switches at every sample keeps its width.
    #[test]
    fn stretches_keep_their_extremes() {
        let angles = vec![vec![0.0; 100_001]];
        let torques = vec![(0..=100_000).map(|k| if k % 2 == 0 { 3.0 } else { -2.0 }).collect()];
        let course = Course::<1> { period: 1e-4, angles, torques };
        let points = course.points(1.0, 9.0, |k| course.torque(0, k));
        assert!(points.len() <= 3000, "{}", points.len());
        assert!(points.windows(2).all(|pair| pair[0].0 <= pair[1].0));
        for wanted in [3.0, -2.0] {
            let there = points.iter().filter(|point| (point.1 - wanted).abs() < 1e-12).count();
            assert!(2 * there == points.len(), "{there} of {}", points.len());
        }
    }
}
