//! What a search wants of pairs of triangles: whether some are near, or the nearest ones.

use super::grid_pose::GridPose;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::{GapLimits, HullGap};
use crate::num::tolerance::{GAP_SLACK, LEAST_NEAR, SQUARED_SLACK, U32};
use crate::num::{greater, lesser, sqrt_approx};
use crate::query::ScratchEntry;

/// Two triangles, one of each model.
pub(crate) type TrianglesAt = [TriangleAt; 2];

/// What a search wants, in units of the first grid.
pub(crate) struct Goal<'s> {
    /// Pairs with a computed gap above this are left out.
    pub(crate) far: f32,
    pub(crate) limits: GapLimits,
    pub(crate) wanted: Wanted<'s>,
}

pub(crate) enum Wanted<'s> {
    Near(Threshold),
    Nearest(NearestPair<'s>),
}

/// Whether triangles are within a distance.
pub(crate) struct Threshold {
    /// Two triangles that are certainly within the distance.
    pub(crate) near: Option<TrianglesAt>,
    /// There are triangles of which f32 does not tell whether they are within the distance.
    pub(crate) is_undecided: bool,
    /// A computed gap above this proves that two triangles are farther than the distance.
    clear: f32,
    clear_sq: f32,
}

/// The leaves that may have the nearest triangles.
pub(crate) struct NearestPair<'s> {
    pub(crate) candidates: Candidates<'s>,
    /// Triangles with the two points of `upper_sq`.
    pub(crate) best: TrianglesAt,
    /// Two triangles are within rounding of each other: f32 cannot go on.
    pub(crate) is_touching: bool,
    /// Least squared distance, as computed, of two points of the models so far.
    upper_sq: f32,
    /// [`GridPose::rounding`].
    rounding: f32,
}

/// A square of a length, rounded up.
#[inline(always)]
pub(crate) fn square_up(length: f32) -> f32 {
    length * length * GAP_SLACK
}

impl<'s> Goal<'s> {
    /// Whether triangles are within `distance`. If none are, a lower bound of at most `distance +
    /// more` is wanted. Both in input units of the first model.
    pub(crate) fn threshold(pose: &GridPose<'_>, [distance, more]: [f32; 2]) -> Goal<'s> {
        let [a, _] = pose.trees;
        let (distance, more) = (a.units().inward(distance), a.units().inward(more));
        let up = 1.0 + 4.0 * U32;
        let near = (distance - pose.error) * (1.0 - 4.0 * U32);
        let (clear, far) = ((distance + pose.error) * up, (distance + more + pose.error) * up);
        let near_sq = if near > LEAST_NEAR { near * near * SQUARED_SLACK } else { -1.0 };
        let threshold =
            Threshold { near: None, is_undecided: false, clear, clear_sq: square_up(clear) };
        let limits = GapLimits { far_sq: square_up(far), near_sq };
        Goal { far, limits, wanted: Wanted::Near(threshold) }
    }

    /// The leaves that may have the nearest triangles. `scratch` keeps them, two entries each.
    pub(crate) fn nearest(pose: &GridPose<'_>, scratch: &'s mut [ScratchEntry]) -> Goal<'s> {
        let limits = GapLimits { far_sq: f32::INFINITY, near_sq: -1.0 };
        let nearest = NearestPair {
            candidates: Candidates::new(scratch),
            best: [TriangleAt::NONE; 2],
            is_touching: false,
            upper_sq: f32::INFINITY,
            rounding: pose.rounding,
        };
        Goal { far: f32::INFINITY, limits, wanted: Wanted::Nearest(nearest) }
    }

    /// Takes the squared distance of two vertices. `places` gives two triangles that have them.
    /// Returns whether the search goes on.
    #[inline(always)]
    pub(crate) fn take_vertices(&mut self, square: f32, places: impl Fn() -> TrianglesAt) -> bool {
        if let Wanted::Near(threshold) = &mut self.wanted {
            if square <= self.limits.near_sq {
                threshold.near = Some(places());
            }
            return threshold.near.is_none();
        }
        self.bring_upper(square, places)
    }

    /// Forgets the leaves that were kept, but not the limit.
    pub(crate) fn forget(&mut self) {
        if let Wanted::Nearest(nearest) = &mut self.wanted {
            (nearest.candidates.used, nearest.candidates.is_truncated) = (0, false);
        }
    }

    /// Keeps two leaves without a look at their triangles, if none of these can be nearer than the
    /// best ones, but for rounding. Returns whether it did.
    #[inline(always)]
    pub(crate) fn keep_unopened(&mut self, place: TrianglesAt, gap_sq: f32) -> bool {
        let Wanted::Nearest(nearest) = &mut self.wanted else { return false };
        let is_kept = gap_sq >= nearest.upper_sq * HULLS_SETTLED;
        if is_kept {
            nearest.candidates.add(place, gap_sq, self.limits.far_sq);
        }
        is_kept
    }

    /// Takes what was found of two triangles. Returns whether the search goes on.
    #[inline(always)]
    pub(crate) fn take(&mut self, place: TrianglesAt, found: &HullGap) -> bool {
        let &HullGap { gap_sq, hull_sq, .. } = found;
        let goes_on = self.bring_upper(hull_sq, || place);
        match &mut self.wanted {
            Wanted::Near(threshold) if hull_sq <= self.limits.near_sq => {
                threshold.near = Some(place);
                false
            }
            _ if gap_sq > self.limits.far_sq => true,
            Wanted::Near(threshold) if gap_sq > threshold.clear_sq => {
                // Clear, and the bound that is returned is at most this gap: the limit falls to it.
                let far = sqrt_approx(gap_sq) * (1.0 - 8.0 * U32);
                self.far = greater(threshold.clear, far);
                self.limits.far_sq = square_up(self.far);
                true
            }
            Wanted::Near(threshold) => {
                threshold.is_undecided = true;
                // A later pair may still prove `Yes`, unless the distance is too short for that.
                self.limits.near_sq >= 0.0
            }
            Wanted::Nearest(nearest) => {
                nearest.candidates.add(place, gap_sq, self.limits.far_sq);
                goes_on
            }
        }
    }

    /// Lowers the limit of [`Wanted::Nearest`] to the squared distance of two points. Returns
    /// whether the search goes on.
    #[inline(always)]
    fn bring_upper(&mut self, square: f32, places: impl Fn() -> TrianglesAt) -> bool {
        let Wanted::Nearest(nearest) = &mut self.wanted else { return true };
        if square < nearest.upper_sq {
            (nearest.upper_sq, nearest.best) = (square, places());
            let upper = sqrt_approx(square) * (1.0 + 8.0 * U32);
            self.far = (upper + 2.0 * nearest.rounding) * (1.0 + 8.0 * U32);
            self.limits.far_sq = square_up(self.far);
            nearest.is_touching = upper <= nearest.rounding;
        }
        !nearest.is_touching
    }
}

/// The part of the least squared distance that the gap of two leaves must have. No answer depends
/// on it.
const HULLS_SETTLED: f32 = 1.0 - 2e-5;

/// Entries of a candidate.
const ENTRIES: usize = 2;

/// Pairs of leaves in the caller's scratch memory.
pub(crate) struct Candidates<'s> {
    slots: &'s mut [[ScratchEntry; ENTRIES]],
    used: usize,
    /// Some did not fit.
    pub(crate) is_truncated: bool,
}

impl<'s> Candidates<'s> {
    fn new(scratch: &'s mut [ScratchEntry]) -> Candidates<'s> {
        Candidates { slots: scratch.as_chunks_mut::<ENTRIES>().0, used: 0, is_truncated: false }
    }

    /// Adds one, and drops those beyond the limit if memory ends. The leaves that were added last
    /// are not added again.
    fn add(&mut self, place: TrianglesAt, gap_sq: f32, limit_sq: f32) {
        let [a, b] = place.map(|triangle| triangle.with_lane(0));
        if let Some([first, second]) =
            self.used.checked_sub(1).and_then(|at| self.slots.get_mut(at))
            && [first.node(), second.node()] == [a.word(), b.word()]
        {
            *first = ScratchEntry::new(lesser(first.key(), gap_sq), a.word());
            return;
        }
        if self.used == self.slots.len() {
            self.drop_beyond(limit_sq);
        }
        match self.slots.get_mut(self.used) {
            Some(slot) => {
                let first = ScratchEntry::new(gap_sq, a.word());
                *slot = [first, ScratchEntry::of_words([0, b.word()])];
                self.used += 1;
            }
            None => self.is_truncated = true,
        }
    }

    /// Drops those with a squared gap above the limit.
    pub(crate) fn drop_beyond(&mut self, limit_sq: f32) {
        let end = self.used;
        self.used = 0;
        for from in 0..end {
            let Some(&slot) = self.slots.get(from) else { continue };
            let [first, _] = slot;
            if first.key() <= limit_sq
                && let Some(to) = self.slots.get_mut(self.used)
            {
                *to = slot;
                self.used += 1;
            }
        }
    }

    /// Takes the last one.
    pub(crate) fn take_last(&mut self) -> Option<TrianglesAt> {
        self.used = self.used.checked_sub(1)?;
        let [first, second] = self.slots.get(self.used)?;
        Some([TriangleAt::of_word(first.node()), TriangleAt::of_word(second.node())])
    }
}
