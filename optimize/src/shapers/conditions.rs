//! Zeros as conditions that keep their digits where modes are close to each other.

use profiles::Complex;

/// Poles so close to each other that their zeros are nearly one zero of higher order.
///
/// Instead of the response at each of them its divided differences are asked to vanish, the first of which is the response
/// and which are derivatives where poles are equal. Of `e^(p tau)` they are the first row of the exponential of `tau Z`, with
/// the poles on the diagonal of `Z` and one above it (here times the size of the poles, so that all are of one scale).
#[derive(Debug, Clone)]
pub(super) struct Group {
    poles: Vec<Complex<f64>>,
    scale: f64,
}

impl Group {
    /// Groups of the poles, each as often as its order.
    pub(super) fn of(mut poles: Vec<Complex<f64>>) -> Vec<Self> {
        poles.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
        let mut groups: Vec<Self> = vec![];
        for pole in poles {
            match groups.last_mut() {
                Some(group) if group.poles.iter().all(|p| (p - pole).norm() < 0.5 * pole.norm()) => {
                    group.poles.push(pole);
                }
                _ => groups.push(Self { poles: vec![pole], scale: pole.norm() }),
            }
        }
        groups
    }

    /// Appends the differences of `e^(p tau)` to `values`, and their derivatives by `tau` to `slopes`.
    pub(super) fn append(&self, tau: f64, values: &mut Vec<Complex<f64>>, slopes: &mut Vec<Complex<f64>>) {
        let exponential = self.exponential(tau);
        let n = self.poles.len();
        for (column, value) in exponential.iter().take(n).enumerate() {
            // d/dtau e^(tau Z) = Z e^(tau Z), whose first row is made of the first two.
            let below = exponential.get(n + column).copied().unwrap_or_default();
            values.push(*value);
            slopes.push(self.poles[0] * value + below * self.scale);
        }
    }

    /// `e^(tau Z)`, row by row: about the mean of the poles, by the Taylor series of a part of it and squaring.
    fn exponential(&self, tau: f64) -> Vec<Complex<f64>> {
        let n = self.poles.len();
        let mean = self.poles.iter().sum::<Complex<f64>>() / n as f64;
        let spread = self.poles.iter().map(|p| (p - mean).norm()).fold(0.0, f64::max);
        let size = (spread + if n > 1 { self.scale } else { 0.0 }) * tau;
        let halvings = if size > 0.5 { (2.0 * size).log2().ceil() as i32 } else { 0 };
        let part = tau / 2.0_f64.powi(halvings);
        let mut z = vec![Complex::default(); n * n];
        for (row, pole) in self.poles.iter().enumerate() {
            z[row * n + row] = (pole - mean) * part;
            if row + 1 < n {
                z[row * n + row + 1] = Complex::new(self.scale * part, 0.0);
            }
        }
        // Nested from the 16th term, which is below 0.5^16 / 16!.
        let mut sum = identity(n);
        for k in (1..=16).rev() {
            sum = product(&z, &sum, n);
            sum.iter_mut().for_each(|x| *x /= f64::from(k));
            (0..n).for_each(|row| sum[row * n + row] += 1.0);
        }
        (0..halvings).for_each(|_| sum = product(&sum, &sum, n));
        let turn = (mean * tau).exp();
        sum.iter_mut().for_each(|x| *x *= turn);
        sum
    }
}

fn identity(n: usize) -> Vec<Complex<f64>> {
    (0..n * n).map(|k| Complex::new(f64::from(u8::from(k / n == k % n)), 0.0)).collect()
}

/// The product of two upper triangular matrices.
fn product(a: &[Complex<f64>], b: &[Complex<f64>], n: usize) -> Vec<Complex<f64>> {
    let mut c = vec![Complex::default(); n * n];
    for row in 0..n {
        for column in row..n {
            c[row * n + column] = (row..=column).map(|k| a[row * n + k] * b[k * n + column]).sum();
        }
    }
    c
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_of_distant_and_of_equal_poles_are_the_textbook_ones() {
        let (a, b) = (Complex::new(-0.1, 1.0), Complex::new(-0.2, 1.4));
        let differences = |poles: &[Complex<f64>], tau: f64| {
            let (mut values, mut slopes) = (vec![], vec![]);
            Group::of(poles.to_vec())[0].append(tau, &mut values, &mut slopes);
            (values, slopes)
        };
        for tau in [0.0, 0.3, 7.0, 40.0] {
            let e = |p: Complex<f64>| (p * tau).exp();
            let (values, slopes) = differences(&[a, b], tau);
            let known = (e(b) - e(a)) / (b - a) * a.norm();
            assert!((values[0] - e(a)).norm() < 1e-14 && (values[1] - known).norm() < 1e-13);
            let slope = (b * e(b) - a * e(a)) / (b - a) * a.norm();
            assert!((slopes[0] - a * e(a)).norm() < 1e-14 && (slopes[1] - slope).norm() < 1e-13);
            // Three times the same pole: tau^k e^(p tau) / k!.
            let (values, _) = differences(&[a, a, a], tau);
            let s = a.norm() * tau;
            for (value, power) in values.iter().zip([1.0, s, 0.5 * s * s]) {
                assert!((value - e(a) * power).norm() < 1e-13 * power.max(1.0), "{value} {power}");
            }
            // Nearly the same is nearly the same.
            let near = differences(&[a, a * (1.0 + 1e-9), a * (1.0 - 1e-9)], tau).0;
            assert!((near[2] - values[2]).norm() < 1e-7 * (1.0 + s * s));
        }
    }
}
