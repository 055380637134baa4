//! From switches to a profile.

use super::states::SwitchState;
use super::{Contact, Goal, Switched};
use crate::polynomial::{Piece, Piecewise};
use crate::quantities::Sample;

impl<const N: usize> Switched<N> {
    /// The motion as a profile that ends at the goal exactly, and lies on the limits exactly where it meets them.
    ///
    /// The first half is expanded from the start, the second one from the end, so that what rounding is left of the
    /// conditions lies in between.
    #[must_use]
    pub fn profile(&self, goal: &Goal, contacts: &[Contact]) -> Piecewise<N> {
        let duration = self.duration();
        let mut starts = [SwitchState::default(); N];
        starts.iter_mut().zip(self.states()).for_each(|(place, state)| *place = state);
        let end = self.states().last().unwrap_or_default();
        let target = goal.distance.unwrap_or(end.position);
        let mut pieces = [Piece::new(duration, 0.0, Sample::cruising(target, goal.velocity)); N];
        let mut ends = [duration; N];
        // From the end backwards.
        let mut later =
            SwitchState { time: duration, position: target, velocity: goal.velocity, acceleration: 0.0 };
        for (k, arc) in self.arcs().iter().enumerate().rev() {
            let before = later.advanced(arc.jerk, -arc.duration);
            let start = starts.get(k).copied().unwrap_or_default();
            let first_half = start.time + 0.5 * arc.duration < 0.5 * duration;
            let (anchor, reach, state) = if first_half {
                (start.time, arc.duration, start)
            } else {
                (later.time, -arc.duration, later)
            };
            let mut motion = Sample {
                position: state.position,
                velocity: state.velocity,
                acceleration: state.acceleration,
                jerk: arc.jerk,
                snap: 0.0,
            };
            for contact in contacts.iter().filter(|contact| contact.arc() == k && arc.jerk == 0.0) {
                match *contact {
                    Contact::Acceleration { value, .. } => motion.acceleration = value,
                    Contact::Velocity { value, .. } => motion.velocity = value,
                    Contact::Turn { .. } => {}
                }
            }
            if let Some((piece, end)) = pieces.get_mut(k).zip(ends.get_mut(k)) {
                *piece = Piece::new(anchor, reach, motion);
                *end = if k + 1 == self.len { duration } else { start.time + arc.duration };
            }
            later = before;
        }
        Piecewise { ends, pieces, before: self.from, target, after: goal.velocity, duration }
    }
}
