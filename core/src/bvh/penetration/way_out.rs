//! The upper end of the depth: translations that part two solids.
//!
//! Along a direction, the models are apart where their boxes are. From there the second one goes
//! straight to its pose. The surfaces do not meet before the first contact. So the solids are apart
//! until then, and the rest of the way is a translation that parts them.

use super::asking::Asking;
use super::deepest::{Deepest, unit};
use crate::bvh::input_box::corners_of_input;
use crate::bvh::overlap::quickest;
use crate::geom::{Pose, dot};
use crate::num::tolerance::{PARTED, U32, U64};
use crate::num::{greater, lesser, up_to_f32};
use crate::query::{Budget, Motion, QueryError};

type Point = [f64; 3];

/// Parts of the motion that are given up before contact, until the pose itself is proved to be
/// clear.
const BACK: [f32; 5] = [1.0 / 4194304.0, 1.0 / 262144.0, 1.0 / 16384.0, 1.0 / 1024.0, 1.0 / 64.0];

/// Where the models are apart.
#[derive(Clone, Copy)]
pub(super) struct WayOut {
    pub(super) apart: Option<Pose>,
    /// The length of the translation there, input units, rounded up.
    pub(super) length: f64,
    /// From the first model to the second at the contact.
    contact: Point,
}

/// The shortest translation that was found.
pub(super) fn search(
    asking: &mut Asking<'_, '_>,
    deepest: &Deepest,
    budget: &Budget,
) -> Result<WayOut, QueryError> {
    let mut best = WayOut { apart: None, length: f64::INFINITY, contact: [0.0; 3] };
    let [a, b] = deepest.from_surface.map(unit);
    let ([ax, ay, az], [bx, by, bz]) = (a, b);
    // Out of the first solid through its nearest wall, or with the nearest wall of the second one
    // behind.
    let ways = [
        unit([bx - ax, by - ay, bz - az]),
        a.map(|x| -x),
        b,
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    for way in ways {
        best.try_way(asking, way)?;
        if best.is_within(deepest.depth, budget) {
            return Ok(best);
        }
    }
    // Across the surfaces that were met.
    for _ in 0..3 {
        let before = best.length;
        best.try_way(asking, unit(best.contact))?;
        if best.length >= before || best.is_within(deepest.depth, budget) {
            break;
        }
    }
    Ok(best)
}

impl WayOut {
    /// Whether the depth is known as well as the budget asks.
    fn is_within(&self, lower: f64, budget: &Budget) -> bool {
        let lower = greater(lower, 0.0);
        let relative = lower * (1.0 + f64::from(budget.relative));
        self.length <= greater(relative, lower + f64::from(budget.absolute))
    }

    /// Tries to part the models along a unit vector.
    fn try_way(&mut self, asking: &mut Asking<'_, '_>, way: Point) -> Result<(), QueryError> {
        if way == [0.0; 3] || asking.is_spent() {
            return Ok(());
        }
        let pose = asking.pose;
        let Some(start) = beside(asking, way) else { return Ok(()) };
        let motion = Motion::straight(start, pose);
        let met = asking.first_contact(&motion)?;
        if met.is_clear() {
            (self.apart, self.length) = (Some(pose), 0.0);
            return Ok(());
        }
        let [_, b] = asking.trees;
        let (_, rounding) = quickest(b, &motion);
        for back in BACK {
            let at = motion.at(greater(met.clear_until - back, 0.0));
            let length = length_between(&at, &pose);
            if length >= self.length {
                return Ok(());
            }
            // The motion is clear there, and so are all places as near as rounding leaves them.
            if asking.is_clear(&at, up_to_f32(rounding))? {
                let [from, to] = met.points.map(|point| point.map(f64::from));
                let ([x, y, z], [u, v, w]) = (from, to);
                let contact = [u - x, v - y, w - z];
                *self = WayOut { apart: Some(at), length, contact };
                return Ok(());
            }
        }
        let length = length_between(&start, &pose);
        if length < self.length {
            *self = WayOut { apart: Some(start), length, contact: [0.0; 3] };
        }
        Ok(())
    }
}

/// The pose moved along a unit vector until the boxes are apart along it. `None` if f32 does not
/// reach there.
fn beside(asking: &Asking<'_, '_>, way: Point) -> Option<Pose> {
    let [a, b] = asking.trees;
    let mut most = f64::NEG_INFINITY;
    let mut size = 0.0;
    for corner in corners_of_input(a) {
        most = greater(most, dot(way, corner));
        size = greater(size, dot(corner.map(f64::abs), [1.0; 3]));
    }
    // A lower bound of where the second model begins along the way, and the size of its numbers.
    let begins = |pose: &Pose| {
        corners_of_input(b).fold((f64::INFINITY, size), |(least, size), corner| {
            let place = pose.carry(corner);
            let numbers = dot(corner.map(f64::abs), [2.0; 3])
                + dot(pose.translation.map(|x| f64::from(x).abs()), [1.0; 3]);
            (lesser(least, dot(way, place)), greater(size, numbers))
        })
    };
    let (least, size) = begins(&asking.pose);
    let gap = greater(most - least, 0.0);
    let mut room = size * (8.0 * f64::from(U32));
    for _ in 0..4 {
        let mut start = asking.pose;
        let sides = start.translation.iter_mut().zip(way);
        sides.for_each(|(x, way)| *x = (f64::from(*x) + way * (gap + room)) as f32);
        if !start.translation.iter().all(|x| x.is_finite()) {
            return None;
        }
        let (least, size) = begins(&start);
        if least - most > PARTED * U64 * size {
            return Some(start);
        }
        room *= 4.0;
    }
    None
}

/// How far the translations of two poses are from each other, rounded up.
fn length_between(one: &Pose, other: &Pose) -> f64 {
    let mut squares = 0.0;
    for (x, y) in one.translation.iter().zip(&other.translation) {
        let way = f64::from(*x) - f64::from(*y);
        squares += way * way;
    }
    libm::sqrt(squares) * (1.0 + 8.0 * U64)
}
