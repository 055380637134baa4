//! A belt drive from its counts: the motor runs up to 30 000 pulse/s within 1 ms, both encoders are read at 75 Hz, the
//! same moving average smooths both speeds. Prints the transfer function with its standard deviations, and the peak of
//! the spectrum of the load's acceleration.

use identify::{
    Hold, MovingAverage, SpectrumOptions, TransferFunctionOptions, amplitude_spectrum, fit_transfer_function,
};
use plants::{GaussianNoise, Noise};
use profiles::{Interval, Mode};

const RATE: f64 = 75.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // 1.15 w^2 (0.092 s + 1) / (s^2 + 2 z w s + w^2)
    let mode = Mode::new(7.55, 0.2)?;
    let (pole, w, z) = (mode.pole(), mode.angular_frequency(), mode.damping_ratio());
    let position = |t: f64| {
        let (decay, (sin, cos)) = ((pole.re * t).exp(), (pole.im * t).sin_cos());
        let step = 1.0 - decay * (cos - pole.re / pole.im * sin);
        let ramp = t - 2.0 * z / w + decay * (2.0 * z / w * cos + (2.0 * z * z - 1.0) / pole.im * sin);
        if t > 0.0 { 1.15 * (ramp + 0.092 * step) } else { 0.0 }
    };
    let mut jitter = GaussianNoise::new(2.0, 1)?;
    let mut speeds = |position: &dyn Fn(f64) -> f64| -> Vec<f64> {
        let time = |n: i32| f64::from(n) / RATE - 0.4 - 0.5e-3;
        let counts: Vec<f64> =
            (0..=450).map(|n| (30_000.0 * position(time(n)) + jitter.sample()).round()).collect();
        counts.windows(2).map(|pair| (pair[1] - pair[0]) * RATE).collect()
    };
    let (motor, load) = (speeds(&|t| t.max(0.0)), speeds(&position));

    let average = MovingAverage::new(5)?;
    let (input, output) = (average.zero_phase(&motor)?, average.zero_phase(&load)?);
    let options =
        TransferFunctionOptions { hold: Hold::First, noise_lags: 20, ..TransferFunctionOptions::new(2, 1) };
    let found = fit_transfer_function(&input, &output, 1.0 / RATE, &options)?;
    println!("fit {:.2} %, residual {:.1} pulse/s", found.fit, found.residual_deviation);
    println!("gain {:.4} +- {:.4}", found.dc_gain, found.dc_gain_deviation);
    for pole in found.poles.iter().filter(|pole| pole.imaginary >= 0.0) {
        println!(
            "pole {:.4} +- {:.4} rad/s, damping ratio {:.4} +- {:.4}",
            pole.angular_frequency(),
            pole.frequency_deviation,
            pole.damping_ratio(),
            pole.damping_deviation
        );
    }
    for zero in &found.zeros {
        println!("zero {:.3} +- {:.3} rad/s: lead {:.4} s", zero.real, zero.real_deviation, -1.0 / zero.real);
    }

    let acceleration: Vec<f64> = output.windows(2).map(|pair| (pair[1] - pair[0]) * RATE).collect();
    let spectrum = amplitude_spectrum(&acceleration, 1.0 / RATE, &SpectrumOptions::default())?;
    let peak = spectrum.peak(Interval { lower: 3.0, upper: 20.0 })?;
    println!("peak of the acceleration at {:.3} Hz, {:.0} pulse/s^2", peak.hz(), peak.amplitude);
    Ok(())
}
