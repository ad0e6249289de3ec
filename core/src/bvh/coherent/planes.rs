//! Planes between a moving query and the leaves around it.
//!
//! A leaf lies beyond its plane wherever the query moves. So the distance of the query from the
//! plane stays a lower bound of the leaf's distance. After a step this bound loses only the order
//! of the step's square. The bound by path length (Guéziec 2000, 5.1) loses the whole step. To make
//! a plane costs as much as half a leaf. To use it costs six products.

use super::front::Child;
use crate::bvh::format::{Bvh, FanLeaf};
use crate::bvh::node::in_memory;
use crate::geom::fan::{Edges8, LANES_BELOW, WIDTH};
use crate::num::tolerance::{PLANE_NORMAL, SHORTFALL};
use crate::num::{greater, lesser, of_eight, sqrt_approx};
use glam::Vec3;

/// Planes of a coherent query: a power of two.
const PLANES: usize = 32;

/// A leaf's distance is at least `normal·(p − middle) − offset`, up to the error of a box's bound.
#[derive(Clone, Copy, Debug)]
struct Plane {
    normal: Vec3,
    offset: f32,
    of: u32,
}

/// Planes of leaves that were visited lately: a hash table, where a later leaf overwrites an
/// earlier one in the same place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Planes([Plane; PLANES]);

impl Planes {
    /// No leaf has a plane.
    pub(crate) const EMPTY: Planes =
        Planes([Plane { normal: Vec3::ZERO, offset: 0.0, of: u32::MAX }; PLANES]);

    /// Lower bound of the distance of a leaf, grid units. Negative without a plane. `way` leads
    /// from the model's middle to the query.
    #[inline(always)]
    pub(crate) fn bound(&self, child: Child, way: Vec3) -> f32 {
        match self.0.get(place(child)) {
            Some(plane) if plane.of == child.without_bound() => {
                dot(plane.normal, way) - plane.offset
            }
            _ => -1.0,
        }
    }

    /// Puts a plane between a leaf without slivers and the query, across the way from the leaf's
    /// closest point, on triangle `lane`. `way` as above. `margin` is the error of triangles'
    /// bounds, beside [`SHORTFALL`] of themselves.
    #[inline(always)]
    pub(crate) fn put(
        &mut self,
        child: Child,
        leaf: &VisitedLeaf<'_>,
        way: Vec3,
        near: At,
        margin: f32,
    ) {
        let found = match leaf.edges {
            Some(edges) => separate_wide(edges, leaf.fans.shape().triangles(), near),
            None => separate_narrow(leaf.fans, leaf.p, near),
        };
        if let Some((normal, distance)) = found
            && let Some(plane) = self.0.get_mut(place(child))
        {
            *plane = Plane {
                normal,
                offset: dot(normal, way) - distance + margin,
                of: child.without_bound(),
            };
        }
    }
}

/// A leaf that was visited from the point `p`, and on vector targets its edges as they were read.
pub(crate) struct VisitedLeaf<'a> {
    pub(crate) fans: &'a FanLeaf<'a>,
    pub(crate) p: Vec3,
    pub(crate) edges: Option<&'a Edges8>,
}

/// A point of a triangle of a leaf: the lane, and coordinates along the spokes.
pub(crate) type At = (usize, f32, f32);

/// The direction of `residual`, slightly shorter than 1. So a length along it is below the computed
/// distance and below the lower bound.
#[inline(always)]
fn normal(residual: Vec3) -> Option<Vec3> {
    let length = sqrt_approx(dot(residual, residual));
    if length > 1.0 / 1024.0 {
        Some(residual * ((1.0 - SHORTFALL) * (1.0 - PLANE_NORMAL) / length))
    } else {
        None
    }
}

/// The direction from a leaf's point to `p`, and the distance along it between `p` and the leaf.
#[inline(always)]
fn separate_wide(edges: &Edges8, triangles: usize, (lane, v, w): At) -> Option<(Vec3, f32)> {
    let Edges8 { e: [ex, ey, ez], g: [gx, gy, gz], s: [sx, sy, sz] } = edges;
    let at = |x: &[f32; WIDTH], y: &[f32; WIDTH], z: &[f32; WIDTH]| {
        Some(Vec3::new(*x.get(lane)?, *y.get(lane)?, *z.get(lane)?))
    };
    let n = normal(at(sx, sy, sz)? - at(ex, ey, ez)? * v - at(gx, gy, gz)? * w)?;
    let used = LANES_BELOW.get(triangles)?;
    let mut along = [0f32; WIDTH];
    for i in 0..WIDTH {
        let first = n.x * ex[i] + n.y * ey[i] + n.z * ez[i];
        let second = n.x * gx[i] + n.y * gy[i] + n.z * gz[i];
        let centre = n.x * sx[i] + n.y * sy[i] + n.z * sz[i];
        let beyond = if first > 0.0 { first } else { 0.0 };
        let beyond = greater(beyond, second);
        // An unused lane may hold any value. A large one keeps it from being the least.
        along[i] =
            f32::from_bits((centre - beyond).to_bits() & used[i] | f32::MAX.to_bits() & !used[i]);
    }
    Some((n, of_eight(in_memory(along), lesser)))
}

/// The same, vertex by vertex.
#[inline(never)]
fn separate_narrow(leaf: &FanLeaf<'_>, p: Vec3, (lane, v, w): At) -> Option<(Vec3, f32)> {
    let (count, turn) = (leaf.shape().triangles(), leaf.shape().turn());
    let which = usize::from(lane >= turn);
    let from = p - leaf.centre(which);
    let n = normal(from - leaf.spoke(lane, which) * v - leaf.spoke(lane + 1, which) * w)?;
    let other = p - leaf.centre(leaf.shape().centres() - 1 - which.min(leaf.shape().centres() - 1));
    let along = dot(n, from);
    let nearest = (0..=count).fold(0.0, |least, i| lesser(least, -dot(n, leaf.spoke(i, which))));
    Some((n, lesser(along + nearest, dot(n, other))))
}

/// The middle of the model's box. Planes are measured from it, so that rounding is in proportion to
/// the model's size, not to its distance from the origin.
#[inline(always)]
pub(crate) fn middle(tree: &Bvh<'_>) -> Vec3 {
    (tree.scale().low + tree.scale().high) * 0.5
}

/// Leaves of a node get different places.
#[inline(always)]
fn place(child: Child) -> usize {
    (child.without_bound() >> 8).wrapping_mul(5).wrapping_add(child.lane()) as usize % PLANES
}

#[inline(always)]
fn dot(a: Vec3, b: Vec3) -> f32 {
    a.x * b.x + a.y * b.y + a.z * b.z
}
