//! Planes between a moving query and the leaves around it.
//!
//! That a leaf lies beyond a plane does not depend on where the query is. So a plane across the way
//! to a leaf bounds the leaf's distance wherever the query goes, and as the query moves by a step
//! it loses only a part of the order of the step's square, where path length (Guéziec 2000, 5.1)
//! loses the whole step. One plane costs as much as half a leaf, asking it six products.

use super::front::Child;
use crate::bvh::format::{Bvh, FanLeaf};
use crate::bvh::node::in_memory;
use crate::geom::fan::{Edges8, LANES_BELOW, WIDTH};
use crate::num::sqrt_approx;
use crate::num::tolerance::{PLANE_NORMAL, SHORTFALL};
use glam::Vec3;

/// Planes that a session holds: a power of two.
const PLANES: usize = 32;

/// A leaf's distance is at least `normal·(p − middle) − offset`, up to what a box's bound may be
/// off by.
#[derive(Clone, Copy, Debug)]
struct Plane {
    normal: Vec3,
    offset: f32,
    of: u32,
}

/// The planes of the leaves that were looked at lately, each at a place that its leaf decides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Planes([Plane; PLANES]);

impl Planes {
    /// Says nothing.
    pub(crate) const EMPTY: Planes =
        Planes([Plane { normal: Vec3::ZERO, offset: 0.0, of: u32::MAX }; PLANES]);

    /// A lower bound, grid units, of the distance of a leaf; negative if nothing is known. `way`
    /// leads to the query from the model's middle.
    #[inline(always)]
    pub(crate) fn bound(&self, child: Child, way: Vec3) -> f32 {
        match self.0.get(place(child)) {
            Some(plane) if plane.of == child.leaf() => dot(plane.normal, way) - plane.offset,
            _ => -1.0,
        }
    }

    /// Puts a plane between a leaf without slivers and the query: across the way from its closest
    /// point, on triangle `lane`. `way` as above; `margin` is what triangles' bounds may be off
    /// by, beside [`SHORTFALL`] of themselves.
    #[inline(always)]
    pub(crate) fn put(
        &mut self,
        child: Child,
        leaf: &Looked<'_>,
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
            *plane =
                Plane { normal, offset: dot(normal, way) - distance + margin, of: child.leaf() };
        }
    }
}

/// A leaf as it was looked at from `p`, and its triangles side by side where all were read at once.
pub(crate) struct Looked<'a> {
    pub(crate) fans: &'a FanLeaf<'a>,
    pub(crate) p: Vec3,
    pub(crate) edges: Option<&'a Edges8>,
}

/// A point of a triangle of a leaf: its lane, and coordinates along its spokes.
pub(crate) type At = (usize, f32, f32);

/// A direction a little shorter than 1, so that what is measured along it is less than the
/// distance, also of a sliver's certificate.
#[inline(always)]
fn normal(residual: Vec3) -> Option<Vec3> {
    let length = sqrt_approx(dot(residual, residual));
    if length > 1.0 / 1024.0 {
        Some(residual * ((1.0 - SHORTFALL) * (1.0 - PLANE_NORMAL) / length))
    } else {
        None
    }
}

/// The direction from a leaf's point to `p`, and how far `p` is along it from all of the leaf.
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
        let beyond = if second > beyond { second } else { beyond };
        // An unused lane may hold anything: large.
        along[i] =
            f32::from_bits((centre - beyond).to_bits() & used[i] | f32::MAX.to_bits() & !used[i]);
    }
    let [a, b, c, d, e, f, g, h] = in_memory(along);
    Some((n, less(less(less(a, e), less(b, f)), less(less(c, g), less(d, h)))))
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
    let nearest = (0..=count).fold(0.0, |least, i| less(least, -dot(n, leaf.spoke(i, which))));
    Some((n, less(along + nearest, dot(n, other))))
}

/// The middle of the model's box, from which planes are measured: rounding counts in model sizes,
/// wherever the origin is.
#[inline(always)]
pub(crate) fn middle(tree: &Bvh<'_>) -> Vec3 {
    (tree.scale().low + tree.scale().high) * 0.5
}

/// Leaves of a node get different places.
#[inline(always)]
fn place(child: Child) -> usize {
    (child.leaf() >> 8).wrapping_mul(5).wrapping_add(child.lane()) as usize % PLANES
}

#[inline(always)]
fn dot(a: Vec3, b: Vec3) -> f32 {
    a.x * b.x + a.y * b.y + a.z * b.z
}

#[inline(always)]
fn less(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}
