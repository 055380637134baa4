//! Extra-insensitive shapers: humps of a tolerated vibration.

use core::f64::consts::PI;

use profiles::{Complex, Mode, Real, complex};

use super::spaced::Spaced;
use crate::error::{ShaperError, TrainError};
use crate::newton::{Continued, Row, continued, newton};
use crate::train::{Impulse, ImpulseTrain};

/// The most humps.
pub(super) const MOST_HUMPS: usize = 3;
/// Frequencies at which something is asked of a train: zeros, and humps between them.
const MOST_PLACES: usize = 2 * MOST_HUMPS + 1;

/// The train with `humps` humps of the sensitivity, as high as `tolerance`, about the mode.
pub(super) fn extra_insensitive<const N: usize>(
    mode: Mode,
    humps: usize,
    tolerance: f64,
) -> Result<ImpulseTrain<N>, ShaperError> {
    if !(1..=MOST_HUMPS).contains(&humps) {
        return Err(ShaperError::Humps { humps, most: MOST_HUMPS });
    }
    if !(tolerance > 0.0 && tolerance < 1.0) {
        return Err(ShaperError::Tolerance(tolerance));
    }
    if humps + 2 > N {
        return Err(TrainError::Capacity { needed: humps + 2, capacity: N }.into());
    }
    let undamped = Undamped::new(humps, tolerance);
    if mode.damping_ratio() == 0.0 {
        return Ok(undamped.train(0.5 * mode.damped_period())?);
    }
    // Unknowns: amplitudes but the last, times but the first, places but the one on the mode.
    match humps {
        1 => damped::<6, N>(mode, &undamped),
        2 => damped::<10, N>(mode, &undamped),
        _ => damped::<14, N>(mode, &undamped),
    }
}

/// The shaper of an undamped mode: equal ripples over its band, a Chebyshev polynomial in the cosine of a quarter turn.
#[derive(Debug, Clone, Copy)]
struct Undamped {
    humps: usize,
    tolerance: f64,
    /// Value of the cosine up to which the ripples go, inverted.
    stretch: f64,
}

impl Undamped {
    fn new(humps: usize, tolerance: f64) -> Self {
        // T_n(stretch) = 1 / tolerance, by T_n(cosh u) = cosh(n u).
        let inverse = 1.0 / tolerance;
        let u = Real::ln(inverse + Real::sqrt((inverse - 1.0) * (inverse + 1.0))) / (humps + 1) as f64;
        Self { humps, tolerance, stretch: 0.5 * (Real::exp(u) + Real::exp(-u)) }
    }

    /// The turn in half a period, rad, of the place with this index: a zero where even, a hump where odd, upwards.
    fn turn(&self, place: usize) -> f64 {
        let cosine = Real::cos((place + 1) as f64 * PI / (2 * (self.humps + 1)) as f64) / self.stretch;
        2.0 * Real::atan2(Real::sqrt((1.0 - cosine) * (1.0 + cosine)), cosine)
    }

    fn spaced<const M: usize>(&self) -> Spaced<M> {
        let zeros = self.humps + 1;
        let mut train = Spaced::one();
        for pair in 0..zeros / 2 {
            train = train.with_pair(1.0, self.turn(2 * pair));
        }
        if zeros % 2 == 1 { train.with_half_turn(1.0) } else { train }
    }

    fn train<const M: usize>(&self, half_period: f64) -> Result<ImpulseTrain<M>, TrainError> {
        self.spaced().train(half_period)
    }

    /// A start for the damped equations: amplitudes fall with the mode, times and places keep their turns.
    fn start<const D: usize>(&self, damping_ratio: f64) -> [f64; D] {
        let last = self.humps + 1;
        let root = Real::sqrt((1.0 - damping_ratio) * (1.0 + damping_ratio));
        let decay = Real::exp(-PI * damping_ratio / root);
        let mut amplitudes = [0.0; MOST_HUMPS + 2];
        let (mut power, mut sum) = (1.0, 0.0);
        if let Ok(train) = self.train::<{ MOST_HUMPS + 2 }>(1.0) {
            for (amplitude, impulse) in amplitudes.iter_mut().zip(train.impulses()) {
                *amplitude = impulse.amplitude * power;
                sum += *amplitude;
                power *= decay;
            }
        }
        let shares = amplitudes.iter().take(last).map(|a| a / sum);
        let times = (1..=last).map(|k| k as f64 * PI / root);
        let places = (0..2 * self.humps + 1).filter(|k| *k != self.humps).map(|k| self.turn(k) / PI);
        let mut start = [0.0; D];
        start.iter_mut().zip(shares.chain(times).chain(places)).for_each(|(x, value)| *x = value);
        start
    }
}

/// Solves the equations in units of the mode: times by `1/w`, frequencies by `w`.
fn damped<const D: usize, const N: usize>(
    mode: Mode,
    undamped: &Undamped,
) -> Result<ImpulseTrain<N>, ShaperError> {
    let (humps, target) = (undamped.humps, mode.damping_ratio());
    let at = |damping_ratio: f64, start: [f64; D]| {
        let pole = unit_pole(damping_ratio);
        let found =
            newton(start, |unknowns| Candidate::of(humps, unknowns).equations(pole, undamped.tolerance));
        found.filter(|unknowns| Candidate::of(humps, unknowns).is_in_order())
    };
    match continued(undamped.start(0.0), target, |z| undamped.start(z), at) {
        Continued::Reached(unknowns) => {
            let candidate = Candidate::of(humps, &unknowns);
            let mut impulses = [Impulse::default(); MOST_HUMPS + 2];
            let found = candidate.amplitudes.iter().zip(&candidate.times);
            for (impulse, (amplitude, time)) in impulses.iter_mut().zip(found) {
                *impulse = Impulse::new(time / mode.angular_frequency(), *amplitude);
            }
            Ok(ImpulseTrain::new(impulses.get(..humps + 2).unwrap_or_default())?)
        }
        Continued::Lost(reached) => Err(ShaperError::Damping { damping_ratio: target, reached }),
    }
}

/// The pole of a mode of 1 rad/s.
pub(super) fn unit_pole(damping_ratio: f64) -> Complex<f64> {
    Complex::new(-damping_ratio, Real::sqrt((1.0 - damping_ratio) * (1.0 + damping_ratio)))
}

/// What a vector of unknowns says, in units of the mode; the unused rest of every array is zero.
struct Candidate {
    humps: usize,
    amplitudes: [f64; MOST_HUMPS + 2],
    times: [f64; MOST_HUMPS + 2],
    places: [f64; MOST_PLACES],
}

impl Candidate {
    fn of<const D: usize>(humps: usize, unknowns: &[f64; D]) -> Self {
        let mut rest = unknowns.iter().copied();
        let mut candidate = Self { humps, amplitudes: [0.0; 5], times: [0.0; 5], places: [0.0; MOST_PLACES] };
        let mut left = 1.0;
        for (k, amplitude) in candidate.amplitudes.iter_mut().enumerate().take(humps + 2) {
            *amplitude = if k <= humps { rest.next().unwrap_or(0.0) } else { left };
            left -= *amplitude;
        }
        for time in candidate.times.iter_mut().take(humps + 2).skip(1) {
            *time = rest.next().unwrap_or(0.0);
        }
        for (k, place) in candidate.places.iter_mut().enumerate().take(2 * humps + 1) {
            *place = if k == humps { 1.0 } else { rest.next().unwrap_or(0.0) };
        }
        candidate
    }

    fn is_in_order(&self) -> bool {
        let rising = |values: &[f64]| values.windows(2).all(|pair| matches!(pair, [a, b] if a < b));
        rising(self.times.get(..self.humps + 2).unwrap_or_default())
            && rising(self.places.get(..2 * self.humps + 1).unwrap_or_default())
            && self.places.first().is_some_and(|lowest| *lowest > 0.0)
    }

    /// `2 (humps + 1)` equations for zeros, and for every hump its height and its slope of zero.
    fn equations<const D: usize>(&self, pole: Complex<f64>, tolerance: f64) -> [Row<D>; D] {
        let mut rows = [Row::ZERO; D];
        let mut free = rows.iter_mut();
        for (k, place) in self.places.iter().enumerate().take(2 * self.humps + 1) {
            let here = self.at(pole, *place);
            let (Some(first), Some(second)) = (free.next(), free.next()) else { break };
            // The unknown that is this place, if it is one.
            let fixed = usize::from(k > self.humps);
            let own = (k != self.humps).then_some(2 * (self.humps + 1) + k - fixed);
            if k % 2 == 0 {
                (first.right, second.right) = (here.value.re, here.value.im);
                here.into_rows(first, second, own, |gradient, _| (gradient.re, gradient.im));
            } else {
                // (|F|^2 - V^2) / 2 V and its derivative along the frequency, both over V.
                let (value, slope) = (here.value, here.slope);
                let scale = 1.0 / tolerance;
                first.right = 0.5 * scale * (value.norm_sqr() - tolerance * tolerance);
                second.right = scale * (value.conj() * slope).re;
                here.into_rows(first, second, own, |gradient, of_slope| {
                    let height = (value.conj() * gradient).re;
                    (scale * height, scale * (gradient.conj() * slope + value.conj() * of_slope).re)
                });
            }
        }
        rows
    }

    /// The response at `place` times the pole, its derivatives by the place, and the gradients of response and slope.
    fn at(&self, pole: Complex<f64>, place: f64) -> Response {
        let p = pole * place;
        let end = self.times.get(self.humps + 1).copied().unwrap_or(0.0);
        let zero = Complex::new(0.0, 0.0);
        let mut response = Response {
            humps: self.humps,
            value: zero,
            slope: zero,
            bend: zero,
            by_amplitude: [(zero, zero); MOST_HUMPS + 2],
            by_time: [(zero, zero); MOST_HUMPS + 2],
        };
        let gradients = response.by_amplitude.iter_mut().zip(&mut response.by_time);
        let impulses = self.amplitudes.iter().zip(&self.times);
        let (mut by_end, mut slope_by_end) = (zero, zero);
        for ((by_amplitude, by_time), (amplitude, time)) in gradients.zip(impulses).take(self.humps + 2) {
            let left = end - time;
            let phasor = if left == 0.0 { Complex::new(1.0, 0.0) } else { complex::exp(p * left) };
            let (turned, share) = (pole * left * phasor, phasor * *amplitude);
            response.value += share;
            response.slope += turned * *amplitude;
            response.bend += pole * left * turned * *amplitude;
            *by_amplitude = (phasor, turned);
            let (rate, slope_rate) = (p * share, pole * share * (p * left + 1.0));
            *by_time = (-rate, -slope_rate);
            by_end += rate;
            slope_by_end += slope_rate;
        }
        // Everything waits for the last impulse; its own time is no delay of it.
        if let Some(last) = response.by_time.get_mut(self.humps + 1) {
            *last = (last.0 + by_end, last.1 + slope_by_end);
        }
        response
    }
}

/// The response of a train at a place, with its derivatives.
struct Response {
    humps: usize,
    value: Complex<f64>,
    slope: Complex<f64>,
    bend: Complex<f64>,
    /// Gradients of value and slope.
    by_amplitude: [(Complex<f64>, Complex<f64>); MOST_HUMPS + 2],
    by_time: [(Complex<f64>, Complex<f64>); MOST_HUMPS + 2],
}

impl Response {
    /// Writes two rows of gradients, made by `both` from the gradients of value and slope by one unknown.
    fn into_rows<const D: usize>(
        self,
        first: &mut Row<D>,
        second: &mut Row<D>,
        own: Option<usize>,
        both: impl Fn(Complex<f64>, Complex<f64>) -> (f64, f64),
    ) {
        let unknown = self.humps + 1;
        // The last amplitude is what the others leave of one.
        let last = self.by_amplitude.get(unknown).copied().unwrap_or_default();
        let amplitudes = self.by_amplitude.iter().take(unknown).map(|of| (of.0 - last.0, of.1 - last.1));
        let times = self.by_time.iter().skip(1).take(unknown).copied();
        let places = first.coefficients.iter_mut().zip(&mut second.coefficients);
        for ((a, b), of) in places.zip(amplitudes.chain(times)) {
            (*a, *b) = both(of.0, of.1);
        }
        if let Some(own) = own
            && let (Some(a), Some(b)) = (first.coefficients.get_mut(own), second.coefficients.get_mut(own))
        {
            (*a, *b) = both(self.slope, self.bend);
        }
    }
}
