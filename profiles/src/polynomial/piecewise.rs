//! The one polynomial profile.

use num_complex::Complex;

use super::{extrema, response};
use crate::error::PlanError;
use crate::profile::{Extrema, Profile};
use crate::quantities::Sample;
use crate::section::{Section, Sectioned, local_time};
use crate::stretch::Stretch;

/// A profile of at most `N` sections with constant snap in each.
///
/// Each section is a Taylor polynomial about an anchor of its own. In the half of a motion that speeds up the
/// anchors stand where a section starts, in the half that slows down where it ends, so that both ends of the
/// motion are exact and a symmetric plan gives a symmetric motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piecewise<const N: usize> {
    /// End of each section, s; never decreasing, sections of no length allowed.
    pub(crate) ends: [f64; N],
    /// Time about which each section is expanded, s.
    pub(crate) anchors: [f64; N],
    /// Planned length of each section, s, negative where the anchor is its end.
    pub(crate) reaches: [f64; N],
    /// Motion of each section at its anchor.
    pub(crate) motions: [Sample; N],
    /// The motion before the start, at the start.
    pub(crate) before: Sample,
    /// The motion after the end, at the end.
    pub(crate) after: Sample,
    pub(crate) duration: f64,
}

impl<const N: usize> Piecewise<N> {
    /// A motion of no duration at `position`.
    pub(crate) fn empty(before: Sample) -> Self {
        Self {
            ends: [0.0; N],
            anchors: [0.0; N],
            reaches: [0.0; N],
            motions: [before; N],
            before,
            after: before,
            duration: 0.0,
        }
    }

    /// The same motion in a longer time.
    ///
    /// A move keeps its path, `p(t) -> p(t T / duration)`: its derivative of order `k` shrinks by
    /// `(T / duration)^k`, start and stop speeds included, and its end stays exact. A velocity ramp keeps its
    /// speeds, `v(t) -> v(t T / duration)`, and takes a longer way.
    ///
    /// # Errors
    /// A duration that is not finite or shorter than the profile's own, and any for a motion of no duration.
    pub fn stretched_to(&self, duration: f64) -> Result<Self, PlanError> {
        let stretch = Stretch::new(self.duration, duration, self.before, self.after)?;
        Ok(Self {
            ends: self.ends.map(|t| stretch.time(t)),
            anchors: self.anchors.map(|t| stretch.time(t)),
            reaches: self.reaches.map(|x| stretch.length(x)),
            motions: self.motions.map(|m| stretch.motion(m)),
            before: stretch.motion(self.before),
            after: stretch.motion(self.after),
            duration,
        })
    }
}

impl<const N: usize> Profile for Piecewise<N> {
    fn duration(&self) -> f64 {
        self.duration
    }

    #[inline]
    fn sample(&self, t: f64) -> Sample {
        if t >= 0.0 {
            let index: usize = self.ends.iter().map(|end| usize::from(*end <= t)).sum();
            match (self.motions.get(index), self.anchors.get(index), self.reaches.get(index)) {
                (Some(motion), Some(anchor), Some(reach)) => motion.advanced(local_time(t, *anchor, *reach)),
                _ => self.after.coasted(t - self.duration),
            }
        } else {
            self.before.coasted(if t < 0.0 { t } else { 0.0 })
        }
    }

    fn extrema(&self) -> Extrema {
        extrema::over(self)
    }

    fn response(&self, p: Complex<f64>) -> Complex<f64> {
        response::over(self, p)
    }
}

impl<const N: usize> Sectioned for Piecewise<N> {
    const HARMONIC: bool = false;

    fn section(&self, index: usize) -> Option<Section> {
        let start = match index.checked_sub(1) {
            Some(previous) => *self.ends.get(previous)?,
            None => 0.0,
        };
        Some(Section {
            start,
            end: *self.ends.get(index)?,
            anchor: *self.anchors.get(index)?,
            reach: *self.reaches.get(index)?,
            polynomial: *self.motions.get(index)?,
            amplitude: 0.0,
            angular_frequency: 0.0,
        })
    }

    fn before(&self) -> Sample {
        self.before
    }

    fn after(&self) -> Sample {
        self.after
    }
}
