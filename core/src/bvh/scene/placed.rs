//! A model at its place, its box in the world, and the pose of another one in its frame.

use crate::bvh::format::Bvh;
use crate::bvh::input_box::corners_of_input;
use crate::geom::{Pose, dot};
use crate::num::tolerance::{POSED_POINT, U32, U64};
use crate::num::{down_to_f32, greater, sqrt_approx, up_to_f32};
use crate::query::{Interval, PoseInverse, QueryError, transposed};

/// A model at its place in a [`Scene`](super::Scene).
#[derive(Clone, Copy, Debug)]
pub struct Placed<'a> {
    /// The model.
    pub tree: Bvh<'a>,
    /// Where it is: from its frame to the world.
    pub pose: Pose,
}

/// An axis-aligned box in the world.
#[derive(Clone, Copy)]
pub(super) struct WorldBox {
    middle: [f32; 3],
    /// Half of the edges, and room for the rounding of all.
    half: [f32; 3],
}

impl WorldBox {
    pub(super) fn new(placed: &Placed<'_>) -> WorldBox {
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
            *half += size * (BOX_ROUNDING * U32) + f32::MIN_POSITIVE;
        }
        found
    }

    /// A lower bound of the distance; 0 where numbers leave f32's range.
    pub(super) fn gap(&self, other: &WorldBox) -> f32 {
        let mut square = 0.0;
        let sides = self.middle.iter().zip(&self.half).zip(other.middle.iter().zip(&other.half));
        for ((a, half), (b, other_half)) in sides {
            let gap = (a - b).abs() - (half + other_half);
            // Not a number is no gap.
            let gap = if gap > 0.0 { gap } else { 0.0 };
            square += gap * gap;
        }
        let gap = if square < f32::INFINITY { sqrt_approx(square) } else { 0.0 };
        gap * (1.0 - 16.0 * U32)
    }
}

/// Rounding of a box in the world, in units of [`U32`] times the sizes of its terms. Proved: 13
/// (§21).
const BOX_ROUNDING: f32 = 16.0;

/// The pose of one model in the frame of another, and how distances there differ from those in the
/// world.
pub(super) struct Relative {
    pub(super) pose: Pose,
    /// A vertex is no farther than this from its place at that pose, in the first model's frame.
    error: f64,
    /// The first model's pose changes lengths by a factor within `1 ± stretch`.
    stretch: f64,
}

impl Relative {
    pub(super) fn new(first: &Placed<'_>, second: &Placed<'_>) -> Result<Relative, QueryError> {
        let wide = |pose: &Pose| {
            (pose.rotation.map(|row| row.map(f64::from)), pose.translation.map(f64::from))
        };
        let ((rows, shift), (other, other_shift)) = (wide(&first.pose), wide(&second.pose));
        let numbers = [&first.pose, &second.pose]
            .into_iter()
            .flat_map(|pose| pose.rotation.iter().flatten().chain(&pose.translation));
        if !numbers.into_iter().all(|x| x.is_finite()) {
            return Err(QueryError::NotFinite);
        }
        let inverse = PoseInverse::new(rows)?;
        let stretch = inverse.stretch;
        let ([ax, ay, az], [bx, by, bz]) = (shift, other_shift);
        let way = [bx - ax, by - ay, bz - az];
        let matrix = transposed(&transposed(&other).map(|column| inverse.of(column)));
        let pose = Pose {
            rotation: matrix.map(|row| row.map(|x| x as f32)),
            translation: inverse.of(way).map(|x| x as f32),
        };
        if !pose.translation.iter().all(|x| x.is_finite()) {
            return Err(QueryError::OutOfDomain);
        }
        let (matrix, place) = wide(&pose);
        let mut largest = 0.0;
        // How far off a point is, is a convex function of the point: a corner of the box is worst.
        for point in corners_of_input(&second.tree) {
            let [x, y, z] = matrix.map(|row| dot(row, point));
            let [a, b, c] = place;
            let here = [x + a, y + b, z + c];
            let left = |row: [f64; 3], turned: [f64; 3], way: f64, a: f64, b: f64| {
                let sizes = |row: [f64; 3], v: [f64; 3]| dot(row.map(f64::abs), v.map(f64::abs));
                // Of `here` too, whose terms are larger than itself.
                let terms = sizes(row, matrix.map(|m| sizes(m, point)))
                    + sizes(row, place)
                    + sizes(turned, point)
                    + a.abs()
                    + b.abs();
                (dot(turned, point) + way - dot(row, here)).abs() + 2.0 * POSED_POINT * U64 * terms
            };
            let ([r0, r1, r2], [m0, m1, m2], [wx, wy, wz]) = (rows, other, way);
            let off =
                [left(r0, m0, wx, ax, bx), left(r1, m1, wy, ay, by), left(r2, m2, wz, az, bz)];
            largest = greater(largest, dot(off, off));
        }
        let error = libm::sqrt(largest) / (1.0 - stretch) * (1.0 + POSED_POINT * U64);
        Ok(Relative { pose, error, stretch })
    }

    /// The distance in the world, from that in the first model's frame.
    pub(super) fn in_world(&self, distance: Interval) -> Interval {
        let lower = (f64::from(distance.lower) - self.error) * (1.0 - self.stretch);
        let upper = (f64::from(distance.upper) + self.error) * (1.0 + self.stretch);
        Interval::new(down_to_f32(greater(lower, 0.0)), up_to_f32(upper))
    }

    /// If nothing is within this distance in the first model's frame, nothing is within `distance`
    /// in the world.
    pub(super) fn at_most(&self, distance: f32) -> f32 {
        let in_model = f64::from(distance) / (1.0 - self.stretch) + self.error;
        up_to_f32(in_model * (1.0 + 4.0 * U64))
    }

    /// What is within this distance in the first model's frame is within `distance` in the world.
    /// `None` if no distance is.
    pub(super) fn at_least(&self, distance: f32) -> Option<f32> {
        let in_model = (f64::from(distance) / (1.0 + self.stretch)) * (1.0 - 4.0 * U64);
        let in_model = in_model - self.error * (1.0 + 4.0 * U64);
        (in_model >= 0.0).then(|| down_to_f32(in_model))
    }
}
