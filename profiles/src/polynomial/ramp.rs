//! Half a move: from rest to a speed.

use super::{Piece, Piecewise};
use crate::quantities::Sample;

/// A change of speed in `M` sections that starts and ends without acceleration.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ramp<const M: usize> {
    /// End of each section, s.
    pub(crate) ends: [f64; M],
    pub(crate) pieces: [Piece; M],
    /// Duration, s.
    pub(crate) duration: f64,
    /// Way covered, m.
    pub(crate) way: f64,
    /// Speed reached, m/s.
    pub(crate) speed: f64,
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
        let cruise = Sample::cruising(self.way, self.speed);
        let mut pieces = [Piece::new(self.duration, down_start - self.duration, cruise); N];
        for k in 0..M {
            (ends[k], pieces[k]) = (self.ends[k], self.pieces[k]);
            // Seen from the end, the last section is the first one of the mirrored ramp.
            let last = N - 1 - k;
            let Piece { anchor, reach, motion } = down.pieces[k];
            let mirrored = Sample {
                position: distance - motion.position,
                velocity: motion.velocity,
                acceleration: -motion.acceleration,
                jerk: motion.jerk,
                snap: -motion.snap,
            };
            pieces[last] = Piece::new(down_start + (down.duration - anchor), -reach, mirrored);
            if k + 1 < M {
                ends[last - 1] = down_start + (down.duration - down.ends[k]);
            }
        }
        ends[M] = down_start;
        Piecewise { ends, pieces, before: 0.0, target: distance, after: 0.0, duration }
    }

    /// The ramp alone, on top of the speed `from`, m/s, ending with the speed `to`.
    #[inline]
    pub(crate) fn on_top_of<const N: usize>(&self, from: f64, to: f64) -> Piecewise<N> {
        const { assert!(N >= M) };
        let target = self.way + from * self.duration;
        let mut ends = [self.duration; N];
        let mut pieces = [Piece::new(self.duration, 0.0, Sample::cruising(target, to)); N];
        for k in 0..M {
            let Piece { anchor, reach, motion } = self.pieces[k];
            let lifted = Sample {
                position: motion.position + from * anchor,
                velocity: motion.velocity + from,
                ..motion
            };
            (ends[k], pieces[k]) = (self.ends[k], Piece::new(anchor, reach, lifted));
        }
        // To the bit, whatever the sum of the two speeds was rounded to.
        pieces[M - 1].motion.velocity = to;
        Piecewise { ends, pieces, before: from, target, after: to, duration: self.duration }
    }
}
