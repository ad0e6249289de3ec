//! The host's files as they lie in flash: little-endian 32-bit words, any alignment.

/// Records of `N` words each.
#[derive(Clone, Copy, Debug)]
pub struct Records<const N: usize>(&'static [u8]);

impl<const N: usize> Records<N> {
    /// The whole records of `bytes`; what is left at the end is no part of them.
    #[must_use]
    pub const fn new(bytes: &'static [u8]) -> Self {
        Self(bytes)
    }

    /// How many there are.
    #[must_use]
    pub const fn count(self) -> usize {
        self.0.len() / (4 * N)
    }

    /// Each as integers.
    pub fn integers(self) -> impl ExactSizeIterator<Item = [u32; N]> {
        self.0.chunks_exact(4 * N).map(|record| {
            core::array::from_fn(|k| {
                u32::from_le_bytes([
                    record[4 * k],
                    record[4 * k + 1],
                    record[4 * k + 2],
                    record[4 * k + 3],
                ])
            })
        })
    }

    /// Each as numbers.
    pub fn numbers(self) -> impl ExactSizeIterator<Item = [f32; N]> {
        self.integers().map(|record| record.map(f32::from_bits))
    }
}
