//! Gauss-Legendre rules.

use crate::quantities::Real;

/// Nodes in `(0, 1)` and weights of the symmetric rule with 16 nodes over `[-1, 1]`.
const SIXTEEN: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_58),
    (0.458_016_777_657_227_37, 0.169_156_519_395_002_54),
    (0.617_876_244_402_643_8, 0.149_595_988_816_576_74),
    (0.755_404_408_355_003, 0.124_628_971_255_533_88),
    (0.865_631_202_387_831_8, 0.095_158_511_682_492_79),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_894),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_096),
];

/// The same with 4 nodes.
const FOUR: [(f64, f64); 2] = [
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

/// How many nodes the longer rule has.
pub(super) const NODES: usize = 16;

/// The integral of `f` from `from` to `to` by 16 nodes: exact for polynomials of degree 31.
pub(super) fn sixteen(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    rule(&SIXTEEN, from, to, f)
}

/// The integral of `f` from `from` to `to` by 4 nodes: exact for polynomials of degree 7.
pub(super) fn four(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    rule(&FOUR, from, to, f)
}

fn rule(nodes: &[(f64, f64)], from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let pair = |(node, weight): &(f64, f64)| weight * (f(middle - half * node) + f(middle + half * node));
    half * nodes.iter().map(pair).sum::<f64>()
}

/// A function over `[-1, 1]` as a series of Legendre polynomials: the interpolant at the 16 nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Series {
    coefficients: [f64; NODES],
}

impl Series {
    /// `c_k = (2 k + 1) / 2 sum w_i P_k(x_i) f(x_i)`, exact because the rule is for the products.
    pub(super) fn new(f: impl Fn(f64) -> f64) -> Self {
        let mut coefficients = [0.0; NODES];
        for (node, weight) in SIXTEEN {
            let (right, left) = (f(node), f(-node));
            let (even, odd) = (weight * (right + left), weight * (right - left));
            // P_k(-x) is P_k(x) for even k, and its negative for odd k.
            let mut order = 0.5;
            for (pair, [p, q]) in coefficients.chunks_exact_mut(2).zip(Legendre::new(node).pairs()) {
                if let [c, d] = pair {
                    *c += order * p * even;
                    *d += (order + 1.0) * q * odd;
                }
                order += 2.0;
            }
        }
        Self { coefficients }
    }

    /// The integral over `[-1, 1]`.
    pub(super) fn whole(&self) -> f64 {
        2.0 * self.coefficients.first().copied().unwrap_or(0.0)
    }

    /// The integral from -1 to `x`, and the value at `x`, with `(2 k + 1) integral of P_k = P_(k+1) - P_(k-1)`.
    pub(super) fn until(&self, x: f64) -> (f64, f64) {
        let mut legendre = Legendre::new(x);
        let (mut below, mut here) = (-1.0, legendre.next().unwrap_or(1.0));
        let (mut integral, mut value) = (0.0, 0.0);
        let mut order = 1.0;
        for (c, above) in self.coefficients.iter().zip(legendre) {
            integral += c / order * (above - below);
            value += c * here;
            (below, here) = (here, above);
            order += 2.0;
        }
        (integral, value)
    }

    /// The `x` to which the integral from -1 is `part` of the whole, for a function that is not negative.
    pub(super) fn place(&self, part: f64) -> f64 {
        let target = part * self.whole();
        let (mut low, mut high, mut x) = (-1.0, 1.0, 2.0 * part - 1.0);
        for _ in 0..16 {
            let (integral, value) = self.until(x);
            if integral < target {
                low = x;
            } else {
                high = x;
            }
            let step = (target - integral) / value;
            if step.abs() < 1e-6 {
                // The next step would be the square of this one; the series itself is hardly better.
                return (x + step).clamped(-1.0, 1.0);
            }
            x = if x + step > low && x + step < high { x + step } else { 0.5 * (low + high) };
        }
        x
    }
}

/// `1 / k` for `k = 1, 2, ...`, as far as the recursion goes.
const INVERSES: [f64; NODES + 1] = {
    let mut inverses = [1.0; NODES + 1];
    let mut k = 1;
    while k < inverses.len() {
        inverses[k] = 1.0 / (k + 1) as f64;
        k += 1;
    }
    inverses
};

/// `P_0(x), P_1(x), ... P_16(x)` by `P_(k+1) = x P_k + k / (k + 1) (x P_k - P_(k-1))`.
struct Legendre {
    x: f64,
    before: f64,
    here: f64,
    inverses: core::slice::Iter<'static, f64>,
}

impl Legendre {
    fn new(x: f64) -> Self {
        Self { x, before: 0.0, here: 1.0, inverses: INVERSES.iter() }
    }

    fn pairs(mut self) -> impl Iterator<Item = [f64; 2]> {
        core::iter::from_fn(move || Some([self.next()?, self.next()?]))
    }
}

impl Iterator for Legendre {
    type Item = f64;
    #[inline]
    fn next(&mut self) -> Option<f64> {
        // k / (k + 1) is 1 - 1 / (k + 1).
        let share = 1.0 - self.inverses.next()?;
        let value = self.here;
        let forward = self.x * value;
        self.here = forward + share * (forward - self.before);
        self.before = value;
        Some(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_up_to_their_degree_are_exact_and_the_next_one_is_not() {
        // The moments of x over [0, 1]: 1 / (k + 1); the first one missed is off by the square of a binomial's inverse.
        let moment = |k: i32, rule: &dyn Fn(i32) -> f64| (rule(k) * f64::from(k + 1) - 1.0).abs();
        for k in 0..=31 {
            assert!(moment(k, &|k| sixteen(0.0, 1.0, |x| x.powi(k))) <= 16.0 * f64::EPSILON, "{k}");
        }
        for k in 0..=7 {
            assert!(moment(k, &|k| four(0.0, 1.0, |x| x.powi(k))) <= 16.0 * f64::EPSILON, "{k}");
        }
        assert!(moment(8, &|k| four(0.0, 1.0, |x| x.powi(k))) > 1e-4);
        assert!(moment(40, &|k| sixteen(0.0, 1.0, |x| x.powi(k))) > 1e-14);
    }

    #[test]
    fn a_series_is_its_function() {
        let (f, integral) = (|x: f64| x.exp(), |x: f64| x.exp() - (-1.0_f64).exp());
        let series = Series::new(f);
        assert!((series.whole() - integral(1.0)).abs() <= 8.0 * f64::EPSILON);
        for x in [-1.0, -0.3, 0.0, 0.7, 1.0] {
            let (sum, value) = series.until(x);
            assert!(
                (sum - integral(x)).abs() <= 16.0 * f64::EPSILON
                    && (value - f(x)).abs() <= 32.0 * f64::EPSILON
            );
            // The last step is below 1e-6, and what it leaves its square.
            assert!((series.place(sum / series.whole()) - x).abs() <= 1e-11);
        }
    }
}
