//! Incremental insertion, the one loop behind the programs in two and three variables.

use glam::DVec3;

use super::half_space::HalfSpace;
use super::order::{Order, Run};
use super::tolerance::{VIOLATION, scale};

/// The optimum over `constraints`, from `start`, the optimum without them; `None` if `tight` finds
/// none.
///
/// `tight(h, without, inserted)` must return the optimum over `inserted` among the points of `h`'s
/// plane, where `without` is the optimum over `inserted` alone and violates `h`. Seidel's lemma: if
/// the optimum over some constraints violates another, the optimum over all of them lies on its
/// plane. So the next violated constraint is inserted until none is left. Which one comes next is
/// the order's choice. Only constraints in front of it reach the lower program: those that were
/// violated in their turn, and in random order also those that were not.
///
/// With `CONE`, offsets count as zero (see [`offset`]).
#[inline(always)]
pub(super) fn insert<const CONE: bool>(
    run: &mut Run,
    start: DVec3,
    constraints: &mut [HalfSpace],
    mut tight: impl FnMut(&mut Run, &HalfSpace, DVec3, &mut [HalfSpace]) -> Option<DVec3>,
) -> Option<DVec3> {
    let (mut optimum, mut inserted) = (start, 0);
    while inserted < constraints.len() {
        let next = match run.order {
            Order::MostViolated => {
                run.tests += (constraints.len() - inserted) as u64;
                most_violated::<CONE>(optimum, constraints, inserted)
            }
            Order::Shuffled(_) => {
                let next = first_violated::<CONE>(optimum, constraints, inserted);
                run.tests += (next.map_or(constraints.len(), |next| next + 1) - inserted) as u64;
                next
            }
        };
        let Some(next) = next else { break };
        // Copied before the swap: read from where it was just stored in other pieces, it would
        // stall.
        let h = constraints[next];
        if run.order == Order::MostViolated {
            constraints.swap(inserted, next);
        } else {
            inserted = next;
        }
        optimum = tight(run, &h, optimum, &mut constraints[..inserted])?;
        inserted += 1;
    }
    Some(optimum)
}

/// Index of the first half-space, not below `first`, that `point` violates; `None` if it violates
/// none of them.
#[inline(always)]
fn first_violated<const CONE: bool>(
    point: DVec3,
    constraints: &[HalfSpace],
    first: usize,
) -> Option<usize> {
    let slack = VIOLATION * scale(point);
    let holds = |h: &HalfSpace| offset::<CONE>(h) - h.normal.dot(point) <= slack;
    constraints.iter().skip(first).position(|h| !holds(h)).map(|next| first + next)
}

/// Index of a half-space, not below `first`, that `point` violates; `None` if it violates none of
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
