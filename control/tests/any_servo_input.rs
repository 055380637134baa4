//! Whatever comes into a servo, what goes out is finite and within the limits, and a bad sample leaves no trace.

use control::{
    AntiWindup, Cascade, CurrentLoop, CurrentStatus, Dq, Feedforward, FieldOriented, FieldOrientedInput,
    FieldOrientedOutput, FieldOrientedState, Phases, PiGains, Rotation, Status,
};
use profiles::Sample;
use proptest::prelude::*;

macro_rules! any_input {
    ($real:ident) => {
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

            fn any_dq() -> impl Strategy<Value = Dq<$real>> {
                (any_number(), any_number()).prop_map(|(d, q)| Dq { d, q })
            }

            fn any_gains() -> impl Strategy<Value = PiGains<$real>> {
                (some(), some()).prop_map(|(kp, ki)| PiGains { kp, ki })
            }

            fn any_control() -> impl Strategy<Value = FieldOriented<$real>> {
                let outer = (some(), any_gains(), between(0.0, 1.0), some(), some(), some());
                let inner = (any_gains(), any_gains(), prop::array::uniform3(some()), some());
                let rates = (between(1e-6, 1.0), 1_u32..4, 1_u32..4, 1_u32..9, any::<bool>());
                (outer, inner, rates).prop_filter_map("valid", |(outer, inner, rates)| {
                    let (position_gain, gains, share, speed, current, acceleration) = outer;
                    let (d, q, [d_inductance, q_inductance, flux], voltage) = inner;
                    let (period, every, each, pole_pairs, clamping) = rates;
                    let back = AntiWindup::BackCalculation { tracking_time: 0.1 };
                    let cascade = Cascade::new(position_gain, gains, period)
                        .and_then(|c| c.with_divisors(every, each))
                        .and_then(|c| c.with_velocity_feedforward(share))
                        .and_then(|c| c.with_velocity_limit(speed))
                        .and_then(|c| c.with_current_limit(current))
                        .and_then(|c| c.with_anti_windup(if clamping { AntiWindup::Clamping } else { back }))
                        .ok()?
                        .with_feedforward(Feedforward::NONE.with_acceleration(acceleration).ok()?);
                    let current_loop = CurrentLoop::new(d, q, period)
                        .and_then(|l| l.with_decoupling(d_inductance, q_inductance, flux))
                        .and_then(|l| l.with_voltage_limit(voltage))
                        .ok()?;
                    FieldOriented::new(cascade, current_loop, pole_pairs).ok()
                })
            }

            /// An ordinary servo.
            fn usual_control(position_gain: $real, pole_pairs: u32) -> FieldOriented<$real> {
                let gains = PiGains { kp: 2.0, ki: 30.0 };
                let cascade = Cascade::new(position_gain, gains, 1e-4)
                    .and_then(|c| c.with_current_limit(20.0))
                    .expect("valid");
                let gains = PiGains { kp: 16.0, ki: 5e3 };
                let current_loop = CurrentLoop::new(gains, gains, 1e-4)
                    .and_then(|l| l.with_decoupling(8e-3, 8e-3, 0.2))
                    .and_then(|l| l.with_voltage_limit(100.0))
                    .expect("valid");
                FieldOriented::new(cascade, current_loop, pole_pairs).expect("valid")
            }

            fn any_sample() -> impl Strategy<Value = FieldOrientedInput<$real>> {
                let numbers = prop::array::uniform8(any_number());
                (numbers, any_dq(), prop::option::of(any_dq())).prop_map(|(numbers, current, realised)| {
                    let [position, velocity, acceleration, jerk, snap, angle, speed, feedforward] = numbers;
                    let reference = Sample { position, velocity, acceleration, jerk, snap };
                    let input = FieldOrientedInput::new(reference, angle, speed, current);
                    FieldOrientedInput { feedforward, realised, ..input }
                })
            }

            #[derive(Debug, Clone)]
            enum Event {
                Tick(FieldOrientedInput<$real>),
                Phases(FieldOrientedInput<$real>, [$real; 3], $real),
                TakeOver,
            }

            fn events() -> impl Strategy<Value = Vec<Event>> {
                let phases = (any_sample(), prop::array::uniform3(any_number()), any_number());
                let event = prop_oneof![
                    6 => any_sample().prop_map(Event::Tick),
                    2 => phases.prop_map(|(input, currents, angle)| Event::Phases(input, currents, angle)),
                    1 => Just(Event::TakeOver),
                ];
                prop::collection::vec(event, 1..40)
            }

            fn check(control: &FieldOriented<$real>, output: &FieldOrientedOutput<$real>) -> Result<(), TestCaseError> {
                let Dq { d, q } = output.voltage;
                let limit = control.current_loop().voltage_limit();
                // A square rounded below the smallest normal number costs two bits more.
                let room = limit * (1.0 + 16.0 * $real::EPSILON);
                prop_assert!(d.is_finite() && q.is_finite() && d.hypot(q) <= room, "{output:?} of {limit}");
                let limit = control.cascade().current_limit();
                prop_assert!(output.current.is_finite() && output.current.abs() <= limit, "{output:?}");
                Ok(())
            }

            /// Runs `events`, changing between two configurations, and checks every answer; the configuration in force at
            /// the end.
            fn run(
                first: FieldOriented<$real>,
                second: FieldOriented<$real>,
                state: &mut FieldOrientedState<$real>,
                events: Vec<Event>,
            ) -> Result<FieldOriented<$real>, TestCaseError> {
                let (mut control, mut other) = (first, second);
                for event in events {
                    match event {
                        Event::Tick(input) => check(&control, &control.update(state, input))?,
                        Event::Phases(input, [a, b, c], angle) => {
                            let rotor = Rotation::by(angle);
                            let (output, voltages) =
                                control.update_phases(state, input, Phases { a, b, c }, rotor);
                            check(&control, &output)?;
                            if control.current_loop().voltage_limit() < 1e30 {
                                let sum = voltages.a + voltages.b + voltages.c;
                                prop_assert!(sum.is_finite(), "{voltages:?}");
                            }
                        }
                        Event::TakeOver => {
                            other.take_over(&control, state);
                            (control, other) = (other, control);
                        }
                    }
                    let Dq { d, q } = state.current_loop().integral();
                    let memory = [state.cascade().integral(), state.cascade().velocity_command(), d, q];
                    prop_assert!(memory.iter().all(|x| x.is_finite()), "{state:?}");
                }
                Ok(control)
            }

            proptest! {
                #![proptest_config(ProptestConfig { max_global_rejects: 1 << 20, max_local_rejects: 1 << 20, ..ProptestConfig::with_cases(1024) })]

                #[test]
                fn the_output_is_finite_and_within_the_limits(
                    first in any_control(), second in any_control(), events in events(),
                ) {
                    run(first, second, &mut FieldOrientedState::new(), events)?;
                }

                #[test]
                fn a_sample_that_is_not_finite_leaves_no_trace(
                    control in any_control(), events in events(), sample in any_sample(), field in 0..12,
                    bad in prop::sample::select(vec![$real::NAN, $real::INFINITY, $real::NEG_INFINITY]),
                ) {
                    let mut state = FieldOrientedState::new();
                    run(control, control, &mut state, events)?;
                    let mut input = sample;
                    match field {
                        0 => input.reference.position = bad,
                        1 => input.reference.velocity = bad,
                        2 => input.reference.acceleration = bad,
                        3 => input.reference.jerk = bad,
                        4 => input.reference.snap = bad,
                        5 => input.position = bad,
                        6 => input.velocity = bad,
                        7 => input.feedforward = bad,
                        8 => input.current.d = bad,
                        9 => input.current.q = bad,
                        10 => input.realised = Some(Dq { d: bad, q: 0.0 }),
                        _ => input.realised = Some(Dq { d: 0.0, q: bad }),
                    }
                    // Debug prints the shortest digits that round-trip and the sign of zero: equal text, equal bits.
                    let before = format!("{state:?}");
                    let output = control.update(&mut state, input);
                    prop_assert_eq!((output.cascade, output.current_loop), (Status::Held, CurrentStatus::Held));
                    prop_assert_eq!(format!("{state:?}"), before);
                }

                #[test]
                fn two_ordinary_samples_always_bring_it_back(
                    gains in (between(1.0, 300.0), between(1.0, 300.0)), pole_pairs in 1_u32..9, events in events(),
                    samples in prop::array::uniform2(prop::array::uniform5(between(-10.0, 10.0))),
                ) {
                    let (first, second) = (usual_control(gains.0, pole_pairs), usual_control(gains.1, pole_pairs));
                    let mut state = FieldOrientedState::new();
                    let control = run(first, second, &mut state, events)?;
                    let answers = samples.map(|[reference, position, velocity, d, q]| {
                        let current = Dq { d, q };
                        let input = FieldOrientedInput::new(Sample::at_rest(reference), position, velocity, current);
                        control.update(&mut state, input)
                    });
                    prop_assert!(answers[1].cascade != Status::Held, "{answers:?} {state:?}");
                    prop_assert!(answers[1].current_loop != CurrentStatus::Held, "{answers:?} {state:?}");
                }
            }
        }
    };
}

any_input!(f32);
any_input!(f64);
