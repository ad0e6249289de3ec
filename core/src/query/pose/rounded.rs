//! Poses that were computed, and how far rounding may have moved a model. Derivation:
//! `core/docs/rounding.md` §25.

use super::rotation::{is_rotation, longest, skew_of};
use crate::geom::{Pose, dot, transposed};
use crate::num::greater;
use crate::num::tolerance::{POSE_PRODUCT, POSE_SHIFT, POSE_UP, QUATERNION, U32};
use crate::query::error::QueryError;

/// A pose that was computed, and how far it may be from the exact one.
///
/// ```
/// use meshsweep_core::{Pose, RoundedPose};
/// // A link that is turned by its joint, and the joint at its place.
/// let half = core::f32::consts::FRAC_1_SQRT_2;
/// let joint = Pose::of_quaternion([0.0, 0.0, half, half], [0.0, 0.0, 0.3])?;
/// let base = RoundedPose::exact(Pose { translation: [1.0, 0.0, 0.0], ..Pose::IDENTITY });
/// let link = joint.then(&base);
/// // No point within half a metre of the link's origin is farther off than this.
/// let slack = link.motion(0.5);
/// assert!(slack < 2e-6);
/// # Ok::<(), meshsweep_core::QueryError>(())
/// ```
///
/// Each function rounds f32 in one order, and so gives the same bits on every target.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct RoundedPose {
    /// The pose.
    pub pose: Pose,
    /// The matrix is no farther from the exact one than this, as a factor of lengths: about
    /// radians.
    pub turn: f32,
    /// The translation is no farther from the exact one than this, in its unit.
    pub shift: f32,
}

impl RoundedPose {
    /// A pose whose numbers are exact.
    pub const fn exact(pose: Pose) -> RoundedPose {
        RoundedPose { pose, turn: 0.0, shift: 0.0 }
    }

    /// A pose that is known up to `turn` and `shift`, as from an encoder. Their signs do not count.
    pub const fn within(pose: Pose, turn: f32, shift: f32) -> RoundedPose {
        RoundedPose { pose, turn: turn.abs(), shift: shift.abs() }
    }

    /// No point of a model is farther than this from its place at the exact pose. `radius`: all
    /// points of the model are within it of the model's origin. The distance of two models differs
    /// from that at their exact poses by at most the sum of both motions: add it to the distance
    /// that is asked about.
    pub fn motion(&self, radius: f32) -> f32 {
        (self.turn * radius + self.shift) * POSE_UP + f32::MIN_POSITIVE
    }

    /// The motion of this pose, and then that of `next`: from a link's frame to its parent's, then
    /// from the parent's to the world.
    ///
    /// What both were off before is in the result's rounding. A pose that overflows f32, or is not
    /// finite, is refused where it is asked about.
    ///
    /// Cost: some 200 instructions of a Cortex-M4F.
    pub fn then(&self, next: &RoundedPose) -> RoundedPose {
        let (first, second) = (&self.pose, &next.pose);
        let rotation = second.rotation.map(|row| product(row, &first.rotation));
        let [x, y, z] = second.rotation.map(|row| dot(row, first.translation));
        let [a, b, c] = second.translation;
        let [before, after] =
            [longest(skew_of(&first.rotation)), longest(skew_of(&second.rotation))];
        let (away, by) = (size(first.translation), size(second.translation));
        let turn = after * self.turn
            + next.turn * (before + self.turn)
            + after * before * (POSE_PRODUCT * U32);
        let shift = after * self.shift
            + next.turn * (away + self.shift)
            + next.shift
            + (after * away + by) * (POSE_SHIFT * U32);
        RoundedPose {
            pose: Pose {
                rotation,
                translation: [x + a, y + b, z + c],
                is_affine: first.is_affine || second.is_affine,
            },
            turn: up(turn),
            shift: up(shift),
        }
    }

    /// The motion back.
    ///
    /// The matrix is the transpose, and what it lacks of the inverse is in the rounding: some 1e-7
    /// for a matrix that was rounded to f32.
    ///
    /// # Errors
    /// [`QueryError::NotRigid`] if the matrix is no rotation, also if the pose [is
    /// affine](Pose::is_affine), or if [`turn`](Self::turn) is above a quarter;
    /// [`QueryError::NotFinite`].
    pub fn inverse(&self) -> Result<RoundedPose, QueryError> {
        RoundedPose::exact(Pose::IDENTITY).relative_to(self)
    }

    /// This pose as seen from `frame`: the motion of this pose, then the motion back of `frame`.
    /// [`Bvh::distance_to`](crate::Bvh::distance_to) and the other questions about two models want
    /// the second model's pose relative to the first's.
    ///
    /// # Errors
    /// Those of [`inverse`](Self::inverse), about `frame`.
    pub fn relative_to(&self, frame: &RoundedPose) -> Result<RoundedPose, QueryError> {
        let rows = &frame.pose.rotation;
        let lack = skew_of(rows);
        if !(is_rotation(rows, lack) && frame.turn <= 0.25) {
            let is_finite = rows.iter().flatten().all(|x| x.is_finite());
            return Err(if is_finite { QueryError::NotRigid } else { QueryError::NotFinite });
        }
        let back = transposed(rows);
        let (moved, [a, b, c]) = (&self.pose, frame.pose.translation);
        let [x, y, z] = moved.translation;
        let between = [x - a, y - b, z - c];
        let longest_back = longest(lack);
        let before = longest(skew_of(&moved.rotation));
        // The inverse of the matrix, and that of the exact one, make no length longer than this.
        let lack = lack * POSE_UP + 16.0 * U32;
        let inverse = (1.0 + lack) * POSE_UP;
        let exact = inverse / (1.0 - inverse * frame.turn) * POSE_UP;
        let off = (lack + exact * frame.turn) * inverse * POSE_UP;
        let away = size(between);
        let turn = longest_back * self.turn
            + off * (before + self.turn)
            + longest_back * before * (POSE_PRODUCT * U32);
        let shift = off * away
            + exact * (self.shift + frame.shift + away * (2.0 * U32))
            + longest_back * away * (POSE_SHIFT * U32);
        Ok(RoundedPose {
            pose: Pose {
                rotation: back.map(|row| product(row, &moved.rotation)),
                translation: back.map(|row| dot(row, between)),
                is_affine: moved.is_affine,
            },
            turn: up(turn),
            shift: up(shift),
        })
    }
}

impl Pose {
    /// The rotation of a quaternion `[x, y, z, w]`, then a translation. The quaternion's length
    /// does not matter; ROS, URDF and most libraries write the real part last as here, and some
    /// write it first.
    ///
    /// The matrix is within 2.1e-6 of that of the quaternion's numbers. Cost: some 100 instructions
    /// of a Cortex-M4F.
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::NotRigid`] for a quaternion of zeros.
    pub fn of_quaternion(
        quaternion: [f32; 4],
        translation: [f32; 3],
    ) -> Result<RoundedPose, QueryError> {
        if !quaternion.iter().chain(&translation).all(|x| x.is_finite()) {
            return Err(QueryError::NotFinite);
        }
        let most = quaternion.iter().fold(0.0, |most, x| greater(most, x.abs()));
        if most == 0.0 {
            return Err(QueryError::NotRigid);
        }
        // Neither overflow nor underflow: exact powers of two.
        const HIGH: f32 = (1u64 << 50) as f32;
        let scale = if most < 1.0 / HIGH {
            HIGH * HIGH
        } else if most > HIGH {
            1.0 / (HIGH * HIGH)
        } else {
            1.0
        };
        let [x, y, z, w] = quaternion.map(|x| x * scale);
        let (xx, yy, zz) = (x * x, y * y, z * z);
        let (xy, yz, zx) = (x * y, y * z, z * x);
        let (xw, yw, zw) = (x * w, y * w, z * w);
        let s = 2.0 / (((w * w + xx) + yy) + zz);
        let rotation = [
            [1.0 - s * (yy + zz), s * (xy - zw), s * (zx + yw)],
            [s * (xy + zw), 1.0 - s * (xx + zz), s * (yz - xw)],
            [s * (zx - yw), s * (yz + xw), 1.0 - s * (xx + yy)],
        ];
        let pose = Pose { rotation, translation, is_affine: false };
        Ok(RoundedPose { pose, turn: QUATERNION * U32, shift: 0.0 })
    }

    /// [`RoundedPose::then`] of poses whose numbers are exact.
    pub fn then(&self, next: &Pose) -> RoundedPose {
        RoundedPose::exact(*self).then(&RoundedPose::exact(*next))
    }

    /// [`RoundedPose::inverse`] of a pose whose numbers are exact.
    ///
    /// # Errors
    /// Those of [`RoundedPose::inverse`].
    pub fn inverse(&self) -> Result<RoundedPose, QueryError> {
        RoundedPose::exact(*self).inverse()
    }

    /// [`RoundedPose::relative_to`] of poses whose numbers are exact.
    ///
    /// # Errors
    /// Those of [`RoundedPose::relative_to`].
    pub fn relative_to(&self, frame: &Pose) -> Result<RoundedPose, QueryError> {
        RoundedPose::exact(*self).relative_to(&RoundedPose::exact(*frame))
    }
}

/// Room for the roundings of a bound and of what it is made of, and for what underflows.
fn up(bound: f32) -> f32 {
    bound * POSE_UP + f32::MIN_POSITIVE
}

/// A row, times a matrix.
fn product(row: [f32; 3], &[[a, b, c], [d, e, f], [g, h, i]]: &[[f32; 3]; 3]) -> [f32; 3] {
    [dot(row, [a, d, g]), dot(row, [b, e, h]), dot(row, [c, f, i])]
}

/// An upper bound of a length.
fn size([x, y, z]: [f32; 3]) -> f32 {
    ((x.abs() + y.abs()) + z.abs()) * POSE_UP
}
