//! Half a move: from rest to a speed.

use super::Piecewise;
use crate::quantities::Sample;

/// A change of speed in `M` sections that starts and ends without acceleration.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ramp<const M: usize> {
    /// End of each section, s.
    pub(crate) ends: [f64; M],
    /// Time about which each section is expanded, s.
    pub(crate) anchors: [f64; M],
    /// Length of each section, s, negative where the anchor is its end.
    pub(crate) reaches: [f64; M],
    /// Motion of each section at its anchor.
    pub(crate) motions: [Sample; M],
    /// Duration, s.
    pub(crate) duration: f64,
    /// The motion after the ramp, at its end.
    pub(crate) after: Sample,
}

impl<const M: usize> Ramp<M> {
    /// Up along `self`, on with its speed until `down_start`, and down along the mirror image of `down` to
    /// `distance`.
    ///
    /// `N` must be `2 M + 1`; the speeds of both ramps are the same.
    #[inline]
    pub(crate) fn move_to<const N: usize>(
        &self,
        down: &Self,
        down_start: f64,
        distance: f64,
    ) -> Piecewise<N> {
        const { assert!(N == 2 * M + 1) };
        let duration = down_start + down.duration;
        let mut ends = [duration; N];
        let mut anchors = [self.duration; N];
        let mut reaches = [down_start - self.duration; N];
        let mut motions = [self.after; N];
        for k in 0..M {
            (ends[k], anchors[k]) = (self.ends[k], self.anchors[k]);
            (reaches[k], motions[k]) = (self.reaches[k], self.motions[k]);
            // Seen from the end, the last section is the first one of the mirrored ramp.
            let last = N - 1 - k;
            let mirrored = &down.motions[k];
            anchors[last] = down_start + (down.duration - down.anchors[k]);
            reaches[last] = -down.reaches[k];
            motions[last] = Sample {
                position: distance - mirrored.position,
                velocity: mirrored.velocity,
                acceleration: -mirrored.acceleration,
                jerk: mirrored.jerk,
                snap: -mirrored.snap,
            };
            if k + 1 < M {
                ends[last - 1] = down_start + (down.duration - down.ends[k]);
            }
        }
        ends[M] = down_start;
        Piecewise {
            ends,
            anchors,
            reaches,
            motions,
            before: Sample::default(),
            after: Sample::at_rest(distance),
            duration,
        }
    }

    /// The ramp alone, on top of the speed `from`, m/s, ending with the speed `to`.
    #[inline]
    pub(crate) fn on_top_of<const N: usize>(&self, from: f64, to: f64) -> Piecewise<N> {
        const { assert!(N >= M) };
        let on_top = |motion: &Sample, t: f64| Sample {
            position: motion.position + from * t,
            velocity: motion.velocity + from,
            ..*motion
        };
        let after = Sample::cruising(on_top(&self.after, self.duration).position, to);
        let mut ends = [self.duration; N];
        let mut anchors = [self.duration; N];
        let mut reaches = [0.0; N];
        let mut motions = [after; N];
        for k in 0..M {
            (ends[k], anchors[k], reaches[k]) = (self.ends[k], self.anchors[k], self.reaches[k]);
            motions[k] = on_top(&self.motions[k], self.anchors[k]);
        }
        let before = Sample::cruising(0.0, from);
        Piecewise { ends, anchors, reaches, motions, before, after, duration: self.duration }
    }
}
