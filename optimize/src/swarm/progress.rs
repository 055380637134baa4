//! What a generation brought.

use profiles::Interval;

use crate::cost::Cost;

/// What a generation brought.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Progress {
    /// How often the particles had moved, from zero.
    pub iteration: u64,
    /// The best cost so far.
    pub best: Cost,
    /// Root mean square distance of the candidates from their centre per dimension, in widths of the box: 0.29 for a
    /// swarm scattered all over, 0 for one at a point.
    pub spread: f64,
    /// How many evaluations of this generation failed.
    pub failed: usize,
}

pub(super) fn spread(positions: &[Vec<f64>], bounds: &[Interval]) -> f64 {
    let particles = positions.len() as f64;
    let variance = |(dimension, bounds): (usize, &Interval)| {
        let width = bounds.upper - bounds.lower;
        let coordinates = || {
            positions.iter().filter_map(move |x| x.get(dimension)).map(move |x| (x - bounds.lower) / width)
        };
        let mean = coordinates().sum::<f64>() / particles;
        coordinates().map(|x| (x - mean) * (x - mean)).sum::<f64>() / particles
    };
    (bounds.iter().enumerate().map(variance).sum::<f64>() / bounds.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spread_is_in_widths() {
        let bounds = [Interval::new(10.0, 20.0), Interval::new(-1.0, 1.0)];
        // A quarter of the width to either side in one dimension, nothing in the other.
        let positions = [vec![12.5, 0.3], vec![17.5, 0.3]];
        assert!((spread(&positions, &bounds) - 0.25 / 2_f64.sqrt()).abs() < 1e-15);
    }
}
