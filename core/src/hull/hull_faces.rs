//! The hull of one level as triangles: for drawing, export and tests.

use crate::hull::format::{Hull, Level, SplitIdx, VertIdx};

/// One triangle of a hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HullFace {
    /// Corners, counter-clockwise seen from outside.
    pub corners: [VertIdx; 3],
    /// Certified radius, local frame. Infinite if no part of the surface is assigned to the
    /// triangle.
    pub radius: f32,
}

impl Hull<'_> {
    /// Triangles of the hull after `level.splits` splits, from the tables alone: no memory, time
    /// linear in the splits. [`vertex`](Hull::vertex) gives the corners' coordinates.
    ///
    /// A triangle exists exactly while its three corners exist. It appears with the last of them.
    /// The first split of a corner removes it, with the whole star of the split vertex.
    pub fn faces(&self, level: &Level) -> impl Iterator<Item = HullFace> + '_ {
        let splits = level.splits;
        let alive =
            move |vertex: VertIdx| self.split_of(vertex).is_none_or(|split| split.0 >= splits);
        let base = (0..self.header().base_triangles).filter_map(move |index| {
            Some(HullFace { corners: self.base_triangle(index)?, radius: self.radius(index)? })
        });
        let fine = (0..splits).flat_map(move |index| {
            let split = self.split(SplitIdx(index));
            let count = split.map_or(0, |s| s.fine_len());
            (0..count).filter_map(move |slot| {
                let split = split?;
                let corners = split.fine(slot)?;
                let number = split.first_triangle.checked_add(u32::try_from(slot).ok()?)?;
                Some(HullFace { corners, radius: self.radius(number)? })
            })
        });
        base.chain(fine).filter(move |face| face.corners.into_iter().all(alive))
    }
}
