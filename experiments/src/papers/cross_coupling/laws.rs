//! The laws that are compared, as they run on one axis.

use anyhow::Result;
use control::{
    AxisModel, DisturbanceInput, DisturbanceObserver, DisturbanceObserverState, Pid, PidGains, PidInput,
    PidState, ReachingLaw, Sampling, SlidingMode, SlidingModeInput, SlidingModeState, SlidingSurface,
    SuperTwisting, SuperTwistingState, Switching,
};
use profiles::Sample;

use super::setup::{
    AXIS, COMPENSATION, DERIVATIVE_FILTER, DSMC, DSMC_POWERS, PID, SMC, SURFACE, TRADITIONAL,
};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// A law and its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Law {
    /// PID with a filtered derivative.
    Pid,
    /// Terminal surface, exponential law: equation (19).
    Smc,
    /// The same with a boundary layer of a width in rad/s.
    SmcInLayer(f64),
    /// Terminal surface, improved double-power law, integral compensation: equation (24).
    Dsmc,
    /// The same with another `alpha` in 1/s.
    DsmcOn { alpha: f64 },
    /// The same as printed, with its reaching law matched to the sampling.
    DsmcMatched,
    /// Linear surface, exponential law: the traditional one of table 3.
    Traditional,
    /// Linear surface of a slope in 1/s, super-twisting for loads that change by so many N m/s, matched to the sampling.
    SuperTwisting { slope: f64, load_rate: f64 },
    /// Linear surface of a slope in 1/s that decays as fast, and an observer of a bandwidth in rad/s for velocity and load.
    Observed { slope: f64, bandwidth: f64 },
}

impl Law {
    /// The three of table 1.
    pub(super) const SINGLE: [(&'static str, Self); 3] =
        [("pid", Self::Pid), ("smc", Self::Smc), ("dsmc", Self::Dsmc)];
    /// The three of table 3.
    pub(super) const ROBOT: [(&'static str, Self); 3] =
        [("pid", Self::Pid), ("smc", Self::Traditional), ("dsmc", Self::Dsmc)];

    /// One axis under the law at a control period in s.
    pub(super) fn axis(self, period: f64) -> Result<Axis> {
        let [damping, stiffness, gain] = AXIS;
        let model = AxisModel::new(damping, stiffness, gain)?;
        let (alpha, beta, p, q) = SURFACE;
        let terminal = SlidingSurface::terminal(alpha, beta, p, q)?;
        let sliding =
            |surface, law| -> Result<SlidingMode> { Ok(SlidingMode::new(surface, law, model, period)?) };
        let dsmc = |alpha| -> Result<SlidingMode> {
            let ([k1, k2, k3], [b2, b3]) = (DSMC, DSMC_POWERS);
            let surface = SlidingSurface::terminal(alpha, beta, p, q)?;
            let law = sliding(surface, ReachingLaw::improved_double_power(k1, k2, k3, b2, b3)?)?;
            Ok(law.with_integral_compensation(COMPENSATION)?)
        };
        let config = match self {
            Self::Pid => {
                let [kp, ki, kd] = PID;
                let pid =
                    Pid::new(PidGains { kp, ki, kd }, period)?.with_derivative_filter(DERIVATIVE_FILTER)?;
                let mut state = PidState::new();
                // The filter of a block diagram starts from zero, not from the first error.
                let _ = pid.update(&mut state, PidInput::new(0.0, 0.0));
                return Ok(Axis::Pid(pid, state));
            }
            Self::Smc => sliding(terminal, ReachingLaw::exponential(SMC[0], SMC[1])?)?,
            Self::SmcInLayer(width) => {
                let law = ReachingLaw::exponential(SMC[0], SMC[1])?;
                sliding(terminal, law.with_switching(Switching::Saturation { width })?)?
            }
            Self::Dsmc => dsmc(alpha)?,
            Self::DsmcOn { alpha } => dsmc(alpha)?,
            Self::DsmcMatched => dsmc(alpha)?.with_sampling(Sampling::Matched)?,
            Self::SuperTwisting { slope, load_rate } => {
                let surface = SlidingSurface::linear(slope)?;
                let law = SuperTwisting::for_load_rate(surface, load_rate, model, period)?;
                return Ok(Axis::Twisting(law.with_sampling(Sampling::Matched), SuperTwistingState::new()));
            }
            Self::Observed { slope, bandwidth } => {
                let law = sliding(SlidingSurface::linear(slope)?, ReachingLaw::exponential(slope, 0.0)?)?;
                let observer = DisturbanceObserver::new(model, bandwidth, period)?;
                return Ok(Axis::Observed(
                    law,
                    SlidingModeState::new(),
                    observer,
                    DisturbanceObserverState::new(),
                ));
            }
            Self::Traditional => {
                let [c, k, eps] = TRADITIONAL;
                sliding(SlidingSurface::linear(c)?, ReachingLaw::exponential(k, eps)?)?
            }
        };
        Ok(Axis::Sliding(config, SlidingModeState::new()))
    }
}

/// What an axis is told at a tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct Told {
    /// Where it should be.
    pub(super) reference: Sample,
    /// Where it is measured to be, rad.
    pub(super) position: f64,
    /// How fast it is measured to move, rad/s.
    pub(super) velocity: f64,
    /// Its error after the coupling, rad.
    pub(super) error: f64,
    /// The rate of that, rad/s.
    pub(super) error_rate: f64,
}

/// One axis under a law, with its memory.
#[derive(Clone, Copy, Debug)]
pub(super) enum Axis {
    Pid(Pid, PidState),
    Sliding(SlidingMode, SlidingModeState),
    Twisting(SuperTwisting, SuperTwistingState),
    Observed(SlidingMode, SlidingModeState, DisturbanceObserver, DisturbanceObserverState),
}

impl Axis {
    /// Position in rad and velocity in rad/s as the law takes them: as measured, or as its observer has them.
    pub(super) fn observe(&mut self, measured: (f64, f64)) -> (f64, f64) {
        match self {
            Self::Observed(_, state, observer, memory) => {
                let input = DisturbanceInput { position: measured.0, realised: state.output() };
                let estimate = observer.update(memory, input);
                (estimate.position, estimate.velocity)
            }
            _ => measured,
        }
    }

    /// The torque of this tick, N m.
    pub(super) fn update(&mut self, told: &Told) -> f64 {
        let input = SlidingModeInput::new(&told.reference, told.position, told.velocity)
            .with_error(told.error, told.error_rate);
        match self {
            Self::Pid(pid, state) => pid.update(state, PidInput::new(told.error, 0.0)).output,
            Self::Sliding(law, state) => law.update(state, input).output,
            Self::Twisting(law, state) => law.update(state, input).output,
            Self::Observed(law, state, _, memory) => {
                let load = memory.estimate().load;
                law.update(state, SlidingModeInput { load, ..input }).output
            }
        }
    }
}
