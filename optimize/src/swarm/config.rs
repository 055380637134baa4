//! What a swarm may be told.

use crate::cost::Cost;
use crate::error::SwarmError;

/// A million: a swarm beyond it is a slip of the keyboard, not a search.
const MOST_PARTICLES: u64 = 1_000_000;

/// How a swarm moves and when it stops. The rule, for every coordinate with fresh `r1` and `r2` in `[0, 1)`:
///
/// `v <- w v + c1 r1 (own - x) + c2 r2 (leader - x)`, held within the velocity limit, then `x <- x + v`,
///
/// where `own` is the best point the particle has seen and `leader` the best its neighbours have.
///
/// ```
/// use optimize::{Schedule, SwarmOptions};
///
/// let options = SwarmOptions { inertia: Schedule::Linear { from: 0.9, to: 0.4 }, ..SwarmOptions::new(50, 30) };
/// assert_eq!(options.inertia.at(29, 30), 0.4);
/// ```
///
/// # References
/// - J. Kennedy, R. Eberhart, "Particle swarm optimization", ICNN 1995, <https://doi.org/10.1109/ICNN.1995.488968>.
/// - Y. Shi, R. Eberhart, "A modified particle swarm optimizer", ICEC 1998,
///   <https://doi.org/10.1109/ICEC.1998.699146>: the inertia.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields, default))]
pub struct SwarmOptions {
    /// How many particles, 1 to 1 000 000.
    pub particles: usize,
    /// How often they move; the first generation is evaluated before.
    pub iterations: u64,
    /// The part `w` of its velocity that a particle keeps.
    pub inertia: Schedule,
    /// The pull `c1` to a particle's own best.
    pub cognitive: Schedule,
    /// The pull `c2` to the best of its neighbours.
    pub social: Schedule,
    /// Who is a neighbour.
    pub topology: Topology,
    /// What happens at a bound.
    pub boundary: Boundary,
    /// The largest move in one iteration, as a part of the width of the search in that dimension; above 0, at most 1.
    pub velocity_limit: f64,
    /// How fast particles start.
    pub initial_velocity: InitialVelocity,
    /// The cost at which the search is done.
    pub target: Option<f64>,
    /// How long the search may go without getting better.
    pub stall: Option<Stall>,
}

impl Default for SwarmOptions {
    /// 40 particles and 200 iterations.
    fn default() -> Self {
        Self::new(40, 200)
    }
}

impl SwarmOptions {
    /// The defaults for a number of particles and of iterations: inertia `1 / (2 ln 2)`, both pulls `1/2 + ln 2`, one
    /// leader for all, reflection at the bounds, a start at rest, moves of at most a fifth of the box, no stop but the
    /// last iteration.
    ///
    /// # References
    /// M. Clerc, "Standard particle swarm optimisation", 2012, <https://hal.science/hal-00764996>: the factors.
    #[must_use]
    pub const fn new(particles: usize, iterations: u64) -> Self {
        let pull = Schedule::Constant(0.5 + std::f64::consts::LN_2);
        Self {
            particles,
            iterations,
            inertia: Schedule::Constant(0.5 / std::f64::consts::LN_2),
            cognitive: pull,
            social: pull,
            topology: Topology::Global,
            boundary: Boundary::Reflect,
            velocity_limit: 0.2,
            initial_velocity: InitialVelocity::Zero,
            target: None,
            stall: None,
        }
    }

    pub(crate) fn check(&self) -> Result<(), SwarmError> {
        let number = |quantity, range, fits, value| {
            if fits { Ok(()) } else { Err(SwarmError::Number { quantity, range, value }) }
        };
        let count = |quantity, given, most| {
            let least = 1;
            let fits = given >= least && given <= most;
            if fits { Ok(()) } else { Err(SwarmError::Count { quantity, least, most, given }) }
        };
        count("the number of particles", self.particles as u64, MOST_PARTICLES)?;
        for (quantity, schedule) in [
            ("the inertia", self.inertia),
            ("the cognitive pull", self.cognitive),
            ("the social pull", self.social),
        ] {
            for value in schedule.ends() {
                number(quantity, "finite and not negative", value >= 0.0 && value.is_finite(), value)?;
            }
        }
        let limit = self.velocity_limit;
        number("the velocity limit", "above 0 and at most 1", limit > 0.0 && limit <= 1.0, limit)?;
        if let Topology::Ring { reach } = self.topology {
            count("the reach of the ring", reach as u64, u64::MAX)?;
        }
        if let Some(target) = self.target {
            number("the target", "finite", target.is_finite(), target)?;
        }
        if let Some(Stall { iterations, absolute, relative }) = self.stall {
            count("the iterations of a stall", iterations, u64::MAX)?;
            for value in [absolute, relative] {
                let fits = value >= 0.0 && value.is_finite();
                number("an improvement", "finite and not negative", fits, value)?;
            }
        }
        Ok(())
    }
}

/// A number over the iterations of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Schedule {
    /// The same at every move.
    Constant(f64),
    /// From one value at the first move to another at the last.
    Linear {
        /// Value at the first move.
        from: f64,
        /// Value at the last move.
        to: f64,
    },
}

impl Schedule {
    /// The value at a move, counted from zero, of `moves`; after the last move its value.
    #[must_use]
    pub fn at(self, index: u64, moves: u64) -> f64 {
        match self {
            Self::Constant(value) => value,
            Self::Linear { from, to } if moves > 1 => {
                let part = (index as f64 / (moves - 1) as f64).min(1.0);
                // Exact at both ends, unlike from + (to - from) part.
                from * (1.0 - part) + to * part
            }
            Self::Linear { from, .. } => from,
        }
    }

    fn ends(self) -> [f64; 2] {
        match self {
            Self::Constant(value) => [value; 2],
            Self::Linear { from, to } => [from, to],
        }
    }
}

/// Whose best point a particle is drawn to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Topology {
    /// The best of all.
    Global,
    /// The best of those within `reach` on either side, the particles standing in a ring; slower, and harder to trap.
    Ring {
        /// Neighbours on each side, at least one.
        reach: usize,
    },
}

/// What becomes of a coordinate that would leave the search.
///
/// # References
/// J. Robinson, Y. Rahmat-Samii, "Particle swarm optimization in electromagnetics", IEEE Transactions on Antennas and
/// Propagation 52 (2004), <https://doi.org/10.1109/TAP.2004.823969>: absorbing and reflecting walls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Boundary {
    /// It stops at the bound, and its velocity is the step that was made: what led outside is lost.
    Clamp,
    /// It stops at the bound, its velocity is zero.
    Absorb,
    /// It is thrown back by as much as it would have been outside, its velocity is reversed.
    Reflect,
}

/// How fast particles start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum InitialVelocity {
    /// At rest.
    Zero,
    /// Uniform within the velocity limit.
    Uniform,
}

/// A search that has gone `iterations` without an improvement worth counting is over.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Stall {
    /// How many iterations, at least one.
    pub iterations: u64,
    /// An improvement counts if it is larger than this, in the unit of the cost, ...
    pub absolute: f64,
    /// ... plus this part of the cost.
    pub relative: f64,
}

impl Stall {
    /// Whether `cost` is enough of an improvement over `reference`.
    pub(super) fn counts(&self, cost: Cost, reference: Cost) -> bool {
        match (cost, reference) {
            (Cost::Ok(now), Cost::Ok(before)) | (Cost::Infeasible(now), Cost::Infeasible(before)) => {
                before - now > self.absolute + self.relative * before.abs()
            }
            _ => cost < reference,
        }
    }
}

/// Why a search is over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// The target cost is reached.
    Target,
    /// All iterations are done.
    Iterations,
    /// Nothing got better for long enough.
    Stalled,
}
