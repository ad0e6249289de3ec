//! Triangles whose other side tells inside from outside.
//!
//! A tree stores triangles as the file winds them. Where that winding does not bound a solid, but
//! that of some triangles turned does, sides are those of the turned ones.

/// The triangles of a tree that are turned for sides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TurnedTriangles<'a> {
    /// All of them. There are no bits then.
    all: bool,
    /// One bit for each triangle, least bit first, or none.
    bits: &'a [u8],
}

impl<'a> TurnedTriangles<'a> {
    /// If a tree `is_turned`, those of the section's bits, or all if there is none. What
    /// [`are_valid`](Self::are_valid) says of them is not checked.
    pub(super) const fn new(is_turned: bool, bits: &'a [u8]) -> Self {
        Self { all: is_turned && bits.is_empty(), bits }
    }

    /// Whether a section fits the flag and a number of triangles: a bit for each, or none.
    pub(super) const fn are_valid(self, is_turned: bool, triangles: u32) -> bool {
        self.bits.is_empty() || is_turned && self.bits.len() == triangles.div_ceil(8) as usize
    }

    /// Whether the bits after those of all `triangles` are 0.
    pub(super) const fn ends_with_zeros(self, triangles: u32) -> bool {
        match self.bits.last() {
            Some(last) if !triangles.is_multiple_of(8) => *last >> (triangles % 8) == 0,
            _ => true,
        }
    }

    /// Whether all triangles are turned: the mesh is inside out as a whole.
    pub(crate) const fn are_all(self) -> bool {
        self.all
    }

    /// Whether some triangles may be turned and others not.
    pub(crate) const fn are_some(self) -> bool {
        !self.bits.is_empty()
    }

    /// Whether a triangle of the tree shows a point the side that it turns away.
    #[inline(always)]
    pub(crate) fn contains(self, triangle: u32) -> bool {
        let byte = self.bits.get(triangle as usize / 8);
        self.all || byte.is_some_and(|byte| byte >> (triangle % 8) & 1 != 0)
    }
}
