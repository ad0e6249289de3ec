//! Which side of a triangle a point sees.
//!
//! The side is the sign of a triple product. In f32 it counts if the product exceeds its rounding.
//! Two cheaper tests come first. They decide only what the f32 test decides too, in the same way
//! (`core/docs/rounding.md` §8, Facing).

use crate::bvh::point::leaf::bounds::seen_from;
use crate::bvh::point::leaf::plain_side::is_plainly_in_front;
use crate::bvh::point::query::PointQuery;
use crate::bvh::tree::format::{Bvh, FanLeaf};
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::fan::{is_in_front, is_integer};
use crate::geom::norm_1;
use crate::num::SOFT_FLOAT;
use crate::num::tolerance::{EXACT_INTEGERS, SIGN_TRIPLE_PRODUCT, U32};
use glam::Vec3;

/// Which side of a triangle is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ViewedSide {
    Front = 0,
    Back = 1,
    /// Rounding leaves the side undecided.
    Unclear = 2,
    /// It has no area, certainly.
    Flat = 3,
}

impl ViewedSide {
    /// How many there are, for arrays with one as the index.
    pub(crate) const COUNT: usize = 4;

    /// Front or back.
    #[inline(always)]
    fn of(is_front: bool) -> ViewedSide {
        if is_front { ViewedSide::Front } else { ViewedSide::Back }
    }

    /// Whether it is the front in the winding of the triangle's fan; `None` if it is no side.
    #[cfg(not(meshsweep_wide))]
    #[inline(always)]
    pub(crate) fn in_winding(self, leaf: &FanLeaf<'_>, lane: usize) -> Option<bool> {
        let is_reversed = is_reversed(leaf, lane);
        match self {
            ViewedSide::Front => Some(!is_reversed),
            ViewedSide::Back => Some(is_reversed),
            _ => None,
        }
    }

    /// The side that a triangle tells a point which sees this side of it: the other one if it is
    /// turned, none if it is sideless.
    #[cold]
    #[inline(never)]
    pub(crate) fn told_by(self, tree: &Bvh<'_>, place: TriangleAt) -> ViewedSide {
        // In a tree that is not checked no number may be right.
        let triangle = place.number(tree).unwrap_or(u32::MAX);
        let is_turned = tree.turned().contains(triangle);
        match self {
            ViewedSide::Flat => ViewedSide::Flat,
            _ if tree.sideless().contains(triangle) => ViewedSide::Unclear,
            ViewedSide::Front if is_turned => ViewedSide::Back,
            ViewedSide::Back if is_turned => ViewedSide::Front,
            side => side,
        }
    }
}

/// Whether the fan of triangle `lane` runs the other way round.
#[inline(always)]
fn is_reversed(leaf: &FanLeaf<'_>, lane: usize) -> bool {
    lane >= leaf.shape().turn() && leaf.shape().second_reversed()
}

/// How triangle `lane` faces the query's point, from which it is `seen` so by [`seen_from`].
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
pub(crate) fn viewed_side(
    query: &PointQuery,
    leaf: &FanLeaf<'_>,
    lane: usize,
    seen: Option<&[Vec3; 3]>,
) -> ViewedSide {
    let is_reversed = is_reversed(leaf, lane);
    if SOFT_FLOAT
        && let Some(point) = &query.int_point
        && let Some(ring) = leaf.grid_ring()
        && let Some(corners) = ring.corners(lane, leaf.shape().turn())
        && let Some(is_front) = is_in_front(point, &corners)
    {
        return ViewedSide::of(is_front != is_reversed);
    }
    let [s, e, g] = match seen {
        Some(seen) => *seen,
        None => seen_from(leaf, lane, query.p),
    };
    if !SOFT_FLOAT
        && !leaf.is_f32()
        && let Some(is_front) = is_plainly_in_front(&[s, e, g])
    {
        return ViewedSide::of(is_front != is_reversed);
    }
    by_rounding(leaf, lane, [s, e, g], is_reversed)
}

#[cold]
#[inline(never)]
fn by_rounding(
    leaf: &FanLeaf<'_>,
    lane: usize,
    [s, e, g]: [Vec3; 3],
    is_reversed: bool,
) -> ViewedSide {
    let (normal, size) = cross(e, g);
    if normal == Vec3::ZERO && is_flat(leaf, lane, norm_1(size)) {
        return ViewedSide::Flat;
    }
    let volume = normal.dot(s);
    // Underflow adds some hundred times less than the last term.
    let rounding =
        SIGN_TRIPLE_PRODUCT * U32 * size.dot(s.abs()) + f32::MIN_POSITIVE * (1.0 + norm_1(s));
    if volume.abs() > rounding {
        ViewedSide::of((volume > 0.0) != is_reversed)
    } else {
        ViewedSide::Unclear
    }
}

/// Normal of two spokes, and for each component the sum of the absolute values of its products.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
pub(crate) fn cross(e: Vec3, g: Vec3) -> (Vec3, Vec3) {
    let (a, b) = (e.abs(), g.abs());
    (e.cross(g), Vec3::new(a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x))
}

/// Whether two places are the same.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
pub(crate) fn is_same(a: &Vec3, b: &Vec3) -> bool {
    a == b
}

/// Whether a triangle with a computed normal of zero has no area: a repeated corner, or integers so
/// small that the normal is exact.
#[cold]
pub(crate) fn is_flat(leaf: &FanLeaf<'_>, lane: usize, size: f32) -> bool {
    let [a, b, c] = leaf.corners(lane);
    let is_exact = |v: Vec3| is_integer(v, EXACT_INTEGERS);
    is_same(&a, &b)
        || is_same(&b, &c)
        || is_same(&c, &a)
        || (size < EXACT_INTEGERS && is_exact(a) && is_exact(b) && is_exact(c))
}
