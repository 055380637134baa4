//! Properties of random systems, signals and clocks.
#![expect(clippy::expect_used, reason = "helpers of tests fail as tests do")]

use plants::nalgebra::{SMatrix, SVector, vector};
use plants::{
    Clock, Encoder, HeldLinear, LinearMotor, Saturation, StateSpace, spectral_radius, zero_order_hold,
};
use proptest::prelude::*;

fn matrix<const R: usize, const C: usize>(size: f64) -> impl Strategy<Value = SMatrix<f64, R, C>> {
    prop::collection::vec(-size..size, R * C).prop_map(|entries| SMatrix::from_column_slice(&entries))
}

/// A system whose poles all lie left of -0.1 rad/s.
fn stable<const N: usize>() -> impl Strategy<Value = StateSpace<N, 2, 1>> {
    (matrix::<N, N>(20.0), matrix::<N, 2>(5.0)).prop_map(|(a, b)| {
        let shift = spectral_radius(&a).expect("converges") + 0.1;
        StateSpace::new(a - SMatrix::identity() * shift, b, SMatrix::zeros(), SMatrix::zeros())
            .expect("finite")
    })
}

fn halves_make_the_whole<const N: usize>(
    system: &StateSpace<N, 2, 1>,
    state: SVector<f64, N>,
    input: SVector<f64, 2>,
    period: f64,
) -> Result<(), TestCaseError> {
    let whole = system.discretise(period).expect("finite").step(&state, &input);
    let half = system.discretise(period / 2.0).expect("finite");
    let twice = half.step(&half.step(&state, &input), &input);
    // The exponential is exact to some units in the last place of its norm, which a skew system may raise.
    let transition = half.transition();
    let size = state.norm() * transition.state.norm() + input.norm() * transition.input.norm();
    let tolerance = 1e-14 * (1.0 + system.a().norm() * period) * transition.state.norm().max(1.0) * size;
    prop_assert!((whole - twice).norm() <= tolerance, "{} > {}", (whole - twice).norm(), tolerance);
    prop_assert!(system.discretise(period).expect("finite").spectral_radius().expect("converges") < 1.0);
    Ok(())
}

proptest! {
    #[test]
    fn two_half_steps_of_two_states(
        system in stable::<2>(), x in matrix::<2, 1>(1.0), u in matrix::<2, 1>(1.0), period in 1e-4..1.0
    ) {
        halves_make_the_whole(&system, x, u, period)?;
    }

    #[test]
    fn two_half_steps_of_three_states(
        system in stable::<3>(), x in matrix::<3, 1>(1.0), u in matrix::<2, 1>(1.0), period in 1e-4..1.0
    ) {
        halves_make_the_whole(&system, x, u, period)?;
    }

    #[test]
    fn a_held_input_ends_in_equilibrium(system in stable::<3>(), u in matrix::<2, 1>(1.0)) {
        // Slow enough poles decay by e^-300 over 3000 s: A x + B u = 0.
        let x = zero_order_hold(system.a(), system.b(), 3000.0).expect("stable").input * u;
        let rest = system.a() * x + system.b() * u;
        // Squaring over so many time constants leaves about 1e-16 |A| T of what matters.
        prop_assert!(rest.norm() <= 1e-9 * (system.a().norm() * x.norm() + system.b().norm()));
    }

    #[test]
    fn motor_steps_add_up(
        mass in 0.1..100.0, log_damping in -9.0..4.0, first in 1e-5..0.5, second in 1e-5..0.5, force in -50.0..50.0
    ) {
        let motor = LinearMotor::new(mass, 10.0_f64.powf(log_damping)).expect("valid");
        let (x, u) = (vector![0.3, -1.0], vector![force]);
        let step = |t: f64, x: &SVector<f64, 2>| motor.transition(t).expect("finite").apply(x, &u);
        let (whole, parts) = (step(first + second, &x), step(second, &step(first, &x)));
        prop_assert!((whole - parts).amax() <= 1e-14 * (1.0 + whole.amax() + force.abs() / mass));
    }

    #[test]
    fn an_encoder_is_within_half_a_count(position in -1e3..1e3, log_resolution in -9.0..0.0) {
        let encoder = Encoder::new(10.0_f64.powf(log_resolution)).expect("valid");
        let error = (encoder.quantise(position) - position).abs();
        // Beyond the half, the rounding of a division and a product.
        prop_assert!(error <= 0.5 * encoder.resolution() + 2.0 * f64::EPSILON * position.abs());
        prop_assert_eq!(encoder.counts(encoder.quantise(position)), encoder.counts(position));
    }

    #[test]
    fn ticks_survive_time(numerator in 1_u64..1000, denominator in 1_u64..1_000_000_000, tick in 0_u64..1 << 50) {
        let clock = Clock::from_period(numerator, denominator).expect("valid");
        prop_assert_eq!(clock.ticks(clock.time(tick)), Ok(tick));
    }

    #[test]
    fn saturation_keeps_its_bounds_and_its_direction(command in matrix::<3, 1>(10.0), limit in 0.0..20.0) {
        let circle = Saturation::norm(limit).expect("valid").apply(&command);
        prop_assert!(circle.norm() <= limit * (1.0 + 1e-15));
        prop_assert!((circle * command.norm() - command * circle.norm()).norm() <= 1e-13 * command.norm_squared());
        let bounds = Saturation::symmetric(limit).expect("valid").apply(&command);
        prop_assert!(bounds.amax() <= limit);
        prop_assert_eq!(Saturation::symmetric(limit).expect("valid").apply(&bounds), bounds);
    }
}
