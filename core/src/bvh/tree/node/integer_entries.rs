//! A segment against the boxes of a node, without floating point.
//!
//! Parameters are whole numbers of a fraction of the segment. They tell nearly all children that
//! are missed, and of the others the axis that decides. Only that axis' parameter is computed in
//! f32, so that every key has the bits of the wide form. Margins: `core/docs/rounding.md` §9.

use super::keys::CHILD_MASK;
use super::opened_node::{OpenedNode, Pushed, Pusher};
use super::slab_planes::SlabPlanes;
use super::slab_ray::{Fraction, SlabRay};
use crate::geom::fan::WIDTH;
use crate::num::{greater, lesser, truncated};
use crate::query::ScratchEntry;

/// Whole parameters of byte 0 are below this, and 255 steps are.
const MOST: u32 = 1 << 28;
/// Two whole parameters that differ by more have the order of those in f32.
const SURE: i32 = 1024;
/// Before all parameters; after all, with the opposite sign.
const BEFORE: i32 = -(1 << 30);

/// Whole parameters of byte 0, and of a step.
#[derive(Clone, Copy)]
struct IntAxis {
    enter: i32,
    leave: i32,
    step: i32,
}

/// Pushes the children of a node whose boxes the segment enters.
#[inline(always)]
pub(super) fn push(
    planes: &SlabPlanes<'_>,
    ray: &SlabRay,
    opened: &OpenedNode,
    slots: &mut [ScratchEntry; WIDTH],
) -> Pushed {
    let &OpenedNode { node, count, bound, limit } = opened;
    let mut pusher = Pusher::new(node, slots);
    let Fraction { bits, steep } = ray.fraction;
    // What does not fit counts as after all parameters. As one of an axis it is beyond `MOST`, and
    // the node is decided in f32.
    let whole = |x: f32| truncated(x, bits).unwrap_or(-BEFORE);
    let (first, last) = (whole(f32::from_bits(bound)), whole(f32::from_bits(limit)));
    let (mut parameters, mut steps) = (0, 0);
    let mut of_axis = |number: usize| {
        if steep >> number & 1 != 0 {
            return IntAxis { enter: BEFORE, leave: -BEFORE, step: 0 };
        }
        let axis = &planes.0[number];
        let [enter, leave, step] = [whole(axis.enter), whole(axis.leave), whole(axis.step)];
        parameters |= enter.unsigned_abs() | leave.unsigned_abs();
        steps |= step.unsigned_abs();
        IntAxis { enter, leave, step }
    };
    let (x, y, z) = (of_axis(0), of_axis(1), of_axis(2));
    let fits = parameters < MOST && steps < MOST / 256;
    let is_sure = steep == 0;
    let [px, py, pz] = &planes.0;
    for child in 0..lesser(count as usize, WIDTH) {
        let plane = |row: &[u8; WIDTH]| i32::from(row[child % WIDTH]);
        if fits {
            let enter_x = plane(px.near) * x.step + x.enter;
            let enter_y = plane(py.near) * y.step + y.enter;
            let enter_z = plane(pz.near) * z.step + z.enter;
            let leave_x = plane(px.far) * x.step + x.leave;
            let leave_y = plane(py.far) * y.step + y.leave;
            let leave_z = plane(pz.far) * z.step + z.leave;
            let enter = greater(greater(first, enter_x), greater(enter_y, enter_z));
            let leave = lesser(lesser(last, leave_x), lesser(leave_y, leave_z));
            if enter > leave + SURE {
                continue;
            }
            // Certainly entered: only axes within `SURE` of the latest entry can decide the key.
            if is_sure && enter + SURE < leave {
                let mut key = bound.cast_signed();
                let from = enter - SURE;
                for (axis, whole) in planes.0.iter().zip([enter_x, enter_y, enter_z]) {
                    if whole >= from {
                        key = greater(key, axis.at(axis.near[child % WIDTH], axis.enter));
                    }
                }
                pusher.push(key.cast_unsigned() & !CHILD_MASK | child as u32);
                continue;
            }
        }
        if let Some(key) = planes.entry(child, [bound, limit]) {
            pusher.push(key);
        }
    }
    pusher.finish()
}
