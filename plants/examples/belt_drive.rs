//! A belt drive in a semi-closed loop: the controller sees the encoder of the motor, and the load swings behind it.
//! Prints the frequencies of the drive and what four five-phase curves of the same peak velocity leave in the load.

use std::f64::consts::TAU;

use plants::nalgebra::{self, vector};
use plants::{BeltDrive, Clock, ControlTick, Encoder, Probe, Simulation, ZeroOrderHold};
use profiles::{FivePhase, Profile};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let belt = BeltDrive::new(0.004, 0.03, 2.0)?; // kg m^2, kg m^2, N m/rad
    let encoder = Encoder::from_counts_per_unit(22_800.0)?; // pulses/rad
    println!(
        "motor held: {:.3} Hz, motor free: {:.3} Hz",
        belt.anti_resonance() / TAU,
        belt.resonance() / TAU
    );

    let clock = Clock::from_frequency(1000)?;
    let period = TAU / belt.anti_resonance();
    for phase in [0.05 * period, 0.5 * period, 0.9 * period, period] {
        let curve = FivePhase::over_distance(4.0, 0.0, 1.5, phase)?;
        let end = curve.duration();
        let mut previous = 0.0;
        let recording = Simulation::new(clock, clock.ticks(end + 2.0)?)
            .run(
                &mut ZeroOrderHold::new(belt),
                vector![0.0, 0.0, 0.0, 0.0],
                &mut previous,
                |previous, tick: &ControlTick<'_, 4, 2>| {
                    let angle = encoder.quantise(tick.state[0]);
                    let speed = (angle - *previous) * 1000.0;
                    *previous = angle;
                    let wanted = curve.sample(tick.time);
                    vector![400.0 * (wanted.position - angle) + 2.0 * (wanted.velocity - speed), 0.0]
                },
                [("motor", "pulses"), ("load", "pulses")],
                |_, probe: &Probe<'_, 4, 2>| {
                    [probe.state[0], probe.state[2]].map(|angle| encoder.counts(angle - 4.0) as f64)
                },
            )?
            .completed()?;
        let after = |name| -> Result<f64, plants::RecordingError> {
            let rest = recording.time().iter().zip(recording.column(name)?).filter(|(time, _)| **time > end);
            Ok(rest.fold(0.0, |most: f64, (_, counts)| most.max(counts.abs())))
        };
        println!(
            "T = {phase:.3} s, J = {:7.2} rad/s^3, {end:.2} s: motor within {:3} pulses of the end, load within {:5}",
            curve.jerk(),
            after("motor")?,
            after("load")?,
        );
    }
    Ok(())
}
