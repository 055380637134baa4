//! What the paper prints of its robot, and what had to be chosen.

use std::f64::consts::TAU;

use profiles::Sample;

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

// Section 3 and table 2 of the paper.
/// Damping `a` in 1/s, stiffness `b` in 1/s^2 and gain `k` of every axis, `theta'' = -a theta' - b theta + k u`.
pub(super) const AXIS: [f64; 3] = [10.0, 1.0, 1.0];
/// Proportional, integral and derivative gain.
pub(super) const PID: [f64; 3] = [600.0, 1.0, 10.0];
/// `alpha` and `beta` of the terminal surface, and its exponents `p` and `q`.
pub(super) const SURFACE: (f64, f64, u32, u32) = (10.0, 1.0, 9, 5);
/// `k` and `eps` of the exponential law.
pub(super) const SMC: [f64; 2] = [200.0, 33.0];
/// `k1`, `k2` and `k3` of the improved double-power law.
pub(super) const DSMC: [f64; 3] = [20.0, 20.0, 200.0];
/// `beta2` and `beta3` of that law; `beta1` is `2 - beta2`.
pub(super) const DSMC_POWERS: [f64; 2] = [1.0 / 3.0, 1.0 / 3.0];
/// `k4` of the integral compensation.
pub(super) const COMPENSATION: f64 = 20.0;
/// Slope `c`, `k` and `eps` of the traditional law of section 4.2.
pub(super) const TRADITIONAL: [f64; 3] = [10.0, 15.0, 0.5];
/// The load on x, N m, and when it comes, s. A torque of 10 N m in the direction of the input, as table 1 needs it: where the
/// model has a load that opposes the motion it is negative.
pub(super) const LOAD: (f64, f64) = (-10.0, 10.0);
/// The gain of the coupling.
pub(super) const COUPLING: f64 = 0.01;

// Not printed.
/// How long a run is, s.
pub(super) const HORIZON: f64 = 15.0;
/// Base rate of the simulation, Hz: the paper's laws are continuous, and 0.1 ms stand for that.
pub(super) const RATE: u64 = 10_000;
/// Time constant of the derivative, s: Simulink's default `N s / (s + N)` with `N = 100`.
pub(super) const DERIVATIVE_FILTER: f64 = 0.01;
/// Start of table 1, at rest and one radian off.
pub(super) const SINGLE_START: f64 = 1.0;
/// Start of table 3: the origin, but for z, whose printed figures are met from ten radians up.
pub(super) const START: [f64; 3] = [0.0, 0.0, 10.0];
/// A start on the path.
pub(super) const ON_PATH: [f64; 3] = [0.0, 1.0, 0.0];
/// One count of the encoder, rad: 17 bits a turn.
pub(super) const COUNT: f64 = TAU / 131_072.0;
/// Time constant of the velocity that is made from counts, s.
pub(super) const VELOCITY_FILTER: f64 = 1e-3;

/// The helix of equation (25): x, y and z at an instant.
pub(super) fn helix(time: f64) -> [Sample; 3] {
    let (sine, cosine) = time.sin_cos();
    let along =
        |position, velocity, acceleration| Sample { position, velocity, acceleration, ..Sample::default() };
    [along(sine, cosine, -sine), along(cosine, -sine, -cosine), along(5.0 * time, 5.0, 0.0)]
}
