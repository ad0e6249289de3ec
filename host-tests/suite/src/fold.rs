//! Answer bits to a 64-bit hash.

/// FNV-1a over 32-bit words taken as bytes, low byte first.
///
/// Not a cryptographic hash, and it need not be: a wrong bit changes it, and the multiplication
/// carries that change into every later state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fold(u64);

impl Fold {
    const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0000_0100_0000_01b3;

    /// The hash of nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self(Self::OFFSET)
    }

    /// Folds one byte.
    pub fn byte(&mut self, byte: u8) {
        self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(Self::PRIME);
    }

    /// Folds the four bytes of a word.
    pub fn word(&mut self, word: u32) {
        for byte in word.to_le_bytes() {
            self.byte(byte);
        }
    }

    /// Folds the bits of a number: `-0.0` and `0.0` differ.
    pub fn f32(&mut self, value: f32) {
        self.word(value.to_bits());
    }

    /// Folds the bits of a number: `-0.0` and `0.0` differ.
    pub fn f64(&mut self, value: f64) {
        for byte in value.to_bits().to_le_bytes() {
            self.byte(byte);
        }
    }

    /// Folds the bits of a point, x first.
    pub fn point(&mut self, point: [f32; 3]) {
        for coordinate in point {
            self.f32(coordinate);
        }
    }

    /// The hash of all that was folded.
    #[must_use]
    pub const fn finish(self) -> u64 {
        self.0
    }

    /// The hash of a byte slice.
    #[must_use]
    pub fn of_bytes(bytes: &[u8]) -> u64 {
        let mut fold = Self::new();
        for &byte in bytes {
            fold.byte(byte);
        }
        fold.finish()
    }
}

impl Default for Fold {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::Fold;

    #[test]
    fn hash_is_the_published_fnv1a() {
        assert_eq!(Fold::of_bytes(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(Fold::of_bytes(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(Fold::of_bytes(b"foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn a_word_is_its_little_endian_bytes() {
        let mut fold = Fold::new();
        fold.word(u32::from_le_bytes(*b"foob"));
        fold.byte(b'a');
        fold.byte(b'r');
        assert_eq!(fold.finish(), Fold::of_bytes(b"foobar"));
    }
}
