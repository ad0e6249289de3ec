//! The hull of one level as triangles: to draw it, to export it, to test against it.

use crate::hull::format::{Hull, Level, SplitIdx, VertIdx};

/// One triangle of a hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HullFace {
    /// Corners, counter-clockwise seen from outside.
    pub corners: [VertIdx; 3],
    /// Certified radius, local frame; infinite where the triangle stands for no part of the
    /// surface.
    pub radius: f32,
}

impl Hull<'_> {
    /// Triangles of the hull after `level.splits` splits, from the tables alone: no memory, time
    /// linear in the splits. [`vertex`](Hull::vertex) gives the corners' coordinates.
    ///
    /// A triangle is alive exactly while its three corners are. It comes with the last of them, and
    /// the first split of a corner takes it away: the whole star of a split vertex goes.
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
