//! Coupled axes: single axes where the gain is zero, finite whatever comes in.

use control::{
    ContourFault, CouplingError, CrossCoupling, PathFrame, Pid, PidGains, PidInput, PidState, Status,
};
use proptest::prelude::*;

macro_rules! any_axes {
    ($real:ident) => {
        mod $real {
            use super::*;

            fn any_number() -> impl Strategy<Value = $real> {
                prop_oneof![
                    6 => -10.0 as $real..10.0,
                    2 => prop::num::$real::NORMAL,
                    1 => prop::num::$real::SUBNORMAL,
                    1 => prop::sample::select(vec![$real::MAX, $real::MIN, 0.0, -0.0]),
                ]
            }

            fn any_vector() -> impl Strategy<Value = [$real; 3]> {
                prop::array::uniform3(any_number())
            }

            fn any_path() -> impl Strategy<Value = Option<PathFrame<3, $real>>> {
                let between = (any_vector(), any_vector()).prop_map(|(a, b)| PathFrame::between(a, b));
                let along = any_vector().prop_map(PathFrame::along);
                let circle = (any_vector(), any_vector()).prop_map(|(v, a)| PathFrame::osculating(v, a));
                prop_oneof![between, along, circle].prop_map(|path| path.ok().flatten())
            }

            fn bits(values: [$real; 3]) -> [u64; 3] {
                values.map(|x| u64::from(x.to_bits()))
            }

            proptest! {
                #![proptest_config(ProptestConfig::with_cases(2048))]

                #[test]
                fn finite_axes_have_a_finite_answer(
                    errors in any_vector(), rates in any_vector(), path in any_path(),
                    gains in prop::array::uniform3(prop_oneof![0.0 as $real..2.0, prop::num::$real::POSITIVE]),
                ) {
                    let Ok(coupling) = CrossCoupling::new(gains) else { return Ok(()) };
                    if let Some(path) = path {
                        let frame = path.tangent().into_iter().chain(path.normal()).chain([path.curvature()]);
                        prop_assert!(frame.into_iter().all($real::is_finite), "{path:?}");
                    }
                    let coupled = coupling.couple(errors, rates, path.as_ref());
                    prop_assert!(coupled.errors.iter().chain(&coupled.rates).all(|x| x.is_finite()));
                    match coupled.contour {
                        Ok(contour) => {
                            prop_assert!(contour.vector().iter().all(|x| x.is_finite()), "{contour:?}");
                            prop_assert!(contour.magnitude().is_finite() && contour.magnitude() >= 0.0);
                        }
                        Err(fault) => {
                            prop_assert!(matches!(fault, ContourFault::Range { .. }), "{fault}");
                            prop_assert_eq!(bits(coupled.errors), bits(errors));
                            prop_assert_eq!(bits(coupled.rates), bits(rates));
                        }
                    }
                    let setpoints = coupling.setpoints(errors, rates, path.as_ref());
                    prop_assert!(setpoints.iter().all(|x| x.is_finite()));
                }

                #[test]
                fn without_a_gain_nothing_changes_to_the_bit(
                    errors in any_vector(), rates in any_vector(), path in any_path(), coupled in 0..4_usize,
                ) {
                    let mut gains = [0.0; 3];
                    // One axis may be coupled; the others are not.
                    if let Some(gain) = gains.get_mut(coupled) { *gain = 1.0; }
                    let coupling = CrossCoupling::new(gains).expect("valid");
                    let after = coupling.couple(errors, rates, path.as_ref());
                    let setpoints = coupling.setpoints(errors, rates, path.as_ref());
                    for axis in (0..3).filter(|axis| *axis != coupled) {
                        prop_assert_eq!(bits(after.errors)[axis], bits(errors)[axis]);
                        prop_assert_eq!(bits(after.rates)[axis], bits(rates)[axis]);
                        prop_assert_eq!(bits(setpoints)[axis], bits(errors)[axis]);
                    }
                }

                #[test]
                fn an_axis_that_fails_uncouples_the_others(
                    errors in any_vector(), rates in any_vector(), path in any_path(), axis in 0..3_usize,
                    in_rates in any::<bool>(),
                    bad in prop::sample::select(vec![$real::NAN, $real::INFINITY, $real::NEG_INFINITY]),
                ) {
                    let (mut errors, mut rates) = (errors, rates);
                    *(if in_rates { &mut rates } else { &mut errors }).get_mut(axis).expect("an axis") = bad;
                    let coupling = CrossCoupling::uniform(0.7).expect("valid");
                    let coupled = coupling.couple(errors, rates, path.as_ref());
                    prop_assert_eq!(bits(coupled.errors), bits(errors));
                    prop_assert_eq!(bits(coupled.rates), bits(rates));
                    // Finite errors may be out of range before the rates are looked at.
                    match coupled.contour {
                        Err(ContourFault::NotFinite { axis: named, .. }) => prop_assert_eq!(named, axis),
                        Err(ContourFault::Range { .. }) => prop_assert!(in_rates),
                        other => prop_assert!(false, "{other:?}"),
                    }
                    if !in_rates {
                        let references = [1.0, -0.0, 3.0];
                        let setpoints = coupling.setpoints(references, errors, path.as_ref());
                        prop_assert_eq!(bits(setpoints), bits(references));
                    }
                }

                #[test]
                fn three_uncoupled_axes_are_three_single_ones(
                    samples in prop::collection::vec((any_vector(), any_vector()), 1..40),
                ) {
                    let gains = PidGains { kp: 600.0, ki: 1.0, kd: 10.0 };
                    let pid = Pid::<$real>::new(gains, 1e-3).expect("valid");
                    let coupling = CrossCoupling::uniform(0.0).expect("valid");
                    let (mut together, mut single) = ([PidState::new(); 3], [PidState::new(); 3]);
                    let mut before = [0.0; 3];
                    for (reference, position) in samples {
                        let path = PathFrame::between(before, reference).expect("finite");
                        before = reference;
                        let setpoints = coupling.setpoints(reference, position, path.as_ref());
                        for i in 0..3 {
                            let a = pid.update(&mut together[i], PidInput::new(setpoints[i], position[i]));
                            let b = pid.update(&mut single[i], PidInput::new(reference[i], position[i]));
                            prop_assert_eq!(a.output.to_bits(), b.output.to_bits());
                        }
                    }
                }
            }
        }
    };
}

any_axes!(f32);
any_axes!(f64);

#[test]
#[expect(clippy::float_cmp, reason = "numbers that are exact in binary")]
fn every_axis_has_its_own_gain() {
    let coupling = CrossCoupling::new([0.5, 0.0, 2.0]).expect("valid");
    let path = PathFrame::along([0.0, 0.0, 3.0]).expect("finite");
    // Along z: x and y are contour error, and of the rates alike.
    let coupled = coupling.couple([1.0, 2.0, 4.0], [8.0, 16.0, 32.0], path.as_ref());
    assert_eq!(coupled.contour.map(|e| e.vector()), Ok([1.0, 2.0, 0.0]));
    assert_eq!(coupled.errors, [1.5, 2.0, 4.0]);
    assert_eq!(coupled.rates, [12.0, 16.0, 32.0]);
    // Without a direction all of it is.
    let coupled = coupling.couple([1.0, 2.0, 4.0], [8.0, 16.0, 32.0], None);
    assert_eq!((coupled.errors, coupled.rates), ([1.5, 2.0, 12.0], [12.0, 16.0, 96.0]));
    assert_eq!(coupling.setpoints([5.0; 3], [4.0, 3.0, 1.0], path.as_ref()), [5.5, 5.0, 5.0]);
}

#[test]
fn a_lost_sensor_holds_its_own_axis_alone() {
    let coupling = CrossCoupling::<2>::uniform(0.5).expect("valid");
    let pid = Pid::new(PidGains { kp: 2.0, ..PidGains::default() }, 1e-3).expect("valid");
    let mut axes = [PidState::new(); 2];
    let path = PathFrame::along([1.0, 1.0]).expect("finite");
    let (reference, position) = ([1.0, 1.0], [f64::NAN, 0.5]);
    let setpoints = coupling.setpoints(reference, position, path.as_ref());
    let [x, y] = [0, 1].map(|i| pid.update(&mut axes[i], PidInput::new(setpoints[i], position[i])));
    assert_eq!((x.status, y.status), (Status::Held, Status::Regular));
    assert!((y.output - 1.0).abs() <= 0.0, "2 (1 - 0.5), uncoupled");
}

#[test]
fn bad_gains_are_named() {
    assert_eq!(CrossCoupling::new([0.0, -0.5]), Err(CouplingError::Gain { axis: 1, value: -0.5 }));
    assert_eq!(
        CrossCoupling::<1>::uniform(f64::INFINITY),
        Err(CouplingError::Gain { axis: 0, value: f64::INFINITY })
    );
    assert!(CrossCoupling::new([f64::NAN]).is_err());
}
