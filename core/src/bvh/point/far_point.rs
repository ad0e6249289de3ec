//! A point so far from the model that all of its surface is equally near up to rounding.

use super::query::FarPoint;
use crate::bvh::tree::format::{Bvh, at_least, at_most};
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::num::tolerance::{FAN_RELATIVE, U32};
use crate::num::{greater, sqrt_approx};
use crate::query::{ClosestPoint, Ended, Interval, QueryError, Work};

impl FarPoint<'_> {
    /// The interval of the model's box, and some point of the surface.
    ///
    /// It is computed in input units, scaled by a power of two so that no coordinate's square
    /// leaves f32's range. Proof: `core/docs/rounding.md` §8, Far away.
    #[cold]
    #[inline(never)]
    pub(crate) fn closest_point(
        self,
        tree: &Bvh<'_>,
        point: [f32; 3],
    ) -> Result<ClosestPoint, QueryError> {
        let query = self.query;
        // In place: at `opt-level = "s"` copies of arrays are made number by number.
        let (low, high) = tree.grid_ends();
        let scaled = |x: f32, scale: f32| query.units.outward(x, scale);
        let mut size = 0.0;
        // Here and below by number: at `opt-level = "s"` iterators over arrays are kept in memory.
        for axis in 0..3 {
            let (low, high) = (scaled(low[axis], 1.0).abs(), scaled(high[axis], 1.0).abs());
            size = greater(size, greater(greater(low, high), point[axis].abs()));
        }
        let (scale, unscale) = match size {
            size if size > POWER_40 => (1.0 / POWER_70, POWER_70),
            size if size < 1.0 / POWER_40 => (POWER_70, 1.0 / POWER_70),
            _ => (1.0, 1.0),
        };
        let (mut nearest, mut farthest) = ([1f32; 3], [1f32; 3]);
        for axis in 0..3 {
            let x = point[axis] * scale;
            let (below, above) = (scaled(low[axis], scale) - x, x - scaled(high[axis], scale));
            nearest[axis] = greater(0.0, greater(below, above));
            farthest[axis] = greater(below.abs(), above.abs());
        }
        let (near, far) = (length(nearest), length(farthest));
        let fixed_error = scaled(query.fixed_error, scale);
        let margin = |distance: f32| distance * (2.0 * FAN_RELATIVE * U32) + fixed_error;
        // Any point of the surface serves: the first leaf. A damaged tree must not loop.
        let mut node = 0;
        let mut links = tree.links(0).ok_or(QueryError::Unchecked)?;
        for _ in 0..tree.most_steps() {
            if links.child(0).is_leaf() {
                break;
            }
            node = links.child(0).at;
            links = tree.links(node).ok_or(QueryError::Unchecked)?;
        }
        let leaf = tree.leaf(node, 0);
        let leaf = leaf.as_ref().ok_or(QueryError::Unchecked)?;
        Ok(ClosestPoint {
            distance: Interval::new(
                at_least((near - margin(near)) * unscale),
                at_most((far + margin(far)) * unscale),
            ),
            point: query.units.point(leaf.centre(0)),
            triangle: TriangleAt::new(node, 0, 0).source(tree),
            work: Work::default(),
            ended: Ended::Exact,
        })
    }
}

/// Length of a vector of gaps, each at least 0. A short one is scaled, so that no square
/// underflows.
#[inline(never)]
fn length(gaps: [f32; 3]) -> f32 {
    let [x, y, z] = gaps;
    let scale = if greater(greater(x, y), z) < 1.0 / POWER_40 { POWER_70 } else { 1.0 };
    let mut sum = 0.0;
    for gap in gaps {
        let scaled = gap * scale;
        sum += scaled * scaled;
    }
    sqrt_approx(sum) / scale
}

const POWER_40: f32 = (1u64 << 40) as f32;
const POWER_70: f32 = (1u128 << 70) as f32;
