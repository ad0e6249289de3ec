//! A model at its place in the world, and what boxes and balls prove of two of them.

use super::model_ball::ModelBall;
use super::model_box::{ModelBox, beyond_sq, exceeds, gap_sq};
use super::separation::grid_pose::FramePose;
use crate::bvh::tree::format::Bvh;
use crate::geom::{Pose, Rows, columns, turned};
use crate::num::tolerance::{BOX_PAIR, MOTION, NEARLY_RIGID, SEPARATION_POSE, SKEW, U32};
use crate::num::{difference, dot, exp2_f32, greater, lesser, sqrt_approx, sqrt_below};
use crate::query::{PoseInverse, QueryError, check_rigid, is_rotation, skew};
use glam::Vec3;

/// A model at its place in a [`Scene`](crate::Scene).
///
/// It knows its box and its ball in the world, so it is placed once for all pairs and questions.
/// RAM: 120 bytes beside the tree's.
#[derive(Clone, Copy, Debug)]
pub struct PlacedModel<'a> {
    pub(crate) tree: Bvh<'a>,
    pub(crate) pose: Pose,
    bounds: ModelBox,
    ball: ModelBall,
    place: Place,
}

/// What changes with the pose.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// The ball's middle in the world.
    centre: Vec3,
    /// Twice the model's reach plus the 1-norm of the translation: its part of F in §24 of
    /// `core/docs/rounding.md`.
    far: f32,
    /// Upper bound of [`skew`].
    skew: f32,
}

/// Two models are farther apart than `sqrt(square) − less`, in the world.
#[derive(Clone, Copy)]
pub(crate) struct WorldGap {
    square: f32,
    less: f32,
}

/// Greater squares count as this one. The root of an infinite square is infinite, and no motion
/// would use up an infinite clearance.
const SQUARE_CAP: f32 = exp2_f32(126);

impl WorldGap {
    /// Whether the models are farther than `distance`.
    #[inline(always)]
    fn proves(&self, distance: f32) -> bool {
        exceeds(self.square, distance + self.less)
    }

    /// A lower bound of the distance. Not infinite.
    pub(crate) fn gap(&self) -> f32 {
        let square = lesser(self.square, SQUARE_CAP);
        sqrt_below(square) - self.less * (1.0 + 8.0 * U32)
    }

    /// How much farther than `distance` the models certainly are, by a root that loses less.
    #[cold]
    #[inline(never)]
    pub(crate) fn sharp_clearance(&self, distance: f32) -> f32 {
        let square = lesser(self.square, SQUARE_CAP);
        let gap = sqrt_approx(square) * (1.0 - 8.0 * U32) - self.less * (1.0 + 8.0 * U32);
        (gap - distance) * (1.0 - 4.0 * U32)
    }
}

impl<'a> PlacedModel<'a> {
    /// A model at a pose: from its frame to the world.
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::NotRigid`] if the matrix is no rotation, unless the
    /// pose is [affine](Pose::affine); [`QueryError::PoseOutOfDomain`] if the matrix of an affine
    /// pose is far from a rotation.
    pub fn new(tree: Bvh<'a>, pose: Pose) -> Result<Self, QueryError> {
        let bounds = ModelBox::of(&tree);
        let ball = ModelBall::around(&bounds);
        let place = Place::new(&bounds, ball.middle, &pose)?;
        Ok(PlacedModel { tree, pose, bounds, ball, place })
    }

    /// The same model with a ball that is at most 1 % larger than the least one, if that is smaller
    /// than the ball around its box.
    ///
    /// More pairs are then told to be clear without a look into the trees. Do it once, at the
    /// start, and [`move_to`](Self::move_to) afterwards. Cost: 16 looks at each vertex.
    #[must_use]
    pub fn with_least_ball(mut self) -> Self {
        if let Some(ball) = ModelBall::of(&self.tree)
            && ball.radius < self.ball.radius
        {
            let size = ball.middle.abs();
            let reach = (size.x + size.y + size.z) * (1.0 + 4.0 * U32);
            let bounds = ModelBox { reach: greater(self.bounds.reach, reach), ..self.bounds };
            // The pose was checked.
            if let Ok(place) = Place::new(&bounds, ball.middle, &self.pose) {
                (self.bounds, self.ball, self.place) = (bounds, ball, place);
            }
        }
        self
    }

    /// Moves the model to another pose. If the pose is refused, the model stays where it was.
    ///
    /// Cost: some 40 operations in f32.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn move_to(&mut self, pose: Pose) -> Result<(), QueryError> {
        self.place = Place::new(&self.bounds, self.ball.middle, &pose)?;
        self.pose = pose;
        Ok(())
    }

    /// Places the model where its pose was changed to.
    #[inline(never)]
    pub(crate) fn place_again(&mut self) -> Result<(), QueryError> {
        self.place = Place::new(&self.bounds, self.ball.middle, &self.pose)?;
        Ok(())
    }

    /// The model.
    pub const fn tree(&self) -> &Bvh<'a> {
        &self.tree
    }

    /// Where it is: from its frame to the world.
    pub const fn pose(&self) -> &Pose {
        &self.pose
    }

    /// The middle of its ball, in its own frame.
    #[inline(always)]
    pub(crate) fn ball_middle(&self) -> Vec3 {
        self.ball.middle
    }

    /// The radius of its ball, and room for the roundings of a motion.
    pub(crate) fn arm(&self) -> f32 {
        (self.ball.radius + self.bounds.reach * (MOTION * U32)) * (1.0 + 4.0 * U32)
    }

    /// Upper bound of [`skew`].
    #[inline(always)]
    pub(crate) fn skew(&self) -> f32 {
        self.place.skew
    }

    /// A proof that this model and another one are farther than `distance` from each other in the
    /// world, if their balls and boxes prove it. One that proves `more` as well ends the search.
    /// `core/docs/rounding.md` §24.
    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    pub(crate) fn apart(
        &self,
        other: &PlacedModel<'_>,
        distance: f32,
        more: f32,
    ) -> Option<WorldGap> {
        let (a, b) = (&self.place, &other.place);
        let slack = (a.far + b.far) * (BOX_PAIR * U32 + 4.0 * (a.skew + b.skew));
        let offset = difference(b.centre, a.centre);
        let balls = WorldGap {
            square: dot(offset, offset),
            less: (self.ball.radius + other.ball.radius) + slack,
        };
        if balls.proves(distance + more) {
            return Some(balls);
        }
        self.apart_by_boxes(other, [distance, more], slack, balls)
    }

    /// The same by the boxes, if the balls do not prove enough.
    #[inline(never)]
    fn apart_by_boxes(
        &self,
        other: &PlacedModel<'_>,
        [distance, more]: [f32; 2],
        slack: f32,
        balls: WorldGap,
    ) -> Option<WorldGap> {
        let mut found = balls.proves(distance).then_some(balls);
        // Keeps the last proof, not the one with the longest gap: to compare gaps takes roots.
        let mut is_enough = |square: f32, less: f32| {
            let proof = WorldGap { square, less };
            if proof.proves(distance) {
                found = Some(proof);
            }
            proof.proves(distance + more)
        };
        let [rows, other_rows] = [self, other].map(|model| columns(&model.rows()));
        let (a, b) = (&self.place, &other.place);
        if is_enough(self.ball_gap_sq(&rows, b.centre), other.ball.radius + slack)
            || is_enough(other.ball_gap_sq(&other_rows, a.centre), self.ball.radius + slack)
        {
            return found;
        }
        // The second box in the frame of the first.
        let middle = turned(&other.rows(), other.bounds.middle) + other.translation();
        let offset = self.seen(&rows, middle);
        let relative = other_rows.map(|column| turned(&rows, column));
        let back = relative;
        let relative = columns(&relative);
        let (half, other_half) = (self.bounds.half, other.bounds.half);
        if !is_enough(gap_sq(offset, half, &relative, other_half), slack) {
            is_enough(gap_sq(turned(&back, offset), other_half, &back, half), slack);
        }
        found
    }

    /// The pose of another model in the frame of this one, for questions about a distance in the
    /// world. `None` if a matrix is far from a rotation. `core/docs/rounding.md` §26.
    #[inline(always)]
    pub(crate) fn pose_of(&self, other: &PlacedModel<'_>, distance: f32) -> Option<FramePose> {
        let (a, b) = (&self.place, &other.place);
        let rows = columns(&self.rows());
        let turned_columns = columns(&other.rows()).map(|column| turned(&rows, column));
        let far = (a.far + b.far) * (SEPARATION_POSE * U32 + 0.5 * a.skew);
        (a.skew < NEARLY_RIGID && b.skew < NEARLY_RIGID).then(|| FramePose {
            rows: columns(&turned_columns),
            shift: turned(&rows, difference(other.translation(), self.translation())),
            error: far + 2.0 * a.skew * distance + f32::MIN_POSITIVE,
        })
    }

    /// The squared distance of a place in the world from the box. `columns` are the pose's.
    #[inline(always)]
    fn ball_gap_sq(&self, columns: &Rows, centre: Vec3) -> f32 {
        beyond_sq(self.seen(columns, centre).abs() - self.bounds.half)
    }

    /// A place in the world, in the model's frame from the middle of its box.
    #[inline(always)]
    fn seen(&self, columns: &Rows, place: Vec3) -> Vec3 {
        turned(columns, difference(place, self.translation())) - self.bounds.middle
    }

    #[inline(always)]
    fn rows(&self) -> Rows {
        self.pose.rotation.map(Vec3::from_array)
    }

    #[inline(always)]
    fn translation(&self) -> Vec3 {
        Vec3::from_array(self.pose.translation)
    }
}

impl Place {
    #[inline(always)]
    fn new(bounds: &ModelBox, middle: Vec3, pose: &Pose) -> Result<Place, QueryError> {
        let rows = pose.rotation.map(Vec3::from_array);
        let shift = Vec3::from_array(pose.translation);
        let size = shift.abs();
        let far = (size.x + size.y + size.z) + 2.0 * bounds.reach;
        let skew = skew(&rows) + SKEW * U32;
        let is_sound = is_rotation(&pose.rotation, skew) || pose.is_affine && skew < NEARLY_RIGID;
        if !(is_sound && far < f32::INFINITY) {
            check_pose(pose)?;
        }
        Ok(Place { centre: turned(&rows, middle) + shift, far, skew })
    }
}

/// Refuses a pose that is not finite, no rotation, or, if it may be any, far from one.
#[cold]
#[inline(never)]
fn check_pose(pose: &Pose) -> Result<(), QueryError> {
    if !pose.rotation.iter().flatten().chain(&pose.translation).all(|x| x.is_finite()) {
        return Err(QueryError::NotFinite);
    }
    check_rigid(pose)?;
    PoseInverse::new(pose.wide().0).map(|_| ())
}
