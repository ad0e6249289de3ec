//! Where the links of a mechanism are, from the places of its joints. Derivation:
//! `core/docs/rounding.md` §27.

use super::rounded::RoundedPose;
use crate::geom::Pose;
use crate::num::half_turn;
use crate::num::tolerance::{TURN, U32};
use crate::query::error::QueryError;

/// A joint, and the link that it carries.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Joint {
    /// Index of the joint whose link carries this one. It is less than the joint's own. `None`: the
    /// world.
    pub parent: Option<u16>,
    /// The link's frame in that of its parent, while the joint's place is 0.
    pub origin: RoundedPose,
    /// How the link moves.
    pub kind: JointKind,
}

/// How a joint moves its link.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum JointKind {
    /// Not at all.
    Fixed,
    /// The link turns about the axis by the place, in radians. Beyond 8192 it is refused.
    Turns(JointAxis),
    /// The link slides along the axis by the place, in the unit of length.
    Slides(JointAxis),
}

/// The axis of a joint, and its place.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct JointAxis {
    /// A unit vector in the link's frame, each coordinate rounded to f32. Proper rounding leaves
    /// its squared length within 8 roundoffs of 1; anything else is refused.
    pub direction: [f32; 3],
    /// Which of the places is this joint's.
    pub place: u16,
    /// Of a joint that follows another one, `[factor, offset]`: it is at `factor · place + offset`.
    /// Both are rounded to f32, and the factor is 0 or a normal number. `None`: the joint is at the
    /// place.
    pub follows: Option<[f32; 2]>,
}

impl JointAxis {
    /// An axis with a place of its own.
    pub const fn new(direction: [f32; 3], place: u16) -> JointAxis {
        JointAxis { direction, place, follows: None }
    }

    /// The joint's place, and how far it may be from the exact one.
    fn place(&self, places: &[f32]) -> Result<(f32, f32), QueryError> {
        let place = *places.get(usize::from(self.place)).ok_or(QueryError::NoJoint)?;
        let [x, y, z] = self.direction;
        let size_sq = (x * x + y * y) + z * z;
        if !place.is_finite() || !size_sq.is_finite() {
            return Err(QueryError::NotFinite);
        }
        if (size_sq - 1.0).abs() > 8.0 * U32 {
            return Err(QueryError::NotRigid);
        }
        let Some([factor, offset]) = self.follows else { return Ok((place, 0.0)) };
        let scaled = factor * place;
        let off = (scaled.abs() + offset.abs()) * (4.0 * U32) + f32::MIN_POSITIVE;
        Ok((scaled + offset, off))
    }
}

impl Joint {
    /// The link's frame in that of its parent.
    fn pose(&self, places: &[f32]) -> Result<RoundedPose, QueryError> {
        let moved = match &self.kind {
            JointKind::Fixed => return Ok(self.origin),
            JointKind::Turns(axis) => {
                let (angle, off) = axis.place(places)?;
                let [sine, cosine] = half_turn(angle).ok_or(QueryError::OutOfDomain)?;
                let [x, y, z] = axis.direction;
                let quaternion = [x * sine, y * sine, z * sine, cosine];
                let pose = Pose::of_quaternion(quaternion, [0.0; 3])?.pose;
                RoundedPose::within(pose, (TURN * U32 + off) * (1.0 + 4.0 * U32), 0.0)
            }
            JointKind::Slides(axis) => {
                let (way, off) = axis.place(places)?;
                let [x, y, z] = axis.direction;
                let pose = Pose { translation: [x * way, y * way, z * way], ..Pose::IDENTITY };
                let off = (off + way.abs() * (2.0 * U32)) * (1.0 + 8.0 * U32);
                RoundedPose::within(pose, 0.0, off + f32::MIN_POSITIVE)
            }
        };
        Ok(moved.then(&self.origin))
    }
}

/// Where the links of a mechanism are: forward kinematics.
///
/// `places`: the angle or the way of each joint that moves, taken as exact. Errors of encoders come
/// on top. `out`: one for each joint. It gets the pose of the joint's link in the world, with its
/// rounding. After an error its content says nothing.
///
/// Cost: at most, for each joint that moves, one [`Pose::of_quaternion`], a sine and a cosine, and
/// two [`RoundedPose::then`]; for a fixed one, one `then`.
///
/// ```
/// use meshsweep_core::{Joint, JointAxis, JointKind, Pose, RoundedPose, link_poses};
/// let at = |x: f32| RoundedPose::exact(Pose { translation: [x, 0.0, 0.0], ..Pose::IDENTITY });
/// let about_z = |place| JointKind::Turns(JointAxis::new([0.0, 0.0, 1.0], place));
/// let arm = [
///     Joint { parent: None, origin: at(0.1), kind: about_z(0) },
///     Joint { parent: Some(0), origin: at(0.5), kind: about_z(1) },
/// ];
/// let mut links = [RoundedPose::exact(Pose::IDENTITY); 2];
/// link_poses(&arm, &[core::f32::consts::FRAC_PI_2, 0.0], &mut links)?;
/// let [x, y, _] = links[1].pose.translation;
/// assert!((x - 0.1).abs() < 1e-6 && (y - 0.5).abs() < 1e-6);
/// // No point within half a metre of the second link's origin is farther off than this.
/// assert!(links[1].motion(0.5) < 1e-5);
/// # Ok::<(), meshsweep_core::QueryError>(())
/// ```
///
/// # Errors
/// [`QueryError::NoJoint`] for a parent that is not before its joint, a place that is not given, or
/// an `out` of another length than `joints`; [`QueryError::NotFinite`] for a place or an axis;
/// [`QueryError::OutOfDomain`] for an angle beyond 8192, or one that is NaN by `follows`;
/// [`QueryError::NotRigid`] for an axis that is no unit vector.
pub fn link_poses(
    joints: &[Joint],
    places: &[f32],
    out: &mut [RoundedPose],
) -> Result<(), QueryError> {
    if joints.len() != out.len() {
        return Err(QueryError::NoJoint);
    }
    for (index, joint) in joints.iter().enumerate() {
        let (done, rest) = out.split_at_mut_checked(index).ok_or(QueryError::NoJoint)?;
        let own = joint.pose(places)?;
        let pose = match joint.parent {
            None => own,
            Some(parent) => own.then(done.get(usize::from(parent)).ok_or(QueryError::NoJoint)?),
        };
        *rest.first_mut().ok_or(QueryError::NoJoint)? = pose;
    }
    Ok(())
}
