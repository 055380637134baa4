//! One child of one particle.

use profiles::Interval;

use super::config::{Crossover, GeneticOptions, Mutation};
use crate::swarm::Stream;

impl GeneticOptions {
    /// Writes the child of a parent into `child`; with nobody for a mate it only mutates.
    pub(super) fn breed(
        &self,
        stream: &mut Stream,
        bounds: &[Interval],
        child: &mut [f64],
        (parent, mate): (&[f64], Option<&[f64]>),
    ) {
        child.copy_from_slice(parent);
        let crossed = stream.uniform() < self.crossover_rate;
        if let Some(mate) = mate.filter(|_| crossed) {
            self.crossover.cross(stream, bounds, child, mate);
        }
        let mut copy = child == parent;
        for (x, bounds) in child.iter_mut().zip(bounds) {
            if stream.uniform() < self.mutation_rate {
                *x = self.mutation.mutate(stream, *x, *bounds);
                copy = false;
            }
        }
        if copy {
            let any = index(stream, child.len());
            for (x, bounds) in child.iter_mut().zip(bounds).skip(any).take(1) {
                *x = self.mutation.mutate(stream, *x, *bounds);
            }
        }
    }
}

impl Crossover {
    fn cross(self, stream: &mut Stream, bounds: &[Interval], child: &mut [f64], mate: &[f64]) {
        // One number for the whole line; the other operators draw theirs by coordinate.
        let along = stream.uniform();
        for ((x, mate), bounds) in child.iter_mut().zip(mate).zip(bounds) {
            *x = match self {
                Self::Arithmetic => *x + along * (mate - *x),
                Self::Blend { beyond } => {
                    let part = stream.uniform() * (1.0 + 2.0 * beyond) - beyond;
                    *x + part * (mate - *x)
                }
                Self::Uniform if stream.uniform() < 0.5 => *mate,
                Self::Uniform => *x,
            };
            // The order of max and min turns a NaN, from terms beyond the range of numbers, into a coordinate.
            *x = x.max(bounds.lower).min(bounds.upper);
        }
    }
}

impl Mutation {
    fn mutate(self, stream: &mut Stream, x: f64, bounds: Interval) -> f64 {
        let width = bounds.upper - bounds.lower;
        let mutated = match self {
            Self::Anywhere => bounds.lower + stream.uniform() * width,
            Self::Nearby { reach } => x + (2.0 * stream.uniform() - 1.0) * reach * width,
        };
        mutated.max(bounds.lower).min(bounds.upper)
    }
}

/// A number below `count`, uniform.
pub(super) fn index(stream: &mut Stream, count: usize) -> usize {
    ((stream.uniform() * count as f64) as usize).min(count.saturating_sub(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: [Interval; 4] = [Interval::new(-1.0, 3.0); 4];
    const PARENT: [f64; 4] = [0.0, 1.0, 2.0, -1.0];
    const MATE: [f64; 4] = [1.0, 0.0, 2.5, 3.0];

    fn children(options: GeneticOptions) -> Vec<[f64; 4]> {
        let child = |particle| {
            let mut child = [f64::NAN; 4];
            let mut stream = Stream::new(1, particle, 7);
            options.breed(&mut stream, &BOX, &mut child, (&PARENT, Some(&MATE)));
            child
        };
        (0..4000).map(child).collect()
    }

    /// How far a coordinate lies from parent to mate.
    fn part(child: &[f64; 4], k: usize) -> f64 {
        (child[k] - PARENT[k]) / (MATE[k] - PARENT[k])
    }

    #[test]
    fn crossings_are_as_named() {
        let pure = GeneticOptions { crossover_rate: 1.0, mutation_rate: 0.0, ..GeneticOptions::new(2, 1) };
        let line = children(GeneticOptions { crossover: Crossover::Arithmetic, ..pure });
        // All coordinates at one part of the way, which is uniform: the mean of 4000 is within five deviations.
        assert!(line.iter().all(|child| (1..4).all(|k| (part(child, k) - part(child, 0)).abs() < 1e-12)));
        let mean = line.iter().map(|child| part(child, 0)).sum::<f64>() / 4000.0;
        assert!((mean - 0.5).abs() < 5.0 * 0.29 / 4000_f64.sqrt(), "{mean}");
        let blend = children(GeneticOptions { crossover: Crossover::Blend { beyond: 0.5 }, ..pure });
        let parts: Vec<f64> = blend.iter().map(|child| part(child, 0)).collect();
        let least = parts.iter().copied().fold(0.0, f64::min);
        let most = parts.iter().copied().fold(0.0, f64::max);
        assert!((-0.5..-0.49).contains(&least) && most > 1.49 && most <= 1.5, "{least} {most}");
        assert!(blend.iter().any(|child| (part(child, 1) - part(child, 0)).abs() > 0.5));
        let coin = children(GeneticOptions { crossover: Crossover::Uniform, ..pure });
        for k in 0..4 {
            let own = coin.iter().filter(|child| child[k].to_bits() == PARENT[k].to_bits()).count();
            let other = coin.iter().filter(|child| child[k].to_bits() == MATE[k].to_bits()).count();
            // But for the copies, one in sixteen, one coordinate of which mutates.
            assert!(own + other > 3900 && own.abs_diff(2000) < 250, "{own} {other}");
        }
    }

    #[test]
    fn mutations_are_as_named() {
        let pure = GeneticOptions { crossover_rate: 0.0, mutation_rate: 0.0, ..GeneticOptions::new(2, 1) };
        // Nothing would happen: one coordinate mutates, each as often.
        let changed =
            |child: &[f64; 4]| (0..4).filter(|k| child[*k].to_bits() != PARENT[*k].to_bits()).count();
        let forced = children(pure);
        assert!(forced.iter().all(|child| changed(child) == 1));
        let first = forced.iter().filter(|child| child[0] != 0.0).count();
        assert!(first.abs_diff(1000) < 5 * 28, "{first}");
        let some = children(GeneticOptions { mutation_rate: 0.5, ..pure });
        // Four coins, and one coordinate where none fell: 2 + 1/16, standard deviation 1 of each.
        let mean = some.iter().map(|child| changed(child) as f64).sum::<f64>() / 4000.0;
        assert!((mean - 2.0625).abs() < 5.0 / 4000_f64.sqrt(), "{mean}");
        let near = Mutation::Nearby { reach: 0.1 };
        let near = children(GeneticOptions { mutation_rate: 1.0, mutation: near, ..pure });
        let far = near.iter().map(|child| child[1] - PARENT[1]).fold(0.0, f64::max);
        assert!(far > 0.39 && far <= 0.4, "{far}");
        assert!(near.iter().flatten().all(|x| BOX[0].contains(*x)));
        assert!(near.iter().any(|child| child[3].to_bits() == (-1.0_f64).to_bits()));
    }
}
