//! A linear motor under a sampled PD controller with an encoder and a computation delay: prints how the error of a
//! step to 1 mm falls, for three delays.

use plants::nalgebra::{self, vector};
use plants::{Clock, Encoder, LinearMotor, Simulation, ZeroOrderHold};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let motor = LinearMotor::new(2.0, 5.0)?.driven_by_current(40.0)?.with_force_limit(200.0)?;
    let scale = Encoder::new(0.1e-6)?;
    let clock = Clock::from_frequency(100_000)?;
    let target = 1e-3;

    for delay in [0.0, 0.5, 1.0] {
        let simulation = Simulation::new(clock, clock.ticks(0.1)?)
            .control_every(40)?
            .record_every(10)?
            .delay(delay)?
            .saturation(motor.saturation());
        let period = simulation.control_period();
        // The position measured one period ago.
        let mut previous = 0.0;
        let recording = simulation
            .run(
                &mut ZeroOrderHold::new(motor),
                vector![0.0, 0.0],
                &mut previous,
                |previous, tick| {
                    let position = scale.quantise(tick.state[0]);
                    let velocity = (position - *previous) / period;
                    *previous = position;
                    vector![1200.0 * (target - position) - 9.0 * velocity]
                },
                [("error", "m"), ("current", "A")],
                |_, probe| [target - probe.state[0], probe.input[0]],
            )?
            .completed()?;
        println!("delay of {delay} periods, largest current {} A", recording.max_abs("current")?);
        for (time, error) in recording.time().iter().zip(recording.column("error")?).step_by(100) {
            println!("  {time:5.2} s  {:9.3} um", error * 1e6);
        }
    }
    Ok(())
}
