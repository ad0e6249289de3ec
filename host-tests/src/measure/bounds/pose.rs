//! Where a moved copy of the mesh is.

use glam::{DMat3, DQuat, DVec3};
use meshsweep_core::tribox::Pose as Matrix;
use parry3d::math::{Pose as ParryPose, Rotation, Vector};

use crate::generate::Rng;

use super::enclosing_sphere::Sphere;

/// p ↦ `rotation`·p + `shift`.
pub struct Pose {
    /// A rotation.
    pub rotation: DMat3,
    /// Added after it.
    pub shift: DVec3,
    /// Both for parry3d, rounded to f32.
    pub parry: ParryPose,
}

/// A pose as programs have it: in f32.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// Rows of the rotation, and the shift.
    pub matrix: Matrix,
    /// For parry3d.
    pub parry: ParryPose,
}

impl Motion {
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

impl Pose {
    /// A uniform rotation about the sphere's centre, then a uniform direction and a distance
    /// uniform in 0..`farthest` radii.
    pub fn random(rng: &mut Rng, sphere: &Sphere, farthest: f64) -> Self {
        let turn = loop {
            let part = [(); 4].map(|()| 2.0 * rng.unit_f64() - 1.0);
            let turn = DQuat::from_array(part);
            // Uniform in the ball, so uniform on the sphere of unit quaternions.
            if (1e-3..1.0).contains(&turn.length_squared()) {
                break turn.normalize();
            }
        };
        let away = DVec3::from_array(rng.direction().map(f64::from)).normalize();
        let distance = farthest * sphere.radius * rng.unit_f64();
        let rotation = DMat3::from_quat(turn);
        let shift = sphere.centre - rotation * sphere.centre + away * distance;
        let [x, y, z, w] = turn.to_array().map(|part| part as f32);
        let parry = ParryPose::from_parts(
            Vector::from_array(shift.to_array().map(|x| x as f32)),
            Rotation::from_xyzw(x, y, z, w).normalize(),
        );
        Self { rotation, shift, parry }
    }

    /// Rounded to f32.
    #[must_use]
    pub fn motion(&self) -> Motion {
        let single = |row: DVec3| row.to_array().map(|x| x as f32);
        let rotation = [0, 1, 2].map(|k| single(self.rotation.row(k)));
        Motion { matrix: Matrix { rotation, translation: single(self.shift) }, parry: self.parry }
    }

    /// A point moved.
    #[must_use]
    pub fn apply(&self, p: DVec3) -> DVec3 {
        self.rotation * p + self.shift
    }

    /// A vertex moved, then rounded to f32.
    #[must_use]
    pub fn apply_rounded(&self, p: [f32; 3]) -> [f32; 3] {
        self.apply(DVec3::from_array(p.map(f64::from))).to_array().map(|x| x as f32)
    }
}
