//! From a reduced curve to pulses, and from pulses to the motion of a mechanism.

use std::array::from_fn;
use std::f64::consts::TAU;

use anyhow::Result;
use control::{
    AxisModel, CrossCoupling, DisturbanceInput, DisturbanceObserver, DisturbanceObserverState, PathFrame,
    ReachingLaw, SlidingMode, SlidingModeInput, SlidingModeState, SlidingSurface,
};
use plants::nalgebra::SVector;
use plants::{
    BallScrewAxis, CartesianRobot, Channel, Clock, ControlTick, Encoder, Friction, Probe, Simulation,
};
use profiles::nurbs::{CoordinateList, FeedInterpolator, FeedLimits, FeedReport, FeedSample, NurbsCurve};
use profiles::{Limits, Profile, PulseTrain};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// Feed along the curve, m/s.
pub(super) const FEED: f64 = 0.25;
/// Velocity, acceleration and jerk of every axis, m/s, m/s^2 and m/s^3.
pub(super) const AXIS: [f64; 3] = [0.25, 3.0, 150.0];
/// Chord error, m.
pub(super) const CHORD: f64 = 0.2e-6;
/// Period of the controller, s.
const PERIOD: f64 = 1e-3;
/// A pulse, m.
pub(super) const PULSE: f64 = 1e-6;

// The drives: ball screws, each with the observer and the linear surface that cross-coupling finds best.
/// Lead of the screws, m.
const LEAD: f64 = 0.01;
/// Damping in 1/s and gain in rad/s^2 per N m.
const SCREW: (f64, f64) = (10.0, 1.0);
/// Dry friction: sliding, and break-away with its speed in rad/s, N m.
const FRICTION: (f64, f64, f64) = (2.0, 3.0, 0.5);
/// Rate of the drives, Hz.
const RATE: u64 = 10_000;
/// One count of their encoders, rad: 20 bits a turn.
const COUNT: f64 = TAU / 1_048_576.0;
/// Slope of the surface, 1/s, bandwidth of the observer, rad/s, gain of the coupling.
const LAW: (f64, f64, f64) = (100.0, 300.0, 1.0);
/// What the drives are given after the end of the path, s.
const REST: f64 = 0.1;

/// A path after its interpolation.
pub(super) struct Interpolated<const D: usize> {
    /// The motion at every period of the controller.
    pub(super) samples: Vec<FeedSample<D>>,
    /// What it reaches of its limits.
    pub(super) report: FeedReport<D>,
    /// The list for the drives.
    pub(super) list: CoordinateList<D>,
}

/// Interpolates a curve.
pub(super) fn interpolate<const D: usize>(curve: &NurbsCurve<D>) -> Result<Interpolated<D>> {
    let [velocity, acceleration, jerk] = AXIS;
    let limits = FeedLimits::new(FEED, [Limits::new(velocity, acceleration, jerk)?; D], PERIOD)?;
    let motion = FeedInterpolator::new(curve.clone(), limits.with_chord_error(CHORD)?)?;
    Ok(Interpolated {
        samples: motion.ticks()?.collect(),
        report: motion.report()?,
        list: motion.coordinates()?,
    })
}

/// Pulses of every axis by the ticks of the drives, from the start.
fn pulses<const D: usize>(list: &CoordinateList<D>) -> Result<[Vec<i64>; D]> {
    let mut counted: [Vec<i64>; D] = from_fn(|_| Vec::new());
    for (axis, counted) in list.axes().into_iter().zip(&mut counted) {
        let train = PulseTrain::new(axis, PULSE)?;
        let mut sum = 0;
        counted.push(0);
        for count in train.counts(1.0 / RATE as f64)? {
            sum += i64::from(count);
            counted.push(sum);
        }
    }
    Ok(counted)
}

/// What the drives make of a list.
pub(super) struct Driven {
    /// The farthest that pulses are from their coordinate, m.
    pub(super) pulse_error: f64,
    /// Time in s and distance of the mechanism from the curve in m.
    pub(super) contour: Vec<(f64, f64)>,
    /// Time in s and the farthest that an axis is from its coordinate, m.
    pub(super) tracking: Vec<(f64, f64)>,
}

impl Driven {
    /// The largest distance from the curve, m.
    pub(super) fn largest(&self) -> f64 {
        self.contour.iter().map(|point| point.1).fold(0.0, f64::max)
    }
}

#[derive(Clone, Copy)]
struct Drive {
    sliding: SlidingModeState,
    observer: DisturbanceObserverState,
}

fn rows<const D: usize, const STATES: usize>(
    list: &CoordinateList<D>,
    curve: &NurbsCurve<D>,
) -> Result<Driven> {
    let period = 1.0 / RATE as f64;
    let (damping, gain) = SCREW;
    let (slope, bandwidth, coupling) = LAW;
    let model = AxisModel::new(damping, 0.0, gain)?;
    let law = SlidingMode::new(
        SlidingSurface::linear(slope)?,
        ReachingLaw::exponential(slope, 0.0)?,
        model,
        period,
    )?;
    let observer = DisturbanceObserver::new(model, bandwidth, period)?;
    let coupling = CrossCoupling::uniform(coupling)?;
    let encoder = Encoder::new(COUNT)?;
    let (sliding, breakaway, speed) = FRICTION;
    let friction = Friction::coulomb(sliding)?.with_stribeck(breakaway, speed, 2.0)?;
    let screw = BallScrewAxis::from_coefficients(damping, 0.0, gain)?;
    let robot = CartesianRobot::new([screw; D]).with_friction([friction; D])?;

    let counted = pulses(list)?;
    let axes = list.axes();
    let start = list.points().first().copied().unwrap_or([0.0; D]);
    let per_metre = TAU / LEAD;
    let pulse_error = counted.iter().zip(&axes).flat_map(|(counted, axis)| {
        let at = move |(tick, pulses): (usize, &i64)| {
            (*pulses as f64 * PULSE - axis.sample(tick as f64 * period).position).abs()
        };
        counted.iter().enumerate().map(at)
    });
    let pulse_error = pulse_error.fold(0.0, f64::max);
    let at = |counted: &[i64], tick: usize| counted.get(tick).or(counted.last()).copied().unwrap_or(0);

    let clock = Clock::from_frequency(RATE)?;
    let duration = axes.first().map_or(0.0, Profile::duration);
    let every = (PERIOD * RATE as f64).round() as u32;
    let simulation =
        Simulation::new(clock, clock.ticks(((duration + REST) * 1e3).ceil() * 1e-3)?).record_every(every)?;
    let controller = |memory: &mut [Drive; D], tick: &ControlTick<'_, STATES, STATES>| {
        let angles = robot.angles(tick.state);
        let motion = axes.map(|axis| axis.sample(tick.time));
        let mut inputs = [SlidingModeInput::default(); D];
        for (axis, (input, drive)) in inputs.iter_mut().zip(memory.iter_mut()).enumerate() {
            let seen = DisturbanceInput {
                position: encoder.quantise(angles[axis]),
                realised: drive.sliding.output(),
            };
            let estimate = observer.update(&mut drive.observer, seen);
            // The position comes as pulses, its rates as the list has them.
            let wanted = profiles::Sample {
                position: per_metre * PULSE * at(&counted[axis], tick.tick as usize) as f64,
                velocity: per_metre * motion[axis].velocity,
                acceleration: per_metre * motion[axis].acceleration,
                ..profiles::Sample::default()
            };
            *input = SlidingModeInput {
                load: estimate.load,
                ..SlidingModeInput::new(&wanted, estimate.position, estimate.velocity)
            };
        }
        let path = PathFrame::along(motion.map(|sample| sample.velocity)).unwrap_or(None);
        let coupled = coupling.couple(inputs.map(|i| i.error), inputs.map(|i| i.error_rate), path.as_ref());
        SVector::from_fn(|axis, _| {
            memory.get_mut(axis).map_or(0.0, |drive| {
                let input = inputs[axis].with_error(coupled.errors[axis], coupled.rates[axis]);
                law.update(&mut drive.sliding, input).output
            })
        })
    };
    let channels: [Channel; D] = from_fn(|axis| Channel::new(format!("angle {axis}"), "rad"));
    let fresh = Drive { sliding: SlidingModeState::new(), observer: DisturbanceObserverState::new() };
    let recording = simulation
        .run(
            &mut robot.stepper(),
            SVector::zeros(),
            &mut [fresh; D],
            controller,
            channels,
            |_, probe: &Probe<'_, STATES, STATES>| robot.angles(probe.state).into(),
        )?
        .completed()?;
    let columns: Vec<&[f64]> =
        (0..D).map(|axis| Ok(recording.column(&format!("angle {axis}"))?)).collect::<Result<_>>()?;
    let (mut contour, mut tracking) = (Vec::new(), Vec::new());
    for (row, time) in recording.time().iter().enumerate() {
        let way: [f64; D] = from_fn(|axis| columns[axis][row] / per_metre);
        let off = way.iter().zip(&axes).map(|(way, axis)| (way - axis.sample(*time).position).abs());
        tracking.push((*time, off.fold(0.0, f64::max)));
        contour.push((*time, curve.closest(from_fn(|axis| start[axis] + way[axis]))?.distance));
    }
    Ok(Driven { pulse_error, contour, tracking })
}

/// Two axes along a planar curve.
pub(super) fn drive_planar(list: &CoordinateList<2>, curve: &NurbsCurve<2>) -> Result<Driven> {
    rows::<2, 4>(list, curve)
}

/// Three axes along a curve in space.
pub(super) fn drive_spatial(list: &CoordinateList<3>, curve: &NurbsCurve<3>) -> Result<Driven> {
    rows::<3, 6>(list, curve)
}
