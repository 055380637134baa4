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
    pub(crate) pieces: [Piece; N],
    /// Velocity before the start, m/s.
    pub(crate) before: f64,
    /// Position at the end, m, and velocity after it, m/s.
    pub(crate) target: f64,
    pub(crate) after: f64,
    pub(crate) duration: f64,
}

/// A Taylor polynomial and where it holds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Piece {
    /// Time about which it is expanded, s.
    pub(crate) anchor: f64,
    /// Planned length of its section, s, negative where the anchor is the end.
    pub(crate) reach: f64,
    /// The motion at the anchor.
    pub(crate) motion: Sample,
}

impl Piece {
    #[inline]
    pub(crate) fn new(anchor: f64, reach: f64, motion: Sample) -> Self {
        Self { anchor, reach, motion }
    }
}

impl<const N: usize> Piecewise<N> {
    /// No motion but a constant velocity, m/s, for no time.
    pub(crate) fn empty(velocity: f64) -> Self {
        let piece = Piece::new(0.0, 0.0, Sample::cruising(0.0, velocity));
        Self {
            ends: [0.0; N],
            pieces: [piece; N],
            before: velocity,
            target: 0.0,
            after: velocity,
            duration: 0.0,
        }
    }

    /// Number of sections that have ended at `t`: that of the section to evaluate.
    #[inline]
    fn index(&self, t: f64) -> usize {
        // Counted, not searched: the comparisons do not wait for each other, and the compiler sets them side by side.
        let mut index = 0;
        for end in &self.ends {
            index += usize::from(*end <= t);
        }
        index
    }

    /// The same motion in a longer time.
    ///
    /// A move keeps its path, `p(t) -> p(t T / duration)`: its derivative of order `k` shrinks by
    /// `(T / duration)^k`, start and stop speeds included, and its end stays exact. A velocity ramp keeps its
    /// speeds, `v(t) -> v(t T / duration)`, and takes a longer way.
    ///
    /// # Errors
    /// A duration above 1e75 s or shorter than the profile's own, and any for a motion of no duration.
    pub fn stretched_to(&self, duration: f64) -> Result<Self, PlanError> {
        let stretch = Stretch::new(self.duration, duration, self.before, self.after)?;
        Ok(Self {
            ends: self.ends.map(|t| stretch.time(t)),
            pieces: self.pieces.map(|piece| Piece {
                anchor: stretch.time(piece.anchor),
                reach: stretch.length(piece.reach),
                motion: stretch.motion(piece.motion),
            }),
            before: stretch.speed(self.before),
            target: stretch.position(self.target),
            after: stretch.speed(self.after),
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
            match self.pieces.get(self.index(t)) {
                Some(piece) => piece.motion.advanced(local_time(t, piece.anchor, piece.reach)),
                None => self.after().coasted(t - self.duration),
            }
        } else {
            self.before().coasted(if t < 0.0 { t } else { 0.0 })
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
        let piece = self.pieces.get(index)?;
        Some(Section {
            start,
            end: *self.ends.get(index)?,
            anchor: piece.anchor,
            reach: piece.reach,
            polynomial: piece.motion,
            amplitude: 0.0,
            angular_frequency: 0.0,
            phase: 0.0,
        })
    }

    fn section_at(&self, t: f64) -> Option<Section> {
        self.section(self.index(t))
    }

    fn before(&self) -> Sample {
        Sample::cruising(0.0, self.before)
    }

    fn after(&self) -> Sample {
        Sample::cruising(self.target, self.after)
    }
}
