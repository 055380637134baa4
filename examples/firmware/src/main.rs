//! Three axes on a bare microcontroller: plan a move when asked, follow it at every tick.
//!
//! There is no allocator. The panic handler calls a function that does not exist, so that the program links only if
//! no panic can be reached: an index that might be out of bounds anywhere below is a link error.

#![no_std]
#![no_main]

mod board;
mod gantry;
mod moves;
mod servo;
mod stepper;

use board::Registers;
use control::{AntiWindup, Feedforward, Pid, PidError, PidGains, PidInput, PidState};
use gantry::Gantry;
use profiles::switched::MoveTable;
use profiles::{
    Cosine, Cursor, Limits, Mode, Profile, Real, SCurve, Sample, Sectioned, SnapLimited, Trapezoid,
};
use servo::Servo;

/// Control period, s.
const PERIOD: f64 = 4e-4;

/// A linear axis driven by a force: its controller and the controller's memory.
struct Axis {
    pid: Pid<f32>,
    feedforward: Feedforward<f32>,
    state: PidState<f32>,
}

impl Axis {
    fn new() -> Result<Self, PidError> {
        let gains = PidGains { kp: 1.3e6, ki: 1.8e7, kd: 4.6e4 };
        let pid = Pid::new(gains, PERIOD as f32)?
            .with_derivative_filter(1e-3)?
            .with_output_limits(-400.0, 400.0)?
            .with_anti_windup(AntiWindup::BackCalculation { tracking_time: 0.02 })?;
        let feedforward = Feedforward::rigid(45.0, 0.0).unwrap_or(Feedforward::NONE);
        Ok(Self { pid, feedforward, state: PidState::new() })
    }

    /// One control tick: reference and measurement in, force out.
    fn tick(&mut self, reference: Sample<f32>, position: f32) -> f32 {
        let feedforward = self.feedforward.force(&reference);
        let input = PidInput { feedforward, ..PidInput::new(reference.position, position) };
        self.pid.update(&mut self.state, input).output
    }

    /// Follows a profile to its end.
    fn follow<P: Sectioned>(&mut self, profile: P, registers: &mut Registers) {
        let Ok(mut cursor) = Cursor::<_, f32>::new(profile, PERIOD) else {
            return registers.report_fault();
        };
        while !cursor.is_finished() {
            let force = self.tick(cursor.tick(), registers.position());
            registers.set_force(force);
        }
    }
}

/// Moves that leave nothing of the load's mode, planned elsewhere: here they are interpolated and corrected.
fn table() -> Option<MoveTable<'static, 12>> {
    let limits = Limits::new(0.5, 5.0, 200.0).ok()?;
    MoveTable::new(moves::MOVES, &limits, &[Mode::from_hz(8.0, 0.02).ok()?], false).ok()
}

/// Plans and follows one move with the law the host asks for.
fn serve(axis: &mut Axis, servo: &mut Servo, registers: &mut Registers) {
    let [distance, velocity, acceleration, jerk, snap] = registers.request();
    let Ok(limits) = Limits::new(velocity, acceleration, jerk).and_then(|l| l.with_snap(snap)) else {
        return registers.report_fault();
    };
    let law = registers.law();
    #[cfg(feature = "provoke-a-panic")]
    let law = law + registers.choice();
    if law == 4 {
        if servo.turn(distance, &limits, registers).is_none() {
            registers.report_fault();
        }
        return;
    }
    if law == 5 {
        if stepper::step(distance, &limits, registers).is_none() {
            registers.report_fault();
        }
        return;
    }
    if law == 9 {
        match Gantry::new(registers.twists()) {
            Some(mut gantry) => gantry.circle(registers),
            None => registers.report_fault(),
        }
        return;
    }
    if law == 10 {
        return match table().and_then(|table| table.rest_to_rest(distance).ok()) {
            Some(motion) => axis.follow(motion, registers),
            None => registers.report_fault(),
        };
    }
    let planned = match law {
        0 => Trapezoid::rest_to_rest(distance, &limits).map(|p| axis.follow(p, registers)),
        1 => SCurve::rest_to_rest(distance, &limits)
            .and_then(|p| p.stretched_to(Real::ceil(p.duration() / PERIOD) * PERIOD))
            .map(|p| axis.follow(p, registers)),
        2 => SnapLimited::rest_to_rest(distance, &limits).map(|p| axis.follow(p, registers)),
        3 => SCurve::velocity_ramp(0.0, velocity, &limits).map(|p| axis.follow(p, registers)),
        6 => Trapezoid::velocity_ramp(0.0, velocity, &limits).map(|p| axis.follow(p, registers)),
        7 => SnapLimited::velocity_ramp(0.0, velocity, &limits).map(|p| axis.follow(p, registers)),
        8 => Cosine::velocity_ramp(0.0, velocity, &limits).map(|p| axis.follow(p, registers)),
        _ => Cosine::rest_to_rest(distance, &limits).map(|p| axis.follow(p, registers)),
    };
    if planned.is_err() {
        registers.report_fault();
    }
}

/// The program.
fn run(registers: &mut Registers) -> Option<()> {
    let mut axis = Axis::new().ok()?;
    let mut servo = Servo::new()?;
    loop {
        serve(&mut axis, &mut servo, registers);
    }
}
