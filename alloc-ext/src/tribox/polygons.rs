//! The surface within a cell: every triangle clipped by the planes of the splits above (Crosnier &
//! Rossignac 1999, section 4: vertices of the first, third and fourth kind).
//!
//! *Why nothing is lost to rounding.* Let `M` be the largest coordinate, `u` = 2^-53, and let the
//! plane be moved outward by `m` = 2^-40·M. For each loop of computed corners ṽ there is a convex
//! polygon Q on the true triangle, with corners w in the same order and |w − ṽ| ≤ η, that contains
//! the triangle's true part in the cell. At first w = ṽ. A cut keeps the corners that are computed
//! to be inside of the moved plane, and where an edge leaves adds a point ṽ(t) of it; its
//! counterpart is the point of Q's edge at the same t. Those points lie on the boundary of Q in
//! order, so they are convex again. The part of Q inside of the plane itself, or up to m/2 beyond
//! it, is kept: its corners there are computed to be inside, and the edges' new ends are beyond, as
//! long as √2·η and some units 4·u·M of rounding stay below m/2. Each cut rounds a coordinate by
//! 5·u·M, so that η ≤ 2^-49·M times the number of cuts, which is [limited](super::split::DEPTH) to
//! 64. Bounds that are padded by m therefore hold the true part.
//!
//! Coordinates that no cut has changed are *exact*, and not padded: most parts have faces along the
//! axes, and stay without slivers of faces beside them.

use super::span::projections;
use crate::mesh::Mesh;
use meshsweep_core::Tribox;
use meshsweep_core::internal::num::{down_to_f32, up_to_f32};
use meshsweep_core::internal::tribox::SLABS;

/// A corner of a clipped triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub at: [f64; 3],
    /// Bit `k`: coordinate `k` is that of the true part.
    exact: u8,
}

/// Clipped triangles, as loops of corners.
#[derive(Clone, Debug, Default)]
pub(super) struct Polygons {
    pub corners: Vec<Corner>,
    /// For each loop its triangle, and where its corners end.
    pub loops: Vec<(u32, u32)>,
}

/// Half of space beyond or before a plane of one of the slabs.
#[derive(Clone, Copy, Debug)]
pub(super) struct HalfSpace {
    pub slab: usize,
    pub at: f64,
    /// Whether the lesser side is kept.
    pub is_low: bool,
}

/// Distance by which planes are moved outward, for coordinates up to `size`.
pub(super) fn margin(size: f64) -> f64 {
    size * (1.0 / (1u64 << 40) as f64)
}

impl Polygons {
    /// All triangles of a mesh, those of its wires among them.
    pub fn of(mesh: &Mesh) -> Polygons {
        let corner = |v: u32| Corner { at: mesh.positions[v as usize].map(f64::from), exact: 7 };
        let corners: Vec<Corner> = mesh.all_triangles().flatten().map(corner).collect();
        let loops = (0..corners.len() as u32 / 3).map(|t| (t, 3 * t + 3)).collect();
        Polygons { corners, loops }
    }

    /// Each loop's triangle and corners.
    pub fn iter(&self) -> impl Iterator<Item = (u32, &[Corner])> {
        let mut begin = 0;
        self.loops.iter().map(move |&(triangle, end)| {
            let corners = &self.corners[begin..end as usize];
            begin = end as usize;
            (triangle, corners)
        })
    }

    /// The part inside of a half-space whose plane is moved outward by `margin` (Sutherland &
    /// Hodgman).
    pub fn clipped(&self, half: &HalfSpace, margin: f64) -> Polygons {
        let sign = if half.is_low { 1.0 } else { -1.0 };
        let limit = sign * half.at + margin;
        let height = |corner: &Corner| sign * projections(corner.at)[half.slab];
        let mut clipped = Polygons::default();
        for (triangle, corners) in self.iter() {
            let before = clipped.corners.len();
            let Some(mut from) = corners.last() else { continue };
            let mut from_height = height(from);
            for to in corners {
                let to_height = height(to);
                if (from_height <= limit) != (to_height <= limit) {
                    clipped.corners.push(crossing(from, from_height, to, to_height, limit));
                }
                if to_height <= limit {
                    clipped.corners.push(*to);
                }
                (from, from_height) = (to, to_height);
            }
            if clipped.corners.len() > before {
                clipped.loops.push((triangle, clipped.corners.len() as u32));
            }
        }
        clipped
    }

    /// A tribox that holds the true parts of all triangles, inexact coordinates padded by `margin`,
    /// and the others too if `exact_too`.
    pub fn bound(&self, margin: f64, exact_too: bool) -> Tribox {
        let (mut low, mut high) = ([f64::INFINITY; SLABS], [f64::NEG_INFINITY; SLABS]);
        let mut put = |slab: usize, value: f64, by: f64| {
            low[slab] = low[slab].min(value - by);
            high[slab] = high[slab].max(value + by);
        };
        for Corner { at: [x, y, z], exact } in &self.corners {
            let pad = |axis: u8| if exact >> axis & 1 == 1 && !exact_too { 0.0 } else { margin };
            let [px, py, pz] = [pad(0), pad(1), pad(2)];
            put(0, *x, px);
            put(1, *y, py);
            put(2, *z, pz);
            for (slab, a, b, by) in [
                (3, *x, *y, px + py),
                (4, *x, -y, px + py),
                (5, *y, *z, py + pz),
                (6, *y, -z, py + pz),
            ] {
                put(slab, a + b, by + rounding(a, b));
            }
            put(7, z + x, pz + px + rounding(*z, *x));
            put(8, z - x, pz + px + rounding(*z, -x));
        }
        Tribox { low: low.map(down_to_f32), high: high.map(up_to_f32) }
    }
}

/// Upper bound of a sum's rounding; 0 if the sum is exact.
fn rounding(a: f64, b: f64) -> f64 {
    let sum = a + b;
    if sum - a == b && sum - b == a { 0.0 } else { sum.abs() * (2.0 * f64::EPSILON) }
}

/// Where an edge passes a plane. An exact coordinate that both ends share is exact there, too.
///
/// Both sides of an edge compute the same point from its end inside, so that neighbours keep common
/// corners.
#[inline]
fn crossing(from: &Corner, from_height: f64, to: &Corner, to_height: f64, limit: f64) -> Corner {
    let (inside, low, outside, high) = if from_height <= limit {
        (from, from_height, to, to_height)
    } else {
        (to, to_height, from, from_height)
    };
    let t = (limit - low) / (high - low);
    let mut corner = Corner { at: [0.0; 3], exact: 0 };
    for axis in 0..3 {
        let (a, b) = (inside.at[axis], outside.at[axis]);
        corner.at[axis] = a + t * (b - a);
        let both = inside.exact & outside.exact & 1 << axis;
        corner.exact |= if a == b { both } else { 0 };
    }
    corner
}
