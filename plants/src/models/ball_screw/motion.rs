//! The motion of a second-order system over a short time, in closed form.

use nalgebra::{SVector, vector};

/// The exact motion of `x'' = -a x' - b x + c` over a time `t` with `a t` and `b t^2` of at most one: with the divided
/// differences of the exponential at the two poles times `t` and at zero,
///
/// `s = t e[z1, z2]`, `g = t^2 e[0, z1, z2]`
///
/// it is `x+ = (1 - b g) x + s v + g c` and `v+ = -b s x + (1 - b g - a s) v + s c`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Motion {
    a: f64,
    b: f64,
    s: f64,
    g: f64,
}

impl Motion {
    /// Both by their series, whose terms are the complete symmetric polynomials of the poles, real for complex pairs.
    pub(super) fn over(a: f64, b: f64, t: f64) -> Self {
        let (sum, product) = (-a * t, b * t * t);
        let (mut before, mut term) = (0.0, 1.0);
        let (mut s, mut g) = (1.0, 0.5);
        // Terms below `1.62^k / (k + 1)!`, the last one below a hundredth of a rounding.
        for k in 1..=20 {
            (before, term) = (term, sum * term - product * before);
            let part = term * RECIPROCAL_FACTORIALS[k + 1];
            s += part;
            g += term * RECIPROCAL_FACTORIALS[k + 2];
        }
        Self { a, b, s: t * s, g: t * t * g }
    }

    /// The state after it, from position and velocity under the constant acceleration `c`.
    #[inline]
    pub(super) fn apply(&self, state: &SVector<f64, 2>, c: f64) -> SVector<f64, 2> {
        let start = c - self.a * state[1] - self.b * state[0];
        vector![
            state[0] + self.s * state[1] + self.g * (c - self.b * state[0]),
            state[1] + self.s * start - self.b * self.g * state[1]
        ]
    }
}

const RECIPROCAL_FACTORIALS: [f64; 23] = {
    let mut table = [1.0; 23];
    let (mut k, mut factorial) = (1, 1.0);
    while k < 23 {
        factorial *= k as f64;
        table[k] = 1.0 / factorial;
        k += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::zero_order_hold;
    use nalgebra::matrix;

    #[test]
    fn the_series_is_the_matrix_exponential() {
        for t in [1e-6, 1e-3, 0.3, 40.0] {
            for (at, bt2) in
                [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.25), (1e-9, 0.3), (0.7, 1e-12)]
            {
                let (a, b) = (at / t, bt2 / (t * t));
                let hold =
                    zero_order_hold(&matrix![0.0, 1.0; -b, -a], &matrix![0.0; 1.0], t).expect("finite");
                let motion = Motion::over(a, b, t);
                for (state, c) in [([1.0, 0.0], 0.0), ([0.0, 1.0], 0.0), ([0.0, 0.0], 1.0)] {
                    let (got, expected) =
                        (motion.apply(&state.into(), c), hold.apply(&state.into(), &vector![c]));
                    for (x, y) in got.iter().zip(&expected) {
                        // A dozen roundings of entries of this size, as many as the exponential has.
                        assert!((x - y).abs() <= 4e-15 * y.abs(), "{x} {y} {at} {bt2} {t}");
                    }
                }
            }
        }
    }
}
