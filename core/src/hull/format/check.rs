//! The check of the sections' contents in [`Hull::open`].

use super::index::{SplitIdx, TriIdx, VertIdx};
use super::layout::{BASE_GROUP, LEVEL_BYTES, MAX_RING, SLOTS, START_GROUP};
use super::view::{Hull, Vertices, Widths};
use crate::format::Contradiction;
use crate::format::layout::{MAX_LEVELS, SectionKind, VertexFormat};
use crate::format::{Bytes, OpenError, SectionTable};
use crate::geom::Aabb;

impl<'a> Hull<'a> {
    /// Opens the hull hierarchy of a blob where it lies and checks all of it: CRCs, every index,
    /// every coordinate, every order that the queries rely on. Any bytes are safe to open. It reads
    /// no other sections, so that the code that checks them is not linked.
    ///
    /// Cost: linear in the hierarchy, no allocation; once per start. Alignment of `bytes` does not
    /// matter.
    ///
    /// # Errors
    /// [`OpenError`]; [`OpenError::MissingSection`] if the blob was built without a hull.
    #[inline(never)]
    pub fn open(bytes: &'a [u8]) -> Result<Hull<'a>, OpenError> {
        let table = SectionTable::open(bytes)?;
        table.check_crcs(SectionKind::is_hull)?;
        let hull = Hull::locate(&table)?;
        if !hull.has_hull() {
            return Err(OpenError::MissingSection { section: SectionKind::BaseTriangles });
        }
        hull.check()?;
        Ok(hull)
    }

    /// The hull hierarchy of bytes that were opened before.
    pub(crate) fn view(bytes: &'a [u8]) -> Result<Hull<'a>, OpenError> {
        Hull::locate(&SectionTable::view(bytes)?)
    }

    /// The sections where they lie, of the right lengths. A blob without a hull hierarchy has none
    /// of them.
    pub(crate) fn locate(table: &SectionTable<'a>) -> Result<Hull<'a>, OpenError> {
        let header = table.header;
        let section = |kind: SectionKind| Bytes(table.bytes(kind));
        let hull = Hull {
            header,
            checksum: table.checksum(),
            widths: Widths::of(&header),
            vertices: Vertices::new(header.vertex_format, table.bytes(SectionKind::Vertices)),
            base: section(SectionKind::BaseTriangles),
            groups: section(SectionKind::BaseGroups),
            splits: section(SectionKind::Splits),
            rings: section(SectionKind::Rings),
            radii: section(SectionKind::Radii),
            splits_with: section(SectionKind::SplitsWith),
            source_starts: section(SectionKind::SourceStarts),
            source: section(SectionKind::Source),
            levels: section(SectionKind::Levels),
        };
        let wrong = SectionKind::ALL
            .into_iter()
            .filter(|kind| kind.is_hull())
            .find(|&kind| hull.section_len(kind) != Some(table.bytes(kind).len()));
        match wrong {
            Some(kind) => Err(table.malformed(kind)),
            None => Ok(hull),
        }
    }
}

impl Hull<'_> {
    /// Bytes that a section must have, by the header's counts; `None` if they overflow.
    pub(crate) fn section_len(&self, kind: SectionKind) -> Option<usize> {
        let h = &self.header;
        let (records, each) = match kind {
            SectionKind::Vertices => (h.vertices as usize, h.vertex_format.vertex_bytes()),
            SectionKind::BaseTriangles => (h.base_triangles as usize, 3 * self.widths.vertex),
            SectionKind::BaseGroups => {
                (h.base_triangles.div_ceil(BASE_GROUP) as usize, h.group_bytes())
            }
            SectionKind::Splits => (h.splits as usize, h.split_bytes()),
            SectionKind::Rings => (h.rings as usize, self.widths.vertex),
            SectionKind::Radii => {
                let fine = (h.splits as usize).checked_mul(2)?.checked_add(h.rings as usize)?;
                (fine.checked_add(h.base_triangles as usize)?, 1)
            }
            SectionKind::SplitsWith => (h.vertices as usize, self.widths.split),
            SectionKind::SourceStarts if !self.is_cut() => {
                (h.splits.div_ceil(START_GROUP) as usize, self.widths.start)
            }
            SectionKind::Source => (h.surface_triangles as usize, h.source_index_bytes()),
            SectionKind::Levels => (h.levels as usize, LEVEL_BYTES),
            _ => (0, 0),
        };
        records.checked_mul(each)
    }

    /// All contents, once the sections are in place.
    pub(crate) fn check(&self) -> Result<(), OpenError> {
        self.check_counts()?;
        self.check_vertices()?;
        self.check_corners()?;
        self.check_splits()?;
        self.check_stars()?;
        if self.last_part().is_none() {
            let what = Contradiction::UncoveredSurface;
            return Err(OpenError::Counts { what });
        }
        self.check_sources()?;
        self.check_levels()
    }

    /// Without a hull hierarchy all header fields about it are 0.
    pub(crate) fn check_absent(&self) -> Result<(), OpenError> {
        let h = &self.header;
        let counts =
            [h.vertices, h.base_vertices, h.splits, h.rings, h.surface_triangles, h.levels];
        let rest = [h.flags, h.queue_capacity, h.dependency_depth];
        if counts.iter().chain(&rest).any(|&count| count != 0) {
            return Err(OpenError::Counts { what: Contradiction::HullWithoutBase });
        }
        self.check_frame()
    }

    fn check_counts(&self) -> Result<(), OpenError> {
        let h = &self.header;
        let wrong = |what: Contradiction| Err(OpenError::Counts { what });
        if u64::from(h.vertices) != u64::from(h.base_vertices) + 2 * u64::from(h.splits) {
            return wrong(Contradiction::HullVertices);
        }
        if h.levels > MAX_LEVELS {
            return wrong(Contradiction::HullLevels);
        }
        if h.base_triangles == 0 || h.levels == 0 {
            return wrong(Contradiction::EmptyHull);
        }
        if self.is_cut() != (h.surface_triangles == 0) {
            return wrong(Contradiction::HullSurface);
        }
        let most = u32::MAX / 16;
        let numbers = u64::from(SLOTS) * u64::from(h.splits) + 2 * u64::from(h.base_triangles);
        if h.vertices.max(h.rings).max(h.surface_triangles) > most || numbers > u64::from(u32::MAX)
        {
            return wrong(Contradiction::HullRecords);
        }
        self.check_frame()?;
        // No queue holds a triangle twice.
        let triangles = u64::from(h.rings) + 2 * u64::from(h.base_triangles + h.splits);
        if h.queue_capacity == 0 || u64::from(h.queue_capacity) > triangles {
            return wrong(Contradiction::HullScratch);
        }
        Ok(())
    }

    /// Scale, error bound, boxes and grid.
    fn check_frame(&self) -> Result<(), OpenError> {
        let h = &self.header;
        let wrong = |what: Contradiction| Err(OpenError::Counts { what });
        if !(h.scale_exponent >= -200 && h.scale_exponent <= 200) {
            return wrong(Contradiction::HullScale);
        }
        if h.surface_error.is_sign_negative() {
            return wrong(Contradiction::HullError);
        }
        let ordered = |[low, high]: [[f32; 3]; 2]| {
            low.iter()
                .zip(&high)
                .all(|(low, high)| low <= high && low.abs().max(high.abs()) <= 16.0)
        };
        if !ordered(h.hull_box) || !ordered(h.surface_box) {
            return wrong(Contradiction::HullBox);
        }
        let grid = h.vertex_format != VertexFormat::F32;
        // Every sum of a stored integer and the origin is exact in f32.
        let range = if h.vertex_format == VertexFormat::Grid16 { 0xFFFF } else { 0xFF_FFFF };
        let limit = 1 << 24;
        let origin_fits = h.grid_origin.iter().all(|&o| o >= -limit && o <= limit - range);
        if grid && !(origin_fits && (-60..=0).contains(&h.grid_exponent)) {
            return wrong(Contradiction::HullGrid);
        }
        Ok(())
    }

    /// Every vertex lies in the hull's box. So it is finite, and the rounding margins of queries
    /// hold.
    fn check_vertices(&self) -> Result<(), OpenError> {
        let bounds = Aabb::of(self.header.hull_box);
        for index in 0..self.header.vertices {
            let inside = self
                .position(VertIdx(index))
                .is_some_and(|p| p.cmpge(bounds.min).all() && p.cmple(bounds.max).all());
            if !inside {
                return Err(OpenError::Record { section: SectionKind::Vertices, index });
            }
        }
        Ok(())
    }

    fn check_corners(&self) -> Result<(), OpenError> {
        let limit = |corners: [VertIdx; 3], count: u32| corners.iter().all(|v| v.0 < count);
        for index in 0..self.header.base_triangles {
            if !self.base_triangle(index).is_some_and(|t| limit(t, self.header.base_vertices)) {
                return Err(OpenError::Record { section: SectionKind::BaseTriangles, index });
            }
        }
        for index in 0..self.header.base_triangles.div_ceil(BASE_GROUP) {
            let sound = self.base_group(index).is_some_and(|(corners, radius)| {
                limit(corners, self.header.base_vertices) && radius >= 0.0
            });
            if !sound {
                return Err(OpenError::Record { section: SectionKind::BaseGroups, index });
            }
        }
        Ok(())
    }

    /// Every vertex that a split names exists before it, and "splits with" is the inverse. So
    /// dependencies have no cycle.
    fn check_splits(&self) -> Result<(), OpenError> {
        for index in 0..self.header.splits {
            let bad = OpenError::Record { section: SectionKind::Splits, index };
            let split = self.split(SplitIdx(index)).ok_or(bad)?;
            let k = split.ring_len();
            if !(2..=MAX_RING).contains(&k)
                || split.right == 0
                || split.right >= k
                || split.vertex >= split.origin
                || !split.error.is_finite()
            {
                return Err(bad);
            }
            if self.split_of(split.vertex) != Some(SplitIdx(index)) {
                return Err(OpenError::Record {
                    section: SectionKind::SplitsWith,
                    index: split.vertex.0,
                });
            }
            if (0..k).any(|i| split.ring(i).is_none_or(|v| v >= split.origin)) {
                return Err(OpenError::Record { section: SectionKind::Rings, index });
            }
        }
        for index in 0..self.header.vertices {
            let consistent = self
                .split_of(VertIdx(index))
                .is_none_or(|split| self.split(split).is_some_and(|s| s.vertex == VertIdx(index)));
            if !consistent {
                return Err(OpenError::Record { section: SectionKind::SplitsWith, index });
            }
        }
        Ok(())
    }

    /// Each triangle that a split removes lies in the split's star. So a sweep finds its children.
    fn check_stars(&self) -> Result<(), OpenError> {
        for index in 0..self.header.base_triangles {
            let in_star = self.base_triangle(index).is_some_and(|t| self.is_in_star(t));
            if !in_star {
                return Err(OpenError::Record { section: SectionKind::BaseTriangles, index });
            }
        }
        for index in 0..self.header.splits {
            let in_stars = self.split(SplitIdx(index)).is_some_and(|split| {
                (0..split.fine_len())
                    .all(|slot| split.fine(slot).is_some_and(|t| self.is_in_star(t)))
            });
            if !in_stars {
                return Err(OpenError::Record { section: SectionKind::Rings, index });
            }
        }
        Ok(())
    }

    /// Whether the split that removes a triangle has it in its star, or there is no such split.
    fn is_in_star(&self, [a, b, c]: [VertIdx; 3]) -> bool {
        let Some(split) = self.removed_by([a, b, c]).and_then(|split| self.split(split)) else {
            return true;
        };
        let v = split.vertex;
        let (from, to) = if a == v {
            (b, c)
        } else if b == v {
            (c, a)
        } else {
            (a, b)
        };
        from != v
            && to != v
            && split.find(from).is_some_and(|edge| split.ring(edge + 1) == Some(to))
    }

    /// Counts the triangles that no split removes. They match the source numbers and their starts,
    /// and lie in the surface's box.
    fn check_sources(&self) -> Result<(), OpenError> {
        if self.is_cut() {
            return Ok(());
        }
        for index in 0..self.header.surface_triangles {
            if self.source(TriIdx(index)).is_none_or(|s| s >= self.header.input_triangles) {
                return Err(OpenError::Record { section: SectionKind::Source, index });
            }
        }
        let bounds = Aabb::of(self.header.surface_box);
        for index in 0..self.header.vertices {
            let inside = self.split_of(VertIdx(index)).is_some()
                || self
                    .position(VertIdx(index))
                    .is_some_and(|p| p.cmpge(bounds.min).all() && p.cmple(bounds.max).all());
            if !inside {
                return Err(OpenError::Record { section: SectionKind::Vertices, index });
            }
        }
        let wrong = OpenError::Counts { what: Contradiction::SourceNumbers };
        let mut before = self.base_finals(0..self.header.base_triangles).ok_or(wrong)?;
        for index in 0..self.header.splits {
            if index % START_GROUP == 0 && self.source_start(index / START_GROUP) != Some(before) {
                let index = index / START_GROUP;
                return Err(OpenError::Record { section: SectionKind::SourceStarts, index });
            }
            let split = self.split(SplitIdx(index)).ok_or(wrong)?;
            before += self.finals(&split, split.fine_len()).ok_or(wrong)?;
        }
        if before == self.header.surface_triangles { Ok(()) } else { Err(wrong) }
    }

    fn check_levels(&self) -> Result<(), OpenError> {
        let mut before = 0;
        for index in 0..self.header.levels {
            let bad = OpenError::Record { section: SectionKind::Levels, index };
            let level = self.level(index).ok_or(bad)?;
            let lengths = [level.hull_to_surface, level.surface_to_hull];
            if lengths.iter().any(|x| x.is_nan() || x.is_sign_negative())
                || level.splits > self.header.splits
                || level.splits < before
            {
                return Err(bad);
            }
            before = level.splits;
        }
        if before != self.header.splits {
            return Err(OpenError::Counts { what: Contradiction::LastHullLevel });
        }
        Ok(())
    }
}
