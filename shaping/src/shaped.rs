//! A profile through a train.

use profiles::{Complex, Extrema, Profile, Real, Sample, Section, Sectioned};

use crate::train::ImpulseTrain;

/// A profile convolved with a train: the sum of copies of it, each by its amplitude and at its time.
///
/// It is a [`Profile`] again, and exact: its response is the product of both responses, its extrema are found section by
/// section, and a move ends where it would without the train. The profile is taken by value or by reference.
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

    fn sections(&self) -> impl Iterator<Item = Section> + '_ {
        (0..).map_while(|k| self.profile.section(k))
    }

    /// The first instant after `t` at which a copy goes from one section to the next, s.
    fn boundary_after(&self, t: f64) -> Option<f64> {
        let copies = self.train.impulses().iter();
        let instants = copies.flat_map(|impulse| {
            let ends = self.sections().map(move |section| impulse.time + section.end);
            ends.chain([impulse.time])
        });
        instants.filter(|instant| *instant > t).reduce(f64::min)
    }

    /// The range from `start` to `end`, two neighbouring boundaries, s.
    fn range(&self, start: f64, end: f64) -> Extrema {
        let middle = 0.5 * (start + end);
        let mut sum = Sample::default();
        // The sines have one frequency: their sum is one sine, of the amplitude and the phase of a sum of phasors.
        let (mut in_phase, mut ahead, mut w) = (0.0, 0.0, 0.0);
        for impulse in self.train.impulses() {
            let local = middle - impulse.time;
            let from = start - impulse.time;
            let (before, after) = (self.profile.before(), self.profile.after());
            let motion = if local < 0.0 {
                before.advanced(from)
            } else if let Some(section) = self.sections().find(|section| local < section.end) {
                let x = from - section.anchor;
                if section.amplitude != 0.0 {
                    w = section.angular_frequency;
                    let (sine, cosine) = Real::sin_cos(w * x);
                    in_phase += impulse.amplitude * section.amplitude * cosine;
                    ahead += impulse.amplitude * section.amplitude * sine;
                }
                section.polynomial.advanced(x)
            } else {
                after.advanced(from - self.profile.duration())
            };
            sum = added(sum, impulse.amplitude, motion);
        }
        let amplitude = profiles::complex::norm(Complex::new(in_phase, ahead));
        let phase = Real::atan2(ahead, in_phase);
        Extrema::of_motion(&sum, amplitude, w, phase, 0.0, end - start)
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
        let after = self.profile.after();
        if t >= self.duration() && after.velocity == 0.0 {
            return after;
        }
        let copies = self.train.impulses().iter();
        copies.fold(Sample::default(), |sum, impulse| {
            added(sum, impulse.amplitude, self.profile.sample(t - impulse.time))
        })
    }

    fn extrema(&self) -> Extrema {
        let mut extrema = Extrema::at(&self.sample(0.0));
        let mut start = 0.0;
        while let Some(end) = self.boundary_after(start) {
            // Two boundaries that are one but for rounding leave an instant between them.
            extrema = extrema.including(self.range(start, end)).including(Extrema::at(&self.sample(end)));
            start = end;
        }
        extrema
    }

    fn response(&self, p: Complex<f64>) -> Complex<f64> {
        self.profile.response(p) * self.train.response(p)
    }
}
