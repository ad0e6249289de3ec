//! Distance to a tribox, and the part of a segment inside it.

use super::bounds::{Tribox, projections};
use crate::num::tolerance::U32;
use crate::num::{greater, lesser, sqrt_approx, sum_down, sum_up};

/// Four frames of orthogonal slabs: the axes', and one turned by 45° about each axis. A slab's
/// number, and the square of its direction's length, twice three times.
const FRAMES: [[usize; 3]; 4] = [[0, 1, 2], [3, 4, 2], [5, 6, 0], [7, 8, 1]];

impl Tribox {
    /// Lower bound of the distance from a point to the tribox, in the unit of the parameters.
    /// Infinite if it is empty. Never NaN.
    ///
    /// The greatest distance to the four boxes of which the tribox is the intersection, rounded
    /// down, below f32's normal range to 0: exact where the closest point lies on a face, short
    /// beside some edges and vertices. 0 does not say that the point is inside.
    #[must_use]
    pub fn distance(&self, point: [f32; 3]) -> f32 {
        if self.is_empty() {
            return f32::INFINITY;
        }
        let (low, high) = projections(point);
        let mut gaps = [0f32; super::SLABS];
        let slabs = self.slabs().zip(low.into_iter().zip(high));
        for (gap, ((from, to), (low, high))) in gaps.iter_mut().zip(slabs) {
            let (below, above) = (sum_down(from, -high), sum_down(low, -to));
            let most = greater(above, below);
            // A sum beyond f32 gives no bound. Those of the axes still do.
            *gap = if most > 0.0 && most.is_finite() { most } else { 0.0 };
        }
        let most = gaps.iter().fold(0f32, |most, &gap| greater(most, gap));
        // So that no square leaves f32's range.
        let scale = if most > (1u64 << 60) as f32 {
            1.0 / 18_446_744_073_709_551_616.0
        } else if most < 1.0 / (1u64 << 40) as f32 {
            18_446_744_073_709_551_616.0
        } else {
            1.0
        };
        let square = |slab: usize| {
            let gap = gaps.get(slab).copied().unwrap_or(0.0) * scale;
            if slab < 3 { gap * gap } else { 0.5 * (gap * gap) }
        };
        let greatest = FRAMES.iter().fold(0f32, |greatest, &[a, b, c]| {
            let here = square(a) + square(b) + square(c);
            greater(greatest, here)
        });
        let distance = sqrt_approx(greatest) * (1.0 - 16.0 * U32) / scale;
        // Below, the quotient may have been rounded up by more than that.
        if distance >= f32::MIN_POSITIVE { distance } else { 0.0 }
    }

    /// Parameters between which the segment from `a` (0) to `b` (1) may be inside, rounded outward.
    /// `None` is a proof that it is nowhere inside.
    ///
    /// A segment of no length gives `(0, 1)` or `None`. Neither end may be NaN or infinite. Cost: 9
    /// slabs.
    #[must_use]
    pub fn clip(&self, a: [f32; 3], b: [f32; 3]) -> Option<(f32, f32)> {
        let along = |[x, y, z]: [f32; 3]| [x, y, z, x + y, x - y, y + z, y - z, z + x, z - x];
        let size = |[x, y, z]: [f32; 3]| {
            let [x, y, z] = [x.abs(), y.abs(), z.abs()];
            [0.0, 0.0, 0.0, x + y, x + y, y + z, y + z, z + x, z + x]
        };
        let ends = along(a).into_iter().zip(along(b)).zip(size(a).into_iter().zip(size(b)));
        let (mut enter, mut leave) = (0f32, 1f32);
        for ((low, high), ((from, to), (size_a, size_b))) in self.slabs().zip(ends) {
            // Rounding of either end. The parameter's own rounding is relative.
            let doubt = (4.0 * U32) * (size_a + size_b);
            let (low, high) = (sum_down(low, -doubt), sum_up(high, doubt));
            let change = to - from;
            // So far away that the way overflows: the slab gives no bound.
            if !change.is_finite() {
                continue;
            }
            if change == 0.0 {
                if from < low || from > high {
                    return None;
                }
                continue;
            }
            let (near, far) = if change > 0.0 { (low, high) } else { (high, low) };
            let (near, far) =
                (outward(near, from, change, false), outward(far, from, change, true));
            enter = greater(enter, near);
            leave = lesser(leave, far);
        }
        if enter <= leave { Some((enter, leave)) } else { None }
    }
}

/// `(plane − from)/change`, rounded down or up.
#[inline(always)]
fn outward(plane: f32, from: f32, change: f32, up: bool) -> f32 {
    let t = (plane - from) / change;
    let grows = (t > 0.0) == up;
    let t = if grows { t * (1.0 + 8.0 * U32) } else { t * (1.0 - 8.0 * U32) };
    // Below f32's normal range roundings are not relative.
    if up { t + f32::MIN_POSITIVE } else { t - f32::MIN_POSITIVE }
}
