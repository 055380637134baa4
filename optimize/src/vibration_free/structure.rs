//! Arcs and the limits they meet.

use profiles::switched::{Arc, Contact};

use super::Motion;
use super::task::{Place, Task};

/// Arcs, where the motion meets limits, and where bands are as full as is tolerated.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Structure {
    pub(super) arcs: Vec<Arc>,
    pub(super) contacts: Vec<Contact>,
    pub(super) places: Vec<Place>,
}

/// How far off a limit may be that is met, as a part of itself.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blur {
    /// The shortest arc that is one.
    pub(super) shortest: f64,
    /// Distance of an acceleration from its limit.
    pub(super) acceleration: f64,
    /// Distance of a velocity from its limit.
    pub(super) velocity: f64,
    /// The same for a velocity that touches its limit and turns.
    pub(super) turn: f64,
}

/// Adds an arc, to the last one where the jerk is the same.
pub(super) fn push(arcs: &mut Vec<Arc>, jerk: f64, duration: f64) {
    match arcs.last_mut() {
        Some(last) if last.jerk.total_cmp(&jerk).is_eq() => last.duration += duration,
        _ => arcs.push(Arc { jerk, duration }),
    }
}

fn merged(arcs: &[Arc]) -> Vec<Arc> {
    let mut all = Vec::new();
    arcs.iter().for_each(|arc| push(&mut all, arc.jerk, arc.duration));
    all
}

impl Structure {
    /// The structure of `arcs` that meet limits to within a blur; none where there are too many of them.
    pub(super) fn of(task: &Task, arcs: &[Arc], blur: Blur) -> Option<Self> {
        let kept: Vec<Arc> = arcs.iter().filter(|arc| arc.duration >= blur.shortest).copied().collect();
        let mut arcs = merged(&kept);
        // An arc without jerk that meets no limit is the time in which the jerk changes sign.
        loop {
            let contacts = contacts(task, &arcs, blur)?;
            let free = |(k, arc): &(usize, &Arc)| {
                arc.jerk == 0.0 && !contacts.iter().any(|contact| contact.arc() == *k)
            };
            let Some((k, arc)) = arcs.iter().enumerate().find(free) else {
                return Some(Self { arcs, contacts, places: vec![] });
            };
            let half = 0.5 * arc.duration;
            for neighbour in [k.checked_sub(1), Some(k + 1)].into_iter().flatten() {
                if let Some(arc) = arcs.get_mut(neighbour) {
                    arc.duration += half;
                }
            }
            arcs.remove(k);
            arcs = merged(&arcs);
        }
    }

    /// Where an arc's velocity, its acceleration or neither is at a limit.
    pub(super) fn stay(&self, index: usize) -> Option<Stay> {
        let here = self.contacts.iter().filter(|contact| contact.arc() == index);
        let velocity = here.clone().find_map(|contact| match contact {
            Contact::Velocity { value, .. } => Some(Stay::Velocity(*value)),
            _ => None,
        });
        let acceleration = here.clone().find_map(|contact| match contact {
            Contact::Acceleration { value, .. } => Some(Stay::Acceleration(*value)),
            _ => None,
        });
        velocity.or(acceleration)
    }

    /// Without the arc of this index, and without what it meets; its neighbours become one where they are alike.
    pub(super) fn without(&self, index: usize) -> Self {
        let mut arcs: Vec<Arc> = Vec::new();
        let mut places = Vec::new();
        for (k, arc) in self.arcs.iter().enumerate() {
            if k == index {
                places.push(None);
                continue;
            }
            push(&mut arcs, arc.jerk, arc.duration);
            places.push(Some(arcs.len() - 1));
        }
        let contacts = self.contacts.iter().filter_map(|contact| {
            let place = places.get(contact.arc()).copied().flatten()?;
            Some(contact.moved(place))
        });
        Self { contacts: contacts.collect(), arcs, places: self.places.clone() }
    }

    /// Without the arc of this index, where the limit that it met is only touched.
    pub(super) fn touching(&self, index: usize) -> Self {
        let mut structure = self.without(index);
        // Where both sides are alike the velocity turns within them; else what follows starts where the arc was.
        let alike = structure.arcs.len() + 1 < self.arcs.len();
        match self.stay(index) {
            Some(Stay::Velocity(value)) if alike && index > 0 => {
                structure.contacts.push(Contact::Turn { arc: index - 1, value });
            }
            Some(Stay::Acceleration(value)) if !alike => {
                structure.contacts.push(Contact::Acceleration { arc: index, value });
            }
            _ => {}
        }
        structure
    }

    /// With a stretch without jerk at a limit, `from` after the start of an arc.
    pub(super) fn with_stay(&self, index: usize, from: f64, stay: Stay) -> Self {
        let (mut before, mut after) = (vec![], vec![]);
        if let Some(arc) = self.arcs.get(index) {
            if from > 0.0 {
                before.push(Arc { duration: from, ..*arc });
            }
            after.push(Arc { duration: arc.duration - from, ..*arc });
        }
        self.replaced(index, &[before, vec![Arc::default()], after].concat(), |first| {
            stay.contacts(if from > 0.0 { first + 1 } else { first })
        })
    }

    /// With other arcs in the place of one, and what they meet given the index of the first of them.
    pub(super) fn replaced(
        &self,
        index: usize,
        by: &[Arc],
        meets: impl FnOnce(usize) -> Vec<Contact>,
    ) -> Self {
        let (before, rest) = self.arcs.split_at(index.min(self.arcs.len()));
        let after = rest.get(1..).unwrap_or_default();
        let shift = by.len().saturating_sub(1);
        let kept = self.contacts.iter().filter_map(|contact| match contact {
            // Which part it now lies in is found out again.
            Contact::Turn { arc, .. } if *arc == index => None,
            _ if contact.arc() > index => Some(contact.moved(contact.arc() + shift)),
            _ => Some(*contact),
        });
        let contacts = kept.chain(meets(index)).collect();
        Self { arcs: [before, by, after].concat(), contacts, places: self.places.clone() }
    }
}

/// A limit that is kept for a while.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Stay {
    Acceleration(f64),
    Velocity(f64),
}

impl Stay {
    /// What an arc without jerk meets.
    pub(super) fn contacts(self, arc: usize) -> Vec<Contact> {
        match self {
            Self::Acceleration(value) => vec![Contact::Acceleration { arc, value }],
            Self::Velocity(value) => {
                vec![Contact::Acceleration { arc, value: 0.0 }, Contact::Velocity { arc, value }]
            }
        }
    }
}

/// What arcs without jerk meet, and where a velocity turns at its limit.
fn contacts(task: &Task, arcs: &[Arc], blur: Blur) -> Option<Vec<Contact>> {
    let motion = Motion::new(task.from, arcs)?;
    let mut contacts = Vec::new();
    let steepest = motion.states().map(|state| state.acceleration.abs()).fold(0.0, f64::max);
    let near = |value: f64, limit: f64, part: f64| (value - limit).abs() <= part * limit.abs();
    let velocities = [task.velocity.upper, task.velocity.lower];
    let accelerations = [task.acceleration.upper, task.acceleration.lower];
    for (arc, (state, stretch)) in motion.states().zip(arcs).enumerate() {
        if stretch.jerk != 0.0 {
            let (turn, inside) = (-state.acceleration / stretch.jerk, 1e-2 * stretch.duration);
            if turn > inside && turn < stretch.duration - inside {
                let velocity = state.advanced(stretch.jerk, turn).velocity;
                let met = velocities.into_iter().find(|limit| near(velocity, *limit, blur.turn));
                contacts.extend(met.map(|value| Contact::Turn { arc, value }));
            }
            continue;
        }
        if arc == 0 || arc + 1 == arcs.len() {
            continue;
        }
        // In the middle, where what is off at one end is not yet off twice.
        let middle = state.advanced(0.0, 0.5 * stretch.duration);
        let at = |limit: &f64| near(middle.acceleration, *limit, blur.acceleration);
        let level = middle.acceleration.abs() <= blur.acceleration * steepest;
        let stay = if let Some(limit) = accelerations.into_iter().find(at) {
            Some(Stay::Acceleration(limit))
        } else {
            let at = |limit: &f64| level && near(middle.velocity, *limit, blur.velocity);
            velocities.into_iter().find(at).map(Stay::Velocity)
        };
        contacts.extend(stay.into_iter().flat_map(|stay| stay.contacts(arc)));
    }
    Some(contacts)
}
