//! A tick allocates nothing: every piece of a control tick and of a simulated tick, under a counting allocator.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use std::hint::black_box;

use allocation_counter::measure;
use control::{
    AxisModel, Cascade, CommandedPath, CrossCoupling, CurrentLoop, DisturbanceInput, DisturbanceObserver,
    DisturbanceObserverState, Dq, FieldOriented, FieldOrientedInput, FieldOrientedState, PiGains,
    ReachingLaw, SlidingMode, SlidingModeInput, SlidingModeState, SlidingSurface, SuperTwisting,
    SuperTwistingState, Windings,
};
use plants::nalgebra::{self, SVector, vector};
use plants::{
    Clock, ControlTick, Disturbance, Outcome, PmsmDrive, PmsmWindings, Rk4, Simulation, SimulationError,
    Stepper, TransportDelay, TwoInertia, ZeroOrderHold,
};
use profiles::{Cursor, Limits, Mode, PulseTrain, SCurve, Sample, Trapezoid};
use proptest::prelude::*;
use shaping::{DelayFilter, DelayLine, DelayLineState, Shaped};

const PERIOD: f64 = 1e-4; // s

/// How often `tick` allocates in a thousand calls.
fn allocations(mut tick: impl FnMut(u32)) -> u64 {
    measure(|| (0..1000).for_each(&mut tick)).count_total
}

fn axis() -> TwoInertia {
    TwoInertia::new(0.003, 5.066e-4, 100.0)
        .and_then(|axis| axis.with_damping(0.008, 0.006, 0.0))
        .expect("valid")
}

fn stepper() -> Rk4<PmsmDrive> {
    let windings = PmsmWindings::surface(2.875, 8.5e-3, 0.175, 3).and_then(|w| w.with_voltage_limit(180.0));
    Rk4::fixed(PmsmDrive::new(windings.expect("valid"), axis()), 1, 500.0).expect("valid")
}

fn control() -> FieldOriented {
    let windings = Windings { resistance: 2.875, d_inductance: 8.5e-3, q_inductance: 8.5e-3, flux: 0.175 };
    let current_loop = CurrentLoop::tuned(windings, 1970.0, PERIOD)
        .and_then(|c| c.with_voltage_limit(180.0))
        .expect("valid");
    let cascade = Cascade::new(180.0, PiGains { kp: 2.3, ki: 33.0 }, PERIOD)
        .and_then(|c| c.with_divisors(10, 2))
        .and_then(|c| c.with_current_limit(20.0))
        .expect("valid");
    FieldOriented::new(cascade, current_loop, 3).expect("valid")
}

/// The input that the control makes of a state.
fn command(
    control: &FieldOriented,
    memory: &mut FieldOrientedState,
    position: f64,
    state: &SVector<f64, 6>,
) -> SVector<f64, 3> {
    let (reference, current) = (Sample::at_rest(position), Dq { d: state[0], q: state[1] });
    let output = control.update(memory, FieldOrientedInput::new(reference, state[2], state[3], current));
    vector![output.voltage.d, output.voltage.q, 0.0]
}

fn profile() -> SCurve {
    SCurve::rest_to_rest(0.04, &Limits::new(0.2, 4.0, 200.0).expect("valid")).expect("valid")
}

#[test]
fn an_allocation_is_counted() {
    assert_eq!(allocations(|k| drop(black_box(Box::new(k)))), 1000);
    assert_eq!(allocations(|k| _ = black_box(k)), 0);
}

#[test]
fn a_servo_tick_allocates_nothing() {
    let (control, mut stepper) = (control(), stepper());
    let (mut memory, mut state) = (FieldOrientedState::new(), SVector::zeros());
    let mut metered = stepper.clone().metered();
    let count = allocations(|k| {
        // A step that reaches the limits, and a sensor that fails.
        let position = if k % 100 == 7 { f64::NAN } else { 1.0 };
        let input = command(&control, &mut memory, position, &state);
        let next = metered.advance(&state, &input, PERIOD).expect("stable");
        state = stepper.advance(&state, &input, PERIOD).expect("stable");
        assert!(state == next);
    });
    assert_eq!(count, 0);
    assert!(state[2] > 0.1, "it moved: {state}");
}

#[test]
fn exact_steps_allocate_once_for_each_length() {
    let mut stepper = ZeroOrderHold::new(axis());
    let (torque, mut state) = (vector![0.1, 0.0], SVector::zeros());
    let lengths = [PERIOD, 0.3 * PERIOD, 0.7 * PERIOD];
    let mut run = || {
        allocations(|k| {
            let length = lengths[k as usize % lengths.len()];
            state = stepper.advance(&state, &torque, length).expect("stable");
        })
    };
    assert!(run() > 0, "the matrix exponential is counted");
    assert_eq!(run(), 0);
    let discrete = axis().state_space().and_then(|system| system.discretise(PERIOD)).expect("valid");
    assert_eq!(allocations(|_| state = discrete.step(&state, &torque)), 0);
    assert!(state[3] > 0.0);
}

#[test]
fn delays_allocate_nothing() {
    let mode = Mode::from_hz(40.0, 0.02).expect("valid");
    let filter = DelayFilter::positive(mode, 0.0101).expect("valid");
    let mut output = 0.0;
    let count = measure(|| {
        let line = DelayLine::<f32, 6, 32>::new(filter.train(), mode, 1e-3).expect("fits");
        let mut memory = DelayLineState::at_rest(0.0);
        (0..1000).for_each(|_| output = line.update(&mut memory, 1.0).output);
    });
    assert_eq!(count.count_total, 0, "the line is set up without allocation, too");
    assert!((output - 1.0).abs() < 1e-6);

    let mut delay = TransportDelay::new(3.3e-3, PERIOD).expect("valid");
    let mut sum = 0.0;
    assert_eq!(allocations(|_| sum += delay.update(1.0).mean()), 0);
    assert!((sum - 967.0).abs() < 1e-9, "33 of 1000 samples are on their way: {sum}");
}

#[test]
fn references_allocate_nothing() {
    let mode = Mode::from_hz(33.0, 0.02).expect("valid");
    let mut end = [0.0; 3];
    let count = measure(|| {
        let filter = DelayFilter::zvd(mode).expect("valid");
        let mut plain = Cursor::<_, f64>::new(profile(), PERIOD).expect("valid");
        let mut single = Cursor::<_, f32>::new(profile(), PERIOD).expect("valid");
        let mut shaped =
            Cursor::<_, f64>::new(Shaped::new(profile(), *filter.train()), PERIOD).expect("valid");
        for _ in 0..10_000 {
            end = [plain.tick().position, f64::from(single.tick().position), shaped.tick().position];
        }
    });
    assert_eq!(count.count_total, 0);
    assert!(end.iter().all(|end| (end - 0.04).abs() < 1e-8), "{end:?}");
}

#[test]
fn pulses_allocate_nothing() {
    let limits = Limits::new(0.3, 10.0, f64::INFINITY).expect("valid");
    let mut sent = [0; 3];
    let count = measure(|| {
        let move_ = Trapezoid::with_speeds(4e-3, 0.01, 0.01, &limits).expect("valid");
        let train = PulseTrain::new(move_, 1e-6).expect("valid");
        let counts = train.counts(1e-3).expect("valid");
        sent = [
            train.pulses().count(),
            train.periods(72e6).expect("valid").count(),
            counts.sum::<i32>() as usize,
        ];
    });
    assert_eq!(count.count_total, 0);
    assert_eq!(sent, [4000; 3]);
}

/// A servo under `Simulation::run` with everything that may need memory: delay, disturbance, ledger, recording.
fn simulated(ticks: u64, record_every: u32, delay: f64) -> Result<Outcome<6>, SimulationError> {
    let (control, mut stepper) = (control(), stepper().metered());
    let load = Disturbance::sine(0.1, 200.0, 0.0).expect("finite"); // N m
    Simulation::new(Clock::from_frequency(10_000)?, ticks)
        .record_every(record_every)?
        .delay(delay)?
        .saturation(stepper.stepper().plant().saturation())
        .disturbances([Disturbance::none(), Disturbance::none(), load])
        .run(
            &mut stepper,
            SVector::zeros(),
            &mut FieldOrientedState::new(),
            |memory, tick: &ControlTick<'_, 6, 3>| command(&control, memory, 1.0, tick.state),
            [("load angle", "rad"), ("current", "A")],
            |_, probe| [probe.state[4], probe.state[1]],
        )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn a_longer_run_allocates_no_more_often(every in 1..50_u32, delay in prop_oneof![Just(0.0), 0.0..3.0]) {
        let count = |ticks| {
            let mut outcome = None;
            let info = measure(|| outcome = Some(simulated(ticks, every, delay)));
            let outcome = outcome.expect("ran").expect("valid");
            assert_eq!(outcome.halt(), None);
            assert!(outcome.recording().len() as u64 > ticks / u64::from(every));
            (info.count_total, info.bytes_total)
        };
        let (short, long) = (count(1000), count(10_000));
        prop_assert_eq!(short.0, long.0);
        prop_assert!(long.1 > short.1, "the recording is longer");
    }
}

#[test]
fn a_tick_of_three_coupled_axes_allocates_nothing() {
    let model = AxisModel::new(10.0, 1.0, 1.0).expect("valid");
    let surface = SlidingSurface::terminal(10.0, 1.0, 9, 5).expect("valid");
    let reaching =
        ReachingLaw::improved_double_power(20.0, 20.0, 200.0, 1.0 / 3.0, 1.0 / 3.0).expect("valid");
    let sliding = SlidingMode::new(surface, reaching, model, PERIOD)
        .and_then(|law| law.with_integral_compensation(20.0))
        .expect("valid");
    let twisting = SuperTwisting::for_load_rate(surface, 100.0, model, PERIOD).expect("valid");
    let observer = DisturbanceObserver::new(model, 200.0, PERIOD).expect("valid");
    let coupling = CrossCoupling::<3>::uniform(0.01).expect("valid");
    let mut path = CommandedPath::new();
    let mut memory =
        [(SlidingModeState::new(), SuperTwistingState::new(), DisturbanceObserverState::new()); 3];
    let count = allocations(|k| {
        let t = 0.01 * f64::from(k);
        let wanted = [t.sin(), t.cos(), 5.0 * t];
        // A sensor that fails.
        let errors = [0.1 * t, if k % 100 == 7 { f64::NAN } else { -0.2 }, 0.0];
        let coupled = coupling.couple(errors, [0.1, 0.0, -0.1], path.update(wanted).as_ref());
        for (axis, (sliding_state, twisting_state, observed)) in memory.iter_mut().enumerate() {
            let reference = Sample { position: wanted[axis], velocity: 1.0, ..Sample::default() };
            let input = SlidingModeInput::new(&reference, wanted[axis], 1.0)
                .with_error(coupled.errors[axis], coupled.rates[axis]);
            let torque = sliding.update(sliding_state, input).output;
            let other = twisting.update(twisting_state, input).output;
            let estimate = observer.update(observed, DisturbanceInput { position: torque, realised: other });
            let _ = black_box(estimate);
        }
    });
    assert_eq!(count, 0);
}
