//! Random numbers of unit tests.

/// A linear congruential generator, from a seed.
pub(crate) struct Noise(pub(crate) u64);

impl Noise {
    /// 64 bits. The high ones are the better ones.
    pub(crate) fn bits(&mut self) -> u64 {
        const FACTOR: u64 = 6_364_136_223_846_793_005;
        self.0 = self.0.wrapping_mul(FACTOR).wrapping_add(1_442_695_040_888_963_407);
        self.0
    }

    /// A number from −1 to 1.
    pub(crate) fn unit(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1u32 << 23) as f32 - 1.0
    }
}
