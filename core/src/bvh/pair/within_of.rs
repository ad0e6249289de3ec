//! Whether two surfaces, one of them moved, are within a distance of each other.

use super::from_afar::from_afar;
use super::gaps::answers;
use super::gaps::nearest_first::Search;
use super::gaps::question::PairQuestion;
use super::gaps::skipped::ChildPairs;
use super::model_box::are_apart;
use super::models::numbers;
use super::separation::grid_pose::{FramePose, GridPose};
use super::separation::search::{PairVerdict, SearchStart, separation};
use super::stored_pair::StoredPair;
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::gap::{GapThreshold, GapVisitor};
use crate::geom::Pose;
use crate::query::{Budget, Decided, QueryError, ScratchEntry, Verdict, Work};

impl Bvh<'_> {
    /// Whether the surface of `other`, moved by `pose` from its frame to this tree's, is at most
    /// `distance` from the surface of this tree. All lengths in input units.
    ///
    /// Both verdicts are proved for the input meshes as they were after repair. A distance of 0
    /// asks whether the surfaces meet. The verdict is undecided for lack of precision only if the
    /// distance of the surfaces is within both surface errors and rounding of the one asked about,
    /// or beyond 2^30 grid units and within some 2e-4 of it.
    /// Only surfaces count: [`penetration`](Bvh::penetration) tells whether one closed mesh is
    /// inside the other. If the models move in small steps, [`CoherentPair`](crate::CoherentPair)
    /// asks for less work. For collision avoidance, treat an undecided answer as `Yes`.
    ///
    /// Arguments and degenerate cases as for [`distance_to`](Bvh::distance_to). It ends at the
    /// first pair of triangles that is certainly near enough. The witness of a `Yes` is this pair,
    /// this tree's triangle first; that of an undecided
    /// [`Resolution`](crate::Undecided::Resolution) is a pair that may be near enough. Numbers are
    /// those of the input files. `work` as in [`PairDistance::work`](crate::PairDistance::work).
    /// `scratch`: [`DISTANCE_ENTRIES`](Bvh::DISTANCE_ENTRIES) are always enough. A shorter one may
    /// leave the question undecided. Of the budget only `steps` matters.
    ///
    /// Cost: one test of both models' boxes in f32 if they are farther apart; else a search in f32.
    /// A search in f64 follows, with the steps that are left, in three cases: the distance is
    /// within some surface errors of the one asked about, vertices are f32, or `scratch` is too
    /// short.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Pose, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<{ Bvh::DISTANCE_ENTRIES }>::new());
    /// let pose = Pose { translation: [300.0, 0.0, 0.0], ..Pose::IDENTITY };
    /// let found = part.within_of(&part, pose, 5.0, Budget::EXACT, &mut scratch)?;
    /// assert!(found.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`distance_to`](Bvh::distance_to); [`QueryError::Tolerance`] also for a distance
    /// that is negative, NaN or infinite.
    #[inline(never)]
    pub fn within_of(
        &self,
        other: &Bvh<'_>,
        pose: Pose,
        distance: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<[u32; 2]>, QueryError> {
        budget.check_about(distance, scratch)?;
        if are_apart([self, other], &pose, distance)? {
            return Ok(Decided::CLEAR);
        }
        Ok(self.search_within_of(other, &pose, [distance, 0.0], budget, scratch)?.0)
    }

    /// The same by the trees: in f32 first, then in f64. With a `No` a lower end of the distance,
    /// at most `more` above the one asked about.
    pub(crate) fn search_within_of(
        &self,
        other: &Bvh<'_>,
        pose: &Pose,
        asked: [f32; 2],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<(Decided<[u32; 2]>, f32), QueryError> {
        let mut work = Work::NONE;
        if let Some(pose) = GridPose::of([self, other], &FramePose::of(pose)) {
            let mut start = SearchStart::NONE;
            match separation(&pose, asked, &mut start, budget.steps, scratch, &mut work) {
                PairVerdict::Apart(lower) => {
                    return Ok((Decided { work, ..Decided::CLEAR }, lower));
                }
                PairVerdict::Near(place) => {
                    let witness = numbers(self, other, place).ok_or(QueryError::Unchecked)?;
                    let found = Decided { verdict: Verdict::Yes, witness: Some(witness), work };
                    return Ok((found, 0.0));
                }
                PairVerdict::Undecided => {}
            }
        }
        self.within_of_f64(other, pose, asked, (budget, work), scratch)
    }

    /// The question in f64, for `[distance, more]`. The steps of `work` count against the budget.
    /// With a `No` also a lower bound of the distance: at most `distance + more`, input units.
    #[inline(never)]
    pub(crate) fn within_of_f64(
        &self,
        other: &Bvh<'_>,
        pose: &Pose,
        [distance, more]: [f32; 2],
        (budget, work): (Budget, Work),
        scratch: &mut [ScratchEntry],
    ) -> Result<(Decided<[u32; 2]>, f32), QueryError> {
        let pair = StoredPair::new([self, other], pose)?;
        let threshold = GapThreshold::new(&pair.lengths, 0.0, distance);
        let mut threshold = threshold.and_beyond(more);
        let relative = pair.relative();
        let mut search = Search { work, ..Search::new(&pair, &relative, budget.steps, scratch) };
        let missed = if pair.common.is_in_range {
            let mut question = PairQuestion::Within(&mut threshold);
            search.descend((ChildPairs::ALL, 0.0), &mut question, None)?.missed()
        } else {
            threshold.take(&from_afar(&pair).ok_or(QueryError::Unchecked)?);
            None
        };
        let lower = if missed.is_some() { distance } else { threshold.lower() };
        Ok((answers::within(&threshold, &pair, missed, search.work)?, lower))
    }
}
