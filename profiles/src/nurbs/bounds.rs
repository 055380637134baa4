//! The largest value of a quotient of polynomials, for certain.

use super::bernstein::Bernstein;

/// A bound is at most this much beyond what is reached, relative to it.
const SLACK: f64 = 1e-3;

/// Halvings after which a denominator that may still vanish does.
const MOST_HALVINGS: u32 = 40;

/// Halvings in all, after which a bound is as good as it is.
const MOST_WORK: u32 = 4096;

/// Something over `[0, 1]` that has halves.
pub(super) trait Halved: Sized {
    /// It over `[0, 1/2]` and over `[1/2, 1]`, each again over `[0, 1]`.
    fn halves(&self) -> [Self; 2];
}

/// A quotient of two polynomials of the same degree over `[0, 1]`, the lower one not negative.
pub(super) struct Quotient {
    above: Bernstein,
    below: Bernstein,
}

impl Quotient {
    pub(super) fn new(above: Bernstein, below: Bernstein) -> Self {
        let (high, low) = (above.degree(), below.degree());
        Self { above: above.raised(low.saturating_sub(high)), below: below.raised(high.saturating_sub(low)) }
    }

    /// The largest quotient of coefficients, which the values never exceed; infinite where a coefficient below is not
    /// positive.
    fn upper(&self) -> f64 {
        let pairs = self.above.coefficients().iter().zip(self.below.coefficients());
        pairs.map(|(a, b)| if *b > 0.0 { a / b } else { f64::INFINITY }).fold(0.0, f64::max)
    }

    /// The larger value at the ends, and at which of them, 0 or 1, it is.
    fn reached(&self) -> (f64, f64) {
        let value = |a: Option<&f64>, b: Option<&f64>| match (a, b) {
            (Some(a), Some(b)) if *b > 0.0 => a / b,
            _ => 0.0,
        };
        let (above, below) = (self.above.coefficients(), self.below.coefficients());
        let (start, end) = (value(above.first(), below.first()), value(above.last(), below.last()));
        if end > start { (end, 1.0) } else { (start, 0.0) }
    }
}

/// The largest value of a quotient.
#[derive(Debug, Clone, Copy)]
pub(super) struct Largest {
    /// Never below it.
    pub(super) bound: f64,
    /// What is reached, and where in `[0, 1]`.
    pub(super) reached: f64,
    pub(super) place: f64,
}

/// A part and what is bounded in it.
struct Part<M> {
    from: f64,
    width: f64,
    of: M,
    upper: f64,
    reached: f64,
    place: f64,
    halvings: u32,
}

impl<M: Halved> Part<M> {
    fn new(of: M, from: f64, width: f64, halvings: u32, measure: fn(&M) -> Quotient) -> Self {
        let quotient = measure(&of);
        let (reached, end) = quotient.reached();
        Self { from, width, of, upper: quotient.upper(), reached, place: from + end * width, halvings }
    }

    fn halves(&self, measure: fn(&M) -> Quotient) -> [Self; 2] {
        let [left, right] = self.of.halves();
        let (width, halvings) = (0.5 * self.width, self.halvings + 1);
        [
            Self::new(left, self.from, width, halvings, measure),
            Self::new(right, self.from + width, width, halvings, measure),
        ]
    }
}

/// Bounds what is measured, at most `SLACK` above its largest value relatively or below `floor`; the bound is infinite where
/// there is a pole.
pub(super) fn largest<M: Halved>(of: M, floor: f64, measure: fn(&M) -> Quotient) -> Largest {
    let part = Part::new(of, 0.0, 1.0, 0, measure);
    let (mut reached, mut place) = (part.reached, part.place);
    let (mut bound, mut work) = (0.0_f64, 0);
    let mut open = alloc::vec![part];
    while let Some(part) = open.pop() {
        let close = part.upper <= floor.max(reached * (1.0 + SLACK));
        if close || part.halvings >= MOST_HALVINGS || work >= MOST_WORK {
            bound = bound.max(part.upper);
            if bound.is_infinite() {
                break;
            }
        } else {
            work += 1;
            let [left, right] = part.halves(measure);
            for half in [&left, &right] {
                if half.reached > reached {
                    (reached, place) = (half.reached, half.place);
                }
            }
            // The steeper half first: what it reaches closes others.
            open.extend(if left.upper > right.upper { [right, left] } else { [left, right] });
        }
    }
    Largest { bound, reached, place }
}
