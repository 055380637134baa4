//! The estimate follows the load as its transfer function says, on an axis simulated by other means.
#![expect(clippy::expect_used, reason = "a helper that fails fails its test")]

mod axis;

use axis::{Axis, model};
use control::{
    AxisModel, DisturbanceInput, DisturbanceObserver, DisturbanceObserverState, ReachingLaw, SlidingMode,
    SlidingModeInput, SlidingModeState, SlidingSurface,
};
use profiles::Sample;

const H: f64 = 1e-3;

/// The estimates over `ticks` periods of an axis under a load, `u = 3 sin(50 t)` and a controller that does nothing.
fn estimates(axis: &AxisModel, bandwidth: f64, load: impl Fn(u32) -> f64, ticks: u32) -> Vec<f64> {
    let observer = DisturbanceObserver::new(*axis, bandwidth, H).expect("valid");
    let mut state = DisturbanceObserverState::new();
    let mut plant = Axis::default();
    let mut input = 0.0;
    (0..ticks)
        .map(|tick| {
            let measured = DisturbanceInput { position: plant.position, realised: input };
            let estimate = observer.update(&mut state, measured);
            input = 3.0 * (50.0 * f64::from(tick) * H).sin();
            plant.advance(axis, input, load(tick), H);
            estimate.load
        })
        .collect()
}

#[test]
fn the_estimate_is_the_load_through_its_transfer_function() {
    for (axis, bandwidth) in [
        (model(), 300.0),
        (AxisModel::new(0.0, 0.0, 2.0).expect("valid"), 100.0),
        (AxisModel::new(2.0, 4e4, -1.0).expect("valid"), 500.0),
    ] {
        let load = |tick: u32| 7.0 * (0.08 * f64::from(tick)).sin() + if tick > 40 { -4.0 } else { 0.0 };
        let measured = estimates(&axis, bandwidth, load, 300);

        // D(z) = (1 - m)^3 z (z + c) / ((1 + c) (z - m)^3) as a difference equation; the zero -c is that of the axis
        // sampled with a held load, from its step response over one period and two.
        let position_after = |periods: u32| {
            let mut plant = Axis::default();
            plant.advance(&axis, 0.0, 1.0, H);
            (1..periods).for_each(|_| plant.advance(&axis, 0.0, 0.0, H));
            plant.position
        };
        // The impulse response of (b1 z + b0) / (z^2 - T z + D) begins with b1, b0 + T b1; T from the axis let go.
        let let_go = |position: f64, velocity: f64| {
            let mut plant = Axis { position, velocity };
            plant.advance(&axis, 0.0, 0.0, H);
            plant
        };
        let trace = let_go(1.0, 0.0).position + let_go(0.0, 1.0).velocity;
        let first = position_after(1);
        let zero = (position_after(2) - trace * first) / first;
        let m = (-bandwidth * H).exp();
        let gain = (1.0 - m).powi(3) / (1.0 + zero);
        let mut estimated = vec![0.0; 300];
        for tick in 0..300_usize {
            let at = |signal: &dyn Fn(usize) -> f64, back: usize| tick.checked_sub(back).map_or(0.0, signal);
            let past = |back| at(&|i| estimated[i], back);
            let loads = |back| at(&|i| load(i as u32), back);
            estimated[tick] = 3.0 * m * past(1) - 3.0 * m * m * past(2)
                + m * m * m * past(3)
                + gain * (loads(1) + zero * loads(2));
        }
        for (tick, (ours, theirs)) in measured.iter().zip(&estimated).enumerate() {
            // The simulated position is good to 1e-14 or so, and the gain of the load is up to w^3 h.
            let tolerance = 1e-13 * bandwidth.powi(3) * H + 1e-9;
            assert!((ours - theirs).abs() < tolerance, "{tick}: {ours} {theirs}");
        }
    }
}

#[test]
fn velocity_and_position_come_with_it() {
    let observer = DisturbanceObserver::new(model(), 200.0, H).expect("valid");
    let mut plant = Axis { position: 0.3, velocity: -1.0 };
    let mut state = DisturbanceObserverState::at(0.2, 0.0);
    // Errors decay as n^2 m^n: e^-60 of 90 after 0.3 s.
    for tick in 0..300 {
        let input = if tick % 7 < 3 { 20.0 } else { -15.0 };
        plant.advance(&model(), input, 5.0, H);
        let measured = DisturbanceInput { position: plant.position, realised: input };
        let _ = observer.update(&mut state, measured);
    }
    let estimate = state.estimate();
    assert!((estimate.position - plant.position).abs() < 1e-13);
    assert!((estimate.velocity - plant.velocity).abs() < 1e-11);
    assert!((estimate.load - 5.0).abs() < 1e-8);
}

/// PD with feedforward, which is a linear surface with a linear law, and the load subtracted.
#[test]
fn a_constant_load_leaves_no_error_and_a_slow_one_what_theory_says() {
    let (c, k, bandwidth) = (40.0, 80.0, 500.0);
    let surface = SlidingSurface::linear(c).expect("valid");
    let law = ReachingLaw::exponential(k, 0.0).expect("valid");
    let controller = SlidingMode::new(surface, law, model(), H).expect("valid");
    let observer = DisturbanceObserver::new(model(), bandwidth, H).expect("valid");
    let error_after = |load: &dyn Fn(f64) -> f64, time: f64| {
        let (mut state, mut seen) = (SlidingModeState::new(), DisturbanceObserverState::new());
        let mut plant = Axis::default();
        for tick in 0..(time / H) as u32 {
            let realised = state.output();
            let measured = DisturbanceInput { position: plant.position, realised };
            let estimate = observer.update(&mut seen, measured);
            let input = SlidingModeInput {
                load: estimate.load,
                ..SlidingModeInput::new(&Sample::default(), plant.position, plant.velocity)
            };
            let output = controller.update(&mut state, input).output;
            plant.advance(&model(), output, load(f64::from(tick) * H), H);
        }
        -plant.position
    };
    let constant = error_after(&|_| 10.0, 2.0);
    assert!(constant.abs() < 1e-13, "{constant}");
    // A ramp of 10 m/s^3 is seen late by the delay of D(z) at z = 1, -D'(1) periods, and what is not seen leaves
    // e = (estimate - load) / (c k).
    let ramp = error_after(&|t| 10.0 * t, 2.0);
    let late = 3.0 / (1.0 - (-bandwidth * H).exp()) - 1.5;
    let theory = -10.0 * late * H / (c * k);
    // With c = 1 in D(z), true to a h / 3.
    assert!((ramp / theory - 1.0).abs() < 10.0 * H / 3.0, "{ramp} {theory}");
}
