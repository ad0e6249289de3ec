//! Closest point by the sweeping process (Guéziec 2000, 3.2 and 4.3) on the split tables.

use super::above::Above;
use super::front::{Front, triangles};
use super::geometry::{Geometry, frame};
use super::nearest::Nearest;
use crate::hull::format::{Hull, Instance};
use crate::num::SOFT_DOUBLE;
use crate::num::tolerance::HULL_FAR;
use crate::query::{Budget, ClosestPoint, Ended, QueryError, ScratchEntry, Taken, Work};

impl Hull<'_> {
    /// Closest point of the surface to `point` (input units), with an interval that contains the
    /// distance to the input mesh.
    ///
    /// `scratch`: [`scratch_entries`](Hull::scratch_entries) make overflow impossible. More give a
    /// tighter interval to a query that stops early. With fewer the interval still holds, and the
    /// answer may say [`Ended::Scratch`]. A point on the surface has a lower bound of 0. Of
    /// equidistant triangles the answer is the least in blob order, whatever the order of visits. A
    /// point farther than 2^40 times the model's size gets the interval of the model's box.
    ///
    /// Cost: some hundreds of nodes and triangles near a scanned part. The worst case is all of
    /// them, at the centre of a sphere. Where time is bounded, set [`Budget::with_steps`]. With a
    /// tolerance the search begins with the distance of a vertex of the surface, unless the blob is
    /// cut or its levels do not [enclose](Hull::encloses) the surface. The box tree
    /// ([`Bvh`](crate::Bvh)) answers the same question much faster. Source: Guéziec 2000, 4.3.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Hull, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bracket.msw"));
    /// let (part, mut scratch) = (Hull::open(bytes)?, Scratch::<256>::new());
    /// let near = part.closest_point([300.0, 0.0, 0.0], Budget::EXACT, &mut scratch)?;
    /// assert!(near.distance.lower > 0.0);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::Tolerance`], [`QueryError::NoScratch`].
    #[inline(never)]
    pub fn closest_point(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        budget.check_with(scratch)?;
        let Budget { relative, absolute, steps } = budget;
        closest_point(self, point, [relative, absolute], steps, scratch)
    }
}

/// Takes the tolerances as numbers, not a budget, so that a program with constant tolerances links
/// no code for others.
pub(super) fn closest_point<'a, G: Geometry<'a> + Copy>(
    hull: &G,
    point: [f32; 3],
    [relative, absolute]: [f32; 2],
    steps: u32,
    scratch: &mut [ScratchEntry],
) -> Result<ClosestPoint, QueryError> {
    let is_cut = hull.tables().is_cut();
    if !hull.tables().has_hull() {
        return Err(QueryError::NO_HULL);
    }
    let frame = frame(hull);
    let p = frame.local(point)?;
    let mut nearest = Nearest::new(hull, p).ok_or(QueryError::Unchecked)?;
    let (mut work, mut ended) = (Work::NONE, Ended::Exact);
    if p.abs().max_element() > HULL_FAR {
        nearest.settle_by_box(hull).ok_or(QueryError::Unchecked)?;
        if is_cut {
            ended = Ended::Resolution;
        }
    } else {
        let tolerance = (relative > 0.0 || absolute > 0.0)
            .then(|| [f64::from(relative), frame.length(absolute)]);
        if tolerance.is_none() {
            nearest.defers = steps >= triangles(hull.tables()) && !nearest.distant;
            if SOFT_DOUBLE {
                nearest.share_corners(frame.surface_error());
            }
        }
        let mut front = Front::new(hull, scratch, steps);
        ended = match tolerance {
            None if APART => search(&mut front, &mut nearest, None),
            _ if APART => search_apart(&mut front, &mut nearest, tolerance),
            _ => search_to(&mut front, &mut nearest, tolerance),
        }
        .ok_or(QueryError::Unchecked)?;
        work = nearest.work(front.work);
    }
    nearest.settle_unreached(hull).ok_or(QueryError::Unchecked)?;
    Ok(nearest.answer(hull.tables(), &frame, work, ended))
}

/// Whether the exact search is compiled apart from that to a tolerance. On boards one search for
/// both makes the exact one up to 1.7 % dearer, and on x86-64 two do so by 1.2 %.
const APART: bool = !cfg!(target_arch = "x86_64");

#[inline(never)]
fn search_apart<'a, G: Geometry<'a>>(
    front: &mut Front<'_, G>,
    nearest: &mut Nearest,
    tolerance: Option<[f64; 2]>,
) -> Option<Ended> {
    search_to(front, nearest, tolerance)
}

/// A search that begins with the distance of a vertex of the surface, if there is a tolerance.
#[inline(always)]
fn search_to<'a, G: Geometry<'a>>(
    front: &mut Front<'_, G>,
    nearest: &mut Nearest,
    tolerance: Option<[f64; 2]>,
) -> Option<Ended> {
    let mut above = Above::NONE;
    if tolerance.is_some() {
        above.begin(&front.model, nearest)?;
    }
    let ended = search(front, nearest, tolerance.map(|within| (within, &mut above)))?;
    if tolerance.is_some() {
        above.settle(front, nearest)?;
    }
    Some(ended)
}

/// Refines until no triangle that waits may be nearer than the best one, or until the tolerance is
/// met.
#[inline(always)]
fn search<'a, G: Geometry<'a>>(
    front: &mut Front<'_, G>,
    nearest: &mut Nearest,
    mut tolerance: Option<([f64; 2], &mut Above)>,
) -> Option<Ended> {
    let error = front.model.surface_error();
    // Least key of the triangles that the tolerance spared.
    let mut spared = f64::INFINITY;
    front.begin(nearest)?;
    while let Some(Taken { entry, least }) =
        front.queue.take(nearest.next.take(), nearest.limit_f32 == f32::INFINITY)
    {
        let key = f64::from(entry.key());
        let instance = Instance(entry.node());
        let beaten = entry.key() > nearest.limit_f32;
        let tolerated = tolerance.as_mut().is_some_and(|(within, above)| {
            let bound = key.min(spared);
            above.improve(front, instance, nearest, (*within, bound));
            nearest.is_within(*within, bound, error)
        });
        if beaten || tolerated {
            if !beaten {
                spared = spared.min(key);
            }
            if least {
                // All entries that wait are farther.
                break;
            }
            continue;
        }
        if front.is_spent() {
            nearest.settle_waiting();
            let waiting = f64::from(front.queue.lower());
            nearest.lower = nearest.lower.min(spared).min(key).min(waiting);
            return Some(Ended::Steps);
        }
        front.open(instance, nearest)?;
    }
    nearest.settle_waiting();
    let dropped = f64::from(front.queue.dropped());
    nearest.lower = nearest.lower.min(spared).min(dropped);
    // Beyond a cut, a triangle that was evaluated later may have widened the interval again.
    let is_met = spared < nearest.upper
        && tolerance.is_some_and(|(within, _)| nearest.is_within(within, spared, error));
    Some(if dropped < nearest.upper {
        Ended::Scratch
    } else if is_met {
        Ended::Tolerance
    } else if front.model.tables().is_cut() {
        Ended::Resolution
    } else {
        Ended::Exact
    })
}
