//! The log of the near-step, and the transfer function fitted to it.

use anyhow::Result;
use identify::{Hold, MovingAverage, TransferFunctionFit, TransferFunctionOptions, fit_transfer_function};
use plants::nalgebra::Complex;
use plants::{Encoder, GaussianNoise, Noise, TransferFunction};

use super::drive::Drive;
use super::setup::{HORIZON, LOG_RATE, NEAR_STEP, trapezoid};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// Steps of the simulation to a sample of the log.
const FINE: usize = 16;
/// Standard deviation of what disturbs the measured speed, pulse/s: 2 % of the command, not printed.
pub(super) const NOISE: f64 = 0.02 * NEAR_STEP;
/// Samples of rest ahead of the move, so that the average has a past, not printed.
const REST: usize = 30;
/// Samples of the moving average, not printed.
const AVERAGED: usize = 5;

/// A log of commanded and measured speed, pulse/s, at [`LOG_RATE`].
pub(super) struct Log {
    pub(super) input: Vec<f64>,
    pub(super) output: Vec<f64>,
}

impl Log {
    pub(super) fn points(values: &[f64]) -> Vec<(f64, f64)> {
        values.iter().enumerate().map(|(k, value)| (k as f64 / LOG_RATE, *value)).collect()
    }

    /// Both through the same moving average.
    fn averaged(&self) -> Result<Self> {
        let average = MovingAverage::new(AVERAGED)?;
        Ok(Self { input: average.causal(&self.input)?, output: average.causal(&self.output)? })
    }
}

/// What the encoder at the load shows of the near-step: the whole pulses of every sample as a speed, and noise on the speed.
pub(super) fn log(drive: &Drive, seed: u64) -> Result<Log> {
    let step = 1.0 / (LOG_RATE * FINE as f64);
    let samples = (HORIZON * LOG_RATE).round() as usize;
    let command = trapezoid(NEAR_STEP);
    let start = REST as f64 / LOG_RATE;
    let commands: Vec<f64> = (0..=samples * FINE).map(|k| command((k as f64 + 0.5) * step - start)).collect();
    let integrator = TransferFunction::new(&[], &[Complex::new(0.0, 0.0)], 1.0)?;
    let position = drive.transfer.in_series(&integrator)?.respond(&commands, step)?;
    let encoder = Encoder::new(1.0)?;
    let mut noise = GaussianNoise::new(NOISE, seed)?;
    let counts: Vec<f64> = position.iter().step_by(FINE).map(|p| encoder.quantise(*p)).collect();
    let output = counts.windows(2).map(|pair| (pair[1] - pair[0]) * LOG_RATE + noise.sample()).collect();
    let input = commands.chunks_exact(FINE).map(|chunk| chunk.iter().sum::<f64>() / FINE as f64).collect();
    Ok(Log { input, output })
}

/// Two poles and a zero, fitted to the averaged log; the averaged log too.
pub(super) fn identified(log: &Log) -> Result<(TransferFunctionFit, Log)> {
    let averaged = log.averaged()?;
    let options = TransferFunctionOptions {
        hold: Hold::First,
        noise_lags: 4 * AVERAGED,
        ..TransferFunctionOptions::new(2, 1)
    };
    Ok((fit_transfer_function(&averaged.input, &averaged.output, 1.0 / LOG_RATE, &options)?, averaged))
}
