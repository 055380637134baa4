//! From a reference of motion to the voltages of a motor.

use profiles::{Real, Sample};

use crate::cascade::{Cascade, CascadeInput, CascadeState};
use crate::current::{CurrentInput, CurrentLoop, CurrentLoopState, CurrentStatus};
use crate::error::FieldOrientedError;
use crate::finite::all_finite;
use crate::pid::Status;
use crate::transform::{Dq, Phases, Rotation};

/// Field-oriented control with `i_d = 0`: a [`Cascade`] whose current is the q reference of a [`CurrentLoop`].
///
/// Any number of axes may share it, each with its own [`FieldOrientedState`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "UncheckedFieldOriented<F>",
        into = "UncheckedFieldOriented<F>",
        bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
    )
)]
pub struct FieldOriented<F = f64> {
    cascade: Cascade<F>,
    current_loop: CurrentLoop<F>,
    pole_pairs: u32,
    /// The pole pairs as a real number.
    speed_ratio: F,
}

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(
    deny_unknown_fields,
    bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
)]
struct UncheckedFieldOriented<F> {
    cascade: Cascade<F>,
    current_loop: CurrentLoop<F>,
    pole_pairs: u32,
}

#[cfg(feature = "serde")]
impl<F: Real> TryFrom<UncheckedFieldOriented<F>> for FieldOriented<F> {
    type Error = FieldOrientedError;
    fn try_from(unchecked: UncheckedFieldOriented<F>) -> Result<Self, FieldOrientedError> {
        Self::new(unchecked.cascade, unchecked.current_loop, unchecked.pole_pairs)
    }
}

#[cfg(feature = "serde")]
impl<F: Real> From<FieldOriented<F>> for UncheckedFieldOriented<F> {
    fn from(control: FieldOriented<F>) -> Self {
        let FieldOriented { cascade, current_loop, pole_pairs, .. } = control;
        Self { cascade, current_loop, pole_pairs }
    }
}

/// The memory of one field-oriented control; every number in it is finite.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FieldOrientedState<F = f64> {
    cascade: CascadeState<F>,
    current_loop: CurrentLoopState<F>,
    /// Whether the voltage fell short at the last valid tick.
    is_short: bool,
    /// Where the rotor stood at the last valid tick in phases.
    rotor: Option<Rotation<F>>,
}

impl<F: Real> FieldOrientedState<F> {
    /// No integral and no past; all loops run at the next tick.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Forgets everything.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// The memory of the position and velocity loop.
    #[must_use]
    pub fn cascade(&self) -> &CascadeState<F> {
        &self.cascade
    }

    /// The memory of the current loop.
    #[must_use]
    pub fn current_loop(&self) -> &CurrentLoopState<F> {
        &self.current_loop
    }
}

/// What a field-oriented control is told at a base tick.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FieldOrientedInput<F = f64> {
    /// The motion wanted of the motor; [`Sample::at_rest`] where only a position is given.
    pub reference: Sample<F>,
    /// Measured angle of the motor, rad (mechanical).
    pub position: F,
    /// Measured speed of the motor, rad/s (mechanical).
    pub velocity: F,
    /// Measured current, A.
    pub current: Dq<F>,
    /// Current to add to that of the velocity loop, A.
    pub feedforward: F,
    /// The voltage that the inverter gave since the previous tick, V; `None`: what this control asked for.
    pub realised: Option<Dq<F>>,
}

impl<F: Real> FieldOrientedInput<F> {
    /// Reference, angle, speed and current, without further feedforward, the voltage realised as given.
    #[inline]
    #[must_use]
    pub fn new(reference: Sample<F>, position: F, velocity: F, current: Dq<F>) -> Self {
        Self { reference, position, velocity, current, feedforward: F::ZERO, realised: None }
    }
}

/// What a field-oriented control answers at a base tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldOrientedOutput<F = f64> {
    /// The voltage, V: always finite and, to rounding, within the limit.
    pub voltage: Dq<F>,
    /// The q reference of the current loop, A.
    pub current: F,
    /// How the q reference came about.
    pub cascade: Status,
    /// How the voltage came about.
    pub current_loop: CurrentStatus,
}

impl<F: Real> FieldOriented<F> {
    /// Position and velocity loop, current loop, and the `pole_pairs` by which the electrical speed exceeds the mechanical.
    ///
    /// # Errors
    /// No pole pairs, or loops on different base periods.
    pub fn new(
        cascade: Cascade<F>,
        current_loop: CurrentLoop<F>,
        pole_pairs: u32,
    ) -> Result<Self, FieldOrientedError> {
        if pole_pairs == 0 {
            return Err(FieldOrientedError::PolePairs);
        }
        let (outer, inner) = (cascade.period(), current_loop.period());
        // The same period, written as a product and as a quotient.
        if (outer - inner).abs() > F::from_f64(4.0) * F::EPSILON * inner {
            return Err(FieldOrientedError::Periods {
                cascade: outer.to_f64(),
                current_loop: inner.to_f64(),
            });
        }
        Ok(Self { cascade, current_loop, pole_pairs, speed_ratio: F::from_u32(pole_pairs) })
    }

    /// The position and velocity loop.
    #[must_use]
    pub fn cascade(&self) -> &Cascade<F> {
        &self.cascade
    }

    /// The current loop.
    #[must_use]
    pub fn current_loop(&self) -> &CurrentLoop<F> {
        &self.current_loop
    }

    /// The pole pairs.
    #[must_use]
    pub fn pole_pairs(&self) -> u32 {
        self.pole_pairs
    }

    /// One base tick in rotor axes: [`Cascade::update`], then [`CurrentLoop::update`] with the references `i_d = 0` and
    /// `i_q` from the cascade and the electrical speed.
    ///
    /// As long as the voltage falls short of what the current loop asks for, the velocity loop's anti-windup goes by the
    /// measured `i_q`, otherwise by the current it commanded.
    ///
    /// An input that is not finite leaves `state` untouched to the bit and returns the last valid voltage and current
    /// within their limits, held by both loops.
    #[inline(always)]
    #[must_use]
    pub fn update(
        &self,
        state: &mut FieldOrientedState<F>,
        input: FieldOrientedInput<F>,
    ) -> FieldOrientedOutput<F> {
        let FieldOrientedInput { reference, position, velocity, current, feedforward, realised } = input;
        let flowing = if state.is_short { Some(current.q) } else { None };
        let outer = CascadeInput { reference, position, velocity, feedforward, realised: flowing };
        let given = realised.unwrap_or_default();
        if !(outer.is_finite() & all_finite([current.d, current.q, given.d, given.q])) {
            return self.held(state);
        }
        let outer = self.cascade.step(&mut state.cascade, outer);
        let inner = CurrentInput {
            reference: Dq { d: F::ZERO, q: outer.current },
            current,
            speed: self.speed_ratio * velocity,
            realised,
        };
        let inner = self.current_loop.update(&mut state.current_loop, inner);
        state.is_short = inner.status == CurrentStatus::Limited;
        FieldOrientedOutput {
            voltage: inner.voltage,
            current: outer.current,
            cascade: outer.status,
            current_loop: inner.status,
        }
    }

    /// One base tick in phases: [`FieldOriented::update`] with the measured `currents` of the phases in A in place of
    /// `input.current`, seen from `rotor`; the voltages of the phases in V beside its answer.
    ///
    /// A `rotor` that is none, `sin^2 + cos^2` not within `[1/2, 2]`, counts as an input that is not finite, as currents that
    /// are not finite do; the voltages are then those of the last valid rotor.
    #[inline(always)]
    #[must_use]
    pub fn update_phases(
        &self,
        state: &mut FieldOrientedState<F>,
        input: FieldOrientedInput<F>,
        currents: Phases<F>,
        rotor: Rotation<F>,
    ) -> (FieldOrientedOutput<F>, Phases<F>) {
        let input = FieldOrientedInput { current: currents.to_dq(rotor), ..input };
        let output = if rotor.is_turn() { self.update(state, input) } else { self.held(state) };
        if output.current_loop != CurrentStatus::Held {
            state.rotor = Some(rotor);
        }
        (output, output.voltage.to_phases(state.rotor.unwrap_or_default()))
    }

    /// Prepares `state`, so far driven by `old`, for this configuration, between two ticks, as [`Cascade::take_over`] and
    /// [`CurrentLoop::take_over`] do.
    pub fn take_over(&self, old: &Self, state: &mut FieldOrientedState<F>) {
        self.cascade.take_over(&old.cascade, &mut state.cascade);
        self.current_loop.take_over(&old.current_loop, &mut state.current_loop);
    }

    #[cold]
    fn held(&self, state: &FieldOrientedState<F>) -> FieldOrientedOutput<F> {
        FieldOrientedOutput {
            voltage: self.current_loop.limited(state.current_loop.output()),
            current: self.cascade.held_current(&state.cascade),
            cascade: Status::Held,
            current_loop: CurrentStatus::Held,
        }
    }
}
