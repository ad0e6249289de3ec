//! Two box trees, one of them moved: whether their surfaces meet, and where.

use super::descent::descend;
use crate::bvh::pair::models::numbers;
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::format::layout::MAX_TREE_DEPTH;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::Pose;
use crate::query::{
    AllOverlaps, AllPairs, Budget, Decided, QueryError, ScratchEntry, TrianglePair, Witness,
};

impl Bvh<'_> {
    /// With this many scratch entries no overlap ends for lack of memory. Every pair of entries is
    /// deeper in one of the trees, and no tree has more than 64 levels.
    pub const OVERLAP_ENTRIES: usize = 2 * 2 * MAX_TREE_DEPTH;

    /// Whether the surface of `other`, moved by `pose` from its frame to this tree's (both in input
    /// units), meets the surface of this tree.
    ///
    /// Both verdicts are proved for the input meshes as they were after repair, even if a grid
    /// moved vertices. The pose's numbers are taken as exact. Surfaces that touch without passing
    /// through each other are undecided, and so are surfaces nearer than rounding and the surface
    /// errors. Two triangles without area are never proved to meet. Only surfaces count: one
    /// closed mesh may lie inside the other. [`penetration`](Bvh::penetration) tells that.
    ///
    /// It ends at the first pair that is proved to meet: the same pair on every target. The witness
    /// of a `Yes` is this pair, this tree's triangle first; that of an undecided
    /// [`Resolution`](crate::Undecided::Resolution) is a pair that may meet. Numbers are those of
    /// the input files. `work` as in [`AllOverlaps::work`](crate::AllOverlaps::work). `scratch`:
    /// [`OVERLAP_ENTRIES`](Bvh::OVERLAP_ENTRIES) are always enough. A shorter one may leave the
    /// question undecided. Of the budget only `steps` matters: pairs of nodes.
    ///
    /// Cost: in proportion to the surface that is near the other. Some dozens of pairs of nodes on
    /// scanned parts.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Pose, Scratch, Verdict};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<{ Bvh::OVERLAP_ENTRIES }>::new());
    /// let pose = Pose { translation: [300.0, 0.0, 0.0], ..Pose::IDENTITY };
    /// let found = part.overlap(&part, pose, Budget::EXACT, &mut scratch)?;
    /// assert_eq!(found.verdict, Verdict::No);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::PoseOutOfDomain`] if an entry of the matrix is
    /// beyond 2, one grid is 2^40 times as coarse as the other, or a surface error is beyond 2^30
    /// grid units; [`QueryError::NotRigid`] for a matrix that is no rotation, unless it is
    /// [`Pose::affine`]; [`QueryError::NotServed`] unless both trees have boxes for segments;
    /// [`QueryError::Tolerance`], [`QueryError::NoScratch`].
    #[inline(never)]
    pub fn overlap(
        &self,
        other: &Bvh<'_>,
        pose: Pose,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<[u32; 2]>, QueryError> {
        let mut first = Witness::NONE;
        let (truncated, work) = descend([self, other], &pose, &budget, scratch, &mut first)?;
        let (verdict, place) = first.answer(truncated);
        let numbers = |place| numbers(self, other, place).ok_or(QueryError::Unchecked);
        let witness = place.map(numbers).transpose()?;
        Ok(Decided { verdict, witness, work })
    }

    /// All pairs of triangles of this tree and of `other`, moved by `pose`, that meet or that may
    /// meet, into `pairs`.
    ///
    /// Arguments, errors and degenerate cases as for [`overlap`](Bvh::overlap). Every pair is found
    /// once. The order is that of the search and the same on every target. Cost: in proportion to
    /// the curves where the surfaces meet.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Pose, Scratch, TrianglePair};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<{ Bvh::OVERLAP_ENTRIES }>::new());
    /// let pose = Pose { translation: [300.0, 0.0, 0.0], ..Pose::IDENTITY };
    /// let mut pairs = [TrianglePair::EMPTY; 8];
    /// let found = part.all_overlaps(&part, pose, &mut pairs, Budget::EXACT, &mut scratch)?;
    /// assert_eq!((found.stored, found.dropped), (0, 0));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`overlap`](Bvh::overlap).
    #[inline(never)]
    pub fn all_overlaps(
        &self,
        other: &Bvh<'_>,
        pose: Pose,
        pairs: &mut [TrianglePair],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<AllOverlaps, QueryError> {
        let mut all = AllPairs::new(pairs, |&place: &[TriangleAt; 2]| numbers(self, other, place));
        let (truncated, work) = descend([self, other], &pose, &budget, scratch, &mut all)?;
        Ok(all.answer(truncated, work))
    }
}
