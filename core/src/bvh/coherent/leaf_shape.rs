//! Finds leaves with slivers. The lower bound of a sliver may be far below its distance, so such a
//! leaf keeps the bound of its box.

use crate::bvh::format::FanLeaf;
use crate::bvh::node::{WIDE, in_memory};
use crate::geom::fan::{Edges8, LANES_BELOW, WIDTH};
use crate::num::tolerance::SLIVER_SINE_SQ;
use crate::num::{greater, of_eight};
use glam::Vec3;

/// Whether no triangle of a leaf is a sliver. Triangles without area are slivers. `None` says that
/// the tree is unchecked.
pub(crate) fn has_no_sliver(leaf: &FanLeaf<'_>) -> Option<bool> {
    if !WIDE {
        let (count, turn) = (leaf.shape().triangles(), leaf.shape().turn());
        return Some((0..count.min(WIDTH)).all(|lane| {
            let which = usize::from(lane >= turn);
            let (e, g) = (leaf.spoke(lane, which), leaf.spoke(lane + 1, which));
            let normal = e.cross(g);
            SLIVER_SINE_SQ * (square(e) * square(g)) - square(normal) <= 0.0 && square(normal) > 0.0
        }));
    }
    let edges =
        if leaf.is_f32() { leaf.f32_edges8(Vec3::ZERO)? } else { leaf.grid_edges8(Vec3::ZERO)? };
    let Edges8 { e: [ex, ey, ez], g: [gx, gy, gz], .. } = &edges;
    let used = LANES_BELOW.get(leaf.shape().triangles())?;
    let mut excess = [0f32; WIDTH];
    for i in 0..WIDTH {
        let (ex, ey, ez, gx, gy, gz) = (ex[i], ey[i], ez[i], gx[i], gy[i], gz[i]);
        let (x, y, z) = (ey * gz - gy * ez, ez * gx - gz * ex, ex * gy - gx * ey);
        let normal = x * x + y * y + z * z;
        let sides = (ex * ex + ey * ey + ez * ez) * (gx * gx + gy * gy + gz * gz);
        // Not a sliver where it is negative, and an unused lane may hold anything.
        let lack = SLIVER_SINE_SQ * sides - normal;
        let lack = if normal > 0.0 { lack } else { 1.0 };
        excess[i] = f32::from_bits(lack.to_bits() & used[i]);
    }
    Some(of_eight(in_memory(excess), greater) <= 0.0)
}

fn square(v: Vec3) -> f32 {
    v.x * v.x + v.y * v.y + v.z * v.z
}
