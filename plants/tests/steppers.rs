//! Steppers against closed forms and against each other.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use plants::nalgebra::{Vector1, Vector2, matrix, vector};
use plants::{
    DormandPrince, EnergyLedger, HeldLinear, LinearMotor, Plant, Rk4, StateSpace, Stepper, Tolerance,
    ZeroOrderHold, integrate, integrate_adaptive, linearise, spectral_radius,
};

/// A mass of 1 kg on a spring that hardens, with friction: smooth, nonlinear, no closed form.
fn hardening(x: &Vector2<f64>, u: &Vector1<f64>) -> Vector2<f64> {
    vector![x[1], u[0] - 100.0 * x[0] - 2000.0 * x[0].powi(3) - 0.8 * x[1]]
}

fn two_mode() -> StateSpace<4, 1, 1> {
    // Two masses of 1 and 0.5 kg with a spring of 3000 N/m and a damper of 2 N s/m between them.
    let (m1, m2, k, d) = (1.0, 0.5, 3000.0, 2.0);
    StateSpace::new(
        matrix![
            0.0, 1.0, 0.0, 0.0;
            -k / m1, -d / m1, k / m1, d / m1;
            0.0, 0.0, 0.0, 1.0;
            k / m2, d / m2, -k / m2, -d / m2
        ],
        matrix![0.0; 1.0 / m1; 0.0; 0.0],
        matrix![0.0, 0.0, 1.0, 0.0],
        matrix![0.0],
    )
    .expect("finite")
}

/// The slope of the error of a method over its step, between `steps` and twice as many.
fn order(error: impl Fn(u32) -> f64, steps: u32) -> f64 {
    (error(steps) / error(2 * steps)).log2()
}

#[test]
fn rk4_is_of_order_four() {
    let oscillator = |x: &Vector2<f64>, _: &Vector1<f64>| vector![x[1], -x[0]];
    let error = |steps| {
        let mut stepper = Rk4::fixed(oscillator, steps, 1.0).expect("valid");
        let x = stepper.advance(&vector![1.0, 0.0], &vector![0.0], 2.0).expect("stable");
        (x - vector![2.0_f64.cos(), -2.0_f64.sin()]).norm()
    };
    for steps in [16, 32, 64] {
        let slope = order(error, steps);
        // The next term of the error is smaller by the step.
        assert!((slope - 4.0).abs() < 0.1, "{slope}");
    }
    // Also where time is in the right-hand side: x' = -2 t x.
    let error = |steps: u32| {
        let f = |t: f64, x: &Vector1<f64>| x * (-2.0 * t);
        let x = integrate(f, vector![1.0], 0.0, 1.0 / f64::from(steps), u64::from(steps), |_, _| ());
        (x.expect("valid")[0] - (-1.0_f64).exp()).abs()
    };
    for steps in [16, 32, 64] {
        let slope = order(error, steps);
        assert!((slope - 4.0).abs() < 0.2, "{slope}");
    }
}

#[test]
fn dormand_prince_keeps_its_tolerance() {
    let reference = {
        let mut stepper = Rk4::fixed(hardening, 20_000, 0.0).expect("valid");
        stepper.advance(&vector![0.4, 0.0], &vector![3.0], 1.0).expect("stable")
    };
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let bound = Tolerance::new(tolerance, tolerance).expect("valid");
        let mut stepper = DormandPrince::new(hardening, bound);
        let x = stepper.advance(&vector![0.4, 0.0], &vector![3.0], 1.0).expect("regular");
        // A local tolerance on a damped motion of a few periods: the global error stays within some tens of it.
        assert!((x - reference).amax() < 50.0 * tolerance, "{tolerance}: {}", (x - reference).amax());
        // In a hundred pieces, as a simulation asks for it.
        let mut x = vector![0.4, 0.0];
        for _ in 0..100 {
            x = stepper.advance(&x, &vector![3.0], 0.01).expect("regular");
        }
        assert!((x - reference).amax() < 50.0 * tolerance);
    }
}

#[test]
fn the_matrix_exponential_is_the_limit_of_small_steps() {
    let system = two_mode();
    let mut exact = ZeroOrderHold::new(system);
    let mut small = Rk4::fixed(system, 400, 0.0).expect("valid");
    let (mut x, mut y) = (vector![0.0, 0.1, 0.01, 0.0], vector![0.0, 0.1, 0.01, 0.0]);
    for k in 0..200 {
        let input = vector![f64::from(k % 7) - 3.0];
        x = exact.advance(&x, &input, 1e-3).expect("finite");
        y = small.advance(&y, &input, 1e-3).expect("stable");
        // w h = 2.4e-4, (w h)^5 / 120 of error a step: rounding of 80 000 steps is what remains.
        assert!((x - y).amax() < 1e-12 * (1.0 + x.amax()), "{k}: {}", (x - y).amax());
    }
}

#[test]
fn the_rule_of_substeps_holds_its_accuracy() {
    let system = two_mode();
    let radius = system.poles().expect("converges").iter().fold(0.0_f64, |r, p| r.max(p.norm()));
    // Vibration at sqrt(k (1 / m1 + 1 / m2)).
    assert!((radius - 9000.0_f64.sqrt()).abs() < 1e-9);
    let mut exact = ZeroOrderHold::new(system);
    let mut stepper = Rk4::accurate(system, radius).expect("valid");
    let (mut x, mut y) = (vector![0.0, 0.1, 0.0, 0.0], vector![0.0, 0.1, 0.0, 0.0]);
    let mut worst = 0.0_f64;
    for _ in 0..500 {
        x = exact.advance(&x, &vector![0.0], 1e-2).expect("finite");
        y = stepper.advance(&y, &vector![0.0], 1e-2).expect("stable");
        worst = worst.max((x - y).amax());
    }
    // 0.12^4 / 120 per radian, while the vibration lasts: 1 / (damping ratio) of them.
    assert!(worst < 1e-5 && worst > 1e-9, "{worst}");
}

#[test]
fn the_motor_in_closed_form_is_its_state_space() {
    for damping in [0.0, 1e-9, 0.5, 300.0] {
        let motor = LinearMotor::new(3.0, damping).and_then(|m| m.driven_by_current(12.0)).expect("valid");
        let mut closed = ZeroOrderHold::new(motor);
        let mut general = ZeroOrderHold::new(motor.state_space().expect("finite"));
        let (mut x, mut y) = (vector![0.0, 0.2], vector![0.0, 0.2]);
        for k in 0..1000 {
            let input = vector![f64::from(k % 11) - 5.0];
            x = closed.advance(&x, &input, 4e-4).expect("finite");
            y = general.advance(&y, &input, 4e-4).expect("finite");
        }
        assert!((x - y).amax() < 1e-12, "{}", (x - y).amax());
    }
}

#[test]
fn the_energy_of_a_motor_is_accounted_for() {
    // Gauss-Legendre on five points: exact to rounding for c T / m well below one.
    let nodes =
        [-0.906_179_845_938_664, -0.538_469_310_105_683, 0.0, 0.538_469_310_105_683, 0.906_179_845_938_664];
    let weights = [
        0.236_926_885_056_189,
        0.478_628_670_499_366,
        0.568_888_888_888_889,
        0.478_628_670_499_366,
        0.236_926_885_056_189,
    ];
    for damping in [0.0, 1e-6, 2.0, 50.0] {
        let motor = LinearMotor::new(2.0, damping).expect("valid").with_force_limit(40.0).expect("valid");
        let mut stepper = ZeroOrderHold::new(motor);
        let (mut state, mut ledger, t) = (vector![0.0, 0.0], EnergyLedger::default(), 1e-3);
        for k in 0..2000 {
            let input = vector![60.0 * (f64::from(k) * 0.01).cos()];
            let next = stepper.advance(&state, &input, t).expect("finite");
            ledger.input += motor.force(input[0]) * (next[0] - state[0]);
            ledger.stored += motor.kinetic_energy(&next) - motor.kinetic_energy(&state);
            for (node, weight) in nodes.iter().zip(weights) {
                let within = motor.transition(t * (1.0 + node) / 2.0).expect("finite");
                let velocity = within.apply(&state, &motor.realised(&input))[1];
                ledger.dissipated += damping * velocity * velocity * weight * t / 2.0;
            }
            state = next;
        }
        assert!(ledger.input > 0.1);
        assert!(ledger.relative_imbalance() < 1e-12, "{damping}: {ledger:?}");
    }
}

#[test]
fn a_loop_in_continuous_time_both_ways() {
    // The hardening spring under continuous PD control of a sine.
    let f = |t: f64, x: &Vector2<f64>| {
        hardening(x, &vector![5e3 * (0.1 * (7.0 * t).sin() - x[0]) + 100.0 * (0.7 * (7.0 * t).cos() - x[1])])
    };
    let mut fixed = Vec::new();
    integrate(f, vector![0.05, 0.0], 0.0, 1e-4, 10_000, |_, x| fixed.push(*x)).expect("valid");
    let mut adaptive = Vec::new();
    let tolerance = Tolerance::new(1e-10, 1e-10).expect("valid");
    integrate_adaptive(f, vector![0.05, 0.0], 0.0, 1e-2, 100, &tolerance, |_, x| adaptive.push(*x))
        .expect("regular");
    for (x, y) in fixed.iter().step_by(100).zip(&adaptive) {
        assert!((x - y).amax() < 1e-8, "{}", (x - y).amax());
    }
    assert_eq!(adaptive.len(), 101);
}

#[test]
fn a_spectral_radius_of_a_nonlinear_plant() {
    let steep = linearise(&hardening, &vector![0.4, 0.0], &vector![0.0]).expect("finite");
    // The stiffness at 0.4 m is 100 + 6000 * 0.16, the product of the poles.
    assert!((spectral_radius(steep.a()).expect("converges") - 1060.0_f64.sqrt()).abs() < 1e-6);
    assert_eq!(hardening.derivative(&vector![0.0, 1.0], &vector![2.0]), vector![1.0, 1.2]);
}
