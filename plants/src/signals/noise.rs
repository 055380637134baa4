//! Seeded noise.

use profiles::Real;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};

use crate::error::ModelError;

/// A source of random numbers; the same seed gives the same bits on every platform.
pub trait Noise {
    /// The next number.
    fn sample(&mut self) -> f64;
}

/// Independent numbers, evenly distributed over `[-amplitude, amplitude)`: their standard deviation is
/// `amplitude / sqrt(3)`.
#[derive(Debug, Clone, PartialEq)]
pub struct UniformNoise {
    amplitude: f64,
    generator: Xoshiro256PlusPlus,
}

impl UniformNoise {
    /// Noise from its amplitude, in the unit of what it is added to, and a seed.
    ///
    /// # Errors
    /// An amplitude that is negative or not finite.
    pub fn new(amplitude: f64, seed: u64) -> Result<Self, ModelError> {
        not_negative("the amplitude", amplitude)?;
        Ok(Self { amplitude, generator: Xoshiro256PlusPlus::seed_from_u64(seed) })
    }
}

impl Noise for UniformNoise {
    #[inline]
    fn sample(&mut self) -> f64 {
        self.amplitude * symmetric(&mut self.generator)
    }
}

/// Independent numbers with a normal distribution about zero.
///
/// ```
/// use plants::{GaussianNoise, Noise};
///
/// let mut noise = GaussianNoise::new(1e-6, 7)?;
/// let mut again = noise.clone();
/// assert_eq!(noise.sample().to_bits(), again.sample().to_bits());
/// # Ok::<(), plants::ModelError>(())
/// ```
///
/// # References
/// G. Marsaglia and T. A. Bray, "A convenient method for generating normal variables", SIAM Review 6 (1964),
/// doi:10.1137/1006063.
#[derive(Debug, Clone, PartialEq)]
pub struct GaussianNoise {
    standard_deviation: f64,
    generator: Xoshiro256PlusPlus,
    // The polar method makes two at a time.
    spare: Option<f64>,
}

impl GaussianNoise {
    /// Noise from its standard deviation, in the unit of what it is added to, and a seed.
    ///
    /// # Errors
    /// A standard deviation that is negative or not finite.
    pub fn new(standard_deviation: f64, seed: u64) -> Result<Self, ModelError> {
        not_negative("the standard deviation", standard_deviation)?;
        Ok(Self { standard_deviation, generator: Xoshiro256PlusPlus::seed_from_u64(seed), spare: None })
    }

    fn standard(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        loop {
            let (u, v) = (symmetric(&mut self.generator), symmetric(&mut self.generator));
            let square = u * u + v * v;
            if square > 0.0 && square < 1.0 {
                let factor = Real::sqrt(-2.0 * Real::ln(square) / square);
                self.spare = Some(v * factor);
                return u * factor;
            }
        }
    }
}

impl Noise for GaussianNoise {
    #[inline]
    fn sample(&mut self) -> f64 {
        self.standard_deviation * self.standard()
    }
}

/// A multiple of 2^-52 in `[-1, 1)`.
fn symmetric(generator: &mut Xoshiro256PlusPlus) -> f64 {
    const STEP: f64 = 1.0 / (1_u64 << 52) as f64;
    (generator.next_u64() >> 11) as f64 * STEP - 1.0
}

fn not_negative(parameter: &'static str, value: f64) -> Result<(), ModelError> {
    if value >= 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(ModelError::Parameter { parameter, range: "finite and not negative", value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAMPLES: usize = 200_000;

    /// Mean and the second to fourth moments about zero.
    fn moments(noise: &mut impl Noise) -> [f64; 4] {
        let mut sums = [0.0; 4];
        for _ in 0..SAMPLES {
            let x = noise.sample();
            for (power, sum) in (1..).zip(sums.iter_mut()) {
                *sum += x.powi(power);
            }
        }
        sums.map(|sum| sum / SAMPLES as f64)
    }

    #[test]
    fn gaussian_moments() {
        // Five standard errors of each moment over n samples: sqrt(var / n).
        let n = (SAMPLES as f64).sqrt();
        let [mean, variance, skew, kurtosis] = moments(&mut GaussianNoise::new(1.0, 1).expect("valid"));
        assert!(mean.abs() < 5.0 / n);
        assert!((variance - 1.0).abs() < 5.0 * 2.0_f64.sqrt() / n);
        assert!(skew.abs() < 5.0 * 15.0_f64.sqrt() / n);
        assert!((kurtosis - 3.0).abs() < 5.0 * 96.0_f64.sqrt() / n);
    }

    #[test]
    fn uniform_moments() {
        let n = (SAMPLES as f64).sqrt();
        let [mean, variance, _, kurtosis] = moments(&mut UniformNoise::new(2.0, 1).expect("valid"));
        assert!(mean.abs() < 5.0 * (4.0_f64 / 3.0).sqrt() / n);
        assert!((variance - 4.0 / 3.0).abs() < 5.0 * (64.0_f64 / 45.0).sqrt() / n);
        assert!((kurtosis - 16.0 / 5.0).abs() < 5.0 * (256.0_f64 / 9.0).sqrt() / n);
    }

    #[test]
    fn a_seed_is_a_sequence() {
        let sequence = |seed| {
            let mut noise = GaussianNoise::new(0.5, seed).expect("valid");
            core::array::from_fn::<u64, 9, _>(|_| noise.sample().to_bits())
        };
        assert_eq!(sequence(3), sequence(3));
        assert_ne!(sequence(3), sequence(4));
        let mut silent = GaussianNoise::new(0.0, 3).expect("valid");
        assert!(silent.sample().abs() <= 0.0);
        assert!(GaussianNoise::new(f64::NAN, 0).is_err());
        assert!(UniformNoise::new(-1.0, 0).is_err());
    }

    #[test]
    fn the_generator_is_the_published_one() {
        // First output of xoshiro256++ from the state [1, 2, 3, 4] in its authors' reference code.
        let mut seed = [0_u8; 32];
        for (word, value) in seed.chunks_exact_mut(8).zip(1_u64..) {
            word.copy_from_slice(&value.to_le_bytes());
        }
        let mut generator = Xoshiro256PlusPlus::from_seed(seed);
        assert_eq!([generator.next_u64(), generator.next_u64()], [41_943_041, 58_720_359]);
    }
}
