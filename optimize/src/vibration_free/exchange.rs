//! The structure of the optimum by exchange: arcs that would take negative time go, limits that are passed are met, and
//! where the switching function asks for another jerk there is one.

use profiles::switched::Contact;

use super::Motion;
use super::band;
use super::improve::{Verdict, verdict};
use super::newton::{Optimum, stationary};
use super::settle::settled;
use super::structure::{Blur, Stay, Structure};
use super::task::{Place, Task};

/// Changes of the structure before it is given up.
const EXCHANGES: usize = 32;
/// Steps of the programmes that come to the aid of Newton's method.
const RESCUE_STEPS: usize = 25;
/// The most arcs with which that is worth its time.
const AIDED: usize = 32;
/// The most arcs that are exchanged.
const MOST_EXCHANGED: usize = 48;
/// Times that places of a band are added to them, and the part of what is tolerated that is all of it.
const FILLINGS: usize = 2;
const FULL: f64 = 0.98;
/// What a linear programme leaves of durations and limits.
const SETTLED: Blur = Blur { shortest: 1e-4, acceleration: 1e-2, velocity: 2e-3, turn: 1e-5 };
/// An arc that is none, as a part of the S-curve's duration.
const SHORTEST: f64 = 1e-9;
/// A limit that is passed by less, as a part of its size, is met.
const MET: f64 = 5e-13;

/// A motion that meets all that is asked.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Found {
    pub(super) structure: Structure,
    pub(super) motion: Motion,
    /// The multipliers that prove it the shortest; none where there is no proof.
    pub(super) multipliers: Option<Vec<f64>>,
}

/// The optimum near a structure; if it is not reached, the shortest motion on the way there that meets all that is asked.
/// With aid a sequence of programmes brings the structure closer where Newton's method alone does not get there.
pub(super) fn exchanged(task: &Task, start: Structure, known: Option<&[f64]>, aided: bool) -> Option<Found> {
    let alone = unaided(task, start.clone(), known);
    if !aided || start.arcs.len() > AIDED || alone.as_ref().is_some_and(Found::is_proven) {
        return alone;
    }
    let Some(closer) = rescued(task, &start) else { return alone };
    let found = [exact(task, &closer), unaided(task, closer, None)];
    found.into_iter().flatten().fold(alone, |best, found| Some(shorter(best, found)))
}

fn unaided(task: &Task, start: Structure, known: Option<&[f64]>) -> Option<Found> {
    let mut structure = start;
    let mut known = known;
    let mut best: Option<Found> = None;
    let mut added = None;
    for _ in 0..EXCHANGES {
        if structure.arcs.len() > MOST_EXCHANGED {
            break;
        }
        let Some(optimum) = stationary(task, &structure, known.take()) else { break };
        structure.arcs = optimum.motion.arcs().to_vec();
        let durations = structure.arcs.iter().enumerate().map(|(index, arc)| (index, arc.duration));
        let short = durations.filter(|(_, d)| *d < SHORTEST).min_by(|(_, a), (_, b)| a.total_cmp(b));
        if let Some((index, _)) = short {
            // A limit that is passed without a stay and needs a negative one is touched.
            structure =
                if added == Some(index) { structure.touching(index) } else { structure.without(index) };
            added = None;
        } else if let Some(Passed { arc, from, stay }) = passed(task, &optimum.motion) {
            structure = structure.with_stay(arc, from, stay);
            added = Some(if from > 0.0 { arc + 1 } else { arc });
        } else if let Some(place) = useless(&structure, &optimum) {
            match place {
                Useless::Contact(place) => drop(structure.contacts.remove(place)),
                Useless::Place(place) => drop(structure.places.remove(place)),
            }
        } else if let Some(fuller) = band::fuller(task, &structure, optimum.motion.arcs()) {
            structure.places = fuller;
        } else {
            let Optimum { motion, multipliers } = optimum.clone();
            let unproven = Found { structure: structure.clone(), motion, multipliers: None };
            match verdict(task, &structure, &optimum) {
                Verdict::Optimal => return Some(Found { multipliers: Some(multipliers), ..unproven }),
                Verdict::Better(better) => structure = better,
                Verdict::Unknown => return Some(shorter(best, unproven)),
            }
            best = Some(shorter(best, unproven));
        }
    }
    best
}

impl Found {
    pub(super) fn is_proven(&self) -> bool {
        self.multipliers.is_some()
    }
}

/// Of two motions the shorter one; of two that last as long, but for a billionth, the one with fewer switches.
pub(super) fn shorter(best: Option<Found>, found: Found) -> Found {
    let Some(best) = best else { return found };
    if best.is_proven() != found.is_proven() {
        return if best.is_proven() { best } else { found };
    }
    let (a, b) = (best.motion.duration(), found.motion.duration());
    let order = |found: &Found| (found.motion.switches(), found.motion.effort());
    let better = if (a - b).abs() <= 1e-9 * a { order(&found) < order(&best) } else { b < a };
    if better { found } else { best }
}

/// The structure to which a sequence of programmes leads.
fn rescued(task: &Task, structure: &Structure) -> Option<Structure> {
    let mut arcs = structure.arcs.clone();
    let mut places = structure.places.clone();
    for _ in 0..if task.bands.is_empty() { 1 } else { FILLINGS } {
        arcs = settled(task, &arcs, &places, RESCUE_STEPS)?.arcs().to_vec();
        let beyond = band::peaks(task, &arcs).into_iter().filter(|place| place.part(&arcs) > 1.0);
        let beyond: Vec<_> = beyond.collect();
        if beyond.is_empty() {
            break;
        }
        places.extend(beyond);
    }
    let full = |place: &Place| place.part(&arcs) > FULL;
    let places = band::peaks(task, &arcs).into_iter().filter(full).collect();
    Some(Structure { places, ..Structure::of(task, &arcs, SETTLED)? })
}

/// The motion nearest to a structure that meets all that is asked.
pub(super) fn exact(task: &Task, structure: &Structure) -> Option<Found> {
    let close = Motion::new(task.from, &structure.arcs)?;
    let motion = close.corrected(&task.goal, &task.zeros, &structure.contacts)?;
    let good = passed(task, &motion).is_none() && band::is_kept(task, motion.arcs());
    good.then(|| Found { structure: structure.clone(), motion, multipliers: None })
}

/// Where a limit is passed.
struct Passed {
    arc: usize,
    /// Time into the arc.
    from: f64,
    stay: Stay,
}

/// The limit that is passed furthest, in parts of its size.
fn passed(task: &Task, motion: &Motion) -> Option<Passed> {
    let mut worst = (MET, None);
    let mut consider = |value: f64, limit: f64, passed: Passed| {
        let by = value / limit - 1.0;
        if by > worst.0 && by.is_finite() {
            worst = (by, Some(passed));
        }
    };
    for (arc, (state, stretch)) in motion.states().zip(motion.arcs()).enumerate() {
        for limit in [task.acceleration.lower, task.acceleration.upper] {
            consider(state.acceleration, limit, Passed { arc, from: 0.0, stay: Stay::Acceleration(limit) });
        }
        let turn = -state.acceleration / stretch.jerk;
        if stretch.jerk == 0.0 || turn < 0.0 || turn > stretch.duration {
            continue;
        }
        let velocity = state.advanced(stretch.jerk, turn).velocity;
        for limit in [task.velocity.lower, task.velocity.upper] {
            consider(velocity, limit, Passed { arc, from: turn, stay: Stay::Velocity(limit) });
        }
    }
    worst.1
}

/// A limit that is only touched, or a place of a band, by its index.
enum Useless {
    Contact(usize),
    Place(usize),
}

/// A limit that is touched although the motion would be no longer without it.
fn useless(structure: &Structure, optimum: &Optimum) -> Option<Useless> {
    let (contacts, places) = (structure.contacts.len(), structure.places.len());
    let first = optimum.multipliers.len().checked_sub(contacts + places)?;
    let multipliers = optimum.multipliers.get(first..)?;
    let touched = |contact: &Contact| match *contact {
        Contact::Turn { value, .. } => Some(value),
        Contact::Acceleration { arc, value } => {
            structure.arcs.get(arc).filter(|arc| arc.jerk != 0.0).map(|_| value)
        }
        Contact::Velocity { .. } => None,
    };
    let contact = structure
        .contacts
        .iter()
        .zip(multipliers)
        .position(|(contact, multiplier)| touched(contact).is_some_and(|limit| multiplier * limit > 0.0));
    let place = || multipliers.iter().skip(contacts).position(|multiplier| *multiplier > 0.0);
    contact.map(Useless::Contact).or_else(|| place().map(Useless::Place))
}
