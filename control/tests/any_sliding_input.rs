//! Whatever comes into a sliding mode controller, what goes out is finite and within the limits, and a bad sample leaves no
//! trace.

use control::{
    AxisModel, DisturbanceInput, DisturbanceObserver, DisturbanceObserverState, ReachingLaw, Sampling,
    SlidingMode, SlidingModeInput, SlidingModeOutput, SlidingModeState, SlidingSurface, Status,
    SuperTwisting, SuperTwistingState, Switching,
};
use proptest::prelude::*;

macro_rules! any_input {
    ($real:ident, $far:expr) => {
        mod $real {
            use super::*;

            /// By way of an integer: the sampler of `f32` ranges asserts now and then.
            fn between(lower: $real, upper: $real) -> impl Strategy<Value = $real> {
                any::<u16>().prop_map(move |k| lower + (upper - lower) * ($real::from(k) / $real::from(u16::MAX)))
            }

            fn any_number() -> impl Strategy<Value = $real> {
                prop_oneof![
                    4 => between(-10.0, 10.0),
                    2 => prop::num::$real::ANY,
                    1 => prop::num::$real::SUBNORMAL,
                    1 => prop::sample::select(vec![
                        $real::NAN, $real::INFINITY, $real::NEG_INFINITY, $real::MAX, $real::MIN, 0.0, -0.0,
                    ]),
                ]
            }

            /// Mostly usual, so that a configuration of many is often valid.
            fn some() -> impl Strategy<Value = $real> {
                prop_oneof![8 => between(1e-3, 1e3), 1 => prop::num::$real::POSITIVE, 1 => Just(0.0)]
            }

            fn any_surface() -> impl Strategy<Value = SlidingSurface<$real>> {
                let exponents = prop::sample::select(vec![(9_u32, 5_u32), (5, 3), (101, 99), (199, 101), (7, 1)]);
                let parts = (0..4, some(), some(), between(1.0, 4.0), exponents, prop::option::of(some()));
                parts.prop_filter_map("valid", |(kind, alpha, beta, g, (p, q), guard)| {
                    let surface = match kind {
                        0 => SlidingSurface::linear(beta),
                        1 => SlidingSurface::terminal(alpha, beta, p, q),
                        2 => SlidingSurface::nonsingular_terminal(beta, p, q),
                        _ => SlidingSurface::fast_nonsingular_terminal(alpha, g, beta, p, q),
                    };
                    surface.and_then(|s| guard.map_or(Ok(s), |guard| s.with_guard(guard))).ok()
                })
            }

            fn any_law() -> impl Strategy<Value = ReachingLaw<$real>> {
                let shares = (between(0.001, 0.999), between(1.001, 4.0), some());
                (0..5, some(), some(), some(), shares, 0..3).prop_filter_map("valid", |(kind, k1, k2, k3, shares, sign)| {
                    let (near, far, width) = shares;
                    let law = match kind {
                        0 => ReachingLaw::constant(k1),
                        1 => ReachingLaw::exponential(k1, k2),
                        2 => ReachingLaw::power(k1, near),
                        3 => ReachingLaw::double_power(k1, far, k2, near),
                        _ => ReachingLaw::improved_double_power(k1, k2, k3, near, width),
                    };
                    let switching = match sign {
                        0 => Switching::Sign,
                        1 => Switching::Saturation { width },
                        _ => Switching::Smooth { width },
                    };
                    law.and_then(|law| law.with_switching(switching)).ok()
                })
            }

            fn any_sampling() -> impl Strategy<Value = Sampling> {
                prop::sample::select(vec![Sampling::Explicit, Sampling::Implicit, Sampling::Matched])
            }

            fn any_model() -> impl Strategy<Value = AxisModel<$real>> {
                (some(), some(), any_number())
                    .prop_filter_map("valid", |(a, b, k)| AxisModel::new(a, b, k).ok())
            }

            #[derive(Debug, Clone, Copy)]
            enum Controller {
                Sliding(SlidingMode<$real>),
                Twisting(SuperTwisting<$real>),
            }

            #[derive(Debug, Clone, Copy, PartialEq, Default)]
            struct State(SlidingModeState<$real>, SuperTwistingState<$real>);

            impl Controller {
                fn update(&self, state: &mut State, input: SlidingModeInput<$real>) -> SlidingModeOutput<$real> {
                    match self {
                        Self::Sliding(sliding) => sliding.update(&mut state.0, input),
                        Self::Twisting(twisting) => twisting.update(&mut state.1, input),
                    }
                }

                fn limits(&self) -> ($real, $real) {
                    match self {
                        Self::Sliding(sliding) => sliding.output_limits(),
                        Self::Twisting(twisting) => twisting.output_limits(),
                    }
                }
            }

            fn any_controller() -> impl Strategy<Value = Controller> {
                let parts = (any_surface(), any_law(), any_model(), any_sampling());
                let numbers = (some(), some(), some(), between(1e-6, 1.0), any_number(), any_number());
                (parts, numbers, any::<bool>()).prop_filter_map("valid", |(parts, numbers, twisting)| {
                    let (surface, law, model, sampling) = parts;
                    let (k1, k2, k4, period, lower, upper) = numbers;
                    if twisting {
                        SuperTwisting::new(surface, k1, k2, model, period)
                            .and_then(|c| c.with_sampling(sampling).with_output_limits(lower, upper))
                            .map(Controller::Twisting)
                            .ok()
                    } else {
                        SlidingMode::new(surface, law, model, period)
                            .and_then(|c| c.with_sampling(sampling))
                            .and_then(|c| c.with_integral_compensation(k4))
                            .and_then(|c| c.with_output_limits(lower, upper))
                            .map(Controller::Sliding)
                            .ok()
                    }
                })
            }

            fn any_sample() -> impl Strategy<Value = SlidingModeInput<$real>> {
                let numbers = prop::array::uniform6(any_number());
                (numbers, prop::option::of(any_number())).prop_map(|(numbers, realised)| {
                    let [error, error_rate, reference_acceleration, position, velocity, load] = numbers;
                    SlidingModeInput {
                        error, error_rate, reference_acceleration, position, velocity, load, realised,
                    }
                })
            }

            fn run(
                controller: &Controller,
                state: &mut State,
                samples: &[SlidingModeInput<$real>],
            ) -> Result<(), TestCaseError> {
                let (lower, upper) = controller.limits();
                for sample in samples {
                    let answer = controller.update(state, *sample);
                    prop_assert!(answer.output.is_finite() && answer.surface.is_finite(), "{answer:?}");
                    prop_assert!(lower <= answer.output && answer.output <= upper, "{answer:?}");
                    let memory = [state.0.integral(), state.0.output(), state.1.integral(), state.1.output()];
                    prop_assert!(memory.iter().all(|x| x.is_finite()), "{state:?}");
                }
                Ok(())
            }

            /// The paper's controller, and a fast non-singular one, unlimited.
            fn usual(sampling: Sampling) -> [SlidingMode<$real>; 2] {
                let third = 1.0 / 3.0;
                let law = ReachingLaw::improved_double_power(20.0, 20.0, 200.0, third, third).expect("valid");
                let model = AxisModel::new(10.0, 1.0, 1.0).expect("valid");
                let terminal = SlidingSurface::terminal(10.0, 1.0, 9, 5).expect("valid");
                let fast = SlidingSurface::fast_nonsingular_terminal(1.0, 2.0, 3.0, 5, 3).expect("valid");
                [terminal, fast].map(|surface| {
                    SlidingMode::new(surface, law, model, 1e-3)
                        .and_then(|c| c.with_sampling(sampling))
                        .and_then(|c| c.with_integral_compensation(20.0))
                        .expect("valid")
                })
            }

            /// From the smallest subnormal number to the largest for which the law itself has a value.
            fn any_finite() -> impl Strategy<Value = $real> {
                let far: $real = $far;
                prop_oneof![
                    any_number().prop_filter_map("finite", move |x| (x.abs() <= far).then_some(x)),
                    prop::num::$real::SUBNORMAL,
                    prop::sample::select(vec![
                        0.0, -0.0, $real::MIN_POSITIVE, -$real::MIN_POSITIVE, $real::from_bits(1), far, -far,
                    ]),
                ]
            }

            proptest! {
                #![proptest_config(ProptestConfig { max_global_rejects: 1 << 20, max_local_rejects: 1 << 20, ..ProptestConfig::with_cases(2048) })]

                #[test]
                fn the_output_is_finite_and_within_the_limits(
                    controller in any_controller(), samples in prop::collection::vec(any_sample(), 1..40),
                ) {
                    run(&controller, &mut State::default(), &samples)?;
                }

                #[test]
                fn a_sample_that_is_not_finite_leaves_no_trace(
                    controller in any_controller(), samples in prop::collection::vec(any_sample(), 0..20),
                    sample in any_sample(), field in 0..7,
                    bad in prop::sample::select(vec![$real::NAN, $real::INFINITY, $real::NEG_INFINITY]),
                ) {
                    let mut state = State::default();
                    run(&controller, &mut state, &samples)?;
                    let input = match field {
                        0 => SlidingModeInput { error: bad, ..sample },
                        1 => SlidingModeInput { error_rate: bad, ..sample },
                        2 => SlidingModeInput { reference_acceleration: bad, ..sample },
                        3 => SlidingModeInput { position: bad, ..sample },
                        4 => SlidingModeInput { velocity: bad, ..sample },
                        5 => SlidingModeInput { load: bad, ..sample },
                        _ => SlidingModeInput { realised: Some(bad), ..sample },
                    };
                    // Debug prints the shortest digits that round-trip and the sign of zero: equal text, equal bits.
                    let before = format!("{state:?}");
                    prop_assert_eq!(controller.update(&mut state, input).status, Status::Held);
                    prop_assert_eq!(format!("{state:?}"), before);
                }

                #[test]
                fn every_finite_state_has_its_answer(
                    error in any_finite(), error_rate in any_finite(), position in any_finite(), velocity in any_finite(),
                    matched: bool,
                ) {
                    let sampling = if matched { Sampling::Matched } else { Sampling::Explicit };
                    for controller in usual(sampling) {
                        let input = SlidingModeInput { position, velocity, ..SlidingModeInput::default() };
                        let input = input.with_error(error, error_rate);
                        let answer = controller.update(&mut SlidingModeState::new(), input);
                        prop_assert_eq!(answer.status, Status::Regular, "{:?}", input);
                        prop_assert!(answer.output.is_finite(), "{answer:?}");
                    }
                }

                #[test]
                fn the_singular_term_is_within_its_bound(error in any_finite(), error_rate in any_finite()) {
                    // No law, no model: what is left is alpha e' and the singular term, at most e' / (4 h).
                    let surface = SlidingSurface::<$real>::terminal(10.0, 1.0, 9, 5).expect("valid");
                    let (h, smallest) = (1e-3 as $real, $real::MIN_POSITIVE);
                    let law = ReachingLaw::constant(smallest).expect("valid");
                    let model = AxisModel::new(0.0, 0.0, 1.0).expect("valid");
                    let controller = SlidingMode::new(surface, law, model, h).expect("valid");
                    let input = SlidingModeInput::default().with_error(error, error_rate);
                    let answer = controller.update(&mut SlidingModeState::new(), input);
                    prop_assert_eq!(answer.status, Status::Regular);
                    // The guard is a power of twenty some e-foldings, each of which is rounded.
                    let bound = (10.0 + 0.25 / h) * error_rate.abs() * (1.0 + 64.0 * $real::EPSILON) + smallest;
                    prop_assert!(answer.output.abs() <= bound, "{} {bound}", answer.output);
                }

                #[test]
                fn an_ordinary_sample_brings_it_back(
                    samples in prop::collection::vec(any_sample(), 0..20), error in between(-1.0, 1.0), rate in between(-1.0, 1.0),
                ) {
                    for controller in usual(Sampling::Explicit) {
                        let controller = controller.with_output_limits(-400.0, 400.0).expect("valid");
                        let mut state = State::default();
                        run(&Controller::Sliding(controller), &mut state, &samples)?;
                        let input = SlidingModeInput::default().with_error(error, rate);
                        prop_assert!(controller.update(&mut state.0, input).status != Status::Held);
                    }
                }

                #[test]
                fn an_observer_stays_finite_and_keeps_its_state(
                    model in any_model(), bandwidth in some(), period in between(1e-5, 1.0),
                    samples in prop::collection::vec((any_number(), any_number()), 0..40),
                    bad in prop::sample::select(vec![$real::NAN, $real::INFINITY, $real::NEG_INFINITY]),
                    of_position: bool,
                ) {
                    let Ok(observer) = DisturbanceObserver::new(model, bandwidth, period) else {
                        return Ok(());
                    };
                    let mut state = DisturbanceObserverState::new();
                    for (position, realised) in samples {
                        let estimate = observer.update(&mut state, DisturbanceInput { position, realised });
                        let numbers = [estimate.position, estimate.velocity, estimate.load];
                        prop_assert!(numbers.iter().all(|x| x.is_finite()), "{estimate:?}");
                    }
                    let input = DisturbanceInput { position: 0.5, realised: 0.5 };
                    let input = if of_position {
                        DisturbanceInput { position: bad, ..input }
                    } else {
                        DisturbanceInput { realised: bad, ..input }
                    };
                    let before = format!("{state:?}");
                    prop_assert!(observer.update(&mut state, input).is_held);
                    prop_assert_eq!(format!("{state:?}"), before);
                }
            }
        }
    };
}

// The fast surface squares the error, and the law takes that to the power of 5/3.
any_input!(f32, 1e10);
any_input!(f64, 1e90);
