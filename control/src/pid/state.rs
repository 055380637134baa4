//! What a PID controller remembers from tick to tick.

use profiles::Real;

/// The memory of one PID controller; every number in it is finite.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PidState<F = f64> {
    /// The integral as a contribution to the output, so that a change of `ki` alone makes no bump.
    pub(super) integral: F,
    /// The filtered derivative, without its gain.
    pub(super) derivative: F,
    /// Set-point and measurement of the last valid tick.
    pub(super) setpoint: F,
    pub(super) measurement: F,
    /// Output of the last valid tick before and after the limits; in manual mode the output to give.
    pub(super) unlimited: F,
    pub(super) output: F,
    /// Whether the last tick can be differenced with the next.
    pub(super) primed: bool,
    pub(super) manual: bool,
}

impl<F: Real> PidState<F> {
    /// Automatic, with no integral and no past.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Forgets everything, the mode too.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// Goes over to manual, or stays there: from the next tick on the output is `output` within the limits, and the
    /// integral follows it. An `output` that is not finite stands for the last valid output.
    pub fn set_manual(&mut self, output: F) {
        if output.is_finite() {
            self.output = output;
            self.unlimited = output;
        }
        self.manual = true;
    }

    /// Goes back to automatic. The output goes on from its manual value: with the set-point met it does not change,
    /// otherwise by the ordinary step of one tick.
    pub fn set_automatic(&mut self) {
        self.manual = false;
    }

    /// Whether the output is given by hand.
    #[must_use]
    pub fn is_manual(&self) -> bool {
        self.manual
    }

    /// The last valid output, or the manual one to give next; zero before the first tick.
    #[must_use]
    pub fn output(&self) -> F {
        self.output
    }

    /// The contribution of the integral to the output, in the unit of the output.
    #[must_use]
    pub fn integral(&self) -> F {
        self.integral
    }

    /// Adds to the integral, unless the sum overflows; whether it did.
    pub(crate) fn shift_integral(&mut self, shift: F) -> bool {
        let integral = self.integral + shift;
        let fits = integral.is_finite();
        if fits {
            self.integral = integral;
        }
        fits
    }

    /// The filtered derivative of the error (or minus that of the measurement), without its gain.
    #[must_use]
    pub fn derivative(&self) -> F {
        self.derivative
    }
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "numbers that are exact in binary")]
mod tests {
    use super::*;

    #[test]
    fn a_manual_output_is_finite() {
        let mut state = PidState::new();
        state.set_manual(2.0);
        state.set_manual(f64::NAN);
        assert_eq!(state.output(), 2.0);
        assert!(state.is_manual());
        state.reset();
        assert_eq!(state, PidState::default());
    }
}
