//! Which side of a triangle of the grid a point sees, where f32 shows it plainly.
//!
//! The side is the sign of a triple product, whose square is compared with that of its rounding
//! (`core/docs/rounding.md` §8, Facing).

#[cfg(not(meshsweep_wide))]
use crate::bvh::tree::format::FanLeaf;
#[cfg(not(meshsweep_wide))]
use crate::geom::fan::{PointFan, WIDTH};
use crate::num::tolerance::{PLAIN_SIDE_FLOOR, PLAIN_SIDE_SQ};
use glam::Vec3;

/// The square that a plain triple product exceeds, from the product of the three squares.
#[inline(always)]
fn least_square(squares: f32) -> f32 {
    PLAIN_SIDE_SQ * squares + PLAIN_SIDE_FLOOR
}

/// Whether the front in the fan's winding is seen, if that is plain. For the vectors see
/// [`seen_from`](super::bounds::seen_from).
#[inline(always)]
pub(crate) fn is_plainly_in_front(&[s, e, g]: &[Vec3; 3]) -> Option<bool> {
    let volume = e.cross(g).dot(s);
    let is_plain = volume * volume > least_square(e.dot(e) * g.dot(g) * s.dot(s));
    if is_plain { Some(volume > 0.0) } else { None }
}

/// Those of a fan's triangles whose closest point is the centre, and that plainly show this side:
/// the front in the fan's winding, or the back. `None` says that the tree is unchecked.
#[cfg(not(meshsweep_wide))]
#[inline(never)]
pub(crate) fn showing_at_centre(
    leaf: &FanLeaf<'_>,
    which: usize,
    &PointFan { s, centre_sq }: &PointFan,
    mut lanes: u32,
    is_front: bool,
) -> Option<u32> {
    if leaf.is_f32() {
        return Some(0);
    }
    let sign = if is_front { 1.0 } else { -1.0 };
    let ring = leaf.full_ring()?;
    let [cx, cy, cz] = ring.centre(which);
    let spoke = |i: usize| {
        let [x, y, z] = ring.vertex(i)?;
        let less = |x: i32, cx: i32| x.wrapping_sub(cx) as f32;
        let edge = Vec3::new(less(x, cx), less(y, cy), less(z, cz));
        Some((edge, edge.dot(s), edge.dot(edge)))
    };
    let lowest = |lanes: u32| lanes.trailing_zeros() as usize & (WIDTH - 1);
    let (mut showing, mut lane) = (0, lowest(lanes));
    let mut first = spoke(lane)?;
    loop {
        let second = spoke(lane + 1)?;
        let ((e, e_along, e_sq), (g, g_along, g_sq)) = (first, second);
        if e_along <= 0.0 && g_along <= 0.0 {
            let volume = e.cross(g).dot(s);
            // With its sign the square tells the side too.
            if volume * sign * volume.abs() > least_square(e_sq * g_sq * centre_sq) {
                showing |= lanes & lanes.wrapping_neg();
            }
        }
        lanes &= lanes - 1;
        if lanes == 0 {
            return Some(showing);
        }
        let next = lowest(lanes);
        first = if next == lane + 1 { second } else { spoke(next)? };
        lane = next;
    }
}
