//! One tick of the PID law.

use profiles::Real;

use super::{Pid, PidState};

/// What a PID controller is told at a tick.
///
/// ```
/// use control::PidInput;
///
/// let input = PidInput { feedforward: 3.0, ..PidInput::new(1.0, 0.9) };
/// assert_eq!(input.realised, None);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PidInput<F = f64> {
    /// Set-point `r`.
    pub setpoint: F,
    /// Measurement `y`, in the unit of the set-point.
    pub measurement: F,
    /// Feedforward `ff`, in the unit of the output.
    pub feedforward: F,
    /// The output that the actuator was left with at the previous tick, after every later limit (voltage circle, rate
    /// limit, inner loop); `None`: what this controller gave.
    ///
    /// With [`AntiWindup::Clamping`](crate::AntiWindup::Clamping) it is compared exactly: pass the limited command, not
    /// a noisy measurement of it.
    pub realised: Option<F>,
}

impl<F: Real> PidInput<F> {
    /// Set-point and measurement, without feedforward, the previous output realised as given.
    #[inline]
    #[must_use]
    pub fn new(setpoint: F, measurement: F) -> Self {
        Self { setpoint, measurement, feedforward: F::ZERO, realised: None }
    }
}

/// What a PID controller answers at a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PidOutput<F = f64> {
    /// The output `u`: always finite and within the limits.
    pub output: F,
    /// How it came about.
    pub status: Status,
}

/// How an output came about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Status {
    /// The control law, within the limits.
    #[default]
    Regular,
    /// The control law asked for less than the lower limit.
    AtLower,
    /// The control law asked for more than the upper limit.
    AtUpper,
    /// The output was given by hand.
    Manual,
    /// An input was not finite, or the arithmetic overflowed: the last valid output, brought into the limits.
    Held,
}

impl<F: Real> Pid<F> {
    /// One tick. With period `h`, filter time constant `tau`, tracking time `T` and error `e = r - y`:
    ///
    /// ```text
    /// d_k = (tau d_(k-1) + s_k - s_(k-1)) / (tau + h)                    s = e, or -y on measurement; 0 at the first tick
    /// I_k = I_(k-1) + ki h e_k + h / (T + h) (realised_(k-1) - v_(k-1))  last term with back-calculation only
    /// v_k = ff_k + kp e_k + I_k + kd d_k
    /// u_k = v_k within the limits
    /// ```
    ///
    /// All three are backward Euler: the current error counts before it is used. With clamping, `I_k` takes of
    /// `ki h e_k` only what does not move `v_k` beyond a limit, and nothing in a direction in which the actuator fell
    /// short of `u_(k-1)`.
    ///
    /// An input that is not finite leaves `state` untouched to the bit and returns the last valid output (zero before
    /// the first tick) within the limits, with [`Status::Held`]; the next valid tick goes on from there, and its
    /// derivative takes the whole gap for one period. Finite inputs that overflow are answered alike, except that the
    /// derivative starts afresh, so that one absurd sample cannot hold the output for good.
    ///
    /// In manual mode `u_k` is the manual output within the limits and `I_k = u_k - ff_k - kp e_k - kd d_k`.
    ///
    /// # References
    /// K. J. Åström, R. M. Murray, *Feedback Systems*, 2nd ed., Princeton University Press, 2021, chapter 11.
    #[inline(always)]
    #[must_use]
    pub fn update(&self, state: &mut PidState<F>, input: PidInput<F>) -> PidOutput<F> {
        let PidInput { setpoint, measurement, feedforward, realised } = input;
        let realised = realised.unwrap_or(state.output);
        let error = setpoint - measurement;
        let (difference, beyond, shortfall) = if state.primed {
            (
                self.setpoint_share * (setpoint - state.setpoint) - (measurement - state.measurement),
                realised - state.unlimited,
                state.output - realised,
            )
        } else {
            (F::ZERO, F::ZERO, F::ZERO)
        };
        let derivative = self.filter_memory * state.derivative + self.filter_gain * difference;
        let known = feedforward + self.gains.kp * error + self.gains.kd * derivative;

        let integral;
        let unlimited;
        let mut status = Status::Regular;
        if state.manual {
            unlimited = self.limited(state.output);
            integral = unlimited - known;
            status = Status::Manual;
        } else {
            let mut increment = self.integral_step * error + self.tracking * beyond;
            let mut kept = increment;
            if self.clamping {
                let short_above = (increment > F::ZERO) & (shortfall > F::ZERO);
                let short_below = (increment < F::ZERO) & (shortfall < F::ZERO);
                if short_above | short_below {
                    increment = F::ZERO;
                }
                let before = known + state.integral;
                kept =
                    increment.clamped((self.lower - before).min(F::ZERO), (self.upper - before).max(F::ZERO));
            }
            integral = state.integral + kept;
            unlimited = known + (state.integral + increment);
            if unlimited < self.lower {
                status = Status::AtLower;
            } else if unlimited > self.upper {
                status = Status::AtUpper;
            }
        }
        // A term that is not finite makes a sum with it so.
        let remembered = known + integral;
        if !(unlimited.is_finite() & remembered.is_finite() & realised.is_finite()) {
            return self.hold(state, &input);
        }
        let output = self.limited(unlimited);
        *state = PidState {
            integral,
            derivative,
            setpoint,
            measurement,
            unlimited: remembered,
            output,
            primed: true,
            manual: state.manual,
        };
        PidOutput { output, status }
    }

    /// A finite `output` brought into the limits.
    #[inline]
    pub(crate) fn limited(&self, output: F) -> F {
        lesser(greater(output, self.lower), self.upper)
    }

    #[cold]
    fn hold(&self, state: &mut PidState<F>, input: &PidInput<F>) -> PidOutput<F> {
        let inputs =
            [input.setpoint, input.measurement, input.feedforward, input.realised.unwrap_or(F::ZERO)];
        if inputs.iter().all(|value| value.is_finite()) {
            state.primed = false;
            state.derivative = F::ZERO;
        }
        PidOutput { output: self.limited(state.output), status: Status::Held }
    }
}

// One instruction each, where `Real::min` and `max` also sort out NaN: here a NaN ends in `hold`.
#[inline]
fn lesser<F: Real>(a: F, b: F) -> F {
    if a < b { a } else { b }
}

#[inline]
fn greater<F: Real>(a: F, b: F) -> F {
    if a > b { a } else { b }
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "numbers that are exact in binary")]
mod tests {
    use super::*;
    use crate::{DerivativeOn, PidGains};

    fn pid() -> Pid {
        Pid::new(PidGains { kp: 2.0, ki: 4.0, kd: 1.0 }, 0.5).expect("valid")
    }

    #[test]
    fn a_sequence_by_hand() {
        // h = 0.5: ki h = 2, 1/h = 2; every number is exact in binary.
        //   r    y   ff |  e     2 e    I = I + 2 e   d = 2 (e - e_old)   u = ff + 2 e + I + d
        //   1    0    0 |  1     2      0 + 2 = 2     0 (first tick)      0 + 2 + 2 + 0     = 4
        //   1   0.5   0 |  0.5   1      2 + 1 = 3     2 (-0.5) = -1       0 + 1 + 3 - 1     = 3
        //   1   1.25  3 | -0.25 -0.5    3 - 0.5 = 2.5 2 (-0.75) = -1.5    3 - 0.5 + 2.5 - 1.5 = 3.5
        //   2   1.25  0 |  0.75  1.5    2.5 + 1.5 = 4 2 (1) = 2           0 + 1.5 + 4 + 2   = 7.5
        let mut state = PidState::new();
        for (setpoint, measurement, feedforward, output) in
            [(1.0, 0.0, 0.0, 4.0), (1.0, 0.5, 0.0, 3.0), (1.0, 1.25, 3.0, 3.5), (2.0, 1.25, 0.0, 7.5)]
        {
            let input = PidInput { feedforward, ..PidInput::new(setpoint, measurement) };
            assert_eq!(pid().update(&mut state, input), PidOutput { output, status: Status::Regular });
        }
    }

    #[test]
    fn a_filtered_sequence_on_the_measurement_by_hand() {
        // tau = 0.5: d = (0.5 d_old - (y - y_old)) / 1
        //   y = 0: d = 0;  y = 1: d = -1;  y = 1: d = -0.5;  y = 3: d = -0.25 - 2 = -2.25
        let pid =
            pid().with_derivative_on(DerivativeOn::Measurement).with_derivative_filter(0.5).expect("valid");
        let mut state = PidState::new();
        // The set-point jumps about and must not matter.
        for (setpoint, measurement, derivative) in
            [(5.0, 0.0, 0.0), (-7.0, 1.0, -1.0), (2.0, 1.0, -0.5), (0.0, 3.0, -2.25)]
        {
            let _ = pid.update(&mut state, PidInput::new(setpoint, measurement));
            assert_eq!(state.derivative(), derivative);
        }
    }

    #[test]
    fn limits_cut_and_say_so() {
        let pid = pid().with_output_limits(-1.0, 3.0).expect("valid");
        let mut state = PidState::new();
        assert_eq!(
            pid.update(&mut state, PidInput::new(2.0, 0.0)),
            PidOutput { output: 3.0, status: Status::AtUpper }
        );
        // kp e = 4 is beyond the limit by itself: the integral took nothing.
        assert_eq!(state.integral(), 0.0);
        assert_eq!(
            pid.update(&mut state, PidInput::new(-5.0, 0.0)),
            PidOutput { output: -1.0, status: Status::AtLower }
        );
    }

    #[test]
    fn clamping_fills_the_integral_up_to_the_limit() {
        let pid = pid().with_output_limits(-1.0, 3.0).expect("valid");
        let mut state = PidState::new();
        // kp e = 2 leaves room for 1 of the 2 that the integral would take.
        assert_eq!(pid.update(&mut state, PidInput::new(1.0, 0.0)).status, Status::AtUpper);
        assert_eq!(state.integral(), 1.0);
        // Back at the set-point the output leaves the limit at once: I + kd d = 1 - 2, limited to -1.
        assert_eq!(pid.update(&mut state, PidInput::new(1.0, 1.0)).output, -1.0);
        assert_eq!(pid.update(&mut state, PidInput::new(1.0, 1.0)).output, 1.0);
    }

    #[test]
    fn clamping_heeds_the_actuator() {
        let mut state = PidState::new();
        let _ = pid().update(&mut state, PidInput::new(1.0, 0.0)); // u = 4, I = 2
        let short = PidInput { realised: Some(3.5), ..PidInput::new(1.0, 0.0) };
        assert_eq!(pid().update(&mut state, short).output, 4.0, "2 e + I without the increment");
        assert_eq!(state.integral(), 2.0);
        let other_way = PidInput { realised: Some(3.5), ..PidInput::new(0.0, 1.0) };
        let _ = pid().update(&mut state, other_way);
        assert_eq!(state.integral(), 0.0, "an error of -1 takes 2 off");
    }

    #[test]
    fn before_the_first_tick_zero_is_held_within_the_limits() {
        let pid = pid().with_output_limits(1.0, 2.0).expect("valid");
        let mut state = PidState::new();
        let held = pid.update(&mut state, PidInput::new(f64::NAN, 0.0));
        assert_eq!(held, PidOutput { output: 1.0, status: Status::Held });
        assert_eq!(state, PidState::new());
    }

    #[test]
    fn the_first_tick_ignores_what_the_actuator_did_before() {
        let mut state = PidState::new();
        let input = PidInput { realised: Some(-50.0), ..PidInput::new(1.0, 0.0) };
        assert_eq!(pid().update(&mut state, input).output, 4.0);
    }

    #[test]
    fn one_absurd_sample_does_not_hold_for_good() {
        let pid = Pid::new(PidGains { kp: 1.0, ki: 0.0, kd: 1.0 }, 0.5).expect("valid");
        let mut state = PidState::new();
        let mut status = |y| pid.update(&mut state, PidInput::new(0.0, y)).status;
        assert_eq!(status(1.5e308), Status::Regular);
        assert_eq!(status(0.0), Status::Held, "1.5e308 / 0.5 overflows");
        assert_eq!(status(0.0), Status::Regular, "the derivative started afresh");
    }

    #[test]
    fn a_derivative_that_overflows_the_sum_is_forgotten() {
        let pid = Pid::new(PidGains { kp: -1.0, ki: 2.0, kd: 1.0 }, 0.5)
            .and_then(|p| p.with_derivative_filter(0.5))
            .expect("valid")
            .with_derivative_on(DerivativeOn::Measurement);
        let mut state = PidState::new();
        let mut status = |r, y| pid.update(&mut state, PidInput::new(r, y)).status;
        let huge = 1.5e308;
        assert_eq!(status(0.0, 0.0), Status::Regular);
        // kp e = -huge, I = huge, d = huge: the sum is huge.
        assert_eq!(status(0.0, -huge), Status::Regular);
        // kp e = 0, I = huge, d = huge / 2 overflow, and would for ever with d kept.
        assert_eq!(status(-huge, -huge), Status::Held);
        assert_eq!(status(-huge, -huge), Status::Regular);
    }

    #[test]
    fn clamping_fills_the_integral_down_to_the_lower_limit() {
        let pid = pid().with_output_limits(-3.0, 1.0).expect("valid");
        let mut state = PidState::new();
        // kp e = -2 leaves room for 1 of the 2 that the integral would take.
        assert_eq!(pid.update(&mut state, PidInput::new(-1.0, 0.0)).status, Status::AtLower);
        assert_eq!(state.integral(), -1.0);
    }
}
