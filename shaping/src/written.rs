//! Trains as they are written down: the list of their impulses, checked when read.

use core::fmt;

use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::error::TrainError;
use crate::train::{Impulse, ImpulseTrain};

impl<const N: usize> Serialize for ImpulseTrain<N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.impulses())
    }
}

impl<'de, const N: usize> Deserialize<'de> for ImpulseTrain<N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(Impulses)
    }
}

struct Impulses<const N: usize>;

impl<'de, const N: usize> Visitor<'de> for Impulses<N> {
    type Value = ImpulseTrain<N>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "a list of at most {N} impulses")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<ImpulseTrain<N>, A::Error> {
        let mut impulses = [Impulse::default(); N];
        let mut len = 0;
        while let Some(impulse) = list.next_element()? {
            len += 1;
            match impulses.get_mut(len - 1) {
                Some(place) => *place = impulse,
                None => return Err(Error::custom(TrainError::Capacity { needed: len, capacity: N })),
            }
        }
        ImpulseTrain::new(impulses.get(..len).unwrap_or_default()).map_err(Error::custom)
    }
}
