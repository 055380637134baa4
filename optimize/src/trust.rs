//! Descent by steps within a region of trust.

/// How far the steps of a descent may go.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Trust {
    /// The first region, in units of the unknowns.
    pub(crate) first: f64,
    /// The largest one.
    pub(crate) most: f64,
    /// The smallest one: shorter steps are lost in the accuracy of the solver.
    pub(crate) rest: f64,
    /// A gain that the solver cannot tell from nothing.
    pub(crate) nothing: f64,
    /// Steps at most.
    pub(crate) steps: usize,
}

impl Trust {
    /// The state of least `merit` that steps from `start` lead to. A `step` within a region answers where it leads and what
    /// merit it predicts; the region grows where that comes true and shrinks where it does not.
    pub(crate) fn descend<T>(
        self,
        start: T,
        merit: impl Fn(&T) -> f64,
        step: impl Fn(&T, f64) -> Option<(T, f64)>,
    ) -> T {
        let mut state = start;
        let mut value = merit(&state);
        let mut trust = self.first;
        for _ in 0..self.steps {
            if trust < self.rest {
                break;
            }
            let Some((next, predicted)) = step(&state, trust) else {
                trust *= 0.25;
                continue;
            };
            let (expected, next_value) = (value - predicted, merit(&next));
            if expected < self.nothing {
                break;
            }
            let gained = (value - next_value) / expected;
            if gained > 0.0 {
                (state, value) = (next, next_value);
            }
            trust *= if gained > 0.75 {
                2.0
            } else if gained > 0.1 {
                1.0
            } else {
                0.25
            };
            trust = trust.min(self.most);
        }
        state
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_valley_is_descended_by_linear_steps() {
        let merit = |x: &f64| (x - 2.0).powi(2);
        // The linear model of a parabola predicts too much: the region has to shrink.
        let step = |x: &f64, trust: f64| {
            let slope = 2.0 * (x - 2.0);
            Some((x - trust * slope.signum(), merit(x) - trust * slope.abs()))
        };
        let trust = Trust { first: 0.3, most: 1.0, rest: 1e-9, nothing: 1e-16, steps: 200 };
        assert!((trust.descend(-5.0, merit, step) - 2.0).abs() < 1e-6);
        // Steps that fail shrink the region until it is at rest.
        assert!((trust.descend(-5.0, merit, |_, _| None) + 5.0).abs() < 1e-15);
    }
}
