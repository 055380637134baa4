//! One tick of the current loop.

use profiles::Real;

use super::CurrentLoop;
use crate::transform::Dq;

/// The memory of one current loop; every number in it is finite.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CurrentLoopState<F = f64> {
    integral: Dq<F>,
    /// Error, decoupling and output of the last valid tick.
    error: Dq<F>,
    coupling: Dq<F>,
    output: Dq<F>,
}

impl<F: Real> CurrentLoopState<F> {
    /// No integral and no past.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Forgets everything.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// The contribution of the integrals to the voltage, V; with the gains of pole-zero cancellation it is the drop over
    /// the resistance.
    #[must_use]
    pub fn integral(&self) -> Dq<F> {
        self.integral
    }

    /// The last valid voltage, V; zero before the first tick.
    #[must_use]
    pub fn output(&self) -> Dq<F> {
        self.output
    }
}

/// What a current loop is told at a tick.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CurrentInput<F = f64> {
    /// Reference of the current, A.
    pub reference: Dq<F>,
    /// Measured current, A.
    pub current: Dq<F>,
    /// Electrical speed `w` of the rotor, rad/s: mechanical speed times pole pairs.
    pub speed: F,
    /// The voltage that the inverter gave since the previous tick, V; `None`: what this loop asked for.
    pub realised: Option<Dq<F>>,
}

/// What a current loop answers at a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurrentOutput<F = f64> {
    /// The voltage, V: always finite and, to rounding, within the limit.
    pub voltage: Dq<F>,
    /// How it came about.
    pub status: CurrentStatus,
}

/// How a voltage came about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CurrentStatus {
    /// The control law, within the limit.
    Regular,
    /// The control law asked for more voltage than there is.
    Limited,
    /// An input was not finite, or the arithmetic overflowed: the last valid voltage, brought into the limit.
    Held,
}

impl<F: Real> CurrentLoop<F> {
    /// One tick. With period `h`, electrical speed `w` and error `e = reference - current` of each axis:
    ///
    /// ```text
    /// c_d = -w L_q i_q              c_q = w (L_d i_d + psi)
    /// I_k = I_(k-1) + (1 - e^(-h ki / kp)) (realised_(k-1) - c_(k-1) - I_(k-1))
    /// v_k = kp e_k + I_k + c_k
    /// ```
    ///
    /// Where the voltage was given as asked, `realised - c - I` is `kp e`, and the integral grows by `ki h e` to first
    /// order in `h`. Where it was not, the integral follows the voltage there was as the drop over the resistance of the
    /// winding does: with the gains of pole-zero cancellation, `kp / ki = L / R`, it is that drop at every tick, exactly so
    /// for a voltage held over the period, limited or not. Nothing winds up, and the current arrives without overshoot.
    ///
    /// At the voltage limit `V` the d axis comes first: `v_d` within `[-V, V]`, then `v_q` within the rest,
    /// `|v_q| <= sqrt(V^2 - v_d^2)`. The flux stays where it belongs while the torque gives way.
    ///
    /// An input that is not finite leaves `state` untouched to the bit and returns the last valid voltage (zero before the
    /// first tick) within the limit, with [`CurrentStatus::Held`]. Finite inputs that overflow are answered alike, except
    /// that the integral starts afresh, so that one absurd sample cannot hold the output for good.
    #[inline(always)]
    #[must_use]
    pub fn update(&self, state: &mut CurrentLoopState<F>, input: CurrentInput<F>) -> CurrentOutput<F> {
        let CurrentInput { reference, current, speed, realised } = input;
        let realised = realised.unwrap_or(state.output);
        let error = Dq { d: reference.d - current.d, q: reference.q - current.q };
        let coupling = Dq {
            d: -(speed * (self.q_inductance * current.q)),
            q: speed * (self.d_inductance * current.d + self.flux),
        };
        let before = state.integral;
        let integral = Dq {
            d: before.d + self.d_reset * (realised.d - (state.coupling.d + before.d)),
            q: before.q + self.q_reset * (realised.q - (state.coupling.q + before.q)),
        };
        let asked = Dq {
            d: self.d_gains.kp * error.d + (integral.d + coupling.d),
            q: self.q_gains.kp * error.q + (integral.q + coupling.q),
        };
        // A term that is not finite makes a sum with it so.
        if !asked.is_finite() {
            return self.hold(state, &input);
        }
        let voltage = self.limited(asked);
        *state = CurrentLoopState { integral, error, coupling, output: voltage };
        let status = if voltage == asked { CurrentStatus::Regular } else { CurrentStatus::Limited };
        CurrentOutput { voltage, status }
    }

    /// Prepares `state`, so far driven by `old`, for the gains of this configuration, between two ticks.
    ///
    /// With `e` of the last valid tick each integral becomes `I' = I + (kp_old - kp_new) e`, so that `kp e + I` is the same
    /// before and after to rounding. The integral is a contribution to the voltage: a change of `ki` alone shifts nothing.
    /// A shift that overflows is not made. What a new decoupling adds is not taken back.
    pub fn take_over(&self, old: &Self, state: &mut CurrentLoopState<F>) {
        let integral = Dq {
            d: state.integral.d + (old.d_gains.kp - self.d_gains.kp) * state.error.d,
            q: state.integral.q + (old.q_gains.kp - self.q_gains.kp) * state.error.q,
        };
        if integral.is_finite() {
            state.integral = integral;
        }
    }

    /// A finite `voltage` brought into the circle, the d axis first.
    #[inline]
    pub(crate) fn limited(&self, voltage: Dq<F>) -> Dq<F> {
        if voltage.d * voltage.d + voltage.q * voltage.q <= self.voltage_limit_squared {
            return voltage;
        }
        let d = voltage.d.clamped(-self.voltage_limit, self.voltage_limit);
        let rest = (self.voltage_limit_squared - d * d).max(F::ZERO).sqrt();
        Dq { d, q: voltage.q.clamped(-rest, rest) }
    }

    #[cold]
    fn hold(&self, state: &mut CurrentLoopState<F>, input: &CurrentInput<F>) -> CurrentOutput<F> {
        let vectors = [input.reference, input.current, input.realised.unwrap_or_default()];
        if vectors.iter().all(Dq::is_finite) & input.speed.is_finite() {
            *state = CurrentLoopState { output: state.output, ..CurrentLoopState::default() };
        }
        CurrentOutput { voltage: self.limited(state.output), status: CurrentStatus::Held }
    }
}
