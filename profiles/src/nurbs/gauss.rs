//! Gauss-Legendre rules.

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
pub(super) const NODES: i32 = 16;

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
}
