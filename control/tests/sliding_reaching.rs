//! Surfaces are reached, and errors vanish, within the times that theory gives.
#![expect(clippy::expect_used, reason = "a helper that fails fails its test")]

mod axis;

use axis::{Axis, model, sine};
use control::{
    ReachingLaw, Sampling, SlidingMode, SlidingModeState, SlidingSurface, SuperTwisting, Switching,
};
use proptest::prelude::*;

/// The integral of `1 / rate` from zero to `distance`: with s = t^m for a large m the integrand is smooth and small at both
/// ends; Simpson's rule on two thousand intervals.
fn quadrature(rate: impl Fn(f64) -> f64, distance: f64) -> f64 {
    let power = 12.0;
    let intervals = 2000_u32;
    let integrand = |i: u32| {
        let t = f64::from(i) / f64::from(intervals);
        if i == 0 { 0.0 } else { power * t.powf(power - 1.0) * distance / rate(distance * t.powf(power)) }
    };
    let sum: f64 = (0..intervals / 2)
        .map(|i| integrand(2 * i) + 4.0 * integrand(2 * i + 1) + integrand(2 * i + 2))
        .sum();
    sum / (3.0 * f64::from(intervals))
}

/// Simpson's rule for the integrands below; found by halving the step.
const QUADRATURE: f64 = 1e-6;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn the_time_is_the_integral_of_one_over_the_rate(
        k in 0.5..200.0, eps in 0.5..50.0, a in 0.2..0.8, s in 1e-3..50.0_f64, negative: bool,
    ) {
        let s = if negative { -s } else { s };
        for law in [
            ReachingLaw::constant(eps),
            ReachingLaw::exponential(k, eps),
            ReachingLaw::power(k, a),
            ReachingLaw::improved_double_power(k, eps, 0.0, a, 1.0),
        ] {
            let law = law.expect("valid");
            let time = law.reaching_time(s).expect("finite");
            let exact = quadrature(|s| law.rate(s, 0.0), s.abs());
            prop_assert!((time / exact - 1.0).abs() < QUADRATURE, "{law:?}: {time} {exact}");
        }
    }

    #[test]
    fn the_double_power_laws_are_bounded_whatever_the_start(
        k1 in 0.5..200.0, k2 in 0.5..200.0, k3 in 0.0..200.0, b1 in 1.2..2.0, b2 in 0.2..0.8, s in 1e-3..1e3, e in 0.0..2.0,
    ) {
        for law in [
            ReachingLaw::double_power(k1, b1, k2, b2),
            ReachingLaw::improved_double_power(k1, k2, k3, b2, 0.5),
        ] {
            let law = law.expect("valid");
            let bound = law.reaching_time(s).expect("finite");
            let fixed = law.reaching_time(f64::INFINITY).expect("finite");
            prop_assert!(bound <= fixed * (1.0 + 4.0 * f64::EPSILON));
            let exact = quadrature(|s| law.rate(s, e), s);
            prop_assert!(exact <= bound * (1.0 + QUADRATURE), "{law:?}: {exact} {bound}");
        }
    }

    #[test]
    fn the_fixed_time_is_the_least_that_holds_for_all(
        k1 in 0.5..200.0, k2 in 0.5..200.0, b1 in 1.3..2.0, b2 in 0.2..0.8,
    ) {
        let law = ReachingLaw::double_power(k1, b1, k2, b2).expect("valid");
        let fixed = law.reaching_time(f64::INFINITY).expect("finite");
        // From one down to zero, and from infinity to one with s = 1/y, ds = -dy / y^2.
        let near = quadrature(|s| law.rate(s, 0.0), 1.0);
        let far = quadrature(|y| y * y * law.rate(1.0 / y, 0.0), 1.0);
        prop_assert!(((near + far) / fixed - 1.0).abs() < QUADRATURE, "{} {fixed}", near + far);
        let improved = ReachingLaw::improved_double_power(k1, k2, 0.0, b2, 1.0).expect("valid");
        let plain = ReachingLaw::double_power(k1, 2.0 - b2, k2, b2).expect("valid");
        let [a, b] = [improved, plain].map(|law| law.reaching_time(f64::INFINITY).expect("finite"));
        prop_assert!((a / b - 1.0).abs() < 1e-13, "two formulas of one integral: {a} {b}");
    }
}

#[test]
fn laws_that_only_tend_to_zero_say_so() {
    assert_eq!(ReachingLaw::exponential(3.0, 0.0).expect("valid").reaching_time(1.0), None);
    let smooth = ReachingLaw::constant(3.0)
        .and_then(|law| law.with_switching(Switching::Smooth { width: 0.1 }))
        .expect("valid");
    assert_eq!(smooth.reaching_time(1.0), None);
    assert_eq!(ReachingLaw::constant(3.0).expect("valid").reaching_time(f64::NAN), None);
    assert_eq!(SlidingSurface::linear(2.0).expect("valid").sliding_time(1.0), None);
}

/// When the surface first lies within `near` of zero, s, on the paper's axis from one metre off.
fn time_to_surface(controller: &SlidingMode, near: f64) -> (f64, f64) {
    let mut axis = Axis { position: 1.0, velocity: 0.0 };
    let mut state = SlidingModeState::new();
    let h = controller.period();
    let mut first = None;
    for tick in 0..100_000_u32 {
        let t = f64::from(tick) * h;
        let output = controller.update(&mut state, axis.input(&sine(t)));
        let from = *first.get_or_insert(output.surface);
        if output.surface.abs() <= near {
            return (t, from);
        }
        axis.advance(&controller.model(), output.output, 0.0, h);
    }
    (f64::INFINITY, f64::NAN)
}

#[test]
fn the_axis_reaches_its_surface_in_time() {
    let h = 1e-5;
    for surface in
        [SlidingSurface::terminal(10.0, 1.0, 9, 5), SlidingSurface::linear(10.0)].map(|s| s.expect("valid"))
    {
        for law in [
            ReachingLaw::constant(33.0),
            ReachingLaw::exponential(200.0, 33.0),
            ReachingLaw::power(20.0, 0.5),
            ReachingLaw::double_power(20.0, 5.0 / 3.0, 20.0, 1.0 / 3.0),
            ReachingLaw::improved_double_power(20.0, 20.0, 200.0, 1.0 / 3.0, 1.0 / 3.0),
            ReachingLaw::improved_double_power(20.0, 20.0, 0.0, 1.0 / 3.0, 1.0 / 3.0),
        ] {
            let law = law.expect("valid");
            for sampling in [Sampling::Explicit, Sampling::Matched] {
                let controller = SlidingMode::new(surface, law, model(), h)
                    .and_then(|c| c.with_sampling(sampling))
                    .expect("valid");
                let near = 1e-2;
                let (time, from) = time_to_surface(&controller, near);
                let bound = law.reaching_time(from).expect("finite");
                // Of first order in the period: what it does to the axis within one, e'' + ... <= 1e3, is 1e-2.
                assert!(time <= bound * 1.01 + h, "{law:?} {sampling:?}: {time} {bound}");
                // Not trivially so: the bound is the time but for the last 1e-2 of a square root, or for k3.
                let exact = !format!("{law:?}").contains("k3: 200") && !format!("{law:?}").contains("Double");
                assert!(!exact || time > 0.85 * bound, "{law:?} {sampling:?}: {time} {bound}");
            }
        }
    }
}

#[test]
fn on_a_terminal_surface_the_error_is_zero_in_time() {
    // e' = -(alpha e + beta |e|^(q/p)), and the same of the non-singular surface solved for e', by the midpoint rule.
    type Rate = fn(f64) -> f64;
    let cases: [(SlidingSurface, Rate, f64); 4] = [
        (SlidingSurface::terminal(10.0, 1.0, 9, 5).expect("valid"), |e| 10.0 * e + e.powf(5.0 / 9.0), 1.0),
        (SlidingSurface::terminal(0.0, 2.0, 5, 3).expect("valid"), |e| 2.0 * e.powf(0.6), 1.0),
        (SlidingSurface::nonsingular_terminal(3.0, 5, 3).expect("valid"), |e| (3.0 * e).powf(0.6), 1.0),
        (
            SlidingSurface::fast_nonsingular_terminal(0.5, 2.0, 3.0, 5, 3).expect("valid"),
            |e| (3.0 * (e + 2.0 * e * e)).powf(0.6),
            0.0,
        ),
    ];
    for (surface, rate, exact) in cases {
        for start in [1e-3, 0.7, 20.0] {
            let time = surface.sliding_time(-start).expect("finite");
            let integral = quadrature(rate, start);
            assert!(integral <= time * (1.0 + QUADRATURE), "{surface:?} {start}: {integral} {time}");
            assert!(integral >= exact * time * (1.0 - QUADRATURE), "{surface:?} {start}: {integral} {time}");
        }
    }
}

#[test]
fn super_twisting_arrives_when_it_says() {
    // Oscillating, barely so, at the limit, and not.
    for (k1, k2) in [(15.0, 110.0), (2.0, 40.0), (5.0, 3.2), (4.0, 2.0), (20.0, 3.0)] {
        let surface = SlidingSurface::linear(10.0).expect("valid");
        let law = SuperTwisting::new(surface, k1, k2, model(), 1e-3).expect("valid");
        for start in [0.01, 30.0] {
            let time = law.reaching_time(-start).expect("finite");
            // s' = -k1 |s|^(1/2) sgn s - v, v' = k2 sgn s, by Euler's method with steps of a millionth of the time.
            let h = time * 1e-6;
            let (mut s, mut v, mut last_outside) = (start, 0.0_f64, 0);
            for step in 0..1_100_000_u32 {
                let sign = f64::signum(s);
                (s, v) = (s - h * (k1 * s.abs().sqrt() * sign + v), v + h * k2 * sign);
                if s.abs() > 1e-6 * start {
                    last_outside = step;
                }
            }
            // A millionth of the distance is a thousandth of its root, and strong damping creeps over it.
            let measured = f64::from(last_outside) * h;
            assert!(measured < time && measured > 0.95 * time, "{k1} {k2} {start}: {measured} {time}");
        }
    }
}
