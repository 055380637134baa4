//! Tunes two gains of a loop around an integrator with a lag: prints the search and the response it chose.

use argmin::core::{CostFunction, Error, Executor};
use identify::Signal;
use optimize::{Cost, FitnessWeights, ParticleSwarm, Stall, SwarmOptions};
use profiles::Interval;

const PERIOD: f64 = 1e-3;
const TICKS: usize = 2000;

/// A cart whose drive lags by 20 ms, under a controller of position and velocity.
struct Cart {
    weights: FitnessWeights,
}

impl Cart {
    /// Output and effort of a unit step, by gains in 1/s^2 and 1/s.
    fn step(gains: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let [position_gain, velocity_gain] = *gains else { return (Vec::new(), Vec::new()) };
        let (mut position, mut velocity, mut force) = (0.0, 0.0, 0.0);
        let tick = |_| {
            let effort = position_gain * (1.0 - position) - velocity_gain * velocity;
            force += (effort - force) * PERIOD / 0.02;
            velocity += force * PERIOD;
            position += velocity * PERIOD;
            (position, effort)
        };
        (0..TICKS).map(tick).unzip()
    }
}

impl CostFunction for Cart {
    type Param = Vec<f64>;
    type Output = Cost;
    fn cost(&self, gains: &Vec<f64>) -> Result<Cost, Error> {
        let (output, effort) = Self::step(gains);
        let strongest = effort.iter().fold(0.0, |most: f64, effort| most.max(effort.abs()));
        if strongest > 400.0 {
            return Ok(Cost::Infeasible(strongest - 400.0));
        }
        let fitness = self.weights.of(&Signal::sampled(&output, PERIOD)?, &effort, 0.0, 1.0)?;
        Ok(fitness.total().into())
    }
}

fn main() -> Result<(), Error> {
    let problem = Cart { weights: FitnessWeights::new(1.0, 1e-3, 10.0, 10.0)? };
    let bounds = [Interval::new(1.0, 1000.0), Interval::new(0.0, 100.0)];
    let stall = Some(Stall { iterations: 20, absolute: 0.0, relative: 1e-6 });
    let solver = ParticleSwarm::new(&bounds, SwarmOptions { stall, ..SwarmOptions::new(30, 200) }, 1)?;
    let result = Executor::new(problem, solver).run()?;

    let swarm = result.solver.swarm();
    for progress in swarm.history().iter().step_by(10) {
        println!(
            "{:3}: best {:?}, spread {:.1e}, {} failed",
            progress.iteration, progress.best, progress.spread, progress.failed
        );
    }
    println!("stopped by {:?} after {} evaluations", swarm.stop(), swarm.evaluations());
    let (gains, cost) = swarm.best();
    let (output, _) = Cart::step(gains);
    let response = Signal::sampled(&output, PERIOD)?;
    println!("gains {gains:.1?}, cost {cost:.4?}");
    println!(
        "rise {:.3} s, overshoot {:.2} %",
        response.rise_time(0.0, 1.0)?,
        100.0 * response.overshoot(0.0, 1.0)?
    );
    Ok(())
}
