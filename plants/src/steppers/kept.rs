//! What was computed for the last lengths of a step.

use crate::error::ModelError;

const KEPT: usize = 8;

/// What belongs to the last eight distinct intervals.
#[derive(Debug, Clone)]
pub(crate) struct Kept<T> {
    // Ordered from the last used; the key is the interval.
    entries: Vec<(f64, T)>,
}

impl<T> Kept<T> {
    pub(crate) fn new() -> Self {
        Self { entries: Vec::with_capacity(KEPT) }
    }

    /// What belongs to an interval, made when it is not kept; the usual case, the first, inline.
    #[inline(always)]
    pub(crate) fn get(
        &mut self,
        interval: f64,
        make: impl FnOnce() -> Result<T, ModelError>,
    ) -> Result<&T, ModelError> {
        let place = match self.entries.first() {
            Some((kept, _)) if kept.to_bits() == interval.to_bits() => 0,
            _ => self.find(interval, make)?,
        };
        Ok(&self.entries[place].1)
    }

    #[inline(never)]
    fn find(
        &mut self,
        interval: f64,
        make: impl FnOnce() -> Result<T, ModelError>,
    ) -> Result<usize, ModelError> {
        let bits = interval.to_bits();
        match self.entries.iter().position(|(kept, _)| kept.to_bits() == bits) {
            Some(0) => Ok(0),
            // One place forward at each use keeps the frequent ones in front without moving all of them.
            Some(place) => Ok(self.forward(place)),
            None => {
                let value = make()?;
                Ok(self.insert(interval, value))
            }
        }
    }

    fn forward(&mut self, place: usize) -> usize {
        self.entries.swap(place, place - 1);
        place - 1
    }

    #[cold]
    fn insert(&mut self, interval: f64, value: T) -> usize {
        if self.entries.len() == KEPT {
            self.entries.pop();
        }
        self.entries.push((interval, value));
        let last = self.entries.len() - 1;
        if last > 0 { self.forward(last) } else { 0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_are_kept_and_none_is_mistaken() {
        let (mut kept, mut made) = (Kept::new(), 0);
        for k in 0..200_u32 {
            // Twelve lengths in turn, more than are kept, then three that are.
            let interval = f64::from(1 + if k < 100 { k % 12 } else { k % 3 });
            let value = kept.get(interval, || {
                made += 1;
                Ok(interval)
            });
            assert_eq!(value, Ok(&interval));
            assert!(kept.entries.len() <= KEPT);
        }
        assert_eq!(kept.entries.capacity(), KEPT);
        assert!(made < 110);
    }

    #[test]
    fn what_cannot_be_made_is_not_kept() {
        let mut kept = Kept::<f64>::new();
        let error = ModelError::Range { interval: 1.0 };
        assert_eq!(kept.get(1.0, || Err(error)), Err(error));
        assert_eq!(kept.get(1.0, || Ok(2.0)), Ok(&2.0));
    }
}
