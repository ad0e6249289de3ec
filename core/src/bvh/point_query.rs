//! A query point in the tree's grid units, and the rounding of its answers.

use super::descent::{NodeQuery, OpenedNode};
use super::node::{NodeFrame, box_distances};
use crate::bvh::format::Bvh;
use crate::geom::fan::WIDTH;
use crate::num::sqrt_approx;
use crate::num::tolerance::{
    BOX_DISTANCE, BVH_FAR, CERTIFIED_PART, CERTIFIED_SHORTFALL, FAN_DISTANCE, FAN_RELATIVE, U32,
};
use crate::query::{Budget, QueryError, ScratchEntry};
use glam::Vec3;

/// Conversion between input units and grid units, by powers of two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Units {
    /// `2^-(scale + grid)` in two factors, each within f32's range.
    inward: [f32; 2],
    /// The inverse of `inward`.
    outward: [f32; 2],
    /// Surface error, grid units.
    pub(crate) surface_error: f32,
}

impl Units {
    #[inline(always)]
    pub(crate) fn of(tree: &Bvh<'_>) -> Units {
        let scale = tree.scale();
        Units { inward: scale.inward, outward: scale.outward, surface_error: scale.surface_error }
    }

    /// A length or coordinate in grid units: exact unless it leaves f32's range.
    #[inline(always)]
    pub(crate) fn inward(&self, x: f32) -> f32 {
        x * self.inward[0] * self.inward[1]
    }

    /// A coordinate in input units, kept finite.
    #[inline(always)]
    pub(crate) fn point(&self, p: Vec3) -> [f32; 3] {
        p.to_array().map(|x| (x * self.outward[0] * self.outward[1]).clamp(-f32::MAX, f32::MAX))
    }

    /// A lower bound in input units: at least 0, and below f32's normal range 0.
    #[inline(always)]
    pub(crate) fn lower(&self, x: f32) -> f32 {
        at_least(x * self.outward[0] * self.outward[1])
    }

    /// An upper bound in input units; infinite where f32 ends.
    #[inline(always)]
    pub(crate) fn upper(&self, x: f32) -> f32 {
        if x == 0.0 { 0.0 } else { at_most(x * self.outward[0] * self.outward[1]) }
    }

    /// A length or coordinate in input units times a power of two.
    #[inline(always)]
    pub(crate) fn outward(&self, x: f32, power: f32) -> f32 {
        x * self.outward[0] * power * self.outward[1]
    }
}

/// A lower bound in f32's normal range, or 0.
#[inline(always)]
pub(crate) fn at_least(x: f32) -> f32 {
    if x >= f32::MIN_POSITIVE { x.min(f32::MAX) } else { 0.0 }
}

/// An upper bound in f32's normal range, or infinite.
#[inline(always)]
pub(crate) fn at_most(x: f32) -> f32 {
    if x >= f32::MIN_POSITIVE { x } else { f32::MIN_POSITIVE }
}

/// A query point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointQuery {
    /// Grid units.
    pub(crate) p: Vec3,
    pub(crate) units: Units,
    /// Rounding of a computed distance, grid units, in addition to [`FAN_RELATIVE`] roundings of
    /// the distance itself.
    rounding: f32,
    /// Added to a squared limit, so that no rounding hides a candidate.
    allowance: f32,
    /// Square by which a lower bound may fall short: [`CERTIFIED_SHORTFALL`], or 0 for f32
    /// vertices.
    shortfall_sq: f32,
    /// Farther than [`BVH_FAR`]: the model's box gives the answer.
    pub(crate) far: bool,
}

impl PointQuery {
    /// Prepares a question: refuses a tree without boxes for distances, the budget, the scratch
    /// memory or the point.
    #[inline(always)]
    pub(crate) fn prepare(
        tree: &Bvh<'_>,
        point: [f32; 3],
        budget: &Budget,
        scratch: &[ScratchEntry],
    ) -> Result<PointQuery, QueryError> {
        PointQuery::check_served(tree)?;
        budget.check_with(scratch)?;
        PointQuery::new(tree, point)
    }

    #[inline(always)]
    pub(crate) fn new(tree: &Bvh<'_>, point: [f32; 3]) -> Result<PointQuery, QueryError> {
        let [x, y, z] = point;
        if !(x.is_finite() && y.is_finite() && z.is_finite()) {
            return Err(QueryError::NotFinite);
        }
        let units = Units::of(tree);
        let p = Vec3::new(units.inward(x), units.inward(y), units.inward(z));
        let header = tree.header();
        let (low, high) = bounds(tree);
        let farthest = (p - low).abs().max((p - high).abs());
        let size = farthest.x + farthest.y + farthest.z;
        let fan = FAN_DISTANCE * U32 * header.star_radius;
        let off = BOX_DISTANCE * U32 * size + fan;
        let shortfall_sq = if header.is_f32() { 0.0 } else { CERTIFIED_SHORTFALL };
        let near = size <= BVH_FAR;
        Ok(PointQuery {
            p,
            units,
            shortfall_sq,
            rounding: fan,
            allowance: 2100.0 * off * off,
            far: !near,
        })
    }

    /// A node with a greater squared bound holds nothing that is computed as near as `distance_sq`.
    ///
    /// (√B·(1 + 16u) + b)² ≤ B·(1 + 2^-10) + 2100·b², so no root is needed.
    #[inline(always)]
    pub(crate) fn limit(&self, distance_sq: f32) -> f32 {
        distance_sq * (1.0 + 1.0 / 1024.0) + self.allowance
    }

    /// A triangle with a smaller squared lower bound is refined as a sliver, if `distance_sq` is
    /// the best squared distance.
    #[inline(always)]
    pub(crate) fn refine_below(&self, distance_sq: f32) -> f32 {
        distance_sq * CERTIFIED_PART - self.shortfall_sq
    }

    /// Upper bound of the distance to the input surface, input units, from a computed distance to
    /// the stored surface.
    #[inline(always)]
    pub(crate) fn upper(&self, distance: f32) -> f32 {
        self.units.upper(
            distance
                + (distance * (FAN_RELATIVE * U32) + (self.rounding + self.units.surface_error)),
        )
    }

    /// Rounding of a box's distance, grid units. `allowance` is 2100 times its square, and 2100 is
    /// a little more than 45².
    #[inline(always)]
    pub(crate) fn box_error(&self) -> f32 {
        sqrt_approx(self.limit(0.0)) * (1.0 / 45.0)
    }

    /// The part of a distance's error that does not grow with the distance: rounding and surface
    /// error, grid units.
    pub(crate) fn fixed_error(&self) -> f32 {
        self.rounding + self.units.surface_error
    }

    /// Lower bound of the distance to the input surface, input units, from a computed one.
    #[inline(always)]
    pub(crate) fn lower(&self, distance: f32) -> f32 {
        self.units.lower(
            distance
                - (distance * (FAN_RELATIVE * U32) + (self.rounding + self.units.surface_error)),
        )
    }
}

impl NodeQuery for PointQuery {
    #[inline(always)]
    fn check_served(tree: &Bvh<'_>) -> Result<(), QueryError> {
        if tree.serves_distances() { Ok(()) } else { Err(QueryError::NO_DISTANCES) }
    }

    #[inline(always)]
    fn keys(&self, tree: &Bvh<'_>, opened: &OpenedNode) -> Option<[f32; WIDTH]> {
        let record = tree.frame(opened.node)?;
        let frame = NodeFrame::of(record, self.p);
        Some(box_distances(record, &frame, opened.count, opened.bound))
    }
}

/// Corners of the tree's box, grid units.
#[inline(always)]
pub(crate) fn bounds(tree: &Bvh<'_>) -> (Vec3, Vec3) {
    (tree.scale().low, tree.scale().high)
}
