//! A model at its place, its box in the world, and the pose of another one in its frame.

use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::input_box::corners_of_input;
use crate::geom::{Pose, dot};
use crate::num::tolerance::{LEAST_WORLD_GAP, POSED_POINT, RELATIVE_POSE, U32, U64, WORLD_BOX};
use crate::num::{down_to_f32, greater, sqrt_approx, up_to_f32};
use crate::query::{Interval, PoseInverse, QueryError, transposed};

/// A model at its place in a [`Scene`](crate::Scene).
#[derive(Clone, Copy, Debug)]
pub struct PlacedModel<'a> {
    /// The model.
    pub tree: Bvh<'a>,
    /// Where it is: from its frame to the world.
    pub pose: Pose,
}

/// An axis-aligned box in the world.
#[derive(Clone, Copy)]
pub(crate) struct WorldBox {
    middle: [f32; 3],
    /// Half of the edges, and room for the rounding of all.
    half: [f32; 3],
}

impl WorldBox {
    pub(crate) fn new(placed: &PlacedModel<'_>) -> WorldBox {
        let [low, high] = placed.tree.bounds();
        let error = placed.tree.surface_error();
        let mut found = WorldBox { middle: placed.pose.translation, half: [0.0; 3] };
        let sides = found.middle.iter_mut().zip(&mut found.half);
        for ((middle, half), row) in sides.zip(&placed.pose.rotation) {
            let mut size = middle.abs();
            for (entry, (low, high)) in row.iter().zip(low.iter().zip(&high)) {
                *middle += entry * (0.5 * low + 0.5 * high);
                *half += entry.abs() * (0.5 * high - 0.5 * low + error);
                size += entry.abs() * (low.abs() + high.abs() + error);
            }
            *half += size * (WORLD_BOX * U32) + f32::MIN_POSITIVE;
        }
        found
    }

    /// A lower bound of the distance; 0 where numbers leave f32's range.
    pub(crate) fn gap(&self, other: &WorldBox) -> f32 {
        let mut square = 0.0;
        let sides = self.middle.iter().zip(&self.half).zip(other.middle.iter().zip(&other.half));
        for ((a, half), (b, other_half)) in sides {
            let gap = (a - b).abs() - (half + other_half);
            // Not a number is no gap, nor is one with a square below f32's normal range.
            let gap = if gap > LEAST_WORLD_GAP { gap } else { 0.0 };
            square += gap * gap;
        }
        let gap = if square < f32::INFINITY { sqrt_approx(square) } else { 0.0 };
        gap * (1.0 - 16.0 * U32)
    }
}

/// The pose of one model in the frame of another, and how distances there differ from those in the
/// world.
pub(crate) struct Relative {
    pub(crate) pose: Pose,
    /// A vertex is no farther than this from its place at that pose, in the first model's frame.
    pub(crate) error: f64,
    /// The first model's pose changes lengths by a factor within `1 ± stretch`.
    stretch: f64,
}

impl Relative {
    /// The poses were [checked](check_pose).
    pub(crate) fn new(
        first: &PlacedModel<'_>,
        second: &PlacedModel<'_>,
    ) -> Result<Relative, QueryError> {
        let ((a_rows, a_shift), (b_rows, b_shift)) = (wide(&first.pose), wide(&second.pose));
        let inverse = PoseInverse::new(a_rows)?;
        let stretch = inverse.stretch;
        let ([ax, ay, az], [bx, by, bz]) = (a_shift, b_shift);
        let m_rows = transposed(&transposed(&b_rows).map(|column| inverse.apply(column)));
        let m_shift = inverse.apply([bx - ax, by - ay, bz - az]);
        let pose = Pose {
            rotation: m_rows.map(|row| row.map(|x| x as f32)),
            translation: m_shift.map(|x| x as f32),
        };
        if !pose.translation.iter().all(|x| x.is_finite()) {
            return Err(QueryError::OutOfDomain);
        }
        // As rounded.
        let (m_rows, m_shift) = wide(&pose);
        let mut largest = 0.0;
        // How far off a point is, is a convex function of the point: a corner of the box is worst.
        for x in corners_of_input(&second.tree) {
            let [p, q, r] = m_rows.map(|row| dot(row, x));
            let [u, v, w] = m_shift;
            let carried = [p + u, q + v, r + w];
            let sizes = |row: Row, v: Row| dot(row.map(f64::abs), v.map(f64::abs));
            // B·x + t − (A·(M·x + m) + s) along an axis, and room for its rounding.
            let residual = |a_row: Row, b_row: Row, s: f64, t: f64| {
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
        Ok(Relative { pose, error, stretch })
    }

    /// The distance in the world, from that in the first model's frame.
    pub(crate) fn in_world(&self, distance: Interval) -> Interval {
        let lower = (f64::from(distance.lower) - self.error) * (1.0 - self.stretch);
        let upper = (f64::from(distance.upper) + self.error) * (1.0 + self.stretch);
        Interval::new(down_to_f32(greater(lower, 0.0)), up_to_f32(upper))
    }

    /// If nothing is within this distance in the first model's frame, nothing is within `distance`
    /// in the world.
    pub(crate) fn at_most(&self, distance: f32) -> f32 {
        let in_model = f64::from(distance) / (1.0 - self.stretch) + self.error;
        up_to_f32(in_model * (1.0 + 4.0 * U64))
    }

    /// What is within this distance in the first model's frame is within `distance` in the world.
    /// `None` if no distance is.
    pub(crate) fn at_least(&self, distance: f32) -> Option<f32> {
        let in_model = (f64::from(distance) / (1.0 + self.stretch)) * (1.0 - 4.0 * U64);
        let in_model = in_model - self.error * (1.0 + 4.0 * U64);
        (in_model >= 0.0).then(|| down_to_f32(in_model))
    }
}

/// Refuses a pose that is not finite, or far from a rotation.
pub(crate) fn check_pose(pose: &Pose) -> Result<(), QueryError> {
    if !pose.rotation.iter().flatten().chain(&pose.translation).all(|x| x.is_finite()) {
        return Err(QueryError::NotFinite);
    }
    PoseInverse::new(wide(pose).0).map(|_| ())
}

type Row = [f64; 3];

fn wide(pose: &Pose) -> ([Row; 3], Row) {
    (pose.rotation.map(|row| row.map(f64::from)), pose.translation.map(f64::from))
}
