//! What goes to the drives: a list of points at the controller's period.

use alloc::vec::Vec;

use num_complex::Complex;

use crate::polynomial::{extrema, response};
use crate::profile::{Extrema, Profile};
use crate::quantities::{Real, Sample};
use crate::section::{Section, Sectioned};

/// The points of a motion at every tick, with the velocities there: what a controller hands to its drives.
#[derive(Debug, Clone, PartialEq)]
pub struct CoordinateList<const D: usize> {
    period: f64,
    points: Vec<[f64; D]>,
    velocities: Vec<[f64; D]>,
}

impl<const D: usize> CoordinateList<D> {
    pub(super) fn new(period: f64, motion: impl Iterator<Item = ([f64; D], [f64; D])>) -> Self {
        let (points, velocities) = motion.unzip();
        Self { period, points, velocities }
    }

    /// Time from one point to the next, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.period
    }

    /// The points from the start to the end, m.
    #[must_use]
    pub fn points(&self) -> &[[f64; D]] {
        &self.points
    }

    /// The velocities of the axes at the points, m/s.
    #[must_use]
    pub fn velocities(&self) -> &[[f64; D]] {
        &self.velocities
    }

    /// Each axis as a profile, from its first coordinate on: give it to a [`PulseTrain`](crate::PulseTrain).
    #[must_use]
    pub fn axes(&self) -> [AxisMotion<'_, D>; D] {
        core::array::from_fn(|axis| AxisMotion { list: self, axis })
    }

    fn duration(&self) -> f64 {
        self.points.len().saturating_sub(1) as f64 * self.period
    }
}

/// One axis of a [`CoordinateList`], by position, velocity and time as drives interpolate: between two ticks the cubic
/// with the coordinates and the velocities of both. It differs from the motion that the list was made of by at most
/// `period^4 / 384` times the fourth derivative of that; in a tick in which the jerk jumps by `sqrt(3) / 216 period^3` times
/// the largest jerk, and by `period^2 / 61` times the step of an acceleration that jumps where the curvature does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisMotion<'a, const D: usize> {
    list: &'a CoordinateList<D>,
    axis: usize,
}

impl<const D: usize> AxisMotion<'_, D> {
    /// Way from the first coordinate in m and velocity in m/s at a tick; those of the end after it.
    fn at(&self, tick: usize) -> (f64, f64) {
        let tick = tick.min(self.list.points.len().saturating_sub(1));
        let of = |rows: &[[f64; D]], row: usize| rows.get(row).and_then(|row| row.get(self.axis)).copied();
        let (start, now) = (of(&self.list.points, 0), of(&self.list.points, tick));
        let way = now.zip(start).map_or(0.0, |(now, start)| now - start);
        (way, of(&self.list.velocities, tick).unwrap_or(0.0))
    }
}

impl<const D: usize> Profile for AxisMotion<'_, D> {
    fn duration(&self) -> f64 {
        self.list.duration()
    }
    fn sample(&self, t: f64) -> Sample {
        if t >= 0.0 {
            self.section_at(t).map_or_else(|| self.after(), |section| section.at(t))
        } else {
            self.before()
        }
    }
    fn extrema(&self) -> Extrema {
        extrema::over(self)
    }
    fn response(&self, p: Complex<f64>) -> Complex<f64> {
        response::over(self, p)
    }
}

impl<const D: usize> Sectioned for AxisMotion<'_, D> {
    const HARMONIC: bool = false;

    fn section(&self, index: usize) -> Option<Section> {
        if index + 1 >= self.list.points.len() {
            return None;
        }
        let period = self.list.period;
        let ((from, before), (to, after)) = (self.at(index), self.at(index + 1));
        let mean = (to - from) / period;
        let motion = Sample {
            position: from,
            velocity: before,
            acceleration: (6.0 * mean - 4.0 * before - 2.0 * after) / period,
            jerk: (6.0 * (before + after) - 12.0 * mean) / (period * period),
            snap: 0.0,
        };
        let start = index as f64 * period;
        Some(Section {
            end: (index + 1) as f64 * period,
            reach: period,
            ..Section::cruise(start, start, motion)
        })
    }

    fn section_at(&self, t: f64) -> Option<Section> {
        let index = Real::floor(t.max(0.0) / self.list.period) as usize;
        let section = self.section(index)?;
        // The quotient may be one too large or too small by rounding.
        match index.checked_sub(1) {
            Some(previous) if t < section.start => self.section(previous),
            _ if t >= section.end => self.section(index + 1),
            _ => Some(section),
        }
    }

    fn before(&self) -> Sample {
        Sample::at_rest(0.0)
    }

    fn after(&self) -> Sample {
        Sample::at_rest(self.at(usize::MAX).0)
    }
}
