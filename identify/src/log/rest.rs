//! Where the command of a log is at rest.

/// A stretch of samples in which the command stays where it is: `first..end`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rest {
    /// The first sample of the rest.
    pub first: usize,
    /// One past its last sample.
    pub end: usize,
}

impl Rest {
    /// Samples in it.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.end.saturating_sub(self.first)
    }
}

/// Every rest of at least `least` samples, in the order of time: the command stays within `tolerance` of its value at
/// the end of the rest, counted backwards, so that the last creep of a move is no rest.
pub(super) fn rests(command: &[f64], tolerance: f64, least: usize) -> Vec<Rest> {
    let mut found = Vec::new();
    let mut end = command.len();
    while let Some(last) = end.checked_sub(1).and_then(|last| command.get(last)) {
        let still = command.iter().take(end).rev().take_while(|u| (**u - last).abs() <= tolerance).count();
        let rest = Rest { first: end - still, end };
        if still >= least {
            found.push(rest);
        }
        end = rest.first;
    }
    found.reverse();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rests_lie_between_moves() {
        let command: Vec<f64> =
            [vec![0.0; 5], vec![1.0, 2.0, 2.99], vec![3.0; 6], vec![2.0], vec![1.0; 2]].concat();
        let at = |tolerance, least| {
            rests(&command, tolerance, least).iter().map(|r| (r.first, r.end)).collect::<Vec<_>>()
        };
        assert_eq!(at(0.0, 3), [(0, 5), (8, 14)]);
        assert_eq!(at(0.02, 2), [(0, 5), (7, 14), (15, 17)]);
        assert_eq!(at(10.0, 2), [(0, 17)]);
        assert!(rests(&[], 0.0, 1).is_empty());
    }
}
