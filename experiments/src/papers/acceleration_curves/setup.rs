//! What the paper prints of its bench, and what had to be found.

use anyhow::Result;
use control::PidGains;
use profiles::{Cosine, Limits, Profile, SCurve, SnapLimited, Trapezoid};

use crate::figure::Role;

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

// Section 4 of the paper.
/// Top speed, m/s.
pub(super) const VELOCITY: f64 = 0.2;
/// Limit of the acceleration, m/s^2.
pub(super) const ACCELERATION: f64 = 4.0;
/// Mass of the mover, kg, on an air bearing without friction.
pub(super) const MASS: f64 = 45.0;
/// Gain of the acceleration feedforward, N s^2/m: 3 kg short of the mass.
pub(super) const FEEDFORWARD: f64 = 42.0;
/// Resolution of the encoder, m.
pub(super) const RESOLUTION: f64 = 1e-6;
/// Rate of the controller, Hz.
pub(super) const CONTROL_RATE: u64 = 2500;

// Not printed, and found from the printed ramp times.
/// Limit of the jerk, m/s^3: 0.07 s = V/A + A/J.
pub(super) const JERK: f64 = 200.0;
/// Limit of the derivative of jerk, m/s^4: 0.086 s = V/A + A/J + J/D.
pub(super) const SNAP: f64 = 12_500.0;
/// Length of a whole move, m: fitted to the peaks of figure 8.
pub(super) const DISTANCE: f64 = 0.04;

/// Ticks of the simulation between two of the controller.
pub(super) const CONTROL_EVERY: u32 = 40;
/// Step of the continuous loop, s: 6 % of its fastest time constant, m / K_D of the printed gains.
pub(super) const STEP: f64 = 2e-6;
/// Time after the start of a ramp for which its error is looked at, s.
pub(super) const RAMP_HORIZON: f64 = 0.15;
/// Time for which the error of a whole move is looked at, s: 80 ms past the end of the slowest.
pub(super) const MOVE_HORIZON: f64 = 0.37;

/// A motion law of the paper.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Law {
    Trapezoid,
    SCurve,
    SnapLimited,
    Cosine,
}

impl Law {
    pub(super) const ALL: [Self; 4] = [Self::Trapezoid, Self::SCurve, Self::SnapLimited, Self::Cosine];
    /// The laws of figures 7 and 8.
    pub(super) const COMPARED: [Self; 3] = [Self::SCurve, Self::SnapLimited, Self::Cosine];

    pub(super) fn id(self) -> &'static str {
        match self {
            Self::Trapezoid => "trapezoid",
            Self::SCurve => "s-curve",
            Self::SnapLimited => "snap-limited",
            Self::Cosine => "cosine",
        }
    }

    pub(super) fn role(self) -> Role {
        match self {
            Self::Trapezoid => Role::Reference,
            Self::SCurve => Role::Ours,
            Self::SnapLimited => Role::Second,
            Self::Cosine => Role::Third,
        }
    }

    /// Printed ramp time, s, and printed peak error, m.
    pub(super) fn printed(self) -> Option<(f64, f64)> {
        match self {
            Self::Trapezoid => None,
            Self::SCurve => Some((0.07, 6.5e-6)),
            Self::SnapLimited => Some((0.086, 6.3e-6)),
            Self::Cosine => Some((0.08, 5.9e-6)),
        }
    }

    /// From rest to top speed.
    pub(super) fn ramp(self) -> Result<Box<dyn Profile>> {
        let limits = limits()?;
        Ok(match self {
            Self::Trapezoid => Box::new(Trapezoid::velocity_ramp(0.0, VELOCITY, &limits)?),
            Self::SCurve => Box::new(SCurve::velocity_ramp(0.0, VELOCITY, &limits)?),
            Self::SnapLimited => Box::new(SnapLimited::velocity_ramp(0.0, VELOCITY, &limits)?),
            Self::Cosine => Box::new(Cosine::velocity_ramp(0.0, VELOCITY, &limits)?),
        })
    }

    /// Up, cruise and down.
    pub(super) fn whole_move(self) -> Result<Box<dyn Profile>> {
        let limits = limits()?;
        Ok(match self {
            Self::Trapezoid => Box::new(Trapezoid::rest_to_rest(DISTANCE, &limits)?),
            Self::SCurve => Box::new(SCurve::rest_to_rest(DISTANCE, &limits)?),
            Self::SnapLimited => Box::new(SnapLimited::rest_to_rest(DISTANCE, &limits)?),
            Self::Cosine => Box::new(Cosine::rest_to_rest(DISTANCE, &limits)?),
        })
    }
}

pub(super) fn limits() -> Result<Limits> {
    Ok(Limits::new(VELOCITY, ACCELERATION, JERK)?.with_snap(SNAP)?)
}

/// A way to read what the paper leaves open about figure 8.
pub(super) struct Reading {
    pub(super) id: &'static str,
    pub(super) title: &'static str,
    pub(super) gains: PidGains,
    pub(super) whole_move: bool,
}

/// The reading that comes closest to print.
pub(super) const WHOLE_MOVE: Reading = Reading {
    id: "exchanged-40mm",
    title: "exchanged, whole move of 40 mm",
    gains: PidGains { kp: 1.3e6, ki: 1.8e7, kd: 4.6e4 },
    whole_move: true,
};

/// Every reading, in the order of the report.
pub(super) const READINGS: [Reading; 4] = [
    Reading {
        id: "printed",
        title: "gains as printed, ramp alone",
        gains: PidGains { kp: 4.6e4, ki: 1.8e7, kd: 1.3e6 },
        whole_move: false,
    },
    Reading {
        id: "exchanged",
        title: "K_P and K_D exchanged, ramp alone",
        gains: PidGains { kp: 1.3e6, ki: 1.8e7, kd: 4.6e4 },
        whole_move: false,
    },
    Reading {
        id: "exchanged-no-integral",
        title: "exchanged, K_I = 0, ramp alone",
        gains: PidGains { kp: 1.3e6, ki: 0.0, kd: 4.6e4 },
        whole_move: false,
    },
    WHOLE_MOVE,
];

impl Reading {
    pub(super) fn reference(&self, law: Law) -> Result<Box<dyn Profile>> {
        if self.whole_move { law.whole_move() } else { law.ramp() }
    }

    pub(super) fn horizon(&self) -> f64 {
        if self.whole_move { MOVE_HORIZON } else { RAMP_HORIZON }
    }
}
