//! A search as it is written down, checked when it is read.

use super::config::GeneticOptions;
use super::core::Breeding;
use crate::error::SwarmError;
use crate::swarm::Swarm;

#[derive(serde::Deserialize)]
pub(super) struct WrittenBreeding {
    options: GeneticOptions,
    swarm: Swarm,
    order: Vec<usize>,
    children: Vec<Vec<f64>>,
    breeding: bool,
    failed: usize,
    evaluations: u64,
}

impl TryFrom<WrittenBreeding> for Breeding {
    type Error = SwarmError;

    fn try_from(written: WrittenBreeding) -> Result<Self, SwarmError> {
        let WrittenBreeding { options, swarm, order, children, breeding, failed, evaluations } = written;
        options.check()?;
        let count = |quantity, given, needed| {
            if given == needed { Ok(()) } else { Err(SwarmError::Written { quantity, given, needed }) }
        };
        count("particles", swarm.options().particles, options.swarm.particles)?;
        count("equal options", usize::from(*swarm.options() == options.swarm), 1)?;
        count("children", children.len(), options.pooled())?;
        let mut places = order.clone();
        places.sort_unstable();
        let matching = places.iter().enumerate().filter(|(place, particle)| place == *particle).count();
        count("places", order.len(), options.swarm.particles)?;
        count("particles with a place", matching, options.swarm.particles)?;
        for child in &children {
            count("coordinates", child.len(), swarm.bounds().len())?;
            for (dimension, (&value, bounds)) in child.iter().zip(swarm.bounds()).enumerate() {
                // Children that nobody has bred yet stand anywhere.
                if breeding && !bounds.contains(value) {
                    return Err(SwarmError::Guess { dimension, value });
                }
            }
        }
        let most = options.swarm.particles.saturating_add(options.pooled());
        count("failures beyond the candidates", failed.saturating_sub(most), 0)?;
        Ok(Self { options, swarm, order, children, breeding, failed, evaluations })
    }
}
