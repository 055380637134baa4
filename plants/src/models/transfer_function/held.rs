//! A transfer function under a held input.

use nalgebra::{DMatrix, DVector};

use super::TransferFunction;
use super::cascade::Realisation;
use crate::error::ModelError;
use crate::linear::held_transition;

/// A transfer function of any order between a zero-order hold and a sampler, exact at the samples.
///
/// An update allocates nothing. Where the order is known when compiling,
/// [`to_state_space`](TransferFunction::to_state_space) and its
/// [`discretise`](crate::StateSpace::discretise) give the same in matrices of fixed size.
///
/// ```
/// use plants::{TransferFunction, nalgebra::Complex};
///
/// let lag = TransferFunction::with_dc_gain(&[], &[Complex::new(-2.0, 0.0)], 3.0)?;
/// let mut held = lag.held(0.1)?;
/// assert_eq!(held.update(1.0), 0.0); // the output at the sample, before the input has acted
/// assert!((held.update(1.0) - 3.0 * (1.0 - (-0.2_f64).exp())).abs() < 1e-15);
/// # Ok::<(), plants::ModelError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct HeldTransferFunction {
    phi: DMatrix<f64>,
    gamma: DVector<f64>,
    output: DVector<f64>,
    direct: f64,
    period: f64,
    state: DVector<f64>,
    next: DVector<f64>,
}

impl HeldTransferFunction {
    /// The output at this sample, whose input is held until the next.
    #[inline]
    pub fn update(&mut self, input: f64) -> f64 {
        let output = self.output.dot(&self.state) + self.direct * input;
        self.next.copy_from(&self.gamma);
        self.next *= input;
        self.next.gemv(1.0, &self.phi, &self.state, 1.0);
        core::mem::swap(&mut self.state, &mut self.next);
        output
    }

    /// Back to rest.
    pub fn reset(&mut self) {
        self.state.fill(0.0);
    }

    /// The period, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.period
    }
}

impl TransferFunction {
    /// The transfer function at rest under an input that is held for a period in s.
    ///
    /// The matrix exponential is that of the whole series of sections, see
    /// [`to_state_space`](Self::to_state_space): nothing is lost between them.
    ///
    /// # Errors
    /// A period that is not positive and finite, or as [`zero_order_hold`](crate::zero_order_hold).
    pub fn held(&self, period: f64) -> Result<HeldTransferFunction, ModelError> {
        if !(period > 0.0 && period.is_finite()) {
            return Err(ModelError::Parameter {
                parameter: "the period in s",
                range: "positive and finite",
                value: period,
            });
        }
        let Realisation { a, b, c, d } = self.realised();
        if !(c.iter().all(|x| x.is_finite()) && d.is_finite()) {
            return Err(ModelError::Range { interval: period });
        }
        let order = self.order();
        let (phi, gamma) = held_transition(&a, &DMatrix::from_fn(order, 1, |i, _| b[i]), period)?;
        Ok(HeldTransferFunction {
            phi,
            gamma: DVector::from_fn(order, |i, _| gamma[(i, 0)]),
            output: c,
            direct: d,
            period,
            state: DVector::zeros(order),
            next: DVector::zeros(order),
        })
    }

    /// The outputs at the samples of an input that is held between them, from rest.
    ///
    /// # Errors
    /// As [`held`](Self::held); an input that is not finite, or an output that leaves the range of numbers.
    pub fn respond(&self, input: &[f64], period: f64) -> Result<Vec<f64>, ModelError> {
        let mut held = self.held(period)?;
        let mut outputs = Vec::with_capacity(input.len());
        for &value in input {
            finite("an input", value)?;
            outputs.push(finite("an output", held.update(value))?);
        }
        Ok(outputs)
    }

    /// The response to a step of one, from the instant of the step on, so many samples a period in s apart.
    ///
    /// # Errors
    /// As [`held`](Self::held).
    pub fn step_response(&self, period: f64, samples: usize) -> Result<Vec<f64>, ModelError> {
        let mut held = self.held(period)?;
        Ok((0..samples).map(|_| held.update(1.0)).collect())
    }

    /// The response to an impulse of one, just after it, so many samples a period in s apart: `C e^(A t) B`.
    ///
    /// With as many zeros as poles there is an impulse of the size of the gain in the output too, which no sample shows.
    ///
    /// # Errors
    /// As [`held`](Self::held).
    pub fn impulse_response(&self, period: f64, samples: usize) -> Result<Vec<f64>, ModelError> {
        let mut held = self.held(period)?;
        held.state = self.realised().b;
        Ok((0..samples).map(|_| held.update(0.0)).collect())
    }
}

fn finite(parameter: &'static str, value: f64) -> Result<f64, ModelError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(ModelError::Parameter { parameter, range: "finite", value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Complex;

    #[test]
    fn nothing_that_is_not_finite_goes_in_or_comes_out() {
        let lag = TransferFunction::with_dc_gain(&[], &[Complex::new(-2.0, 0.0)], 3.0).expect("stable");
        for value in [f64::NAN, f64::INFINITY] {
            let asked = lag.respond(&[1.0, value], 0.1);
            assert!(matches!(asked, Err(ModelError::Parameter { parameter: "an input", .. })));
        }
        let runaway = TransferFunction::new(&[], &[Complex::new(700.0, 0.0)], 1.0).expect("a function");
        let asked = runaway.respond(&[1.0; 8], 1.0);
        assert!(matches!(asked, Err(ModelError::Parameter { parameter: "an output", .. })));
    }
}
