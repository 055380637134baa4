//! What is left over bands of frequency.

use profiles::Interval;
use profiles::switched::Arc;

use super::structure::Structure;
use super::task::{Band, Place, Task};

/// Samples of a band, per rad that its poles turn in the course of the motion.
const DENSITY: f64 = 2.0;
/// What may be left beyond what is aimed for, as a part of it: less than the aim is below what is tolerated.
const BEYOND: f64 = 5e-5;
/// Intervals before a certificate is given up.
const HALVINGS: usize = 100_000;
/// Places closer than this, as a part of the frequency, are one.
const CLOSE: f64 = 1e-6;

/// Whether no more is left of any band than is tolerated.
pub(super) fn is_kept(task: &Task, arcs: &[Arc]) -> bool {
    worst(task, arcs) <= 1.0 + BEYOND
}

/// The most that is left, as a part of what is aimed for; zero without bands.
pub(super) fn worst(task: &Task, arcs: &[Arc]) -> f64 {
    peaks(task, arcs).iter().map(|place| place.part(arcs)).fold(0.0, f64::max)
}

/// The places of the structure moved to where most is left, with those at which more is left than is tolerated; none where
/// that is nowhere.
pub(super) fn fuller(task: &Task, structure: &Structure, arcs: &[Arc]) -> Option<Vec<Place>> {
    let peaks = peaks(task, arcs);
    let beyond = peaks.iter().filter(|place| place.part(arcs) > 1.0 + BEYOND);
    beyond.clone().next()?;
    let distance = |a: &Place, b: &Place| (a.pole - b.pole).norm();
    let nearest = |place: &Place| {
        let nearest = peaks.iter().min_by(|a, b| distance(a, place).total_cmp(&distance(b, place)));
        nearest.copied().unwrap_or(*place)
    };
    let mut places: Vec<Place> = Vec::new();
    for place in structure.places.iter().map(nearest).chain(beyond.copied()) {
        if !places.iter().any(|other| distance(other, &place) <= CLOSE * place.pole.norm()) {
            places.push(place);
        }
    }
    Some(places)
}

/// Whether no mode of any band is left with more than is tolerated, between all samples too.
///
/// Over factors `x` of the frequency within `h` of `c` the response to the jerk is `q(c) + (x - c) q'(c)`, of which the
/// magnitude is largest at an end, and no more than `h^2 / 2` times a bound of `q''` beyond that. Intervals are halved until
/// the bound suffices.
pub(super) fn is_certified(task: &Task, arcs: &[Arc]) -> bool {
    let end: f64 = arcs.iter().map(|arc| arc.duration).sum();
    task.bands.iter().all(|band| {
        let slowest = band.place(band.factors.lower).pole.re;
        // |p|^2 times the integral of |j| R^2 e^(Re p R), with R the time left.
        let mut left = end;
        let integral: f64 = arcs
            .iter()
            .map(|arc| {
                let before = left;
                left = (left - arc.duration).max(0.0);
                arc.jerk.abs() * (before.powi(3) - left.powi(3)) / 3.0 * (slowest * left).exp()
            })
            .sum();
        let curvature = band.place(1.0).pole.norm_sqr() * integral;
        let mut open = vec![band.factors];
        let mut rounds = 0;
        while let Some(Interval { lower, upper }) = open.pop() {
            rounds += 1;
            let (centre, half) = (0.5 * (lower + upper), 0.5 * (upper - lower));
            let place = band.place(centre);
            let [value, slope] = place.responses(arcs, true);
            // r is |p| times the derivative by the pole, and the pole is a multiple of the factor.
            let slope = slope * (place.pole / (place.pole.norm() * centre)) * half;
            let bound = (value + slope).norm().max((value - slope).norm()) + 0.5 * half * half * curvature;
            if bound <= band.tolerated(lower) {
                continue;
            }
            if rounds > HALVINGS || value.norm() > band.tolerated(centre) {
                return false;
            }
            open.extend([Interval::new(lower, centre), Interval::new(centre, upper)]);
        }
        true
    })
}

/// Local maxima of what is left over the bands, their ends included.
pub(super) fn peaks(task: &Task, arcs: &[Arc]) -> Vec<Place> {
    task.bands.iter().flat_map(|band| peaks_of(band, arcs)).collect()
}

fn peaks_of(band: &Band, arcs: &[Arc]) -> Vec<Place> {
    let Interval { lower, upper } = band.factors;
    let duration: f64 = arcs.iter().map(|arc| arc.duration).sum();
    let turned = (upper - lower) * band.place(1.0).pole.norm() * duration;
    let count = (8.0 + DENSITY * turned).min(4000.0).floor();
    let step = (upper - lower) / count;
    let at = |factor: f64| band.place(factor).part(arcs);
    let samples: Vec<f64> = (0..=count as usize).map(|k| at(lower + step * k as f64)).collect();
    let sample = |k: Option<usize>| k.and_then(|k| samples.get(k)).copied().unwrap_or(0.0);
    let top = |k: &usize| {
        let here = sample(Some(*k));
        here >= sample(k.checked_sub(1)) && here >= sample(Some(k + 1))
    };
    (0..samples.len())
        .filter(top)
        .map(|k| {
            let centre = lower + step * k as f64;
            let range = Interval::new((centre - step).max(lower), (centre + step).min(upper));
            band.place(largest(at, range))
        })
        .collect()
}

/// Where a function with one maximum in an interval has it, by golden sections.
fn largest(f: impl Fn(f64) -> f64, range: Interval) -> f64 {
    let part = 0.5 * (5.0_f64.sqrt() - 1.0);
    let Interval { mut lower, mut upper } = range;
    let (mut a, mut b) = (upper - part * (upper - lower), lower + part * (upper - lower));
    let (mut f_a, mut f_b) = (f(a), f(b));
    for _ in 0..40 {
        if f_a >= f_b {
            (upper, b, f_b) = (b, a, f_a);
            a = upper - part * (upper - lower);
            f_a = f(a);
        } else {
            (lower, a, f_a) = (a, b, f_b);
            b = lower + part * (upper - lower);
            f_b = f(b);
        }
    }
    // An end of the band is a maximum of its own.
    [lower, 0.5 * (lower + upper), upper].into_iter().max_by(|x, y| f(*x).total_cmp(&f(*y))).unwrap_or(lower)
}
