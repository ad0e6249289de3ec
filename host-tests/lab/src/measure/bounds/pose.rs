//! Poses as programs have them, in f32, and as parry3d takes them.

use meshsweep_core::Pose as Matrix;
use meshsweep_host_tests::workload::pose::Pose;
use parry3d::math::{Pose as ParryPose, Rotation, Vector};

/// A pose in f32.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// Rows of the rotation, and the shift.
    pub matrix: Matrix,
    /// The same for parry3d.
    pub parry: ParryPose,
}

impl Motion {
    /// Rounds a pose.
    #[must_use]
    pub fn of(pose: &Pose) -> Self {
        Self { matrix: pose.rounded(), parry: parry(pose) }
    }

    /// Where a point goes.
    #[inline(always)]
    #[must_use]
    pub fn apply(&self, point: [f32; 3]) -> [f32; 3] {
        let [x, y, z] = self.turn(point);
        let [u, v, w] = self.matrix.translation;
        [x + u, y + v, z + w]
    }

    /// Where a direction goes.
    #[inline(always)]
    #[must_use]
    pub fn turn(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        self.matrix.rotation.map(|[a, b, c]| a * x + b * y + c * z)
    }
}

/// A pose for parry3d, rounded to f32.
#[must_use]
pub fn parry(pose: &Pose) -> ParryPose {
    let [x, y, z, w] = pose.turn.to_array().map(|part| part as f32);
    let shift = Vector::from_array(pose.shift.to_array().map(|x| x as f32));
    ParryPose::from_parts(shift, Rotation::from_xyzw(x, y, z, w).normalize())
}
