//! Conservative advancement: how far a moving model certainly goes without contact, by distances.

use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::input_box::corners_of_input;
use crate::geom::Pose;
use crate::num::tolerance::ADVANCE_KEPT;
use crate::num::{down_to_f32, greater};
use crate::query::{Budget, Ended, Motion, PairContact, QueryError, ScratchEntry, Work};

/// Most distances of a search. Near contact each gains a part of the gap that is left.
const MOST_ADVANCES: u32 = 512;

impl Bvh<'_> {
    /// Where the surface of `other` first comes within `keep` of this tree's during a motion: after
    /// Mirtich, see [`first_contact_of`](Bvh::first_contact_of). An advance by less than `least` of
    /// the motion ends the search.
    pub(crate) fn advance(
        &self,
        other: &Bvh<'_>,
        motion: &Motion,
        (keep, least): (f32, f64),
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<PairContact, QueryError> {
        budget.check_about(keep, scratch)?;
        if !motion.is_finite() {
            return Err(QueryError::NotFinite);
        }
        motion.check_rigid()?;
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
            let steps = budget.steps.saturating_sub(contact.work.opened);
            // The set-up of a distance takes time. Without steps only the first distance is asked.
            if steps == 0 && t > 0.0 {
                contact.ended = Ended::Steps;
                break;
            }
            // A matrix between two rotations is mostly no rotation. It is taken as given.
            let pose = Pose { is_affine: true, ..motion.at_time(t) };
            let budget = Budget::EXACT.with_steps(steps);
            let found = self.distance_to(other, pose, budget, scratch)?;
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
pub(crate) fn longest_path(tree: &Bvh<'_>, motion: &Motion) -> (f64, f64) {
    // Both are convex functions of the point: a corner goes farthest.
    corners_of_input(tree).fold((0.0, 0.0), |(longest, rounding), corner| {
        let (path, off) = motion.path_bounds(corner);
        if path.is_finite() && off.is_finite() {
            (greater(longest, path), greater(rounding, off))
        } else {
            // The path has no bound, so no distance permits an advance.
            (f64::INFINITY, f64::INFINITY)
        }
    })
}
