//! The servo of figure 4: field-oriented control of a motor that drives a load through a spring.

use anyhow::{Result, ensure};
use control::{
    Cascade, CurrentLoop, Dq, FieldOriented, FieldOrientedInput, FieldOrientedState, PiGains, Windings,
};
use plants::nalgebra::{self, SVector, vector};
use plants::{
    Clock, EnergyLedger, PmsmDrive, PmsmWindings, Rk4, Simulation, TwoInertia, eigenvalues, linearise,
    monodromy, spectral_radius,
};
use profiles::{Mode, Sample};

use super::setup::{
    CONTROL_RATE, FLUX, INDUCTANCE, POLE_PAIRS, RESISTANCE, ROTOR_FRICTION, ROTOR_INERTIA, RPM, System,
};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// What the paper leaves out of its loops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LoopParameters {
    /// Integral gain of the velocity loop, A min/(r s).
    pub(super) velocity_integral: f64,
    /// Bandwidth of the current loop, rad/s.
    pub(super) current_bandwidth: f64,
    /// Viscous damping of the spring, N m s.
    pub(super) spring_damping: f64,
    /// Viscous damping of the load, N m s.
    pub(super) load_damping: f64,
}

/// What the ledger of any run may leave open, as a part of its largest entry.
pub(super) const LARGEST_IMBALANCE: f64 = 1e-6;

/// A servo ready to run.
pub(super) struct Servo {
    drive: PmsmDrive,
    control: FieldOriented,
    spectral_radius: f64,
}

/// The course of a move.
pub(super) struct Response {
    /// Time between two samples, s.
    pub(super) period: f64,
    /// Angle of the load, rad.
    pub(super) load: Vec<f64>,
    /// Twist of the spring, rad.
    pub(super) twist: Vec<f64>,
    /// Where the energy went.
    pub(super) ledger: EnergyLedger,
}

impl Response {
    /// Angle of the motor, rad.
    pub(super) fn motor(&self) -> Vec<f64> {
        self.load.iter().zip(&self.twist).map(|(load, twist)| load + twist).collect()
    }

    pub(super) fn points(&self, value: impl Fn(usize) -> f64) -> Vec<(f64, f64)> {
        (0..self.load.len()).map(|k| (k as f64 * self.period, value(k))).collect()
    }

    /// The index of the first sample at or after `instant` in s.
    pub(super) fn index(&self, instant: f64) -> usize {
        ((instant / self.period).round() as usize).min(self.load.len() - 1)
    }
}

impl Servo {
    pub(super) fn new(system: &System, loops: &LoopParameters) -> Result<Self> {
        let windings = PmsmWindings::surface(RESISTANCE, INDUCTANCE, FLUX, POLE_PAIRS)?;
        let mechanics = TwoInertia::new(ROTOR_INERTIA, system.load_inertia, system.stiffness)?.with_damping(
            ROTOR_FRICTION,
            loops.spring_damping,
            loops.load_damping,
        )?;
        let drive = PmsmDrive::new(windings, mechanics);
        let period = 1.0 / CONTROL_RATE as f64;
        let velocity = PiGains { kp: system.velocity_gain / RPM, ki: loops.velocity_integral / RPM };
        let motor = Windings {
            resistance: RESISTANCE,
            d_inductance: INDUCTANCE,
            q_inductance: INDUCTANCE,
            flux: FLUX,
        };
        let control = FieldOriented::new(
            Cascade::new(system.position_gain, velocity, period)?,
            CurrentLoop::tuned(motor, loops.current_bandwidth, period)?,
            POLE_PAIRS,
        )?;
        let at_rest = linearise(&drive, &SVector::zeros(), &SVector::zeros())?;
        Ok(Self { drive, control, spectral_radius: spectral_radius(at_rest.a())? })
    }

    /// Follows `command`, the angle wanted at an instant, for `horizon` s, with `substeps` of Runge and Kutta to a tick.
    pub(super) fn run(
        &self,
        mut command: impl FnMut(f64) -> f64,
        horizon: f64,
        substeps: u32,
    ) -> Result<Response> {
        let clock = Clock::from_frequency(CONTROL_RATE)?;
        let simulation = Simulation::new(clock, clock.ticks(horizon)?);
        let mut stepper = Rk4::fixed(self.drive, substeps, self.spectral_radius)?.metered();
        let outcome = simulation.run(
            &mut stepper,
            SVector::zeros(),
            &mut FieldOrientedState::new(),
            |memory, tick| {
                let [along, across, angle, speed] = [0, 1, 2, 3].map(|k| tick.state[k]);
                let reference = Sample::at_rest(command(tick.time));
                let input = FieldOrientedInput::new(reference, angle, speed, Dq { d: along, q: across });
                let voltage = self.control.update(memory, input).voltage;
                vector![voltage.d, voltage.q, 0.0]
            },
            [("load", "rad"), ("twist", "rad")],
            |_, probe| [probe.state[4], probe.state[2] - probe.state[4]],
        )?;
        let recording = outcome.completed()?;
        let open = stepper.ledger().relative_imbalance();
        ensure!(open < LARGEST_IMBALANCE, "the ledger of the energy is open by {open:e}");
        Ok(Response {
            period: simulation.record_period(),
            load: recording.column("load")?.to_vec(),
            twist: recording.column("twist")?.to_vec(),
            ledger: *stepper.ledger(),
        })
    }

    /// The modes of the sampled loop about rest. Their poles are the logarithms of the eigenvalues of one tick over the
    /// period.
    pub(super) fn modes(&self) -> Result<Vec<Mode>> {
        let period = 1.0 / CONTROL_RATE as f64;
        let values = eigenvalues(&self.tick()?)?;
        // A motor that is free to turn has no pole at zero here: the position loop holds it.
        ensure!(values.iter().all(|z| z.norm() < 1.0), "the loop is unstable");
        let poles = values.iter().filter(|z| z.im > 0.0).map(|z| z.ln() / period);
        poles.map(|p| Ok(Mode::new(p.norm(), -p.re / p.norm())?)).collect()
    }

    /// One tick of the loop about rest: the six states of the drive, the integral of the velocity loop, and those of the
    /// current loop along both axes.
    fn tick(&self) -> Result<plants::nalgebra::SMatrix<f64, 9, 9>> {
        let period = 1.0 / CONTROL_RATE as f64;
        let drive = linearise(&self.drive, &SVector::zeros(), &SVector::zeros())?.discretise(period)?;
        let velocity = self.control.cascade().velocity_gains();
        let (current, position) =
            (self.control.current_loop().q_gains(), self.control.cascade().position_gain());
        let reset = 1.0 - (-period * current.ki / current.kp).exp();
        let back_emf = f64::from(POLE_PAIRS) * FLUX;
        Ok(monodromy(|x: &SVector<f64, 9>| {
            let [along, across, angle, speed] = [0, 1, 2, 3].map(|k| x[k]);
            let speed_error = -position * angle - speed;
            let integral = x[6] + velocity.ki * period * speed_error;
            let wanted = velocity.kp * speed_error + integral;
            let (error_d, error_q) = (-along, wanted - across);
            let voltage =
                vector![current.kp * error_d + x[7], current.kp * error_q + x[8] + back_emf * speed, 0.0];
            let next = drive.step(&x.fixed_rows::<6>(0).into_owned(), &voltage);
            let memory =
                vector![integral, x[7] + reset * current.kp * error_d, x[8] + reset * current.kp * error_q];
            SVector::from_fn(|k, _| if k < 6 { next[k] } else { memory[k - 6] })
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::papers::delay_filter::reading::fitted;
    use crate::papers::delay_filter::setup::SYSTEMS;

    const LOOPS: LoopParameters = LoopParameters {
        velocity_integral: 3.45,
        current_bandwidth: 1970.0,
        spring_damping: 0.006,
        load_damping: 0.0,
    };

    /// The matrix of a tick is the loop: a small move ends as its powers say.
    #[test]
    fn the_poles_are_those_of_the_loop_that_runs() {
        for system in &SYSTEMS {
            let servo = Servo::new(system, &LOOPS).expect("servo");
            let target = 1e-6;
            let response = servo.run(|_| target, 0.05, 8).expect("response");
            let tick = servo.tick().expect("tick");
            // About the target everything is at rest but both angles, which are short of it.
            let mut state = SVector::<f64, 9>::zeros();
            (state[2], state[4]) = (-target, -target);
            for load in &response.load {
                assert!((load - target - state[4]).abs() < 1e-9 * target + 1e-6 * state[4].abs());
                state = tick * state;
            }
        }
    }

    /// What a fit finds in the tail of a small move is a pole of the linearised loop.
    #[test]
    fn the_vibration_that_is_seen_is_a_pole() {
        for system in SYSTEMS.iter().filter(|system| system.vibration.is_some()) {
            let servo = Servo::new(system, &LOOPS).expect("servo");
            let response = servo.run(|_| 1e-3, 0.2, 8).expect("response");
            let seen = *fitted(&response, 0.01).first().expect("a mode");
            let modes = servo.modes().expect("modes");
            let there = |mode: &Mode| (mode.pole() - seen.pole()).norm() < 1e-4 * seen.angular_frequency();
            assert!(modes.iter().any(there), "{seen:?} of {modes:?}");
        }
    }
}
