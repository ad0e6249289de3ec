//! Numbers of the triangles of all levels, so that one word names a triangle without its corners.
//!
//! The triangles of the surface are those that no split removes. Their numbers in the input file
//! are stored in the order of instances, with a start for each eighth split. So the place of one
//! is found by counting in at most eight splits.

use core::ops::Range;

use super::index::{SplitIdx, TriIdx, VertIdx};
use super::layout::{BASE_GROUP, SLOTS, START_GROUP};
use super::view::{Hull, Split};

/// A triangle of any level, or a group of base triangles.
///
/// Base triangles come first, then their groups, then 128 numbers for the triangles of each split.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Instance(pub u32);

/// The contents of an [`Instance`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named {
    /// A triangle of the base hull.
    Base(u32),
    /// A group of triangles of the base hull.
    Group(u32),
    /// A triangle that a split brings, by its slot.
    Fine(SplitIdx, u32),
}

/// For the builder, the checker and the tests.
#[doc(hidden)]
impl<'a> Hull<'a> {
    /// Groups of base triangles.
    #[inline(always)]
    pub fn base_groups(&self) -> u32 {
        self.header.base_triangles.div_ceil(BASE_GROUP)
    }

    /// The number of a thing. `open` made sure that no number overflows.
    #[inline(always)]
    pub fn instance(&self, named: Named) -> Instance {
        let base = self.header.base_triangles;
        Instance(match named {
            Named::Base(index) => index,
            Named::Group(index) => base.wrapping_add(index),
            Named::Fine(split, slot) => base
                .wrapping_add(self.base_groups())
                .wrapping_add(split.0.wrapping_mul(SLOTS))
                .wrapping_add(slot),
        })
    }

    /// What a number names.
    #[inline(always)]
    pub fn named(&self, instance: Instance) -> Named {
        let Some(past) = instance.0.checked_sub(self.header.base_triangles) else {
            return Named::Base(instance.0);
        };
        match past.checked_sub(self.base_groups()) {
            None => Named::Group(past),
            Some(fine) => Named::Fine(SplitIdx(fine / SLOTS), fine % SLOTS),
        }
    }

    /// Corners of a triangle; `None` of a group.
    #[inline]
    pub fn corners(&self, instance: Instance) -> Option<[VertIdx; 3]> {
        match self.named(instance) {
            Named::Base(index) => self.base_triangle(index),
            Named::Group(_) => None,
            Named::Fine(split, slot) => self.split(split)?.fine(slot as usize),
        }
    }

    /// The split that removes a triangle in the builder's order: the first of its corners'. `None`
    /// on the surface and beyond a cut.
    #[inline(always)]
    pub fn removed_by(&self, corners: [VertIdx; 3]) -> Option<SplitIdx> {
        let [a, b, c] = corners;
        let [a, b, c] =
            [self.stored_split_of(a)?, self.stored_split_of(b)?, self.stored_split_of(c)?];
        self.stored_split(a.min(b).min(c))
    }

    /// The place of a triangle among those of the surface.
    pub fn surface_index(&self, instance: Instance) -> Option<TriIdx> {
        let (from, split, slot) = match self.named(instance) {
            Named::Base(index) => return self.base_index(index).map(TriIdx),
            Named::Group(_) => return None,
            Named::Fine(split, slot) => (split.0 - split.0 % START_GROUP, split, slot as usize),
        };
        let mut before = self.source_start(from / START_GROUP)?;
        for index in from..split.0 {
            let earlier = self.split(SplitIdx(index))?;
            before = before.checked_add(self.finals(&earlier, earlier.fine_len())?)?;
        }
        Some(TriIdx(before.checked_add(self.finals(&self.split(split)?, slot)?)?))
    }

    /// Triangles of the surface before a base triangle, counted from the nearer end.
    fn base_index(&self, index: u32) -> Option<u32> {
        let end = self.header.base_triangles;
        match self.source_start(0) {
            Some(all) if index > end / 2 => all.checked_sub(self.base_finals(index..end)?),
            _ => self.base_finals(0..index),
        }
    }

    /// Number in the input file of a triangle of the surface; `None` of any other.
    pub fn number(&self, instance: Instance) -> Option<u32> {
        let is_surface = !self.is_cut() && self.removed_by(self.corners(instance)?).is_none();
        if is_surface { self.source(self.surface_index(instance)?) } else { None }
    }

    /// A triangle that stands for a part of the surface and that no split removes: of the last
    /// split, or of the base without splits. `open` made sure that there is one.
    pub(crate) fn last_part(&self) -> Option<Instance> {
        let Some(last) = self.header.splits.checked_sub(1).map(SplitIdx) else {
            let index = (0..self.header.base_triangles).find(|&index| self.has_part(index))?;
            return Some(self.instance(Named::Base(index)));
        };
        let split = self.split(last)?;
        let count = u32::try_from(split.fine_len()).ok()?;
        let has_part = |slot: &u32| self.has_part(split.first_triangle.wrapping_add(*slot));
        Some(self.instance(Named::Fine(last, (0..count).find(has_part)?)))
    }

    /// Triangles of the surface among base triangles.
    pub(super) fn base_finals(&self, triangles: Range<u32>) -> Option<u32> {
        let mut finals = 0;
        for index in triangles {
            let [a, b, c] = self.base_triangle(index)?;
            let is_final = self.is_final(a)? && self.is_final(b)? && self.is_final(c)?;
            finals += u32::from(is_final && self.has_part(index));
        }
        Some(finals)
    }

    /// Triangles of the surface among the first of a split's.
    pub(super) fn finals(&self, split: &Split<'a>, slots: usize) -> Option<u32> {
        /// Five copies are a third of a kilobyte on boards.
        #[cfg_attr(meshsweep_small, inline(never))]
        #[cfg_attr(not(meshsweep_small), inline(always))]
        fn is_final(hull: &Hull<'_>, vertex: VertIdx) -> Option<bool> {
            hull.is_final(vertex)
        }

        let are_final = [is_final(self, split.origin)?, is_final(self, split.destination())?];
        if are_final == [false; 2] {
            return Some(0);
        }
        let mut finals = 0;
        for slot in 0..slots {
            let is_final = if slot < split.ring_len() {
                are_final[usize::from(slot >= split.right)]
                    && is_final(self, split.ring(slot)?)?
                    && is_final(self, split.ring(slot + 1)?)?
            } else {
                let wing = if slot == split.ring_len() { split.right } else { 0 };
                are_final == [true; 2] && is_final(self, split.ring(wing)?)?
            };
            let radius = split.first_triangle.checked_add(u32::try_from(slot).ok()?)?;
            finals += u32::from(is_final && self.has_part(radius));
        }
        Some(finals)
    }

    /// Whether no split replaces a vertex.
    #[inline(always)]
    fn is_final(&self, vertex: VertIdx) -> Option<bool> {
        Some(self.stored_split(self.stored_split_of(vertex)?).is_none())
    }
}
