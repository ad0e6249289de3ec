//! A segment in the tree's grid units, prepared for boxes and fans, and the rounding of its
//! answers.

use super::descent::{NodeQuery, OpenedNode};
use super::node::box_entries;
use crate::bvh::format::{Bvh, Units};
use crate::bvh::node::{GridLine, SlabRay, WIDE};
use crate::geom::fan::FanRay;
use crate::geom::fan::WIDTH;
use crate::num::tolerance::{BOX_ENTRY, BVH_FAR, LEAST_DENOMINATOR, NEAR_START, STILL, U32};
use crate::num::{SOFT_FLOAT, greater, lesser, two_sum};
use crate::query::{Budget, Hit, QueryError, ScratchEntry};
use glam::Vec3;

/// The bit of a number's sign.
const SIGN: u32 = 1 << 31;

/// A segment, and the conversion of its parameters to the caller's.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SegmentQuery {
    pub(crate) ray: FanRay,
    pub(crate) slab_ray: SlabRay,
    /// For targets without floating point.
    pub(crate) line: GridLine,
    units: Units,
    /// The line's origin and direction, grid units.
    origin: Vec3,
    direction: Vec3,
    /// The caller's parameter of `origin`.
    start: f32,
    /// The segment has no length: all parameters are the same point.
    still: bool,
}

/// Where a line begins.
struct Start {
    origin: Vec3,
    /// By axis, the distance of the farthest corner of the model's box.
    far: Vec3,
    /// The caller's parameter of `origin`.
    start: f32,
    /// Upper bound of the distance of `origin` from the segment.
    off: f32,
}

impl SegmentQuery {
    /// Prepares a question: refuses a tree without boxes for segments, the budget, the scratch
    /// memory or the segment. `None`: the segment is proved clear of the model.
    #[inline(always)]
    pub(crate) fn prepare(
        tree: &Bvh<'_>,
        [a, b]: [[f32; 3]; 2],
        budget: &Budget,
        scratch: &[ScratchEntry],
    ) -> Result<Option<SegmentQuery>, QueryError> {
        SegmentQuery::check_served(tree)?;
        budget.check_with(scratch)?;
        // By bits, without a branch for each number.
        let magnitude = |x: f32| x.to_bits() & !SIGN;
        let largest =
            |[x, y, z]: [f32; 3]| greater(greater(magnitude(x), magnitude(y)), magnitude(z));
        if greater(largest(a), largest(b)) >= f32::INFINITY.to_bits() {
            return Err(QueryError::NotFinite);
        }
        let units = tree.units();
        let inward =
            |[x, y, z]: [f32; 3]| Vec3::new(units.inward(x), units.inward(y), units.inward(z));
        let (a, b) = (inward(a), inward(b));
        let (low, high) = tree.grid_bounds();
        let far = farthest(a, low, high);
        let size = norm_1(far);
        let far_b = farthest(b, low, high);
        if !((size <= BVH_FAR) & (norm_1(far_b) <= BVH_FAR)) {
            return Err(QueryError::OutOfDomain);
        }
        let size_b = norm_1(far_b);
        if misses([a, b], [low, high], units.surface_error, size + size_b) {
            return Ok(None);
        }
        let mut start = Start { origin: a, far, start: 0.0, off: 0.0 };
        if size > NEAR_START * norm_1(high - low) {
            let Some(nearer) = approach(tree, [a, b], [low, high], size) else { return Ok(None) };
            start = nearer;
        }
        Ok(Some(SegmentQuery::at(tree, start, b - a)))
    }

    /// The query along the line from a place. One instance: it is much code.
    #[inline(always)]
    fn at(tree: &Bvh<'_>, Start { origin, far, start, off }: Start, direction: Vec3) -> Self {
        let units = tree.units();
        let surface = units.surface_error + off;
        let inverse = |d: f32| 1.0 / if d.abs() > STILL { d } else { STILL.copysign(d) };
        let inverse = [inverse(direction.x), inverse(direction.y), inverse(direction.z)];
        // One grid unit is added to the distance: the origin of a node that is flat, or thinner
        // than a grid unit, is an integer.
        let margin = |far: f32| surface + (BOX_ENTRY * U32 * far + BOX_ENTRY * U32);
        let margin = [margin(far.x), margin(far.y), margin(far.z)];
        let end = if start > 0.0 { (1.0 - start) * (1.0 + 4.0 * U32) } else { 1.0 };
        let from = origin.to_array();
        let ray = FanRay::new(from, direction.to_array(), inverse, end, surface, norm_1(far))
            .turning(units.has_place_error);
        SegmentQuery {
            ray,
            line: if SOFT_FLOAT {
                GridLine::new(&ray, tree.header.grid_origin)
            } else {
                GridLine::NONE
            },
            slab_ray: SlabRay::new(from, inverse, margin),
            units,
            origin,
            direction,
            start,
            still: direction.abs().max_element() <= STILL,
        }
    }

    /// A lower bound of the caller's parameter for `t`.
    #[inline(always)]
    pub(crate) fn lower(&self, t: f32) -> f32 {
        if t == f32::INFINITY {
            t
        } else if self.still {
            0.0
        } else if self.start > 0.0 {
            (self.start + t) * (1.0 - 4.0 * U32)
        } else {
            t
        }
    }

    /// An upper bound of the caller's parameter for `t`.
    #[inline(always)]
    pub(crate) fn upper(&self, t: f32) -> f32 {
        let up = if self.start > 0.0 { (self.start + t) * (1.0 + 4.0 * U32) } else { t };
        if up < 1.0 { up } else { 1.0 }
    }

    /// The caller's hit for a triangle that is met at `t`.
    #[inline(always)]
    pub(crate) fn hit(&self, t: f32, triangle: Option<u32>) -> Hit {
        let point = self.units.point(self.origin + self.direction * t);
        let whole = self.start + t;
        let whole = if whole < 1.0 { whole } else { 1.0 };
        Hit { t: if self.still { 0.0 } else { whole }, point, triangle }
    }
}

impl NodeQuery for SegmentQuery {
    #[inline(always)]
    fn check_served(tree: &Bvh<'_>) -> Result<(), QueryError> {
        if tree.serves_segments() { Ok(()) } else { Err(QueryError::NO_SEGMENTS) }
    }

    #[inline(always)]
    fn keys(&self, tree: &Bvh<'_>, opened: &OpenedNode, keys: &mut [u32; WIDTH]) -> Option<()> {
        let &OpenedNode { node, count, bound, limit } = opened;
        let [bound, limit] = [bound, limit].map(f32::from_bits);
        *keys = box_entries(tree.boxes(node)?, &self.slab_ray, count, bound, limit);
        Some(())
    }
}

#[inline(always)]
fn norm_1(v: Vec3) -> f32 {
    v.x.abs() + v.y.abs() + v.z.abs()
}

/// By axis, the way to the farthest corner of a box.
#[inline(always)]
fn farthest(p: Vec3, low: Vec3, high: Vec3) -> Vec3 {
    let (l, h) = ((p - low).abs(), (p - high).abs());
    Vec3::new(greater(h.x, l.x), greater(h.y, l.y), greater(h.z, l.z))
}

/// Whether a segment is proved clear of the model's box, by their six separating axes, all lengths
/// doubled (Ericson, *Real-Time Collision Detection*, 2005, 5.3.3). Most segments that miss the
/// model end here, without a division. `size`: the distance of both ends' farthest corners. The
/// margin is in `core/docs/rounding.md` §9.
#[inline(always)]
fn misses([a, b]: [Vec3; 2], [low, high]: [Vec3; 2], surface_error: f32, size: f32) -> bool {
    let margin = 2.0 * surface_error + size * (32.0 * U32) + LEAST_DENOMINATOR;
    let (d, m) = (b - a, (a - low) + (b - high));
    let (half, d_abs) = ((high - low) + Vec3::splat(margin), d.abs());
    // By bits, for a comparison is a branch that no processor guesses, or a call. No number is
    // negative, so the difference of bits has the right sign.
    let beyond = |x: f32, limit: f32| limit.to_bits().wrapping_sub(x.to_bits());
    let apart = |m: f32, half: f32, d: f32| beyond(m.abs(), half + d);
    let along =
        apart(m.x, half.x, d_abs.x) | apart(m.y, half.y, d_abs.y) | apart(m.z, half.z, d_abs.z);
    if !WIDE && along & SIGN != 0 {
        return true;
    }
    let apart_across = |[m, n]: [f32; 2], [d, e]: [f32; 2], [h, k]: [f32; 2]| {
        beyond((m * e - n * d).abs(), (h * e.abs() + k * d.abs()) + LEAST_DENOMINATOR)
    };
    let across = apart_across([m.x, m.y], [d.x, d.y], [half.x, half.y])
        | apart_across([m.y, m.z], [d.y, d.z], [half.y, half.z])
        | apart_across([m.z, m.x], [d.z, d.x], [half.z, half.x]);
    (along | across) & SIGN != 0
}

/// Moves a far start along the segment to the place where it enters the model's box, enlarged by
/// its size. The place is computed with twice f32's precision. So the strip along edges in which a
/// hit is undecided has a width in proportion to the model, not to the distance. See
/// `core/docs/rounding.md` §9.
#[cold]
#[inline(never)]
fn approach(tree: &Bvh<'_>, [a, b]: [Vec3; 2], [low, high]: [Vec3; 2], size: f32) -> Option<Start> {
    let surface_error = tree.units().surface_error;
    let direction = b - a;
    // Eight times the error of the slab test below.
    let pad = norm_1(high - low) + 2.0 * surface_error + size * (256.0 * U32) + LEAST_DENOMINATOR;
    let (mut enter, mut leave) = (0f32, 1f32);
    for axis in 0..3 {
        let (a, d) = (a.to_array()[axis], direction.to_array()[axis]);
        // In this order only the difference is rounded, wherever the model lies.
        let (low, high) = (low.to_array()[axis] - a - pad, high.to_array()[axis] - a + pad);
        if d.abs() > STILL {
            let (low, high) = (low / d, high / d);
            let (near, far) = if low < high { (low, high) } else { (high, low) };
            enter = greater(enter, near);
            leave = lesser(leave, far);
        } else if low > 0.0 || high < 0.0 {
            return None;
        }
    }
    if enter > leave {
        return None;
    }
    let start = enter * (1.0 - 16.0 * U32);
    let at = |a: f32, b: f32| interpolate(a, b, start);
    let origin = Vec3::new(at(a.x, b.x), at(a.y, b.y), at(a.z, b.z));
    let far = farthest(origin, low, high);
    let off = 2.0 * U32 * norm_1(origin) + (64.0 * U32 * U32) * (size + norm_1(direction));
    Some(Start { origin, far, start, off })
}

/// `a + t·(b − a)`, computed with twice f32's precision and rounded once (Dekker 1971; Knuth, TAOCP
/// 4.2.2).
fn interpolate(a: f32, b: f32, t: f32) -> f32 {
    let (d, d_rest) = two_sum(b, -a);
    let (p, p_rest) = two_product(t, d);
    let (s, s_rest) = two_sum(a, p);
    s + (s_rest + (p_rest + t * d_rest))
}

/// The product `a·b`, rounded, and its rounding (Dekker 1971).
fn two_product(a: f32, b: f32) -> (f32, f32) {
    let halves = |x: f32| {
        let c = 4097.0 * x;
        let high = c - (c - x);
        (high, x - high)
    };
    let product = a * b;
    let ((ah, al), (bh, bl)) = (halves(a), halves(b));
    (product, ((ah * bh - product) + ah * bl + al * bh) + al * bl)
}
