//! Little-endian reads by byte offset. A read past the end gives `None`.

/// The bytes that are read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bytes<'a>(pub(crate) &'a [u8]);

impl<'a> Bytes<'a> {
    pub(crate) fn len(self) -> usize {
        self.0.len()
    }

    #[inline(always)]
    pub(crate) fn slice(self, at: usize, len: usize) -> Option<&'a [u8]> {
        self.0.get(at..)?.get(..len)
    }

    #[inline(always)]
    pub(crate) fn array<const N: usize>(self, at: usize) -> Option<[u8; N]> {
        self.0.get(at..)?.first_chunk::<N>().copied()
    }

    #[inline(always)]
    pub(crate) fn u8(self, at: usize) -> Option<u8> {
        self.0.get(at).copied()
    }

    #[inline(always)]
    pub(crate) fn u16(self, at: usize) -> Option<u16> {
        self.array(at).map(u16::from_le_bytes)
    }

    #[inline(always)]
    pub(crate) fn u32(self, at: usize) -> Option<u32> {
        self.array(at).map(u32::from_le_bytes)
    }

    /// Three words, side by side.
    #[inline(always)]
    pub(crate) fn u32x3(self, at: usize) -> Option<[u32; 3]> {
        let (words, _) = self.0.get(at..)?.as_chunks::<4>();
        Some(words.first_chunk::<3>()?.map(u32::from_le_bytes))
    }

    #[inline(always)]
    pub(crate) fn f32(self, at: usize) -> Option<f32> {
        self.array(at).map(f32::from_le_bytes)
    }

    /// An index of `width` bytes.
    #[inline(always)]
    pub(crate) fn index(self, at: usize, width: usize) -> Option<u32> {
        match width {
            2 => self.u16(at).map(u32::from),
            3 => self.array::<3>(at).map(|[a, b, c]| u32::from_le_bytes([a, b, c, 0])),
            4 => self.u32(at),
            _ => self.u8(at).map(u32::from),
        }
    }

    /// Three indices of `width` bytes, side by side.
    #[inline(always)]
    pub(crate) fn index3(self, at: usize, width: usize) -> Option<[u32; 3]> {
        match width {
            2 => {
                let bytes = self.0.get(at..)?.first_chunk::<6>()?;
                let (x, rest) = bytes.split_first_chunk::<2>()?;
                let (y, rest) = rest.split_first_chunk::<2>()?;
                let z = rest.first_chunk::<2>()?;
                Some([x, y, z].map(|pair| u32::from(u16::from_le_bytes(*pair))))
            }
            3 => self.array::<9>(at).map(|[a, b, c, d, e, f, g, h, i]| {
                [[a, b, c, 0], [d, e, f, 0], [g, h, i, 0]].map(u32::from_le_bytes)
            }),
            _ => Some([
                self.index(at, width)?,
                self.index(at.checked_add(width)?, width)?,
                self.index(at.checked_add(width.checked_mul(2)?)?, width)?,
            ]),
        }
    }
}
