//! A free decay of two modes, logged by an encoder: prints the modes with their standard deviations, and what the
//! logarithmic decrement makes of the same log.

use identify::{LogarithmicDecrement, Peaks, Signal, SinusoidOptions, fit_damped_sinusoids};
use plants::{Encoder, GaussianNoise, Noise};
use profiles::Mode;

const PERIOD: f64 = 1e-3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let truth = [(Mode::from_hz(38.5, 0.035)?, 1.0), (Mode::from_hz(92.3, 0.018)?, 0.6)];
    let scale = Encoder::new(1e-3)?;
    let mut noise = GaussianNoise::new(0.01, 1)?;
    let mut position = |t: f64| {
        let ideal = truth.iter().map(|(mode, amplitude)| {
            let pole = mode.pole();
            amplitude * (pole.re * t).exp() * (pole.im * t).cos()
        });
        scale.quantise(ideal.sum::<f64>() + noise.sample())
    };
    let log: Vec<f64> = (0..1000).map(|n| position(f64::from(n) * PERIOD)).collect();

    let decay = fit_damped_sinusoids(&log, PERIOD, &SinusoidOptions::default())?;
    println!("order {}, fit {:.2} %, noise {:.4}", decay.order(), decay.fit, decay.noise);
    for mode in &decay.modes {
        println!(
            "  {:8.3} +- {:.3} rad/s, damping ratio {:.5} +- {:.5}, amplitude {:.3}",
            mode.mode.angular_frequency(),
            mode.frequency_deviation,
            mode.mode.damping_ratio(),
            mode.damping_deviation,
            mode.amplitude
        );
    }

    let peaks = Peaks::find(&Signal::sampled(&log, PERIOD)?, 0.1)?;
    match LogarithmicDecrement::over_cycles(&peaks.maxima, decay.offset, 2) {
        Ok(decrement) => println!(
            "by peaks: {:.3} rad/s, damping ratio {:.5}",
            decrement.angular_frequency(),
            decrement.damping_ratio()
        ),
        Err(reason) => println!("by peaks: {reason}"),
    }
    Ok(())
}
