//! Stability of sampled loops: by the matrix of one period, and by what a run does.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use plants::nalgebra::{SVector, Vector1, Vector2, vector};
use plants::{
    Clock, ControlTick, HaltError, LinearMotor, Simulation, Stepper, ZeroOrderHold, monodromy,
    spectral_radius,
};

type Mass = ZeroOrderHold<2, 1, LinearMotor>;

fn mass(mass: f64) -> Mass {
    ZeroOrderHold::new(LinearMotor::new(mass, 0.0).expect("valid"))
}

fn clock(hz: u64) -> Clock {
    Clock::from_frequency(hz).expect("not zero")
}

/// A mass of 1 kg under a sampled PD controller at 1 kHz, with a delay of one period.
fn pd(kp: f64, kd: f64, x: &Vector2<f64>) -> Vector1<f64> {
    vector![-kp * x[0] - kd * x[1]]
}

fn pd_radius(kp: f64, kd: f64) -> f64 {
    let mut stepper = mass(1.0);
    let tick = |z: &SVector<f64, 3>| {
        let x = vector![z[0], z[1]];
        let next = stepper.advance(&x, &vector![z[2]], 1e-3).expect("valid");
        vector![next[0], next[1], pd(kp, kd, &x)[0]]
    };
    spectral_radius(&monodromy(tick)).expect("converges")
}

fn pd_run(kp: f64, kd: f64, ticks: u64) -> plants::Outcome<2> {
    Simulation::new(clock(1000), ticks)
        .delay(1.0)
        .expect("valid")
        .run(
            &mut mass(1.0),
            vector![1.0, 0.0],
            &mut (),
            |_, tick: &ControlTick<'_, 2, 1>| pd(kp, kd, tick.state),
            [("position", "m")],
            |(), probe| [probe.state[0]],
        )
        .expect("valid")
}

#[test]
fn an_unstable_loop_is_told_by_its_radius_and_by_its_run() {
    let (stable, unstable) = ((1e4, 200.0), (1e4, 1500.0));
    assert!(pd_radius(stable.0, stable.1) < 1.0);
    assert!(
        pd_run(stable.0, stable.1, 1000).completed().expect("stable").column("position").expect("recorded")
            [1000]
            .abs()
            < 1e-6
    );

    let radius = pd_radius(unstable.0, unstable.1);
    assert!(radius > 1.0);
    let outcome = pd_run(unstable.0, unstable.1, 1000);
    let Some(&HaltError::Diverged { time, value, bound, .. }) = outcome.halt() else {
        panic!("{:?}", outcome.halt());
    };
    assert!(value.abs() > bound && (bound - 1e9).abs() < 1.0);
    // From about 1 m/s to 1e9 by powers of the radius, give or take the modes' shares.
    let growth = (time * 1000.0) * radius.ln();
    assert!((growth - 1e9_f64.ln()).abs() < 8.0, "{growth}");
    // What was recorded until then is still there.
    assert_eq!(outcome.recording().len(), (time * 1000.0).round() as usize);
    assert!(matches!(outcome.completed(), Err(HaltError::Diverged { .. })));
}

#[test]
fn powers_of_the_monodromy_matrix_are_the_run() {
    let (kp, kd) = (9e3, 150.0);
    let mut stepper = mass(1.0);
    let m = monodromy(|z: &SVector<f64, 3>| {
        let x = vector![z[0], z[1]];
        let next = stepper.advance(&x, &vector![z[2]], 1e-3).expect("valid");
        vector![next[0], next[1], pd(kp, kd, &x)[0]]
    });
    let recording = pd_run(kp, kd, 50).completed().expect("stable");
    let mut z = vector![1.0, 0.0, 0.0];
    for x in recording.column("position").expect("recorded") {
        assert!((x - z[0]).abs() < 1e-13);
        z = m * z;
    }
}
