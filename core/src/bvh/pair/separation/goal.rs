//! What a search wants of pairs of triangles: whether some are near, or the nearest ones.

use super::grid_pose::GridPose;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::{GapLimits, HullGap};
use crate::num::tolerance::{GAP_SLACK, LEAST_NEAR, SQUARED_SLACK, U32};
use crate::num::{greater, sqrt_approx};
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
    Nearest(Nearest<'s>),
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

/// The triangles that may be the nearest ones.
pub(crate) struct Nearest<'s> {
    pub(crate) candidates: Candidates<'s>,
    /// The search ended early, at two triangles that are within rounding of each other.
    pub(crate) is_cut: bool,
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

    /// The triangles that may be the nearest ones. `scratch` keeps them, two entries each.
    pub(crate) fn nearest(pose: &GridPose<'_>, scratch: &'s mut [ScratchEntry]) -> Goal<'s> {
        let limits = GapLimits { far_sq: f32::INFINITY, near_sq: -1.0 };
        let nearest = Nearest {
            candidates: Candidates::new(scratch),
            is_cut: false,
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
        self.bring_upper(square);
        true
    }

    /// Takes what was found of two triangles. Returns whether the search goes on.
    #[inline(always)]
    pub(crate) fn take(&mut self, place: TrianglesAt, found: &HullGap) -> bool {
        let &HullGap { gap_sq, hull_sq, .. } = found;
        self.bring_upper(hull_sq);
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
                // If nothing is proved to be near, f64 is asked.
                self.limits.near_sq >= 0.0
            }
            Wanted::Nearest(nearest) => {
                nearest.candidates.add(place, gap_sq, self.limits.far_sq);
                nearest.is_cut = sqrt_approx(nearest.upper_sq) <= nearest.rounding;
                !nearest.is_cut
            }
        }
    }

    /// Lowers the limit of [`Wanted::Nearest`] to the squared distance of two points.
    #[inline(always)]
    fn bring_upper(&mut self, square: f32) {
        if let Wanted::Nearest(nearest) = &mut self.wanted
            && square < nearest.upper_sq
        {
            nearest.upper_sq = square;
            let upper = sqrt_approx(square) * (1.0 + 8.0 * U32);
            self.far = (upper + 2.0 * nearest.rounding) * (1.0 + 8.0 * U32);
            self.limits.far_sq = square_up(self.far);
        }
    }
}

/// Entries of a candidate.
const ENTRIES: usize = 2;

/// Pairs of triangles in the caller's scratch memory.
pub(crate) struct Candidates<'s> {
    slots: &'s mut [[ScratchEntry; ENTRIES]],
    used: usize,
    /// Some did not fit.
    pub(crate) is_short: bool,
}

impl<'s> Candidates<'s> {
    fn new(scratch: &'s mut [ScratchEntry]) -> Candidates<'s> {
        Candidates { slots: scratch.as_chunks_mut::<ENTRIES>().0, used: 0, is_short: false }
    }

    /// Adds one, and drops those beyond the limit if memory ends.
    fn add(&mut self, [a, b]: TrianglesAt, gap_sq: f32, limit_sq: f32) {
        if self.used == self.slots.len() {
            self.drop_beyond(limit_sq);
        }
        match self.slots.get_mut(self.used) {
            Some(slot) => {
                let first = ScratchEntry::new(gap_sq, a.word());
                *slot = [first, ScratchEntry::of_words([0, b.word()])];
                self.used += 1;
            }
            None => self.is_short = true,
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

    /// Takes the one with the least gap.
    pub(crate) fn remove_least(&mut self) -> Option<TrianglesAt> {
        let last = self.used.checked_sub(1)?;
        let used = self.slots.get_mut(..self.used)?;
        let least = (0..used.len()).reduce(|best, at| {
            let key = |at: usize| used.get(at).map_or(f32::INFINITY, |[first, _]| first.key());
            if key(at) < key(best) { at } else { best }
        })?;
        let end = *used.get(last)?;
        let [first, second] = core::mem::replace(used.get_mut(least)?, end);
        self.used = last;
        Some([TriangleAt::of_word(first.node()), TriangleAt::of_word(second.node())])
    }
}
