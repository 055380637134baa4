//! A plant driven by the feedforward alone follows the reference.
#![expect(clippy::float_cmp, reason = "numbers that must be equal to the bit")]

use control::{Feedforward, Pid, PidGains, PidInput, PidState};
use profiles::Sample;

/// Rest to rest over one metre in one second with continuous jerk:
/// `126 t^5 - 420 t^6 + 540 t^7 - 315 t^8 + 70 t^9`.
fn reference(t: f64) -> Sample {
    let mut polynomial = [0.0, 0.0, 0.0, 0.0, 0.0, 126.0, -420.0, 540.0, -315.0, 70.0];
    let mut derivatives = [0.0; 5];
    for derivative in &mut derivatives {
        *derivative = polynomial.iter().rev().fold(0.0, |sum, c| sum * t + c);
        for power in 1..polynomial.len() {
            polynomial[power - 1] = polynomial[power] * power as f64;
        }
        polynomial[9] = 0.0;
    }
    let [position, velocity, acceleration, jerk, snap] = derivatives;
    Sample { position, velocity, acceleration, jerk, snap }
}

/// Classical Runge-Kutta over `[0, 1]`; the largest `deviation` on the way.
fn worst<const N: usize>(
    steps: u32,
    derivative: impl Fn(f64, [f64; N]) -> [f64; N],
    deviation: impl Fn(f64, [f64; N]) -> f64,
) -> f64 {
    let h = 1.0 / f64::from(steps);
    let add = |x: [f64; N], k: [f64; N], h: f64| core::array::from_fn(|i| x[i] + h * k[i]);
    let (mut x, mut worst) = ([0.0; N], 0.0_f64);
    for step in 0..steps {
        let t = f64::from(step) * h;
        let k1 = derivative(t, x);
        let k2 = derivative(t + h / 2.0, add(x, k1, h / 2.0));
        let k3 = derivative(t + h / 2.0, add(x, k2, h / 2.0));
        let k4 = derivative(t + h, add(x, k3, h));
        x = core::array::from_fn(|i| x[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        worst = worst.max(deviation(t + h, x).abs());
    }
    worst
}

#[test]
fn the_reference_ends_at_rest() {
    let end = reference(1.0);
    let Sample { position, velocity, acceleration, jerk, .. } = end;
    // Sums of coefficients up to 1e5 with alternating signs.
    for (value, expected) in [(position, 1.0), (velocity, 0.0), (acceleration, 0.0), (jerk, 0.0)] {
        assert!((value - expected).abs() < 1e-10, "{end:?}");
    }
}

#[test]
fn a_rigid_mass_with_friction() {
    let (mass, damping) = (3.0, 20.0);
    let feedforward = Feedforward::rigid(mass, damping).expect("valid");
    let error = worst(
        1000,
        |t, [_, v]| [v, (feedforward.force(&reference(t)) - damping * v) / mass],
        |t, [x, _]| x - reference(t).position,
    );
    // Runge-Kutta of order four at 1000 steps.
    assert!(error < 1e-10, "{error:e}");
}

#[test]
fn the_load_of_a_two_mass_plant() {
    // 1 kg and 4 kg on 2000 N/m vibrate at 50 rad/s, in antiphase.
    let (motor, load, stiffness, damping) = (1.0, 4.0, 2000.0, 15.0);
    let plant = |feedforward: Feedforward, steps| {
        worst(
            steps,
            |t, [x1, v1, x2, v2]| {
                let spring = stiffness * (x1 - x2);
                let force = feedforward.force(&reference(t));
                [v1, (force - damping * v1 - spring) / motor, v2, spring / load]
            },
            |t, [_, _, x2, _]| x2 - reference(t).position,
        )
    };
    let full = Feedforward::two_mass(motor, load, stiffness, damping).expect("valid");
    let (coarse, fine) = (plant(full, 500), plant(full, 1000));
    // What remains is the integration, of order four.
    assert!(fine < 1e-7 && (coarse / fine - 16.0).abs() < 1.0, "{coarse:e} -> {fine:e}");
    // Every gain is needed.
    let rigid = Feedforward::rigid(motor + load, damping).expect("valid");
    let without_jerk = full.with_jerk(0.0).expect("valid");
    let without_snap = full.with_snap(0.0).expect("valid");
    for lacking in [rigid, without_jerk, without_snap] {
        assert!(plant(lacking, 1000) > 1e-3);
    }
}

#[test]
fn in_the_loop_nothing_is_left_for_the_feedback() {
    // Constant accelerations over whole ticks: the held force is the exact one. Powers of two keep it exact.
    let (mass, period, acceleration) = (2.0, 1.0 / 1024.0, 4.0);
    let feedforward = Feedforward::rigid(mass, 0.0).expect("valid");
    let pid = Pid::new(PidGains { kp: 5e3, ki: 4e4, kd: 100.0 }, period).expect("valid");
    let mut state = PidState::new();
    let (mut x, mut v) = (0.0, 0.0);
    let mut reference = Sample::default();
    for k in 0..1024 {
        reference.acceleration = [acceleration, 0.0, -acceleration, 0.0][k / 256];
        let input =
            PidInput { feedforward: feedforward.force(&reference), ..PidInput::new(reference.position, x) };
        let force = pid.update(&mut state, input).output;
        assert_eq!(force, mass * reference.acceleration);
        x += period * (v + 0.5 * period * force / mass);
        v += period * force / mass;
        reference.position += period * (reference.velocity + 0.5 * period * reference.acceleration);
        reference.velocity += period * reference.acceleration;
    }
    // 4 m/s^2 for 0.25 s, as long at 1 m/s, and down again.
    assert_eq!((x, v), (0.125 + 0.25 + 0.125, 0.0));
}
