//! The triangles of hulls: of the base, of a split, of one level. For drawing, export and tests.

use crate::hull::format::{Hull, HullLevel, SplitIdx, VertIdx};

/// One triangle of a hull.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct HullFace {
    /// Corners, counter-clockwise seen from outside.
    pub corners: [VertIdx; 3],
    /// Certified radius, local frame: times [`Hull::scale`] input units.
    pub radius: f32,
}

impl HullFace {
    /// Any value, for filling arrays.
    pub const EMPTY: HullFace = HullFace { corners: [VertIdx(0); 3], radius: 0.0 };
}

impl<'a> Hull<'a> {
    /// Triangles of the hull after `level.splits` splits, from the tables alone: no memory, time
    /// linear in the splits. [`vertex`](Hull::vertex) gives the corners' coordinates.
    ///
    /// A triangle exists exactly while its three corners exist. It appears with the last of them.
    /// The first split of a corner removes it, with the whole star of the split vertex. Triangles
    /// that close the holes of an open mesh are left out.
    pub fn faces(&self, level: &HullLevel) -> impl Iterator<Item = HullFace> + '_ {
        let splits = level.splits;
        let alive =
            move |vertex: VertIdx| self.split_of(vertex).is_none_or(|split| split.0 >= splits);
        let fine = (0..splits).flat_map(|index| self.fine_faces(SplitIdx(index)));
        self.base_faces().chain(fine).filter(move |face| face.corners.into_iter().all(alive))
    }

    /// Triangles of the base hull.
    pub(crate) fn base_faces(&self) -> impl Iterator<Item = HullFace> + use<'a> {
        let hull = *self;
        let standing = (0..hull.header().base_triangles).filter(move |&index| hull.has_part(index));
        standing.filter_map(move |index| {
            Some(HullFace { corners: hull.base_triangle(index)?, radius: hull.radius(index)? })
        })
    }

    /// Triangles that a split adds.
    pub(crate) fn fine_faces(&self, split: SplitIdx) -> impl Iterator<Item = HullFace> + use<'a> {
        let (hull, split) = (*self, self.split(split));
        (0..split.map_or(0, |s| s.fine_len())).filter_map(move |slot| {
            let corners = split?.fine(slot)?;
            let number = split?.first_triangle.checked_add(u32::try_from(slot).ok()?)?;
            if !hull.has_part(number) {
                return None;
            }
            Some(HullFace { corners, radius: hull.radius(number)? })
        })
    }
}
