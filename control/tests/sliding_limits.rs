//! Limits, changes of configuration, several axes.
#![expect(clippy::float_cmp, reason = "numbers that must be equal to the bit")]
#![expect(clippy::expect_used, reason = "a helper that fails fails its test")]

mod axis;

use axis::{Axis, model, sine};
use control::{
    CrossCoupling, PathFrame, ReachingLaw, Sampling, SlidingMode, SlidingModeInput, SlidingModeState,
    SlidingSurface, Status, SuperTwisting, SuperTwistingState,
};
use profiles::Sample;
use proptest::prelude::*;

fn dsmc(h: f64) -> SlidingMode {
    let surface = SlidingSurface::terminal(10.0, 1.0, 9, 5).expect("valid");
    let law = ReachingLaw::improved_double_power(20.0, 20.0, 200.0, 1.0 / 3.0, 1.0 / 3.0).expect("valid");
    SlidingMode::new(surface, law, model(), h)
        .and_then(|c| c.with_integral_compensation(20.0))
        .expect("valid")
}

#[test]
fn the_integral_does_not_wind_up_at_a_limit() {
    // Three metres off with an output of at most 12: limited for most of a second, and one period's integral of the error a
    // thousandth of what unlimited integration would gather.
    let h = 1e-3;
    let limited = dsmc(h).with_output_limits(-12.0, 12.0).expect("valid");
    let mut axis = Axis { position: -3.0, velocity: 0.0 };
    let mut state = SlidingModeState::new();
    let (mut at_limit, mut overshoot) = (0, 0.0_f64);
    for _ in 0..20_000 {
        let output = limited.update(&mut state, axis.input(&Sample::default()));
        at_limit += u32::from(output.status != Status::Regular);
        axis.advance(&model(), output.output, 0.0, h);
        overshoot = overshoot.max(axis.position);
    }
    assert!(at_limit > 500, "{at_limit}");
    // Wound up, 20 times the integral of e over the limited time, some 30, would push it far over.
    assert!(overshoot < 1e-3, "{overshoot}");
    assert!(state.integral().abs() < 1.0 && axis.position.abs() < 1e-4, "{state:?} {axis:?}");
}

#[test]
fn what_the_actuator_did_counts() {
    let controller = dsmc(1e-3);
    let mut state = SlidingModeState::new();
    let input = SlidingModeInput::default().with_error(0.5, 0.0);
    let output = controller.update(&mut state, input).output;
    let integral = state.integral();
    assert!(integral > 0.0);
    // The actuator fell short: an error in the same direction adds nothing, one the other way does.
    let short = SlidingModeInput { realised: Some(output - 1.0), ..input };
    let _ = controller.update(&mut state, short);
    assert_eq!(state.integral(), integral);
    let short = SlidingModeInput { realised: Some(state.output() - 1.0), ..input.with_error(-0.5, 0.0) };
    let _ = controller.update(&mut state, short);
    // 20 * 1e-3 * 0.5 off again
    assert!(state.integral().abs() < 1e-17, "{state:?}");
}

#[test]
fn super_twisting_does_not_wind_up_either() {
    let h = 1e-3;
    for sampling in [Sampling::Explicit, Sampling::Implicit, Sampling::Matched] {
        let surface = SlidingSurface::linear(10.0).expect("valid");
        let controller = SuperTwisting::for_load_rate(surface, 400.0, model(), h)
            .and_then(|c| c.with_sampling(sampling).with_output_limits(-12.0, 12.0))
            .expect("valid");
        let mut axis = Axis { position: -3.0, velocity: 0.0 };
        let mut state = SuperTwistingState::new();
        let (mut at_limit, mut overshoot) = (0, 0.0_f64);
        for _ in 0..5_000 {
            let output = controller.update(&mut state, axis.input(&Sample::default()));
            at_limit += u32::from(output.status != Status::Regular);
            axis.advance(&model(), output.output, 0.0, h);
            overshoot = overshoot.max(axis.position);
        }
        // Wound up, v would stand at 440 times the limited time.
        assert!(at_limit > 500 && overshoot < 0.05, "{sampling:?} {at_limit} {overshoot}");
        assert!(
            axis.position.abs() < 1e-3 && state.integral().abs() < 13.0,
            "{sampling:?} {axis:?} {state:?}"
        );
    }
}

proptest! {
    #[test]
    fn a_change_of_laws_makes_no_bump(
        e in -1.0..1.0, rate in -2.0..2.0, x in -1.0..1.0, v in -2.0..2.0, k in 1.0..100.0, c in 1.0..50.0,
    ) {
        let old = dsmc(1e-3);
        let new = SlidingMode::new(
            SlidingSurface::linear(c).expect("valid"),
            ReachingLaw::exponential(k, 5.0).expect("valid"),
            model(),
            1e-3,
        ).expect("valid");
        let input = SlidingModeInput { position: x, velocity: v, ..SlidingModeInput::default() };
        let input = input.with_error(e, rate);
        let mut state = SlidingModeState::new();
        let before = old.update(&mut state, input).output;
        new.take_over(&old, &mut state, &input);
        let after = new.update(&mut state, input).output;
        // Both outputs are sums of terms up to some thousand.
        prop_assert!((after - before).abs() < 1e-11, "{before} {after}");
    }

    #[test]
    fn three_axes_without_coupling_are_three_single_axes(
        position in prop::array::uniform3(-1.0..1.0), velocity in prop::array::uniform3(-2.0..2.0), lambda in 0.01..1.0,
    ) {
        let controller = dsmc(1e-3);
        let references: [Sample; 3] = [0.1, 0.7, 2.0].map(sine);
        let inputs: [SlidingModeInput; 3] =
            core::array::from_fn(|i| SlidingModeInput::new(&references[i], position[i], velocity[i]));
        let path = PathFrame::along(references.map(|r| r.velocity)).expect("moving");
        let run = |gain: f64| {
            let coupling = CrossCoupling::uniform(gain).expect("valid");
            let coupled = coupling.couple(inputs.map(|i| i.error), inputs.map(|i| i.error_rate), path.as_ref());
            let mut axes = [SlidingModeState::new(); 3];
            let outputs: [f64; 3] = core::array::from_fn(|i| {
                let input = inputs[i].with_error(coupled.errors[i], coupled.rates[i]);
                controller.update(&mut axes[i], input).output
            });
            outputs.map(f64::to_bits)
        };
        let single = inputs.map(|input| controller.update(&mut SlidingModeState::new(), input).output.to_bits());
        prop_assert_eq!(run(0.0), single);
        prop_assert_ne!(run(lambda), single);
    }
}
