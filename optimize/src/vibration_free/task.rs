//! What is asked of a motion, without units.

use profiles::switched::{Arc, Goal, Zero};
use profiles::{Complex, Interval, Limits, Mode, Profile, SCurve, Sectioned};

use super::error::VibrationFreeError;
use super::{MOST_MODES, Request, Robustness};

/// What is aimed for in a band, as a part of what is tolerated: the rest is what the certificate cannot tell.
const AIM: f64 = 1.0 - 2e-4;
/// A part of what is tolerated that a solver can tell.
const VISIBLE: f64 = 2e-5;
/// The longest half period of a mode, in durations of the S-curve.
const SLOWEST: f64 = 1e4;
/// A distance of two poles, as a part of the frequency, of which the square is nothing.
const SAME: f64 = 3e-7;
/// Places of a band at which it is kept on a grid.
const PLACES: usize = 5;

/// A mode of which a band of frequency may be left with a tolerated amplitude.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Band {
    /// Pole in the middle.
    pole: Complex<f64>,
    /// The band, as factors of the frequency.
    pub(super) factors: Interval,
    /// The tolerated amplitude.
    residual: f64,
}

impl Band {
    /// The place at a factor of the frequency.
    pub(super) fn place(&self, factor: f64) -> Place {
        let pole = self.pole * factor;
        // A mode is left with |q| / (|p| w_d), with q the response of its pole to the jerk.
        Place { pole, tolerated: AIM * self.residual * pole.norm() * pole.im }
    }

    /// For another size of the motion.
    pub(super) fn scale(&mut self, factor: f64) {
        self.residual *= factor;
    }

    /// What a certificate must show: the tolerated response at a factor of the frequency.
    pub(super) fn tolerated(&self, factor: f64) -> f64 {
        self.place(factor).tolerated / AIM
    }

    /// Places over the band, for a grid.
    pub(super) fn places(&self) -> impl Iterator<Item = Place> {
        let Interval { lower, upper } = self.factors;
        let step = (upper - lower) / (PLACES - 1) as f64;
        (0..PLACES).map(move |k| self.place(lower + step * k as f64))
    }
}

/// A pole and what its response to the jerk may be at the end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub(super) pole: Complex<f64>,
    pub(super) tolerated: f64,
}

impl Place {
    /// The response of the pole to the jerk at the end.
    pub(super) fn response(&self, arcs: &[Arc]) -> Complex<f64> {
        let [response, _] = self.responses(arcs, false);
        response
    }

    /// And its derivative by the pole times the pole's magnitude.
    pub(super) fn responses(&self, arcs: &[Arc], derivative: bool) -> [Complex<f64>; 2] {
        let zero = Zero::at(self.pole, derivative);
        arcs.iter().fold(Default::default(), |response, arc| zero.after(response, arc))
    }

    /// Its magnitude as a part of what is tolerated.
    pub(super) fn part(&self, arcs: &[Arc]) -> f64 {
        self.response(arcs).norm() / self.tolerated
    }
}

/// A motion upwards with the duration of the S-curve as the unit of time and the distance (or the change of velocity
/// times that unit) as the unit of length.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Task {
    pub(super) velocity: Interval,
    pub(super) acceleration: Interval,
    pub(super) jerk: Interval,
    /// Velocity at the start.
    pub(super) from: f64,
    pub(super) goal: Goal,
    pub(super) zeros: Vec<Zero>,
    pub(super) bands: Vec<Band>,
    /// Where the bands are kept on a grid.
    pub(super) places: Vec<Place>,
    /// The S-curve.
    pub(super) plain: Vec<Arc>,
    /// A duration that a convolution of the S-curve would reach; the S-curve's is one.
    pub(super) longest: f64,
    /// s.
    pub(super) time: f64,
    /// m, negative for a motion downwards.
    pub(super) length: f64,
}

/// The modes, those that are the same but for what a double zero covers once, and whether there was more than one.
fn distinct(modes: &[Mode]) -> Vec<(Mode, bool)> {
    let mut distinct: Vec<(Mode, bool)> = Vec::new();
    for mode in modes {
        let same = |(other, _): &&mut (Mode, bool)| {
            (other.pole() - mode.pole()).norm() <= SAME * other.angular_frequency()
        };
        match distinct.iter_mut().find(same) {
            Some((_, twice)) => *twice = true,
            None => distinct.push((*mode, false)),
        }
    }
    distinct
}

impl Task {
    /// The task, and the S-curve that meets all of it but the modes.
    pub(super) fn new(
        request: &Request,
        limits: &Limits,
        modes: &[Mode],
        robustness: Robustness,
    ) -> Result<(Self, SCurve), VibrationFreeError> {
        if modes.len() > MOST_MODES {
            return Err(VibrationFreeError::Modes { modes: modes.len(), most: MOST_MODES });
        }
        if let Robustness::Band { half_width, residual } = robustness {
            if !(half_width > 0.0 && half_width < 1.0) {
                return Err(VibrationFreeError::HalfWidth(half_width));
            }
            if !(1e-9..1.0).contains(&residual) {
                return Err(VibrationFreeError::Residual(residual));
            }
        }
        let (s_curve, change) = match *request {
            Request::Move { distance } => (SCurve::rest_to_rest(distance, limits)?, distance),
            Request::Ramp { from, to } => (SCurve::velocity_ramp(from, to, limits)?, to - from),
        };
        let time = s_curve.duration();
        let along = if change < 0.0 { limits.mirrored() } else { *limits };
        let jerk = along.jerk();
        if !(jerk.lower.is_finite() && jerk.upper.is_finite()) {
            return Err(profiles::PlanError::Unlimited("jerk").into());
        }
        let sign = 1.0_f64.copysign(change);
        let (length, from, goal) = match *request {
            Request::Move { distance } => (distance.abs(), 0.0, Goal { velocity: 0.0, distance: Some(1.0) }),
            Request::Ramp { from, to } => {
                let unit = change.abs();
                (unit * time, sign * from / unit, Goal { velocity: sign * to / unit, distance: None })
            }
        };
        let scaled = |bounds: Interval, order: i32| {
            let factor = time.powi(order) / length;
            Interval::new(bounds.lower * factor, bounds.upper * factor)
        };
        let mut longest = 1.0;
        let (mut zeros, mut bands) = (Vec::new(), Vec::new());
        let modes = distinct(modes);
        for (mode, twice) in &modes {
            if 0.5 * mode.damped_period() > SLOWEST * time && time > 0.0 {
                return Err(VibrationFreeError::Slow(mode.angular_frequency()));
            }
            let (pole, half) = (mode.pole() * time, 0.5 * mode.damped_period() / time);
            match robustness {
                Robustness::None => zeros.push(Zero::at(pole, *twice)),
                Robustness::DoubleZero => zeros.push(Zero::at(pole, true)),
                Robustness::Band { half_width, residual } => {
                    let factors = Interval::new(1.0 - half_width, 1.0 + half_width);
                    // A change of velocity is set against |dv| / w.
                    let unit = if goal.distance.is_some() { 1.0 } else { pole.norm().recip() };
                    bands.push(Band { pole, factors, residual: residual * unit });
                }
            }
            longest += match robustness {
                Robustness::None => half,
                Robustness::DoubleZero => 2.0 * half,
                Robustness::Band { .. } => 8.0 * half,
            };
        }
        let mut task = Self {
            velocity: scaled(along.velocity(), 1),
            acceleration: scaled(along.acceleration(), 2),
            jerk: scaled(jerk, 3),
            from,
            goal,
            zeros,
            places: bands.iter().flat_map(Band::places).collect(),
            bands,
            plain: vec![],
            longest,
            time,
            length: sign * length,
        };
        let sections = (0..).map_while(|k| s_curve.section(k)).filter(|section| section.length() > 0.0);
        let arcs = sections.map(|section| {
            let jerk = section.polynomial.jerk / (task.length / task.time.powi(3));
            Arc {
                jerk: if jerk == 0.0 { 0.0 } else { task.full(jerk) },
                duration: section.length() / task.time,
            }
        });
        task.plain = arcs.collect();
        Ok((task, s_curve))
    }

    /// Adds places on a grid at which more is left of a band than is tolerated.
    pub(super) fn add_places(&mut self, peaks: Vec<Place>, arcs: &[Arc]) {
        self.places.extend(peaks.into_iter().filter(|place| place.part(arcs) > 1.0 + VISIBLE));
    }

    /// A jerk, exactly at its limit where it is so but for rounding.
    pub(super) fn known(&self, jerk: f64) -> f64 {
        let full = self.full(jerk);
        if (jerk - full).abs() <= 1e-9 * full.abs() { full } else { jerk }
    }

    /// The frequency of the fastest mode, in rad over the duration of the S-curve.
    pub(super) fn fastest(&self) -> f64 {
        let zeros = self.zeros.iter().map(Zero::pole);
        zeros.chain(self.places.iter().map(|place| place.pole)).map(|pole| pole.norm()).fold(0.0, f64::max)
    }

    /// The larger of the limits of the jerk.
    pub(super) fn full_jerk(&self) -> f64 {
        self.jerk.magnitude()
    }

    /// The limit of the jerk with a sign.
    pub(super) fn full(&self, sign: f64) -> f64 {
        if sign > 0.0 { self.jerk.upper } else { self.jerk.lower }
    }
}
