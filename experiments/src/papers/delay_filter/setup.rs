//! What the paper prints of its servo systems, and what had to be found.

use std::f64::consts::PI;

use anyhow::Result;
use identify::ResponseClass;
use profiles::{Limits, Mode, Trapezoid};

use crate::figure::Role;

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// One revolution a minute, rad/s.
pub(super) const RPM: f64 = PI / 30.0;

// Section 4.1 of the paper.
/// Resistance of a phase, ohm.
pub(super) const RESISTANCE: f64 = 2.875;
/// Inductance along both axes, H.
pub(super) const INDUCTANCE: f64 = 8.5e-3;
/// Flux linkage of the magnets, Wb.
pub(super) const FLUX: f64 = 0.175;
/// Inertia of the rotor, kg m^2.
pub(super) const ROTOR_INERTIA: f64 = 0.003;
/// Viscous friction of the rotor, N m s.
pub(super) const ROTOR_FRICTION: f64 = 0.008;
/// Time constant of the low-pass filter, s: 5 T = 0.022 s.
pub(super) const LOW_PASS: f64 = 0.022 / 5.0;

// Not printed.
/// Pole pairs of the motor: only gain times torque constant shows in a response.
pub(super) const POLE_PAIRS: u32 = 3;
/// Rate of all three loops, Hz.
pub(super) const CONTROL_RATE: u64 = 10_000;
/// How long a response is looked at, s.
pub(super) const HORIZON: f64 = 0.25;

/// A servo system of table 1, with what tables 2 and 3 say of it.
pub(super) struct System {
    pub(super) number: u32,
    pub(super) role: Role,
    /// Position gain, 1/s.
    pub(super) position_gain: f64,
    /// Velocity gain, A min/r: the unit is not printed.
    pub(super) velocity_gain: f64,
    /// Stiffness of the spring, N m/rad.
    pub(super) stiffness: f64,
    /// Inertia of the load, kg m^2.
    pub(super) load_inertia: f64,
    pub(super) class: ResponseClass,
    /// Settling time, s.
    pub(super) settling: f64,
    /// Damping ratio and frequency, printed in Hz and meant in rad/s.
    pub(super) vibration: Option<(f64, f64)>,
    /// Delay of its filter, s, printed in ms and meant in s.
    pub(super) filter_delay: Option<f64>,
}

pub(super) const SYSTEMS: [System; 4] = [
    System {
        number: 1,
        role: Role::Ours,
        position_gain: 190.0,
        velocity_gain: 0.24,
        stiffness: 1000.0,
        load_inertia: 1.066e-3,
        class: ResponseClass::B,
        settling: 0.0901,
        vibration: Some((0.4583, 274.01)),
        filter_delay: Some(0.007),
    },
    System {
        number: 2,
        role: Role::Second,
        position_gain: 180.0,
        velocity_gain: 0.24,
        stiffness: 100.0,
        load_inertia: 5.066e-4,
        class: ResponseClass::C,
        settling: 0.1266,
        vibration: Some((0.0722, 439.92)),
        filter_delay: Some(0.006),
    },
    System {
        number: 3,
        role: Role::Third,
        position_gain: 180.0,
        velocity_gain: 0.16,
        stiffness: 100.0,
        load_inertia: 5.066e-4,
        class: ResponseClass::C,
        settling: 0.1005,
        vibration: Some((0.15, 465.668)),
        filter_delay: Some(0.006),
    },
    System {
        number: 4,
        role: Role::Fourth,
        position_gain: 140.0,
        velocity_gain: 0.24,
        stiffness: 200.0,
        load_inertia: 5.066e-4,
        class: ResponseClass::A,
        settling: 0.0761,
        vibration: None,
        filter_delay: None,
    },
];

impl System {
    /// The mode that table 2 prints.
    pub(super) fn printed_mode(&self) -> Result<Option<Mode>> {
        Ok(self.vibration.map(|(damping, frequency)| Mode::new(frequency, damping)).transpose()?)
    }
}

/// The command of section 3.2: 60 r/min at both ends, 900 r/min on top, 5 ms up, 15 ms on, 5 ms down.
pub(super) fn command() -> Result<Trapezoid> {
    let (ends, top, ramp) = (60.0 * RPM, 900.0 * RPM, 0.005);
    let limits = Limits::new(top, (top - ends) / ramp, f64::INFINITY)?;
    Ok(Trapezoid::with_speeds((ends + top) * ramp + top * 0.015, ends, ends, &limits)?)
}

/// The letter of a class.
pub(super) fn letter(class: ResponseClass) -> &'static str {
    match class {
        ResponseClass::A => "A",
        ResponseClass::B => "B",
        ResponseClass::C => "C",
    }
}
