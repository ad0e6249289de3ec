//! Planes between a moving query and the leaves around it.
//!
//! A leaf lies beyond its plane wherever the query moves. So the distance of the query from the
//! plane stays a lower bound of the leaf's distance. After a step this bound loses only the order
//! of the step's square. The bound by path length (Guéziec 2000, 5.1) loses the whole step. To make
//! a plane costs as much as half a leaf. To use it costs four products.

use super::front::Child;
use crate::bvh::point::leaf::distance::LeafEdges;
use crate::bvh::tree::format::{Bvh, FanLeaf};
use crate::num::tolerance::{PLANE_NORMAL, SHORTFALL};
use crate::num::{dot, lesser, sqrt_approx};
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

    /// Lower bound of the distance of a leaf, grid units. Negative without a plane. `from_middle`
    /// leads from the model's middle to the query.
    #[inline(always)]
    pub(crate) fn bound(&self, child: Child, from_middle: Vec3) -> f32 {
        match self.0.get(slot_of(child)) {
            Some(plane) if plane.of == child.without_bound() => {
                dot(plane.normal, from_middle) - plane.offset
            }
            _ => -1.0,
        }
    }

    /// Puts a plane between a leaf without slivers and the query, across the way from the leaf's
    /// closest point, on triangle `lane`. `from_middle` as above. `margin` is the error of a
    /// triangle's bound, in addition to the part [`SHORTFALL`] of the bound.
    #[inline(always)]
    pub(crate) fn put(
        &mut self,
        child: Child,
        leaf: &VisitedLeaf<'_>,
        from_middle: Vec3,
        near: At,
        margin: f32,
    ) {
        let found = match leaf.edges {
            #[cfg(meshsweep_wide)]
            Some(edges) => separate_wide(edges, leaf.fans.shape().triangles(), near),
            #[cfg(not(meshsweep_wide))]
            Some(never) => match *never {},
            None => separate_narrow(leaf.fans, leaf.p, near),
        };
        if let Some((normal, distance)) = found
            && let Some(plane) = self.0.get_mut(slot_of(child))
        {
            *plane = Plane {
                normal,
                offset: dot(normal, from_middle) - distance + margin,
                of: child.without_bound(),
            };
        }
    }
}

/// A leaf that was visited from the point `p`, and on vector targets its edges as they were read.
pub(crate) struct VisitedLeaf<'a> {
    pub(crate) fans: &'a FanLeaf<'a>,
    pub(crate) p: Vec3,
    pub(crate) edges: Option<&'a LeafEdges>,
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
#[cfg(meshsweep_wide)]
#[inline(always)]
fn separate_wide(edges: &LeafEdges, triangles: usize, (lane, v, w): At) -> Option<(Vec3, f32)> {
    use crate::geom::fan::{LANES, Lanes, PIECES, lanes_below, least};
    let here = edges.get(lane / LANES)?;
    let at = |[x, y, z]: [Lanes; 3]| {
        let [x, y, z] = [x, y, z].map(|x| x.to_array()[lane % LANES]);
        Vec3::new(x, y, z)
    };
    let n = normal(at(here.s) - at(here.e) * v - at(here.g) * w)?;
    let along = |[x, y, z]: [Lanes; 3]| {
        Lanes::splat(n.x) * x + Lanes::splat(n.y) * y + Lanes::splat(n.z) * z
    };
    // An unused lane may hold any value. A large one keeps it from being the least.
    let mut out = [Lanes::splat(f32::MAX); PIECES];
    for ((out, edges), used) in out.iter_mut().zip(edges).zip(lanes_below(triangles)?) {
        let beyond = along(edges.g).fast_max(along(edges.e).fast_max(Lanes::ZERO));
        *out = used.select(along(edges.s) - beyond, *out);
    }
    Some((n, least(out)))
}

/// The same, vertex by vertex.
#[inline(never)]
fn separate_narrow(leaf: &FanLeaf<'_>, p: Vec3, (lane, v, w): At) -> Option<(Vec3, f32)> {
    let (count, turn) = (leaf.shape().triangles(), leaf.shape().turn());
    let which = usize::from(lane >= turn);
    let spoke = leaf.spokes_from(which);
    let from = p - leaf.centre(which);
    let n = normal(from - spoke(lane) * v - spoke(lane + 1) * w)?;
    let other = p - leaf.centre(leaf.shape().centres() - 1 - which.min(leaf.shape().centres() - 1));
    let along = dot(n, from);
    let nearest = (0..=count).fold(0.0, |least, i| lesser(least, -dot(n, spoke(i))));
    Some((n, lesser(along + nearest, dot(n, other))))
}

/// The middle of the model's box. Planes are measured from it, so that rounding is in proportion to
/// the model's size, not to its distance from the origin.
#[inline(always)]
pub(crate) fn middle(tree: &Bvh<'_>) -> Vec3 {
    let (low, high) = tree.grid_bounds();
    (low + high) * 0.5
}

/// Leaves of a node get different places.
#[inline(always)]
fn slot_of(child: Child) -> usize {
    (child.without_bound() >> 8).wrapping_mul(5).wrapping_add(child.index()) as usize % PLANES
}
