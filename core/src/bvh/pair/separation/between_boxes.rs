//! The direction between the boxes of two models.

use super::grid_pose::GridPose;
use crate::bvh::pair::direction::Direction;
use crate::bvh::tree::format::Bvh;
use crate::geom::{Rows, columns, turned};
use crate::num::dot;
use glam::Vec3;

/// How two boxes lie along the axes of one of them.
struct BoxGap {
    /// The gap along each axis, towards the second box. 0 along an axis on which the boxes overlap.
    gap: Vec3,
    gap_sq: f32,
    /// A unit vector towards the second box, along the axis of the greatest gap. If the boxes meet,
    /// along the axis of the least overlap.
    axis: Vec3,
    /// The gap along this axis. Below 0: the overlap, times −1.
    along: f32,
}

impl BoxGap {
    fn new(offset: Vec3, half: Vec3, rows: &Rows, other_half: Vec3) -> BoxGap {
        let gaps = (offset.abs() - half) - turned(&rows.map(Vec3::abs), other_half);
        let signs = Vec3::ONE.copysign(offset);
        let gap = gaps.max(Vec3::ZERO) * signs;
        let [x, y, z] = gaps.to_array();
        let (axis, along) = if x >= y && x >= z {
            (Vec3::X, x)
        } else if y >= z {
            (Vec3::Y, y)
        } else {
            (Vec3::Z, z)
        };
        BoxGap { gap, gap_sq: dot(gap, gap), axis: axis * signs, along }
    }
}

/// The direction of the gap of both models' boxes, along the axes of the model that shows the
/// longer gap. If the boxes meet: the axis of the least overlap.
#[inline(never)]
pub(crate) fn between_boxes(pose: &GridPose<'_>) -> Option<Direction> {
    let boxes = |tree: &Bvh<'_>, origin: Vec3| {
        let (low, high) = tree.grid_bounds();
        (0.5 * low + 0.5 * high - origin, 0.5 * high - 0.5 * low)
    };
    let ([a, b], [origin_a, origin_b]) = (pose.trees, pose.origins);
    let ((middle_a, half_a), (middle_b, half_b)) = (boxes(a, origin_a), boxes(b, origin_b));
    let offset = pose.moved(middle_b) - middle_a;
    let first = BoxGap::new(offset, half_a, &pose.rows, half_b);
    let turned_back = pose.rows.map(|row| row * (1.0 / pose.ratio));
    let axes = columns(&turned_back);
    let second = BoxGap::new(turned(&axes, offset), half_b * pose.ratio, &axes, half_a);
    let back = |vector: Vec3| turned(&turned_back, vector);
    let found = if first.gap_sq > 0.0 || second.gap_sq > 0.0 {
        if second.gap_sq > first.gap_sq { back(second.gap) } else { first.gap }
    } else if second.along > first.along {
        back(second.axis)
    } else {
        first.axis
    };
    Direction::of(found).or_else(|| Direction::of(first.axis))
}
