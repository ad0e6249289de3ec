//! Whether a point is outside a hull: by how many faces a ray from it crosses, in integers.
//!
//! The winding number of a hull is 0 or 1 around every point clear of it. So it is 0 if the ray
//! crosses an even number of faces. Neither a small move of the point nor a small move of the hull
//! changes it, as long as they never touch. So the point moves to odd multiples of 1/256 grid unit:
//! no vertex has such a coordinate, and no case is special. Vertices in f32 move to the grid.
//!
//! The ray runs along x. Seen along it, the point is within a face if an odd number of the face's
//! edges cross the ray from the point along z. An edge is looked at from its lower end. So both of
//! its faces say the same: `core/docs/rounding.md` §12.

use crate::bvh::tree::format::layout::boxes;
use crate::bvh::tree::format::{Bvh, FanLeaf, LeafShape, lanes_of};
use crate::geom::fan::WIDTH;
use crate::num::tolerance::{RAY_MOVED, RAY_MOVED_F32};
use crate::num::{Real, float, floored};

/// Parts of a grid unit that places are whole numbers of, as a power of two.
const FINE: i32 = 8;

/// Whether a point so far from the hull, in input units, has a [side](is_outside).
pub(super) fn has_side(tree: &Bvh<'_>, lower: f32) -> bool {
    let moved = if tree.header().is_f32() { RAY_MOVED_F32 } else { RAY_MOVED };
    tree.is_closed() && Real(tree.units().inward(lower)) >= Real(moved)
}

/// Whether a point within the hull's box (input units) is outside the hull. It [has a
/// side](has_side). `None`: the tree is unchecked.
#[inline(never)]
pub(super) fn is_outside(tree: &Bvh<'_>, point: [f32; 3]) -> Option<bool> {
    let (units, header) = (tree.units(), tree.header());
    let [mut x, mut y, mut z] = header.grid_origin;
    for (place, of) in [&mut x, &mut y, &mut z].into_iter().zip(point) {
        let within = Real(units.inward(of)) - Real(float(*place));
        *place = floored(within.0, FINE) | 1;
    }
    let place = [x, y, z];
    let mut is_odd = false;
    // Bits of the first nodes that the ray misses. Nodes come before their children.
    let mut missed = 0u64;
    for node in 0..header.nodes {
        let links = tree.links(node)?;
        let is_missed = node < u64::BITS && missed >> node & 1 != 0;
        let met = if is_missed { 0 } else { children_met(tree, node, place)? };
        for inner in 0..links.inner {
            let child = links.first_node.wrapping_add(inner);
            if met >> (inner & 31) & 1 == 0 && child < u64::BITS {
                missed |= 1 << child;
            }
        }
        let mut at = links.first_vertex;
        for index in links.inner..links.count {
            let shape = links.shape(index);
            if met >> (index & 31) & 1 != 0 {
                let lanes = if header.is_f32() {
                    f32_maybe_crossed(tree, (at, shape), place)?
                } else {
                    maybe_crossed::<false>(&tree.leaf_at(at, shape)?, place)?
                };
                if lanes != 0 {
                    is_odd ^= crosses_oddly(tree, (at, shape), lanes, place)?;
                }
            }
            at = at.wrapping_add(shape.vertices() as u32);
        }
    }
    Some(!is_odd)
}

/// Bits of a node's children whose boxes the ray may meet, and of some others. All, if the tree has
/// no boxes along the axes.
#[inline(always)]
fn children_met(tree: &Bvh<'_>, node: u32, place: [i32; 3]) -> Option<u32> {
    let Some(record) = tree.boxes(node) else { return Some(u32::MAX) };
    let header = tree.header();
    // Vertices in f32 moved down by less than this.
    let below = if header.is_f32() { 2 << FINE } else { 0 };
    let rows = record.as_chunks::<WIDTH>().0.first_chunk::<6>()?;
    let words = record.as_chunks::<4>().0.get(boxes::ORIGIN / 4..)?.first_chunk::<6>()?;
    let ([lx, hx, ly, hy, lz, hz], [ox, oy, oz, ux, uy, uz]) = (rows, words);
    let ([x, y, z], [from_x, from_y, from_z]) = (place, header.grid_origin);
    let mut met = u32::MAX;
    for (low, high, origin, step, from, place, least) in [
        (ly, hy, oy, uy, from_y, y, Some(y + below)),
        (lz, hz, oz, uz, from_z, z, Some(z + below)),
        (lx, hx, ox, ux, from_x, x, None),
    ] {
        // A whole number of the grid, and a power of two.
        let from = floored(f32::from_le_bytes(*origin), 0).wrapping_sub(from) << FINE;
        let step = (u32::from_le_bytes(*step) >> 23).cast_signed() - 127 + FINE;
        if step < FINEST_STEP {
            continue;
        }
        let byte = |x: i32| {
            let (away, places) = (x.wrapping_sub(from), step.unsigned_abs().min(31));
            let steps =
                if step < 0 { away.wrapping_shl(places) } else { away.wrapping_shr(places) };
            steps.saturating_add(128)
        };
        let (most, least) = (byte(place), least.map_or(i32::MAX, byte));
        let mut here = 0;
        for (low, high) in low.iter().zip(high).rev() {
            let is_met = i32::from(*low) <= least && i32::from(*high) >= most;
            here = here << 1 | u32::from(is_met);
        }
        met &= here;
        if met == 0 {
            break;
        }
    }
    Some(met)
}

/// A step of a node's boxes, as an exponent of [fine](FINE) units, whose bytes leave 32 bits if it
/// is less: 2^25 of these units go across a hull.
const FINEST_STEP: i32 = -5;

/// Bits of the triangles of a leaf whose boxes the ray meets.
#[inline(always)]
fn maybe_crossed<const IS_F32: bool>(leaf: &FanLeaf<'_>, place: [i32; 3]) -> Option<u32> {
    let shape = leaf.shape();
    let first_fan = !(u32::MAX << (shape.turn() & 31));
    // Of each triangle whether its corners have greater coordinates: some, and not all.
    let along = |axis: usize| {
        let floor = place[axis] >> FINE;
        let above = if IS_F32 { leaf.f32_above(axis, floor) } else { leaf.above(axis, floor) };
        let (above, one, other) = above?;
        let centre = one.wrapping_neg() & first_fan | other.wrapping_neg() & !first_fan;
        let some = above | above >> 1 | centre;
        Some((some, some & !(above & above >> 1 & centre)))
    };
    let mut lanes = along(1)?.1 & !(u32::MAX << (shape.triangles() & 31));
    if lanes != 0 {
        lanes &= along(2)?.1;
    }
    if lanes != 0 {
        lanes &= along(0)?.0;
    }
    Some(lanes)
}

/// [`maybe_crossed`] as a call, so that leaves on the grid keep all registers.
#[cold]
#[inline(never)]
fn f32_maybe_crossed(
    tree: &Bvh<'_>,
    (at, shape): (u32, LeafShape),
    place: [i32; 3],
) -> Option<u32> {
    maybe_crossed::<true>(&tree.leaf_at(at, shape)?, place)
}

/// Whether the ray crosses an odd number of the triangles of a leaf whose bits in `lanes` are ones.
/// Vertices in f32 move down to the grid.
#[inline(never)]
fn crosses_oddly(
    tree: &Bvh<'_>,
    (at, shape): (u32, LeafShape),
    lanes: u32,
    place: [i32; 3],
) -> Option<bool> {
    let leaf = tree.leaf_at(at, shape)?;
    let mut is_odd = false;
    for lane in lanes_of(lanes) {
        let mut corners = [[0; 3]; 3];
        if leaf.is_f32() {
            for (corner, stored) in corners.iter_mut().zip(leaf.stored_corners(lane)) {
                let stored = stored.to_array().into_iter().zip(leaf.origin);
                for (x, (of, origin)) in corner.iter_mut().zip(stored) {
                    *x = floored((Real(of) - Real(float(origin))).0, 0).clamp(0, 0xFFFF);
                }
            }
        } else {
            corners = leaf.grid_ring()?.corners(lane, shape.turn())?;
        }
        is_odd ^= is_crossed(&corners, place);
    }
    Some(is_odd)
}

/// Whether the ray crosses a triangle. Corners have 16 bits.
#[inline(never)]
fn is_crossed(corners: &[[i32; 3]; 3], place: [i32; 3]) -> bool {
    let [a, b, c] = corners.map(|corner| {
        let fine = |axis: usize| (corner[axis] << FINE).wrapping_sub(place[axis]);
        [fine(0), fine(1), fine(2)]
    });
    let mut is_within = false;
    for ([_, y, z], [_, next_y, next_z]) in [(a, b), (b, c), (c, a)] {
        if (y > 0) != (next_y > 0) {
            let turn = product(z, next_y) - product(next_z, y);
            is_within ^= if y < 0 { turn > 0 } else { turn < 0 };
        }
    }
    if !is_within || a[0] < 0 && b[0] < 0 && c[0] < 0 {
        return false;
    }
    if a[0] > 0 && b[0] > 0 && c[0] > 0 {
        return true;
    }
    let [corner, e, g] = corners;
    let edge = |to: &[i32; 3]| [to[0] - corner[0], to[1] - corner[1], to[2] - corner[2]];
    let (e, g) = (edge(e), edge(g));
    let normal = |j: usize, k: usize| product(e[j], g[k]) - product(e[k], g[j]);
    let normal = [normal(1, 2), normal(2, 0), normal(0, 1)];
    let side: i64 = (0..3).map(|axis| normal[axis] * i64::from(a[axis])).sum();
    side != 0 && (side > 0) == (normal[0] > 0)
}

fn product(a: i32, b: i32) -> i64 {
    i64::from(a) * i64::from(b)
}
