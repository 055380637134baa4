//! Moves as numbers.

use super::super::Contact;

/// Moves next to each other that have the same structure: jerk after jerk, and limits that are met.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Run {
    /// Arcs of each move.
    pub arcs: usize,
    /// Limits that each move meets.
    pub contacts: usize,
    /// Moves.
    pub moves: usize,
}

/// Moves by growing distance, as plain numbers that a `static` can hold: no padding, a number for each arc of each move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MoveFamily<'a> {
    /// Moves of the same structure.
    pub runs: &'a [Run],
    /// Jerk of each arc, m/s^3, run after run.
    pub jerks: &'a [f64],
    /// Where limits are met, run after run.
    pub contacts: &'a [Contact],
    /// Distances, m, move after move.
    pub distances: &'a [f64],
    /// Duration of each arc, s, move after move.
    pub durations: &'a [f64],
}

/// A run with its numbers.
#[derive(Debug, Clone, Copy)]
pub(super) struct Group<'a> {
    pub(super) index: usize,
    pub(super) jerks: &'a [f64],
    pub(super) contacts: &'a [Contact],
    pub(super) distances: &'a [f64],
    durations: &'a [f64],
}

impl<'a> Group<'a> {
    /// Distance and durations of a move, by its index within the run.
    pub(super) fn node(&self, k: usize) -> Option<Node<'a>> {
        let arcs = self.jerks.len();
        let first = k.checked_mul(arcs)?;
        let durations = self.durations.get(first..first.checked_add(arcs)?)?;
        self.distances.get(k).map(|distance| Node { distance: *distance, durations })
    }
}

/// A move.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node<'a> {
    pub(super) distance: f64,
    pub(super) durations: &'a [f64],
}

impl<'a> MoveFamily<'a> {
    /// The runs, as long as there are numbers for them.
    pub(super) fn groups(&self) -> impl Iterator<Item = Group<'a>> + use<'a> {
        let mut rest = *self;
        self.runs.iter().enumerate().map_while(move |(index, run)| {
            let (jerks, later_jerks) = rest.jerks.split_at_checked(run.arcs)?;
            let (contacts, later_contacts) = rest.contacts.split_at_checked(run.contacts)?;
            let (distances, later_distances) = rest.distances.split_at_checked(run.moves)?;
            let (durations, later) = rest.durations.split_at_checked(run.arcs.checked_mul(run.moves)?)?;
            (rest.jerks, rest.contacts) = (later_jerks, later_contacts);
            (rest.distances, rest.durations) = (later_distances, later);
            Some(Group { index, jerks, contacts, distances, durations })
        })
    }

    /// The run in which the move of an index lies, and its index there.
    pub(super) fn place(&self, mut index: usize) -> Option<(Group<'a>, usize)> {
        for group in self.groups() {
            match index.checked_sub(group.distances.len()) {
                Some(beyond) => index = beyond,
                None => return Some((group, index)),
            }
        }
        None
    }
}
