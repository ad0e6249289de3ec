//! Two box trees, one of them moved: whether their surfaces meet, and where.
//!
//! ```text
//! placement  both trees in one frame: six directions, what rounding may do
//! spans      boxes of two nodes as intervals along these, all pairs of them at once
//! leaves     triangles of two leaves
//! descent    the search
//! ```

mod descent;
mod leaves;
mod placement;
mod spans;

use crate::blob::Bvh;
use crate::geom::Contact;
use crate::query::{Ended, QueryError, Work};
use crate::tribox::Pose;
use descent::{Collect, Place, descend};

/// Nodes whose pairs of children wait: 16 bytes of the caller's stack.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PairEntry {
    nodes: [u32; 2],
    /// A byte for each child of the first, a bit in it for each of the second.
    left: [u32; 2],
}

impl PairEntry {
    /// Any value, for filling arrays.
    pub const EMPTY: PairEntry = PairEntry { nodes: [0; 2], left: [0; 2] };

    /// Entries with which no question can overflow: every entry is deeper in one of the trees, and
    /// none of these has more than 64 levels.
    pub const ENOUGH: usize = 128;
}

/// Whether two surfaces meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overlap {
    /// The answer, about the input meshes.
    pub contact: Contact,
    /// With [`Contact::Meets`] two triangles that do, the first mesh's first; with
    /// [`Contact::Open`] and [`Ended::Level`] two of which it is open. Numbers in the input files.
    pub triangles: Option<[u32; 2]>,
    /// What it cost: pairs of boxes as `nodes`, of triangles as `triangles` (in f32) and `exact`
    /// (in f64), of nodes opened as `splits`.
    pub work: Work,
    /// [`Ended::Exact`] with `Apart` and `Meets`. With `Open`: [`Ended::Level`] if surfaces come
    /// too near to each other for what is stored, [`Ended::Steps`] or [`Ended::Capacity`] if
    /// the search was cut short.
    pub ended: Ended,
}

/// Two triangles that meet or may meet: their numbers in the input files, the first mesh's first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TrianglePair {
    /// The triangles.
    pub triangles: [u32; 2],
    /// Proved that they do.
    pub is_certain: bool,
}

impl TrianglePair {
    /// Any value, for filling arrays.
    pub const EMPTY: TrianglePair = TrianglePair { triangles: [u32::MAX; 2], is_certain: false };
}

/// How a search for all pairs went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overlaps {
    /// Pairs in the slice.
    pub stored: usize,
    /// Pairs that did not fit; those kept are the first that were found.
    pub dropped: u32,
    /// What it cost, as in [`Overlap::work`].
    pub work: Work,
    /// [`Ended::Exact`]: these are the input's pairs, all of them. [`Ended::Level`]: the pairs that are not certain may not meet; no other pair does.
    /// [`Ended::Capacity`] if some did not fit, here or on the stack, [`Ended::Steps`]: more exist or may exist.
    pub ended: Ended,
}

/// Whether the surface of `b`, moved by `pose` from its frame to that of `a` (both in input units),
/// meets the surface of `a`.
///
/// Never a wrong "apart", and never a wrong "meets": both are proved of the input meshes as they
/// were after repair, whatever grids did to vertices, with the numbers of the pose taken as they
/// are, in real arithmetic. Surfaces that touch without passing through each other are
/// [`Contact::Open`], and so are such as come within rounding and the blobs' surface errors of it.
/// Surfaces alone count: of closed meshes one may lie inside the other, which
/// [`signed_distance`](super::signed_distance) of a vertex tells. Of two triangles
/// without area it is never proved that they meet.
///
/// It ends at the first pair that is proved to meet; which one that is does not depend on the
/// target. At most `steps` pairs of nodes are opened. [`PairEntry::ENOUGH`] entries are always
/// enough; a shorter `stack` may turn an answer into `Open`, never into a wrong one.
///
/// Cost: what lies near the other surface; on scanned parts some dozens of pairs of nodes (`cargo
/// xtask measure --overlap`).
///
/// ```
/// use meshsweep_core::{Bvh, tribox::Pose, query::tree::{Contact, PairEntry, overlap}};
/// # fn probe(part: &[u8], tool: &[u8]) -> Result<(), Box<dyn core::error::Error>> {
/// let (part, tool) = (Bvh::open(part)?, Bvh::open(tool)?); // of blobs built with `--for segment`
/// let mut stack = [PairEntry::EMPTY; PairEntry::ENOUGH];
/// let pose = Pose { translation: [30.0, 0.0, 0.0], ..Pose::IDENTITY };
/// let found = overlap(&part, &tool, &pose, u32::MAX, &mut stack)?;
/// match found.contact {
///     Contact::Apart => { /* proved: no point of the moved tool's surface is on the part's */ }
///     Contact::Meets => { /* proved: `found.triangles` of the input files meet */ }
///     Contact::Open => { /* nearer than rounding and grids can tell, or cut short */ }
/// }
/// # Ok(()) }
/// ```
///
/// # Errors
/// [`QueryError::NotFinite`]; [`QueryError::PoseOutOfDomain`] if an entry of the matrix is beyond
/// 2, one grid is 2^40 times as coarse as the other, or a surface error is beyond 2^30 grid units;
/// [`QueryError::NotServed`] unless both have boxes for segments; [`QueryError::NoQueue`].
pub fn overlap(
    a: &Bvh<'_>,
    b: &Bvh<'_>,
    pose: &Pose,
    steps: u32,
    stack: &mut [PairEntry],
) -> Result<Overlap, QueryError> {
    let mut first = First::default();
    let (missed, work) = descend(a, b, pose, steps, stack, &mut first)?;
    let (contact, place, ended) = match (first.met, missed, first.open) {
        (Some(place), _, _) => (Contact::Meets, Some(place), Ended::Exact),
        (None, Some(why), _) => (Contact::Open, None, why),
        (None, None, Some(place)) => (Contact::Open, Some(place), Ended::Level),
        (None, None, None) => (Contact::Apart, None, Ended::Exact),
    };
    let triangles =
        place.map(|place| numbers(a, b, &place).ok_or(QueryError::Model)).transpose()?;
    Ok(Overlap { contact, triangles, work, ended })
}

/// All pairs of triangles of `a` and of `b`, moved by `pose`, that meet or that cannot be told to
/// be apart, into `pairs`.
///
/// What [`overlap`] says of its arguments, errors and degenerate cases holds here. Every pair is
/// found once; the order is that of the search and the same on every target. Cost: what lies along
/// the curves where the surfaces meet.
///
/// # Errors
/// Those of [`overlap`].
pub fn all_overlaps(
    a: &Bvh<'_>,
    b: &Bvh<'_>,
    pose: &Pose,
    steps: u32,
    pairs: &mut [TrianglePair],
    stack: &mut [PairEntry],
) -> Result<Overlaps, QueryError> {
    let mut all = All { a, b, pairs, stored: 0, dropped: 0, is_open: false };
    let (missed, work) = descend(a, b, pose, steps, stack, &mut all)?;
    let ended = match missed {
        Some(why) => why,
        None if all.dropped > 0 => Ended::Capacity,
        None if all.is_open => Ended::Level,
        None => Ended::Exact,
    };
    Ok(Overlaps { stored: all.stored, dropped: all.dropped, work, ended })
}

/// Their numbers in the input files.
fn numbers(a: &Bvh<'_>, b: &Bvh<'_>, [first, second]: &Place) -> Option<[u32; 2]> {
    let number = |tree: &Bvh<'_>, &[node, child, lane]: &[u32; 3]| {
        tree.source(tree.links(node)?.triangle(child).wrapping_add(lane))
    };
    Some([number(a, first)?, number(b, second)?])
}

#[derive(Default)]
struct First {
    met: Option<Place>,
    open: Option<Place>,
}

impl Collect for First {
    #[inline(always)]
    fn pair(&mut self, place: Place, contact: Contact) -> Option<bool> {
        if contact == Contact::Meets {
            self.met = Some(place);
            return Some(false);
        }
        self.open = self.open.or(Some(place));
        Some(true)
    }
}

struct All<'a> {
    a: &'a Bvh<'a>,
    b: &'a Bvh<'a>,
    pairs: &'a mut [TrianglePair],
    stored: usize,
    dropped: u32,
    is_open: bool,
}

impl Collect for All<'_> {
    fn pair(&mut self, place: Place, contact: Contact) -> Option<bool> {
        let is_certain = contact == Contact::Meets;
        self.is_open |= !is_certain;
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
