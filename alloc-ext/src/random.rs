//! Pseudo-random numbers, the same in every run.

use glam::DVec3;

/// SplitMix64 (Steele, Lea & Flood 2014).
#[derive(Clone, Debug)]
pub(crate) struct SplitMix(u64);

impl SplitMix {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1).
    pub fn roll(&mut self) -> f64 {
        ((self.bits() >> 11) as f64) / (1u64 << 53) as f64
    }

    /// Puts `items` in random order (Fisher & Yates).
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            // The high word of the product: below `last + 1`.
            let other = (u128::from(self.bits()) * (last as u128 + 1)) >> 64;
            items.swap(last, other as usize);
        }
    }

    /// Uniform in a box about a centre.
    #[cfg(test)]
    pub fn point(&mut self, centre: DVec3, size: DVec3) -> DVec3 {
        centre + (DVec3::new(self.roll(), self.roll(), self.roll()) - 0.5) * size
    }

    /// Each coordinate uniform in [−1, 1).
    pub fn direction(&mut self) -> DVec3 {
        DVec3::new(self.roll(), self.roll(), self.roll()) * 2.0 - 1.0
    }
}
