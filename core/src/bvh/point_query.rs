//! A query point in the tree's grid units, and the rounding of its answers.

use super::descent::{NodeQuery, OpenedNode};
use super::node::{NodeFrame, box_distances};
use crate::bvh::format::{Bvh, Units};
use crate::geom::fan::WIDTH;
use crate::num::sqrt_approx;
use crate::num::tolerance::{
    BOX_DISTANCE, BVH_FAR, CERTIFIED_PART, CERTIFIED_SHORTFALL, FAN_DISTANCE, FAN_RELATIVE, U32,
};
use crate::query::{Budget, QueryError, ScratchEntry};
use glam::Vec3;

/// Factor of the square of a box's rounding in [`PointQuery::limit`]: with it and a relative 2^-10
/// the limit holds without a root.
const ALLOWANCE: f32 = 2100.0;

/// Its root, rounded down.
const ALLOWANCE_ROOT: f32 = 45.0;

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
        let units = tree.units();
        let p = Vec3::new(units.inward(x), units.inward(y), units.inward(z));
        let header = tree.header();
        let (low, high) = tree.grid_bounds();
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
            allowance: ALLOWANCE * off * off,
            far: !near,
        })
    }

    /// A node with a greater squared bound holds nothing that is computed as near as `distance_sq`.
    ///
    /// (√B·(1 + 16u) + b)² ≤ B·(1 + 2^-10) + [`ALLOWANCE`]·b², so no root is needed.
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

    /// Rounding of a box's distance, grid units, taken back from `allowance`.
    #[inline(always)]
    pub(crate) fn box_error(&self) -> f32 {
        sqrt_approx(self.limit(0.0)) * (1.0 / ALLOWANCE_ROOT)
    }

    /// The error of a distance that does not grow with the distance: rounding and surface error,
    /// grid units.
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
