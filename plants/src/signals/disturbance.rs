//! What is added to an input on its way into the plant.

use profiles::Real;

use super::{GaussianNoise, Noise};
use crate::error::ModelError;

/// A disturbance of one input, in the unit of that input.
///
/// The simulation holds it over every base tick at its value in the middle of the tick.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Disturbance {
    kind: Kind,
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
enum Kind {
    #[default]
    None,
    Step {
        time: f64,
        size: f64,
    },
    Sine {
        amplitude: f64,
        angular_frequency: f64,
        phase: f64,
    },
    Gaussian {
        standard_deviation: f64,
        seed: u64,
    },
}

impl Disturbance {
    /// No disturbance.
    #[must_use]
    pub fn none() -> Self {
        Self::default()
    }

    /// `size` from `time` in s on, zero before.
    ///
    /// # Errors
    /// A time or size that is not finite.
    pub fn step(time: f64, size: f64) -> Result<Self, ModelError> {
        finite("the time of the step in s", time)?;
        finite("the size of the step", size)?;
        Ok(Self { kind: Kind::Step { time, size } })
    }

    /// `amplitude sin(angular_frequency t + phase)`, in rad/s and rad.
    ///
    /// # Errors
    /// A number that is not finite.
    pub fn sine(amplitude: f64, angular_frequency: f64, phase: f64) -> Result<Self, ModelError> {
        finite("the amplitude", amplitude)?;
        finite("the angular frequency in rad/s", angular_frequency)?;
        finite("the phase in rad", phase)?;
        Ok(Self { kind: Kind::Sine { amplitude, angular_frequency, phase } })
    }

    /// A new independent normal number every base tick.
    ///
    /// # Errors
    /// A standard deviation that is negative or not finite.
    pub fn gaussian(standard_deviation: f64, seed: u64) -> Result<Self, ModelError> {
        GaussianNoise::new(standard_deviation, seed)?;
        Ok(Self { kind: Kind::Gaussian { standard_deviation, seed } })
    }

    pub(crate) fn is_none(&self) -> bool {
        self.kind == Kind::None
    }

    pub(crate) fn source(&self) -> DisturbanceSource {
        let noise = match self.kind {
            Kind::Gaussian { standard_deviation, seed } => GaussianNoise::new(standard_deviation, seed).ok(),
            _ => None,
        };
        DisturbanceSource { kind: self.kind, noise }
    }
}

/// A disturbance in the course of a run.
pub(crate) struct DisturbanceSource {
    kind: Kind,
    noise: Option<GaussianNoise>,
}

impl DisturbanceSource {
    /// The value at `time` in s, to be asked for once a tick.
    pub(crate) fn value(&mut self, time: f64) -> f64 {
        match self.kind {
            Kind::None => 0.0,
            Kind::Step { time: start, size } => {
                if time >= start {
                    size
                } else {
                    0.0
                }
            }
            Kind::Sine { amplitude, angular_frequency, phase } => {
                amplitude * Real::sin(angular_frequency * time + phase)
            }
            Kind::Gaussian { .. } => self.noise.as_mut().map_or(0.0, Noise::sample),
        }
    }
}

fn finite(parameter: &'static str, value: f64) -> Result<(), ModelError> {
    if value.is_finite() { Ok(()) } else { Err(ModelError::Parameter { parameter, range: "finite", value }) }
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "zero, a size and a repeated sequence are exact")]
mod tests {
    use super::*;

    #[test]
    fn values_by_hand() {
        let values = |disturbance: Result<Disturbance, ModelError>, times: [f64; 3]| {
            let mut source = disturbance.expect("valid").source();
            times.map(|t| source.value(t))
        };
        assert_eq!(values(Ok(Disturbance::none()), [0.0, 1.0, 2.0]), [0.0; 3]);
        assert_eq!(values(Disturbance::step(1.0, -4.0), [0.9, 1.0, 2.0]), [0.0, -4.0, -4.0]);
        let sine = values(Disturbance::sine(2.0, 3.0, 0.5), [0.0, 0.25, 1.0]);
        for (value, angle) in sine.into_iter().zip([0.5_f64, 1.25, 3.5]) {
            assert!((value - 2.0 * angle.sin()).abs() < 1e-15);
        }
        let noise = Disturbance::gaussian(0.1, 5);
        assert_eq!(values(noise, [0.0, 1.0, 2.0]), values(noise, [3.0, 4.0, 5.0]));
    }

    #[test]
    fn bad_numbers_are_errors() {
        assert!(Disturbance::step(f64::NAN, 1.0).is_err());
        assert!(Disturbance::sine(1.0, f64::INFINITY, 0.0).is_err());
        assert!(Disturbance::gaussian(-1.0, 0).is_err());
    }
}
