//! Whatever comes in, what goes out is finite and within the limits, and a bad sample leaves no trace.

use control::{AntiWindup, DerivativeOn, Pid, PidGains, PidInput, PidState, Status};
use proptest::prelude::*;

macro_rules! any_input {
    ($real:ident) => {
        mod $real {
            use super::*;

            fn any_number() -> impl Strategy<Value = $real> {
                prop_oneof![
                    4 => -10.0 as $real..10.0,
                    2 => prop::num::$real::ANY,
                    1 => prop::num::$real::SUBNORMAL,
                    1 => prop::sample::select(vec![
                        $real::NAN, $real::INFINITY, $real::NEG_INFINITY, $real::MAX, $real::MIN, 0.0, -0.0,
                    ]),
                ]
            }

            fn any_time() -> impl Strategy<Value = $real> {
                prop_oneof![1e-6 as $real..1.0, prop::num::$real::POSITIVE]
            }

            fn any_anti_windup() -> impl Strategy<Value = AntiWindup<$real>> {
                prop_oneof![
                    Just(AntiWindup::None),
                    Just(AntiWindup::Clamping),
                    any_time().prop_map(|tracking_time| AntiWindup::BackCalculation { tracking_time }),
                ]
            }

            fn any_config() -> impl Strategy<Value = Pid<$real>> {
                let gains = (any_number(), any_number(), any_number());
                let limits = (any_number(), any_number());
                (gains, any_time(), any_time(), limits, any_anti_windup(), any::<bool>()).prop_filter_map(
                    "a valid configuration",
                    |((kp, ki, kd), period, tau, (lower, upper), anti_windup, measurement)| {
                        let on = if measurement { DerivativeOn::Measurement } else { DerivativeOn::Error };
                        Pid::new(PidGains { kp, ki, kd }, period)
                            .and_then(|p| p.with_derivative_filter(tau))
                            .and_then(|p| p.with_output_limits(lower, upper))
                            .and_then(|p| p.with_anti_windup(anti_windup))
                            .map(|p| p.with_derivative_on(on))
                            .ok()
                    },
                )
            }

            /// Gains and limits of an ordinary axis.
            fn usual_config() -> impl Strategy<Value = Pid<$real>> {
                (-1e3 as $real..1e3, -1e3 as $real..1e3, -1.0 as $real..1.0, any_anti_windup()).prop_filter_map(
                    "a valid configuration",
                    |(kp, ki, kd, anti_windup)| {
                        Pid::new(PidGains { kp, ki, kd }, 1e-3)
                            .and_then(|p| p.with_output_limits(-10.0, 20.0))
                            .and_then(|p| p.with_anti_windup(anti_windup))
                            .ok()
                    },
                )
            }

            fn any_sample() -> impl Strategy<Value = PidInput<$real>> {
                (any_number(), any_number(), any_number(), prop::option::of(any_number())).prop_map(
                    |(setpoint, measurement, feedforward, realised)| PidInput {
                        setpoint, measurement, feedforward, realised,
                    },
                )
            }

            #[derive(Debug, Clone)]
            enum Event {
                Tick(PidInput<$real>),
                Manual($real),
                Automatic,
                Preset($real, PidInput<$real>),
                TakeOver,
            }

            fn events() -> impl Strategy<Value = Vec<Event>> {
                let event = prop_oneof![
                    8 => any_sample().prop_map(Event::Tick),
                    1 => any_number().prop_map(Event::Manual),
                    1 => Just(Event::Automatic),
                    1 => (any_number(), any_sample()).prop_map(|(u, input)| Event::Preset(u, input)),
                    1 => Just(Event::TakeOver),
                ];
                prop::collection::vec(event, 1..60)
            }

            /// Runs `events`, changing between two configurations, and checks every answer; the configuration in
            /// force at the end.
            fn run(
                first: Pid<$real>,
                second: Pid<$real>,
                state: &mut PidState<$real>,
                events: Vec<Event>,
            ) -> Result<Pid<$real>, TestCaseError> {
                let (mut pid, mut other) = (first, second);
                for event in events {
                    let answer = match event {
                        Event::Tick(input) => Some(pid.update(state, input)),
                        Event::Preset(output, input) => Some(pid.preset(state, output, input)),
                        Event::Manual(output) => { state.set_manual(output); None }
                        Event::Automatic => { state.set_automatic(); None }
                        Event::TakeOver => {
                            other.take_over(&pid, state);
                            (pid, other) = (other, pid);
                            None
                        }
                    };
                    if let Some(answer) = answer {
                        let (lower, upper) = pid.output_limits();
                        prop_assert!(answer.output.is_finite(), "{answer:?}");
                        prop_assert!(lower <= answer.output && answer.output <= upper, "{answer:?}");
                    }
                    let memory = [state.integral(), state.derivative(), state.output()];
                    prop_assert!(memory.iter().all(|x| x.is_finite()), "{state:?}");
                }
                Ok(pid)
            }

            proptest! {
                #![proptest_config(ProptestConfig { max_global_rejects: 1 << 20, max_local_rejects: 1 << 20, ..ProptestConfig::with_cases(2048) })]

                #[test]
                fn the_output_is_finite_and_within_the_limits(
                    first in any_config(), second in any_config(), events in events(),
                ) {
                    run(first, second, &mut PidState::new(), events)?;
                }

                #[test]
                fn a_sample_that_is_not_finite_leaves_no_trace(
                    pid in any_config(), events in events(), sample in any_sample(), field in 0..4,
                    bad in prop::sample::select(vec![$real::NAN, $real::INFINITY, $real::NEG_INFINITY]),
                ) {
                    let mut state = PidState::new();
                    run(pid, pid, &mut state, events)?;
                    let input = match field {
                        0 => PidInput { setpoint: bad, ..sample },
                        1 => PidInput { measurement: bad, ..sample },
                        2 => PidInput { feedforward: bad, ..sample },
                        _ => PidInput { realised: Some(bad), ..sample },
                    };
                    // Debug prints the shortest digits that round-trip and the sign of zero: equal text, equal bits.
                    let before = format!("{state:?}");
                    prop_assert_eq!(pid.update(&mut state, input).status, Status::Held);
                    prop_assert_eq!(format!("{state:?}"), before);
                }

                #[test]
                fn two_ordinary_samples_always_bring_it_back(
                    first in usual_config(), second in usual_config(), events in events(),
                    samples in prop::array::uniform2((-10.0 as $real..10.0, -10.0 as $real..10.0)),
                ) {
                    let mut state = PidState::new();
                    let pid = run(first, second, &mut state, events)?;
                    let answers = samples.map(|(r, y)| pid.update(&mut state, PidInput::new(r, y)).status);
                    prop_assert!(answers[1] != Status::Held, "{answers:?} {state:?}");
                }
            }
        }
    };
}

any_input!(f32);
any_input!(f64);
