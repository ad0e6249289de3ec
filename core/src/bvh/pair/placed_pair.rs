//! Two models that are placed in the world, in the frame of one of them.

use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::input_box::corners_of_input;
use crate::geom::{Point, Pose, dot, transposed};
use crate::num::greater;
use crate::num::tolerance::{POSED_POINT, RELATIVE_POSE, U64};
use crate::query::{PoseInverse, QueryError, WorldLengths};

/// The pose of one model in the frame of another, and how distances there differ from those in the
/// world.
pub(crate) struct PlacedPair {
    pub(crate) pose: Pose,
    /// Distances in the first model's frame, and those in the world.
    pub(crate) lengths: WorldLengths,
}

impl PlacedPair {
    /// `tree` is the second model. The first pose is nearly a rotation.
    pub(crate) fn new(
        first: &Pose,
        second: &Pose,
        tree: &Bvh<'_>,
    ) -> Result<PlacedPair, QueryError> {
        let ((a_rows, a_shift), (b_rows, b_shift)) = (first.wide(), second.wide());
        let inverse = PoseInverse::new(a_rows)?;
        let stretch = inverse.stretch;
        let ([ax, ay, az], [bx, by, bz]) = (a_shift, b_shift);
        let m_rows = transposed(&transposed(&b_rows).map(|column| inverse.apply(column)));
        let m_shift = inverse.apply([bx - ax, by - ay, bz - az]);
        let pose = Pose {
            rotation: m_rows.map(|row| row.map(|x| x as f32)),
            translation: m_shift.map(|x| x as f32),
            is_affine: true,
        };
        if !pose.translation.iter().all(|x| x.is_finite()) {
            return Err(QueryError::OutOfDomain);
        }
        // As rounded.
        let (m_rows, m_shift) = pose.wide();
        let mut largest = 0.0;
        // How far off a point is, is a convex function of the point: a corner of the box is worst.
        for x in corners_of_input(tree) {
            let [p, q, r] = m_rows.map(|row| dot(row, x));
            let [u, v, w] = m_shift;
            let carried = [p + u, q + v, r + w];
            let sizes = |row: Point<f64>, v: Point<f64>| dot(row.map(f64::abs), v.map(f64::abs));
            // B·x + t − (A·(M·x + m) + s) along an axis, and room for its rounding.
            let residual = |a_row: Point<f64>, b_row: Point<f64>, s: f64, t: f64| {
                let terms = sizes(a_row, m_rows.map(|row| sizes(row, x)))
                    + sizes(a_row, m_shift)
                    + sizes(b_row, x)
                    + s.abs()
                    + t.abs();
                let left = dot(b_row, x) + (t - s) - dot(a_row, carried);
                left.abs() + RELATIVE_POSE * U64 * terms
            };
            let ([a0, a1, a2], [b0, b1, b2]) = (a_rows, b_rows);
            let off =
                [residual(a0, b0, ax, bx), residual(a1, b1, ay, by), residual(a2, b2, az, bz)];
            let off_sq = dot(off, off);
            if !off_sq.is_finite() {
                return Err(QueryError::OutOfDomain);
            }
            largest = greater(largest, off_sq);
        }
        let error = libm::sqrt(largest) / (1.0 - stretch) * (1.0 + POSED_POINT * U64);
        Ok(PlacedPair { pose, lengths: WorldLengths { error, stretch } })
    }
}
