//! The shortest chain within limits.

use super::MOST_MODES;
use super::link::Link;
use crate::quantities::{Mode, Real};

/// Averages that limits of velocity, acceleration and jerk ask for.
const ROLES: usize = 3;
/// Averages a chain may have: its position is then a polynomial of the fourth degree.
const MOST_AVERAGES: u32 = 4;

/// What the limits ask of a move of length `h`: `h/V`, `h/A` and `h/J` must not exceed the product of one, two and three
/// averages. Zero where there is no limit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Demand {
    pub(super) velocity: f64,
    pub(super) acceleration: f64,
    pub(super) jerk: f64,
}

/// An average whose length is given, by a mode.
#[derive(Debug, Clone, Copy)]
struct Given {
    length: f64,
    /// Inverse of its largest weight, s.
    effective: f64,
    /// Time between two of its steps, s.
    spacing: f64,
}

impl Given {
    fn of(link: &Link) -> Option<Self> {
        let Link::Damped { period, decay, .. } = *link else { return None };
        let length = link.duration();
        let spacing = if decay < 1.0 { 0.5 * period } else { length };
        Some(Self { length, effective: link.effective(), spacing })
    }
}

/// What may be done about one mode: a pair, or one of the averages that are as long as a part of the S-curve.
#[derive(Debug, Clone, Copy)]
struct Choices {
    links: [Option<Link>; ROLES + 2],
    now: usize,
}

impl Choices {
    fn of(mode: Mode, index: usize, s_curve: [f64; ROLES]) -> Self {
        let [first, second, third] = s_curve.map(|length| Link::damped(mode, index, length));
        let mut links = [Some(Link::pair(mode, index)), Link::damped(mode, index, 0.0), third, second, first];
        // Each once.
        let mut before = None;
        for link in &mut links {
            if *link == before {
                *link = None;
            } else if link.is_some() {
                before = *link;
            }
        }
        Self { links, now: 0 }
    }

    fn link(&self) -> Option<Link> {
        self.links.get(self.now).copied().flatten()
    }

    /// Goes to the next one, and says whether there was one; if not, to the first.
    fn advance(&mut self) -> bool {
        let next = (self.now + 1..self.links.len()).find(|k| matches!(self.links.get(*k), Some(Some(_))));
        self.now = next.unwrap_or(0);
        next.is_some()
    }
}

/// A chain to be: a link for each mode, and the plain averages, zero where there is none.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plan {
    pub(super) modes: [Option<Link>; MOST_MODES],
    pub(super) plain: [f64; ROLES],
}

/// The shortest chain in at most `capacity` sections, or the fewest sections that would do.
///
/// Any three averages bound the peaks of a move: `v <= h/e1`, `a <= h/(e1 e2)`, `j <= c h/(e1 e2 e3)` with `e` the inverse
/// of an average's largest weight. `c` is 1 where the steps of one average are as far apart as all others are long, and
/// never more than 2. Each mode gets a pair or an average; each of the three parts goes to one of those averages or to a
/// plain one, as short as that allows.
pub(super) fn shortest(demand: Demand, modes: &[Mode], capacity: usize) -> Result<Plan, usize> {
    let s_curve = three(demand, 0.0);
    let mut choices = [None; MOST_MODES];
    for (index, (choice, mode)) in choices.iter_mut().zip(modes).enumerate() {
        *choice = Some(Choices::of(*mode, index, s_curve));
    }
    let mut best: Option<(f64, Plan)> = None;
    let mut fewest = usize::MAX;
    loop {
        let links = choices.map(|choice| choice.and_then(|choice| choice.link()));
        consider(demand, links, capacity, &mut best, &mut fewest);
        // Counts through all choices, the first mode's fastest.
        if !choices.iter_mut().flatten().any(Choices::advance) {
            break;
        }
    }
    best.map(|(_, plan)| plan).ok_or(fewest)
}

/// Takes the shortest chain with these links for the modes if it is shorter than the `best`.
fn consider(
    demand: Demand,
    modes: [Option<Link>; MOST_MODES],
    capacity: usize,
    best: &mut Option<(f64, Plan)>,
    fewest: &mut usize,
) {
    let links = modes.iter().flatten();
    let duration: f64 = links.clone().map(Link::duration).sum();
    if best.is_some_and(|(shortest, _)| duration >= shortest) {
        return;
    }
    let knots: usize = links.clone().map(Link::knots).product();
    let mut given = [None; MOST_MODES];
    given.iter_mut().zip(links.filter_map(Given::of)).for_each(|(place, average)| *place = Some(average));
    sort(&mut given);
    let averages = given.iter().flatten().count() as u32;
    for free in 0..1_u32 << ROLES {
        let plain = free.count_ones();
        if plain + averages < ROLES as u32 || plain + averages > MOST_AVERAGES {
            continue;
        }
        let sections = (knots << plain) - 1;
        *fewest = sections.min(*fewest);
        if sections > capacity {
            continue;
        }
        let Some(plain) = fill(demand, free, &given) else { continue };
        let duration = duration + plain.iter().sum::<f64>();
        if best.is_none_or(|(shortest, _)| duration < shortest) {
            *best = Some((duration, Plan { modes, plain }));
        }
    }
}

/// The longest first.
fn sort(given: &mut [Option<Given>]) {
    let length = |average: &Option<Given>| average.map_or(0.0, |given| given.effective);
    // Of four: three rounds of neighbours.
    for _ in 1..given.len() {
        let mut rest = given.iter_mut();
        let mut longest = rest.next();
        for next in rest {
            if let Some(before) = longest
                && length(before) < length(next)
            {
                core::mem::swap(before, next);
            }
            longest = Some(next);
        }
    }
}

/// The plain averages for the parts that are `free`, bit by bit; the others go to the longest of the given ones.
fn fill(demand: Demand, free: u32, given: &[Option<Given>]) -> Option<[f64; ROLES]> {
    let mut given = given.iter().flatten().copied();
    let mut parts = [None; ROLES];
    for (k, part) in parts.iter_mut().enumerate() {
        if free >> k & 1 == 0 {
            *part = Some(given.next()?);
        }
    }
    let rest: f64 = given.map(|average| average.length).sum();
    let Demand { velocity, acceleration, jerk } = demand;
    match parts {
        [None, None, None] => Some(three(demand, rest)),
        [None, None, Some(third)] => {
            let product = |c: f64| acceleration.max(c * jerk / third.effective);
            let [first, second] = two(velocity, product, third.length + rest);
            Some([first, second, 0.0])
        }
        [None, Some(second), None] => {
            let least = velocity.max(acceleration / second.effective);
            let [first, third] = two(least, |c| c * jerk / second.effective, second.length + rest);
            Some([first, 0.0, third])
        }
        [None, Some(second), Some(third)] => {
            let product = second.effective * third.effective;
            let least = velocity.max(acceleration / second.effective);
            let longest = least
                .max(jerk / product)
                .max(apart(second.length + third.length + rest, second.length.min(third.length)));
            Some([longest.min(least.max(2.0 * jerk / product)), 0.0, 0.0])
        }
        [Some(first), second, third] => {
            let e = first.effective;
            if e < velocity {
                return None;
            }
            let behind = |c: f64| match (second, third) {
                (None, None) => {
                    let product = c * jerk / e;
                    let second = (acceleration / e).max(Real::sqrt(product));
                    Some([0.0, second, product / second])
                }
                (None, Some(third)) => {
                    Some([0.0, (acceleration / e).max(c * jerk / (e * third.effective)), 0.0])
                }
                (Some(second), _) if e * second.effective < acceleration => None,
                (Some(second), None) => Some([0.0, 0.0, c * jerk / (e * second.effective)]),
                (Some(second), Some(third)) => {
                    (e * second.effective * third.effective >= c * jerk).then_some([0.0; ROLES])
                }
            };
            let others: f64 = [second, third].iter().flatten().map(|average| average.length).sum();
            let keeps_apart = |plain: &[f64; ROLES]| {
                let shortest = plain.iter().filter(|t| **t > 0.0).copied().fold(f64::INFINITY, f64::min);
                apart(plain.iter().sum::<f64>() + others + rest, shortest) <= first.spacing
            };
            behind(1.0).filter(keeps_apart).or_else(|| behind(2.0))
        }
    }
}

/// How long an average must be to keep its steps apart by others that are `sum` in all, of which the shortest is `least`:
/// where that is lost in the rounding of the sum, ramps of its length would overlap.
fn apart(sum: f64, least: f64) -> f64 {
    if least < 1e-12 * sum { sum * (1.0 + 64.0 * f64::EPSILON) } else { sum }
}

/// Two averages with at least `first` and the product, the larger one first; `beyond` is the length of all others.
fn two(first: f64, product: impl Fn(f64) -> f64, beyond: f64) -> [f64; 2] {
    let bound = |c: f64| {
        let q = product(c);
        let longer = first.max(Real::sqrt(q));
        [longer, q / longer]
    };
    let [longer, shorter] = bound(1.0);
    if longer >= apart(shorter + beyond, shorter) {
        return [longer, shorter];
    }
    // x (x + beyond) = product keeps them apart, as does twice the product without.
    let shorter = behind(product(1.0), beyond);
    let least = apart(shorter + beyond, shorter);
    let [longer, other] = bound(2.0);
    if longer + other < least + shorter { [longer, other] } else { [least, shorter] }
}

/// The positive `x` with `x (x + b) = q`.
fn behind(q: f64, b: f64) -> f64 {
    let half = 0.5 * b;
    // Not the difference of root and half, which cancels.
    q / (half + Real::sqrt(half * half + q))
}

/// Three averages, the first at least as long as the others and `rest` together.
fn three(demand: Demand, rest: f64) -> [f64; ROLES] {
    let Demand { velocity, acceleration, jerk } = demand;
    let third = jerk / acceleration;
    if velocity > 0.0 {
        let second = acceleration / velocity;
        let both = Real::sqrt(jerk / velocity);
        // Written so that an unlimited acceleration, whose third is infinite, takes the other branch.
        let (second, third) = if second >= third { (second, third) } else { (both, both) };
        if velocity >= apart(second + third + rest, third) {
            return [velocity, second, third];
        }
    }
    let second = behind(acceleration, third + rest);
    let (second, third) = if second >= third && third.is_finite() {
        (second, third)
    } else {
        let both = equal(jerk, rest);
        (both, both)
    };
    [apart(second + third + rest, third), second, third]
}

/// The positive `x` with `x^2 (2 x + b) = q`, by Newton's method from above, where it only falls.
fn equal(q: f64, b: f64) -> f64 {
    let mut x = Real::cbrt(0.5 * q).min(Real::sqrt(q / b));
    for _ in 0..60 {
        let next = x - (x * x * (2.0 * x + b) - q) / (x * (6.0 * x + 2.0 * b));
        // Written so that NaN ends it.
        if next < x {
            x = next;
        } else {
            break;
        }
    }
    x
}
