//! Where a model that moves first comes near another one.

use crate::bvh::format::Bvh;
use crate::bvh::input_box::corners_of_input;
use crate::num::tolerance::ADVANCE_KEPT;
use crate::num::{down_to_f32, greater};
use crate::query::{Budget, Ended, Motion, PairContact, QueryError, ScratchEntry, Work};

/// Most distances of a search. Near contact each gains a part of the gap that is left.
const MOST_ADVANCES: u32 = 512;

/// Part of the motion below which an advance ends the search: half of the last bit of f32 at 1.
const LEAST_ADVANCE: f64 = 1.0 / (1u64 << 25) as f64;

impl Bvh<'_> {
    /// Where the surface of `other` first comes within `keep` of the surface of this tree during a
    /// [`Motion`] along straight lines or along a screw.
    ///
    /// Before `clear_until` the surfaces of the input meshes are proved to be farther than `keep`
    /// apart, at every instant. If [`is_clear`](PairContact::is_clear), they are during the whole
    /// motion. Only surfaces count: a mesh may move inside of another one.
    ///
    /// `scratch`: [`DISTANCE_ENTRIES`](Bvh::DISTANCE_ENTRIES) are always enough. The steps (pairs
    /// of nodes) of the budget are those of all distances together. Tolerances are ignored. If
    /// steps or scratch memory run out, `clear_until` is earlier.
    ///
    /// Cost: a [`distance`](Bvh::distance) for each advance: three to ten where the motion passes
    /// at some distance, some dozens before contact, more where the surfaces glide along each
    /// other.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Motion, Pose, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<{ Bvh::DISTANCE_ENTRIES }>::new());
    /// let at = |x: f32| Pose { translation: [x, 0.0, 300.0], ..Pose::IDENTITY };
    /// let motion = Motion::screw(at(-400.0), at(400.0))?;
    /// let found = part.first_contact_of(&part, &motion, 2.0, Budget::EXACT, &mut scratch)?;
    /// assert!(found.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// Source: conservative advancement after Mirtich, *Impulse-based Dynamic Simulation of Rigid
    /// Body Systems* (1996), by proved distances.
    ///
    /// # Errors
    /// Those of [`distance`](Bvh::distance), also for a `keep` that is negative, NaN or infinite,
    /// and [`QueryError::NotFinite`] if a pose on the way leaves f32's range.
    #[inline(never)]
    pub fn first_contact_of(
        &self,
        other: &Bvh<'_>,
        motion: &Motion,
        keep: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<PairContact, QueryError> {
        self.advance(other, motion, (keep, LEAST_ADVANCE), budget, scratch)
    }

    /// The same. An advance by less than `least` of the motion ends the search.
    pub(in crate::bvh) fn advance(
        &self,
        other: &Bvh<'_>,
        motion: &Motion,
        (keep, least): (f32, f64),
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<PairContact, QueryError> {
        // A distance is refused as an absolute tolerance is.
        budget.with_absolute(keep).check()?;
        if !motion.is_finite() {
            return Err(QueryError::NotFinite);
        }
        let (longest, rounding) = longest_path(other, motion);
        let mut contact = PairContact {
            clear_until: 0.0,
            points: [[0.0; 3]; 2],
            triangles: [0; 2],
            work: Work::default(),
            ended: Ended::Resolution,
        };
        let mut t = 0.0;
        for _ in 0..MOST_ADVANCES {
            let steps = budget.steps.saturating_sub(contact.work.splits);
            let pose = motion.at_time(t);
            let budget = Budget::EXACT.with_steps(steps);
            let found = self.distance(other, pose, budget, scratch)?;
            contact.work = contact.work.and(found.work);
            (contact.points, contact.triangles) = (found.points, found.triangles);
            let gap = f64::from(found.distance.lower) - (f64::from(keep) + rounding);
            let is_cut = matches!(found.ended, Ended::Steps | Ended::Scratch);
            let advance = if gap > 0.0 { gap / longest * ADVANCE_KEPT } else { 0.0 };
            let next = t + advance;
            if next > 1.0 {
                return Ok(PairContact {
                    clear_until: f32::INFINITY,
                    ended: Ended::Exact,
                    ..contact
                });
            }
            if advance < least {
                contact.ended = if is_cut { found.ended } else { Ended::Resolution };
                break;
            }
            t = next;
        }
        contact.clear_until = down_to_f32(t);
        Ok(contact)
    }
}

/// How far a point of a model goes at most, and how far it may be from its place at a pose that was
/// rounded to f32. Input units.
pub(in crate::bvh) fn longest_path(tree: &Bvh<'_>, motion: &Motion) -> (f64, f64) {
    // Both are convex functions of the point: a corner goes farthest.
    corners_of_input(tree).fold((0.0, 0.0), |(longest, rounding), corner| {
        let (path, off) = motion.path_bounds(corner);
        if path.is_finite() && off.is_finite() {
            (greater(longest, path), greater(rounding, off))
        } else {
            // No distance is enough for that.
            (f64::INFINITY, f64::INFINITY)
        }
    })
}
