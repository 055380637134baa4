//! Linear systems by their partial fractions: another route to their samples than the fit takes.
#![allow(dead_code, reason = "every test file uses its part")]

use identify::Hold;
use profiles::Complex;

type Parts = (f64, f64);

/// `sum of residue / (s - pole)`; a pole with an imaginary part stands for its conjugate, too.
pub(crate) struct Fractions {
    pub(crate) terms: Vec<(Complex<f64>, Complex<f64>)>,
}

impl Fractions {
    /// From poles and residues, each by its real and imaginary part.
    pub(crate) fn new(terms: &[(Parts, Parts)]) -> Self {
        let complex = |(re, im)| Complex::new(re, im);
        Self { terms: terms.iter().map(|(pole, residue)| (complex(*pole), complex(*residue))).collect() }
    }

    fn all(&self) -> Vec<(Complex<f64>, Complex<f64>)> {
        let pair = |(p, r): &(Complex<f64>, Complex<f64>)| {
            std::iter::once((*p, *r)).chain((p.im.abs() > 0.0).then(|| (p.conj(), r.conj())))
        };
        self.terms.iter().flat_map(pair).collect()
    }

    /// Numerator of degree below the number of poles and monic denominator, the highest power first.
    pub(crate) fn coefficients(&self) -> (Vec<f64>, Vec<f64>) {
        let all = self.all();
        let product = |skip: usize| {
            let mut c = vec![Complex::new(1.0, 0.0)];
            for (_, (p, _)) in all.iter().enumerate().filter(|(k, _)| *k != skip) {
                c.push(Complex::new(0.0, 0.0));
                for k in (1..c.len()).rev() {
                    let before = c[k - 1];
                    c[k] -= p * before;
                }
            }
            c
        };
        let mut numerator = vec![0.0; all.len()];
        for (k, (_, residue)) in all.iter().enumerate() {
            for (sum, c) in numerator.iter_mut().zip(product(k)) {
                *sum += (residue * c).re;
            }
        }
        (numerator, product(usize::MAX).iter().map(|c| c.re).collect())
    }

    /// Output at the samples of the input, every term from the same initial state.
    pub(crate) fn output(&self, input: &[f64], period: f64, hold: Hold, initial: f64) -> Vec<f64> {
        let mut output = vec![0.0; input.len()];
        for (pole, residue) in self.all() {
            let (e, mut x) = ((pole * period).exp(), Complex::new(initial, 0.0));
            let step = (e - 1.0) / pole;
            let ramp = (step - period) / (pole * period);
            for (k, y) in output.iter_mut().enumerate() {
                *y += (residue * x).re;
                let change = match hold {
                    Hold::Zero => 0.0,
                    Hold::First => input.get(k + 1).copied().unwrap_or(0.0) - input[k],
                };
                x = e * x + step * input[k] + ramp * change;
            }
        }
        output
    }
}

/// A square wave of both signs whose half periods follow a fixed irregular pattern.
pub(crate) fn irregular(samples: usize) -> Vec<f64> {
    (0..samples)
        .map(|n| if (n as f64 * 0.13).sin() + (n as f64 * 0.029).sin() > 0.3 { 1.0 } else { -0.6 })
        .collect()
}
