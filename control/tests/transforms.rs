//! Clarke and Park transforms against complex rotations, powers and balanced sets.

use control::{AlphaBeta, Dq, Phases, Rotation};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, TAU};

/// `v_a i_a + v_b i_b + v_c i_c`
fn power(v: Phases, i: Phases) -> f64 {
    v.a * i.a + v.b * i.b + v.c * i.c
}

fn balanced(amplitude: f64, angle: f64) -> Phases {
    let third = TAU / 3.0;
    let of = |lag: f64| amplitude * (angle - lag).cos();
    Phases { a: of(0.0), b: of(third), c: of(2.0 * third) }
}

/// Some ten roundings of numbers of this size.
fn close(a: f64, b: f64, size: f64) -> bool {
    (a - b).abs() <= 16.0 * f64::EPSILON * size
}

#[test]
fn a_balanced_set_of_amplitude_a_is_a_vector_of_length_a() {
    for k in 0..24 {
        let angle = TAU / 24.0 * f64::from(k);
        let AlphaBeta { alpha, beta } = balanced(3.0, angle).to_alpha_beta();
        assert!(close(alpha, 3.0 * angle.cos(), 3.0) && close(beta, 3.0 * angle.sin(), 3.0), "{angle}");
        // A rotor that turns with it sees it standing: on d when its flux points there, on q a quarter turn ahead.
        let Dq { d, q } = balanced(3.0, angle).to_dq(Rotation::by(angle));
        assert!(close(d, 3.0, 3.0) && close(q, 0.0, 3.0), "{angle}: {d} {q}");
        let Dq { d, q } = balanced(3.0, angle + FRAC_PI_2).to_dq(Rotation::by(angle));
        assert!(close(d, 0.0, 3.0) && close(q, 3.0, 3.0), "q leads d: {d} {q}");
    }
}

#[test]
fn a_zero_sequence_makes_no_vector() {
    let AlphaBeta { alpha, beta } = Phases { a: 5.0, b: 5.0, c: 5.0 }.to_alpha_beta();
    assert!(alpha == 0.0 && beta == 0.0);
}

proptest! {
    #[test]
    fn there_and_back(a in -1e3..1e3_f64, b in -1e3..1e3_f64, d in -1e3..1e3_f64, q in -1e3..1e3_f64, angle in -1e3..1e3_f64) {
        let rotor = Rotation::by(angle);
        let phases = Phases { a, b, c: -a - b };
        let back = phases.to_dq(rotor).to_phases(rotor);
        let size = 2e3;
        prop_assert!(close(back.a, a, size) && close(back.b, b, size) && close(back.c, -a - b, size), "{back:?}");
        let back = Dq { d, q }.to_phases(rotor).to_dq(rotor);
        prop_assert!(close(back.d, d, size) && close(back.q, q, size), "{back:?}");
    }

    /// `v_a i_a + v_b i_b + v_c i_c = 1.5 (v_d i_d + v_q i_q) + 3 v_0 i_0`, for unbalanced phases too.
    #[test]
    fn power_is_three_halves_of_the_product_in_rotor_axes(
        v in prop::array::uniform3(-400.0..400.0), i in prop::array::uniform3(-20.0..20.0), angle in -7.0..7.0,
    ) {
        let rotor = Rotation::by(angle);
        let [v, i] = [v, i].map(|[a, b, c]| Phases { a, b, c });
        let (v_dq, i_dq) = (v.to_dq(rotor), i.to_dq(rotor));
        let zero = (v.a + v.b + v.c) * (i.a + i.b + i.c) / 3.0;
        let in_rotor_axes = 1.5 * (v_dq.d * i_dq.d + v_dq.q * i_dq.q);
        prop_assert!(close(power(v, i), in_rotor_axes + zero, 400.0 * 20.0 * 4.0), "{in_rotor_axes}");
    }

    /// Park is a rotation by minus the angle: `d + j q = (alpha + j beta) e^(-j angle)`.
    #[test]
    fn park_turns_back_by_the_angle(length in 0.0..10.0_f64, direction in -4.0..4.0_f64, angle in -4.0..4.0_f64) {
        let vector = AlphaBeta { alpha: length * direction.cos(), beta: length * direction.sin() };
        let rotor = Rotation::from_sin_cos(angle.sin(), angle.cos());
        let Dq { d, q } = vector.to_dq(rotor);
        prop_assert!(close(d, length * (direction - angle).cos(), length), "{d}");
        prop_assert!(close(q, length * (direction - angle).sin(), length), "{q}");
    }
}
