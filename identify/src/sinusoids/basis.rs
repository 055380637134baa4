//! Exponentials on a uniform grid, and the least squares of their amplitudes. Time is counted in samples here.

use core::f64::consts::PI;

use faer::Mat;
use profiles::{Complex, Real};

use crate::least_squares::{back_substitute, left, triangle};

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

/// Columns of the basis with room for `extra` more, the constant last when there is one, and their number.
fn basis(poles: &[Pole], offset: bool, samples: usize, extra: usize) -> (Vec<f64>, usize) {
    let columns = order(poles) + usize::from(offset);
    let mut entries = Vec::with_capacity(samples * (columns + extra));
    for pole in poles {
        let start = entries.len();
        match pole {
            Pole::Pair { .. } => {
                entries.resize(start + 2 * samples, 0.0);
                let (re, im) = entries[start..].split_at_mut(samples);
                for ((re, im), z) in re.iter_mut().zip(im).zip(pole.powers(samples)) {
                    (*re, *im) = (z.re, z.im);
                }
            }
            Pole::Real { .. } => entries.extend(pole.powers(samples).map(|z| z.re)),
        }
    }
    if offset {
        entries.resize(entries.len() + samples, 1.0);
    }
    (entries, columns)
}

/// The best amplitudes; none where two poles coincide to rounding.
pub(super) fn amplitudes(poles: &[Pole], offset: bool, y: &[f64]) -> Option<Amplitudes> {
    let (mut entries, columns) = basis(poles, offset, y.len(), 1);
    entries.extend_from_slice(y);
    let r = triangle(&entries, y.len());
    let values = back_substitute(&r, 0, columns, columns)?;
    Some(Amplitudes { values, square: r[(columns, columns)] * r[(columns, columns)] })
}

/// What the model leaves of the data.
pub(super) fn residual(poles: &[Pole], amplitudes: &[f64], offset: bool, y: &[f64]) -> Vec<f64> {
    let (entries, _) = basis(poles, offset, y.len(), 0);
    left(&entries, amplitudes, y)
}

/// The triangle of the derivatives by decays and turns once the amplitudes are eliminated, with the residual as the
/// last column: its square is the curvature of the sum of squares.
pub(super) fn projected(poles: &[Pole], amplitudes: &[f64], offset: bool, y: &[f64]) -> Mat<f64> {
    let order = order(poles);
    let samples = y.len();
    let (mut entries, columns) = basis(poles, offset, samples, order + 1);
    let left = left(&entries, amplitudes, y);
    let (mut at, mut amplitude) = (0, amplitudes.iter().copied());
    for pole in poles {
        let mut next = || amplitude.next().unwrap_or(0.0);
        match pole {
            Pole::Pair { .. } => {
                let (c, s) = (next(), next());
                let sum = |n: usize, entries: &[f64], c: f64, s: f64| {
                    n as f64 * (c * entries[at + n] + s * entries[at + samples + n])
                };
                for n in 0..samples {
                    entries.push(-sum(n, &entries, c, s));
                }
                for n in 0..samples {
                    entries.push(sum(n, &entries, s, -c));
                }
                at += 2 * samples;
            }
            Pole::Real { .. } => {
                let b = next();
                for n in 0..samples {
                    entries.push(-(n as f64) * b * entries[at + n]);
                }
                at += samples;
            }
        }
    }
    entries.extend_from_slice(&left);
    let r = triangle(&entries, samples);
    Mat::from_fn(order + 1, order + 1, |i, j| r[(columns + i, columns + j)])
}
