//! Seeded random numbers, the same for ever.

/// SplitMix64 (Steele, Lea & Flood 2014): one word of state, any seed is good.
#[derive(Clone, Debug)]
pub struct Rng(u64);

impl Rng {
    /// A generator with this seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub fn next_u64(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1), a multiple of 2⁻⁵³.
    pub fn unit_f64(&mut self) -> f64 {
        (self.next_u64() >> 11) as f64 * (0.5 / (1u64 << 52) as f64)
    }

    /// Uniform in [0, 1), a multiple of 2⁻²⁴.
    pub fn unit_f32(&mut self) -> f32 {
        (self.next_u64() >> 40) as f32 / (1u32 << 24) as f32
    }

    /// Uniform in [`low`, `high`), up to rounding.
    pub fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit_f32()
    }

    /// Uniform among 0..`count`; 0 if `count` is 0. The bias is below `count` · 2⁻⁶⁴.
    pub fn below(&mut self, count: usize) -> usize {
        ((u128::from(self.next_u64()) * count as u128) >> 64) as usize
    }

    /// A point in the box from `low` to `high`.
    pub fn point_in(&mut self, low: [f32; 3], high: [f32; 3]) -> [f32; 3] {
        std::array::from_fn(|k| self.range(low[k], high[k]))
    }

    /// A direction uniform on the unit sphere, of length 1 up to rounding (Marsaglia 1972: needs
    /// only a square root).
    pub fn direction(&mut self) -> [f32; 3] {
        loop {
            let (x, y) = (2.0 * self.unit_f64() - 1.0, 2.0 * self.unit_f64() - 1.0);
            let s = x * x + y * y;
            if s < 1.0 {
                let r = 2.0 * (1.0 - s).sqrt();
                return [(x * r) as f32, (y * r) as f32, (1.0 - 2.0 * s) as f32];
            }
        }
    }
}
