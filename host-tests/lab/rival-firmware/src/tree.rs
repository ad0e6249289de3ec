//! The box tree as a program would use it: the blob read where it lies, stacks that the caller
//! owns.

use meshsweep_core::{
    Budget, Bvh, ClosestPoint, CoherentQuery, Facing, FirstHit, OpenError, ScratchEntry,
};

/// Entries of the stack: what trees of so many triangles ask for, and some more.
const STACK: usize = 64;

/// Entries of the session's front.
const FRONT: usize = 64;

/// An opened tree, and memory for its queries.
pub struct BoxTree {
    tree: Bvh<'static>,
    stack: [ScratchEntry; STACK],
    session: CoherentQuery<'static, FRONT>,
}

impl BoxTree {
    /// Opens a blob; all of it is checked.
    #[inline(never)]
    pub fn open(blob: &'static [u8]) -> Result<Self, OpenError> {
        Ok(Self {
            tree: Bvh::open(blob)?,
            stack: [ScratchEntry::EMPTY; STACK],
            session: CoherentQuery::new(),
        })
    }

    /// Bytes that a query needs beside the processor's stack: the opened tree and the entries that
    /// the blob asks for. `None` if these are more than there are.
    #[allow(dead_code, reason = "images that are never started do not ask")]
    pub fn memory(&self) -> Option<usize> {
        let entries = self.tree.header().stack_entries as usize;
        (entries <= STACK).then_some(size_of::<Bvh<'_>>() + entries * size_of::<ScratchEntry>())
    }

    /// Closest point of the surface.
    #[allow(dead_code, reason = "each image asks its own questions")]
    #[inline(never)]
    pub fn closest(&mut self, point: [f32; 3]) -> Option<ClosestPoint> {
        self.tree.closest_point(point, Budget::EXACT, &mut self.stack).ok()
    }

    /// Closest point of the surface to a point near the one before.
    #[allow(dead_code, reason = "each image asks its own questions")]
    #[inline(never)]
    pub fn follow(&mut self, point: [f32; 3]) -> Option<ClosestPoint> {
        Some(
            self.session
                .closest_point(&self.tree, point, Budget::EXACT, &mut self.stack)
                .ok()?
                .closest,
        )
    }

    /// First hit of a segment.
    #[allow(dead_code, reason = "each image asks its own questions")]
    #[inline(never)]
    pub fn first_hit(&mut self, a: [f32; 3], b: [f32; 3]) -> Option<FirstHit> {
        self.tree.first_hit(a, b, Facing::Both, Budget::EXACT, &mut self.stack).ok()
    }
}
