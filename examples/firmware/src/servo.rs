//! A motor behind a vibrating load: shaped references, field-oriented control, voltages of three phases.

use control::{
    Cascade, CurrentLoop, Dq, Feedforward, FieldOriented, FieldOrientedInput, FieldOrientedState, PiGains,
    Windings,
};
use profiles::{Cursor, Limits, Mode, Profile, SCurve, Sample, residual_vibration};
use shaping::{DelayFilter, DelayLine, DelayLineState, Shaped};

use crate::board::Registers;

/// Base period, s.
const PERIOD: f64 = 1e-4;
/// What the load may still swing by after a move, rad.
const TOLERANCE: f64 = 1e-6;

/// Taps of the delay line: three impulses, each split between two samples.
const TAPS: usize = 6;
/// Its history, samples: 25.6 ms.
const HISTORY: usize = 256;

/// One motor: its control and the control's memory.
pub struct Servo {
    control: FieldOriented<f32>,
    state: FieldOrientedState<f32>,
}

impl Servo {
    pub fn new() -> Option<Self> {
        let windings =
            Windings { resistance: 2.875, d_inductance: 8.5e-3, q_inductance: 8.5e-3, flux: 0.175 };
        let current_loop = CurrentLoop::tuned(windings, 1970.0, PERIOD as f32)
            .and_then(|l| l.with_voltage_limit(180.0))
            .ok()?;
        let inertia_over_torque_constant = 4.1e-3 / 0.7875;
        let feedforward = Feedforward::NONE.with_acceleration(inertia_over_torque_constant).ok()?;
        let cascade = Cascade::new(180.0, PiGains { kp: 2.3, ki: 33.0 }, PERIOD as f32)
            .and_then(|c| c.with_divisors(10, 2))
            .and_then(|c| c.with_velocity_feedforward(1.0))
            .and_then(|c| c.with_current_limit(20.0))
            .ok()?
            .with_feedforward(feedforward);
        let control = FieldOriented::new(cascade, current_loop, 3).ok()?;
        Some(Self { control, state: FieldOrientedState::new() })
    }

    /// One base tick: reference and measurements in, phase voltages out.
    fn tick(&mut self, reference: Sample<f32>, registers: &mut Registers) {
        let (angle, speed) = registers.motor();
        let input = FieldOrientedInput::new(reference, angle, speed, Dq::default());
        let (currents, rotor) = (registers.currents(), registers.rotor());
        let (_, voltages) = self.control.update_phases(&mut self.state, input, currents, rotor);
        registers.set_voltages(voltages);
    }

    /// Turns the motor by `angle` in rad and leaves the load's mode at rest; the host says how the reference is shaped.
    pub fn turn(&mut self, angle: f64, limits: &Limits, registers: &mut Registers) -> Option<()> {
        let (frequency, damping_ratio, delay) = registers.mode();
        let mode = Mode::from_hz(frequency, damping_ratio).ok()?;
        let filter = DelayFilter::positive(mode, delay).ok()?;
        let profile = SCurve::rest_to_rest(angle, limits).ok()?;
        if registers.shapes_ahead() {
            self.follow_exactly(Shaped::new(profile, *filter.train()), mode, limits, registers)
        } else {
            self.follow_delayed(profile, &filter, mode, registers)
        }
    }

    /// The shaped profile itself, if it keeps the limits and leaves the load at rest.
    fn follow_exactly(
        &mut self,
        shaped: Shaped<SCurve, 3>,
        mode: Mode,
        limits: &Limits,
        registers: &mut Registers,
    ) -> Option<()> {
        let too_fast = shaped.extrema().velocity.magnitude() > limits.velocity().magnitude();
        if too_fast || residual_vibration(&shaped, mode) > TOLERANCE {
            return None;
        }
        let mut cursor = Cursor::<_, f32>::new(shaped, PERIOD).ok()?;
        while !cursor.is_finished() {
            self.tick(cursor.tick(), registers);
        }
        Some(())
    }

    /// The profile through a delay line: one line, one memory for every derivative.
    fn follow_delayed(
        &mut self,
        profile: SCurve,
        filter: &DelayFilter,
        mode: Mode,
        registers: &mut Registers,
    ) -> Option<()> {
        let line = DelayLine::<f32, TAPS, HISTORY>::new(filter.train(), mode, PERIOD).ok()?;
        let mut cursor = Cursor::<_, f32>::new(profile, PERIOD).ok()?;
        let mut memory = [DelayLineState::<f32, HISTORY>::at_rest(0.0); 3];
        let mut rest = HISTORY;
        while rest > 0 {
            let sample = cursor.tick();
            let [positions, velocities, accelerations] = &mut memory;
            let reference = Sample {
                position: line.update(positions, sample.position).output,
                velocity: line.update(velocities, sample.velocity).output,
                acceleration: line.update(accelerations, sample.acceleration).output,
                ..Sample::default()
            };
            self.tick(reference, registers);
            if cursor.is_finished() {
                rest -= 1;
            }
        }
        Some(())
    }
}
