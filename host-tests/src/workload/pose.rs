//! Poses of a moved copy of a mesh.

use glam::{DMat3, DQuat, DVec3};
use meshsweep_core::Pose as CorePose;

use crate::generate::Rng;

use super::Subject;
use super::sphere::Sphere;

/// Greatest distance of the two spheres' centres, in radii. Spheres reach 2, so some pairs are
/// apart.
pub const FARTHEST: f64 = 2.2;

/// p ↦ `rotation`·p + `shift`.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    /// The rotation as a unit quaternion, rounded.
    pub turn: DQuat,
    /// The rotation.
    pub rotation: DMat3,
    /// Added after the rotation.
    pub shift: DVec3,
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
        Self { turn, rotation, shift }
    }

    /// The core's pose with all its digits. The quaternion is the nearest one: that of `near`.
    #[must_use]
    pub fn exact(core: &CorePose, near: &Self) -> Self {
        let columns = core.rotation.map(|row| row.map(f64::from));
        let rotation = DMat3::from_cols_array_2d(&columns).transpose();
        let shift = DVec3::from_array(core.translation.map(f64::from));
        Self { turn: near.turn, rotation, shift }
    }

    /// The pose rounded to f32.
    #[must_use]
    pub fn rounded(&self) -> CorePose {
        let single = |row: DVec3| row.to_array().map(|x| x as f32);
        let rotation = [0, 1, 2].map(|k| single(self.rotation.row(k)));
        CorePose::rigid(rotation, single(self.shift))
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

/// Random poses of a mesh in a sphere: each in f64, and rounded to the f32 pose that the core
/// takes.
pub fn poses(sphere: &Sphere, count: usize) -> impl Iterator<Item = (Pose, CorePose)> {
    let mut rng = Rng::new(0x0070_6f73_6573);
    (0..count).map(move |_| {
        let pose = Pose::random(&mut rng, sphere, FARTHEST);
        let core = pose.rounded();
        (Pose::exact(&core, &pose), core)
    })
}

/// The sphere that the poses are about.
#[must_use]
pub fn sphere(subject: &Subject) -> Sphere {
    let points: Vec<DVec3> =
        subject.mesh.positions.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect();
    Sphere::enclosing(&points)
}
