//! Two trees in one frame, as they are stored, and the way back to the input.
//!
//! A search for the distance of two surfaces compares stored surfaces. Their errors are added to
//! the answer, once.

use super::descent::{Models, extended};
use super::leaf_gaps::LeafGaps;
use crate::bvh::format::Bvh;
use crate::bvh::stored_lengths::StoredLengths;
use crate::geom::Pose;
use crate::num::tolerance::U64;
use crate::num::{exp2, greater};
use crate::query::{Extended, Placement, QueryError, RelativePose};

/// Two trees, one of them moved.
pub(super) struct StoredPair<'a> {
    pub(super) trees: [&'a Bvh<'a>; 2],
    /// Its errors are of rounding alone.
    pub(super) pose: RelativePose,
    /// The pose is near enough for f32.
    pub(super) is_in_range: bool,
    /// With the sum of both surface errors.
    pub(super) lengths: StoredLengths,
    /// The greater of both.
    greater_error: f64,
    first: Extended,
}

impl<'a> StoredPair<'a> {
    pub(super) fn new([a, b]: [&'a Bvh<'a>; 2], pose: &Pose) -> Result<StoredPair<'a>, QueryError> {
        if !(a.serves_segments() && b.serves_segments()) {
            return Err(QueryError::NO_SEGMENTS);
        }
        let (first, second) = (extended(a), extended(b));
        let exact = |model: &Extended| Extended { error: 0.0, ..*model };
        let Placement { pose, is_in_range, .. } =
            RelativePose::place(&exact(&first), &exact(&second), pose)?;
        let [frame, _] = &pose.frames;
        let (error_a, error_b) = (first.error * f64::from(frame.unit), second.error * pose.longest);
        let up = 1.0 + 8.0 * U64;
        Ok(StoredPair {
            trees: [a, b],
            is_in_range,
            lengths: StoredLengths {
                error: (error_a + error_b) * up,
                unit: exp2(greater(first.exponent, second.exponent)),
            },
            greater_error: greater(error_a, error_b) * up,
            first,
            pose,
        })
    }

    pub(super) fn models(&self) -> Models<'_> {
        let [a, b] = self.trees;
        Models { a, b, pose: &self.pose }
    }

    pub(super) fn leaves(&self) -> LeafGaps<'_> {
        LeafGaps { pose: &self.pose, surface_error: self.greater_error, way: [0.0; 3] }
    }

    /// A place in the first model's frame, input units, from common units and the first model's
    /// origin.
    pub(super) fn place(&self, [x, y, z]: [f64; 3]) -> [f32; 3] {
        let [frame, _] = &self.pose.frames;
        let (unit, size) = (f64::from(frame.unit), exp2(self.first.exponent));
        let [a, b, c] = self.first.origin;
        [x / unit + a, y / unit + b, z / unit + c]
            .map(|x| ((x * size) as f32).clamp(-f32::MAX, f32::MAX))
    }
}
