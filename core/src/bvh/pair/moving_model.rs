//! A model that moves, and a bound of how far its points went.

use super::placed_model::PlacedModel;
use crate::geom::Pose;
use crate::num::tolerance::NEARLY_RIGID;
use crate::num::{difference, dot, sqrt_above};
use crate::query::QueryError;
use glam::Vec3;

/// A model of a [`CoherentScene`](crate::CoherentScene). `core/docs/rounding.md` §24.
#[derive(Clone, Copy, Debug)]
pub struct MovingModel<'a> {
    pub(crate) model: PlacedModel<'a>,
    /// How far a point goes for each unit that the matrix changes: the ball's radius, rounded up.
    arm: f32,
    /// Upper bound of the matrix's change since it was checked, Frobenius norm.
    unchecked_turn: f32,
    /// `model.place` is not yet that of `model.pose`.
    is_stale: bool,
}

/// Largest square for which [`sqrt_above`] is proved. Longer paths count as infinite.
const MOST_SQUARE: f32 = (1u64 << 60) as f32;

impl<'a> MovingModel<'a> {
    /// A model that stands still, with its least ball.
    pub fn new(model: PlacedModel<'a>) -> Self {
        let model = model.with_least_ball();
        MovingModel { model, arm: model.arm(), unchecked_turn: 0.0, is_stale: false }
    }

    /// Moves the model. Its ball and box in the world wait until a pair is asked about. Returns an
    /// upper bound of the path of its points.
    #[inline(always)]
    pub(crate) fn move_to(&mut self, pose: Pose) -> Result<f32, QueryError> {
        let [turn, path] = self.change(&pose);
        let unchecked_turn = self.unchecked_turn + turn;
        // A matrix that changed little is still nearly a rotation.
        if self.model.skew() + 3.0 * unchecked_turn < NEARLY_RIGID {
            self.model.pose = pose;
            (self.unchecked_turn, self.is_stale) = (unchecked_turn, true);
        } else {
            self.model.move_to(pose)?;
            (self.unchecked_turn, self.is_stale) = (0.0, false);
        }
        Ok(path)
    }

    /// Places the model where it is.
    #[inline(always)]
    pub(crate) fn place(&mut self) -> Result<(), QueryError> {
        if self.is_stale {
            self.model.place_again()?;
            (self.unchecked_turn, self.is_stale) = (0.0, false);
        }
        Ok(())
    }

    /// Upper bounds of the change of the matrix, the Frobenius norm, and of the path of a point.
    /// Infinite if they are large or NaN.
    #[inline(always)]
    fn change(&self, pose: &Pose) -> [f32; 2] {
        let change =
            |new: [f32; 3], old: [f32; 3]| difference(Vec3::from_array(new), Vec3::from_array(old));
        let ([x, y, z], [old_x, old_y, old_z]) = (pose.rotation, self.model.pose.rotation);
        let [x, y, z] = [change(x, old_x), change(y, old_y), change(z, old_z)];
        let middle = self.model.ball_middle();
        let displacement = Vec3::new(dot(x, middle), dot(y, middle), dot(z, middle))
            + change(pose.translation, self.model.pose.translation);
        let (turn_sq, displacement_sq) =
            (dot(x, x) + dot(y, y) + dot(z, z), dot(displacement, displacement));
        // NaN is no small change.
        if turn_sq + displacement_sq > MOST_SQUARE || (turn_sq + displacement_sq).is_nan() {
            return [f32::INFINITY; 2];
        }
        let [turn, displacement] = [turn_sq, displacement_sq].map(sqrt_above);
        [turn, displacement + turn * self.arm]
    }
}
