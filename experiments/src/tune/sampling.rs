//! Brings the samples of a log to one distance.

use super::error::LogFileError;
use super::reader::LogFile;

/// A log sampled evenly.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    /// Time of the first sample, s.
    pub start: f64,
    /// Distance of samples, s.
    pub period: f64,
    /// Commands.
    pub command: Vec<f64>,
    /// Responses.
    pub response: Vec<f64>,
    /// What was done to samples that did not lie evenly; none where they did.
    pub remark: Option<String>,
}

/// The samples of a log between two times, evenly spaced.
///
/// Samples that lie on an even grid to a hundredth of its distance, or to the last digit in which times are printed, are
/// taken as they are. Others are put on a grid of the mean distance by straight lines.
///
/// # Errors
/// Fewer than 64 samples between the two times; a gap of more than four distances.
pub fn evenly(log: &LogFile, from: Option<f64>, to: Option<f64>) -> Result<Sampled, LogFileError> {
    const FEWEST: usize = 64;
    const LARGEST_GAP: f64 = 4.0;
    let first = log.time.partition_point(|t| from.is_some_and(|from| *t < from));
    let end = log.time.partition_point(|t| to.is_none_or(|to| *t <= to)).max(first);
    let part = |values: &[f64]| values.get(first..end).unwrap_or_default().to_vec();
    let (time, command, response) = (part(&log.time), part(&log.command), part(&log.response));
    let (Some(&start), Some(&last)) = (time.first(), time.last()) else {
        return Err(LogFileError::TooShort(0));
    };
    if time.len() < FEWEST {
        return Err(LogFileError::TooShort(time.len()));
    }
    let steps = || time.windows(2).map(|pair| pair[1] - pair[0]);
    let mut sorted: Vec<f64> = steps().collect();
    sorted.sort_by(f64::total_cmp);
    let median = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
    if let Some(at) = steps().position(|step| step > LARGEST_GAP * median) {
        return Err(LogFileError::Gap { from: time[at], to: time[at + 1], period: median });
    }
    let even = (last - start) / (time.len() - 1) as f64;
    let off = time.iter().enumerate().map(|(n, t)| (t - (start + n as f64 * even)).abs()).fold(0.0, f64::max);
    // Coarser digits than the distance itself say nothing of an even grid.
    let digit = last_digit(&time);
    let rounded = if digit < even { digit } else { 0.0 };
    if off <= (0.01 * even).max(1.001 * rounded) {
        return Ok(Sampled { start, period: even, command, response, remark: None });
    }
    let [command, response] = [command, response].map(|values| lines(&time, &values, start, even));
    let (least, most) = (sorted.first().copied().unwrap_or(0.0), sorted.last().copied().unwrap_or(0.0));
    let remark = format!(
        "samples lie {} s to {} s apart: put on a grid of {} s by straight lines",
        crate::number::short(least),
        crate::number::short(most),
        crate::number::short(even)
    );
    Ok(Sampled { start, period: even, command, response, remark: Some(remark) })
}

/// The power of ten of the last digit that any of the first times needs, s.
fn last_digit(time: &[f64]) -> f64 {
    const LOOKED_AT: usize = 200;
    const FINEST: i32 = 12;
    let needed = |t: f64| {
        (0..FINEST).find(|digits| {
            let scaled = t * 10f64.powi(*digits);
            // A few roundings of the scaled time.
            (scaled - scaled.round()).abs() <= 1e-9 * scaled.abs().max(1.0)
        })
    };
    let digits = time.iter().take(LOOKED_AT).map(|t| needed(*t).unwrap_or(FINEST)).max().unwrap_or(FINEST);
    10f64.powi(-digits)
}

/// As many values as samples, on the straight lines between them at `start`, `start + period` and so on.
fn lines(time: &[f64], values: &[f64], start: f64, period: f64) -> Vec<f64> {
    let mut at = 0;
    (0..time.len())
        .map(|n| {
            let t = start + n as f64 * period;
            while at + 2 < time.len() && time[at + 1] <= t {
                at += 1;
            }
            let part = ((t - time[at]) / (time[at + 1] - time[at])).clamp(0.0, 1.0);
            values[at] + part * (values[at + 1] - values[at])
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn log(time: Vec<f64>) -> LogFile {
        let response = time.iter().map(|t| 3.0 * t).collect();
        LogFile {
            command: vec![1.0; time.len()],
            response,
            time,
            names: ["t", "u", "y"].map(str::to_owned),
            irregular: Vec::new(),
            left_out: 0,
        }
    }

    #[test]
    fn even_samples_and_printed_roundings_of_them_stay_as_they_are() {
        let even = evenly(&log((0..100).map(|n| f64::from(n) * 2e-3).collect()), None, None).expect("even");
        assert!((even.period - 2e-3).abs() < 1e-15 && even.remark.is_none());
        // 3 kHz printed in milliseconds: 0, 0.333, 0.667.
        let printed = (0..300).map(|n| (f64::from(n) / 3.0 * 1e3).round() * 1e-6).collect();
        let found = evenly(&log(printed), None, None).expect("even");
        assert!((found.period * 3e3 - 1.0).abs() < 1e-4 && found.remark.is_none(), "{found:?}");
    }

    #[test]
    fn uneven_samples_are_put_on_a_grid() {
        let jitter = |n: u32| f64::from(n) * 1e-3 + 3.1e-4 * f64::from((n * 7) % 5) / 5.0;
        let found = evenly(&log((0..500).map(jitter).collect()), None, None).expect("uneven");
        assert!(found.remark.as_deref().is_some_and(|r| r.contains("straight lines")));
        for (n, y) in found.response.iter().enumerate() {
            // A straight line stays one.
            assert!((y - 3.0 * (found.start + n as f64 * found.period)).abs() < 1e-12);
        }
    }

    #[test]
    fn gaps_and_short_parts_are_refused_with_their_numbers() {
        let mut time: Vec<f64> = (0..200).map(|n| f64::from(n) * 1e-3).collect();
        time.drain(100..106);
        let whole = log(time);
        assert!(
            matches!(evenly(&whole, None, None), Err(LogFileError::Gap { from, .. }) if (from - 0.099).abs() < 1e-12)
        );
        assert!(evenly(&whole, None, Some(0.0991)).is_ok());
        assert!(matches!(evenly(&whole, Some(0.15), None), Err(LogFileError::TooShort(50))));
        assert!(matches!(evenly(&whole, Some(9.0), Some(1.0)), Err(LogFileError::TooShort(0))));
    }
}
