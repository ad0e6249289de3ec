//! A bit for each triangle of a tree.
//!
//! *Turned triangles.* A tree stores triangles as the file winds them. Where that winding does not
//! bound a solid, but that of some triangles turned does, sides are those of the turned ones.
//!
//! *Sideless triangles.* Where the surface crosses itself, or lies inside itself, the front of a
//! triangle may look at places of winding number 1. Such a triangle tells no side.

/// One bit for each triangle of a tree, least bit first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleBits<'a> {
    /// All bits are set, and none is stored.
    all: bool,
    /// The bits, or nothing if none is set.
    bytes: &'a [u8],
}

impl<'a> TriangleBits<'a> {
    /// Those of a section. If there is none, but `is_flagged`, all are set.
    pub(super) const fn new(is_flagged: bool, bytes: &'a [u8]) -> Self {
        Self { all: is_flagged && bytes.is_empty(), bytes }
    }

    /// Whether there are bits for so many triangles, or none.
    pub(super) const fn fit(self, triangles: u32) -> bool {
        self.bytes.is_empty() || self.bytes.len() == triangles.div_ceil(8) as usize
    }

    /// Whether the bits after those of all `triangles` are 0.
    pub(super) const fn ends_with_zeros(self, triangles: u32) -> bool {
        match self.bytes.last() {
            Some(last) if !triangles.is_multiple_of(8) => *last >> (triangles % 8) == 0,
            _ => true,
        }
    }

    /// Whether all bits are set, and none is stored.
    pub(crate) const fn are_all(self) -> bool {
        self.all
    }

    /// Whether bits are stored.
    pub(crate) const fn are_stored(self) -> bool {
        !self.bytes.is_empty()
    }

    /// Whether the bit of a triangle of the tree is set.
    #[inline(always)]
    pub(crate) fn contains(self, triangle: u32) -> bool {
        let byte = self.bytes.get(triangle as usize / 8);
        self.all || byte.is_some_and(|byte| byte >> (triangle % 8) & 1 != 0)
    }
}
