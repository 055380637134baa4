//! Trains with negative impulses: shorter, for more effort of the drive.

use core::f64::consts::{FRAC_PI_3, PI};

use profiles::{Complex, Mode, Real, complex};

use super::extra_insensitive::unit_pole;
use super::spaced;
use crate::error::{ShaperError, TrainError};
use crate::newton::{Continued, Row, continued, newton};
use crate::train::{Impulse, ImpulseTrain};

/// Turns at which the two outer pairs of the undamped unity-magnitude train stand from its middle, rad: the zeros of
/// `1 - 2 cos(a) + 2 cos(b)` and `b sin(b) - a sin(a)`.
const UNITY: (f64, f64) = (1.738_6, 2.300_5);

/// A train with a zero of `order` (one or two) on the mode whose amplitudes alternate in sign and whose magnitudes add
/// up to `demand`.
pub(super) fn negative<const N: usize>(
    mode: Mode,
    order: usize,
    demand: f64,
) -> Result<ImpulseTrain<N>, ShaperError> {
    if !(1..=2).contains(&order) {
        return Err(ShaperError::Order { order, most: 2 });
    }
    let most = (2 * order + 1) as f64;
    if !(demand >= 1.0 && demand <= most) {
        return Err(ShaperError::Demand { demand, most });
    }
    let share = (demand - 1.0) / (most - 1.0);
    if share == 0.0 {
        return spaced::zero_vibration(mode, order);
    }
    if 2 * order + 1 > N {
        return Err(TrainError::Capacity { needed: 2 * order + 1, capacity: N }.into());
    }
    if order == 1 {
        // Undamped in closed form: A - B cos(t) + ... vanishes where cos(t2) = B / 2 A.
        let amplitudes = amplitudes::<3>(0.0, share);
        let cosine = share / (2.0 * amplitudes.first().copied().unwrap_or(1.0));
        let turn = Real::atan2(Real::sqrt((1.0 - cosine) * (1.0 + cosine)), cosine);
        placed::<3, 2, N>(mode, share, [turn, 2.0 * turn])
    } else {
        let start = [2.0 * FRAC_PI_3 * (1.0 - share) + UNITY.0 * share, PI * (1.0 - share) + UNITY.1 * share];
        let [inner, outer] = symmetric(share, start)
            .ok_or(ShaperError::Damping { damping_ratio: mode.damping_ratio(), reached: 0.0 })?;
        placed::<5, 4, N>(mode, share, [outer - inner, outer, outer + inner, 2.0 * outer])
    }
}

/// The amplitudes: those of the positive train (1, K or 1, 2 K, K^2 over their sum) and, between them, none, by
/// `1 - share`, and 1, -1, 1 ... by `share`.
fn amplitudes<const M: usize>(damping_ratio: f64, share: f64) -> [f64; M] {
    let k = Real::exp(unit_pole(damping_ratio).re * PI / unit_pole(damping_ratio).im);
    let sum = if M == 3 { 1.0 + k } else { (1.0 + k) * (1.0 + k) };
    let positive: [f64; 5] = if M == 3 { [1.0, 0.0, k, 0.0, 0.0] } else { [1.0, 0.0, 2.0 * k, 0.0, k * k] };
    let mut amplitudes = [0.0; M];
    let mut sign = 1.0;
    for (amplitude, positive) in amplitudes.iter_mut().zip(positive) {
        *amplitude = (1.0 - share) * positive / sum + share * sign;
        sign = -sign;
    }
    amplitudes
}

/// The turns of the undamped train of order two about its middle: `c - 2 b cos(x) + 2 a cos(y)` and its derivative along
/// the frequency are zero.
fn symmetric(share: f64, start: [f64; 2]) -> Option<[f64; 2]> {
    let [a, b, c, ..] = amplitudes::<5>(0.0, share);
    newton(start, |&[x, y]| {
        let ((sx, cx), (sy, cy)) = (Real::sin_cos(x), Real::sin_cos(y));
        [
            Row { coefficients: [-2.0 * b * sx, -2.0 * a * sy], right: c + 2.0 * b * cx + 2.0 * a * cy },
            Row { coefficients: [b * (sx + x * cx), a * (sy + y * cy)], right: b * x * sx + a * y * sy },
        ]
    })
}

/// Places `M` impulses of given amplitudes, the first at zero, so that the mode is left at rest; `D = M - 1`.
fn placed<const M: usize, const D: usize, const N: usize>(
    mode: Mode,
    share: f64,
    undamped: [f64; D],
) -> Result<ImpulseTrain<N>, ShaperError> {
    let target = mode.damping_ratio();
    // No negative train is longer than the positive one; what Newton's method finds far beyond is no solution, for there
    // everything but the last impulse has decayed.
    let longest = |damping_ratio: f64| (M / 2) as f64 * PI / unit_pole(damping_ratio).im;
    let at = |damping_ratio: f64, start: [f64; D]| {
        let amplitudes = amplitudes::<M>(damping_ratio, share);
        newton(start, |times| equations(&amplitudes, times, unit_pole(damping_ratio))).filter(|times| {
            times.first().is_some_and(|t| *t > 0.0)
                && times.last().is_some_and(|t| *t < 1.01 * longest(damping_ratio))
                && times.windows(2).all(|pair| matches!(pair, [a, b] if a < b))
        })
    };
    let guess = |z: f64| undamped.map(|turn| turn / unit_pole(z).im);
    let times =
        if target == 0.0 { Continued::Reached(undamped) } else { continued(undamped, target, guess, at) };
    match times {
        Continued::Reached(times) => {
            let mut impulses = [Impulse::default(); M];
            let amplitudes = amplitudes::<M>(target, share);
            let times = core::iter::once(&0.0).chain(&times);
            for (impulse, (amplitude, time)) in impulses.iter_mut().zip(amplitudes.iter().zip(times)) {
                *impulse = Impulse::new(time / mode.angular_frequency(), *amplitude);
            }
            Ok(ImpulseTrain::new(&impulses)?)
        }
        Continued::Lost(reached) => Err(ShaperError::Damping { damping_ratio: target, reached }),
    }
}

/// `sum of A e^(-p t)` and, for order two, `sum of A t e^(-p t)`, with their gradients by the times.
fn equations<const M: usize, const D: usize>(
    amplitudes: &[f64; M],
    times: &[f64; D],
    pole: Complex<f64>,
) -> [Row<D>; D] {
    let mut rows = [Row::ZERO; D];
    let mut sums = [Complex::new(0.0, 0.0); 2];
    let [zeroth, first] = &mut sums;
    *zeroth += amplitudes.first().copied().unwrap_or(0.0);
    for (unknown, (amplitude, time)) in amplitudes.iter().skip(1).zip(times).enumerate() {
        let share = complex::exp(-pole * *time) * *amplitude;
        *zeroth += share;
        *first += share * *time;
        let gradients = [-pole * share, share * (Complex::new(1.0, 0.0) - pole * *time)];
        let parts = gradients.into_iter().flat_map(|gradient| [gradient.re, gradient.im]);
        for (row, part) in rows.iter_mut().zip(parts) {
            if let Some(place) = row.coefficients.get_mut(unknown) {
                *place = part;
            }
        }
    }
    let values = sums.into_iter().flat_map(|sum| [sum.re, sum.im]);
    rows.iter_mut().zip(values).for_each(|(row, value)| row.right = value);
    rows
}
