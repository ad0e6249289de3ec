//! Bounds that move as they are, in f32.

use glam::{DVec3, Vec3};
use meshsweep_host_tests::workload::sphere::Sphere;
use parry3d::math::Pose as ParryPose;

use super::{Motion, Moving, Rig, single};
use crate::measure::bounds::contact::Supports;
use crate::measure::bounds::convex_hull::ConvexHull;
use crate::measure::bounds::oriented_box::OrientedBox;

/// What is added to each cosine of the angle between two axes, which is 1 at most: rounding makes
/// the product of two parallel ones no direction that parts (Gottschalk et al. 1996). Ten
/// roundings; the test errs towards meeting.
const PARALLEL: f32 = 1e-6;

/// A sphere: one point moves, one comparison of squares.
#[must_use]
pub fn sphere(sphere: &Sphere) -> Box<dyn Rig> {
    let (centre, radius) = (single(sphere.centre), sphere.radius as f32);
    let reach_sq = 4.0 * radius * radius;
    let meets = move |a: &[f32; 3], b: &[f32; 3]| {
        Vec3::from_array(*a).distance_squared(Vec3::from_array(*b)) <= reach_sq
    };
    Box::new(Moving::new(centre, move |motion: &Motion| motion.apply(centre), meets))
}

/// A box along axes of its own.
#[derive(Clone, Copy)]
struct Oriented {
    axes: [Vec3; 3],
    centre: Vec3,
    half: [f32; 3],
}

impl Oriented {
    /// The 15 axes in the frame of the first box, parting ones told at once (Gottschalk et al.
    /// 1996).
    fn meets(&self, other: &Self) -> bool {
        let cosine = self.axes.map(|ours| other.axes.map(|theirs| ours.dot(theirs)));
        let size = cosine.map(|row| row.map(|x| x.abs() + PARALLEL));
        let between = other.centre - self.centre;
        let t = self.axes.map(|axis| axis.dot(between));
        let (a, b) = (self.half, other.half);
        for i in 0..3 {
            let reach = a[i] + b[0] * size[i][0] + b[1] * size[i][1] + b[2] * size[i][2];
            if t[i].abs() > reach {
                return false;
            }
        }
        for j in 0..3 {
            let along = t[0] * cosine[0][j] + t[1] * cosine[1][j] + t[2] * cosine[2][j];
            let reach = b[j] + a[0] * size[0][j] + a[1] * size[1][j] + a[2] * size[2][j];
            if along.abs() > reach {
                return false;
            }
        }
        for i in 0..3 {
            let (i1, i2) = ((i + 1) % 3, (i + 2) % 3);
            for j in 0..3 {
                let (j1, j2) = ((j + 1) % 3, (j + 2) % 3);
                let along = t[i2] * cosine[i1][j] - t[i1] * cosine[i2][j];
                let ours = a[i1] * size[i2][j] + a[i2] * size[i1][j];
                let theirs = b[j1] * size[i][j2] + b[j2] * size[i][j1];
                if along.abs() > ours + theirs {
                    return false;
                }
            }
        }
        true
    }
}

/// An oriented box: its axes and centre move.
#[must_use]
pub fn oriented(oriented: &OrientedBox) -> Box<dyn Rig> {
    let vector = |v: DVec3| Vec3::from_array(single(v));
    let axes = [oriented.axes.x_axis, oriented.axes.y_axis, oriented.axes.z_axis].map(vector);
    let rest = Oriented { axes, centre: vector(oriented.centre), half: single(oriented.half) };
    let update = move |motion: &Motion| Oriented {
        axes: rest.axes.map(|axis| Vec3::from_array(motion.turn(axis.to_array()))),
        centre: Vec3::from_array(motion.apply(rest.centre.to_array())),
        half: rest.half,
    };
    Box::new(Moving::new(rest, update, Oriented::meets))
}

/// A hull and its poses, of which parry3d's GJK asks the farthest vertex of all.
struct Hull {
    supports: Supports,
    poses: Vec<ParryPose>,
}

impl Rig for Hull {
    fn update(&mut self, motions: &[Motion]) {
        self.poses.clear();
        self.poses.extend(motions.iter().map(|motion| motion.parry));
    }

    fn test(&self, verdicts: &mut Vec<bool>) {
        verdicts.clear();
        verdicts.extend(self.poses.iter().map(|pose| self.supports.meets_moved(pose)));
    }
}

/// A convex hull: only its pose is kept.
#[must_use]
pub fn hull(hull: &ConvexHull) -> Box<dyn Rig> {
    Box::new(Hull { supports: Supports::new(hull), poses: Vec::new() })
}
