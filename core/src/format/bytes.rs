//! Little-endian reads by byte offset. A read past the end gives `None`.

use crate::num::each;

/// The bytes that are read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bytes<'a>(pub(crate) &'a [u8]);

impl<'a> Bytes<'a> {
    pub(crate) const fn len(self) -> usize {
        self.0.len()
    }

    #[inline(always)]
    const fn after(self, at: usize) -> Option<&'a [u8]> {
        match self.0.split_at_checked(at) {
            Some((_, rest)) => Some(rest),
            None => None,
        }
    }

    #[inline(always)]
    pub(crate) const fn slice(self, at: usize, len: usize) -> Option<&'a [u8]> {
        match some!(self.after(at)).split_at_checked(len) {
            Some((slice, _)) => Some(slice),
            None => None,
        }
    }

    #[inline(always)]
    pub(crate) const fn array<const N: usize>(self, at: usize) -> Option<[u8; N]> {
        Some(*some!(some!(self.after(at)).first_chunk::<N>()))
    }

    #[inline(always)]
    pub(crate) const fn u8(self, at: usize) -> Option<u8> {
        let [byte] = some!(self.array(at));
        Some(byte)
    }

    #[inline(always)]
    pub(crate) const fn u16(self, at: usize) -> Option<u16> {
        Some(u16::from_le_bytes(some!(self.array(at))))
    }

    #[inline(always)]
    pub(crate) const fn u32(self, at: usize) -> Option<u32> {
        Some(u32::from_le_bytes(some!(self.array(at))))
    }

    /// Whether `len` bytes are there, and all are 0.
    #[inline(never)]
    pub(crate) const fn is_zero(self, at: usize, len: usize) -> bool {
        let Some(mut bytes) = self.slice(at, len) else { return false };
        while let Some((first, rest)) = bytes.split_first() {
            if *first != 0 {
                return false;
            }
            bytes = rest;
        }
        true
    }

    /// Three words, side by side.
    #[inline(always)]
    pub(crate) const fn u32x3(self, at: usize) -> Option<[u32; 3]> {
        let (words, _) = some!(self.after(at)).as_chunks::<4>();
        let [x, y, z] = *some!(words.first_chunk::<3>());
        Some([u32::from_le_bytes(x), u32::from_le_bytes(y), u32::from_le_bytes(z)])
    }

    #[inline(always)]
    pub(crate) const fn f32(self, at: usize) -> Option<f32> {
        Some(f32::from_le_bytes(some!(self.array(at))))
    }

    /// A word of a header whose length was checked.
    #[inline(never)]
    pub(crate) const fn word(self, at: usize) -> u32 {
        match self.u32(at) {
            Some(word) => word,
            None => 0,
        }
    }

    /// Three signed words of such a header.
    pub(crate) const fn i32x3(self, at: usize) -> [i32; 3] {
        [
            self.word(at).cast_signed(),
            self.word(at + 4).cast_signed(),
            self.word(at + 8).cast_signed(),
        ]
    }

    /// Three u16 of such a header.
    pub(crate) const fn u16x3(self, at: usize) -> [u16; 3] {
        match self.array(at) {
            Some([a, b, c, d, e, f]) => {
                [u16::from_le_bytes([a, b]), u16::from_le_bytes([c, d]), u16::from_le_bytes([e, f])]
            }
            None => [0; 3],
        }
    }

    /// Three f32 of such a header.
    pub(crate) const fn corner(self, at: usize) -> [f32; 3] {
        [
            f32::from_bits(self.word(at)),
            f32::from_bits(self.word(at + 4)),
            f32::from_bits(self.word(at + 8)),
        ]
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

    /// The index at a place, where all have `width` bytes. One comparison says that it is there.
    #[inline(always)]
    pub(crate) fn nth(self, place: usize, width: usize) -> Option<u32> {
        match width {
            2 => self.0.as_chunks::<2>().0.get(place).map(|pair| u16::from_le_bytes(*pair).into()),
            _ => self.index(place.wrapping_mul(width), width),
        }
    }

    /// The record at a place, where all have `N` fields of `W` bytes. Two comparisons say that it
    /// is there. Single bytes would be put together again after each way to them.
    #[inline(always)]
    pub(crate) fn record<const W: usize, const N: usize>(
        self,
        place: u32,
    ) -> Option<&'a [[u8; W]; N]> {
        let at = (place as usize).checked_mul(const { W * N })?;
        self.0.get(at..)?.as_chunks::<W>().0.first_chunk()
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
                Some(each([x, y, z], |pair| u32::from(u16::from_le_bytes(*pair))))
            }
            3 => self.array::<9>(at).map(|[a, b, c, d, e, f, g, h, i]| {
                each([[a, b, c, 0], [d, e, f, 0], [g, h, i, 0]], u32::from_le_bytes)
            }),
            _ => Some([
                self.index(at, width)?,
                self.index(at.checked_add(width)?, width)?,
                self.index(at.checked_add(width.checked_mul(2)?)?, width)?,
            ]),
        }
    }
}
