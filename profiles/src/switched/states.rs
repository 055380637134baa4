//! The motion at the switches, and how it depends on the durations.

use num_complex::Complex;

use super::{Contact, Goal, Switched, Zero};

/// The motion at the start of an arc.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SwitchState {
    /// Time since the start, s.
    pub time: f64,
    /// Position, m.
    pub position: f64,
    /// Velocity, m/s.
    pub velocity: f64,
    /// Acceleration, m/s^2.
    pub acceleration: f64,
}

impl SwitchState {
    /// The motion a time `d` later with the jerk `c`.
    #[must_use]
    pub fn advanced(&self, c: f64, d: f64) -> Self {
        let Self { time, position, velocity, acceleration } = *self;
        Self {
            time: time + d,
            position: position + d * (velocity + d * (0.5 * acceleration + d * c * (1.0 / 6.0))),
            velocity: velocity + d * (acceleration + 0.5 * d * c),
            acceleration: acceleration + d * c,
        }
    }

    /// What an arc of the jerk `c` that ends here adds, per second, to acceleration, velocity and position a time `rest`
    /// later.
    #[must_use]
    pub fn column(&self, c: f64, rest: f64) -> [f64; 3] {
        let &Self { velocity, acceleration, .. } = self;
        [c, acceleration + c * rest, velocity + rest * (acceleration + 0.5 * rest * c)]
    }
}

impl<const N: usize> Switched<N> {
    /// The motion at the start of every arc; that at the end is the last one.
    pub fn states(&self) -> impl Iterator<Item = SwitchState> {
        let start = SwitchState { velocity: self.from, ..SwitchState::default() };
        let later = self.arcs().iter().scan(start, |state, arc| {
            *state = state.advanced(arc.jerk, arc.duration);
            Some(*state)
        });
        core::iter::once(start).chain(later)
    }

    /// Calls `row` with every condition in order: end of acceleration, velocity and position, zeros, contacts.
    pub fn conditions(
        &self,
        goal: &Goal,
        zeros: &[Zero],
        contacts: &[Contact],
        mut row: impl FnMut(&Condition<N>),
    ) {
        let mut starts = [SwitchState::default(); N];
        let mut ends = [SwitchState::default(); N];
        starts.iter_mut().zip(self.states()).for_each(|(place, state)| *place = state);
        ends.iter_mut().zip(self.states().skip(1)).for_each(|(place, state)| *place = state);
        let end = self.states().last().unwrap_or_default();
        let ends = || self.arcs().iter().zip(&ends);
        let mut columns = [[0.0; 3]; N];
        for (column, (arc, state)) in columns.iter_mut().zip(ends()) {
            *column = state.column(arc.jerk, end.time - state.time);
        }
        let whole = |value: f64, gradient: [f64; N], curvature: [f64; N]| Condition {
            value,
            gradient,
            curvature,
            bend: 0.0,
            arcs: self.len,
        };
        let [acceleration, velocity, position] = [0, 1, 2].map(|order| columns.map(|column| column[order]));
        row(&whole(end.acceleration, acceleration, [0.0; N]));
        row(&whole(end.velocity - goal.velocity, velocity, acceleration));
        if let Some(distance) = goal.distance {
            row(&whole(end.position - distance, position, velocity));
        }
        for zero in zeros {
            let mut response = [Complex::default(); 2];
            let mut columns = [[Default::default(); 2]; N];
            for (column, (arc, state)) in columns.iter_mut().zip(ends()) {
                response = zero.advanced(response, arc.jerk, arc.duration);
                *column = zero.column(response, arc.jerk, end.time - state.time);
            }
            response[0] -= zero.rest();
            let slopes = columns.map(|column| zero.turned(column));
            for (order, value) in response.iter().enumerate().take(zero.conditions() / 2) {
                let part = |of: fn(&Complex<f64>) -> f64| {
                    let along = |columns: &[[Complex<f64>; 2]; N]| columns.map(|column| of(&column[order]));
                    whole(of(value), along(&columns), along(&slopes))
                };
                row(&part(|z| z.re));
                row(&part(|z| z.im));
            }
        }
        for contact in contacts {
            let Some((start, arc)) = starts.get(contact.arc()).zip(self.arcs().get(contact.arc())) else {
                continue;
            };
            let (value, at, order, bend) = match *contact {
                Contact::Acceleration { value, .. } => (start.acceleration - value, *start, 0, 0.0),
                Contact::Velocity { value, .. } => (start.velocity - value, *start, 1, 0.0),
                Contact::Turn { value, .. } => {
                    let turn = start.advanced(arc.jerk, -start.acceleration / arc.jerk);
                    (turn.velocity - value, turn, 1, 1.0 / arc.jerk)
                }
            };
            let mut condition = whole(value, [0.0; N], [0.0; N]);
            (condition.bend, condition.arcs) = (bend, contact.arc());
            let places = condition.gradient.iter_mut().zip(&mut condition.curvature);
            for ((gradient, curvature), (arc, state)) in places.zip(ends().take(contact.arc())) {
                let [acceleration, velocity, _] = state.column(arc.jerk, at.time - state.time);
                (*gradient, *curvature) =
                    if order == 0 { (acceleration, 0.0) } else { (velocity, acceleration) };
            }
            row(&condition);
        }
    }
}

/// A condition on the durations `d` of the arcs: `value` must be zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Condition<const N: usize> {
    /// What must be zero.
    pub value: f64,
    /// Its derivatives by the durations; zero from `arcs` on.
    pub gradient: [f64; N],
    /// With `m` the smaller of `k` and `l`, both below `arcs`, its second derivative by `d_k` and `d_l` is
    /// `curvature_m - bend c_k c_l`, with `c` the jerk of the arcs.
    pub curvature: [f64; N],
    /// See `curvature`; 1/jerk of the arc within which the velocity turns, else zero.
    pub bend: f64,
    /// Arcs on which it depends.
    pub arcs: usize,
}
