//! Finds leaves with slivers. The lower bound of a sliver may be far below its distance, so such a
//! leaf keeps the bound of its box.

use crate::bvh::tree::format::FanLeaf;
use crate::num::tolerance::SLIVER_SINE_SQ;

/// Whether no triangle of a leaf is a sliver. Triangles without area are slivers. `None` says that
/// the tree is unchecked.
#[cfg(meshsweep_wide)]
pub(crate) fn has_no_sliver(leaf: &FanLeaf<'_>) -> Option<bool> {
    use crate::bvh::point::leaf::distance::leaf_edges;
    use crate::bvh::tree::format::LanePoint;
    use crate::geom::fan::{Lanes, lanes_below};
    let mut slivers = Lanes::ZERO;
    let used = lanes_below(leaf.shape().triangles())?;
    // Edges do not depend on the point.
    let any_point = LanePoint::new(glam::Vec3::ZERO, [0; 3]);
    for (edges, used) in leaf_edges(leaf, &any_point)?.into_iter().zip(used) {
        let ([ex, ey, ez], [gx, gy, gz]) = (edges.e, edges.g);
        let (x, y, z) = (ey * gz - gy * ez, ez * gx - gz * ex, ex * gy - gx * ey);
        let normal = x * x + y * y + z * z;
        let sides = (ex * ex + ey * ey + ez * ez) * (gx * gx + gy * gy + gz * gz);
        let lack = Lanes::splat(SLIVER_SINE_SQ) * sides - normal;
        let fine = lack.simd_le(Lanes::ZERO) & normal.simd_gt(Lanes::ZERO);
        slivers |= !fine & used;
    }
    Some(!slivers.any())
}

/// Whether no triangle of a leaf is a sliver. Triangles without area are slivers. `None` says that
/// the tree is unchecked.
#[cfg(not(meshsweep_wide))]
pub(crate) fn has_no_sliver(leaf: &FanLeaf<'_>) -> Option<bool> {
    let square = |v: glam::Vec3| v.x * v.x + v.y * v.y + v.z * v.z;
    let (count, turn) = (leaf.shape().triangles(), leaf.shape().turn());
    let spokes = [leaf.spokes_from(0), leaf.spokes_from(leaf.shape().centres() - 1)];
    Some((0..count.min(crate::geom::fan::WIDTH)).all(|lane| {
        let spoke = &spokes[usize::from(lane >= turn)];
        let (e, g) = (spoke(lane), spoke(lane + 1));
        let normal = e.cross(g);
        SLIVER_SINE_SQ * (square(e) * square(g)) - square(normal) <= 0.0 && square(normal) > 0.0
    }))
}
