//! The distance of two surfaces, one of them moved.

use super::gaps::answers;
use super::gaps::nearest_along::NearestAlong;
use super::gaps::nearest_first::{Missed, Search};
use super::gaps::question::PairQuestion;
use super::gaps::skipped::ChildPairs;
use super::models::most_pairs;
use super::separation::grid_pose::{FramePose, GridPose};
use super::separation::search::{NearestLeaves, nearest_leaves};
use super::stored_pair::StoredPair;
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::format::layout::MAX_TREE_DEPTH;
use crate::bvh::tree::gap::NearestGap;
use crate::geom::Pose;
use crate::num::lesser;
use crate::query::{Budget, Ended, PairDistance, QueryError, ScratchEntry, Work};

impl Bvh<'_> {
    /// With this many scratch entries no distance of two trees ends for lack of memory. Every three
    /// entries are a pair of nodes deeper in one of the trees, and no tree has more than 64 levels.
    pub const DISTANCE_ENTRIES: usize = 3 * 2 * MAX_TREE_DEPTH;

    /// The least distance of the surface of this tree and that of `other`, moved by `pose` from its
    /// frame to this tree's (both in input units), and where the surfaces are nearest.
    ///
    /// The interval contains the distance of the input meshes as they were after repair, even if a
    /// grid moved vertices. The pose's numbers are taken as exact. Its matrix is a rotation, or any
    /// matrix if the pose [says so](Pose::affine). The interval is `0 ..= 0` if it is proved that
    /// the surfaces meet. Only surfaces count: of one closed mesh inside the other it is the
    /// distance of the two surfaces.
    /// Ask [`overlap`](Bvh::overlap) where contact alone matters, and
    /// [`within_of`](Bvh::within_of) where a threshold does: both are faster. If the models move in
    /// small steps, [`CoherentPair`](crate::CoherentPair) remembers what the last search showed.
    ///
    /// `scratch`: [`DISTANCE_ENTRIES`](Bvh::DISTANCE_ENTRIES) are always enough. With fewer the
    /// lower end may be lower; the interval holds. A tolerance or the steps (pairs of nodes) of the
    /// budget end the search earlier. Without a single pair of triangles balls around the models
    /// give the interval, and beyond 2^30 grid units they always do: it is then some 2e-4 of the
    /// distance wide.
    ///
    /// Cost: a search in f32, then the distance in f64 of a pair of triangles, and of those that
    /// neither f32 nor integers tell from the nearest one. Some dozens of pairs of nodes and of
    /// triangles if one place is nearest. If the surfaces run side by side, the cost is in
    /// proportion to the surface there. The search is in f64 from the roots if the budget has a
    /// tolerance or few steps, if vertices are f32, if the surfaces meet, or if the candidates do
    /// not fit a quarter of `scratch`.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Pose, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<{ Bvh::DISTANCE_ENTRIES }>::new());
    /// let pose = Pose { translation: [300.0, 0.0, 0.0], ..Pose::IDENTITY };
    /// let found = part.distance_to(&part, pose, Budget::EXACT, &mut scratch)?;
    /// let [here, there] = found.points;
    /// let along = there[0] - here[0];
    /// assert!((found.distance.lower..=found.distance.upper).contains(&along));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// Source: pairs of nodes by lower bounds after Larsen, Gottschalk, Lin and Manocha, *Fast
    /// Proximity Queries with Swept Sphere Volumes* (1999); the bounds are of boxes.
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::PoseOutOfDomain`] if an entry of the matrix is
    /// beyond 2 or one grid is 2^40 times as coarse as the other; [`QueryError::NotRigid`] for a
    /// matrix that is no rotation, unless the pose says that; [`QueryError::NotServed`] unless
    /// both trees have boxes for segments; [`QueryError::Tolerance`], [`QueryError::NoScratch`].
    #[inline(never)]
    pub fn distance_to(
        &self,
        other: &Bvh<'_>,
        pose: Pose,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<PairDistance, QueryError> {
        budget.check_with(scratch)?;
        let pair = StoredPair::new([self, other], &pose)?;
        let mut nearest = NearestGap::new(&pair.lengths, 0.0, &budget);
        let mut question = PairQuestion::Distance(&mut nearest);
        let mut work = Work::NONE;
        // A search that ends early needs a lower bound of the pairs that wait. Only the search in
        // f64 has one. Half of all u32 is no limit of steps: `Scene` takes what earlier pairs used
        // off u32::MAX.
        let runs_to_end = budget.relative == 0.0
            && budget.absolute == 0.0
            && budget.steps >= lesser(most_pairs(self, other), u32::MAX / 2);
        if runs_to_end
            && pair.common.is_in_range
            && measure_nearest(&pair, &pose, &mut question, (scratch, &mut work))
        {
            return answers::nearest(&nearest, &pair, None, work);
        }
        let relative = pair.relative();
        let mut search = Search { work, ..Search::new(&pair, &relative, budget.steps, scratch) };
        let missed = if pair.common.is_in_range {
            search.descend((ChildPairs::ALL, 0.0), &mut question, None)?.missed()
        } else {
            Some(Missed { why: Ended::Resolution, lower: f64::INFINITY })
        };
        answers::nearest(&nearest, &pair, missed, search.work)
    }
}

/// Measures in f64 the triangles that f32 cannot tell from the nearest ones. Returns `true` if the
/// question is answered. Otherwise the search in f64 follows.
#[inline(never)]
fn measure_nearest(
    pair: &StoredPair<'_>,
    pose: &Pose,
    question: &mut PairQuestion<'_>,
    (scratch, work): (&mut [ScratchEntry], &mut Work),
) -> bool {
    let trees = pair.trees;
    let Some(grid) = GridPose::of(trees, &FramePose::of(pose)) else { return false };
    let found = nearest_leaves(&grid, scratch, work);
    let Some(NearestLeaves { best, mut candidates, are_all }) = found else { return false };
    let mut leaves = pair.leaves();
    let [a, b] = trees;
    let (Some(p), Some(q)) = (best[0].leaf(a), best[1].leaf(b)) else { return false };
    if !leaves.measure([&p, &q], best, question, work) {
        return true;
    }
    // Otherwise the search in f64 begins with a limit.
    if !are_all {
        return false;
    }
    let Some(mut along) = NearestAlong::new(leaves, question) else { return false };
    while let Some(place) = candidates.take_last() {
        let [first, second] = place;
        let (Some(p), Some(q)) = (first.leaf(a), second.leaf(b)) else { return false };
        match along.visit([&p, &q], [place, best], question, work) {
            Some(true) => {}
            Some(false) => return true,
            None => return false,
        }
    }
    along.report_beyond(best, question);
    true
}
