//! Leaves without slivers: how far the bound that certifies a triangle can be from its distance.

use crate::bvh::format::FanLeaf;
use crate::bvh::node::{WIDE, in_memory};
use crate::geom::fan::{Edges8, LANES_BELOW, WIDTH};
use glam::Vec3;

/// Squared sine of the angle between the spokes of a triangle below which it counts as a sliver
/// here: 2^-16, a quarter of a degree.
pub(crate) const SLIVER: f32 = 1.0 / 65_536.0;

/// What `lower_bound` of any other triangle lacks of the true distance is below this part of
/// (distance + `reach`): 2^-14. It grows with 1/sine; measured at the limit: 2^-15.
pub(crate) const SHORTFALL: f32 = 1.0 / 16_384.0;

/// Whether no triangle of a leaf is a sliver. Triangles without area are. `None`: the leaf is not
/// one of a tree that was opened.
pub(crate) fn is_sound(patch: &FanLeaf<'_>) -> Option<bool> {
    if !WIDE {
        let (count, turn) = (patch.tag().triangles(), patch.tag().turn());
        return Some((0..count.min(WIDTH)).all(|lane| {
            let which = usize::from(lane >= turn);
            let (e, g) = (patch.spoke(lane, which), patch.spoke(lane + 1, which));
            let normal = e.cross(g);
            SLIVER * (square(e) * square(g)) - square(normal) <= 0.0 && square(normal) > 0.0
        }));
    }
    let edges = if patch.is_f32() {
        patch.single_edges8(Vec3::ZERO)?
    } else {
        patch.grid_edges8(Vec3::ZERO)?
    };
    let Edges8 { e: [ex, ey, ez], g: [gx, gy, gz], .. } = &edges;
    let used = LANES_BELOW.get(patch.tag().triangles())?;
    let mut excess = [0f32; WIDTH];
    for i in 0..WIDTH {
        let (ex, ey, ez, gx, gy, gz) = (ex[i], ey[i], ez[i], gx[i], gy[i], gz[i]);
        let (x, y, z) = (ey * gz - gy * ez, ez * gx - gz * ex, ex * gy - gx * ey);
        let normal = x * x + y * y + z * z;
        let sides = (ex * ex + ey * ey + ez * ez) * (gx * gx + gy * gy + gz * gz);
        // Not a sliver where it is negative, and an unused lane may hold anything.
        let lack = SLIVER * sides - normal;
        let lack = if normal > 0.0 { lack } else { 1.0 };
        excess[i] = f32::from_bits(lack.to_bits() & used[i]);
    }
    let [a, b, c, d, e, f, g, h] = in_memory(excess);
    let most = |a: f32, b: f32| if b > a { b } else { a };
    Some(most(most(most(a, e), most(b, f)), most(most(c, g), most(d, h))) <= 0.0)
}

fn square(v: Vec3) -> f32 {
    v.x * v.x + v.y * v.y + v.z * v.z
}
