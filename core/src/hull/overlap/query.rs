//! Whether a triangle, or another hull hierarchy, meets the surface.

use super::descent::{Pair, descend};
use super::model::{Model, entries};
use crate::geom::Pose;
use crate::hull::format::Hull;
use crate::hull::geometry::Geometry;
use crate::query::{
    AllOverlaps, AllPairs, Budget, Decided, QueryError, ScratchEntry, TrianglePair, Witness,
};

impl Hull<'_> {
    /// Whether a triangle (input units) meets the surface.
    ///
    /// Both verdicts are proved for the input mesh as it was after repair, even if a grid moved
    /// vertices. A triangle that touches the surface without passing through it is undecided, and
    /// so is one nearer than rounding and the surface error. A triangle without area is a segment
    /// or a point. A segment can be proved to meet the surface. A point cannot: on the surface it
    /// is undecided. Only the surface counts: a triangle inside the solid does not meet it. On a
    /// cut blob the answer is `No` or undecided.
    ///
    /// The search ends at the first triangle that is proved to meet: the same one on every target.
    /// The witness of a `Yes` is this triangle, that of an undecided
    /// [`Resolution`](crate::Undecided::Resolution) one that may meet, by its number in the input
    /// file.
    /// `scratch`: [`scratch_entries`](Hull::scratch_entries) and 20 more are always enough. A
    /// shorter one may leave the question undecided. Of the budget only `steps` matters: triangles
    /// replaced by finer ones. Cost: in proportion to the surface that is near the triangle.
    ///
    /// Source: Platis & Theoharis 2003, section 3.2, has triangles as primitives. The search is our
    /// own: it opens triangles of the hierarchy, not of a refined hull.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Hull, Scratch, Verdict};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bracket.msw"));
    /// let (part, mut scratch) = (Hull::open(bytes)?, Scratch::<256>::new());
    /// let floor = [[-400.0, -400.0, -300.0], [400.0, -400.0, -300.0], [0.0, 400.0, -300.0]];
    /// let found = part.meets_triangle(floor, Budget::EXACT, &mut scratch)?;
    /// assert_eq!(found.verdict, Verdict::No);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::OutOfDomain`], [`QueryError::NoScratch`],
    /// [`QueryError::Tolerance`].
    #[inline(never)]
    pub fn meets_triangle(
        &self,
        corners: [[f32; 3]; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<u32>, QueryError> {
        let mut hull = Model::of_hull(self)?;
        let mut triangle = Model::<Hull<'_>>::of_triangle(corners, self)?;
        let mut first = Witness::NONE;
        let (truncated, work) =
            descend((&mut hull, &mut triangle), &Pose::IDENTITY, &budget, scratch, &mut first)
                .map_err(|error| match error {
                    QueryError::PoseOutOfDomain => QueryError::OutOfDomain,
                    error => error,
                })?;
        let (verdict, place) = first.answer(truncated);
        let witness = place.and_then(|[instance, _]| self.number(instance));
        Ok(Decided { verdict, witness, work })
    }

    /// With this many scratch entries no [`overlap`](Hull::overlap) with `other` ends for lack of
    /// memory.
    pub fn overlap_entries(&self, other: &Hull<'_>) -> usize {
        entries(self).saturating_add(entries(other))
    }

    /// Whether the surface of `other`, moved by `pose` from its frame to this hull's (both in input
    /// units), meets the surface of this hull.
    ///
    /// Each hierarchy is refined only where the other is near. Both verdicts, the pose, surfaces
    /// that touch, and the work are as for [`Bvh::overlap`](crate::Bvh::overlap). The two questions
    /// never contradict each other. Only surfaces count: one solid may lie inside the other. If
    /// either blob is cut, the answer is `No` or undecided, without a witness.
    ///
    /// It ends at the first pair that is proved to meet: the same pair on every target. The witness
    /// is that of [`Bvh::overlap`](crate::Bvh::overlap). `scratch`:
    /// [`overlap_entries`](Hull::overlap_entries) are always enough, of models with less than 16
    /// million splits. A shorter one may leave the question undecided. Of the budget only `steps`
    /// matters: triangles replaced by finer ones.
    ///
    /// Cost: in proportion to the surface that is near the other, some times that of the box tree.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Hull, Pose, Scratch, Verdict};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bracket.msw"));
    /// let (part, mut scratch) = (Hull::open(bytes)?, Scratch::<512>::new());
    /// assert!(part.overlap_entries(&part) <= scratch.len());
    /// let pose = Pose { translation: [300.0, 0.0, 0.0], ..Pose::IDENTITY };
    /// let found = part.overlap(&part, pose, Budget::EXACT, &mut scratch)?;
    /// assert_eq!(found.verdict, Verdict::No);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::NotRigid`] for a matrix that is no rotation, unless
    /// it is [`Pose::affine`]; [`QueryError::PoseOutOfDomain`] if an entry of the matrix is beyond
    /// 2, one model is 2^40 times as large as the other, or a surface error is far larger than its
    /// model; [`QueryError::NoScratch`], [`QueryError::Tolerance`].
    #[inline(never)]
    pub fn overlap(
        &self,
        other: &Hull<'_>,
        pose: Pose,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<[u32; 2]>, QueryError> {
        overlap(self, other, &pose, &budget, scratch)
    }

    /// All pairs of triangles of this surface and of that of `other`, moved by `pose`, that meet or
    /// that may meet, into `pairs`.
    ///
    /// Arguments, errors and degenerate cases as for [`overlap`](Hull::overlap). Every pair is
    /// found once. The order is that of the search and the same on every target. If either blob is
    /// cut, no pair is listed, and the answer ends with [`Ended::Exact`](crate::Ended::Exact) only
    /// if there is none. Cost: in proportion to the curves where the surfaces meet.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Hull, Pose, Scratch, TrianglePair};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bracket.msw"));
    /// let (part, mut scratch) = (Hull::open(bytes)?, Scratch::<512>::new());
    /// let pose = Pose { translation: [300.0, 0.0, 0.0], ..Pose::IDENTITY };
    /// let mut pairs = [TrianglePair::EMPTY; 8];
    /// let found = part.all_overlaps(&part, pose, &mut pairs, Budget::EXACT, &mut scratch)?;
    /// assert_eq!((found.stored, found.dropped), (0, 0));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`overlap`](Hull::overlap).
    #[inline(never)]
    pub fn all_overlaps(
        &self,
        other: &Hull<'_>,
        pose: Pose,
        pairs: &mut [TrianglePair],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<AllOverlaps, QueryError> {
        let [mut a, mut b] = [Model::of_hull(self)?, Model::of_hull(other)?];
        let mut all = AllPairs::new(pairs, |pair: &Pair| numbers([self, other], pair));
        let (truncated, work) = descend((&mut a, &mut b), &pose, &budget, scratch, &mut all)?;
        Ok(all.answer(truncated, work))
    }
}

/// [`Hull::overlap`], of hulls at rest or deformed.
pub(in crate::hull) fn overlap<'a, 'b>(
    a: &(impl Geometry<'a> + Copy),
    b: &(impl Geometry<'b> + Copy),
    pose: &Pose,
    budget: &Budget,
    scratch: &mut [ScratchEntry],
) -> Result<Decided<[u32; 2]>, QueryError> {
    let (mut first, mut sides) = (Witness::NONE, (Model::of_hull(a)?, Model::of_hull(b)?));
    let (truncated, work) =
        descend((&mut sides.0, &mut sides.1), pose, budget, scratch, &mut first)?;
    let (verdict, place) = first.answer(truncated);
    let witness = place
        .map(|place| numbers([a.tables(), b.tables()], &place))
        .map(|numbers| numbers.ok_or(QueryError::Unchecked))
        .transpose()?;
    Ok(Decided { verdict, witness, work })
}

/// Their numbers in the input files.
fn numbers([a, b]: [&Hull<'_>; 2], &[first, second]: &Pair) -> Option<[u32; 2]> {
    Some([a.number(first)?, b.number(second)?])
}
