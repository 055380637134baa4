//! The model in continuous time, stepped exactly from sample to sample. Time is counted in units of its own here.

use nalgebra::{DMatrix, DVector};

use super::Hold;

/// The integrators of `1/A(s)` and, behind them, of `1/A(s)^2`, with `A(s) = s^n + a[n-1] s^(n-1) + ... + a[0]`:
///
/// ```text
/// x[k] = s^k / A u, k = 0 ..= n        v[k] = s^k / A^2 u, k = 0 .. 2n
/// ```
///
/// hold the output of every numerator, and its exact derivative by every coefficient of `A`.
pub(super) struct Chain<'a> {
    a: &'a [f64],
    state: DMatrix<f64>,
    now: DVector<f64>,
    change: DVector<f64>,
}

/// `x` and `v` at every sample.
pub(super) struct Motion {
    pub(super) x: Vec<Vec<f64>>,
    pub(super) v: Vec<Vec<f64>>,
}

impl<'a> Chain<'a> {
    /// The exact steps of length `step`: a block of the exponential holds each (C. F. Van Loan, 1978,
    /// doi:10.1109/TAC.1978.1101743). None where they have no representation.
    pub(super) fn new(a: &'a [f64], step: f64, hold: Hold) -> Option<Self> {
        // Far from the poles of any record, and the exponential would not return from infinities.
        const LARGEST: f64 = 1e6;
        let n = a.len();
        let mut block = DMatrix::zeros(2 * n + 2, 2 * n + 2);
        for half in [0, n] {
            for k in 1..n {
                block[(half + k - 1, half + k)] = step;
            }
            for (k, a) in a.iter().enumerate() {
                block[(half + n - 1, half + k)] = -a * step;
            }
        }
        block[(2 * n - 1, 0)] = step;
        block[(n - 1, 2 * n)] = step;
        block[(2 * n, 2 * n + 1)] = 1.0;
        if !block.iter().all(|x: &f64| x.abs() < LARGEST) {
            return None;
        }
        let exponential = block.exp();
        let column = |j: usize| DVector::from_fn(2 * n, |i, _| exponential[(i, j)]);
        let change = match hold {
            Hold::Zero => DVector::zeros(2 * n),
            Hold::First => column(2 * n + 1),
        };
        let state = exponential.view((0, 0), (2 * n, 2 * n)).into_owned();
        Some(Self { a, state, now: column(2 * n), change })
    }

    /// From rest under an input.
    pub(super) fn forced(&self, input: &[f64]) -> Motion {
        self.motion(DVector::zeros(2 * self.a.len()), input.len(), |k| input.get(k).copied().unwrap_or(0.0))
    }

    /// After a unit impulse at the first sample: every free motion of the model is a numerator of this one.
    pub(super) fn free(&self, samples: usize) -> Motion {
        let n = self.a.len();
        let start = DVector::from_fn(2 * n, |i, _| f64::from(u8::from(i + 1 == n)));
        self.motion(start, samples, |_| 0.0)
    }

    fn motion(&self, start: DVector<f64>, samples: usize, input: impl Fn(usize) -> f64) -> Motion {
        let n = self.a.len();
        let mut motion = Motion {
            x: vec![Vec::with_capacity(samples); n + 1],
            v: vec![Vec::with_capacity(samples); 2 * n],
        };
        let (mut z, mut next) = (start, DVector::zeros(2 * n));
        let mut v = vec![0.0; 2 * n];
        for k in 0..samples {
            let u = input(k);
            let weighted = |z: &[f64]| self.a.iter().zip(z).map(|(a, z)| a * z).sum::<f64>();
            let (x, tail) = z.as_slice().split_at(n);
            v[..n].copy_from_slice(tail);
            for i in 0..n {
                v[n + i] = x[i] - weighted(&v[i..]);
            }
            let highest = u - weighted(x);
            for (column, x) in motion.x.iter_mut().zip(x.iter().chain([&highest])) {
                column.push(*x);
            }
            for (column, v) in motion.v.iter_mut().zip(&v) {
                column.push(*v);
            }
            next.gemv(1.0, &self.state, &z, 0.0);
            next.axpy(u, &self.now, 1.0);
            next.axpy(input(k + 1) - u, &self.change, 1.0);
            std::mem::swap(&mut z, &mut next);
        }
        motion
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One pole at -2 under a ramp and a step, by hand.
    #[test]
    fn a_lag_by_hand() {
        let a = [2.0];
        let step = 0.1;
        let ramp: Vec<f64> = (0..20).map(|k| f64::from(k) * step).collect();
        let motion = Chain::new(&a, step, Hold::First).expect("finite").forced(&ramp);
        let held = Chain::new(&a, step, Hold::Zero).expect("finite").forced(&[1.0; 20]);
        let free = Chain::new(&a, step, Hold::Zero).expect("finite").free(20);
        for k in 0..20 {
            let t = k as f64 * step;
            let e = (-2.0 * t).exp();
            // Roundings of values of one.
            let same = |a: f64, b: f64| assert!((a - b).abs() < 1e-14, "{k}: {a} {b}");
            same(motion.x[0][k], t / 2.0 - (1.0 - e) / 4.0);
            same(motion.x[1][k], (1.0 - e) / 2.0);
            same(held.x[0][k], (1.0 - e) / 2.0);
            same(held.v[0][k], (1.0 - e) / 4.0 - t * e / 2.0);
            same(held.v[1][k], t * e);
            same(free.x[0][k], e);
            same(free.v[0][k], t * e);
            same(free.v[1][k], e - 2.0 * t * e);
        }
    }
}
