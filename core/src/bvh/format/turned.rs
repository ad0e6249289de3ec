//! Triangles whose other side tells inside from outside.
//!
//! A tree stores triangles as the file winds them. Where that winding does not bound a solid, but
//! that of some triangles turned does, sides are those of the turned ones.

/// One bit for each triangle of a tree, least bit first, or none if no triangle is turned.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TurnedTriangles<'a>(pub(super) &'a [u8]);

impl TurnedTriangles<'_> {
    /// Whether no triangle is turned.
    pub(crate) const fn is_empty(self) -> bool {
        self.0.is_empty()
    }

    /// Whether a triangle of the tree shows a point the side that it turns away.
    #[inline(always)]
    pub(crate) fn contains(self, triangle: u32) -> bool {
        let byte = self.0.get(triangle as usize / 8);
        byte.is_some_and(|byte| byte >> (triangle % 8) & 1 != 0)
    }

    /// Whether the bits after those of all `triangles` are 0.
    pub(super) const fn ends_with_zeros(self, triangles: u32) -> bool {
        match self.0.last() {
            Some(last) if !triangles.is_multiple_of(8) => *last >> (triangles % 8) == 0,
            _ => true,
        }
    }
}
