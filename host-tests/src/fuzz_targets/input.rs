//! From a fuzzer's bytes to blobs and queries.

use crate::corrupt::{put_u32, seal};
use crate::generate::Rng;
use meshsweep_core::{Budget, Pose};

/// Numbers that arithmetic has trouble with.
const ODD: [f32; 11] = [
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::MAX,
    1e38,
    -1e38,
    1e19,
    f32::MIN_POSITIVE,
    1e-40,
    f32::from_bits(1),
    -0.0,
];

/// Reads numbers off the fuzzer's bytes; zeros when they are used up.
pub(super) struct Input<'a>(pub(super) &'a [u8]);

impl Input<'_> {
    pub(super) fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    pub(super) fn u32(&mut self) -> u32 {
        u32::from_le_bytes(std::array::from_fn(|_| self.byte()))
    }

    pub(super) fn float(&mut self) -> f32 {
        match self.byte() % 8 {
            // Any bits, NaN and infinity among them.
            0 => f32::from_bits(self.u32()),
            1 => 0.0,
            2 => (f32::from(self.byte()) - 128.0) * 1e30,
            3 => ODD[usize::from(self.byte()) % ODD.len()],
            _ => (f32::from(self.byte()) - 128.0) / 32.0,
        }
    }

    pub(super) fn point(&mut self) -> [f32; 3] {
        std::array::from_fn(|_| self.float())
    }

    /// Any tolerances and steps.
    pub(super) fn budget(&mut self) -> Budget {
        Budget::EXACT.with_relative(self.float()).with_absolute(self.float()).with_steps(self.u32())
    }

    /// Any motion, more often a plausible one.
    pub(super) fn pose(&mut self) -> Pose {
        let translation = self.point();
        let rotation = match self.byte() % 4 {
            0 => [self.point(), self.point(), self.point()],
            1 => Pose::IDENTITY.rotation,
            _ => [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]],
        };
        Pose::affine(rotation, translation)
    }

    /// One of some blobs with up to fifteen edits, with right CRCs.
    pub(super) fn blob(&mut self, seeds: &[Vec<u8>]) -> Vec<u8> {
        let mut blob = seeds[usize::from(self.byte()) % seeds.len()].clone();
        for _ in 0..self.byte() % 16 {
            let kind = self.byte();
            let at = if kind & 0x80 == 0 {
                self.u32() as usize % blob.len()
            } else {
                self.u32() as usize % 400
            };
            let at = at.min(blob.len() - 1);
            match kind % 6 {
                0 => blob[at] ^= 1 << (self.byte() % 8),
                1 => blob[at] = self.byte(),
                2 => blob[at] = blob[at].wrapping_add(1),
                3 => blob[at] = 0xFF,
                4 => {
                    let from = self.u32() as usize % blob.len();
                    blob[at] = blob[from];
                }
                _ => {
                    let word = [0, 1, 0x7F80_0000, 0x7FC0_0000, 0x7FFF_FFFF, u32::MAX]
                        [usize::from(self.byte()) % 6];
                    put_u32(&mut blob, at & !3, word);
                }
            }
        }
        seal(&mut blob);
        blob
    }
}

/// Seeded bytes for a driver that has no fuzzer.
#[must_use]
pub fn random_input(rng: &mut Rng) -> Vec<u8> {
    let length = 8 + rng.below(120);
    let mut data: Vec<u8> = (0..length).map(|_| rng.next_u64() as u8).collect();
    // Few edits leave more blobs that open.
    if rng.below(4) > 0 {
        data[1] %= 3;
    }
    data
}
