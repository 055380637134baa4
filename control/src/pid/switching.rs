//! Changes of configuration and starts without a bump.

use profiles::Real;

use super::{Pid, PidInput, PidOutput, PidState, Status};

impl<F: Real> Pid<F> {
    /// Prepares `state`, so far driven by `old`, for this configuration, between two ticks.
    ///
    /// With `e` and `d` of the last valid tick the integral becomes
    ///
    /// `I' = I + (kp_old - kp_new) e + (kd_old - kd_new) d`,
    ///
    /// so that `kp e + I + kd d`, and with it the output, is the same before and after to rounding, as far as the new
    /// limits allow. The integral is a contribution to the output: a change of `ki` alone shifts nothing. Where the
    /// new `ki` is zero the integral stays as a constant bias until [`PidState::reset`]. A shift that overflows
    /// is not made.
    pub fn take_over(&self, old: &Self, state: &mut PidState<F>) {
        let error = state.setpoint - state.measurement;
        let integral = state.integral
            + (old.gains.kp - self.gains.kp) * error
            + (old.gains.kd - self.gains.kd) * state.derivative;
        if integral.is_finite() {
            state.integral = integral;
        }
    }

    /// Starts `state` afresh in automatic mode as if this controller had given `output` at `input` with the derivative
    /// at zero: the next tick goes on from there (flying start). The answer is the output within the limits.
    ///
    /// An input or output that is not finite leaves the state as it is and answers as
    /// [`Pid::update`] does.
    pub fn preset(&self, state: &mut PidState<F>, output: F, input: PidInput<F>) -> PidOutput<F> {
        let mut fresh = PidState::new();
        fresh.set_manual(output);
        let answer = self.update(&mut fresh, input);
        fresh.set_automatic();
        if answer.status == Status::Manual && output.is_finite() {
            *state = fresh;
            answer
        } else {
            PidOutput { output: self.limited(state.output), status: Status::Held }
        }
    }
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "numbers that are exact in binary")]
mod tests {
    use super::*;
    use crate::PidGains;

    fn pid(kp: f64, ki: f64, kd: f64) -> Pid {
        Pid::new(PidGains { kp, ki, kd }, 0.5).expect("valid")
    }

    #[test]
    fn the_integral_takes_the_difference_of_the_gains() {
        let (old, new) = (pid(2.0, 4.0, 1.0), pid(3.0, 0.0, 5.0));
        let mut state = PidState::new();
        let _ = old.update(&mut state, PidInput::new(1.0, 0.0)); // e = 1, d = 0, I = 2
        let _ = old.update(&mut state, PidInput::new(3.0, 0.0)); // e = 3, d = 4, I = 2 + 6
        new.take_over(&old, &mut state);
        // 8 + (2 - 3) 3 + (1 - 5) 4, exact
        assert_eq!(state.integral(), -11.0);
        // The set-point met and d = (0 - 3) / 0.5: the bias stays, -11 + 5 (-6).
        assert_eq!(new.update(&mut state, PidInput::new(3.0, 3.0)).output, -41.0);
        assert_eq!(new.update(&mut state, PidInput::new(3.0, 3.0)).output, -11.0);
    }

    #[test]
    fn a_shift_that_overflows_is_not_made() {
        let mut state = PidState::new();
        let (old, new) = (pid(1.0, 0.0, 0.0), pid(1e300, 0.0, 0.0));
        let _ = old.update(&mut state, PidInput::new(1e300, 0.0));
        new.take_over(&old, &mut state);
        assert_eq!(state.integral(), 0.0);
    }

    #[test]
    fn a_preset_is_the_output_to_go_on_from() {
        let pid = pid(2.0, 4.0, 1.0).with_output_limits(-20.0, 20.0).expect("valid");
        let mut state = PidState::new();
        assert_eq!(pid.preset(&mut state, 7.0, PidInput::new(1.0, 1.0)).output, 7.0);
        assert_eq!(pid.update(&mut state, PidInput::new(1.0, 1.0)).output, 7.0);
        assert_eq!(pid.preset(&mut state, 90.0, PidInput::new(1.0, 1.0)).output, 20.0);
        let before = state;
        assert_eq!(pid.preset(&mut state, f64::NAN, PidInput::new(1.0, 1.0)).status, Status::Held);
        assert_eq!(pid.preset(&mut state, 1.0, PidInput::new(f64::NAN, 1.0)).status, Status::Held);
        assert_eq!(state, before);
        assert!(!state.is_manual());
    }
}
