//! The way along the curve as a profile.

use alloc::vec::Vec;
use core::marker::PhantomData;

use num_complex::Complex;

use super::law::{FeedLaw, PolynomialLaw};
use super::plan::BlockPlan;
use super::ramp::Ramp;
use crate::polynomial::{extrema, response};
use crate::profile::{Extrema, Profile};
use crate::quantities::{Real, Sample};
use crate::section::{Section, Sectioned};

/// The way along a curve in m over the time in s: changes of feed by the law `L`, constant feed between them, and at
/// every stop a wait until the next tick.
#[derive(Debug, Clone, PartialEq)]
pub struct FeedProfile<L> {
    motion: Sections,
    law: PhantomData<L>,
}

impl<L> FeedProfile<L> {
    pub(super) fn new(motion: Sections) -> Self {
        Self { motion, law: PhantomData }
    }

    pub(super) fn sections(&self) -> &Sections {
        &self.motion
    }
}

impl<L: FeedLaw> Profile for FeedProfile<L> {
    fn duration(&self) -> f64 {
        self.motion.duration
    }
    fn sample(&self, t: f64) -> Sample {
        self.motion.sample(t)
    }
    fn extrema(&self) -> Extrema {
        self.motion.extrema()
    }
    fn response(&self, p: Complex<f64>) -> Complex<f64> {
        self.motion.response(p)
    }
}

impl<L: PolynomialLaw> Sectioned for FeedProfile<L> {
    const HARMONIC: bool = false;
    fn section(&self, index: usize) -> Option<Section> {
        self.motion.section(index)
    }
    fn section_at(&self, t: f64) -> Option<Section> {
        self.motion.section_at(t)
    }
    fn before(&self) -> Sample {
        self.motion.before()
    }
    fn after(&self) -> Sample {
        self.motion.after()
    }
}

/// Any number of sections from rest to rest; sines may differ in frequency, so that this is no profile for others.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sections {
    sections: Vec<Section>,
    length: f64,
    duration: f64,
}

impl Sections {
    pub(super) fn new() -> Self {
        Self { sections: Vec::new(), length: 0.0, duration: 0.0 }
    }

    /// The motion along the next block, up to the way `end`, and a wait until the next whole period.
    pub(super) fn append<L: FeedLaw>(&mut self, plan: &BlockPlan<L>, end: f64, period: f64) {
        match plan {
            BlockPlan::Move(law) => self.append_law(law, self.length, end),
            BlockPlan::Ramps(ramps) => {
                for ramp in ramps {
                    self.append_ramp(ramp);
                }
            }
        }
        self.length = end;
        let ticks = Real::ceil((self.duration - crate::cursor::instant_rounding(self.duration)) / period);
        let next = (ticks * period).max(self.duration);
        if next > self.duration {
            self.sections.push(Section::cruise(self.duration, next, Sample::at_rest(end)));
            self.duration = next;
        }
    }

    fn append_ramp<L: FeedLaw>(&mut self, ramp: &Ramp<L>) {
        let gap = ramp.start - self.length;
        if gap > 0.0 && ramp.from > 0.0 {
            let start = self.duration;
            self.duration += gap / ramp.from;
            let cruise = Sample::cruising(self.length, ramp.from);
            self.sections.push(Section::cruise(start, self.duration, cruise));
        }
        self.append_law(&ramp.law, ramp.start, ramp.end);
    }

    /// A motion from one way to another.
    fn append_law<L: FeedLaw>(&mut self, law: &L, from: f64, to: f64) {
        let (start, way) = (self.duration, law.after().position);
        for section in (0..).map_while(|index| law.section(index)).filter(|s| s.length() > 0.0) {
            // What is expanded about its end keeps the end.
            let offset = if section.reach < 0.0 { to - way } else { from };
            let begin = self.duration;
            self.duration = start + section.end;
            let polynomial = Sample { position: section.polynomial.position + offset, ..section.polynomial };
            let anchor = start + section.anchor;
            self.sections.push(Section { start: begin, end: self.duration, anchor, polynomial, ..section });
        }
        self.length = to;
    }
}

impl Profile for Sections {
    fn duration(&self) -> f64 {
        self.duration
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

impl Sectioned for Sections {
    const HARMONIC: bool = true;
    fn section(&self, index: usize) -> Option<Section> {
        self.sections.get(index).copied()
    }
    fn section_at(&self, t: f64) -> Option<Section> {
        self.sections.get(self.sections.partition_point(|section| section.end <= t)).copied()
    }
    fn before(&self) -> Sample {
        Sample::at_rest(0.0)
    }
    fn after(&self) -> Sample {
        Sample::at_rest(self.length)
    }
}
