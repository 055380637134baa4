//! Roots of polynomials.

use nalgebra::{Complex, DMatrix};
use profiles::Real;

use super::eigenvalues::eigenvalues_of;
use crate::error::ModelError;

/// The roots of a polynomial with real coefficients, highest power first, in no particular order; conjugate pairs
/// stand side by side and are conjugate to the bit.
///
/// Zeros at the origin are exact, roots of a quadratic are those of its closed form, and others are the eigenvalues of
/// the balanced companion matrix: the exact roots of a polynomial whose coefficients differ by some roundings. A simple
/// root far from the others is found to some roundings too; one that is repeated `k` times, to the `k`-th root of
/// the machine precision.
///
/// # Errors
/// A coefficient that is not finite, a first coefficient of zero or so small beside the others that the monic polynomial
/// has no representation, or a QR iteration that does not converge.
///
/// # References
/// A. Edelman and H. Murakami, "Polynomial roots from companion matrix eigenvalues", Mathematics of Computation 64
/// (1995), doi:10.1090/S0025-5718-1995-1262279-2.
///
/// ```
/// use plants::polynomial_roots;
///
/// // s (s + 3) (s^2 + 2 s + 5)
/// let roots = polynomial_roots(&[1.0, 5.0, 11.0, 15.0, 0.0])?;
/// assert!(roots.iter().any(|root| root.norm() == 0.0));
/// assert!(roots.iter().any(|root| (root.re + 1.0).abs() + (root.im - 2.0).abs() < 1e-14));
/// # Ok::<(), plants::ModelError>(())
/// ```
pub fn polynomial_roots(coefficients: &[f64]) -> Result<Vec<Complex<f64>>, ModelError> {
    for (k, &value) in coefficients.iter().enumerate() {
        if !value.is_finite() {
            return Err(ModelError::Coefficient { power: coefficients.len() - 1 - k, value });
        }
    }
    let Some((&first, rest)) = coefficients.split_first() else { return Ok(Vec::new()) };
    if first == 0.0 {
        return Err(ModelError::Coefficient { power: rest.len(), value: first });
    }
    let trailing = rest.iter().rev().take_while(|value| **value == 0.0).count();
    let monic: Vec<f64> = rest[..rest.len() - trailing].iter().map(|value| value / first).collect();
    if let Some(k) = monic.iter().position(|value| !value.is_finite()) {
        return Err(ModelError::Coefficient { power: rest.len() - 1 - k, value: monic[k] });
    }
    let mut roots = match monic[..] {
        [] => Vec::new(),
        [b] => vec![Complex::new(-b, 0.0)],
        [b, c] => quadratic_roots(b, c).to_vec(),
        _ => {
            let size = monic.len();
            let companion = DMatrix::from_fn(size, size, |i, j| match (i, j) {
                (0, j) => -monic[j],
                (i, j) if i == j + 1 => 1.0,
                _ => 0.0,
            });
            eigenvalues_of(&companion)?
        }
    };
    roots.resize(rest.len(), Complex::new(0.0, 0.0));
    Ok(roots)
}

/// The roots of `s^2 + sum s + product`, without cancellation; of a pair, the one with positive imaginary part first.
pub(crate) fn quadratic_roots(sum: f64, product: f64) -> [Complex<f64>; 2] {
    // Scaled, so that no square overflows.
    let scale = Real::max(sum.abs(), Real::sqrt(product.abs()));
    if scale <= 0.0 {
        return [Complex::new(0.0, 0.0); 2];
    }
    let (half, product) = (0.5 * sum / scale, product / scale / scale);
    let discriminant = half * half - product;
    if discriminant < 0.0 {
        let (re, im) = (-half * scale, Real::sqrt(-discriminant) * scale);
        return [Complex::new(re, im), Complex::new(re, -im)];
    }
    // The root of larger magnitude adds what has one sign; the other follows from the product.
    let large = -(half + Real::sqrt(discriminant).copysign(half));
    let small = if large == 0.0 { 0.0 } else { product / large };
    [Complex::new(large * scale, 0.0), Complex::new(small * scale, 0.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coefficients of the polynomial with these roots, by hand.
    fn expand(roots: &[Complex<f64>]) -> Vec<f64> {
        let mut all = vec![Complex::new(1.0, 0.0)];
        for root in roots {
            all.push(Complex::new(0.0, 0.0));
            for k in (1..all.len()).rev() {
                let before = all[k - 1];
                all[k] -= root * before;
            }
        }
        all.into_iter().map(|c| c.re).collect()
    }

    /// The largest distance of an expected root to the nearest found one, relative.
    fn distance(found: &[Complex<f64>], expected: &[Complex<f64>]) -> f64 {
        assert_eq!(found.len(), expected.len());
        expected.iter().fold(0.0, |most: f64, root| {
            let nearest = found.iter().map(|f| (f - root).norm()).fold(f64::INFINITY, f64::min);
            most.max(nearest / root.norm().max(1e-300))
        })
    }

    #[test]
    fn quadratics_keep_both_roots() {
        for (p, q) in [(1e-9, 1.0), (-1e-9, 1.0), (1e200, 1e190), (3.0, 3.0), (-5.0, 2.0), (1e-170, 2e-170)] {
            let found = quadratic_roots(p + q, p * q).map(|root| root.re);
            if (p * q).is_finite() && p * q != 0.0 {
                let expected = [Complex::new(-p, 0.0), Complex::new(-q, 0.0)];
                let found = found.map(|x| Complex::new(x, 0.0));
                assert!(distance(&found, &expected) < 1e-7, "{found:?}");
            }
        }
        // 1e-9 beside 1 to all digits, where the school formula keeps seven.
        let [large, small] = quadratic_roots(1.0 + 1e-9, 1e-9);
        assert!((large.re + 1.0).abs() < 1e-15 && (small.re / 1e-9 + 1.0).abs() < 1e-15);
        assert_eq!(quadratic_roots(0.0, 0.0), [Complex::new(0.0, 0.0); 2]);
        assert_eq!(quadratic_roots(0.0, 4.0), [Complex::new(0.0, 2.0), Complex::new(0.0, -2.0)]);
    }

    #[test]
    fn roots_of_many_scales() {
        for scale in [1e-6, 1.0, 1e6] {
            let pair = |re: f64, im: f64| [Complex::new(re, im) * scale, Complex::new(re, -im) * scale];
            let mut roots = vec![Complex::new(-scale, 0.0), Complex::new(-40.0 * scale, 0.0)];
            roots.extend(pair(-0.3, 7.0));
            roots.extend(pair(-2.0, 90.0));
            let found = polynomial_roots(&expand(&roots)).expect("converges");
            // Well apart: some roundings.
            assert!(distance(&found, &roots) < 1e-13, "{}", distance(&found, &roots));
            for pair in found.windows(2).filter(|pair| pair[0].im > 0.0) {
                assert_eq!(pair[0], pair[1].conj());
            }
        }
    }

    #[test]
    fn repeated_roots_lose_their_share_of_the_digits() {
        let triple = [Complex::new(-2.0, 0.0); 3];
        let found = polynomial_roots(&expand(&triple)).expect("converges");
        // The cube root of the machine precision is 6e-6.
        assert!(distance(&found, &triple) < 3e-5);
        let [a, b] = [Complex::new(-2.0, 0.0), Complex::new(-2.0 * (1.0 + 1e-6), 0.0)];
        let close = [a, b, Complex::new(-9.0, 0.0)];
        let found = polynomial_roots(&expand(&close)).expect("converges");
        // A relative distance of 1e-6 leaves 1e-16 / 1e-6 of each root.
        assert!(distance(&found, &close) < 1e-8, "{}", distance(&found, &close));
    }

    #[test]
    fn the_origin_is_exact_and_bad_coefficients_are_named() {
        let found = polynomial_roots(&[2.0, 3.0, 4.0, 5.0, 0.0, 0.0]).expect("converges");
        assert_eq!(found.iter().filter(|root| root.norm() <= 0.0).count(), 2);
        assert_eq!(polynomial_roots(&[]), Ok(vec![]));
        assert_eq!(polynomial_roots(&[7.0]), Ok(vec![]));
        assert_eq!(polynomial_roots(&[0.0, 1.0]), Err(ModelError::Coefficient { power: 1, value: 0.0 }));
        let error = polynomial_roots(&[1.0, f64::INFINITY, 1.0]);
        assert_eq!(error, Err(ModelError::Coefficient { power: 1, value: f64::INFINITY }));
        assert!(polynomial_roots(&[1e-300, 1.0, 1e300]).is_err());
    }
}
