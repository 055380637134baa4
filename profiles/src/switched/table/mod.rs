//! Moves over any distance of a range, from a table of a few.

mod error;
mod family;

pub use error::MoveTableError;
use family::{Group, Node};
pub use family::{MoveFamily, Run};

use super::{Arc, Contact, Goal, Switched, Zero};
use crate::complex;
use crate::polynomial::Piecewise;
use crate::profile::Profile;
use crate::quantities::{Interval, Limits, Mode};

/// The most modes that a table deals with.
const MOST_MODES: usize = 4;
/// What may be left of a mode, as a part of the distance.
const EXACT: f64 = 1e-12;
/// What rounding may leave of the end, as a part of the motion, and pass of a limit, as a part of it.
const ENDED: f64 = 1e-9;
const HELD: f64 = 1e-12;

/// Moves of at most `N` arcs over any distance between the shortest and the longest of a table, within the same limits and
/// free of the vibration of the same modes.
///
/// Between two moves of the same structure the durations of the arcs are interpolated; where the structure changes between
/// them, those of either side are extrapolated. A few Newton steps with the smallest change then make end, zeros and
/// contacts exact ([`Switched::corrected`]): what the interpolation had wrong along the optimum costs time with its square
/// only. Whatever comes out is checked. If nothing good does, or if it lasts longer, the next longer move of the table is
/// made smaller: all of it times the ratio of the distances, as long as before, with the same zeros, further from all
/// limits. So every distance of the range has a move, and none lasts longer than the next longer one of the table.
///
/// A move ends at its distance bit for bit, leaves less than 1e-12 of it of each mode, and passes no limit by more than
/// 1e-12 of it.
#[derive(Debug, Clone, Copy)]
pub struct MoveTable<'a, const N: usize> {
    family: MoveFamily<'a>,
    limits: Limits,
    zeros: [Zero; MOST_MODES],
    modes: usize,
    /// Shortest and longest distance, with the sign of all.
    shortest: f64,
    longest: f64,
}

impl<'a, const N: usize> MoveTable<'a, N> {
    /// A table of moves within `limits` that have a zero at each of `modes`, a `double` one or not; every move is checked.
    ///
    /// # Errors
    /// More than four modes, numbers that do not belong together, or a move that does not hold the limits, end where it
    /// should, or leave the modes at rest.
    pub fn new(
        family: MoveFamily<'a>,
        limits: &Limits,
        modes: &[Mode],
        double: bool,
    ) -> Result<Self, MoveTableError> {
        let mut zeros = [Zero::at(Default::default(), double); MOST_MODES];
        let places = zeros
            .get_mut(..modes.len())
            .ok_or(MoveTableError::Modes { modes: modes.len(), most: MOST_MODES })?;
        places.iter_mut().zip(modes).for_each(|(place, mode)| *place = Zero::new(*mode, double));
        check_lengths::<N>(&family)?;
        let (Some(&shortest), Some(&longest)) = (family.distances.first(), family.distances.last()) else {
            return Err(MoveTableError::Length { what: "distances", needed: 1, given: 0 });
        };
        let table = Self { family, limits: *limits, zeros, modes: modes.len(), shortest, longest };
        let mut before = 0.0;
        for group in family.groups() {
            for node in (0..group.distances.len()).filter_map(|k| group.node(k)) {
                let size = node.distance.copysign(node.distance * shortest);
                if !(size > before && size.is_finite()) {
                    return Err(MoveTableError::Order(node.distance));
                }
                before = size;
                table.check_node(&group, &node)?;
            }
        }
        Ok(table)
    }

    /// The shortest and the longest distance that the table holds, m: negative if it is one of moves downwards.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        (self.shortest, self.longest)
    }

    /// The limits that all moves hold.
    #[must_use]
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// The move over a signed `distance`, m. Within symmetric limits a table of one direction holds the other one too.
    ///
    /// # Errors
    /// A distance shorter than the shortest or longer than the longest of the table, or NaN; one of the other direction
    /// where the limits are not symmetric.
    pub fn rest_to_rest(&self, distance: f64) -> Result<Piecewise<N>, MoveTableError> {
        let Self { family, shortest, longest, .. } = self;
        let outside = MoveTableError::Distance { distance, shortest: *shortest, longest: *longest };
        let size = distance.abs();
        if !(size >= shortest.abs() && size <= longest.abs()) {
            return Err(outside);
        }
        let sign = 1.0_f64.copysign(distance * shortest);
        if sign < 0.0 && self.limits != self.limits.mirrored() {
            return Err(MoveTableError::Direction(distance));
        }
        let along = sign * distance;
        // The first move that is as long.
        let above = family.distances.partition_point(|d| d.abs() < size);
        let (next, k) = family.place(above).ok_or(outside)?;
        let longer = next.node(k).ok_or(outside)?;
        // All of it in proportion.
        let part = distance / longer.distance;
        let whole = switched(&next, longer.durations.iter().copied(), part).ok_or(outside)?;
        let mut best = profile(&whole, &next, part, distance);
        let Some((last, l)) = above.checked_sub(1).and_then(|below| family.place(below)) else {
            return Ok(best);
        };
        let same = last.index == next.index;
        let neighbour = if same { Some(l) } else { k.checked_add(1) };
        let from_above = self.corrected(&next, k, neighbour, along);
        let from_below = if same { None } else { self.corrected(&last, l, l.checked_sub(1), along) };
        for (motion, group) in [(from_above, &next), (from_below, &last)] {
            let durations = motion.iter().flat_map(|motion| motion.arcs().iter().map(|arc| arc.duration));
            let Some(motion) = motion.as_ref().and_then(|_| switched(group, durations, sign)) else {
                continue;
            };
            let found = profile(&motion, group, sign, distance);
            if found.duration < best.duration
                && missed(&motion, distance) <= ENDED
                && self.residual(&motion, distance) <= EXACT
                && self.passed(&found) <= HELD
            {
                best = found;
            }
        }
        Ok(best)
    }

    /// The motion of a run over a distance in the direction of the table, from that of its node `k` along the line through
    /// another one.
    fn corrected(
        &self,
        group: &Group<'a>,
        k: usize,
        other: Option<usize>,
        distance: f64,
    ) -> Option<Switched<N>> {
        let here = group.node(k)?;
        let there = other.and_then(|other| group.node(other)).unwrap_or(here);
        let span = there.distance - here.distance;
        let part = if span == 0.0 { 0.0 } else { (distance - here.distance) / span };
        let durations = here.durations.iter().zip(there.durations).map(|(a, b)| a + part * (b - a));
        let close: Switched<N> = switched(group, durations, 1.0)?;
        close.corrected(&goal(distance), self.zeros(), group.contacts)
    }

    fn zeros(&self) -> &[Zero] {
        self.zeros.get(..self.modes).unwrap_or_default()
    }

    /// The most that is left of a mode, as a part of the distance, m.
    fn residual(&self, motion: &Switched<N>, distance: f64) -> f64 {
        let mut most = 0.0_f64;
        for zero in self.zeros() {
            let [first, second] =
                motion.arcs().iter().fold(Default::default(), |response, arc| zero.after(response, arc));
            let (pole, size) = (zero.pole(), complex::norm(zero.pole()));
            // What the second one stands for grows with the duration, and its rounding does.
            let turned = 1.0 + size * motion.duration();
            let left = (complex::norm(first)).max(complex::norm(second) / turned);
            most = larger(most, left / (size * pole.im * distance.abs()));
        }
        most
    }

    /// How far a motion passes the limits of velocity and acceleration, as a part of them; negative inside.
    fn passed(&self, profile: &Piecewise<N>) -> f64 {
        let found = profile.extrema();
        let beyond = |range: Interval, bounds: Interval| {
            larger(range.upper / bounds.upper, range.lower / bounds.lower) - 1.0
        };
        larger(
            beyond(found.velocity, self.limits.velocity()),
            beyond(found.acceleration, self.limits.acceleration()),
        )
    }

    fn check_node(&self, group: &Group<'a>, node: &Node<'a>) -> Result<(), MoveTableError> {
        let Node { distance, durations } = *node;
        let lost = |residual: f64| MoveTableError::Residual { distance, residual };
        if !durations.iter().all(|duration| *duration >= 0.0) {
            return Err(lost(f64::INFINITY));
        }
        let motion: Switched<N> =
            switched(group, durations.iter().copied(), 1.0).ok_or(lost(f64::INFINITY))?;
        let missed = missed(&motion, distance);
        if missed > ENDED {
            return Err(lost(missed));
        }
        let residual = self.residual(&motion, distance);
        if residual > EXACT {
            return Err(lost(residual));
        }
        let bounds = self.limits.jerk();
        let jerk = group
            .jerks
            .iter()
            .fold(0.0, |most, jerk| larger(most, larger(jerk / bounds.upper, jerk / bounds.lower)));
        let part = larger(jerk - 1.0, self.passed(&profile(&motion, group, 1.0, distance)));
        if part > HELD { Err(MoveTableError::Limits { distance, part }) } else { Ok(()) }
    }
}

/// By how much the way there misses rest at the end, as a part of the distance.
fn missed<const N: usize>(motion: &Switched<N>, distance: f64) -> f64 {
    let end = motion.states().last().unwrap_or_default();
    let missed = [end.position - distance, end.velocity * end.time, end.acceleration * end.time * end.time];
    missed.iter().fold(0.0, |most, miss| larger(most, (miss / distance).abs()))
}

/// The larger of two numbers; infinity where one is none.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

fn goal(distance: f64) -> Goal {
    Goal { velocity: 0.0, distance: Some(distance) }
}

/// A motion of a run with its jerk times a factor.
fn switched<const N: usize>(
    group: &Group<'_>,
    durations: impl Iterator<Item = f64>,
    factor: f64,
) -> Option<Switched<N>> {
    let mut arcs = [Arc::default(); N];
    for (arc, (jerk, duration)) in arcs.iter_mut().zip(group.jerks.iter().zip(durations)) {
        *arc = Arc { jerk: factor * jerk, duration };
    }
    Switched::new(0.0, arcs.get(..group.jerks.len())?)
}

/// A motion of a run times a factor as a profile.
fn profile<const N: usize>(
    motion: &Switched<N>,
    group: &Group<'_>,
    factor: f64,
    distance: f64,
) -> Piecewise<N> {
    let mut contacts = [Contact::Turn { arc: 0, value: 0.0 }; N];
    let places = contacts.iter_mut().zip(group.contacts);
    places.for_each(|(place, contact)| *place = contact.scaled(factor));
    motion.profile(&goal(distance), contacts.get(..group.contacts.len()).unwrap_or_default())
}

/// Whether runs and slices fit together and into `N` arcs.
fn check_lengths<const N: usize>(family: &MoveFamily<'_>) -> Result<(), MoveTableError> {
    let mut needed = [0_usize; 4];
    for (run, &Run { arcs, contacts, moves }) in family.runs.iter().enumerate() {
        if arcs == 0 || arcs > N || contacts >= arcs {
            return Err(MoveTableError::Run { run, arcs, contacts, most: N });
        }
        let more = [arcs, contacts, moves, arcs.saturating_mul(moves)];
        needed.iter_mut().zip(more).for_each(|(sum, more)| *sum = sum.saturating_add(more));
    }
    let given = [family.jerks.len(), family.contacts.len(), family.distances.len(), family.durations.len()];
    let whats = ["jerks", "contacts", "distances", "durations"];
    for ((what, needed), given) in whats.into_iter().zip(needed).zip(given) {
        if needed != given {
            return Err(MoveTableError::Length { what, needed, given });
        }
    }
    Ok(())
}
