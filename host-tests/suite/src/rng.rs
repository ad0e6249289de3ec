//! SplitMix64 (Steele, Lea, Flood 2014): integer arithmetic only, so the same stream on every
//! target.

/// A stream of pseudo-random numbers.
#[derive(Clone, Debug)]
pub struct Rng {
    state: u64,
}

impl Rng {
    /// The stream that belongs to `seed`. Streams of different seeds may be used side by side.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// The next 64 bits.
    pub fn next_u64(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// The next 32 bits: the upper half, whose bits are the better mixed ones.
    pub fn next_u32(&mut self) -> u32 {
        let [_, _, _, _, a, b, c, d] = self.next_u64().to_le_bytes();
        u32::from_le_bytes([a, b, c, d])
    }

    /// A multiple of 2⁻²⁴ in `[0, 1)`: every such number is an `f32`, so no rounding takes part.
    pub fn unit(&mut self) -> f32 {
        const STEP: f32 = 1.0 / 16_777_216.0;
        // Below 2²⁴, where the conversion is exact.
        (self.next_u32() >> 8) as f32 * STEP
    }

    /// A multiple of 2⁻²³ in `[-1, 1)`.
    pub fn signed_unit(&mut self) -> f32 {
        2.0 * self.unit() - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::Rng;

    #[test]
    fn stream_is_the_published_one() {
        // The reference implementation's first outputs for seed 1234567.
        let mut rng = Rng::new(1_234_567);
        assert_eq!(rng.next_u64(), 6_457_827_717_110_365_317);
        assert_eq!(rng.next_u64(), 3_203_168_211_198_807_973);
    }

    #[test]
    fn unit_stays_in_its_interval() {
        let mut rng = Rng::new(1);
        for _ in 0..10_000 {
            let unit = rng.unit();
            assert!((0.0..1.0).contains(&unit));
            let signed = rng.signed_unit();
            assert!((-1.0..1.0).contains(&signed));
        }
    }
}
