//! Small sets of points.

/// SplitMix64 (Steele, Lea & Flood 2014).
pub struct Rng(pub u64);

impl Rng {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    /// A few points with small integer coordinates: many coincide, lie in planes or on lines.
    pub fn points(&mut self) -> Vec<[f32; 3]> {
        let span = [2, 3, 5, 9, 65, 4097][self.below(6) as usize];
        let count = 1 + self.below(12);
        let flat = self.below(8);
        (0..count)
            .map(|_| {
                let mut point = [0; 3].map(|_: i32| self.below(span) as f32 - (span / 2) as f32);
                if flat < 3 {
                    point[flat as usize] = 1.0;
                }
                point
            })
            .collect()
    }
}
