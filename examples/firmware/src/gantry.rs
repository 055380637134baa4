//! Three axes along a circle in space: sliding mode with an observer of the load, coupled by their contour error.

use control::{
    AxisModel, CrossCoupling, DisturbanceInput, DisturbanceObserver, DisturbanceObserverState, PathFrame,
    ReachingLaw, SlidingMode, SlidingModeInput, SlidingModeState, SlidingSurface, SuperTwisting,
    SuperTwistingState,
};
use profiles::{Real, Sample};

use crate::board::Registers;

/// Control period, s.
const PERIOD: f32 = 1e-3;

/// What drives an axis to its surface.
enum Law {
    Reaching(SlidingMode<f32>, [SlidingModeState<f32>; 3]),
    Twisting(SuperTwisting<f32>, [SuperTwistingState<f32>; 3]),
}

/// Three axes: their law, what observes them, and what couples them.
pub struct Gantry {
    law: Law,
    observer: DisturbanceObserver<f32>,
    observed: [DisturbanceObserverState<f32>; 3],
    coupling: CrossCoupling<3, f32>,
}

impl Gantry {
    /// With the law that the host asks for.
    pub fn new(twisting: bool) -> Option<Self> {
        let model = AxisModel::new(10.0, 1.0, 1.0).ok()?;
        let law = if twisting {
            let surface = SlidingSurface::linear(60.0).ok()?;
            let law = SuperTwisting::for_load_rate(surface, 200.0, model, PERIOD).ok()?;
            Law::Twisting(law, [SuperTwistingState::new(); 3])
        } else {
            let surface = SlidingSurface::terminal(10.0, 1.0, 9, 5).ok()?;
            let reaching =
                ReachingLaw::improved_double_power(20.0, 20.0, 200.0, 1.0 / 3.0, 1.0 / 3.0).ok()?;
            let law = SlidingMode::new(surface, reaching, model, PERIOD).ok()?;
            let law = law.with_integral_compensation(20.0).and_then(|l| l.with_output_limits(-60.0, 60.0));
            Law::Reaching(law.ok()?, [SlidingModeState::new(); 3])
        };
        let observer = DisturbanceObserver::new(model, 200.0, PERIOD).ok()?;
        let coupling = CrossCoupling::uniform(0.5).ok()?;
        Some(Self { law, observer, observed: [DisturbanceObserverState::new(); 3], coupling })
    }

    /// One control tick: references and measured positions in, torques out.
    fn tick(&mut self, references: [Sample<f32>; 3], positions: [f32; 3], torques: [f32; 3]) -> [f32; 3] {
        let mut inputs = [SlidingModeInput::<f32>::default(); 3];
        let measured = positions.iter().zip(torques).zip(&mut self.observed).zip(references);
        for (input, (((position, realised), state), reference)) in inputs.iter_mut().zip(measured) {
            let estimate = self.observer.update(state, DisturbanceInput { position: *position, realised });
            let known = SlidingModeInput::new(&reference, estimate.position, estimate.velocity);
            *input = SlidingModeInput { load: estimate.load, ..known };
        }
        let (velocity, acceleration) = (references.map(|r| r.velocity), references.map(|r| r.acceleration));
        let path = PathFrame::osculating(velocity, acceleration).unwrap_or(None);
        let (errors, rates) = (inputs.map(|i| i.error), inputs.map(|i| i.error_rate));
        let coupled = self.coupling.couple(errors, rates, path.as_ref());
        let mut wanted = [0.0; 3];
        let told = inputs.iter().zip(coupled.errors).zip(coupled.rates);
        let told = told.map(|((input, error), rate)| input.with_error(error, rate)).zip(&mut wanted);
        match &mut self.law {
            Law::Reaching(law, states) => {
                told.zip(states)
                    .for_each(|((input, torque), state)| *torque = law.update(state, input).output);
            }
            Law::Twisting(law, states) => {
                told.zip(states)
                    .for_each(|((input, torque), state)| *torque = law.update(state, input).output);
            }
        }
        wanted
    }

    /// Once around a circle that leans in space.
    pub fn circle(&mut self, registers: &mut Registers) {
        let mut torques = [0.0; 3];
        for step in 0..1000_u32 {
            let (sine, cosine) = Real::sin_cos(step as f32 * 6.283_185_5e-3);
            let along = |a: f32, b: f32| Sample {
                position: a * sine + b * cosine,
                velocity: 6.283_185_5 * (a * cosine - b * sine),
                acceleration: -39.478_42 * (a * sine + b * cosine),
                ..Sample::default()
            };
            let references = [along(0.1, 0.0), along(0.0, 0.1), along(0.02, 0.03)];
            torques = self.tick(references, registers.gantry(), torques);
            registers.set_torques(torques);
        }
    }
}
