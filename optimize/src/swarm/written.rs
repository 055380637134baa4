//! A swarm as it is written down, checked when it is read.

use profiles::Interval;

use super::config::SwarmOptions;
use super::core::{Swarm, check_bounds};
use super::progress::Progress;
use crate::cost::Cost;
use crate::error::SwarmError;

#[derive(serde::Deserialize)]
pub(super) struct WrittenSwarm {
    options: SwarmOptions,
    bounds: Vec<Interval>,
    seed: u64,
    generations: u64,
    positions: Vec<Vec<f64>>,
    velocities: Vec<f64>,
    best_positions: Vec<f64>,
    best_costs: Vec<Cost>,
    history: Vec<Progress>,
    stalled: u64,
    reference: Cost,
}

impl TryFrom<WrittenSwarm> for Swarm {
    type Error = SwarmError;

    fn try_from(written: WrittenSwarm) -> Result<Self, SwarmError> {
        let WrittenSwarm { options, bounds, seed, generations, positions, velocities, .. } = written;
        let WrittenSwarm { best_positions, best_costs, history, stalled, reference, .. } = written;
        options.check()?;
        check_bounds(&bounds)?;
        let (particles, dimensions) = (options.particles, bounds.len());
        let count = |quantity, given, needed| {
            if given == needed { Ok(()) } else { Err(SwarmError::Written { quantity, given, needed }) }
        };
        count("positions", positions.len(), particles)?;
        count("costs", best_costs.len(), particles)?;
        count("velocities", velocities.len(), particles.saturating_mul(dimensions))?;
        count("best points", best_positions.len(), velocities.len())?;
        count("history", history.len(), usize::try_from(generations).unwrap_or(usize::MAX))?;
        for point in positions.iter().map(Vec::as_slice).chain(best_positions.chunks_exact(dimensions)) {
            count("coordinates", point.len(), dimensions)?;
            for (dimension, (&value, bounds)) in point.iter().zip(&bounds).enumerate() {
                if !bounds.contains(value) {
                    return Err(SwarmError::Guess { dimension, value });
                }
            }
        }
        if stalled > generations {
            let (given, needed) = (stalled, generations);
            return Err(SwarmError::Written {
                quantity: "generations without an improvement",
                given: given as usize,
                needed: needed as usize,
            });
        }
        if let Some(&value) = velocities.iter().find(|v| !v.is_finite()) {
            return Err(SwarmError::Number { quantity: "a velocity", range: "finite", value });
        }
        let best_costs = best_costs.into_iter().map(Cost::checked).collect();
        let reference = reference.checked();
        Ok(Self {
            options,
            bounds,
            seed,
            generations,
            positions,
            velocities,
            best_positions,
            best_costs,
            history,
            stalled,
            reference,
        })
    }
}
