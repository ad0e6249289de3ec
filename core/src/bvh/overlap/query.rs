//! Two box trees, one of them moved: whether their surfaces meet, and where.

use super::descent::{PairPlace, PairVisitor, descend};
use crate::bvh::format::Bvh;
use crate::geom::{Contact, Pose};
use crate::query::{Budget, Ended, QueryError, ScratchEntry, Undecided, Verdict, Work};

/// Whether two surfaces meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Overlap {
    /// `Yes`: the surfaces of the input meshes meet. `No`: they have no common point. Undecided for
    /// [`Resolution`](Undecided::Resolution): they come nearer to each other than the stored meshes
    /// can tell.
    pub verdict: Verdict,
    /// With `Yes` two triangles that meet, the first mesh's first. With an undecided
    /// [`Resolution`](Undecided::Resolution) two triangles that may meet. Numbers in the input
    /// files.
    pub triangles: Option<[u32; 2]>,
    /// The work of the search: pairs of boxes as `nodes`, pairs of triangles as `triangles` (in
    /// f32) and `exact` (in f64), pairs of nodes opened as `splits`.
    pub work: Work,
}

/// Two triangles that meet or may meet: their numbers in the input files, the first mesh's first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct TrianglePair {
    /// The triangles.
    pub triangles: [u32; 2],
    /// Whether it is proved that they meet.
    pub is_certain: bool,
}

impl TrianglePair {
    /// Any value, for filling arrays.
    pub const EMPTY: TrianglePair = TrianglePair { triangles: [u32::MAX; 2], is_certain: false };
}

/// All pairs that meet or may meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Overlaps {
    /// Pairs in the slice.
    pub stored: usize,
    /// Pairs that did not fit. The slice keeps the first ones that were found.
    pub dropped: u32,
    /// The work of the search, as in [`Overlap::work`].
    pub work: Work,
    /// [`Ended::Exact`]: these are all of the input's pairs. [`Ended::Resolution`]: pairs that are
    /// not certain may not meet; no other pair does. [`Ended::Scratch`]: some pairs did not fit the
    /// slice or the scratch memory. [`Ended::Steps`]: more pairs may exist.
    pub ended: Ended,
}

impl Bvh<'_> {
    /// With this many scratch entries no overlap ends for lack of memory. Every pair of entries is
    /// deeper in one of the trees, and no tree has more than 64 levels.
    pub const OVERLAP_ENTRIES: usize = 256;

    /// Whether the surface of `other`, moved by `pose` from its frame to this tree's (both in input
    /// units), meets the surface of this tree.
    ///
    /// Both verdicts are proved for the input meshes as they were after repair, even if a grid
    /// moved vertices. The pose's numbers are taken as exact. Surfaces that touch without passing
    /// through each other are undecided, and so are surfaces nearer than rounding and the surface
    /// errors. Two triangles without area are never proved to meet. Only surfaces count: one
    /// closed mesh may lie inside the other. [`signed_distance`](Bvh::signed_distance) of a vertex
    /// decides that.
    ///
    /// It ends at the first pair that is proved to meet: the same pair on every target. `scratch`:
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
    /// grid units; [`QueryError::NotServed`] unless both trees have boxes for segments;
    /// [`QueryError::Tolerance`], [`QueryError::NoScratch`].
    pub fn overlap(
        &self,
        other: &Bvh<'_>,
        pose: Pose,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Overlap, QueryError> {
        let mut first = FirstPair::default();
        let (truncated, work) = descend([self, other], &pose, &budget, scratch, &mut first)?;
        let (verdict, place) = match (first.met, truncated, first.undecided) {
            (Some(place), _, _) => (Verdict::Yes, Some(place)),
            (None, Some(why), _) => (Verdict::Undecided(why.undecided()), None),
            (None, None, Some(place)) => (Verdict::Undecided(Undecided::Resolution), Some(place)),
            (None, None, None) => (Verdict::No, None),
        };
        let numbers = |place| numbers(self, other, &place).ok_or(QueryError::Unchecked);
        let triangles = place.map(numbers).transpose()?;
        Ok(Overlap { verdict, triangles, work })
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
    /// let found = part.overlaps(&part, pose, &mut pairs, Budget::EXACT, &mut scratch)?;
    /// assert_eq!((found.stored, found.dropped), (0, 0));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`overlap`](Bvh::overlap).
    pub fn overlaps(
        &self,
        other: &Bvh<'_>,
        pose: Pose,
        pairs: &mut [TrianglePair],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Overlaps, QueryError> {
        let mut all =
            AllPairs { a: self, b: other, pairs, stored: 0, dropped: 0, is_undecided: false };
        let (truncated, work) = descend([self, other], &pose, &budget, scratch, &mut all)?;
        let ended = match truncated {
            Some(why) => why,
            None if all.dropped > 0 => Ended::Scratch,
            None if all.is_undecided => Ended::Resolution,
            None => Ended::Exact,
        };
        Ok(Overlaps { stored: all.stored, dropped: all.dropped, work, ended })
    }
}

/// Their numbers in the input files.
fn numbers(a: &Bvh<'_>, b: &Bvh<'_>, [first, second]: &PairPlace) -> Option<[u32; 2]> {
    let number = |tree: &Bvh<'_>, &[node, child, lane]: &[u32; 3]| {
        tree.source(tree.links(node)?.triangle(child).wrapping_add(lane))
    };
    Some([number(a, first)?, number(b, second)?])
}

#[derive(Default)]
struct FirstPair {
    met: Option<PairPlace>,
    undecided: Option<PairPlace>,
}

impl PairVisitor for FirstPair {
    #[inline(always)]
    fn pair(&mut self, place: PairPlace, contact: Contact) -> Option<bool> {
        if contact == Contact::Meets {
            self.met = Some(place);
            return Some(false);
        }
        self.undecided = self.undecided.or(Some(place));
        Some(true)
    }
}

struct AllPairs<'a> {
    a: &'a Bvh<'a>,
    b: &'a Bvh<'a>,
    pairs: &'a mut [TrianglePair],
    stored: usize,
    dropped: u32,
    is_undecided: bool,
}

impl PairVisitor for AllPairs<'_> {
    fn pair(&mut self, place: PairPlace, contact: Contact) -> Option<bool> {
        let is_certain = contact == Contact::Meets;
        self.is_undecided |= !is_certain;
        match self.pairs.get_mut(self.stored) {
            Some(slot) => {
                *slot = TrianglePair { triangles: numbers(self.a, self.b, &place)?, is_certain };
                self.stored += 1;
            }
            None => self.dropped = self.dropped.saturating_add(1),
        }
        Some(true)
    }
}
