//! Poses of quaternions, products and inverses.

use meshsweep_core::{Pose, RoundedPose};

use crate::error::Error;
use crate::memory::{AnyBits, In, Out};
use crate::question::PoseC;

/// `msw_rounded_pose`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "meshsweep.h says it")]
pub struct RoundedPoseC {
    pub pose: PoseC,
    pub turn: f32,
    pub shift: f32,
}

// SAFETY: floats.
unsafe impl AnyBits for RoundedPoseC {}
// SAFETY: floats.
unsafe impl AnyBits for [f32; 4] {}

impl Default for RoundedPoseC {
    /// All zeros: no question takes it.
    fn default() -> Self {
        let pose = PoseC { rotation: [[0.0; 3]; 3], translation: [0.0; 3], is_affine: 0 };
        RoundedPoseC { pose, turn: 0.0, shift: 0.0 }
    }
}

impl RoundedPoseC {
    const fn rounded(self) -> RoundedPose {
        RoundedPose::within(self.pose.pose(), self.turn, self.shift)
    }
}

impl From<RoundedPose> for RoundedPoseC {
    fn from(RoundedPose { pose, turn, shift, .. }: RoundedPose) -> Self {
        RoundedPoseC { pose: PoseC::of(pose), turn, shift }
    }
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_pose_of_quaternion(
    quaternion: In<[f32; 4]>,
    translation: In<[f32; 3]>,
    answer: Out<RoundedPoseC>,
) -> i32 {
    answer.answer(|| Ok(Pose::of_quaternion(quaternion.get()?, translation.get()?)?.into()))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_pose_then(
    first: In<RoundedPoseC>,
    next: In<RoundedPoseC>,
    answer: Out<RoundedPoseC>,
) -> i32 {
    answer.answer(|| Ok(first.get()?.rounded().then(&next.get()?.rounded()).into()))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_pose_inverse(pose: In<RoundedPoseC>, answer: Out<RoundedPoseC>) -> i32 {
    answer.answer(|| Ok(pose.get()?.rounded().inverse()?.into()))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_pose_relative_to(
    pose: In<RoundedPoseC>,
    frame: In<RoundedPoseC>,
    answer: Out<RoundedPoseC>,
) -> i32 {
    answer.answer(|| Ok(pose.get()?.rounded().relative_to(&frame.get()?.rounded())?.into()))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_pose_motion(pose: In<RoundedPoseC>, radius: f32, answer: Out<f32>) -> i32 {
    answer.answer(|| Ok::<f32, Error>(pose.get()?.rounded().motion(radius)))
}
