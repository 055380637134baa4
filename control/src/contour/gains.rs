//! Gains written as a sequence: arrays of any length are not known to serde.

use core::fmt;
use core::marker::PhantomData;

use profiles::Real;
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use serde::ser::{Serialize, SerializeTuple, Serializer};

use super::CrossCoupling;

impl<const N: usize, F: Real + Serialize> Serialize for CrossCoupling<N, F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut tuple = serializer.serialize_tuple(N)?;
        for gain in self.gains() {
            tuple.serialize_element(&gain)?;
        }
        tuple.end()
    }
}

struct Gains<const N: usize, F>(PhantomData<F>);

impl<'de, const N: usize, F: Real + Deserialize<'de>> Visitor<'de> for Gains<N, F> {
    type Value = [F; N];

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{N} gains")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<[F; N], A::Error> {
        let mut gains = [F::ZERO; N];
        for (axis, gain) in gains.iter_mut().enumerate() {
            *gain = sequence.next_element()?.ok_or_else(|| Error::invalid_length(axis, &self))?;
        }
        Ok(gains)
    }
}

impl<'de, const N: usize, F: Real + Deserialize<'de>> Deserialize<'de> for CrossCoupling<N, F> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let gains = deserializer.deserialize_tuple(N, Gains(PhantomData))?;
        Self::new(gains).map_err(Error::custom)
    }
}
