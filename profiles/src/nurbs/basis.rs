//! B-spline basis functions.

use super::MAX_DEGREE;
use super::knots::{Knots, Side};

/// The basis functions that are not zero at a parameter: `degree + 1` of them, not negative, with the sum one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Basis {
    first: usize,
    values: [f64; MAX_DEGREE + 1],
    count: usize,
}

impl Basis {
    /// Index of the control point that the first value belongs to.
    #[must_use]
    pub fn first(&self) -> usize {
        self.first
    }

    /// The values, for control points in sequence from the first.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        self.values.get(..self.count).unwrap_or_default()
    }
}

impl Knots {
    /// The basis functions at `u`, brought into the domain, on the given side of a knot:
    ///
    /// `N(i, 0) = 1` on its span, `N(i, p) = (u - u_i) / (u_(i+p) - u_i) N(i, p-1) + (u_(i+p+1) - u) / (u_(i+p+1) -
    /// u_(i+1)) N(i+1, p-1)`.
    ///
    /// # References
    /// C. de Boor, On calculating with B-splines, J. Approx. Theory 6, 1972, <https://doi.org/10.1016/0021-9045(72)90080-9>
    #[must_use]
    pub fn basis(&self, u: f64, side: Side) -> Basis {
        let u = self.within(u);
        let first = self.first_acting(u, side);
        let (left, right) = self.local(first).split_at(self.degree());
        let mut values = [0.0; MAX_DEGREE + 1];
        values[0] = 1.0;
        for raised in 1..=self.degree() {
            // The knots on both sides that the functions of this degree meet.
            let below = left.get(self.degree() - raised..).unwrap_or_default();
            let mut carried = 0.0;
            for ((value, low), high) in values.iter_mut().zip(below).zip(right) {
                let share = *value / (high - low);
                *value = carried + (high - u) * share;
                carried = (u - low) * share;
            }
            if let Some(last) = values.get_mut(raised) {
                *last = carried;
            }
        }
        Basis { first, values, count: self.degree() + 1 }
    }
}
