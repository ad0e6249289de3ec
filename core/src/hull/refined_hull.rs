//! The selectively refined hull: which splits were performed, in fixed memory (Platis & Theoharis
//! 2003, 3.2.1; Guéziec 2000, 4.2).
//!
//! A split may be performed when every vertex of its ring exists. Then the star of its vertex is
//! exactly the one that the builder collapsed, and the refined mesh still encloses the surface. A
//! split may be undone when no performed split uses its two vertices: the star of each of them is
//! then the one that the split made. Hull vertices of different levels are different vertices. So a
//! vertex exists if the split that adds it was performed and the split that replaces it was not,
//! and the set of performed splits is the whole state.

use super::hull_faces::HullFace;
use super::split_set::{SplitSet, SplitSlot};
use crate::hull::format::{Hull, Split, SplitIdx, VertIdx};
use core::marker::PhantomData;

/// A hull that is refined only where a scene needs it, in memory for `SPLITS` performed splits.
///
/// [`update`](Self::update) refines and coarsens it around a [`Focus`](crate::Focus).
/// [`sweep_to`](Self::sweep_to) makes the mesh that a sweep ends with.
/// [`Hull::outer_hits`] refines it along a segment. Every state is a closed mesh that encloses the
/// stored surface, under the conditions that [`Hull::outer_hits`] names. Where the hierarchy does
/// not [enclose](Hull::encloses) it, every state is a mesh near it, open where the surface is.
/// A hull of *f* faces needs (*f* − base faces) / 2 splits. RAM: 16 bytes a split and 24 more,
/// whatever the size of the hierarchy.
///
/// The state belongs to one hull at a time. With another hull it starts from that one's base. It
/// borrows the blob's bytes, so they cannot change between updates.
#[derive(Clone, Debug)]
pub struct RefinedHull<'t, const SPLITS: usize> {
    pub(crate) state: Refined<[SplitSlot; SPLITS]>,
    bytes: PhantomData<&'t [u8]>,
}

impl<const SPLITS: usize> Default for RefinedHull<'_, SPLITS> {
    fn default() -> Self {
        Self::new()
    }
}

/// Most splits of a [`RefinedHull`].
const MOST_SPLITS: usize = 1 << 24;

impl<'t, const SPLITS: usize> RefinedHull<'t, SPLITS> {
    /// The base hull. May initialise a `static`. More than 2^24 `SPLITS` do not compile.
    pub const fn new() -> Self {
        const { assert!(SPLITS <= MOST_SPLITS, "positions of splits are products of 32 bits") }
        RefinedHull {
            state: Refined {
                hull: 0,
                checksum: 0,
                floor: 0.0,
                splits: SplitSet::<[SplitSlot; SPLITS]>::new(),
            },
            bytes: PhantomData,
        }
    }

    /// Back to the base hull. Cost: linear in `SPLITS`.
    pub fn reset(&mut self) {
        erased(&mut self.state).reset();
    }

    /// Splits that are performed.
    pub fn splits(&self) -> usize {
        self.state.splits().len()
    }

    /// Triangles of the refined hull. [`vertex`](Hull::vertex) gives the corners' coordinates. For
    /// a hull other than the one that was refined they are the base hull's.
    ///
    /// Cost: linear in the base hull and the performed splits.
    pub fn faces(&self, hull: &Hull<'t>) -> impl Iterator<Item = HullFace> {
        let splits = self.state.is_of(hull).then(|| self.state.splits());
        live_faces(*hull, splits)
    }

    /// Writes the [`faces`](Self::faces) to a slice: how many were written, and how many did not
    /// fit.
    pub fn faces_into(&self, hull: &Hull<'t>, faces: &mut [HullFace]) -> (usize, u32) {
        let (mut stored, mut dropped) = (0, 0);
        for face in self.faces(hull) {
            match faces.get_mut(stored) {
                Some(slot) => {
                    *slot = face;
                    stored += 1;
                }
                None => dropped += 1,
            }
        }
        (stored, dropped)
    }
}

/// A [`RefinedHull`] in memory whose length is known at run time: it ends with as many slots of
/// sixteen bytes as its pointer says. A value whose bytes are all 0 is the base hull. For the C
/// interface, which makes it of the caller's memory.
#[derive(Debug)]
#[repr(transparent)]
pub struct ErasedHull<'t> {
    bytes: PhantomData<&'t [u8]>,
    pub(crate) state: Refined,
}

impl<'t> ErasedHull<'t> {
    /// As [`RefinedHull::faces`].
    pub fn faces(&self, hull: &Hull<'t>) -> impl Iterator<Item = HullFace> {
        live_faces(*hull, self.state.is_of(hull).then_some(&self.state.splits))
    }
}

/// Triangles of a hull after the splits of a set, or of the base hull.
fn live_faces(hull: Hull<'_>, splits: Option<&SplitSet>) -> impl Iterator<Item = HullFace> {
    let is_live = move |&HullFace { corners, .. }: &HullFace| {
        splits.is_none_or(|splits| {
            split_of_face(&hull, corners).is_none_or(|split| !splits.contains(split))
        })
    };
    let fine = (0..splits.map_or(0, SplitSet::len))
        .filter_map(move |position| splits?.get(position))
        .flat_map(move |split| hull.fine_faces(split));
    hull.base_faces().chain(fine).filter(is_live)
}

/// The state, its memory's length erased, so that code is not repeated for each length.
pub(crate) fn erased<const N: usize>(state: &mut Refined<[SplitSlot; N]>) -> &mut Refined {
    state
}

/// What a [`RefinedHull`] holds.
#[derive(Clone, Debug)]
pub(crate) struct Refined<S: ?Sized = [SplitSlot]> {
    /// Address of the hull's split table, by which another hull is told.
    hull: usize,
    /// The blob's checksum. In C the caller may put another blob at the same address.
    checksum: u32,
    /// Splits of no greater need are left out, because the memory was too short for them.
    pub(crate) floor: f32,
    pub(crate) splits: SplitSet<S>,
}

impl<const N: usize> Refined<[SplitSlot; N]> {
    fn splits(&self) -> &SplitSet {
        &self.splits
    }
}

impl<S: ?Sized> Refined<S> {
    fn is_of(&self, hull: &Hull<'_>) -> bool {
        self.hull == address(hull) && self.checksum == hull.checksum
    }
}

fn address(hull: &Hull<'_>) -> usize {
    hull.splits.0.as_ptr().addr()
}

impl Refined {
    pub(crate) fn reset(&mut self) {
        self.splits.clear();
        self.floor = 0.0;
    }

    /// Faces of the hull that stand for a part of the surface.
    pub(crate) fn face_count(&self, hull: &Hull<'_>) -> u32 {
        if hull.encloses() {
            let splits = self.splits.len() as u32;
            return hull.header().base_triangles.saturating_add(splits.saturating_mul(2));
        }
        live_faces(*hull, Some(&self.splits)).fold(0, |count, _| count.saturating_add(1))
    }

    /// Starts from the base hull, if the hull is another than before.
    pub(crate) fn begin(&mut self, hull: &Hull<'_>) {
        if !self.is_of(hull) {
            self.reset();
            (self.hull, self.checksum) = (address(hull), hull.checksum);
        }
    }

    /// Performs a split that has not been performed and, before it, every split that it requires;
    /// no recursion. The new splits are the last of the list. `Some(false)`: the memory is full.
    /// `None`: the hull is unchecked.
    ///
    /// Every split on the way is coarser than the one that requires it, so the search ends.
    pub(crate) fn perform_with_required(
        &mut self,
        hull: &Hull<'_>,
        wanted: SplitIdx,
    ) -> Option<bool> {
        let mut path = heapless::Vec::<SplitIdx, PATH>::new();
        let mut current = wanted;
        loop {
            let split = hull.split(current)?;
            if let Some(required) = self.missing(hull, &split)? {
                // A full path is forgotten. The loop comes back to `wanted` for it.
                if path.push(current).is_err() {
                    path.clear();
                }
                current = required;
                continue;
            }
            if !self.perform(hull, current, &split)? {
                return Some(false);
            }
            if current == wanted {
                return Some(true);
            }
            current = path.pop().unwrap_or(wanted);
        }
    }

    /// A split that must come before `split` and has not been performed. The outer `None`: the hull
    /// is unchecked.
    #[inline]
    fn missing(&self, hull: &Hull<'_>, split: &Split<'_>) -> Option<Option<SplitIdx>> {
        for i in 0..=split.ring_len() {
            let vertex = if i == 0 { split.vertex } else { split.ring(i - 1)? };
            if let Some(maker) = hull.made_by(vertex)
                && !self.splits.contains(maker)
            {
                return Some(Some(maker));
            }
        }
        Some(None)
    }

    fn perform(&mut self, hull: &Hull<'_>, number: SplitIdx, split: &Split<'_>) -> Option<bool> {
        if !self.splits.push(number) {
            return Some(false);
        }
        for i in 0..=split.ring_len() {
            let vertex = if i == 0 { split.vertex } else { split.ring(i - 1)? };
            if let Some(position) = self.maker(hull, vertex) {
                self.splits.require(position);
                if i == 0 {
                    self.splits.set_replaced(position, hull.which(vertex), true);
                }
            }
        }
        Some(true)
    }

    /// Undoes the split at a position, which no performed split requires.
    /// [`SplitSet::close_gaps`] has to follow. `None`: the hull is unchecked.
    pub(crate) fn undo(&mut self, hull: &Hull<'_>, position: usize) -> Option<()> {
        let split = hull.split(self.splits.get(position)?)?;
        for i in 0..=split.ring_len() {
            let vertex = if i == 0 { split.vertex } else { split.ring(i - 1)? };
            if let Some(position) = self.maker(hull, vertex) {
                self.splits.release(position);
                if i == 0 {
                    self.splits.set_replaced(position, hull.which(vertex), false);
                }
            }
        }
        self.splits.remove(position);
        Some(())
    }

    /// Position of the split that adds a vertex. `None` for a vertex of the base hull.
    #[inline]
    fn maker(&self, hull: &Hull<'_>, vertex: VertIdx) -> Option<usize> {
        self.splits.find(hull.made_by(vertex)?)
    }
}

/// Splits remembered on the way down a chain of requirements. Deeper chains are searched again from
/// their end.
const PATH: usize = 32;

/// The split that refines a face: the coarsest among those of its corners. `None` on the surface.
///
/// The splits of the other corners require it. So a face that was added is live as long as this
/// split has not been performed.
#[inline]
pub(crate) fn split_of_face(hull: &Hull<'_>, corners: [VertIdx; 3]) -> Option<SplitIdx> {
    hull.removed_by(corners)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::focus::Focus;

    #[test]
    fn another_blob_at_the_same_address_starts_from_its_base() {
        let hull = Hull::open(include_bytes!("../../fixtures/bracket.msw")).unwrap();
        let mut refined = RefinedHull::<60>::new();
        refined.update(&hull, &Focus::Everywhere, 0.0, &mut []).unwrap();
        let other = Hull { checksum: !hull.checksum, ..hull };
        assert!(refined.faces(&hull).count() > hull.base_faces().count());
        assert!(refined.faces(&other).eq(hull.base_faces()));
    }
}
