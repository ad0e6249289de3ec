//! Whether two surfaces meet, and which of their triangles do.

use super::answer::Ended;
use super::decided::Witness;
use super::work::Work;
use crate::geom::Contact;

/// Two triangles that meet or may meet: their numbers in the input files, the first mesh's first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
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
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct AllOverlaps {
    /// Pairs in the slice.
    pub stored: usize,
    /// Pairs that did not fit. The slice keeps the first ones that were found.
    pub dropped: u32,
    /// The work of the search: pairs of boxes as `bounds`, pairs of triangles as `triangles` (in
    /// f32) and `exact` (in f64), pairs of nodes as `opened`.
    pub work: Work,
    /// [`Ended::Exact`]: these are all of the input's pairs. [`Ended::Resolution`]: pairs that are
    /// not certain may not meet; no other pair does. Without any pair: a blob is cut, and the
    /// surfaces may meet. [`Ended::Scratch`]: some pairs did not fit the slice or the scratch
    /// memory. [`Ended::Steps`]: more pairs may exist.
    pub ended: Ended,
}

/// A question's visitor for pairs of triangles that meet or may meet. A place names a pair in its
/// structure.
pub(crate) trait PairVisitor<Place> {
    /// Whether to go on. `None` says that the structure is unchecked.
    fn pair(&mut self, place: Place, contact: Contact) -> Option<bool>;
}

/// Wants a pair that meets, or else one that may meet.
impl<Place> PairVisitor<Place> for Witness<Place> {
    #[inline(always)]
    fn pair(&mut self, place: Place, contact: Contact) -> Option<bool> {
        if contact == Contact::Meets {
            self.met = Some(place);
            return Some(false);
        }
        if self.may.is_none() {
            self.may = Some(place);
        }
        Some(true)
    }
}

/// The visitor that wants all pairs in the caller's slice.
pub(crate) struct AllPairs<'a, Numbers> {
    pairs: &'a mut [TrianglePair],
    /// Numbers in the input files of the triangles at a place.
    numbers: Numbers,
    stored: usize,
    dropped: u32,
    is_undecided: bool,
}

impl<'a, Numbers> AllPairs<'a, Numbers> {
    pub(crate) fn new(pairs: &'a mut [TrianglePair], numbers: Numbers) -> Self {
        AllPairs { pairs, numbers, stored: 0, dropped: 0, is_undecided: false }
    }

    pub(crate) fn answer(self, truncated: Option<Ended>, work: Work) -> AllOverlaps {
        let ended = match truncated {
            Some(why) => why,
            None if self.dropped > 0 => Ended::Scratch,
            None if self.is_undecided => Ended::Resolution,
            None => Ended::Exact,
        };
        AllOverlaps { stored: self.stored, dropped: self.dropped, work, ended }
    }
}

impl<Place, Numbers: Fn(&Place) -> Option<[u32; 2]>> PairVisitor<Place> for AllPairs<'_, Numbers> {
    fn pair(&mut self, place: Place, contact: Contact) -> Option<bool> {
        let is_certain = contact == Contact::Meets;
        self.is_undecided |= !is_certain;
        match self.pairs.get_mut(self.stored) {
            Some(slot) => {
                *slot = TrianglePair { triangles: (self.numbers)(&place)?, is_certain };
                self.stored += 1;
            }
            None => self.dropped = self.dropped.saturating_add(1),
        }
        Some(true)
    }
}
