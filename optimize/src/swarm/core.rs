//! The swarm, stepped by hand.

use profiles::Interval;

use super::config::{Stop, SwarmOptions, Topology};
use super::motion::{Factors, scatter};
use super::progress::{Progress, spread};
use super::stream::Stream;
use crate::cost::Cost;
use crate::error::SwarmError;

/// A swarm of particles that looks for the least cost in a box, one generation at a time: [`Swarm::ask`] for the
/// candidates, evaluate them in any order and on any machine, [`Swarm::tell`] the costs.
///
/// Everything random is drawn from [`Stream`]s by (seed, particle, iteration): the same costs give the same candidates
/// to the bit, on every platform, however the evaluations were done and however often the swarm was written and read.
/// While all that a particle can see has failed, it is drawn anew from the whole box.
///
/// ```
/// use optimize::{Swarm, SwarmOptions};
/// use profiles::Interval;
///
/// let bounds = [Interval::new(-5.0, 5.0); 2];
/// let mut swarm = Swarm::new(&bounds, SwarmOptions::new(50, 60), 1)?;
/// while swarm.stop().is_none() {
///     let costs: Vec<_> = swarm.ask().iter().map(|x| (x[0].powi(2) + x[1].powi(2)).into()).collect();
///     swarm.tell(&costs)?;
/// }
/// let (_, cost) = swarm.best();
/// assert!(cost.value() < Some(1e-6));
/// # Ok::<(), optimize::SwarmError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "super::written::WrittenSwarm"))]
pub struct Swarm {
    pub(crate) options: SwarmOptions,
    pub(crate) bounds: Vec<Interval>,
    pub(crate) seed: u64,
    /// Evaluated generations.
    pub(crate) generations: u64,
    /// The next candidates; velocities and best points lie one after the other.
    pub(crate) positions: Vec<Vec<f64>>,
    pub(crate) velocities: Vec<f64>,
    pub(crate) best_positions: Vec<f64>,
    pub(crate) best_costs: Vec<Cost>,
    pub(crate) history: Vec<Progress>,
    /// Iterations since the best got enough better, and what it was then.
    pub(crate) stalled: u64,
    pub(crate) reference: Cost,
}

impl Swarm {
    /// A swarm scattered over a box.
    ///
    /// # Errors
    /// No dimension, bounds that are not finite or not in order, options out of range.
    pub fn new(bounds: &[Interval], options: SwarmOptions, seed: u64) -> Result<Self, SwarmError> {
        options.check()?;
        check_bounds(bounds)?;
        let dimensions = bounds.len();
        let mut velocities = vec![0.0; options.particles * dimensions];
        let mut positions = vec![vec![0.0; dimensions]; options.particles];
        let key = Stream::key(seed, 0);
        let particles = positions.iter_mut().zip(velocities.chunks_exact_mut(dimensions));
        for (index, (position, velocity)) in (0..).zip(particles) {
            let mut stream = Stream::keyed(key, index);
            let start = (options.initial_velocity, options.velocity_limit);
            scatter(&mut stream, bounds, (position, velocity), start);
        }
        Ok(Self {
            best_positions: positions.concat(),
            best_costs: vec![Cost::Failed; options.particles],
            bounds: bounds.to_vec(),
            generations: 0,
            history: Vec::new(),
            stalled: 0,
            reference: Cost::Failed,
            options,
            seed,
            positions,
            velocities,
        })
    }

    /// Starts the first particles at these points instead of anywhere.
    ///
    /// # Errors
    /// A guess of another length or outside the bounds, more guesses than particles, a swarm that has been told costs.
    pub fn with_guesses(mut self, guesses: &[Vec<f64>]) -> Result<Self, SwarmError> {
        let particles = self.positions.len();
        if guesses.len() > particles {
            return Err(SwarmError::Guesses { given: guesses.len(), particles });
        }
        if self.generations > 0 {
            return Err(SwarmError::Late(self.generations));
        }
        for (guess, position) in guesses.iter().zip(&mut self.positions) {
            if guess.len() != position.len() {
                return Err(SwarmError::GuessLength { given: guess.len(), dimensions: position.len() });
            }
            for (dimension, (&value, bounds)) in guess.iter().zip(&self.bounds).enumerate() {
                if !bounds.contains(value) {
                    return Err(SwarmError::Guess { dimension, value });
                }
            }
            position.copy_from_slice(guess);
        }
        self.best_positions = self.positions.concat();
        Ok(self)
    }

    /// The candidates to evaluate, one per particle.
    #[must_use]
    pub fn ask(&self) -> &[Vec<f64>] {
        &self.positions
    }

    /// Takes the costs of the candidates, in their order, and moves the particles to the next. Numbers that are not
    /// finite count as failures.
    ///
    /// # Errors
    /// Another number of costs than of candidates; the swarm is then as it was.
    pub fn tell(&mut self, costs: &[Cost]) -> Result<Progress, SwarmError> {
        let particles = self.positions.len();
        if costs.len() != particles {
            return Err(SwarmError::Costs { given: costs.len(), particles });
        }
        let failed = self.take(costs);
        let (leader, progress) = self.close(failed);
        self.advance(leader);
        Ok(progress)
    }

    /// Takes as many costs as there are candidates into the personal bests; how many failed.
    pub(crate) fn take(&mut self, costs: &[Cost]) -> usize {
        let mut failed = 0;
        let bests = self.best_positions.chunks_exact_mut(self.bounds.len()).zip(&mut self.best_costs);
        for ((cost, position), (best_position, best_cost)) in costs.iter().zip(&self.positions).zip(bests) {
            let cost = cost.checked();
            failed += usize::from(cost == Cost::Failed);
            // A failure attracts no one, so a particle that knows nothing else takes its place along.
            if cost < *best_cost || *best_cost == Cost::Failed {
                *best_cost = cost;
                best_position.copy_from_slice(position);
            }
        }
        failed
    }

    /// Ends a generation: its leader, and what it brought.
    pub(crate) fn close(&mut self, failed: usize) -> (usize, Progress) {
        let (leader, best) = self.leader();
        let spread = spread(&self.positions, &self.bounds);
        let progress = Progress { iteration: self.generations, best, spread, failed };
        self.history.push(progress);
        let improved = self.options.stall.is_some_and(|stall| stall.counts(best, self.reference));
        if improved || self.generations == 0 {
            (self.stalled, self.reference) = (0, best);
        } else {
            self.stalled += 1;
        }
        self.generations += 1;
        (leader, progress)
    }

    /// Moves all particles.
    pub(crate) fn advance(&mut self, best: usize) {
        let options = &self.options;
        let at = |schedule: super::Schedule| schedule.at(self.generations - 1, options.iterations);
        let factors = Factors {
            inertia: at(options.inertia),
            cognitive: at(options.cognitive),
            social: at(options.social),
            velocity_limit: options.velocity_limit,
            boundary: options.boundary,
        };
        let dimensions = self.bounds.len();
        let point = |index: usize| {
            let start = index * dimensions;
            self.best_positions.get(start..start + dimensions).unwrap_or(&[])
        };
        let key = Stream::key(self.seed, self.generations);
        let particles = self.positions.iter_mut().zip(self.velocities.chunks_exact_mut(dimensions));
        let owns = self.best_positions.chunks_exact(dimensions);
        for (index, ((position, velocity), own)) in particles.zip(owns).enumerate() {
            let leader = match options.topology {
                Topology::Global => best,
                ring @ Topology::Ring { .. } => ring.leader(index, best, &self.best_costs),
            };
            let mut stream = Stream::keyed(key, index as u64);
            if self.best_costs.get(leader) == Some(&Cost::Failed) {
                let start = (options.initial_velocity, options.velocity_limit);
                scatter(&mut stream, &self.bounds, (position, velocity), start);
            } else {
                factors.step(&mut stream, &self.bounds, (position, velocity), (own, point(leader)));
            }
        }
    }

    /// The first of the particles with the best point, and its cost.
    fn leader(&self) -> (usize, Cost) {
        let first = (0, Cost::Failed);
        let costs = self.best_costs.iter().copied().enumerate();
        costs.fold(first, |best, next| if next.1 < best.1 { next } else { best })
    }

    /// The best point so far and its cost; a point without meaning if the cost is [`Cost::Failed`].
    #[must_use]
    pub fn best(&self) -> (&[f64], Cost) {
        let (leader, cost) = self.leader();
        (self.best_positions.chunks_exact(self.bounds.len()).nth(leader).unwrap_or(&[]), cost)
    }

    /// Why the search is over, if it is; nothing keeps it from being told more.
    #[must_use]
    pub fn stop(&self) -> Option<Stop> {
        let best = self.history.last()?.best;
        if matches!((best, self.options.target), (Cost::Ok(cost), Some(target)) if cost <= target) {
            Some(Stop::Target)
        } else if self.generations > self.options.iterations {
            Some(Stop::Iterations)
        } else {
            self.options.stall.filter(|stall| self.stalled >= stall.iterations).map(|_| Stop::Stalled)
        }
    }

    /// What every generation brought.
    #[must_use]
    pub fn history(&self) -> &[Progress] {
        &self.history
    }

    /// How many candidates have been evaluated.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.generations * self.positions.len() as u64
    }

    /// The velocities that led to the candidates, in the order of [`Swarm::ask`]; after a reflection they point back.
    pub fn velocities(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.velocities.chunks_exact(self.bounds.len())
    }

    /// The options.
    #[must_use]
    pub fn options(&self) -> &SwarmOptions {
        &self.options
    }

    /// The box that is searched.
    #[must_use]
    pub fn bounds(&self) -> &[Interval] {
        &self.bounds
    }
}

pub(super) fn check_bounds(bounds: &[Interval]) -> Result<(), SwarmError> {
    if bounds.is_empty() {
        return Err(SwarmError::NoDimension);
    }
    // A width beyond the range of numbers is no width either.
    let bad = |b: &Interval| !(b.upper > b.lower && (b.upper - b.lower).is_finite());
    match bounds.iter().enumerate().find(|(_, b)| bad(b)) {
        Some((dimension, &Interval { lower, upper })) => Err(SwarmError::Bounds { dimension, lower, upper }),
        None => Ok(()),
    }
}
