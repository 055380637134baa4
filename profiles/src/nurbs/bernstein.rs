//! Polynomials over `[0, 1]` in Bernstein form, whose coefficients bound them.

use alloc::vec::Vec;

/// `sum b_k (n over k) t^k (1 - t)^(n - k)`: never outside the range of its coefficients, at the ends equal to the first
/// and the last.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bernstein {
    coefficients: Vec<f64>,
}

impl Bernstein {
    /// At least one coefficient; none is the constant zero.
    pub(super) fn new(coefficients: impl Iterator<Item = f64>) -> Self {
        let mut coefficients: Vec<f64> = coefficients.collect();
        if coefficients.is_empty() {
            coefficients.push(0.0);
        }
        Self { coefficients }
    }

    pub(super) fn degree(&self) -> usize {
        self.coefficients.len() - 1
    }

    pub(super) fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// The polynomials of one degree less with which this one is `(1 - t) left + t right`; its derivative is `degree
    /// (right - left)`. Only for a degree of at least one.
    fn halves(&self) -> (Self, Self) {
        let left = self.coefficients.iter().take(self.degree()).copied();
        let right = self.coefficients.iter().skip(1).copied();
        (Self::new(left), Self::new(right))
    }

    /// The derivative.
    pub(super) fn derivative(&self) -> Self {
        let degree = self.degree() as f64;
        let pairs = self.coefficients.iter().zip(self.coefficients.iter().skip(1));
        Self::new(pairs.map(|(here, next)| degree * (next - here)))
    }

    /// The product.
    pub(super) fn times(&self, other: &Self) -> Self {
        let mut product = alloc::vec![0.0; self.coefficients.len() + other.coefficients.len() - 1];
        // Times their binomials, coefficients multiply as those of powers do.
        let scaled: Vec<f64> = other.scaled().collect();
        for (k, a) in self.scaled().enumerate() {
            product.iter_mut().skip(k).zip(&scaled).for_each(|(sum, b)| *sum += a * b);
        }
        let degree = product.len() - 1;
        product.iter_mut().zip(binomials(degree)).for_each(|(sum, binomial)| *sum /= binomial);
        Self { coefficients: product }
    }

    fn scaled(&self) -> impl Iterator<Item = f64> + '_ {
        self.coefficients.iter().zip(binomials(self.degree())).map(|(b, binomial)| b * binomial)
    }

    /// The square.
    pub(super) fn squared(&self) -> Self {
        self.times(self)
    }

    /// `self + factor other`, in the higher of the two degrees.
    pub(super) fn plus(self, factor: f64, other: &Self) -> Self {
        let missing = self.degree().saturating_sub(other.degree());
        if missing > 0 {
            return self.plus(factor, &other.clone().raised(missing));
        }
        let missing = other.degree() - self.degree();
        let mut sum = self.raised(missing);
        sum.coefficients.iter_mut().zip(&other.coefficients).for_each(|(a, b)| *a += factor * b);
        sum
    }

    /// `factor self`.
    pub(super) fn scaled_by(mut self, factor: f64) -> Self {
        self.coefficients.iter_mut().for_each(|x| *x *= factor);
        self
    }

    /// The sum of some polynomials, zero where there is none.
    pub(super) fn sum(mut terms: impl Iterator<Item = Self>) -> Self {
        let first = terms.next().unwrap_or(Self { coefficients: alloc::vec![0.0] });
        terms.fold(first, |sum, term| sum.plus(1.0, &term))
    }

    /// The same polynomial in a degree `times` higher.
    pub(super) fn raised(self, times: usize) -> Self {
        if times == 0 {
            return self;
        }
        self.times(&Self { coefficients: alloc::vec![1.0; times + 1] })
    }

    /// `self' other - self other'`, in the degree `2 n - 2` that it really has, for two of the same degree `n`.
    pub(super) fn wronskian(&self, other: &Self) -> Self {
        if self.degree() == 0 {
            return Self { coefficients: alloc::vec![0.0] };
        }
        // n ((b - a) ((1-t) c + t d) - ((1-t) a + t b) (d - c)) = n (b c - a d)
        let ((a, b), (c, d)) = (self.halves(), other.halves());
        b.times(&c).plus(-1.0, &a.times(&d)).scaled_by(self.degree() as f64)
    }

    /// The value at `t` (de Casteljau).
    #[cfg(test)]
    pub(super) fn at(&self, t: f64) -> f64 {
        let mut work = self.coefficients.clone();
        for left in (1..work.len()).rev() {
            for k in 0..left {
                if let Some([here, next]) = work.get_mut(k..k + 2) {
                    *here = (1.0 - t) * *here + t * *next;
                }
            }
        }
        work.first().copied().unwrap_or(0.0)
    }

    /// The polynomial over `[0, 1/2]` and over `[1/2, 1]`, each again over `[0, 1]`.
    pub(super) fn split(&self) -> (Self, Self) {
        self.split_at(0.5)
    }

    /// One half of it.
    pub(super) fn half(&self, upper: bool) -> Self {
        let (left, right) = self.split();
        if upper { right } else { left }
    }

    /// The polynomial over `[0, t]` and over `[t, 1]`, each again over `[0, 1]`.
    fn split_at(&self, t: f64) -> (Self, Self) {
        let mut work = self.coefficients.clone();
        let mut left = Vec::with_capacity(work.len());
        for remaining in (0..work.len()).rev() {
            left.push(work.first().copied().unwrap_or(0.0));
            // The last of every round is a coefficient of the right half, and stays.
            for k in 0..remaining {
                if let Some([here, next]) = work.get_mut(k..k + 2) {
                    *here = (1.0 - t) * *here + t * *next;
                }
            }
        }
        (Self { coefficients: left }, Self { coefficients: work })
    }

    /// The polynomial over `[from, to]`, again over `[0, 1]`, for `0 <= from <= to <= 1`.
    pub(super) fn part(&self, from: f64, to: f64) -> Self {
        if to > 0.0 { self.split_at(to).0.split_at(from / to).1 } else { self.split_at(0.0).0 }
    }
}

/// `(n over k)` for `k = 0, 1, ... n`.
fn binomials(degree: usize) -> impl Iterator<Item = f64> {
    let mut next = 1.0;
    (0..=degree).map(move |k| {
        let here = next;
        next = next * (degree - k) as f64 / (k + 1) as f64;
        here
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polynomial(coefficients: &[f64]) -> Bernstein {
        Bernstein::new(coefficients.iter().copied())
    }

    const PLACES: [f64; 5] = [0.0, 0.2, 0.5, 0.9, 1.0];

    #[test]
    fn products_halves_and_higher_degrees_have_the_values_of_the_polynomial() {
        let (a, b) = (polynomial(&[1.0, -2.0, 0.5, 3.0]), polynomial(&[2.0, 0.1, -1.0, 0.7]));
        let (product, raised, (left, right)) = (a.times(&b), a.clone().raised(3), a.split());
        assert_eq!((product.degree(), raised.degree()), (6, 6));
        for t in PLACES {
            // Coefficients of at most 6, convex combinations of them.
            assert!((product.at(t) - a.at(t) * b.at(t)).abs() <= 64.0 * f64::EPSILON);
            let quotient = (a.at(t + 1e-5) - a.at(t - 1e-5)) / 2e-5;
            // A sixth of the third derivative, 3! times 14.5 at most, times the squared step; and roundings over the step.
            assert!((a.derivative().at(t) - quotient).abs() <= 1e-8);
            assert!((raised.at(t) - a.at(t)).abs() <= 32.0 * f64::EPSILON);
            assert!((left.at(t) - a.at(0.5 * t)).abs() <= 32.0 * f64::EPSILON);
            assert!((right.at(t) - a.at(0.5 + 0.5 * t)).abs() <= 32.0 * f64::EPSILON);
            assert!((a.part(0.2, 0.7).at(t) - a.at(0.2 + 0.5 * t)).abs() <= 32.0 * f64::EPSILON);
            assert!((a.part(0.3, 0.3).at(t) - a.at(0.3)).abs() <= 32.0 * f64::EPSILON);
        }
    }

    #[test]
    fn the_wronskian_is_that_of_the_derivatives() {
        let (a, b) = (polynomial(&[1.0, -2.0, 0.5, 3.0]), polynomial(&[2.0, 0.1, -1.0, 0.7]));
        let slope = |p: &Bernstein, t: f64| p.derivative().at(t);
        let wronskian = a.wronskian(&b);
        assert_eq!(wronskian.degree(), 4);
        for t in PLACES {
            let expected = slope(&a, t) * b.at(t) - a.at(t) * slope(&b, t);
            assert!((wronskian.at(t) - expected).abs() <= 128.0 * f64::EPSILON);
        }
        assert_eq!(polynomial(&[3.0]).wronskian(&polynomial(&[2.0])), polynomial(&[0.0]));
    }

    #[test]
    fn binomials_of_a_high_degree() {
        let row: Vec<f64> = binomials(30).collect();
        assert_eq!((row.len(), row[1], row[15], row[30]), (31, 30.0, 155_117_520.0, 1.0));
    }
}
