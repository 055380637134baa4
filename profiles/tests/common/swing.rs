//! A motion that turns back.

use std::f64::consts::PI;

use profiles::{Complex, Extrema, Profile, Sample, Section, Sectioned};

/// A profile that goes there and back along half waves of a sine, `distance (1 - cos(pi t)) / 2 + slope t`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Swing {
    pub(crate) distance: f64,
    pub(crate) slope: f64,
    pub(crate) half_waves: usize,
}

impl Profile for Swing {
    fn duration(&self) -> f64 {
        self.half_waves as f64
    }
    fn sample(&self, t: f64) -> Sample {
        self.section_at(t).map_or(self.after(), |section| section.at(t))
    }
    fn extrema(&self) -> Extrema {
        let all = (0..).map_while(|k| self.section(k)).map(|s| {
            let w = s.angular_frequency;
            Extrema::of_motion(&s.polynomial, s.amplitude, w, s.phase, 0.0, s.reach)
        });
        all.reduce(Extrema::including).expect("sections")
    }
    fn response(&self, _: Complex<f64>) -> Complex<f64> {
        unreachable!("not asked for")
    }
}

impl Sectioned for Swing {
    const HARMONIC: bool = true;
    fn section(&self, index: usize) -> Option<Section> {
        let start = index as f64;
        (index < self.half_waves).then(|| Section {
            start,
            end: start + 1.0,
            anchor: start,
            reach: 1.0,
            polynomial: Sample::cruising(0.5 * self.distance + self.slope * start, self.slope),
            amplitude: 0.5 * self.distance,
            angular_frequency: PI,
            phase: PI * (start - 0.5),
        })
    }
    fn before(&self) -> Sample {
        Sample::default()
    }
    fn after(&self) -> Sample {
        let end = if self.half_waves.is_multiple_of(2) { 0.0 } else { self.distance };
        Sample::at_rest(end + self.slope * self.half_waves as f64)
    }
}
