//! Polynomials by their roots; coefficients ascend.

use faer::Mat;
use profiles::{Complex, Real};

/// The roots of a polynomial whose last coefficient is not zero, the smallest first, the upper one of a pair first;
/// none if the search for them fails.
pub(super) fn roots(coefficients: &[f64]) -> Option<Vec<Complex<f64>>> {
    let (&leading, rest) = coefficients.split_last()?;
    let n = rest.len();
    if n == 0 {
        return Some(Vec::new());
    }
    // In units of a typical root the companion matrix is balanced.
    let scale = rest
        .iter()
        .enumerate()
        .map(|(k, c)| Real::powf((c / leading).abs(), 1.0 / (n - k) as f64))
        .fold(0.0, f64::max);
    if scale <= 0.0 {
        return Some(vec![Complex::new(0.0, 0.0); n]);
    }
    let monic = |k: usize| rest[k] / leading / Real::powf(scale, (n - k) as f64);
    let companion =
        Mat::from_fn(n, n, |i, j| if i + 1 == n { -monic(j) } else { f64::from(u8::from(i + 1 == j)) });
    let finite = (0..n).all(|j| companion[(n - 1, j)].is_finite());
    let values = if finite { companion.eigenvalues().ok()? } else { return None };
    let mut upper: Vec<Complex<f64>> =
        values.iter().filter(|z| z.im >= 0.0).map(|z| Complex::new(z.re * scale, z.im * scale)).collect();
    upper.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    let pair = |z: Complex<f64>| std::iter::once(z).chain((z.im > 0.0).then(|| z.conj()));
    let all: Vec<Complex<f64>> = upper.into_iter().flat_map(pair).collect();
    (all.len() == n).then_some(all)
}

/// The coefficients below the leading one of the monic polynomial with these roots, complex ones in pairs.
pub(super) fn monic(roots: &[Complex<f64>]) -> Vec<f64> {
    let mut all = vec![Complex::new(1.0, 0.0)];
    for root in roots {
        all.push(Complex::new(0.0, 0.0));
        for k in (0..all.len()).rev() {
            let below = if k > 0 { all[k - 1] } else { Complex::new(0.0, 0.0) };
            all[k] = below - *root * all[k];
        }
    }
    all.pop();
    all.iter().map(|c| c.re).collect()
}

/// The value of a polynomial.
pub(super) fn value(coefficients: impl DoubleEndedIterator<Item = f64>, s: Complex<f64>) -> Complex<f64> {
    coefficients.rev().fold(Complex::new(0.0, 0.0), |sum, c| sum * s + c)
}

/// The gradient of a root by its polynomial's coefficients from the lowest: `-s^k / P'(s)`; infinite for a double root.
pub(super) fn root_gradient(coefficients: &[f64], root: Complex<f64>) -> impl Iterator<Item = Complex<f64>> {
    let slope = value(coefficients.iter().enumerate().skip(1).map(|(k, c)| k as f64 * c), root);
    let mut power = Complex::new(-1.0, 0.0);
    (0..coefficients.len()).map(move |_| {
        let gradient = power / slope;
        power *= root;
        gradient
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        let given = [(-3.0, 0.0), (-0.1, 7.0), (-0.1, -7.0), (40.0, 0.0)].map(|(a, b)| Complex::new(a, b));
        let mut coefficients = monic(&given);
        coefficients.push(1.0);
        let found = roots(&coefficients).expect("finds");
        for root in given {
            // Simple roots of a quartic: a few hundred roundings of the largest.
            assert!(found.iter().any(|z| (z - root).norm() < 1e-12 * 40.0), "{root} {found:?}");
            let ratio = value(coefficients.iter().copied(), root).norm() / 40_f64.powi(4);
            assert!(ratio < 1e-13);
            // The gradient against a small change of each coefficient.
            for (k, slope) in root_gradient(&coefficients, root).enumerate().take(4) {
                let mut moved = coefficients.clone();
                let change = 1e-7 * moved[k].abs();
                moved[k] += change;
                let near = roots(&moved).expect("finds");
                let moved = near.iter().min_by(|a, b| (*a - root).norm().total_cmp(&(*b - root).norm()));
                let expected = (moved.expect("some") - root) / change;
                assert!((expected - slope).norm() < 1e-4 * slope.norm(), "{root} {k} {expected} {slope}");
            }
        }
        assert_eq!(roots(&[0.0, 0.0, 2.0]), Some(vec![Complex::new(0.0, 0.0); 2]));
        assert_eq!(roots(&[5.0]), Some(vec![]));
    }
}
