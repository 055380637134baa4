//! The belt drive against the equations of its paper, its eigenvalues, and in a semi-closed loop.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use std::f64::consts::TAU;

use plants::nalgebra::{Complex, vector};
use plants::{
    BeltDrive, Clock, ControlTick, Encoder, LinearMotor, ModelError, Probe, Recording, Simulation, Stepper,
    TransferFunction, ZeroOrderHold,
};
use profiles::{FivePhase, Profile};

const PULLEY: f64 = 0.004;
const LOAD: f64 = 0.03;
const STIFFNESS: f64 = 2.0;

const POINTS: [Complex<f64>; 5] = [
    Complex::new(0.0, 1.0),
    Complex::new(0.0, 8.0),
    Complex::new(-3.0, 24.0),
    Complex::new(20.0, 0.0),
    Complex::new(-7.0, -2e3),
];

fn belt() -> BeltDrive {
    BeltDrive::new(PULLEY, LOAD, STIFFNESS).expect("valid")
}

fn close(found: Complex<f64>, expected: Complex<f64>, tolerance: f64) {
    assert!((found - expected).norm() <= tolerance * expected.norm(), "{found} {expected}");
}

#[test]
fn undamped_they_are_equations_3_and_4() {
    let (g, l, k) = (PULLEY, LOAD, STIFFNESS);
    let (motor, load, both) = (
        belt().motor_from_torque().expect("finite"),
        belt().load_from_motor().expect("finite"),
        belt().load_from_torque().expect("finite"),
    );
    for s in POINTS {
        let held = s * s * l + k;
        let third = held / (s * s * g * held + s * s * (k * l));
        let at = |transfer: &TransferFunction| transfer.at(s).expect("no pole");
        // Near a resonance the formulas cancel to about a hundredth.
        close(at(&motor), third, 1e-13);
        close(at(&load), k / held, 1e-13);
        close(at(&both), third * k / held, 1e-13);
    }
}

#[test]
fn damped_they_are_those_of_the_two_inertias() {
    let belt = belt().with_damping(0.02, 0.05, 0.01).expect("valid");
    let (motor, load, both) = (
        belt.motor_from_torque().expect("finite"),
        belt.load_from_motor().expect("finite"),
        belt.load_from_torque().expect("finite"),
    );
    let system = belt.state_space().expect("finite");
    // Damped, all poles are well apart: the eigenvalue solver finds them to some roundings.
    let found = TransferFunction::from_state_space(&system, 0, 0).expect("converges");
    let through = TransferFunction::from_state_space(&system, 0, 2).expect("converges");
    assert_eq!((found.zeros().len(), through.zeros().len()), (2, 1));
    for s in POINTS {
        let at = |transfer: &TransferFunction| transfer.at(s).expect("no pole");
        close(at(&motor) * s, belt.axis().motor_speed_from_torque(s).expect("no pole"), 1e-12);
        close(at(&both) * s, belt.axis().load_speed_from_torque(s).expect("no pole"), 1e-12);
        close(at(&load), belt.axis().load_from_motor(s).expect("no pole"), 1e-12);
        close(at(&found), at(&motor), 1e-11);
        close(at(&through), at(&both), 1e-11);
    }
}

#[test]
fn both_resonances_are_eigenvalues() {
    let belt = belt();
    assert!((belt.resonance() - (STIFFNESS / LOAD * (1.0 + LOAD / PULLEY)).sqrt()).abs() < 1e-13);
    assert!((belt.anti_resonance() - (STIFFNESS / LOAD).sqrt()).abs() < 1e-14);
    // Free: eq. (5), among the eigenvalues of the whole. The rotation is a double zero, to 1e-8 of the resonance.
    let free = belt.state_space().expect("finite").poles().expect("converges");
    let highest = free.iter().map(|pole| pole.im).fold(0.0, f64::max);
    assert!((highest / belt.resonance() - 1.0).abs() < 1e-14);
    // Held: the motor's rows and columns struck out.
    let a = *belt.state_space().expect("finite").a();
    let held = plants::eigenvalues(&a.fixed_view::<2, 2>(2, 2).into_owned()).expect("converges");
    assert!((held[0].im.abs() / belt.anti_resonance() - 1.0).abs() < 1e-14);
    // Eq. (4) has its poles there and not at eq. (5), eq. (3) has its zeros there and its poles at eq. (5).
    let (third, fourth) =
        (belt.motor_from_torque().expect("finite"), belt.load_from_motor().expect("finite"));
    assert!((fourth.poles()[0].im / belt.anti_resonance() - 1.0).abs() < 1e-15);
    assert!((third.zeros()[0].im / belt.anti_resonance() - 1.0).abs() < 1e-15);
    assert!((third.poles()[2].im / belt.resonance() - 1.0).abs() < 1e-15);
    assert!(fourth.at(Complex::new(0.0, belt.resonance())).is_ok_and(|g| g.norm() < 0.2));
    assert!((belt.free_mode().expect("vibrates").angular_frequency() / belt.resonance() - 1.0).abs() < 1e-15);
    assert!(
        (belt.held_mode().expect("vibrates").angular_frequency() / belt.anti_resonance() - 1.0).abs() < 1e-15
    );
}

#[test]
fn spans_and_radii() {
    // 20 mm on the motor, 50 mm on the load: both spans stretch by r_g theta_g - r_l theta.
    let (k, r_g, r_l) = (3e4, 0.02, 0.05);
    let belt = BeltDrive::from_spans(PULLEY, LOAD, k, r_g, r_l).expect("valid");
    let (theta_g, theta) = (0.03, 0.007);
    let stretch = r_g * theta_g - r_l * theta;
    let torque = belt.axis().spring_torque(&vector![theta_g, 0.0, theta * r_l / r_g, 0.0]);
    assert!((torque - 2.0 * k * stretch * r_g).abs() < 1e-13);
    // The load itself feels r_l times the belt's force: J_l theta'' = 2 k stretch r_l.
    let acceleration = torque / belt.axis().load_inertia() * (r_g / r_l);
    assert!((acceleration * LOAD - 2.0 * k * stretch * r_l).abs() < 1e-13);
    let error = BeltDrive::from_spans(PULLEY, LOAD, k, 0.02, -1.0);
    assert!(matches!(error, Err(ModelError::Parameter { value, .. }) if value < 0.0));
    assert!(BeltDrive::from_spans(PULLEY, f64::NAN, k, 0.02, 0.02).is_err());
}

#[test]
fn the_energy_of_a_belt_is_kept() {
    let mut stepper = ZeroOrderHold::new(belt()).metered();
    let mut state = vector![0.4, 0.0, -0.1, 2.0];
    for k in 0..5000_u32 {
        state = stepper.advance(&state, &vector![f64::from(k % 9) - 4.0, 0.3], 1e-3).expect("finite");
    }
    assert!(stepper.ledger().relative_imbalance() < 1e-13);
}

/// A semi-closed loop: the PD law sees the encoder of the motor, the recording that of the load.
fn semi_closed(profile: &impl Profile, seconds: f64) -> Recording {
    let (motor, tail) = (
        Encoder::from_counts_per_unit(22_800.0).expect("valid"),
        Encoder::from_counts_per_unit(22_800.0).expect("valid"),
    );
    let clock = Clock::from_frequency(1000).expect("valid");
    let mut previous = 0.0;
    Simulation::new(clock, clock.ticks(seconds).expect("counts"))
        .run(
            &mut ZeroOrderHold::new(belt()),
            vector![0.0, 0.0, 0.0, 0.0],
            &mut previous,
            |previous, tick: &ControlTick<'_, 4, 2>| {
                let angle = motor.quantise(tick.state[0]);
                let speed = (angle - *previous) * 1000.0;
                *previous = angle;
                let wanted = profile.sample(tick.time);
                vector![400.0 * (wanted.position - angle) + 2.0 * (wanted.velocity - speed), 0.0]
            },
            [("motor", "rad"), ("load", "rad")],
            |_, probe: &Probe<'_, 4, 2>| [motor.quantise(probe.state[0]), tail.quantise(probe.state[2])],
        )
        .expect("valid")
        .completed()
        .expect("stable")
}

/// Angular frequency of what passes through zero, from the first and the last passage upwards, and its amplitude.
fn vibration(signal: &[f64], period: f64) -> (f64, f64) {
    let passages: Vec<f64> = signal
        .windows(2)
        .enumerate()
        .filter(|(_, pair)| pair[0] < 0.0 && pair[1] >= 0.0)
        .map(|(k, pair)| (k as f64 - pair[0] / (pair[1] - pair[0])) * period)
        .collect();
    let amplitude = signal.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    match passages[..] {
        [first, .., last] => (TAU * (passages.len() - 1) as f64 / (last - first), amplitude),
        _ => (0.0, amplitude),
    }
}

#[test]
fn a_semi_closed_loop_holds_the_motor_and_leaves_the_load_vibrating() {
    let abrupt = FivePhase::over_distance(1.0, 0.0, 10.0, 0.02).expect("plan");
    let recording = semi_closed(&abrupt, 12.0);
    let after = 1000;
    let motor: Vec<f64> =
        recording.column("motor").expect("there")[after..].iter().map(|x| x - 1.0).collect();
    let load: Vec<f64> = recording.column("load").expect("there")[after..].iter().map(|x| x - 1.0).collect();
    let (frequency, amplitude) = vibration(&load, 1e-3);
    // The proportional gain is a spring of 400 N m/rad behind the belt's 2: lower by half of 2/402.
    let behind = belt().anti_resonance() * (400.0_f64 / 402.0).sqrt();
    assert!((frequency / behind - 1.0).abs() < 2e-4, "{frequency} {behind}");
    assert!(amplitude > 0.8, "{amplitude}");
    // The motor's own encoder hardly shows it: 2 N m/rad over 402 of the amplitude, and some pulses.
    let (_, seen) = vibration(&motor, 1e-3);
    assert!(seen < 0.006 * amplitude + 4.0 / 22_800.0, "{seen}");
}

#[test]
fn two_averages_of_one_period_leave_the_load_at_rest() {
    let period = TAU / (belt().anti_resonance() * (400.0_f64 / 402.0).sqrt());
    let gentle = FivePhase::over_distance(4.0, 0.0, 1.5, period).expect("plan");
    let recording = semi_closed(&gentle, gentle.duration() + 5.0);
    let end = (1000.0 * gentle.duration()) as usize + 1;
    let rest: Vec<f64> = recording.column("load").expect("there")[end..].iter().map(|x| x - 4.0).collect();
    let (_, left) = vibration(&rest, 1e-3);
    // Of a step of the speed 1.5 / w = 0.18 rad would be left; what is, are a few pulses of the loop's own error.
    assert!(left < 2e-3, "{left}");
}

#[test]
fn a_free_motor_vibrates_with_the_load_at_the_resonance() {
    let clock = Clock::from_frequency(1000).expect("valid");
    let recording = Simulation::new(clock, clock.ticks(10.0).expect("counts"))
        .run(
            &mut ZeroOrderHold::new(belt()),
            vector![0.0, 0.0, 0.0, 0.0],
            &mut (),
            |(), tick: &ControlTick<'_, 4, 2>| vector![if tick.time < 0.02 { 1.0 } else { 0.0 }, 0.0],
            [("twist", "rad")],
            |_, probe: &Probe<'_, 4, 2>| [probe.state[0] - probe.state[2]],
        )
        .expect("valid")
        .completed()
        .expect("stable");
    let (frequency, _) = vibration(&recording.column("twist").expect("there")[100..], 1e-3);
    // Thirty-seven periods between two passages that are interpolated to a hundredth of a sample.
    assert!((frequency / belt().resonance() - 1.0).abs() < 1e-5, "{frequency}");
}

#[test]
fn a_stiff_belt_is_one_inertia() {
    let stiff = BeltDrive::new(PULLEY, LOAD, 1e6).expect("valid").load_from_torque().expect("finite");
    let rigid = LinearMotor::new(PULLEY + LOAD, 0.0).expect("valid").state_space().expect("finite");
    let rigid = TransferFunction::from_state_space(&rigid, 0, 0).expect("converges");
    for w in [0.1, 3.0, 20.0] {
        let (found, expected) = (stiff.frequency_response(w), rigid.frequency_response(w));
        // (20 rad/s over the resonance of 17 000)^2.
        close(found.expect("no pole"), expected.expect("no pole"), 2e-6);
    }
}
