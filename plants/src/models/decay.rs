//! The functions of a decay that the motion under a held input is made of.

use profiles::Real;

/// `e^-z`, `(1 - e^-z) / z` and `(z - 1 + e^-z) / z^2` for `z >= 0`, to rounding also where `z` is small.
pub(super) fn decay_functions(z: f64) -> (f64, f64, f64) {
    if z > 1.0 {
        let decay = Real::exp(-z);
        let p1 = (1.0 - decay) / z;
        return (decay, p1, (1.0 - p1) / z);
    }
    // The Taylor series of p2 by Horner's rule; its 19th term is below one unit in the last place at z = 1.
    let p2 = (3..=19).rev().fold(1.0, |sum, k| 1.0 - z / f64::from(k) * sum) / 2.0;
    let p1 = 1.0 - z * p2;
    (1.0 - z * p1, p1, p2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_decay_functions_join() {
        let (below, above) = (decay_functions(1.0), decay_functions(1.0 + 1e-15));
        for (x, y) in [(below.0, above.0), (below.1, above.1), (below.2, above.2)] {
            assert!((x - y).abs() < 2e-15);
        }
    }
}
