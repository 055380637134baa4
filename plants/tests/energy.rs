//! Where the energy goes, for every plant that knows.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use plants::nalgebra::{SVector, vector};
use plants::{
    Clock, ControlTick, Energetic, EnergyLedger, HeldEnergetic, LinearMotor, Pmsm, PmsmDrive, PmsmWindings,
    Rk4, Simulation, Stepper, TwoInertia, ZeroOrderHold, linearise, spectral_radius,
};
use proptest::prelude::*;

fn axis() -> TwoInertia {
    TwoInertia::new(0.003, 5.066e-4, 100.0).and_then(|a| a.with_damping(0.008, 0.006, 0.002)).expect("valid")
}

fn windings() -> PmsmWindings {
    PmsmWindings::new(2.875, 8.5e-3, 11e-3, 0.175, 3)
        .and_then(|w| w.with_voltage_limit(250.0))
        .expect("valid")
}

fn motor() -> Pmsm {
    Pmsm::new(windings(), 0.003).and_then(|m| m.with_friction(0.008)).expect("valid")
}

fn drive() -> PmsmDrive {
    PmsmDrive::new(windings(), axis())
}

/// Every plant stores a quadratic form, so that its growth along the motion is a difference without error.
fn balances<const N: usize, const M: usize>(
    plant: &impl Energetic<N, M>,
    state: SVector<f64, N>,
    input: SVector<f64, M>,
) -> Result<(), TestCaseError> {
    let rate = plant.derivative(&state, &input);
    let span = state.norm() / rate.norm();
    let growth = (plant.stored(&(state + rate * span)) - plant.stored(&(state - rate * span))) / (2.0 * span);
    let powers = plant.powers(&state, &input);
    // The difference cancels to the growth from the energies, the flows cancel to it from each other.
    let size = plant.stored(&(state + rate * span)) / span
        + powers.input.abs()
        + powers.dissipated
        + powers.delivered.abs();
    prop_assert!((growth - powers.net()).abs() <= 1e-13 * size, "{growth} {powers:?}");
    prop_assert!(powers.dissipated >= 0.0 && plant.stored(&state) >= 0.0);
    Ok(())
}

fn entries<const N: usize>(sizes: [f64; N]) -> impl Strategy<Value = SVector<f64, N>> {
    prop::collection::vec(-1.0..1.0, N).prop_map(move |units| SVector::from_fn(|i, _| units[i] * sizes[i]))
}

proptest! {
    #[test]
    fn the_equations_conserve_energy(
        linear in entries([1.0, 0.5]), force in entries([80.0]),
        mechanics in entries([0.1, 30.0, 0.1, 30.0]), torques in entries([5.0, 2.0]),
        rotor in entries([8.0, 8.0, 3.0, 200.0]),
        coupled in entries([8.0, 8.0, 0.1, 30.0, 0.1, 30.0]),
        // Half of them beyond the voltage limit.
        voltages in entries([350.0, 350.0, 2.0])
    ) {
        let carriage = LinearMotor::new(2.0, 5.0).and_then(|m| m.with_force_limit(50.0)).expect("valid");
        balances(&carriage, linear, force)?;
        balances(&axis(), mechanics, torques)?;
        balances(&motor(), rotor, voltages)?;
        balances(&drive(), coupled, voltages)?;
    }
}

const STEPS: u32 = 20_000;

// The rounding of a transition is the same in every step and adds up.
const ROUNDING: f64 = STEPS as f64 * f64::EPSILON;

/// The ledger of two seconds of an exact plant under changing inputs.
fn held<const N: usize, const M: usize, L: HeldEnergetic<N, M>>(
    model: L,
    input: impl Fn(f64) -> SVector<f64, M>,
) -> EnergyLedger {
    let mut stepper = ZeroOrderHold::new(model).metered();
    let mut state = SVector::zeros();
    for k in 0..STEPS {
        // Three lengths in turn, as a split step has them.
        let interval = [1e-4, 0.3e-4, 1.7e-4][k as usize % 3];
        state = stepper.advance(&state, &input(1e-4 * f64::from(k)), interval).expect("finite");
    }
    *stepper.ledger()
}

#[test]
fn exact_plants_close_to_rounding() {
    let torques = |t: f64| vector![(30.0 * t).sin() + 0.2, if t > 1.0 { 0.3 } else { 0.0 }];
    let force = |t: f64| vector![40.0 * (9.0 * t).cos() + 12.0];
    for damping in [[0.0; 3], [0.008, 0.006, 0.002], [0.0, 0.3, 0.0], [1e-9, 1e-9, 1e-9]] {
        let axis = TwoInertia::new(0.003, 5.066e-4, 100.0)
            .and_then(|a| a.with_damping(damping[0], damping[1], damping[2]))
            .expect("valid");
        let ledger = held(axis, torques);
        assert!(ledger.input > 0.1, "{ledger:?}");
        assert!(
            ledger.relative_imbalance() < ROUNDING,
            "{damping:?}: {} {ledger:?}",
            ledger.relative_imbalance()
        );
    }
    for damping in [0.0, 1e-6, 2.0, 50.0] {
        let motor = LinearMotor::new(2.0, damping)
            .and_then(|m| m.driven_by_current(1.5)?.with_force_limit(40.0))
            .expect("valid");
        let ledger = held(motor, force);
        assert!(ledger.input > 0.1 && ledger.relative_imbalance() < ROUNDING, "{damping}: {ledger:?}");
    }
}

#[test]
fn a_metered_step_is_the_step() {
    let (mut plain, mut metered) = (ZeroOrderHold::new(axis()), ZeroOrderHold::new(axis()).metered());
    let (mut plain_rk4, mut metered_rk4) =
        (Rk4::fixed(drive(), 3, 0.0).expect("valid"), Rk4::fixed(drive(), 3, 0.0).expect("valid").metered());
    let (mut x, mut y) = (vector![0.0, 1.0, 0.01, 0.0], vector![0.0, 1.0, 0.01, 0.0]);
    let (mut v, mut w) = (SVector::<f64, 6>::zeros(), SVector::<f64, 6>::zeros());
    for k in 0..500 {
        let (torque, voltage) = (vector![f64::from(k % 7) - 3.0, 0.1], vector![5.0, f64::from(k % 50), 0.2]);
        x = plain.advance(&x, &torque, 1e-4).expect("finite");
        y = metered.advance(&y, &torque, 1e-4).expect("finite");
        v = plain_rk4.advance(&v, &voltage, 1e-4).expect("finite");
        w = metered_rk4.advance(&w, &voltage, 1e-4).expect("finite");
        assert_eq!((x, v), (y, w));
    }
    let ledger = metered_rk4.take_ledger();
    assert!(ledger.input > 0.0);
    assert_eq!(metered_rk4.ledger(), &EnergyLedger::default());
}

/// The ledger of 0.1 s in steps of 1 ms, `substeps` for each; all of them when `None`.
fn stepped<const N: usize, const M: usize, P: Energetic<N, M> + Copy>(
    plant: P,
    state: SVector<f64, N>,
    input: impl Fn(f64) -> SVector<f64, M>,
    substeps: Option<u32>,
) -> EnergyLedger {
    let radius =
        spectral_radius(linearise(&plant, &state, &input(0.0)).expect("smooth").a()).expect("converges");
    let mut stepper = match substeps {
        Some(substeps) => Rk4::fixed(plant, substeps, radius),
        None => Rk4::accurate(plant, radius),
    }
    .expect("valid")
    .metered();
    let mut state = state;
    for k in 0..100 {
        state = stepper.advance(&state, &input(1e-3 * f64::from(k)), 1e-3).expect("stable");
    }
    stepper.take_ledger()
}

fn closes_with_order_four<const N: usize, const M: usize, P: Energetic<N, M> + Copy>(
    plant: P,
    state: SVector<f64, N>,
    input: impl Fn(f64) -> SVector<f64, M>,
) {
    let imbalance = |substeps| stepped(plant, state, &input, Some(substeps)).imbalance();
    for substeps in [8, 16] {
        let ratio = imbalance(substeps) / imbalance(2 * substeps);
        // The next order is smaller by the step, |lambda| h < 0.1.
        assert!((ratio / 16.0 - 1.0).abs() < 0.1, "{ratio}");
    }
    let ledger = stepped(plant, state, &input, None);
    assert!(ledger.relative_imbalance() < 1e-6, "{} {ledger:?}", ledger.relative_imbalance());
}

#[test]
fn runge_kutta_closes_with_its_order() {
    let torques = |t: f64| vector![(60.0 * t).sin() + 0.2, 0.3];
    // Of an undamped vibration the energy errs with the fifth power: the damping must count.
    let axis = axis().with_damping(0.05, 0.2, 0.02).expect("valid");
    closes_with_order_four(axis, vector![0.01, 3.0, 0.0, 0.0], torques);
    let voltages = |t: f64| vector![20.0 * (90.0 * t).sin(), 40.0 + 20.0 * (70.0 * t).cos(), 0.3];
    closes_with_order_four(motor(), vector![1.0, 2.0, 0.0, 5.0], voltages);
    closes_with_order_four(drive(), vector![1.0, 2.0, 0.01, 5.0, 0.0, 5.0], voltages);
    let carriage = LinearMotor::new(0.2, 80.0).expect("valid");
    closes_with_order_four(carriage, vector![0.0, 1.0], |t| vector![60.0 * (90.0 * t).cos()]);
}

#[test]
fn a_simulation_fills_the_ledger() {
    let drive = drive();
    let mut stepper = Rk4::fixed(drive, 1, 0.0).expect("valid").metered();
    let clock = Clock::from_frequency(10_000).expect("not zero");
    let outcome = Simulation::new(clock, 5_000)
        .delay(0.5)
        .expect("valid")
        .saturation(drive.saturation())
        .run(
            &mut stepper,
            SVector::zeros(),
            &mut (),
            |_, tick: &ControlTick<'_, 6, 3>| {
                let x = tick.state;
                // Beyond the voltage limit at first.
                vector![
                    -4.0 * x[0],
                    60.0 * (20.0 - x[3]) - 4.0 * x[1],
                    if tick.time > 0.2 { 1.0 } else { 0.0 }
                ]
            },
            [("load speed", "rad/s")],
            |(), probe| [probe.state[5]],
        )
        .expect("valid");
    let ledger = stepper.ledger();
    assert!((ledger.stored - drive.stored(outcome.state())).abs() < 1e-13 * ledger.input);
    assert!(ledger.delivered > 1.0 && ledger.dissipated > 1.0, "{ledger:?}");
    // 483 rad/s in steps of 50 us: a tenth of the accurate step.
    assert!(ledger.relative_imbalance() < 1e-6, "{} {ledger:?}", ledger.relative_imbalance());
    outcome.completed().expect("stable");
}
