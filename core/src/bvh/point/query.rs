//! A query point in the tree's grid units, and the rounding of its answers.

use crate::bvh::tree::descent::{NodeQuery, OpenedNode};
#[cfg(meshsweep_wide)]
use crate::bvh::tree::format::LanePoint;
use crate::bvh::tree::format::{Bvh, Units};
#[cfg(meshsweep_avx2)]
use crate::bvh::tree::node::box_distances_avx2;
use crate::bvh::tree::node::{CHILD_MASK, KeyPoint, NO_CHILD, box_distances};
#[cfg(not(meshsweep_wide))]
use crate::bvh::tree::node::{Pushed, push_boxes};
use crate::format::layout::BuildFor;
use crate::geom::fan::{IntPoint, WIDTH};
use crate::num::tolerance::{
    BVH_FAR, CERTIFIED_PART, CERTIFIED_SHORTFALL, FAN_DISTANCE, FAN_RELATIVE, LEAST_FAN_ROUNDING,
    LIMIT_ALLOWANCE, LIMIT_GROWTH, PLANE_DISTANCE, SIDE_ALLOWANCE, U32,
};
use crate::num::{Real, SOFT_FLOAT, difference, float, greater, sqrt_approx};
use crate::query::{Budget, QueryError, ScratchEntry};
use glam::Vec3;

/// Key limit that lets every child pass.
pub(crate) const EVERY_KEY: u32 = NO_CHILD - 1;

/// A query point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointQuery {
    /// Grid units.
    pub(crate) p: Vec3,
    /// The point less the grid's origin, rounded.
    #[cfg(not(meshsweep_wide))]
    pub(crate) from_origin: Vec3,
    /// The point for the wide kernel of leaves.
    #[cfg(meshsweep_wide)]
    pub(crate) lanes: LanePoint,
    pub(crate) units: Units,
    /// Rounding of a computed distance, grid units, in addition to [`FAN_RELATIVE`] roundings of
    /// the distance itself.
    pub(crate) rounding: f32,
    /// The error of a distance that does not grow with the distance: rounding and surface error,
    /// grid units.
    pub(crate) fixed_error: f32,
    /// Added to a squared limit, so that no rounding hides a candidate.
    pub(crate) allowance: f32,
    /// The point in integers, on targets without floating point, if the model is near and on a
    /// grid.
    pub(crate) int_point: Option<IntPoint>,
    /// The point, prepared for the boxes of nodes.
    key_point: KeyPoint,
    /// Keys in a square of the grid unit: a power of two.
    keys_in_square: f32,
    /// The 1-norm of the way to the model's farthest corner, grid units.
    size: f32,
    /// Square by which a lower bound may fall short: [`CERTIFIED_SHORTFALL`], or 0 for f32
    /// vertices.
    shortfall_sq: f32,
}

/// A point that a question prepared, near or far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PreparedPoint {
    query: PointQuery,
    /// Farther than [`BVH_FAR`].
    is_far: bool,
}

/// What a question has to answer.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Asked<'q> {
    /// A point that the tree can be searched for.
    Near(&'q PointQuery),
    /// A point so far away that the model's box answers.
    Far(FarPoint<'q>),
}

/// A point farther than [`BVH_FAR`]. Far enough away, all points of the surface are the closest up
/// to a rounding of f32. Nearer, it bounds the distance where no leaf was looked at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FarPoint<'q> {
    pub(crate) query: &'q PointQuery,
}

impl PreparedPoint {
    /// Prepares a question: refuses a tree without boxes for distances, the budget, the scratch
    /// memory or the point.
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    pub(crate) fn prepare(
        tree: &Bvh<'_>,
        point: [f32; 3],
        budget: &Budget,
        scratch: &[ScratchEntry],
    ) -> Result<PreparedPoint, QueryError> {
        PointQuery::check_served(tree)?;
        budget.check_with(scratch)?;
        PreparedPoint::new(tree, point)
    }

    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    pub(crate) fn new(tree: &Bvh<'_>, point: [f32; 3]) -> Result<PreparedPoint, QueryError> {
        let [x, y, z] = point;
        let units = tree.units();
        let p = units.inward_point(point);
        let header = tree.header();
        let (low, high) = tree.grid_bounds();
        let from_low = difference(p, low);
        let farthest = farthest(from_low, difference(p, high));
        let size = (Real(farthest.x) + Real(farthest.y) + Real(farthest.z)).0;
        // As numbers, for the size may be NaN.
        let near = if SOFT_FLOAT { size.to_bits() <= BVH_FAR.to_bits() } else { size <= BVH_FAR };
        // Of a point that is not finite the size is neither.
        if !near && 0.0 * x + 0.0 * y + 0.0 * z != 0.0 {
            return Err(QueryError::NotFinite);
        }
        let fan = Real(header.star_radius).times_power(FAN_DISTANCE * U32);
        let fan = greater(fan, Real(LEAST_FAN_ROUNDING)).0;
        let shortfall_sq = if header.is_f32() { 0.0 } else { CERTIFIED_SHORTFALL };
        let most = greater(greater(Real(farthest.x), Real(farthest.y)), Real(farthest.z)).0;
        let from_origin = if SOFT_FLOAT && header.low == [0; 3] {
            // The same numbers.
            from_low
        } else {
            let [x, y, z] = header.grid_origin;
            difference(p, Vec3::new(float(x), float(y), float(z)))
        };
        let key_point = KeyPoint::new(from_origin, most);
        let int_point = if SOFT_FLOAT && !header.is_f32() {
            IntPoint::new(from_origin.to_array())
        } else {
            None
        };
        let query = PointQuery {
            p,
            #[cfg(not(meshsweep_wide))]
            from_origin,
            #[cfg(meshsweep_wide)]
            lanes: LanePoint::new(p, header.grid_origin),
            units,
            shortfall_sq,
            rounding: fan,
            fixed_error: (Real(fan) + Real(units.surface_error)).0,
            allowance: (Real(fan).times_power(LIMIT_ALLOWANCE) * Real(fan)).0,
            int_point,
            key_point,
            // Keys are halves of squares.
            keys_in_square: f32::from_bits((126 - 2 * key_point.unit_exponent()) << 23),
            size,
        };
        Ok(PreparedPoint { query, is_far: !near })
    }

    /// The point, as a case that each question answers.
    #[inline(always)]
    pub(crate) fn asked(&self) -> Asked<'_> {
        let query = &self.query;
        if self.is_far { Asked::Far(FarPoint { query }) } else { Asked::Near(query) }
    }
}

impl PointQuery {
    /// No triangle that is computed as near as `distance_sq` has a true squared distance above
    /// this.
    ///
    /// (D·(1 + 16u) + f)² ≤ D²·[`LIMIT_GROWTH`] + [`LIMIT_ALLOWANCE`]·f², so no root is needed.
    #[inline(always)]
    pub(crate) fn limit(&self, distance_sq: f32) -> f32 {
        limit_of(distance_sq, self.allowance)
    }

    /// [`allowance`](Self::allowance) with room for all candidates of a side.
    ///
    /// (D·(1 + 500u) + 9f)² ≤ D²·[`LIMIT_GROWTH`] + [`SIDE_ALLOWANCE`]·[`LIMIT_ALLOWANCE`]·f².
    #[inline(always)]
    pub(crate) fn side_allowance(&self) -> f32 {
        Real(self.allowance).times_power(SIDE_ALLOWANCE).0
    }

    /// A child with a greater key is farther than the root of `limit`.
    #[inline(always)]
    pub(crate) fn key_limit(&self, limit: f32) -> u32 {
        let key = if SOFT_FLOAT {
            integer_product(limit, self.keys_in_square)
        } else {
            (limit * self.keys_in_square) as i32
        };
        (if key < EVERY_KEY.cast_signed() { key.cast_unsigned() } else { EVERY_KEY }) | CHILD_MASK
    }

    /// Lower bound of the distance of a box with this key, grid units.
    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    pub(crate) fn distance_of_key(&self, key: u32) -> f32 {
        let square = (key & !CHILD_MASK) as f32 / self.keys_in_square;
        sqrt_approx(square) * (1.0 - 4.0 * U32)
    }

    /// Keys of a node's children.
    #[inline(always)]
    pub(crate) fn keys_of(
        &self,
        tree: &Bvh<'_>,
        opened: &OpenedNode,
        keys: &mut [u32; WIDTH],
    ) -> Option<()> {
        let &OpenedNode { node, count, bound, .. } = opened;
        box_distances(tree.frame(node)?, &self.key_point, count, bound, keys);
        Some(())
    }

    /// The same, as the kernel leaves them.
    #[cfg(meshsweep_wide)]
    #[inline(always)]
    pub(crate) fn keys_in_register(
        &self,
        tree: &Bvh<'_>,
        opened: &OpenedNode,
    ) -> Option<[u32; WIDTH]> {
        let mut keys = [NO_CHILD; WIDTH];
        self.keys_of(tree, opened, &mut keys)?;
        Some(keys)
    }

    /// The same, in registers of 256 bits.
    #[cfg(meshsweep_avx2)]
    #[target_feature(enable = "avx2")]
    #[inline]
    pub(crate) fn keys_avx2(&self, tree: &Bvh<'_>, opened: &OpenedNode) -> Option<[u32; WIDTH]> {
        let &OpenedNode { node, count, bound, .. } = opened;
        Some(box_distances_avx2(tree.frame(node)?, &self.key_point, count, bound))
    }

    /// A triangle with a smaller squared lower bound is refined as a sliver, if `distance_sq` is
    /// the best squared distance.
    #[inline(always)]
    pub(crate) fn refine_below(&self, distance_sq: f32) -> f32 {
        (Real(distance_sq) * Real(CERTIFIED_PART) - Real(self.shortfall_sq)).0
    }

    /// Upper bound of the distance to the input surface, input units, from a computed distance to
    /// the stored surface.
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    pub(crate) fn upper(&self, distance: f32) -> f32 {
        let error = Real(distance).times_power(FAN_RELATIVE * U32) + Real(self.fixed_error);
        self.units.upper((Real(distance) + error).0)
    }

    /// Rounding of the distance from a plane that parts the point from a leaf, grid units.
    pub(crate) fn plane_error(&self) -> f32 {
        (Real(self.size).times_power(PLANE_DISTANCE * U32) + Real(self.rounding)).0
    }

    /// Lower bound of the distance to the input surface, input units, from a computed one.
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    pub(crate) fn lower(&self, distance: f32) -> f32 {
        let error = Real(distance).times_power(FAN_RELATIVE * U32) + Real(self.fixed_error);
        self.units.lower((Real(distance) - error).0)
    }
}

/// By axis the largest way from a point to a corner of a box.
#[inline(always)]
fn farthest(from_low: Vec3, from_high: Vec3) -> Vec3 {
    let (low, high) = (from_low.abs(), from_high.abs());
    if !SOFT_FLOAT {
        return low.max(high);
    }
    let most = |a: f32, b: f32| greater(Real(a), Real(b)).0;
    Vec3::new(most(low.x, high.x), most(low.y, high.y), most(low.z, high.z))
}

/// `(x * power) as i32` of a number that is not negative and a power of two, without a product.
#[inline(never)]
fn integer_product(x: f32, power: f32) -> i32 {
    let (bits, by) = (x.to_bits(), power.to_bits() >> 23);
    match (bits >> 23).wrapping_add(by) {
        // Less than one.
        ..254 => 0,
        exponent @ 254..285 => ((bits << 8 | 1 << 31) >> (285 - exponent)).cast_signed(),
        _ => i32::MAX,
    }
}

/// [`PointQuery::limit`] for an allowance.
#[inline(always)]
pub(crate) fn limit_of(distance_sq: f32, allowance: f32) -> f32 {
    (Real(distance_sq) * Real(LIMIT_GROWTH) + Real(allowance)).0
}

impl NodeQuery for PointQuery {
    #[inline(always)]
    fn check_served(tree: &Bvh<'_>) -> Result<(), QueryError> {
        // Made here: a constant would be copied by `memcpy`, for which alone firmware links it.
        let refused = || QueryError::NotServed { build_for: BuildFor::Closest };
        if tree.serves_distances() { Ok(()) } else { Err(refused()) }
    }

    #[inline(always)]
    fn keys(&self, tree: &Bvh<'_>, opened: &OpenedNode, keys: &mut [u32; WIDTH]) -> Option<()> {
        self.keys_of(tree, opened, keys)
    }

    #[cfg(not(meshsweep_wide))]
    #[inline(always)]
    fn push(
        &self,
        tree: &Bvh<'_>,
        opened: &OpenedNode,
        slots: &mut [ScratchEntry; WIDTH],
    ) -> Option<Pushed> {
        Some(push_boxes(tree.frame(opened.node)?, &self.key_point, opened, slots))
    }
}
