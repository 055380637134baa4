//! Writes `experiments/data/example-log.csv`, the log of the README's walk-through: an axis is sent 0.1 m forth and back
//! by S-curves with a high jerk, and the load on it is read by an encoder.
//!
//! The load swings at 8 Hz with a damping ratio of 0.03, and the frame under the axis adds a part at 18 Hz with 0.02.

use std::fmt::Write;
use std::path::Path;

use plants::{Encoder, GaussianNoise, Noise, TransferFunction};
use profiles::{Limits, Mode, Profile, SCurve};

/// Time between samples, s.
const PERIOD: f64 = 2e-3;
/// Samples: four seconds.
const SAMPLES: u32 = 2000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data").join("example-log.csv");
    std::fs::write(&path, log()?)?;
    println!("{}", path.display());
    Ok(())
}

fn log() -> Result<String, Box<dyn std::error::Error>> {
    let forth = SCurve::rest_to_rest(0.1, &Limits::new(0.5, 5.0, 5000.0)?)?;
    let command = |t: f64| forth.sample(t - 0.1).position - forth.sample(t - 2.1).position;
    let mut load = [(8.0, 0.03, 0.7), (18.0, 0.02, 0.3)]
        .into_iter()
        .map(|(hz, damping, part)| {
            let mode = Mode::from_hz(hz, damping)?;
            let (w, z) = (mode.angular_frequency(), mode.damping_ratio());
            Ok(TransferFunction::from_coefficients(&[part * w * w], &[1.0, 2.0 * z * w, w * w])?
                .held(PERIOD)?)
        })
        .collect::<Result<Vec<_>, Box<dyn std::error::Error>>>()?;
    let (encoder, mut noise) = (Encoder::new(5e-6)?, GaussianNoise::new(1e-5, 1)?);

    let mut text = String::from(
        "# An axis moves 0.1 m forth and back; the load is read by an encoder of 5 um.\n\
         # Synthetic: written by experiments/examples/example_log.rs.\n\
         time [s],command [m],response [m]\n",
    );
    for n in 0..SAMPLES {
        let t = f64::from(n) * PERIOD;
        let position = load.iter_mut().map(|part| part.update(command(t))).sum::<f64>();
        let read = encoder.quantise(position + noise.sample());
        writeln!(text, "{t:.3},{:.6},{read:.6}", command(t))?;
    }
    Ok(text)
}
