//! Where a segment's line begins, unless the segment is proved clear of the model's box.

use super::model_box::SegmentAndBox;
use crate::bvh::tree::format::Bvh;
use crate::geom::norm_1;
use crate::num::tolerance::{BVH_FAR, LEAST_DENOMINATOR, NEAR_START, STILL, U32};
use crate::num::{exp2, greater, lesser, two_sum};
use crate::query::{Behind, Budget, QueryError, Ray, ScratchEntry};
use glam::{DVec3, Vec3};

/// The roundings of the way to the model's farthest corner are less: three of f32.
const BEYOND: f64 = 1.0 + 4.0 * U32 as f64;

/// Where a line begins, grid units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SegmentStart {
    pub(crate) origin: Vec3,
    pub(crate) direction: Vec3,
    /// By axis, the distance of the farthest corner of the model's box.
    pub(crate) far: Vec3,
    /// The caller's parameter of `origin`.
    pub(crate) start: f32,
    /// Upper bound of the distance of `origin` from the segment.
    pub(crate) off: f32,
}

impl SegmentStart {
    /// Refuses a tree without boxes for segments, the budget, the scratch memory or the segment.
    /// `None`: the segment is proved clear of the model.
    #[inline(always)]
    pub(crate) fn find(
        tree: &Bvh<'_>,
        ends: [[f32; 3]; 2],
        budget: &Budget,
        scratch: &[ScratchEntry],
    ) -> Result<Option<SegmentStart>, QueryError> {
        if !tree.serves_segments() {
            return Err(QueryError::NO_SEGMENTS);
        }
        budget.check_with(scratch)?;
        let Some(both) = SegmentAndBox::unless_clear(tree, ends)? else { return Ok(None) };
        let (origin, direction) = (both.a, both.b - both.a);
        let far = both.farthest(origin);
        let size = norm_1(far);
        if size > NEAR_START * norm_1(both.high - both.low) {
            return Ok(approach(&both, tree.units().surface_error, size));
        }
        Ok(Some(SegmentStart { origin, direction, far, start: 0.0, off: 0.0 }))
    }

    /// The same of a ray, as a segment that ends behind the model, with the ray's parameter of that
    /// end. The direction is exact, so no end is rounded (`core/docs/rounding.md` §9, "Rays").
    pub(super) fn of_ray(
        tree: &Bvh<'_>,
        [origin, direction]: [[f32; 3]; 2],
        budget: &Budget,
        scratch: &[ScratchEntry],
    ) -> Result<Option<(SegmentStart, f64)>, QueryError> {
        if !tree.serves_segments() {
            return Err(QueryError::NO_SEGMENTS);
        }
        budget.check_with(scratch)?;
        let ray = Ray::new(origin, direction)?;
        let (both, units) = (SegmentAndBox::new(tree, [origin, origin]), tree.units());
        let far = both.farthest(both.a);
        let size = norm_1(far);
        // Four times as far away are the ends of segments at most.
        if size.is_nan() || size > 0.25 * BVH_FAR {
            return Err(QueryError::OutOfDomain);
        }
        let beyond = f64::from(size + units.surface_error) * BEYOND + 1.0;
        let Behind { way, parameter } = ray.behind(exp2(units.inward_exponent()), beyond);
        let direction = Vec3::from_array(way.map(|x| x as f32));
        let Some(enter) = enters(&both, direction, units.surface_error, size) else {
            return Ok(None);
        };
        // A component that f32 cannot hold is below its least number.
        let is_exact = direction.as_dvec3() == DVec3::from_array(way);
        let lost = if is_exact { 0.0 } else { f32::MIN_POSITIVE };
        let mut from = SegmentStart { origin: both.a, direction, far, start: 0.0, off: lost };
        if size > NEAR_START * norm_1(both.high - both.low) {
            let start = enter * (1.0 - 16.0 * U32);
            let at = |a: f32, d: f32| along(a, [d, 0.0], start);
            let (a, d) = (both.a, direction);
            let origin = Vec3::new(at(a.x, d.x), at(a.y, d.y), at(a.z, d.z));
            from = moved(&both, origin, direction, start, size);
            from.off += lost;
        }
        Ok(Some((from, parameter)))
    }
}

/// Moves a far start along the segment to the place where it enters the model's box, enlarged by
/// its size. The place is computed with twice f32's precision. So the strip along edges in which a
/// hit is undecided has a width in proportion to the model, not to the distance. See
/// `core/docs/rounding.md` §9.
#[cold]
#[inline(never)]
fn approach(both: &SegmentAndBox, surface_error: f32, size: f32) -> Option<SegmentStart> {
    let &SegmentAndBox { a, b, .. } = both;
    let direction = b - a;
    let start = enters(both, direction, surface_error, size)? * (1.0 - 16.0 * U32);
    let at = |a: f32, b: f32| interpolate(a, b, start);
    let origin = Vec3::new(at(a.x, b.x), at(a.y, b.y), at(a.z, b.z));
    Some(moved(both, origin, direction, start, size))
}

/// A start that was moved along its line.
#[inline(always)]
fn moved(
    both: &SegmentAndBox,
    origin: Vec3,
    direction: Vec3,
    start: f32,
    size: f32,
) -> SegmentStart {
    let far = both.farthest(origin);
    let off = 2.0 * U32 * norm_1(origin) + (64.0 * U32 * U32) * (size + norm_1(direction));
    SegmentStart { origin, direction, far, start, off }
}

/// The parameter at which a line enters the model's box, enlarged by its size. `None`: the segment
/// is proved clear of that box.
#[inline(always)]
fn enters(
    &SegmentAndBox { a, low, high, .. }: &SegmentAndBox,
    direction: Vec3,
    surface_error: f32,
    size: f32,
) -> Option<f32> {
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
    (enter <= leave).then_some(enter)
}

/// `a + t·(b − a)`, computed with twice f32's precision and rounded once (Dekker 1971; Knuth, TAOCP
/// 4.2.2).
#[cfg_attr(meshsweep_small, inline(never))]
fn interpolate(a: f32, b: f32, t: f32) -> f32 {
    let (d, d_rest) = two_sum(b, -a);
    along(a, [d, d_rest], t)
}

/// `a + t·(d + d_rest)`, likewise.
#[inline(always)]
fn along(a: f32, [d, d_rest]: [f32; 2], t: f32) -> f32 {
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
