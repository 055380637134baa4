//! Random numbers with an address.

/// The step of the sequence: 2^64 over the golden ratio, odd.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// The random numbers of one particle in one iteration: a sequence that depends on its address and on nothing that was
/// drawn before, so that any order of evaluation and any restart meets the same numbers.
///
/// The state starts at `mix(mix(mix(seed + d) + iteration + d) + particle + d)` and counts on by `d`; each state goes
/// through `mix`, the output function of SplitMix64. All streams are stretches of one cycle of length 2^64: two of `n`
/// streams of length `m` overlap with a probability of about `n^2 m / 2^64`.
///
/// ```
/// use optimize::Stream;
///
/// let mut stream = Stream::new(7, 3, 100);
/// let first = stream.uniform();
/// assert!((0.0..1.0).contains(&first));
/// assert_eq!(Stream::new(7, 3, 100).uniform(), first);
/// assert_ne!(Stream::new(7, 4, 100).uniform(), first);
/// ```
///
/// # References
/// G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014,
/// <https://doi.org/10.1145/2660193.2660195>.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stream {
    state: u64,
}

impl Stream {
    /// The stream of a particle in an iteration.
    #[must_use]
    #[inline]
    pub const fn new(seed: u64, particle: u64, iteration: u64) -> Self {
        Self::keyed(Self::key(seed, iteration), particle)
    }

    /// What the streams of all particles of an iteration share.
    #[must_use]
    #[inline]
    pub(crate) const fn key(seed: u64, iteration: u64) -> u64 {
        mix(mix(seed.wrapping_add(STEP)).wrapping_add(iteration).wrapping_add(STEP))
    }

    /// The stream of a particle, given what its iteration shares.
    #[must_use]
    #[inline]
    pub(crate) const fn keyed(key: u64, particle: u64) -> Self {
        Self { state: mix(key.wrapping_add(particle).wrapping_add(STEP)) }
    }

    /// The next 64 bits.
    #[inline]
    pub const fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(STEP);
        mix(self.state)
    }

    /// The next number, uniform over the multiples of 2^-53 in `[0, 1)`.
    #[inline]
    pub const fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
    }
}

/// A bijection in which every input bit moves about half of the output bits.
#[inline]
const fn mix(bits: u64) -> u64 {
    let bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_generator_is_split_mix() {
        // The published generator started at 1234567 gives these numbers.
        let mut stream = Stream { state: 1_234_567 };
        let expected = [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423];
        assert_eq!([stream.bits(), stream.bits(), stream.bits()], expected);
    }

    #[test]
    fn neighbours_share_nothing() {
        // First numbers along each coordinate of the address: mean, variance, and correlation with the neighbour.
        let count = 100_000_u64;
        let along: [fn(u64) -> Stream; 3] =
            [|n| Stream::new(n, 0, 0), |n| Stream::new(1, n, 5), |n| Stream::new(1, 3, n)];
        for stream in along {
            let centred: Vec<f64> = (0..count).map(|n| stream(n).uniform() - 0.5).collect();
            let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / count as f64;
            // Standard deviations: 0.29, 0.075 and 0.083 over the root of the count; the bounds are five of them.
            let root = (count as f64).sqrt();
            assert!(mean(&mut centred.iter().copied()).abs() < 5.0 * 0.29 / root);
            assert!((mean(&mut centred.iter().map(|x| x * x)) - 1.0 / 12.0).abs() < 5.0 * 0.075 / root);
            assert!(mean(&mut centred.windows(2).map(|w| w[0] * w[1])).abs() < 5.0 * 0.084 / root);
        }
    }
}
