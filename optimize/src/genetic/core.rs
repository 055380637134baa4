//! The swarm with a genetic pool, stepped by hand.

use std::cmp::Ordering;

use profiles::Interval;

use super::breeding::index;
use super::config::{GeneticOptions, Mates};
use crate::cost::Cost;
use crate::error::SwarmError;
use crate::swarm::{InitialVelocity, Progress, Stop, Stream, Swarm, scatter};

/// Keeps the numbers of the pool apart from those of the flight.
const POOL: u64 = 0x6765_6e65_7469_6373;

/// A swarm with a genetic pool that looks for the least cost in a box, half a generation at a time: the particles, then
/// the children of the pool. [`Breeding::ask`] for the candidates, evaluate them in any order and on any machine,
/// [`Breeding::tell`] the costs.
///
/// Everything random belongs to (seed, particle, iteration), as in a [`Swarm`]; with an empty pool it is one to the bit.
/// The child of a particle that knows nothing but failures is drawn anew from the whole box.
///
/// ```
/// use optimize::{Breeding, GeneticOptions};
/// use profiles::Interval;
///
/// let bounds = [Interval::new(-5.0, 5.0); 2];
/// let mut search = Breeding::new(&bounds, GeneticOptions::new(50, 60), 1)?;
/// while search.stop().is_none() {
///     let costs: Vec<_> = search.ask().iter().map(|x| (x[0].powi(2) + x[1].powi(2)).into()).collect();
///     search.tell(&costs)?;
/// }
/// assert!(search.best().1.value() < Some(1e-6));
/// // Fifty particles and twenty-five children in each of 61 generations.
/// assert_eq!(search.evaluations(), 61 * 75);
/// # Ok::<(), optimize::SwarmError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "super::written::WrittenBreeding"))]
pub struct Breeding {
    pub(super) options: GeneticOptions,
    pub(super) swarm: Swarm,
    /// The particles, the worst first; those in the pool lead, each with its child.
    pub(super) order: Vec<usize>,
    pub(super) children: Vec<Vec<f64>>,
    /// Whether the children are to be evaluated next, and how many of the particles failed before.
    pub(super) breeding: bool,
    pub(super) failed: usize,
    pub(super) evaluations: u64,
}

impl Breeding {
    /// A population scattered over a box.
    ///
    /// # Errors
    /// No dimension, bounds that are not finite or not in order, options out of range.
    pub fn new(bounds: &[Interval], options: GeneticOptions, seed: u64) -> Result<Self, SwarmError> {
        options.check()?;
        Ok(Self {
            swarm: Swarm::new(bounds, options.swarm, seed)?,
            order: (0..options.swarm.particles).collect(),
            children: vec![vec![0.0; bounds.len()]; options.pooled()],
            breeding: false,
            failed: 0,
            evaluations: 0,
            options,
        })
    }

    /// Starts the first particles at these points instead of anywhere.
    ///
    /// # Errors
    /// A guess of another length or outside the bounds, more guesses than particles, a swarm that has been told costs.
    pub fn with_guesses(mut self, guesses: &[Vec<f64>]) -> Result<Self, SwarmError> {
        if self.evaluations > 0 {
            return Err(SwarmError::Late(self.swarm.generations.max(1)));
        }
        self.swarm = self.swarm.with_guesses(guesses)?;
        Ok(self)
    }

    /// The candidates to evaluate: one per particle, or one per child.
    #[must_use]
    pub fn ask(&self) -> &[Vec<f64>] {
        if self.breeding { &self.children } else { self.swarm.ask() }
    }

    /// Takes the costs of the candidates, in their order; what the generation brought once it is complete. Numbers that
    /// are not finite count as failures.
    ///
    /// # Errors
    /// Another number of costs than of candidates; the search is then as it was.
    pub fn tell(&mut self, costs: &[Cost]) -> Result<Option<Progress>, SwarmError> {
        let candidates = self.ask().len();
        if costs.len() != candidates {
            return Err(SwarmError::Costs { given: costs.len(), particles: candidates });
        }
        self.evaluations += candidates as u64;
        if self.breeding {
            self.failed += self.succeed(costs);
        } else {
            self.failed = self.swarm.take(costs);
            if !self.children.is_empty() {
                self.select(costs);
                self.breed();
                self.breeding = true;
                return Ok(None);
            }
        }
        let (leader, progress) = self.swarm.close(self.failed);
        if self.options.flight {
            self.breeding = false;
            self.swarm.advance(leader);
        } else {
            self.failed = 0;
            self.rest();
        }
        Ok(Some(progress))
    }

    /// Puts the particles in order by their costs, the worst first and the first of equals last.
    fn select(&mut self, costs: &[Cost]) {
        let cost = |index: &usize| costs.get(*index).copied().unwrap_or(Cost::Failed).checked();
        // Unique keys: the order does not depend on the one before.
        self.order.sort_unstable_by(|a, b| {
            cost(b).partial_cmp(&cost(a)).unwrap_or(Ordering::Equal).then_with(|| b.cmp(a))
        });
    }

    /// Breeds the children of the pool.
    fn breed(&mut self) {
        let Self { options, swarm, order, children, .. } = self;
        let dimensions = swarm.bounds.len();
        let key = Stream::key(swarm.seed ^ POOL, swarm.generations);
        let mates = match options.mates {
            Mates::Pool => order.get(..children.len()).unwrap_or(order),
            Mates::All => order,
        };
        let known = |particle: usize| {
            let start = particle * dimensions;
            let point = swarm.best_positions.get(start..start + dimensions);
            point.filter(|_| swarm.best_costs.get(particle).is_some_and(|cost| *cost != Cost::Failed))
        };
        for (place, (particle, child)) in order.iter().zip(children).enumerate() {
            let mut stream = Stream::keyed(key, *particle as u64);
            let Some(parent) = known(*particle) else {
                // The velocity is nobody's.
                let start = (InitialVelocity::Zero, 1.0);
                scatter(&mut stream, &swarm.bounds, (child, &mut vec![0.0; dimensions]), start);
                continue;
            };
            // Anyone but oneself: the places of the mates without one's own.
            let other = index(&mut stream, mates.len().saturating_sub(1));
            let other = other + usize::from(other >= place);
            let mate = mates.get(other).and_then(|mate| known(*mate));
            options.breed(&mut stream, &swarm.bounds, child, (parent, mate));
        }
    }

    /// Lets the better children take the place of their parents' bests; how many failed.
    fn succeed(&mut self, costs: &[Cost]) -> usize {
        let dimensions = self.swarm.bounds.len();
        let mut failed = 0;
        for ((particle, child), cost) in self.order.iter().zip(&self.children).zip(costs) {
            let cost = cost.checked();
            failed += usize::from(cost == Cost::Failed);
            let best = self.swarm.best_positions.chunks_exact_mut(dimensions).nth(*particle);
            if let (Some(best), Some(known)) = (best, self.swarm.best_costs.get_mut(*particle))
                && cost < *known
            {
                *known = cost;
                best.copy_from_slice(child);
            }
        }
        failed
    }

    /// Without flight: particles stand at their bests, and the next children are theirs.
    fn rest(&mut self) {
        let bests = self.swarm.best_positions.chunks_exact(self.swarm.bounds.len());
        self.swarm.positions.iter_mut().zip(bests).for_each(|(x, best)| x.copy_from_slice(best));
        let costs = std::mem::take(&mut self.swarm.best_costs);
        self.select(&costs);
        self.swarm.best_costs = costs;
        self.breed();
    }

    /// The best point so far and its cost; a point without meaning if the cost is [`Cost::Failed`].
    #[must_use]
    pub fn best(&self) -> (&[f64], Cost) {
        self.swarm.best()
    }

    /// Why the search is over, if it is, as of the last complete generation; nothing keeps it from being told more.
    #[must_use]
    pub fn stop(&self) -> Option<Stop> {
        self.swarm.stop()
    }

    /// What every generation brought.
    #[must_use]
    pub fn history(&self) -> &[Progress] {
        self.swarm.history()
    }

    /// How many candidates have been evaluated: particles and children.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// The options.
    #[must_use]
    pub fn options(&self) -> &GeneticOptions {
        &self.options
    }

    /// The particles: positions, velocities, bounds and history.
    #[must_use]
    pub fn swarm(&self) -> &Swarm {
        &self.swarm
    }
}
