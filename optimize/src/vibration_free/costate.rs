//! The switching function: what a jerk at an instant is worth.

use profiles::Complex;
use profiles::switched::{Contact, SwitchState, Zero};

use super::newton::Optimum;
use super::structure::Structure;
use super::task::Task;

/// What one mode adds to the switching function, a time `R` before the end: `Re ((l + m |p| R) e^(p R))`.
#[derive(Debug, Clone, Copy)]
struct Part {
    zero: Zero,
    first: Complex<f64>,
    second: Complex<f64>,
}

/// `S(t)`, how much sooner the motion could end for a unit of jerk more at `t` (per second of it).
///
/// With `l` the multipliers of the end, the zeros, and of the limits that are met after `t`,
/// `S = l_a + l_v R + l_x R^2/2 + Re(...) + sum of l_i + sum of l_k (t_k - t)`. By the maximum principle a motion that
/// meets its conditions is the shortest there is, as the problem is convex, where
/// - jerk is full upwards where `S > 0` and downwards where `S < 0`;
/// - along an upper limit of acceleration `S` falls, along a lower one it rises;
/// - along an upper limit of velocity `S` is convex, along a lower one concave.
#[derive(Debug, Clone)]
pub(super) struct Costate {
    end: [f64; 3],
    parts: Vec<Part>,
    /// Index of the arc, its start, multipliers of acceleration and velocity there.
    contacts: Vec<(usize, f64, [f64; 2])>,
    states: Vec<SwitchState>,
    duration: f64,
}

impl Costate {
    pub(super) fn new(task: &Task, structure: &Structure, optimum: &Optimum) -> Self {
        let mut multipliers = optimum.multipliers.iter().copied();
        let mut next = || multipliers.next().unwrap_or(0.0);
        let mut end = [next(), next(), 0.0];
        if task.goal.distance.is_some() {
            end[2] = next();
        }
        let parts = task.zeros.iter().map(|zero| {
            // l . (Re, Im) of z is the real part of (l_re - i l_im) z.
            let mut pair = || Complex::new(next(), -next());
            let first = pair();
            let second = if zero.is_double() { pair() } else { Complex::default() };
            Part { zero: *zero, first, second }
        });
        let mut parts: Vec<Part> = parts.collect();
        let states: Vec<_> = optimum.motion.states().collect();
        let contacts = structure.contacts.iter().map(|contact| {
            let (arc, multiplier) = (contact.arc(), next());
            let start = states.get(arc).copied().unwrap_or_default();
            match contact {
                Contact::Acceleration { .. } => (arc, start.time, [multiplier, 0.0]),
                Contact::Velocity { .. } => (arc, start.time, [0.0, multiplier]),
                Contact::Turn { .. } => {
                    let jerk = structure.arcs.get(arc).map_or(1.0, |arc| arc.jerk);
                    (arc, start.time - start.acceleration / jerk, [0.0, multiplier])
                }
            }
        });
        let contacts = contacts.collect();
        parts.extend(structure.places.iter().map(|place| {
            // (|q|^2 / r^2 - 1) / 2 changes by Re(q* dq) / r^2.
            let first = place.response(optimum.motion.arcs()).conj() * (next() / place.tolerated.powi(2));
            Part { zero: Zero::at(place.pole, false), first, second: Complex::default() }
        }));
        let duration = optimum.motion.duration();
        Self { end, parts, contacts, states, duration }
    }

    /// The motion at the switches.
    pub(super) fn states(&self) -> &[SwitchState] {
        &self.states
    }

    /// `S` and its first two derivatives by time at `t`, within an arc.
    pub(super) fn at(&self, arc: usize, t: f64) -> [f64; 3] {
        let rest = self.duration - t;
        let [a, v, x] = self.end;
        let mut value = [a + rest * (v + 0.5 * rest * x), -v - rest * x, x];
        for Part { zero, first, second } in &self.parts {
            let (p, size) = (zero.pole(), zero.pole().norm());
            let turn = (p * rest).exp();
            let weight = first + second * (size * rest);
            let slope = second * size;
            // Time runs against the time left.
            let terms = [weight * turn, -(weight * p + slope) * turn, (weight * p + slope * 2.0) * p * turn];
            value.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term.re);
        }
        for (index, at, [a, v]) in &self.contacts {
            if *index > arc || *index == arc && t < *at {
                value[0] += a + v * (at - t);
                value[1] -= v;
            }
        }
        value
    }
}
