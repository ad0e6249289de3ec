//! Two trees, one of them moved: which of two nodes a descent opens, and the places of triangles.

use crate::bvh::tree::format::layout::boxes;
use crate::bvh::tree::format::{Bvh, BvhChild};
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::fan::WIDTH;
use crate::query::RelativePose;

/// Numbers in the input files of a triangle of each tree.
pub(crate) fn numbers(
    a: &Bvh<'_>,
    b: &Bvh<'_>,
    [first, second]: [TriangleAt; 2],
) -> Option<[u32; 2]> {
    Some([first.source(a)?, second.source(b)?])
}

/// The size of a node up to a factor of two: the sum of its boxes' steps, grid units.
#[inline(always)]
fn size(tree: &Bvh<'_>, node: u32) -> Option<f32> {
    let words = tree.boxes(node)?.as_chunks::<4>().0.get(boxes::STEPS / 4..)?.first_chunk::<3>()?;
    let [x, y, z] = words.map(f32::from_le_bytes);
    Some(x + y + z)
}

/// A node that is larger by this factor is opened alone.
const LARGER: f32 = 4.0;

/// Two trees and their pose, as `overlap/` and `gaps/` open them.
pub(crate) struct Models<'a> {
    pub(crate) a: &'a Bvh<'a>,
    pub(crate) b: &'a Bvh<'a>,
    pub(crate) pose: &'a RelativePose,
}

/// No search opens more pairs: on each side is a node or a child of a node, and no pair comes
/// twice. It ends searches in trees whose links were not checked.
pub(crate) fn most_pairs(a: &Bvh<'_>, b: &Bvh<'_>) -> u32 {
    let places = |tree: &Bvh<'_>| tree.most_steps().saturating_mul(1 + WIDTH as u32);
    places(a).saturating_mul(places(b))
}

impl Models<'_> {
    /// Which of two children to open: both, unless one is a leaf or much smaller.
    #[inline(always)]
    pub(crate) fn opened(&self, [first, second]: &[BvhChild; 2]) -> Option<[bool; 2]> {
        Some(match (first.is_leaf(), second.is_leaf()) {
            (false, false) => {
                let [unit_a, unit_b] = self.pose.vertices.units;
                let (x, y) = (size(self.a, first.at)? * unit_a, size(self.b, second.at)? * unit_b);
                [x * LARGER >= y, y * LARGER >= x]
            }
            (a, b) => [!a, !b],
        })
    }
}
