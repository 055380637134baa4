//! An axis to close loops around: x'' = -a x' - b x + k u + d, stepped so finely that its error does not count.
#![allow(dead_code, reason = "not every test uses all of it")]

use control::{AxisModel, SlidingModeInput};
use profiles::Sample;

/// Position and velocity of an axis.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Axis {
    pub(crate) position: f64,
    pub(crate) velocity: f64,
}

impl Axis {
    /// Goes on for `period` with a constant input and load: four or more Runge-Kutta steps of fourth order, in each of which
    /// no mode goes further than a hundredth, which leaves 1e-12.
    pub(crate) fn advance(&mut self, model: &AxisModel, input: f64, load: f64, period: f64) {
        let acceleration =
            |x: f64, v: f64| -model.damping() * v - model.stiffness() * x + model.gain() * input + load;
        let fastest = model.damping() + model.stiffness().sqrt();
        let steps = (100.0 * fastest * period).ceil().max(4.0);
        let h = period / steps;
        for _ in 0..steps as u32 {
            let (x, v) = (self.position, self.velocity);
            let k1 = acceleration(x, v);
            let (x2, v2) = (x + 0.5 * h * v, v + 0.5 * h * k1);
            let k2 = acceleration(x2, v2);
            let (x3, v3) = (x + 0.5 * h * v2, v + 0.5 * h * k2);
            let k3 = acceleration(x3, v3);
            let (x4, v4) = (x + h * v3, v + h * k3);
            let k4 = acceleration(x4, v4);
            self.position += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
            self.velocity += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        }
    }

    /// What a controller is told.
    pub(crate) fn input(&self, reference: &Sample) -> SlidingModeInput {
        SlidingModeInput::new(reference, self.position, self.velocity)
    }
}

/// The axis of the paper: a = 10, b = 1, k = 1.
pub(crate) fn model() -> AxisModel {
    AxisModel::new(10.0, 1.0, 1.0).expect("valid")
}

/// The reference sin t.
pub(crate) fn sine(t: f64) -> Sample {
    let (sine, cosine) = t.sin_cos();
    Sample { position: sine, velocity: cosine, acceleration: -sine, jerk: -cosine, snap: sine }
}
