//! Incremental insertion, the one loop behind the programs in two and three variables.

use glam::DVec3;

use super::half_space::HalfSpace;
use super::tolerance::{VIOLATION, scale};

/// The optimum over `constraints`, from `start`, the optimum without them; `None` if `tight` finds
/// none.
///
/// `tight(h, without, inserted)` must return the optimum over `inserted` among the points of `h`'s
/// plane, where `without` is the optimum over `inserted` alone and violates `h`. Seidel's lemma: if
/// the optimum over some constraints violates another, the optimum over all of them lies on its
/// plane. So a violated constraint is inserted until none is left. Inserted ones move to the front,
/// and only those reach the lower program.
///
/// With `CONE`, offsets count as zero (see [`offset`]).
#[inline(always)]
pub(super) fn insert<const CONE: bool>(
    start: DVec3,
    constraints: &mut [HalfSpace],
    mut tight: impl FnMut(&HalfSpace, DVec3, &mut [HalfSpace]) -> Option<DVec3>,
) -> Option<DVec3> {
    let mut optimum = start;
    for inserted in 0..constraints.len() {
        let Some(next) = most_violated::<CONE>(optimum, constraints, inserted) else { break };
        // Copied before the swap: read from where it was just stored in other pieces, it would
        // stall.
        let h = constraints[next];
        constraints.swap(inserted, next);
        optimum = tight(&h, optimum, &mut constraints[..inserted])?;
    }
    Some(optimum)
}

/// Index, not below `first`, of a half-space that `point` violates; `None` if it violates none of
/// them.
///
/// Any would do. This takes the one that is violated most by `point` itself in the star, and by
/// `point` pulled back towards the origin if it is outside. Early optima are as far away as
/// `1/eps`, where offsets do not count and the steepest plane seems the worst, though it may touch
/// the star only at its rim. See the module's table.
#[inline(always)]
fn most_violated<const CONE: bool>(
    point: DVec3,
    constraints: &[HalfSpace],
    first: usize,
) -> Option<usize> {
    let size = scale(point);
    let pulled = if size > IN_THE_STAR { 1.0 / size } else { 1.0 };
    let slack = VIOLATION * size;
    let (mut worst, mut found) = (f64::NEG_INFINITY, None);
    for (idx, h) in constraints.iter().enumerate().skip(first) {
        let (height, offset) = (h.normal.dot(point), offset::<CONE>(h));
        let rank = offset - height * pulled;
        if offset - height > slack && rank > worst {
            (worst, found) = (rank, Some(idx));
        }
    }
    found
}

/// Largest [`scale`] of a point that [`most_violated`] takes as it is. Points beyond are pulled
/// back to within the star's radius; to within twice that, stars take a seventh longer. Any value
/// gives correct answers.
const IN_THE_STAR: f64 = 2.0;

/// The offset of `h`, or zero for the program over the cone of directions to infinity.
#[inline(always)]
pub(super) fn offset<const CONE: bool>(h: &HalfSpace) -> f64 {
    if CONE { 0.0 } else { h.offset }
}
