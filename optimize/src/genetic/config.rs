//! What a swarm with a genetic pool may be told.

use crate::error::SwarmError;
use crate::swarm::{Schedule, SwarmOptions};

/// How a swarm with a genetic pool moves and breeds. One generation:
///
/// 1. the particles are evaluated where they are, and their personal bests follow,
/// 2. the better part passes on as it is; the personal bests of the others, the pool, are crossed and mutated as they
///    are, with no encoding, and each child is evaluated,
/// 3. a child that is better takes the place of its parent's personal best, and the best of all follows,
/// 4. velocities and positions follow the rule of [`SwarmOptions`].
///
/// With an empty pool it is a plain swarm; without flight, where a particle rests at its personal best and its child
/// takes its place, a plain genetic algorithm with truncation.
///
/// ```
/// use optimize::{GeneticOptions, SwarmOptions};
///
/// let hybrid = GeneticOptions::new(400, 1000);
/// let swarm = GeneticOptions { pool: 0.0, ..hybrid };
/// let genetic = GeneticOptions::genetic(400, 1000);
/// assert_eq!(hybrid.swarm.cognitive.at(999, 1000), 1.2);
/// assert!(swarm.flight && !genetic.flight);
/// ```
///
/// # References
/// Y. Nan, X. Zhang, "Motion control system for NURBS curve degree reduction and interpolation", patent CN103345201A
/// (2013): the order of the steps, the part that passes on, inertia and pulls. It is silent on the operators, on their
/// rates and on the bounds; its step back to the random start is read as one to the evaluation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields, default))]
pub struct GeneticOptions {
    /// How many particles there are, how they move and when the search stops.
    pub swarm: SwarmOptions,
    /// Whether particles fly; if not, only the first generation evaluates all of them, the others their children.
    pub flight: bool,
    /// The part of the particles that enters the pool, 0 to 1: those with the worse positions in this generation.
    pub pool: f64,
    /// Whom a particle in the pool is crossed with.
    pub mates: Mates,
    /// How two personal bests are crossed.
    pub crossover: Crossover,
    /// How probable it is that they are.
    pub crossover_rate: f64,
    /// How a coordinate mutates.
    pub mutation: Mutation,
    /// How probable it is for a coordinate; a child that would be its parent's copy mutates in one coordinate anyway.
    pub mutation_rate: f64,
}

impl Default for GeneticOptions {
    /// 400 particles and 1000 iterations.
    fn default() -> Self {
        Self::new(400, 1000)
    }
}

impl GeneticOptions {
    /// The hybrid, as published but for its mates: inertia 0.675, both pulls `1.2 + 0.8 (N - t) / N` at move
    /// `t = 1, 2, ... N`, half of the particles in the pool. What was not published is what searched best: coordinates
    /// from either parent at a rate of 0.8, one in fifty drawn anew; at the bounds as [`SwarmOptions::new`]. The mates
    /// published are [`Mates::Pool`]: with them it ended up to a fifth above a plain swarm of as many evaluations, with
    /// [`Mates::All`] level with it or below.
    #[must_use]
    pub const fn new(particles: usize, iterations: u64) -> Self {
        let moves = if iterations == 0 { 1.0 } else { iterations as f64 };
        let pull = Schedule::Linear { from: 2.0 - 0.8 / moves, to: 1.2 };
        let inertia = Schedule::Constant(0.675);
        let plain = SwarmOptions::new(particles, iterations);
        Self {
            swarm: SwarmOptions { inertia, cognitive: pull, social: pull, ..plain },
            flight: true,
            pool: 0.5,
            mates: Mates::All,
            crossover: Crossover::Uniform,
            crossover_rate: 0.8,
            mutation: Mutation::Anywhere,
            mutation_rate: 0.02,
        }
    }

    /// A plain genetic algorithm: no flight, mates from the whole population.
    #[must_use]
    pub const fn genetic(particles: usize, iterations: u64) -> Self {
        Self { flight: false, ..Self::new(particles, iterations) }
    }

    /// How many particles enter the pool.
    pub(super) fn pooled(&self) -> usize {
        let pooled = (self.pool * self.swarm.particles as f64).round() as usize;
        pooled.min(self.swarm.particles)
    }

    pub(super) fn check(&self) -> Result<(), SwarmError> {
        self.swarm.check()?;
        let part = |quantity, value: f64| {
            let range = "0 to 1";
            if (0.0..=1.0).contains(&value) {
                Ok(())
            } else {
                Err(SwarmError::Number { quantity, range, value })
            }
        };
        part("the part in the pool", self.pool)?;
        part("the rate of crossover", self.crossover_rate)?;
        part("the rate of mutation", self.mutation_rate)?;
        if !self.flight && self.pooled() == 0 {
            let (quantity, range) = ("the part in the pool without flight", "enough for one particle");
            return Err(SwarmError::Number { quantity, range, value: self.pool });
        }
        if let Crossover::Blend { beyond: value } = self.crossover
            && !(value >= 0.0 && value.is_finite())
        {
            let (quantity, range) = ("the reach of a blend", "finite and not negative");
            return Err(SwarmError::Number { quantity, range, value });
        }
        if let Mutation::Nearby { reach: value } = self.mutation
            && !(value > 0.0 && value <= 1.0)
        {
            let (quantity, range) = ("the reach of a mutation", "above 0 and at most 1");
            return Err(SwarmError::Number { quantity, range, value });
        }
        Ok(())
    }
}

/// Whom a particle in the pool is crossed with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Mates {
    /// Another particle of the pool, as published: the worse breed among themselves.
    Pool,
    /// Any other particle: the worse learn from the better, too.
    All,
}

/// How the personal bests of a parent and its mate are crossed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Crossover {
    /// A point of the line between them, uniform.
    Arithmetic,
    /// In each coordinate a number uniform from `beyond` times their distance before one to as much after the other,
    /// held within the bounds.
    ///
    /// # References
    /// L. J. Eshelman, J. D. Schaffer, "Real-coded genetic algorithms and interval-schemata", Foundations of Genetic
    /// Algorithms 2 (1993), <https://doi.org/10.1016/B978-0-08-094832-4.50018-0>.
    Blend {
        /// How far beyond them, in their distance; finite, not negative.
        beyond: f64,
    },
    /// Each coordinate from one of them, by the toss of a coin.
    Uniform,
}

/// How a coordinate mutates.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Mutation {
    /// Anywhere between its bounds, uniform.
    Anywhere,
    /// By at most this part of the width between its bounds, uniform, held within them.
    Nearby {
        /// The part, above 0 and at most 1.
        reach: f64,
    },
}
