//! The loop of figure 2, continuous and sampled.

use anyhow::Result;
use control::{Feedforward, Pid, PidGains, PidInput, PidState};
use plants::nalgebra::{self, SVector, vector};
use plants::{Clock, Encoder, LinearMotor, Plant, Simulation, ZeroOrderHold, integrate};
use profiles::Profile;

use super::setup::{CONTROL_EVERY, CONTROL_RATE, FEEDFORWARD, MASS, RESOLUTION};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// The position error over time.
pub(super) struct ErrorCourse {
    /// Time in s and error in m.
    pub(super) points: Vec<(f64, f64)>,
}

impl ErrorCourse {
    /// The instant of the largest error, s, and that error with its sign, m.
    pub(super) fn peak(&self) -> (f64, f64) {
        let larger = |a: (f64, f64), b: (f64, f64)| if b.1.abs() > a.1.abs() { b } else { a };
        self.points.iter().copied().fold((0.0, 0.0), larger)
    }

    /// For a picture: error in micrometres, no more than 1500 points and the peak.
    pub(super) fn in_micrometres(&self) -> Vec<(f64, f64)> {
        let peak = self.peak();
        let every = self.points.len().div_ceil(1500);
        let kept = self.points.iter().enumerate().filter(|(k, p)| k % every == 0 || **p == peak);
        kept.map(|(_, (t, e))| (*t, 1e6 * e)).collect()
    }
}

/// Figure 2 in continuous time: `F = FF a_r + K_P e + K_I int e + K_D e'` on `m x'' = F`.
pub(super) fn continuous(
    gains: PidGains,
    reference: &dyn Profile,
    horizon: f64,
    step: f64,
) -> Result<ErrorCourse> {
    let motor = LinearMotor::new(MASS, 0.0)?;
    let closed_loop = |t: f64, x: &SVector<f64, 3>| {
        let r = reference.sample(t);
        let (e, rate) = (r.position - x[0], r.velocity - x[1]);
        let force = FEEDFORWARD * r.acceleration + gains.kp * e + gains.ki * x[2] + gains.kd * rate;
        let motion = motor.derivative(&vector![x[0], x[1]], &vector![force]);
        vector![motion[0], motion[1], e]
    };
    let steps = (horizon / step).round() as u64;
    let mut points = Vec::with_capacity(steps as usize + 1);
    integrate(closed_loop, vector![0.0, 0.0, 0.0], 0.0, step, steps, |t, x| {
        points.push((t, reference.sample(t).position - x[0]));
    })?;
    Ok(ErrorCourse { points })
}

/// The controller of the bench, sampled.
pub(super) struct Sampled {
    pub(super) gains: PidGains,
    /// Gain of the acceleration feedforward, kg.
    pub(super) feedforward: f64,
    /// How far ahead of the sample the feedforward looks, in periods.
    pub(super) preview: f64,
    /// Whether the position comes through the encoder.
    pub(super) encoder: bool,
}

impl Sampled {
    /// As the paper has it.
    pub(super) fn of(gains: PidGains, encoder: bool) -> Self {
        Self { gains, feedforward: FEEDFORWARD, preview: 0.0, encoder }
    }

    /// The position error, or `None` where the loop is unstable.
    pub(super) fn run(&self, reference: &dyn Profile, horizon: f64) -> Result<Option<ErrorCourse>> {
        let motor = LinearMotor::new(MASS, 0.0)?;
        let scale = Encoder::new(RESOLUTION)?;
        let clock = Clock::from_frequency(CONTROL_RATE * u64::from(CONTROL_EVERY))?;
        let simulation = Simulation::new(clock, clock.ticks(horizon)?).control_every(CONTROL_EVERY)?;
        let period = simulation.control_period();
        let pid = Pid::new(self.gains, period)?;
        let feedforward = Feedforward::rigid(self.feedforward, 0.0)?;
        let outcome = simulation.run(
            &mut ZeroOrderHold::new(motor),
            vector![0.0, 0.0],
            &mut PidState::new(),
            |memory, tick| {
                let measurement = if self.encoder { scale.quantise(tick.state[0]) } else { tick.state[0] };
                let ahead = reference.sample(tick.time + self.preview * period);
                let input = PidInput {
                    feedforward: feedforward.force(&ahead),
                    ..PidInput::new(reference.sample(tick.time).position, measurement)
                };
                vector![pid.update(memory, input).output]
            },
            [("error", "m")],
            |_, probe| [reference.sample(probe.time).position - probe.state[0]],
        )?;
        if outcome.halt().is_some() {
            return Ok(None);
        }
        let recording = outcome.completed()?;
        let points =
            recording.time().iter().copied().zip(recording.column("error")?.iter().copied()).collect();
        Ok(Some(ErrorCourse { points }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::papers::acceleration_curves::setup::{Law, RAMP_HORIZON, STEP, WHOLE_MOVE};

    /// The continuous error in closed form: `m e'' = (m - FF) a - K_P e - K_I int e - K_D e'` is linear, so the error
    /// of a ramp is a sum over its three poles of `|response|` of the ramp at that pole.
    #[test]
    fn the_continuous_error_is_the_response_of_its_poles() {
        use profiles::Complex;
        let PidGains { kp, ki, kd } = WHOLE_MOVE.gains;
        let ramp = Law::SCurve.ramp().expect("ramp");
        let end = ramp.duration();
        let course = continuous(WHOLE_MOVE.gains, &*ramp, end, STEP).expect("course");
        let model = plants::StateSpace::<3, 1, 1>::new(
            nalgebra::matrix![0.0, 1.0, 0.0; 0.0, 0.0, 1.0; -ki / MASS, -kp / MASS, -kd / MASS],
            nalgebra::vector![0.0, 0.0, 1.0],
            nalgebra::matrix![0.0, 1.0, 0.0],
            nalgebra::matrix![0.0],
        )
        .expect("model");
        let poles = model.poles().expect("poles");
        // e(T) = (1 - FF/m) sum of p / prod (p - q) times response(p): residues of s / (s^3 + ...).
        let mut error = Complex::new(0.0, 0.0);
        for (k, p) in poles.iter().enumerate() {
            let others = poles.iter().enumerate().filter(|(j, _)| *j != k);
            let product = others.fold(Complex::new(1.0, 0.0), |product, (_, q)| product * (p - q));
            error += p / product * ramp.response(*p);
        }
        let closed = (1.0 - FEEDFORWARD / MASS) * error.re;
        let simulated = course.points.last().expect("points").1;
        assert!((closed - simulated).abs() < 1e-6 * closed.abs(), "{closed} and {simulated}");
    }

    /// The marks of the pictures are the published values of the table.
    #[test]
    fn what_is_marked_is_what_is_published() {
        let text = crate::papers::acceleration_curves::EXPERIMENT.expected;
        let rows = crate::expected::parse(text).expect("rows");
        let published = |metric: String| {
            let row = rows.iter().find(|row| row.metric == metric);
            row.and_then(|row| row.published.as_ref()).and_then(crate::row::Value::number)
        };
        for law in Law::COMPARED {
            let (time, peak) = law.printed().expect("printed");
            assert_eq!(published(format!("ramp-time/{}", law.id())), Some(time));
            assert_eq!(published(format!("peak-error/exchanged-40mm/{}", law.id())), Some(peak));
        }
    }

    #[test]
    fn the_paper_s_ramp_times_are_their_closed_forms() {
        let pi = std::f64::consts::PI;
        for (law, time) in [(Law::SCurve, 0.07), (Law::SnapLimited, 0.086), (Law::Cosine, pi * 0.2 / 8.0)] {
            assert!((law.ramp().expect("ramp").duration() - time).abs() < 1e-9);
        }
    }

    #[test]
    fn a_fine_step_of_the_continuous_loop_changes_nothing() {
        let ramp = Law::Cosine.ramp().expect("ramp");
        let peak = |step| continuous(WHOLE_MOVE.gains, &*ramp, RAMP_HORIZON, step).expect("course").peak().1;
        assert!((peak(STEP) / peak(0.25 * STEP) - 1.0).abs() < 1e-8);
    }
}
