//! The selectively refined hull: which splits have been performed, in fixed-capacity arrays
//! (Platis & Theoharis 2003, 3.2.1; Guéziec 2000, 4.2).
//!
//! A split may be performed when every vertex of its ring exists. Then the star of its vertex is
//! exactly the one that the builder collapsed, and the refined mesh still encloses the surface.
//! Hull vertices of different levels are different vertices. So a vertex exists if the split that
//! makes it was performed, and one bit set holds that. There is no selective coarsening. A query
//! starts from the base hull again and clears the bits (Platis & Theoharis 2003, 3.2.2).

use crate::hull::format::{Hull, Instance, Named, Split, SplitIdx, VertIdx};

/// A face of the refined hull: a base triangle, or the fine triangle `slot` of a split.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// Split number; `u32::MAX` for a triangle of the base hull.
    split: u32,
    /// Position among the split's fine triangles, or the number of the base triangle.
    slot: u32,
    /// No point of the face meets the segment below this parameter.
    enter: f32,
}

impl Face {
    /// Any value, for filling arrays.
    pub const EMPTY: Face = Face { split: u32::MAX, slot: 0, enter: 0.0 };

    pub(crate) fn base(slot: u32) -> Self {
        Face { split: u32::MAX, slot, enter: 0.0 }
    }

    pub(crate) fn fine(split: SplitIdx, slot: u32) -> Self {
        Face { split: split.0, slot, enter: 0.0 }
    }

    pub(crate) fn entered_at(self, enter: f32) -> Self {
        Face { enter, ..self }
    }

    pub(crate) fn enter_at(self) -> f32 {
        self.enter
    }

    /// The number of the face among the triangles of all levels.
    pub(crate) fn instance(self, model: &Hull<'_>) -> Instance {
        model.instance(if self.split == u32::MAX {
            Named::Base(self.slot)
        } else {
            Named::Fine(SplitIdx(self.split), self.slot)
        })
    }

    /// Corners of the face.
    #[inline]
    pub fn corners(self, model: &Hull<'_>) -> Option<[VertIdx; 3]> {
        if self.split == u32::MAX {
            model.base_triangle(self.slot)
        } else {
            model.split(SplitIdx(self.split))?.fine(self.slot as usize)
        }
    }
}

/// Memory of a refinement: two bit sets of one bit per split, candidates, and a path.
///
/// Any length is correct. With [`Hull::refined_words`] words in each bit set every split can be
/// performed. With fewer, only the coarsest can, and a query ends with
/// [`Ended::Scratch`](crate::Ended::Scratch). A short candidate list costs repeated scans, a short
/// path repeated searches. Neither changes an answer.
#[derive(Debug)]
pub struct RefinedHull<'a> {
    /// Bit set: split performed.
    pub(crate) performed: &'a mut [u32],
    /// Bit set: the new faces were visited.
    pub(crate) swept: &'a mut [u32],
    /// Faces still to be refined.
    pub(crate) candidates: &'a mut [Face],
    pub(crate) path: heapless::Vec<SplitIdx, PATH>,
    /// Splits performed by the last [`refine`](Self::refine), as far as they fit.
    pub(crate) fresh: heapless::Vec<SplitIdx, FRESH>,
}

/// Splits remembered on the way down a chain of dependencies. Deeper chains are searched again from
/// their end.
const PATH: usize = 32;

/// Splits of one refinement that are listed. After a larger one the bit sets are compared instead.
const FRESH: usize = 64;

/// The result of [`RefinedHull::refine`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Refined {
    /// The split and all that it needed are performed: the number of splits.
    Splits(u32),
    /// The bit sets are too short for a split that it needs.
    Scratch,
}

impl<'a> RefinedHull<'a> {
    /// A refined hull in the caller's memory, with any contents. The shorter bit set counts.
    pub fn new(performed: &'a mut [u32], swept: &'a mut [u32], candidates: &'a mut [Face]) -> Self {
        RefinedHull {
            performed,
            swept,
            candidates,
            path: heapless::Vec::new(),
            fresh: heapless::Vec::new(),
        }
    }

    /// Back to the base hull. Cost: the words of the bit sets.
    pub fn reset(&mut self) {
        self.performed.fill(0);
        self.swept.fill(0);
        self.path.clear();
    }

    /// Whether a split fits in the bit sets.
    #[inline]
    pub(crate) fn holds(&self, split: SplitIdx) -> bool {
        split.usize() / 32 < self.performed.len().min(self.swept.len())
    }

    /// Whether a split was performed.
    #[inline]
    pub(crate) fn is_performed(&self, split: SplitIdx) -> bool {
        self.performed.get(split.usize() / 32).is_some_and(|word| word >> (split.0 % 32) & 1 != 0)
    }

    /// Whether a vertex was replaced. The caller has to know that it was made.
    #[inline]
    pub(crate) fn is_split(&self, model: &Hull<'_>, vertex: VertIdx) -> bool {
        model.split_of(vertex).is_some_and(|split| self.is_performed(split))
    }

    /// Whether all corners of a face that was made still exist.
    #[inline]
    pub(crate) fn is_alive(&self, model: &Hull<'_>, corners: [VertIdx; 3]) -> bool {
        !corners.into_iter().any(|v| self.is_split(model, v))
    }

    /// The split that refines a live face: the coarsest among those of its corners. `None` on the
    /// surface.
    ///
    /// The others need vertices that this one makes.
    #[inline]
    pub(crate) fn split_of_face(model: &Hull<'_>, corners: [VertIdx; 3]) -> Option<SplitIdx> {
        corners.into_iter().filter_map(|v| model.split_of(v)).min()
    }

    /// Performs a split and, before it, every split that it needs; no recursion. `None` only if the
    /// model is unchecked.
    ///
    /// Every split on the way is coarser than the one that asked for it, so the search ends.
    pub(crate) fn refine(&mut self, model: &Hull<'_>, wanted: SplitIdx) -> Option<Refined> {
        if !self.holds(wanted) {
            return Some(Refined::Scratch);
        }
        let mut count = 0u32;
        self.path.clear();
        self.fresh.clear();
        let mut current = wanted;
        while !self.is_performed(wanted) {
            let split = model.split(current)?;
            if let Some(needed) = self.missing(model, &split)? {
                // A full path drops its oldest part. The loop comes back to `wanted` for it.
                if self.path.push(current).is_err() {
                    self.path.clear();
                }
                current = needed;
                continue;
            }
            if let Some(word) = self.performed.get_mut(current.usize() / 32) {
                *word |= 1 << (current.0 % 32);
            }
            count += 1;
            // Splits that do not fit are found by their `swept` bits. `count` shows that the list
            // is incomplete.
            let _ = self.fresh.push(current);
            current = self.path.pop().unwrap_or(wanted);
        }
        Some(Refined::Splits(count))
    }

    /// A split that must come before `split` and has not been performed. The outer `None`: the
    /// model is unchecked.
    #[inline]
    fn missing(&self, model: &Hull<'_>, split: &Split<'_>) -> Option<Option<SplitIdx>> {
        let absent =
            |vertex: VertIdx| model.made_by(vertex).filter(|&maker| !self.is_performed(maker));
        if let Some(maker) = absent(split.vertex) {
            return Some(Some(maker));
        }
        for i in 0..split.ring_len() {
            if let Some(maker) = absent(split.ring(i)?) {
                return Some(Some(maker));
            }
        }
        Some(None)
    }
}
