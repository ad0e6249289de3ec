//! A point in the frame of a model that a pose moved. Derivation: `core/docs/rounding.md` §15.

use super::inverse::PoseInverse;
use super::world_lengths::WorldLengths;
use crate::geom::{Pose, dot};
use crate::num::tolerance::{POSED_POINT, U64};
use crate::num::up_to_f32;
use crate::query::answer::Interval;
use crate::query::error::QueryError;

/// A point that a [`Pose`] carried into a model's frame, with the error that distances there carry.
///
/// It serves every question about points: [`Bvh::closest_point`](crate::Bvh::closest_point),
/// [`CoherentQuery`](crate::CoherentQuery), [`Sweep::move_to`](crate::Sweep::move_to) and the
/// others. Point and model may both move between two questions.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct PosedPoint {
    /// The point to ask about, in the model's frame.
    pub point: [f32; 3],
    /// The place that the pose carries exactly onto the point of the world is no farther than this
    /// from [`point`](Self::point), model's frame.
    pub error: f32,
    stretch: f64,
}

impl PosedPoint {
    /// The interval of the distance in the world, from that in the model's frame.
    ///
    /// If the lower bound is above 0, the side that
    /// [`signed_distance`](crate::Bvh::signed_distance) tells of [`point`](Self::point) is that of
    /// the point in the world. For winding numbers ask
    /// [`with_error`](crate::Bvh::with_error) of [`error`](Self::error).
    pub fn distance(&self, in_model: Interval) -> Interval {
        self.lengths().in_world(in_model)
    }

    /// The distance to ask [`Bvh::within`](crate::Bvh::within) about. If the model is not within
    /// this distance of [`point`](Self::point), the moved model is not within `distance` of the
    /// point in the world. If it is, the moved model may be farther than `distance` by rounding:
    /// [`distance`](Self::distance) of the closest point is then the interval to compare.
    /// `within` refuses the result of a NaN, of an infinite distance, and of one that leaves f32. A
    /// negative distance may become one above 0.
    pub fn model_distance(&self, distance: f32) -> f32 {
        self.lengths().at_most(distance)
    }

    fn lengths(&self) -> WorldLengths {
        WorldLengths { error: f64::from(self.error), stretch: self.stretch }
    }
}

impl Pose {
    /// Carries a point of the world into the frame of the model that this pose moves.
    ///
    /// The pose's numbers are taken as exact. The matrix need not be a perfect rotation: every
    /// [`PosedPoint::distance`] includes its stretch. An orthonormal matrix gives the narrowest
    /// intervals.
    ///
    /// For a segment carry both ends. The common points with the moved model are then those of the
    /// carried segment with [`Bvh::with_error`](crate::Bvh::with_error) of the larger `error`, at
    /// the same parameters.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Pose, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let turned = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    /// let pose = Pose::rigid(turned, [300.0, 0.0, 0.0]);
    /// let here = pose.to_model([310.0, 5.0, 40.0])?;
    /// let near = part.closest_point(here.point, Budget::EXACT, &mut scratch)?;
    /// let (distance, place) = (here.distance(near.distance), pose.to_world(near.point));
    /// assert!(distance.lower > 0.0 && place[0] > 200.0);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// Cost: some hundred operations in f64.
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::PoseOutOfDomain`] if the matrix's columns are far
    /// from orthonormal (a reflection is accepted); [`QueryError::OutOfDomain`] if the carried
    /// point is beyond f32's range.
    pub fn to_model(&self, world: [f32; 3]) -> Result<PosedPoint, QueryError> {
        let (rows, shift) = self.wide();
        let world = world.map(f64::from);
        if !rows.iter().flatten().chain(&shift).chain(&world).all(|x| x.is_finite()) {
            return Err(QueryError::NotFinite);
        }
        let inverse = PoseInverse::new(rows)?;
        let stretch = inverse.stretch;
        let ([wx, wy, wz], [tx, ty, tz]) = (world, shift);
        let [r0, r1, r2] = rows;
        let residual = |at: [f64; 3]| {
            let rest = |row, world: f64, shift: f64| world - shift - dot(row, at);
            [rest(r0, wx, tx), rest(r1, wy, ty), rest(r2, wz, tz)]
        };
        let at = inverse.apply([wx - tx, wy - ty, wz - tz]);
        let point = at.map(|x| x as f32);
        if !point.iter().all(|x| x.is_finite()) {
            return Err(QueryError::OutOfDomain);
        }
        let at = point.map(f64::from);
        let [x, y, z] = residual(at);
        let size = |row: [f64; 3], left: f64, world: f64, shift: f64| {
            let terms = dot(row.map(f64::abs), at.map(f64::abs)) + world.abs() + shift.abs();
            left.abs() + POSED_POINT * U64 * terms
        };
        let sizes = [size(r0, x, wx, tx), size(r1, y, wy, ty), size(r2, z, wz, tz)];
        // The inverse carries the residual back. It stretches by at most 1 / (1 − stretch).
        let error = libm::sqrt(dot(sizes, sizes)) / (1.0 - stretch) * (1.0 + POSED_POINT * U64);
        Ok(PosedPoint { point, error: up_to_f32(error), stretch })
    }

    /// The place to which the pose takes a point of the model, rounded to f32. Finite numbers stay
    /// finite.
    pub fn to_world(&self, model: [f32; 3]) -> [f32; 3] {
        self.carry(model.map(f64::from)).map(|x| (x as f32).clamp(-f32::MAX, f32::MAX))
    }

    /// The place to which the pose takes a point of the model, in f64.
    pub(crate) fn carry(&self, model: [f64; 3]) -> [f64; 3] {
        let (rows, [a, b, c]) = self.wide();
        let [x, y, z] = rows.map(|row| dot(row, model));
        [x + a, y + b, z + c]
    }
}
