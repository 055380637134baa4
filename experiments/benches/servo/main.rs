//! One tick of 100 us of a servo, controller included: a synchronous motor on a load behind a spring under field-oriented
//! control. Beside it the same written by hand, and the same with an adaptive solver of another library.
#![expect(clippy::expect_used, reason = "a bench without its servo may fail loudly")]

mod by_hand;
mod exact;

use std::f64::consts::PI;
use std::hint::black_box;

use control::{
    Cascade, CurrentLoop, Dq, Feedforward, FieldOriented, FieldOrientedInput, FieldOrientedState, PiGains,
    Windings,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use numeris::Vector;
use numeris::ode::{AdaptiveSettings, RKAdaptive, RKTS54};
use plants::nalgebra::{self, SVector, vector};
use plants::{Clock, ControlTick, PmsmDrive, PmsmWindings, Rk4, Simulation, StepError, Stepper, TwoInertia};
use profiles::Sample;

use by_hand::ByHand;

const PERIOD: f64 = 1e-4; // s
const TICKS: u32 = 10_000;

const RESISTANCE: f64 = 2.875; // ohm
const INDUCTANCE: f64 = 8.5e-3; // H
const FLUX: f64 = 0.175; // Wb
const POLE_PAIRS: u32 = 3;
const ROTOR: f64 = 0.003; // kg m^2
const LOAD: f64 = 5.066e-4; // kg m^2
const STIFFNESS: f64 = 100.0; // N m/rad
const FRICTION: f64 = 0.008; // N m s/rad
const SPRING_DAMPING: f64 = 0.006; // N m s/rad
const BANDWIDTH: f64 = 1970.0; // rad/s
const POSITION_GAIN: f64 = 180.0; // 1/s
const PER_RPM: f64 = 30.0 / PI; // r/min in a rad/s
const VELOCITY_GAIN: f64 = 0.24 * PER_RPM; // A s/rad
const VELOCITY_INTEGRAL: f64 = 3.45 * PER_RPM; // A/rad
const TORQUE_CONSTANT: f64 = 1.5 * POLE_PAIRS as f64 * FLUX; // N m/A
const ACCELERATION_GAIN: f64 = (ROTOR + LOAD) / TORQUE_CONSTANT; // A s^2/rad
const CURRENT_LIMIT: f64 = 20.0; // A
const VOLTAGE_LIMIT: f64 = 180.0; // V

/// A swing of two radians that no limit cuts.
fn references() -> Vec<Sample> {
    let swing = |k: u32| {
        let (w, t) = (20.0, f64::from(k) * PERIOD);
        Sample {
            position: 1.0 - (w * t).cos(),
            velocity: w * (w * t).sin(),
            acceleration: w * w * (w * t).cos(),
            ..Sample::default()
        }
    };
    (0..TICKS).map(swing).collect()
}

fn axis() -> TwoInertia {
    TwoInertia::new(ROTOR, LOAD, STIFFNESS)
        .and_then(|axis| axis.with_damping(FRICTION, SPRING_DAMPING, 0.0))
        .expect("valid")
}

fn drive() -> PmsmDrive {
    let windings = PmsmWindings::surface(RESISTANCE, INDUCTANCE, FLUX, POLE_PAIRS)
        .and_then(|windings| windings.with_voltage_limit(VOLTAGE_LIMIT))
        .expect("valid");
    PmsmDrive::new(windings, axis())
}

fn control() -> FieldOriented {
    let (r, l) = (RESISTANCE, INDUCTANCE);
    let windings = Windings { resistance: r, d_inductance: l, q_inductance: l, flux: FLUX };
    let current_loop = CurrentLoop::tuned(windings, BANDWIDTH, PERIOD)
        .and_then(|current_loop| current_loop.with_voltage_limit(VOLTAGE_LIMIT))
        .expect("valid");
    let feedforward = Feedforward::NONE.with_acceleration(ACCELERATION_GAIN).expect("valid");
    let cascade = Cascade::new(POSITION_GAIN, PiGains { kp: VELOCITY_GAIN, ki: VELOCITY_INTEGRAL }, PERIOD)
        .and_then(|cascade| cascade.with_velocity_feedforward(1.0))
        .and_then(|cascade| cascade.with_current_limit(CURRENT_LIMIT))
        .expect("valid")
        .with_feedforward(feedforward);
    FieldOriented::new(cascade, current_loop, POLE_PAIRS).expect("valid")
}

/// A servo of these crates.
#[derive(Clone)]
struct Ours {
    control: FieldOriented,
    memory: FieldOrientedState,
    stepper: Rk4<PmsmDrive>,
    state: SVector<f64, 6>,
}

/// What the control makes of a state: voltages, and no load torque.
#[inline(always)]
fn command(
    control: &FieldOriented,
    memory: &mut FieldOrientedState,
    reference: &Sample,
    state: &SVector<f64, 6>,
) -> SVector<f64, 3> {
    let current = Dq { d: state[0], q: state[1] };
    let voltage =
        control.update(memory, FieldOrientedInput::new(*reference, state[2], state[3], current)).voltage;
    vector![voltage.d, voltage.q, 0.0]
}

impl Ours {
    fn new() -> Self {
        // The fastest poles are those of the spring, 480 rad/s.
        let stepper = Rk4::fixed(drive(), 1, 500.0).expect("valid");
        Self { control: control(), memory: FieldOrientedState::new(), stepper, state: SVector::zeros() }
    }

    #[inline(always)]
    fn tick(&mut self, reference: &Sample) -> Result<(), StepError> {
        let input = command(&self.control, &mut self.memory, reference, &self.state);
        self.state = self.stepper.advance(&self.state, &input, PERIOD)?;
        Ok(())
    }
}

/// Our control, and a plant by hand under an adaptive solver of order 5 at 1e-6.
#[derive(Clone)]
struct Adaptive {
    control: FieldOriented,
    memory: FieldOrientedState,
    plant: ByHand,
    settings: AdaptiveSettings<f64>,
    state: SVector<f64, 6>,
}

impl Adaptive {
    /// The first step as the solver finds it, or the whole tick.
    fn new(initial_step: Option<f64>) -> Self {
        let settings =
            AdaptiveSettings { abs_tol: 1e-6, rel_tol: 1e-6, initial_step, ..AdaptiveSettings::default() };
        let (memory, state) = (FieldOrientedState::new(), SVector::zeros());
        Self { control: control(), memory, plant: ByHand::new(), settings, state }
    }

    #[inline(always)]
    fn tick(&mut self, reference: &Sample) -> Result<(), numeris::ode::OdeError> {
        let input = command(&self.control, &mut self.memory, reference, &self.state);
        let derivative = |_: f64, x: &Vector<f64, 6>| {
            let x = std::array::from_fn(|i| x[i]);
            Vector::from_array(self.plant.derivative(x, [input[0], input[1]]))
        };
        let start = Vector::from_array(self.state.data.0[0]);
        let end = RKTS54::integrate(0.0, PERIOD, &start, derivative, &self.settings)?;
        self.state = SVector::from_fn(|i, _| end.y[i]);
        Ok(())
    }
}

/// The servos that are timed are the same servo: by hand but for rounding, under the adaptive solver but for its error.
fn assert_equal(references: &[Sample]) {
    let mut by_hand = ByHand::new();
    let course: Vec<[f64; 6]> = references
        .iter()
        .map(|reference| {
            by_hand.tick(reference);
            by_hand.state
        })
        .collect();
    let largest = |i: usize| course.iter().fold(0.0_f64, |largest, state| largest.max(state[i].abs()));
    let current = largest(1);
    assert!(current > 1.0 && current < CURRENT_LIMIT, "the servo moves and reaches no limit: {current} A");
    // The d current is small and goes by the q current.
    let scale = [current, current, largest(2), largest(3), largest(4), largest(5)];
    let (mut ours, mut adaptive) = (Ours::new(), Adaptive::new(None));
    for (reference, by_hand) in references.iter().zip(&course) {
        ours.tick(reference).expect("stable");
        adaptive.tick(reference).expect("smooth");
        for i in 0..6 {
            let error = |state: f64| (state - by_hand[i]).abs() / scale[i];
            assert!(error(ours.state[i]) < 1e-9, "{:?} {by_hand:?}", ours.state);
            // The tolerance of the solver and the error of the step, over the ticks that the loop remembers.
            assert!(error(adaptive.state[i]) < 1e-3, "{:?} {by_hand:?}", adaptive.state);
        }
    }
}

fn servo_tick(criterion: &mut Criterion) {
    let references = references();
    assert_equal(&references);
    let mut group = criterion.benchmark_group("servo tick");
    group.throughput(Throughput::Elements(u64::from(TICKS)));
    let ours = Ours::new();
    group.bench_function("one RK4 step", |b| {
        b.iter(|| {
            let mut servo = black_box(ours.clone());
            let end = black_box(&references).iter().try_for_each(|reference| servo.tick(reference));
            end.map(|()| servo.state)
        });
    });
    let by_hand = ByHand::new();
    group.bench_function("one RK4 step, by hand", |b| {
        b.iter(|| {
            let mut servo = black_box(by_hand.clone());
            black_box(&references).iter().for_each(|reference| servo.tick(reference));
            servo.state
        });
    });
    for (name, initial_step) in [("numeris, 1e-6", None), ("numeris, 1e-6, first step given", Some(PERIOD))] {
        let adaptive = Adaptive::new(initial_step);
        group.bench_function(name, |b| {
            b.iter(|| {
                let mut servo = black_box(adaptive.clone());
                let end = black_box(&references).iter().try_for_each(|reference| servo.tick(reference));
                end.map(|()| servo.state)
            });
        });
    }
    let clock = Clock::from_frequency(10_000).expect("valid");
    let simulation = Simulation::new(clock, u64::from(TICKS)).saturation(ours.stepper.plant().saturation());
    group.bench_function("one RK4 step, simulation recorded every tick", |b| {
        let mut stepper = ours.stepper.clone();
        b.iter(|| {
            let outcome = black_box(&simulation).run(
                &mut stepper,
                SVector::zeros(),
                &mut (FieldOrientedState::new(), black_box(&references).iter()),
                |(memory, references), tick: &ControlTick<'_, 6, 3>| {
                    let reference = references.next().copied().unwrap_or_default();
                    command(&ours.control, memory, &reference, tick.state)
                },
                [("motor angle", "rad"), ("load angle", "rad"), ("current", "A"), ("voltage", "V")],
                |_, probe| [probe.state[2], probe.state[4], probe.state[1], probe.input[1]],
            );
            outcome.map(|outcome| *outcome.state())
        });
    });
    group.finish();
}

criterion_group!(benches, servo_tick, exact::exact_tick);
criterion_main!(benches);
