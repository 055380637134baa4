//! Whole runs against closed-form answers.
#![expect(clippy::float_cmp, reason = "what is said to be exact is compared exactly")]
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use plants::nalgebra::{Vector1, vector};
use plants::{
    Channel, Clock, ControlTick, Disturbance, HaltError, LinearMotor, Probe, Recording, Rk4, Saturation,
    Simulation, SimulationError, StateSpace, StepError, ZeroOrderHold, nalgebra::matrix,
};

type Mass = ZeroOrderHold<2, 1, LinearMotor>;

fn mass(mass: f64) -> Mass {
    ZeroOrderHold::new(LinearMotor::new(mass, 0.0).expect("valid"))
}

fn clock(hz: u64) -> Clock {
    Clock::from_frequency(hz).expect("not zero")
}

const POSITION_AND_FORCE: [(&str, &str); 2] = [("position", "m"), ("force", "N")];

fn position_and_force(_: &(), probe: &Probe<'_, 2, 1>) -> [f64; 2] {
    [probe.state[0], probe.input[0]]
}

#[test]
fn a_free_oscillator_follows_its_closed_form() {
    let w = 40.0_f64;
    let system =
        StateSpace::new(matrix![0.0, 1.0; -w * w, 0.0], matrix![0.0; 1.0], matrix![1.0, 0.0], matrix![0.0]);
    let mut stepper = ZeroOrderHold::new(system.expect("finite"));
    let recording = Simulation::new(clock(10_000), 20_000)
        .control_every(7)
        .and_then(|s| s.record_every(5))
        .expect("valid")
        .run(
            &mut stepper,
            vector![1.0, 0.0],
            &mut (),
            |_, _| vector![0.0],
            [("position", "m")],
            |_, p| [p.state[0]],
        )
        .expect("valid")
        .completed()
        .expect("stable");
    assert_eq!(recording.len(), 4001);
    for (t, x) in recording.time().iter().zip(recording.column("position").expect("recorded")) {
        // Some 7000 products, each within a few units in the last place.
        assert!((x - (w * t).cos()).abs() < 1e-12, "{x} at {t}");
    }
}

#[test]
fn held_forces_make_parabolas() {
    let force = |k: u64| (k % 5) as f64 - 2.0;
    let (m, period) = (2.0, 4.0 / 1000.0);
    let recording = Simulation::new(clock(1000), 400)
        .control_every(4)
        .expect("valid")
        .run(
            &mut mass(m),
            vector![0.1, -0.3],
            &mut (),
            |_, tick: &ControlTick<'_, 2, 1>| vector![force(tick.tick / 4)],
            POSITION_AND_FORCE,
            position_and_force,
        )
        .expect("valid")
        .completed()
        .expect("stable");
    let (mut x, mut v) = (0.1, -0.3);
    let column = recording.column("position").expect("recorded");
    for k in 0..100 {
        let a = force(k) / m;
        for tick in 0..4 {
            let t = tick as f64 / 1000.0;
            let expected = x + v * t + a * t * t / 2.0;
            // Positions near one, four hundred additions.
            assert!((column[k as usize * 4 + tick] - expected).abs() < 1e-14);
        }
        (x, v) = (x + v * period + a * period * period / 2.0, v + a * period);
    }
    assert!((column[400] - x).abs() < 1e-14);
}

/// The positions of a mass of 1 kg under forces 1, -2, 3 ... of a controller at 10 Hz, with a delay.
fn delayed(periods: f64, record: u32) -> Recording {
    let forces = [1.0, -2.0, 3.0, -4.0];
    Simulation::new(clock(100), 40)
        .control_every(10)
        .and_then(|s| s.record_every(record))
        .and_then(|s| s.delay(periods))
        .expect("valid")
        .run(
            &mut mass(1.0),
            vector![0.0, 0.0],
            &mut (),
            |_, tick: &ControlTick<'_, 2, 1>| vector![forces[tick.tick as usize / 10]],
            POSITION_AND_FORCE,
            position_and_force,
        )
        .expect("valid")
        .completed()
        .expect("stable")
}

#[test]
fn a_delay_moves_every_switch() {
    // Forces switch at (k + delay) * 0.1 s; 0.3 is a whole number of ticks, 0.333 is not, 1 and 2.45 reach over.
    for delay in [0.0, 0.3, 0.333, 1.0, 2.45] {
        for record in [1, 7, 10] {
            let recording = delayed(delay, record);
            let position = recording.column("position").expect("recorded");
            for (&t, &x) in recording.time().iter().zip(position) {
                // Each switch adds a parabola from there on.
                let jumps = [1.0, -3.0, 5.0, -7.0];
                let expected: f64 = (0..4)
                    .map(|k| {
                        let since = (t - (f64::from(k) + delay) * 0.1).max(0.0);
                        jumps[k as usize] * since * since / 2.0
                    })
                    .sum();
                assert!((x - expected).abs() < 1e-15, "{x} {expected} at {t} with {delay}");
            }
        }
    }
}

#[test]
fn a_fractional_delay_by_hand() {
    // 0.3 of 0.1 s, then 0.07 s of 1 N: 0.07^2 / 2; then 0.03 s more, and 0.07 s of -2 N from 0.1 m/s.
    let recording = delayed(0.3, 10);
    let position = recording.column("position").expect("recorded");
    let expected = [0.0, 0.00245, 0.005 + 0.1 * 0.07 - 0.07 * 0.07];
    for (x, e) in position.iter().zip(expected) {
        assert!((x - e).abs() < 1e-16);
    }
    let force = recording.column("force").expect("recorded");
    assert_eq!(force, [0.0, 1.0, -2.0, 3.0, -4.0]);
}

#[test]
fn recorded_inputs_act_from_their_instant_on() {
    assert_eq!(delayed(0.0, 10).column("force").expect("recorded"), [1.0, -2.0, 3.0, -4.0, -4.0]);
    assert_eq!(delayed(1.0, 10).column("force").expect("recorded"), [0.0, 1.0, -2.0, 3.0, -4.0]);
    // 0.7, 1.4, 2.1, 2.8, 3.5 tenths and the end.
    let recording = delayed(0.0, 7);
    assert_eq!(recording.time(), [0.0, 0.07, 0.14, 0.21, 0.28, 0.35, 0.4]);
}

#[test]
fn the_controller_hears_what_was_realised() {
    let mut heard = Vec::new();
    let forces = [9.0, -2.0, -7.0, 0.5, 0.0];
    let outcome = Simulation::new(clock(10), 5)
        .delay(1.5)
        .and_then(|s| s.initial_input(vector![0.25]))
        .expect("valid")
        .saturation(Saturation::symmetric(4.0).expect("valid"))
        .run(
            &mut mass(1.0),
            vector![0.0, 0.0],
            &mut heard,
            |heard, tick: &ControlTick<'_, 2, 1>| {
                heard.push((tick.realised_previous[0], tick.input[0]));
                vector![forces[tick.tick as usize]]
            },
            [("command", "N"), ("force", "N")],
            |_, probe| [probe.command[0], probe.input[0]],
        )
        .expect("valid");
    assert_eq!(heard, [(0.25, 0.25), (4.0, 0.25), (-2.0, 4.0), (-4.0, -2.0), (0.5, -4.0)]);
    let recording = outcome.completed().expect("stable");
    assert_eq!(recording.column("command").expect("recorded"), [9.0, -2.0, -7.0, 0.5, 0.0, 0.0]);
    assert_eq!(recording.column("force").expect("recorded"), [0.25, 0.25, 4.0, -2.0, -4.0, 0.5]);
}

#[test]
fn tasks_have_their_own_rates() {
    let simulation = Simulation::<1>::new(clock(1000), 60).control_every(2).expect("valid");
    let (fast, slow) = (simulation.task(2).expect("fits"), simulation.task(10).expect("fits"));
    let mut runs = (Vec::new(), Vec::new());
    let outcome = simulation
        .run(
            &mut mass(1.0),
            vector![0.0, 0.0],
            &mut runs,
            |runs, tick: &ControlTick<'_, 2, 1>| {
                if tick.runs(slow) {
                    runs.1.push(tick.tick);
                }
                if tick.runs(fast) {
                    runs.0.push(tick.tick);
                }
                vector![0.0]
            },
            [] as [Channel; 0],
            |_, _| [],
        )
        .expect("valid");
    assert!(outcome.halt().is_none());
    assert_eq!(runs.0, (0..60).step_by(2).collect::<Vec<_>>());
    assert_eq!(runs.1, [0, 10, 20, 30, 40, 50]);
}
#[test]
fn disturbances_enter_with_the_input() {
    let run = |disturbance, stepper: &mut Mass| {
        Simulation::new(clock(1000), 2000)
            .control_every(500)
            .expect("valid")
            .saturation(Saturation::symmetric(1.0).expect("valid"))
            .disturbances([disturbance])
            .run(
                stepper,
                vector![0.0, 0.0],
                &mut (),
                |_, _| vector![0.0],
                [("position", "m")],
                |_, p| [p.state[0]],
            )
            .expect("valid")
            .completed()
            .expect("stable")
    };
    // Past the saturation, from 0.5 s on: 3 * 1.5^2 / 2.
    let step = run(Disturbance::step(0.5, 3.0).expect("valid"), &mut mass(1.0));
    assert!((step.column("position").expect("recorded")[2000] - 3.375).abs() < 1e-12);
    // x'' = sin(w t): x = (w t - sin(w t)) / w^2; midpoint holding is of second order, (w h)^2 / 24 of x.
    let w = 6.0_f64;
    let sine = run(Disturbance::sine(1.0, w, 0.0).expect("valid"), &mut mass(1.0));
    let exact = (2.0 * w - (2.0 * w).sin()) / (w * w);
    let error = (sine.column("position").expect("recorded")[2000] - exact).abs();
    assert!(error < (w * 1e-3).powi(2) / 12.0 * exact, "{error}");
    let noise = |seed| run(Disturbance::gaussian(1.0, seed).expect("valid"), &mut mass(1.0));
    assert_eq!(noise(1), noise(1));
    assert_ne!(noise(1), noise(2));
}

#[test]
fn a_bad_command_or_step_stops_the_run() {
    let simulation = Simulation::new(clock(10), 10);
    let outcome = simulation
        .run(
            &mut mass(1.0),
            vector![0.0, 0.0],
            &mut (),
            |_, tick: &ControlTick<'_, 2, 1>| vector![if tick.tick == 3 { f64::NAN } else { 1.0 }],
            POSITION_AND_FORCE,
            position_and_force,
        )
        .expect("valid");
    assert!(
        matches!(outcome.halt(), Some(HaltError::Command { time, component: 0, value }) if *time == 0.3 && value.is_nan())
    );
    assert_eq!(outcome.recording().len(), 3);

    let mut stiff = Rk4::fixed(|x: &Vector1<f64>, _: &Vector1<f64>| x * -1e3, 1, 1e3).expect("valid");
    let outcome = simulation
        .run(&mut stiff, vector![1.0], &mut (), |_, _| vector![0.0], [("x", "1")], |_, p| [p.state[0]])
        .expect("valid");
    let unstable = StepError::Unstable { step: 0.1, product: 100.0, limit: 2.78 };
    assert_eq!(outcome.halt(), Some(&HaltError::Step { time: 0.0, source: unstable }));
}

#[test]
fn a_run_that_cannot_start_is_an_error() {
    let simulation = Simulation::new(clock(10), 10);
    let start = |state, channels| {
        simulation.run(&mut mass(1.0), state, &mut (), |_, _| vector![0.0], channels, position_and_force)
    };
    let error = start(vector![0.0, f64::NAN], POSITION_AND_FORCE);
    assert!(matches!(error, Err(SimulationError::Number { .. })));
    let error = start(vector![0.0, 0.0], [("x", "m"), ("x", "m")]);
    assert!(matches!(error, Err(SimulationError::Recording(_))));
    let endless = Simulation::new(clock(10), u64::MAX);
    let error = endless.run(
        &mut mass(1.0),
        vector![0.0, 0.0],
        &mut (),
        |_, _| vector![0.0],
        POSITION_AND_FORCE,
        position_and_force,
    );
    assert!(matches!(error, Err(SimulationError::Recording(_))), "{error:?}");
}

#[test]
fn the_recording_is_reserved_before_the_start() {
    for (ticks, every, rows) in [(1000, 1, 1001), (1000, 7, 144), (0, 3, 1), (14, 7, 3)] {
        let recording = Simulation::new(clock(1000), ticks)
            .record_every(every)
            .expect("valid")
            .run(
                &mut mass(1.0),
                vector![0.0, 0.0],
                &mut (),
                |_, _| vector![1.0],
                POSITION_AND_FORCE,
                position_and_force,
            )
            .expect("valid")
            .completed()
            .expect("stable");
        assert_eq!(recording.len(), rows);
        // A vector that had to grow would have doubled.
        assert_eq!(recording.capacity() as u64, ticks / u64::from(every) + 2);
    }
}

#[test]
fn written_numbers_read_back_as_the_same() {
    let recording = delayed(0.333, 7);
    let mut text = Vec::new();
    recording.write_csv(&mut text).expect("a vector takes everything");
    let text = String::from_utf8(text).expect("text");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("time [s],position [m],force [N]"));
    let mut read = Recording::new(POSITION_AND_FORCE, recording.len()).expect("valid");
    for line in lines {
        let mut fields = line.split(',').map(|field| field.parse::<f64>().expect("a number"));
        let mut next = || fields.next().expect("three fields");
        let (time, row) = (next(), [next(), next()]);
        read.push(time, row).expect("fits");
    }
    assert_eq!(read, recording);
}
