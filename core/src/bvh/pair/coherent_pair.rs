//! Distances of two models that move little from one question to the next.
//!
//! A search leaves pairs of children out, each with a lower bound of their distance. They are kept.
//! When the models have moved, each bound less the longest path of any point is still a lower
//! bound. So the next search begins with the pairs that may have come near enough, in place of both
//! roots.

use core::marker::PhantomData;

use super::advance::longest_path;
use super::gaps::answers;
use super::gaps::nearest_first::{Missed, PairDescent, Search};
use super::gaps::question::PairQuestion;
use super::gaps::skipped::{ChildPairs, PairGroup, SkippedPairs};
use super::model_box::are_apart;
use super::stored_pair::StoredPair;
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::gap::{GapThreshold, NearestGap};
use crate::geom::Pose;
use crate::num::tolerance::U64;
use crate::num::{down_to_f32, greater, lesser};
use crate::query::{Budget, Decided, Ended, Motion, PairDistance, QueryError, ScratchEntry};

/// Two models that move, with the groups of pairs that the last search left out.
///
/// It keeps up to `N` groups of pairs of boxes, each with a lower bound of their distance. Together
/// they hold all pairs of triangles. RAM: 20·`N` bytes, and about 100. If the groups of a search
/// are more than `N`, the next search begins at the roots, and [`groups`](Self::groups) is 0: take
/// a larger `N`. Models beyond 2^30 grid units from each other are searched afresh each time.
///
/// The state belongs to two trees at a time. With other trees it starts anew. It borrows the blobs'
/// bytes, so they cannot change between questions.
#[derive(Clone, Debug)]
pub struct CoherentPair<'t, const N: usize = 1024> {
    memory: PairMemory,
    groups: [PairGroup; N],
    bytes: PhantomData<&'t [u8]>,
}

/// What a pair keeps of its last question, beside the groups.
#[derive(Clone, Copy, Debug)]
struct PairMemory {
    /// The identities of both trees.
    of: [(usize, u32); 2],
    pose: Pose,
    /// Groups in use. 0: they do not hold all pairs, and the next search begins at the roots.
    count: usize,
    /// No group has a lesser distance.
    least: f32,
    /// Longest path of a point since the distances were written, common units.
    path: f64,
    /// The leaves of the last answer's triangles, if it named any.
    leaves: Option<ChildPairs>,
}

impl<const N: usize> Default for CoherentPair<'_, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<'t, const N: usize> CoherentPair<'t, N> {
    /// A pair without memory of earlier questions. May initialise a `static`.
    pub const fn new() -> Self {
        CoherentPair { memory: PairMemory::NONE, groups: [PairGroup::EMPTY; N], bytes: PhantomData }
    }

    /// Forgets all earlier questions.
    pub fn reset(&mut self) {
        self.memory = PairMemory::NONE;
    }

    /// The groups in use, at most `N`. 0 before the first question, and if those of the last one
    /// did not fit.
    pub fn groups(&self) -> usize {
        self.memory.count
    }

    /// [`Bvh::distance_to`] of `tree` and of `other`, moved by `pose`. The less the models moved
    /// since the last question, the less work it takes.
    ///
    /// The interval contains the distance like that of [`Bvh::distance_to`]. Its bits may differ,
    /// because another of several pairs that are equally near may be found. They depend on all
    /// questions since [`reset`](Self::reset), and are the same on every target. Arguments, errors
    /// and degenerate cases as there.
    ///
    /// Cost: one pass over the groups, and the pairs of boxes whose bounds came below the distance.
    /// For steps of a thousandth of the model's size a small part of a fresh search; a fresh search
    /// for steps as long as the distance.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, CoherentPair, Pose, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<{ Bvh::DISTANCE_ENTRIES }>::new());
    /// let mut arm = CoherentPair::<256>::new();
    /// for step in 0..100 {
    ///     let pose = Pose { translation: [300.0 - step as f32, 0.0, 0.0], ..Pose::IDENTITY };
    ///     let found = arm.distance(&part, &part, pose, Budget::EXACT, &mut scratch)?;
    ///     assert!(found.distance.lower > 0.0);
    /// }
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// Source: fronts of pairs after Ehmann and Lin, *Accurate and Fast Proximity Queries between
    /// Polyhedra Using Convex Surface Decomposition* (2001); bounds less the motion after
    /// Meshsweeper 5.1.
    ///
    /// # Errors
    /// Those of [`Bvh::distance_to`]. If the arguments are refused, the state stays as it was.
    #[inline(never)]
    pub fn distance(
        &mut self,
        tree: &Bvh<'t>,
        other: &Bvh<'t>,
        pose: Pose,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<PairDistance, QueryError> {
        budget.check_with(scratch)?;
        let pair = StoredPair::new([tree, other], &pose)?;
        if !pair.common.is_in_range {
            self.reset();
            return tree.distance_to(other, pose, budget, scratch);
        }
        let mut nearest = NearestGap::new(&pair.lengths, 0.0, &budget);
        let relative = pair.relative();
        let mut search = Search::new(&pair, &relative, budget.steps, scratch);
        let front = PairFront::after_motion(&mut self.memory, &mut self.groups, &pair, &pose);
        let missed = front.search(&mut search, &mut PairQuestion::Distance(&mut nearest))?;
        answers::nearest(&nearest, &pair, missed, search.work)
    }

    /// [`Bvh::within_of`] of `tree` and of `other`, moved by `pose`. It may follow questions about
    /// other distances.
    ///
    /// Arguments, errors and degenerate cases as there. The verdicts are proved in the same way.
    /// Where a pair is undecided or several are within, another one may be named.
    ///
    /// Cost: if the motion since the last search is too short to bring the models within the
    /// distance, the paths of eight corners. Otherwise as for [`distance`](Self::distance).
    ///
    /// # Errors
    /// Those of [`Bvh::within_of`]. If the arguments are refused, the state stays as it was.
    #[inline(never)]
    pub fn within(
        &mut self,
        tree: &Bvh<'t>,
        other: &Bvh<'t>,
        pose: Pose,
        distance: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<[u32; 2]>, QueryError> {
        budget.check_about(distance, scratch)?;
        if are_apart([tree, other], &pose, distance)? {
            // The groups stay as they are. Their bounds hold at the pose of the last search.
            return Ok(Decided::CLEAR);
        }
        let pair = StoredPair::new([tree, other], &pose)?;
        if !pair.common.is_in_range {
            self.reset();
            return tree.within_of(other, pose, distance, budget, scratch);
        }
        let mut threshold = GapThreshold::new(&pair.lengths, 0.0, distance);
        let relative = pair.relative();
        let mut search = Search::new(&pair, &relative, budget.steps, scratch);
        let front = PairFront::after_motion(&mut self.memory, &mut self.groups, &pair, &pose);
        let missed = front.search(&mut search, &mut PairQuestion::Within(&mut threshold))?;
        answers::within(&threshold, &pair, missed, search.work)
    }
}

impl PairMemory {
    const NONE: PairMemory = PairMemory {
        of: [(0, 0); 2],
        pose: Pose::IDENTITY,
        count: 0,
        least: 0.0,
        path: 0.0,
        leaves: None,
    };
}

/// The groups of a [`CoherentPair`] during one search.
struct PairFront<'f> {
    last: &'f mut PairMemory,
    skipped: SkippedPairs<'f>,
    /// Groups at the start of the list that this search did not look at yet.
    unseen: usize,
}

impl<'f> PairFront<'f> {
    /// The front after the motion from the last pose.
    fn after_motion(
        last: &'f mut PairMemory,
        groups: &'f mut [PairGroup],
        pair: &StoredPair<'_>,
        pose: &Pose,
    ) -> Self {
        let [a, b] = pair.trees;
        let of = [a.identity(), b.identity()];
        let (step, _) = longest_path(b, &Motion::straight(last.pose, *pose));
        let path = (last.path + step / pair.lengths.unit) * (1.0 + 4.0 * U64);
        *last = if last.of == of && path.is_finite() {
            PairMemory { pose: *pose, path, ..*last }
        } else {
            PairMemory { of, pose: *pose, ..PairMemory::NONE }
        };
        let skipped =
            SkippedPairs { groups, count: last.count, is_truncated: false, is_known: false };
        PairFront { last, skipped, unseen: 0 }
    }

    /// Searches the groups that may hold a pair within the question's limit.
    fn search(
        mut self,
        search: &mut Search<'_, '_>,
        question: &mut PairQuestion<'_>,
    ) -> Result<Option<Missed>, QueryError> {
        // Only a threshold ends here: the limit of a distance is infinite before its first pair.
        let is_clear = less_path(self.last.least, self.last.path) > question.limit();
        if self.skipped.count > 0 && is_clear {
            return Ok(None);
        }
        self.subtract_path();
        let found = self.search_groups(search, question);
        self.last.leaves = question.leaves().or(self.last.leaves);
        if self.skipped.is_truncated || found.is_err() {
            self.skipped.count = 0;
        }
        self.last.count = self.skipped.count;
        self.last.least = least(self.known());
        found
    }

    /// Descends from one start after the other, in this order:
    /// 1. the leaves of the last answer, which mostly bring the limit down at once;
    /// 2. the groups within the limit, the nearest first;
    /// 3. both roots instead, if no group is known or, after the first group, more than half of the
    ///    others are within the limit.
    fn search_groups(
        &mut self,
        search: &mut Search<'_, '_>,
        question: &mut PairQuestion<'_>,
    ) -> Result<Option<Missed>, QueryError> {
        let mut missed: Option<Missed> = None;
        let mut is_first = true;
        let mut is_fresh = self.unseen == 0;
        // The last answer first. If the models still meet there, nothing else is searched.
        let mut known = self.last.leaves.filter(|_| !is_fresh);
        loop {
            self.skipped.is_known = known.is_some();
            let start = if let Some(leaves) = known.take() {
                (leaves, 0.0)
            } else if is_fresh {
                // The roots include the first group, so its pairs are searched again.
                (self.skipped.count, self.unseen, self.skipped.is_truncated) = (0, 0, false);
                missed = None;
                (ChildPairs::ALL, 0.0)
            } else {
                let Some(at) = self.unseen.checked_sub(1) else { return Ok(missed) };
                self.unseen = at;
                match self.remove_near(at, question.limit()) {
                    Some(group) => (group.pairs(), group.distance),
                    None => continue,
                }
            };
            match search.descend(start, question, Some(&mut self.skipped))? {
                PairDescent::Done => {}
                PairDescent::Answered => return Ok(missed),
                PairDescent::Truncated(now) => {
                    let unseen = self.known().iter().take(self.unseen);
                    let lower = unseen.fold(now.lower, |l, g| lesser(l, f64::from(g.distance)));
                    let lower = missed.map_or(lower, |before| lesser(lower, before.lower));
                    missed = Some(Missed { why: now.why, lower });
                    if now.why == Ended::Steps {
                        return Ok(missed);
                    }
                }
            }
            if self.skipped.is_known {
                continue;
            }
            is_fresh = is_first && !is_fresh && self.are_many_near(question.limit());
            is_first = false;
        }
    }

    /// The groups in use.
    fn known(&self) -> &[PairGroup] {
        self.skipped.groups.get(..self.skipped.count).unwrap_or(&[])
    }

    /// Subtracts the path from all distances. The nearest group comes last: its triangles leave few
    /// of the others.
    fn subtract_path(&mut self) {
        let (count, path) = (self.skipped.count, self.last.path);
        (self.unseen, self.last.path) = (count, 0.0);
        let (mut nearest, mut least) = (0, f32::INFINITY);
        for (i, group) in self.skipped.groups.iter_mut().take(count).enumerate() {
            group.distance = down_to_f32(greater(0.0, less_path(group.distance, path)));
            if group.distance < least {
                (nearest, least) = (i, group.distance);
            }
        }
        if let Some([nearest, .., last]) = self.skipped.groups.get_mut(nearest..count) {
            core::mem::swap(nearest, last);
        }
    }

    /// Removes a group if it may hold a pair within the limit.
    fn remove_near(&mut self, at: usize, limit: f64) -> Option<PairGroup> {
        let group = *self.skipped.groups.get(at)?;
        if f64::from(group.distance) > limit {
            return None;
        }
        let end = self.skipped.count.checked_sub(1)?;
        let last = *self.skipped.groups.get(end)?;
        *self.skipped.groups.get_mut(at)? = last;
        self.skipped.count = end;
        Some(group)
    }

    /// Whether the models have come so near that a search from the roots is cheaper.
    fn are_many_near(&self, limit: f64) -> bool {
        let unseen = self.known().iter().take(self.unseen);
        let near = unseen.filter(|group| f64::from(group.distance) <= limit).count();
        near > self.unseen / 2
    }
}

/// A distance less a path, rounded down.
fn less_path(distance: f32, path: f64) -> f64 {
    (f64::from(distance) - path).next_down()
}

fn least(groups: &[PairGroup]) -> f32 {
    groups.iter().fold(f32::INFINITY, |least, group| lesser(least, group.distance))
}
