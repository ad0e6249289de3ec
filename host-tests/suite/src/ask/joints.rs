//! Where the links of a mechanism are. It needs no blob.

use super::refusal;
use crate::fold::Fold;
pub use meshsweep_core::{Joint, JointAxis, JointKind, RoundedPose};
pub use meshsweep_core::{Pose, QueryError, link_poses};

/// A mechanism, its places, and memory for the answer.
#[derive(Debug)]
pub struct Mechanism<'a> {
    /// Parents first.
    pub joints: &'a [Joint],
    /// Of the joints.
    pub places: &'a [f32],
    /// As many as joints.
    pub poses: &'a mut [RoundedPose],
}

/// Asks for the poses of all links.
#[inline(never)]
pub fn ask(mechanism: &mut Mechanism<'_>, fold: &mut Fold) {
    let Mechanism { joints, places, poses } = mechanism;
    match link_poses(joints, places, poses) {
        Ok(()) => {
            for RoundedPose { pose, turn, shift, .. } in poses.iter() {
                pose.rotation.iter().chain([&pose.translation]).for_each(|row| fold.point(*row));
                [*turn, *shift].into_iter().for_each(|bound| fold.f32(bound));
            }
        }
        Err(error) => refusal(fold, error),
    }
}
