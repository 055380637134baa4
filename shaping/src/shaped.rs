//! A profile through a train.

use core::iter::successors;

use profiles::{Complex, Extrema, Profile, Real, Sample, Section, Sectioned};

use crate::train::ImpulseTrain;

/// A profile convolved with a train: the sum of copies of it, each by its amplitude and at its time.
///
/// It is a [`Profile`] again, and exact: its response is the product of both responses, its extrema are found section by
/// section, and a move ends where it would without the train. It is [`Sectioned`] too, a section for every time between
/// two instants at which a copy goes from one section to the next: cursors and pulse trains run it like a motion law,
/// and another train can shape it again. The profile is taken by value or by reference.
///
/// A start or stop speed is shared out like everything else: the motion jumps to the first impulse's share of it. A
/// change of velocity counts its position from the start, at zero as the unshaped one does.
///
/// ```
/// use profiles::{Limits, Mode, Profile, SCurve, residual_vibration};
/// use shaping::{DelayFilter, Shaped};
///
/// let mode = Mode::from_hz(33.0, 0.02)?;
/// let profile = SCurve::rest_to_rest(0.04, &Limits::new(0.2, 4.0, 200.0)?)?;
/// let shaped = Shaped::new(profile, *DelayFilter::zvd(mode)?.train());
/// assert!(residual_vibration(&profile, mode) > 50e-6); // m
/// assert!(residual_vibration(&shaped, mode) < 1e-16);
/// assert_eq!(shaped.sample(shaped.duration()).position, 0.04);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shaped<P, const N: usize> {
    profile: P,
    train: ImpulseTrain<N>,
}

impl<P: Sectioned, const N: usize> Shaped<P, N> {
    /// `profile` through `train`.
    #[must_use]
    pub fn new(profile: P, train: ImpulseTrain<N>) -> Self {
        Self { profile, train }
    }

    /// The profile without the train.
    #[must_use]
    pub fn profile(&self) -> &P {
        &self.profile
    }

    /// The train.
    #[must_use]
    pub fn train(&self) -> &ImpulseTrain<N> {
        &self.train
    }

    /// Every instant at which a copy starts or goes from one section to the next, s, in no order.
    fn boundaries(&self) -> impl Iterator<Item = f64> + '_ {
        self.train.impulses().iter().flat_map(|impulse| {
            let sections = successors(self.profile.section_at(0.0), |last| self.profile.section_at(last.end));
            sections.map(|section| impulse.time + section.end).chain([impulse.time])
        })
    }

    /// What the position would be at the start of a ramp if the copies were only added up, m, with the other sign.
    fn lead(&self) -> f64 {
        self.profile.before().velocity * self.train.mean_delay()
    }

    /// The section between two neighbouring boundaries, s.
    ///
    /// Like those of a law it is expanded about its slower end: its start in the first half of the motion, its end in
    /// the second.
    fn merged(&self, start: f64, end: f64) -> Section {
        let reach = end - start;
        let middle = 0.5 * (start + end);
        let (anchor, reach) = if middle < 0.5 * self.duration() { (start, reach) } else { (end, -reach) };
        let mut sum = Sample::at_rest(self.lead());
        // The sines have one frequency: their sum is one sine, of the amplitude and the phase of a sum of phasors.
        let (mut in_phase, mut ahead, mut w) = (0.0, 0.0, 0.0);
        for impulse in self.train.impulses() {
            let (inside, local) = (middle - impulse.time, anchor - impulse.time);
            let motion = if inside < 0.0 {
                self.profile.before().coasted(local)
            } else if let Some(section) = self.profile.section_at(inside) {
                let x = section.local(local);
                if section.amplitude != 0.0 {
                    w = section.angular_frequency;
                    let (sine, cosine) = Real::sin_cos(w * x + section.phase);
                    in_phase += impulse.amplitude * section.amplitude * cosine;
                    ahead += impulse.amplitude * section.amplitude * sine;
                }
                section.polynomial.advanced(x)
            } else {
                self.profile.after().coasted(local - self.profile.duration())
            };
            sum = added(sum, impulse.amplitude, motion);
        }
        Section {
            start,
            end,
            anchor,
            reach,
            polynomial: sum,
            amplitude: profiles::complex::norm(Complex::new(in_phase, ahead)),
            angular_frequency: w,
            phase: Real::atan2(ahead, in_phase),
        }
    }
}

fn added(sum: Sample, amplitude: f64, motion: Sample) -> Sample {
    Sample {
        position: sum.position + amplitude * motion.position,
        velocity: sum.velocity + amplitude * motion.velocity,
        acceleration: sum.acceleration + amplitude * motion.acceleration,
        jerk: sum.jerk + amplitude * motion.jerk,
        snap: sum.snap + amplitude * motion.snap,
    }
}

impl<P: Sectioned, const N: usize> Profile for Shaped<P, N> {
    fn duration(&self) -> f64 {
        self.profile.duration() + self.train.duration()
    }

    fn sample(&self, t: f64) -> Sample {
        if t >= self.duration() {
            return self.after().coasted(t - self.duration());
        }
        if t >= 0.0 {
            let copies = self.train.impulses().iter();
            copies.fold(Sample::at_rest(self.lead()), |sum, impulse| {
                added(sum, impulse.amplitude, self.profile.sample(t - impulse.time))
            })
        } else {
            self.before().coasted(if t < 0.0 { t } else { 0.0 })
        }
    }

    fn extrema(&self) -> Extrema {
        let sections = successors(self.section_at(0.0), |last| self.section_at(last.end));
        sections.fold(Extrema::at(&self.sample(0.0)), |extrema, section| {
            let (from, to) = section.local_ends();
            let (w, phase) = (section.angular_frequency, section.phase);
            let range = Extrema::of_motion(&section.polynomial, section.amplitude, w, phase, from, to);
            // Two boundaries that are one but for rounding leave an instant between them.
            extrema.including(range).including(Extrema::at(&self.sample(section.end)))
        })
    }

    fn response(&self, p: Complex<f64>) -> Complex<f64> {
        self.profile.response(p) * self.train.response(p)
    }
}

impl<P: Sectioned, const N: usize> Sectioned for Shaped<P, N> {
    const HARMONIC: bool = P::HARMONIC;

    fn section(&self, index: usize) -> Option<Section> {
        successors(self.section_at(0.0), |last| self.section_at(last.end)).nth(index)
    }

    fn section_at(&self, t: f64) -> Option<Section> {
        let (mut start, mut end) = (0.0, None);
        for instant in self.boundaries() {
            if instant <= t {
                start = Real::max(start, instant);
            } else if instant > 0.0 && end.is_none_or(|end| instant < end) {
                end = Some(instant);
            }
        }
        end.map(|end| self.merged(start, end))
    }

    fn before(&self) -> Sample {
        self.profile.before()
    }

    fn after(&self) -> Sample {
        let Sample { position, velocity, .. } = self.profile.after();
        // What every copy goes on to cover until the last one ends.
        let on = velocity * (self.train.duration() - self.train.mean_delay());
        Sample::cruising(position + on + self.lead(), velocity)
    }
}
