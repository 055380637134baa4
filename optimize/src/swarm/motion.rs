//! One step of one particle.

use profiles::Interval;

use super::config::{Boundary, InitialVelocity, Topology};
use super::stream::Stream;
use crate::cost::Cost;

/// The factors of one iteration.
#[derive(Clone, Copy)]
pub(super) struct Factors {
    pub(super) inertia: f64,
    pub(super) cognitive: f64,
    pub(super) social: f64,
    pub(super) velocity_limit: f64,
    pub(super) boundary: Boundary,
}

impl Factors {
    /// Moves a particle, coordinate by coordinate.
    #[inline]
    pub(super) fn step(
        &self,
        stream: &mut Stream,
        bounds: &[Interval],
        (position, velocity): (&mut [f64], &mut [f64]),
        (own, leader): (&[f64], &[f64]),
    ) {
        let bests = own.iter().zip(leader);
        for (((x, v), bounds), (own, leader)) in position.iter_mut().zip(velocity).zip(bounds).zip(bests) {
            let (to_own, to_leader) = (stream.uniform(), stream.uniform());
            let pulls = self.cognitive * to_own * (own - *x) + self.social * to_leader * (leader - *x);
            let limit = self.velocity_limit * (bounds.upper - bounds.lower);
            // The order of max and min turns a NaN, from terms beyond the range of numbers, into a velocity.
            let wanted = (self.inertia * *v + pulls).max(-limit).min(limit);
            (*x, *v) = self.boundary.hold(*x, wanted, *bounds);
        }
    }
}

impl Boundary {
    /// Position and velocity after a step from `x` by `v`, which is at most one width.
    #[inline]
    fn hold(self, x: f64, v: f64, bounds: Interval) -> (f64, f64) {
        let next = x + v;
        if bounds.contains(next) {
            return (next, v);
        }
        let bound = if next > bounds.upper { bounds.upper } else { bounds.lower };
        match self {
            Self::Clamp => (bound, bound - x),
            Self::Absorb => (bound, 0.0),
            // One width at most: the mirror image is inside but for a rounding.
            Self::Reflect => ((bound - (next - bound)).max(bounds.lower).min(bounds.upper), -v),
        }
    }
}

/// Puts a particle anywhere.
pub(crate) fn scatter(
    stream: &mut Stream,
    bounds: &[Interval],
    (position, velocity): (&mut [f64], &mut [f64]),
    (initial, velocity_limit): (InitialVelocity, f64),
) {
    for ((x, v), bounds) in position.iter_mut().zip(velocity).zip(bounds) {
        let width = bounds.upper - bounds.lower;
        // Rounding may reach beyond the upper bound.
        *x = (bounds.lower + stream.uniform() * width).min(bounds.upper);
        *v = match initial {
            InitialVelocity::Zero => 0.0,
            InitialVelocity::Uniform => (2.0 * stream.uniform() - 1.0) * velocity_limit * width,
        };
    }
}

impl Topology {
    /// The particle with the best cost in sight of `particle`, given the best of all.
    pub(super) fn leader(self, particle: usize, best: usize, costs: &[Cost]) -> usize {
        let count = costs.len();
        match self {
            Self::Ring { reach } if reach < count / 2 => {
                let neighbours = (0..=2 * reach).map(|offset| (particle + count - reach + offset) % count);
                let cost = |index: usize| costs.get(index).copied().unwrap_or(Cost::Failed);
                neighbours.fold(particle, |best, index| if cost(index) < cost(best) { index } else { best })
            }
            _ => best,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: Interval = Interval::new(-1.0, 3.0);

    #[test]
    fn bounds_are_treated_as_named() {
        let close = |(x, v): (f64, f64), (to_x, to_v): (f64, f64)| {
            assert!((x - to_x).abs() < 1e-15 && (v - to_v).abs() < 1e-15, "{x} {v}");
        };
        close(Boundary::Clamp.hold(2.0, 1.5, BOX), (3.0, 1.0));
        close(Boundary::Clamp.hold(3.0, 1.5, BOX), (3.0, 0.0));
        close(Boundary::Absorb.hold(2.0, 1.5, BOX), (3.0, 0.0));
        close(Boundary::Reflect.hold(2.0, 1.5, BOX), (2.5, -1.5));
        close(Boundary::Reflect.hold(-0.5, -1.0, BOX), (-0.5, 1.0));
        close(Boundary::Reflect.hold(0.0, 2.5, BOX), (2.5, 2.5));
    }

    #[test]
    fn a_ring_sees_its_neighbours_only() {
        let costs: Vec<Cost> = [3.0, 9.0, 1.0, 8.0, 7.0, 6.0].map(Cost::Ok).to_vec();
        let leaders = |topology: Topology| (0..6).map(|n| topology.leader(n, 2, &costs)).collect::<Vec<_>>();
        assert_eq!(leaders(Topology::Ring { reach: 1 }), [0, 2, 2, 2, 5, 0]);
        assert_eq!(leaders(Topology::Ring { reach: 2 }), [2, 2, 2, 2, 2, 0]);
        assert_eq!(leaders(Topology::Ring { reach: 3 }), [2; 6]);
        assert_eq!(leaders(Topology::Ring { reach: usize::MAX }), [2; 6]);
        assert_eq!(leaders(Topology::Global), [2; 6]);
    }
}
