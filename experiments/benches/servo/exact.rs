//! One tick of the linear axis under a held torque, exactly.

use std::hint::black_box;

use control::{Pid, PidGains, PidInput, PidState};
use criterion::{Criterion, Throughput};
use plants::nalgebra::{self, SMatrix, SVector, matrix, vector};
use plants::{DiscreteStateSpace, StepError, Stepper, ZeroOrderHold};

use crate::{PERIOD, TICKS, TORQUE_CONSTANT, VELOCITY_GAIN, VELOCITY_INTEGRAL, axis};

const SPEED: f64 = 10.0; // rad/s, the command of the velocity loop

type State = SVector<f64, 4>;

/// The axis under a PI controller of its speed as one linear system: angles, speeds and the integral in N m; the command
/// comes in, the speed of the motor comes out.
fn closed_loop(open: &DiscreteStateSpace<4, 2, 4>, gains: PidGains) -> DiscreteStateSpace<5, 1, 1> {
    let (kp, ki) = (gains.kp, gains.ki * PERIOD);
    // The controller's torque: `T = (kp + ki h) (r - w) + I`, and its integral: `I + ki h (r - w)`.
    let torque = matrix![0.0, -(kp + ki), 0.0, 0.0, 1.0];
    let transition = open.transition();
    let mut a = SMatrix::<f64, 5, 5>::zeros();
    a.fixed_view_mut::<4, 4>(0, 0).copy_from(&transition.state);
    let mut driven = a.fixed_view_mut::<4, 5>(0, 0);
    driven += transition.input.column(0) * torque;
    a[(4, 1)] = -ki;
    a[(4, 4)] = 1.0;
    let motor = transition.input.column(0) * (kp + ki);
    let b = vector![motor[0], motor[1], motor[2], motor[3], ki];
    DiscreteStateSpace::new(a, b, matrix![0.0, 1.0, 0.0, 0.0, 0.0], matrix![0.0], PERIOD).expect("finite")
}

/// The axis under a controller of this library, from rest.
#[inline(always)]
fn controlled<E>(
    pi: &Pid,
    start: State,
    mut step: impl FnMut(&State, f64) -> Result<State, E>,
) -> Result<State, E> {
    let mut memory = PidState::new();
    (0..TICKS).try_fold(start, |x, _| {
        let torque = pi.update(&mut memory, PidInput::new(SPEED, x[1])).output;
        step(&x, torque)
    })
}

/// Alone, under a PI controller of its speed, and both as one system.
pub(crate) fn exact_tick(criterion: &mut Criterion) {
    let axis = axis();
    let mut stepper = ZeroOrderHold::new(axis);
    let discrete = axis.state_space().and_then(|system| system.discretise(PERIOD)).expect("valid");
    let gains =
        PidGains { kp: TORQUE_CONSTANT * VELOCITY_GAIN, ki: TORQUE_CONSTANT * VELOCITY_INTEGRAL, kd: 0.0 };
    let pi = Pid::new(gains, PERIOD).expect("valid");
    let whole = closed_loop(&discrete, gains);
    let run_whole =
        || (0..TICKS).fold(black_box(SVector::zeros()), |x, _| whole.step(&x, black_box(&vector![SPEED])));

    // All of them are the same loop.
    let held = controlled(&pi, State::zeros(), |x, torque| stepper.advance(x, &vector![torque, 0.0], PERIOD));
    let (held, at_once) = (held.expect("stable"), run_whole());
    let (angle, speed) = (held[0], held[1]);
    // Ten thousand roundings of the angle, at most.
    assert!(
        (at_once[0] - angle).abs() < 1e-11 * angle && (at_once[1] - speed).abs() < 1e-11 * speed,
        "{held}{at_once}"
    );
    assert!(angle > 9.0 && (speed - SPEED).abs() < 1e-3, "a second at {SPEED} rad/s: {held}");

    let torque = vector![0.1, 0.0];
    let start = vector![0.01, 0.0, 0.0, 0.0];
    let mut group = criterion.benchmark_group("exact tick");
    group.throughput(Throughput::Elements(u64::from(TICKS)));
    group.bench_function("discrete state space", |b| {
        b.iter(|| (0..TICKS).fold(start, |x, _| discrete.step(&x, black_box(&torque))));
    });
    group.bench_function("zero-order hold", |b| {
        b.iter(|| (0..TICKS).try_fold(start, |x, _| stepper.advance(&x, black_box(&torque), PERIOD)));
    });
    group.bench_function("discrete state space, velocity PI", |b| {
        b.iter(|| {
            controlled(&pi, black_box(start), |x, torque| {
                Ok::<_, StepError>(discrete.step(x, &vector![torque, 0.0]))
            })
        });
    });
    group.bench_function("zero-order hold, velocity PI", |b| {
        b.iter(|| {
            controlled(&pi, black_box(start), |x, torque| stepper.advance(x, &vector![torque, 0.0], PERIOD))
        });
    });
    group.bench_function("axis and velocity PI as one discrete state space", |b| b.iter(run_whole));
    group.finish();
}
