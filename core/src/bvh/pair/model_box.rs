//! The box of a model in its own frame, in f32, and what it proves of two models.

use crate::bvh::tree::extended::unit_exponent;
use crate::bvh::tree::format::Bvh;
use crate::geom::{Pose, Rows, columns, turned};
use crate::num::tolerance::{BOX_PAIR, MODEL_BOX, NEARLY_RIGID, SKEW, SQUARE_FLOOR, U32};
use crate::num::{above_zero, exp2_f32, greater};
use crate::query::{QueryError, RelativePose, skew};
use glam::Vec3;

/// A box that holds the surface of the input. `core/docs/rounding.md` §24.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ModelBox {
    pub(crate) middle: Vec3,
    /// Half of the edges. The surface error and all roundings are in it.
    pub(crate) half: Vec3,
    /// No point of the box has a larger 1-norm.
    pub(crate) reach: f32,
}

impl ModelBox {
    /// In input units.
    pub(crate) fn of(tree: &Bvh<'_>) -> ModelBox {
        let [low, high] = tree.bounds().map(Vec3::from_array);
        ModelBox::new(low, high, tree.surface_error())
    }

    /// In grid units times a power of two.
    #[inline(always)]
    fn in_units(tree: &Bvh<'_>, unit: f32) -> ModelBox {
        let (low, high) = tree.grid_bounds();
        ModelBox::new(low * unit, high * unit, tree.units().surface_error * unit)
    }

    #[inline(always)]
    fn new(low: Vec3, high: Vec3, error: f32) -> ModelBox {
        let size = low.abs() + high.abs() + error;
        let sizes = size.x + size.y + size.z;
        let room = sizes * (MODEL_BOX * U32) + f32::MIN_POSITIVE;
        ModelBox {
            middle: 0.5 * low + 0.5 * high,
            half: (0.5 * high - 0.5 * low) + (error + room),
            reach: sizes + room,
        }
    }
}

/// Whether the boxes prove that the surface of the second model, moved by a pose from its frame to
/// the first one's, is farther than `distance` from the first one's.
///
/// # Errors
/// Those of [`RelativePose::check`], and trees without boxes for segments.
#[inline(never)]
pub(crate) fn are_apart(
    [a, b]: [&Bvh<'_>; 2],
    pose: &Pose,
    distance: f32,
) -> Result<bool, QueryError> {
    if !(a.serves_segments() && b.serves_segments()) {
        return Err(QueryError::NO_SEGMENTS);
    }
    let exponents = [unit_exponent(a), unit_exponent(b)];
    RelativePose::check(pose, exponents)?;
    // In units of the coarser grid, so that answers do not depend on the scale of all.
    let [first, second] = exponents;
    let common = greater(first, second);
    let units = if first == common { a.units() } else { b.units() };
    let [first, second] = [(a, first), (b, second)]
        .map(|(tree, own)| ModelBox::in_units(tree, exp2_f32(own - common)));
    let shift = units.inward_point(pose.translation);
    Ok(are_boxes_apart([&first, &second], &pose.rotation, shift, units.inward(distance)))
}

/// [`are_apart`] in common units. The caller has checked that entries of the matrix are at most 2.
#[inline(always)]
fn are_boxes_apart(
    [first, second]: [&ModelBox; 2],
    rotation: &[[f32; 3]; 3],
    shift: Vec3,
    distance: f32,
) -> bool {
    let rows = rotation.map(Vec3::from_array);
    let offset = (turned(&rows, second.middle) + shift) - first.middle;
    let size = shift.abs();
    // A point of the second model goes through sums of up to six times its 1-norm.
    let sizes = (size.x + size.y + size.z) + 6.0 * second.reach + 2.0 * first.reach;
    let slack = sizes * (BOX_PAIR * U32);
    if exceeds(gap_sq(offset, first.half, &rows, second.half), distance + slack) {
        return true;
    }
    if (offset.abs() - first.half).max_element() <= 0.0 {
        // The middle of one is inside the other.
        return false;
    }
    let skew = skew(&rows) + SKEW * U32;
    let columns = columns(&rows);
    skew < NEARLY_RIGID
        && exceeds(
            gap_sq(turned(&columns, offset), second.half, &columns, first.half),
            distance + (slack + 4.0 * skew * sizes),
        )
}

/// The squared gap of two boxes along the axes of the first box. `rows` turn the second box's frame
/// into the first's. `offset` goes from the first middle to the second, in the first frame.
#[inline(always)]
pub(crate) fn gap_sq(offset: Vec3, half: Vec3, rows: &Rows, other_half: Vec3) -> f32 {
    let [x, y, z] = rows.map(Vec3::abs);
    beyond_sq((offset.abs() - half) - turned(&[x, y, z], other_half))
}

/// The squared length of a gap's components above 0. NaN is no gap.
#[inline(always)]
pub(crate) fn beyond_sq(gap: Vec3) -> f32 {
    let [x, y, z] = gap.to_array().map(above_zero);
    (x * x + y * y) + z * z
}

/// Whether a squared length, with its roundings, proves a length above `least`. `false` for NaN.
#[inline(always)]
pub(crate) fn exceeds(square: f32, least: f32) -> bool {
    let least = least * (1.0 + 8.0 * U32);
    square > least * least + SQUARE_FLOOR
}
