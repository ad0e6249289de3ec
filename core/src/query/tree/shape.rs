//! Leaves without slivers: how far the bound that certifies a triangle can be from its distance.

use crate::blob::Patch;
use crate::fan::WIDTH;
use glam::Vec3;

/// Squared sine of the angle between the spokes of a triangle below which it counts as a sliver here: 2^-16, a quarter of a degree.
pub(super) const SLIVER: f32 = 1.0 / 65_536.0;

/// What `certified_distance` of any other triangle lacks of the true distance is below this part of (distance + `reach`): 2^-14. It grows with
/// 1/sine; measured at the limit: 2^-15.
pub(super) const SHORTFALL: f32 = 1.0 / 16_384.0;

/// Whether no triangle of a leaf is a sliver. Triangles without area are.
pub(super) fn is_sound(patch: &Patch<'_>) -> bool {
    let (count, turn) = (patch.tag().triangles(), patch.tag().turn());
    (0..count.min(WIDTH)).all(|lane| {
        let which = usize::from(lane >= turn);
        let (e, g) = (patch.spoke(lane, which), patch.spoke(lane + 1, which));
        let normal = e.cross(g);
        square(normal) >= SLIVER * (square(e) * square(g)) && square(normal) > 0.0
    })
}

fn square(v: Vec3) -> f32 {
    v.x * v.x + v.y * v.y + v.z * v.z
}
