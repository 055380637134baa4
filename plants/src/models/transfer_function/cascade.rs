//! A transfer function as sections in series.

use nalgebra::{Complex, DMatrix, DVector, SMatrix};

use super::{TransferFunction, magnitude};
use crate::error::ModelError;
use crate::models::StateSpace;

/// One or two poles with at most as many zeros, `(s - z) ... / ((s - p) ...)`, in real form.
///
/// A real pole is `x' = p x + u`; two of them, or a pair `sigma +- i w`, are
///
/// `[[p, q], [0, p']]` or `[[sigma, q], [-w^2 / q, sigma]]`, `B = [0, 1]`
///
/// with `q` a power of two as large as the poles. The poles stand in the matrix as they are, and no entry is the square
/// of a frequency or the difference of two poles.
#[derive(Debug, Clone, Copy)]
struct Section {
    first: Complex<f64>,
    second: Option<Complex<f64>>,
    zeros: [Option<Complex<f64>>; 2],
}

impl Section {
    fn new(first: Complex<f64>, second: Option<Complex<f64>>) -> Self {
        Self { first, second, zeros: [None; 2] }
    }

    fn order(&self) -> usize {
        if self.second.is_some() { 2 } else { 1 }
    }

    fn free(&self) -> usize {
        self.order() - self.zeros.iter().flatten().count()
    }

    fn take(&mut self, zero: Complex<f64>) {
        if let Some(place) = self.zeros.iter_mut().find(|place| place.is_none()) {
            *place = Some(zero);
        }
    }

    /// A power of two near the magnitude of the poles, one for integrators.
    fn scale(&self) -> f64 {
        let size = magnitude(&self.first).max(self.second.as_ref().map_or(0.0, magnitude));
        if size > 0.0 { power_of_two(size) } else { 1.0 }
    }

    /// `A`, with the last state driven by an input of one, `C` and `D`.
    fn matrices(&self) -> ([[f64; 2]; 2], [f64; 2], f64) {
        let p = self.first;
        let Some(next) = self.second else {
            // (s - z) / (s - p) = 1 + (p - z) / (s - p).
            return match self.zeros[0] {
                Some(z) => ([[p.re, 0.0], [0.0; 2]], [p.re - z.re, 0.0], 1.0),
                None => ([[p.re, 0.0], [0.0; 2]], [1.0, 0.0], 0.0),
            };
        };
        let q = self.scale();
        let a = [[p.re, q], [-p.im * (p.im / q), next.re]];
        // The numerator as D (s - p) (s - p') + alpha (s - Re p) + beta.
        let (alpha, beta, d) = match self.zeros {
            [Some(y), Some(z)] => {
                let alpha = (p.re - y.re) + (next.re - z.re);
                // The value of the numerator at Re p, less that of the denominator, -w^2 turned: differences first.
                let beta = if y.im == 0.0 {
                    (p.re - y.re) * (p.re - z.re) - p.im * p.im
                } else {
                    (p.re - y.re) * (p.re - y.re) + (y.im.abs() - p.im) * (y.im.abs() + p.im)
                };
                (alpha, beta, 1.0)
            }
            [Some(z), None] | [None, Some(z)] => (1.0, p.re - z.re, 0.0),
            [None, None] => (0.0, 1.0, 0.0),
        };
        (a, [beta / q, alpha], d)
    }
}

/// The power of two at or below a positive number.
fn power_of_two(value: f64) -> f64 {
    const MANTISSA: u32 = f64::MANTISSA_DIGITS - 1;
    f64::from_bits((value.max(f64::MIN_POSITIVE).to_bits() >> MANTISSA) << MANTISSA)
}

/// `x' = A x + B u`, `y = C x + d u` of any order.
pub(super) struct Realisation {
    pub(super) a: DMatrix<f64>,
    pub(super) b: DVector<f64>,
    pub(super) c: DVector<f64>,
    pub(super) d: f64,
}

impl TransferFunction {
    /// The transfer function as sections of first and second order in series, each with its poles in real form: the
    /// input drives the last states, the output is that of the first.
    ///
    /// `A` is block upper triangular with the poles in its diagonal blocks, so that they are its eigenvalues to
    /// rounding however close they are. Zeros go with the nearest poles.
    ///
    /// # Errors
    /// Another number of states than poles, or entries beyond the range of double precision.
    pub fn to_state_space<const N: usize>(&self) -> Result<StateSpace<N, 1, 1>, ModelError> {
        if self.order() != N {
            return Err(ModelError::Order { order: self.order(), states: N });
        }
        let Realisation { a, b, c, d } = self.realised();
        StateSpace::new(
            SMatrix::from_fn(|i, j| a[(i, j)]),
            SMatrix::from_fn(|i, _| b[i]),
            SMatrix::from_fn(|_, j| c[j]),
            SMatrix::from_element(d),
        )
    }

    pub(super) fn realised(&self) -> Realisation {
        let sections = self.sections();
        let n = self.order();
        let (mut a, mut b, mut c) = (DMatrix::zeros(n, n), DVector::zeros(n), DVector::zeros(n));
        // Section by section from the input: what the sections so far give as a row of states and of the input. The
        // gain is spread: each section has a gain of about one at its own poles.
        let (mut output, mut direct, mut gain) = (DVector::<f64>::zeros(n), 1.0, self.gain);
        let mut end = n;
        for section in sections.iter().rev() {
            let order = section.order();
            let start = end - order;
            let (block, row, through) = section.matrices();
            let driven = end - 1;
            for j in end..n {
                a[(driven, j)] = output[j];
            }
            b[driven] = direct;
            for i in 0..order {
                for j in 0..order {
                    a[(start + i, start + j)] = block[i][j];
                }
            }
            let mut size = 1.0;
            for _ in 0..section.free() {
                size *= section.scale();
            }
            gain /= size;
            output *= through * size;
            direct *= through * size;
            for (i, entry) in row.iter().enumerate().take(order) {
                output[start + i] = entry * size;
            }
            end = start;
        }
        c.copy_from(&(output * gain));
        Realisation { a, b, c, d: direct * gain }
    }

    /// Pairs of poles, and real poles in pairs as far as pairs of zeros need them; zeros with the nearest poles.
    fn sections(&self) -> Vec<Section> {
        let pairs = |roots: &[Complex<f64>]| roots.iter().filter(|r| r.im > 0.0).copied().collect::<Vec<_>>();
        let reals =
            |roots: &[Complex<f64>]| roots.iter().filter(|r| r.im == 0.0).copied().collect::<Vec<_>>();
        let zero_pairs = pairs(&self.zeros);
        let mut sections: Vec<_> =
            pairs(&self.poles).into_iter().map(|pole| Section::new(pole, Some(pole.conj()))).collect();
        let mut real_poles = reals(&self.poles);
        real_poles.sort_by(|p, q| p.re.total_cmp(&q.re));
        let mut missing = zero_pairs.len().saturating_sub(sections.len());
        while let Some(pole) = real_poles.pop() {
            let partner = if missing > 0 { real_poles.pop() } else { None };
            missing = missing.saturating_sub(1);
            sections.push(Section::new(pole, partner));
        }
        for zero in zero_pairs {
            if let Some(section) = nearest(&mut sections, zero, 2) {
                section.take(zero);
                section.take(zero.conj());
            }
        }
        for zero in reals(&self.zeros) {
            if let Some(section) = nearest(&mut sections, zero, 1) {
                section.take(zero);
            }
        }
        sections
    }
}

/// The section with room for so many zeros whose first pole is nearest.
fn nearest(sections: &mut [Section], zero: Complex<f64>, room: usize) -> Option<&mut Section> {
    let distance = |section: &Section| magnitude(&(section.first - zero));
    sections
        .iter_mut()
        .filter(|section| section.free() >= room)
        .min_by(|s, t| distance(s).total_cmp(&distance(t)))
}
