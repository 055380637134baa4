//! Exponentials on a uniform grid, and the least squares of their amplitudes. Time is counted in samples here.

use core::f64::consts::PI;

use faer::Mat;
use profiles::{Complex, Real};

/// An exponential of the model, per sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Pole {
    /// `e^(-decay n)` times the cosine and the sine of `turn n`.
    Pair { decay: f64, turn: f64 },
    /// `e^(-decay n)`.
    Real { decay: f64 },
}

impl Pole {
    /// Columns of the basis, and as many nonlinear parameters.
    pub(super) fn order(&self) -> usize {
        match self {
            Self::Pair { .. } => 2,
            Self::Real { .. } => 1,
        }
    }

    /// Growth of no more than e^4 over the record and a decay no faster than e^-3 a sample; a frequency below half
    /// the sample rate. Beyond lies nothing that samples could tell.
    pub(super) fn bounded(self, samples: usize) -> Self {
        let held = |decay: f64| decay.clamped(-4.0 / samples as f64, 3.0);
        match self {
            Self::Pair { decay, turn } => {
                Self::Pair { decay: held(decay), turn: turn.clamped(1e-3 / samples as f64, PI) }
            }
            Self::Real { decay } => Self::Real { decay: held(decay) },
        }
    }

    /// The pole moved by the first entries of a step, which are used up.
    pub(super) fn moved(self, step: &mut impl Iterator<Item = f64>) -> Self {
        let mut next = || step.next().unwrap_or(0.0);
        match self {
            Self::Pair { decay, turn } => Self::Pair { decay: decay + next(), turn: turn + next() },
            Self::Real { decay } => Self::Real { decay: decay + next() },
        }
    }

    /// `z^n` with `z = e^(-decay + i turn)` for every sample.
    fn powers(&self, samples: usize) -> impl Iterator<Item = Complex<f64>> {
        // A run of products loses a unit in the last place each: start anew before it shows.
        const RUN: usize = 32;
        let (decay, turn) = match *self {
            Self::Pair { decay, turn } => (decay, turn),
            Self::Real { decay } => (decay, 0.0),
        };
        let power = move |n: f64| {
            let (sin, cos) = Real::sin_cos(turn * n);
            Complex::new(cos, sin) * Real::exp(-decay * n)
        };
        let step = power(1.0);
        let mut now = power(0.0);
        (0..samples).map(move |n| {
            now = if n % RUN == 0 { power(n as f64) } else { now * step };
            now
        })
    }
}

/// Sum of the orders.
pub(super) fn order(poles: &[Pole]) -> usize {
    poles.iter().map(Pole::order).sum()
}

/// Amplitudes that fit best with given poles: two for a pair (of the cosine and the sine), one for a real pole, the
/// constant last.
#[derive(Debug, Clone)]
pub(super) struct Amplitudes {
    pub(super) values: Vec<f64>,
    pub(super) square: f64,
}

/// The basis with room for `extra` more columns, the constant last when there is one.
fn basis(poles: &[Pole], offset: bool, samples: usize, extra: usize) -> (Mat<f64>, usize) {
    let columns = order(poles) + usize::from(offset);
    let mut matrix = Mat::zeros(samples, columns + extra);
    let mut column = 0;
    for pole in poles {
        for (n, z) in pole.powers(samples).enumerate() {
            matrix[(n, column)] = z.re;
            if pole.order() == 2 {
                matrix[(n, column + 1)] = z.im;
            }
        }
        column += pole.order();
    }
    if offset {
        (0..samples).for_each(|n| matrix[(n, column)] = 1.0);
    }
    (matrix, columns)
}

/// The best amplitudes; none where two poles coincide to rounding.
pub(super) fn amplitudes(poles: &[Pole], offset: bool, y: &[f64]) -> Option<Amplitudes> {
    let (mut matrix, columns) = basis(poles, offset, y.len(), 1);
    y.iter().enumerate().for_each(|(n, value)| matrix[(n, columns)] = *value);
    let r = matrix.qr().thin_R().to_owned();
    let values = back_substitute(&r, 0, columns, columns)?;
    Some(Amplitudes { values, square: r[(columns, columns)] * r[(columns, columns)] })
}

/// What the model leaves of the data.
pub(super) fn residual(poles: &[Pole], amplitudes: &[f64], offset: bool, y: &[f64]) -> Vec<f64> {
    let (matrix, columns) = basis(poles, offset, y.len(), 0);
    let mut left = y.to_vec();
    for (column, amplitude) in (0..columns).zip(amplitudes) {
        left.iter_mut().enumerate().for_each(|(n, value)| *value -= amplitude * matrix[(n, column)]);
    }
    left
}

/// The triangle of the derivatives by decays and turns once the amplitudes are eliminated, with the residual as the
/// last column: its square is the curvature of the sum of squares.
pub(super) fn projected(poles: &[Pole], amplitudes: &[f64], offset: bool, y: &[f64]) -> Mat<f64> {
    let order = order(poles);
    let (mut matrix, columns) = basis(poles, offset, y.len(), order + 1);
    let last = columns + order;
    y.iter().enumerate().for_each(|(n, value)| matrix[(n, last)] = *value);
    for (column, amplitude) in (0..columns).zip(amplitudes) {
        (0..y.len()).for_each(|n| matrix[(n, last)] -= amplitude * matrix[(n, column)]);
    }
    let (mut at, mut amplitude) = (0, amplitudes.iter().copied());
    for pole in poles {
        let mut next = || amplitude.next().unwrap_or(0.0);
        match pole {
            Pole::Pair { .. } => {
                let (c, s) = (next(), next());
                for n in 0..y.len() {
                    let (time, cos, sin) = (n as f64, matrix[(n, at)], matrix[(n, at + 1)]);
                    matrix[(n, columns + at)] = -time * (c * cos + s * sin);
                    matrix[(n, columns + at + 1)] = time * (s * cos - c * sin);
                }
            }
            Pole::Real { .. } => {
                let b = next();
                (0..y.len()).for_each(|n| matrix[(n, columns + at)] = -(n as f64) * b * matrix[(n, at)]);
            }
        }
        at += pole.order();
    }
    let r = matrix.qr().thin_R().to_owned();
    Mat::from_fn(order + 1, order + 1, |i, j| r[(columns + i, columns + j)])
}

/// Solves the triangle of `size` rows from `start` on against a column of the same matrix; none if it is singular.
pub(super) fn back_substitute(r: &Mat<f64>, start: usize, size: usize, column: usize) -> Option<Vec<f64>> {
    let mut x = vec![0.0; size];
    for i in (0..size).rev() {
        let row = start + i;
        let known: f64 = x.iter().enumerate().skip(i + 1).map(|(j, x)| r[(row, start + j)] * x).sum();
        let norm = (0..=row).map(|k| r[(k, row)].abs()).fold(0.0, f64::max);
        // Columns that agree to fourteen digits are one.
        if r[(row, row)].abs() <= 1e-14 * norm {
            return None;
        }
        x[i] = (r[(row, column)] - known) / r[(row, row)];
    }
    x.iter().all(|x| x.is_finite()).then_some(x)
}
