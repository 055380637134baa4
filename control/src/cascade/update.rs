//! One base tick of the cascade.

use profiles::{Real, Sample};

use super::Cascade;
use crate::finite::all_finite;
use crate::pid::{PidInput, PidState, Status};

/// The memory of one cascade; every number in it is finite.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CascadeState<F = f64> {
    /// Base ticks until either loop runs again.
    position_wait: u32,
    velocity_wait: u32,
    /// What the position loop saw and said when it ran last.
    position_error: F,
    reference_velocity: F,
    velocity_command: F,
    velocity_loop: PidState<F>,
    /// How the current came about when the velocity loop ran last.
    status: Status,
}

impl<F: Real> CascadeState<F> {
    /// No integral and no past; both loops run at the next tick.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Forgets everything.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// The last command of the position loop, rad/s.
    #[must_use]
    pub fn velocity_command(&self) -> F {
        self.velocity_command
    }

    /// The last valid current, A; zero before the first tick.
    #[must_use]
    pub fn current(&self) -> F {
        self.velocity_loop.output()
    }

    /// The contribution of the velocity loop's integral to the current, A.
    #[must_use]
    pub fn integral(&self) -> F {
        self.velocity_loop.integral()
    }
}

/// What a cascade is told at a base tick.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CascadeInput<F = f64> {
    /// The motion wanted of the motor; [`Sample::at_rest`] where only a position is given.
    pub reference: Sample<F>,
    /// Measured angle of the motor, rad.
    pub position: F,
    /// Measured speed of the motor, rad/s.
    pub velocity: F,
    /// Current to add to that of the velocity loop, A.
    pub feedforward: F,
    /// The current that the inner loop was left with since the velocity loop ran last, A, see
    /// [`PidInput::realised`](crate::PidInput::realised); `None`: what this cascade gave.
    pub realised: Option<F>,
}

impl<F: Real> CascadeInput<F> {
    /// Reference, angle and speed, without further feedforward, the current realised as given.
    #[inline]
    #[must_use]
    pub fn new(reference: Sample<F>, position: F, velocity: F) -> Self {
        Self { reference, position, velocity, feedforward: F::ZERO, realised: None }
    }

    #[inline]
    pub(crate) fn is_finite(&self) -> bool {
        let Sample { position, velocity, acceleration, jerk, snap } = self.reference;
        let realised = self.realised.unwrap_or(F::ZERO);
        let feedback = [self.position, self.velocity, self.feedforward, realised];
        all_finite([position, velocity, acceleration, jerk, snap]) & all_finite(feedback)
    }
}

/// What a cascade answers at a base tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CascadeOutput<F = f64> {
    /// The current to command, A: always finite and within the limit. Times the torque constant it is a torque.
    pub current: F,
    /// How it came about when the velocity loop ran last, or [`Status::Held`].
    pub status: Status,
}

impl<F: Real> Cascade<F> {
    /// One base tick. With the reference `r`, the angle `x` and the speed `v` of the motor:
    ///
    /// ```text
    /// every position_divisor ticks:  v_c = k (r - x) + f r'  within the velocity limit
    /// every velocity_divisor ticks:  i   = kp (v_c - v) + I + feedforward  within the current limit
    /// ```
    ///
    /// with the integral `I`, its anti-windup and the statuses of [`Pid::update`](crate::Pid::update). In between either
    /// command is held. The position loop runs first, so that at a common tick the velocity loop has its new command; the
    /// first tick runs both.
    ///
    /// An input that is not finite leaves `state` untouched to the bit, at every tick, and returns the last valid current
    /// (zero before the first tick) within the limit, with [`Status::Held`]: the loops run one base tick later. Finite
    /// inputs that overflow in a loop make that loop hold its command.
    #[inline(always)]
    #[must_use]
    pub fn update(&self, state: &mut CascadeState<F>, input: CascadeInput<F>) -> CascadeOutput<F> {
        if input.is_finite() {
            self.step(state, input)
        } else {
            CascadeOutput { current: self.held_current(state), status: Status::Held }
        }
    }

    /// The last valid current within the limit, A.
    #[inline]
    pub(crate) fn held_current(&self, state: &CascadeState<F>) -> F {
        self.velocity_loop.limited(state.velocity_loop.output())
    }

    /// A tick with finite input.
    #[inline(always)]
    pub(crate) fn step(&self, state: &mut CascadeState<F>, input: CascadeInput<F>) -> CascadeOutput<F> {
        let (position_divisor, velocity_divisor) = self.divisors();
        let mut position_held = false;
        if is_due(&mut state.position_wait, position_divisor) {
            let error = input.reference.position - input.position;
            let command = self.commanded_velocity(error, input.reference.velocity);
            if all_finite([error, command]) {
                state.position_error = error;
                state.reference_velocity = input.reference.velocity;
                state.velocity_command = command;
            } else {
                position_held = true;
            }
        }
        let current = if is_due(&mut state.velocity_wait, velocity_divisor) {
            let loop_input = PidInput {
                setpoint: state.velocity_command,
                measurement: input.velocity,
                feedforward: self.feedforward().force(&input.reference) + input.feedforward,
                realised: input.realised,
            };
            let answer = self.velocity_loop.update(&mut state.velocity_loop, loop_input);
            state.status = answer.status;
            answer.output
        } else {
            self.held_current(state)
        };
        let status = if position_held { Status::Held } else { state.status };
        CascadeOutput { current, status }
    }

    /// Prepares `state`, so far driven by `old`, for this configuration, between two ticks.
    ///
    /// The command of the position loop becomes what these gains make of its last error, and the velocity loop's integral
    /// takes up the difference that this and its own gains make: the current is the same before and after to rounding, as
    /// far as the new limits allow. What another feedforward adds is not taken back. A change that overflows is not made.
    pub fn take_over(&self, old: &Self, state: &mut CascadeState<F>) {
        let command = self.commanded_velocity(state.position_error, state.reference_velocity);
        let shift = self.velocity_gains().kp * (state.velocity_command - command);
        if !all_finite([command, shift]) {
            return;
        }
        self.velocity_loop.take_over(&old.velocity_loop, &mut state.velocity_loop);
        if state.velocity_loop.shift_integral(shift) {
            state.velocity_command = command;
        }
    }
}

/// Whether a loop runs at this tick; counts the tick.
#[inline]
fn is_due(wait: &mut u32, divisor: u32) -> bool {
    // Under a smaller divisor than before, a longer wait is over.
    let due = *wait == 0 || *wait >= divisor;
    *wait = if due { divisor - 1 } else { *wait - 1 };
    due
}
