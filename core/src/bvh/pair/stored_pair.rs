//! Two trees in one frame, and the conversion of results to input units.

use super::gaps::leaf_gaps::LeafGaps;
use crate::bvh::tree::extended::extended;
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::stored_lengths::StoredLengths;
use crate::geom::Pose;
use crate::num::tolerance::U64;
use crate::num::{exp2, greater};
use crate::query::{CommonPose, Extended, QueryError, RelativePose, VertexPose};

/// Two trees for the search in f64: the pose without surface errors, and these errors apart.
pub(crate) struct StoredPair<'a> {
    pub(crate) trees: [&'a Bvh<'a>; 2],
    pose: Pose,
    /// Its vertex errors hold rounding only, no surface errors. In range no length is beyond 2^30
    /// common units, so bounds in f32 hold.
    pub(crate) common: CommonPose,
    /// Holds the sum of both surface errors.
    pub(crate) lengths: StoredLengths,
    /// The larger surface error, common units.
    greater_error: f64,
    first: Extended,
    second: Extended,
}

/// A place of the second model, its units and from its origin, in common units and from the first
/// model's origin.
pub(crate) fn moved(pose: &VertexPose, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let ([r0, r1, r2], [c0, c1, c2]) = (pose.matrix, pose.shift_f64);
    let along = |row: [f32; 3], shift: f64| {
        let [a, b, c] = row.map(f64::from);
        (a * x + b * y) + (c * z + shift)
    };
    [along(r0, c0), along(r1, c1), along(r2, c2)]
}

impl<'a> StoredPair<'a> {
    pub(crate) fn new([a, b]: [&'a Bvh<'a>; 2], pose: &Pose) -> Result<StoredPair<'a>, QueryError> {
        if !(a.serves_segments() && b.serves_segments()) {
            return Err(QueryError::NO_SEGMENTS);
        }
        let (first, second) = (extended(a), extended(b));
        // Surface errors are added to the answer once. So the pose has none.
        let [error_a, error_b] = [first.error, second.error];
        let (first, second) = (Extended { error: 0.0, ..first }, Extended { error: 0.0, ..second });
        let common = RelativePose::relate(&first, &second, pose)?;
        let vertices = &common.vertices;
        let [unit, _] = vertices.units.map(f64::from);
        let (error_a, error_b) = (error_a * unit, error_b * vertices.longest);
        let up = 1.0 + 8.0 * U64;
        Ok(StoredPair {
            trees: [a, b],
            lengths: StoredLengths {
                error: (error_a + error_b) * up,
                unit: exp2(greater(first.exponent, second.exponent)),
            },
            greater_error: greater(error_a, error_b) * up,
            first,
            second,
            pose: *pose,
            common,
        })
    }

    /// The pose for the search in f64.
    pub(crate) fn relative(&self) -> RelativePose {
        let Self { first, second, pose, common, .. } = self;
        RelativePose::along_axes(first, second, pose, common).0
    }

    pub(crate) fn leaves(&self) -> LeafGaps<'_> {
        LeafGaps {
            pose: &self.common.vertices,
            surface_error: self.greater_error,
            direction: [0.0; 3],
            offset: [0.0; 3],
        }
    }

    /// A place in the first model's frame, input units, from common units and the first model's
    /// origin.
    pub(crate) fn to_input(&self, point: [f64; 3]) -> [f32; 3] {
        self.to_input_f64(point).map(|x| (x as f32).clamp(-f32::MAX, f32::MAX))
    }

    /// The same, rounded to f64.
    pub(crate) fn to_input_f64(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let ([unit, _], size) =
            (self.common.vertices.units.map(f64::from), exp2(self.first.exponent));
        let [a, b, c] = self.first.origin;
        [x / unit + a, y / unit + b, z / unit + c].map(|x| x * size)
    }

    /// A place of the second model, its grid units, in common units and from the first model's
    /// origin.
    pub(crate) fn moved(&self, vertex: [f32; 3]) -> [f64; 3] {
        let [x, y, z] = vertex.map(f64::from);
        let [a, b, c] = self.second.origin;
        moved(&self.common.vertices, [x - a, y - b, z - c])
    }
}
