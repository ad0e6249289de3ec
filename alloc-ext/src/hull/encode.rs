//! The hull hierarchy's sections as bytes. Same tables, same bytes.

use super::tables::Tables;
use crate::emit::Sections;
use glam::Vec3;
use meshsweep_core::SectionKind;
use meshsweep_core::internal::format::Header;
use meshsweep_core::internal::format::layout::{FLAG_CUT, FLAG_SWEEP_ONLY, VertexFormat, none};
use meshsweep_core::internal::hull::format::layout::{LEFT_BEFORE, RIGHT_BEFORE};
use meshsweep_core::internal::num::exp2;

impl Tables {
    /// A blob of the hull hierarchy alone.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        self.sections().to_bytes()
    }

    /// The sections of a blob.
    #[must_use]
    pub fn sections(&self) -> Sections {
        let Self { scale_exponent, surface_error, input_triangles, surface_box, .. } = *self;
        let mut sections =
            Sections::new(scale_exponent, surface_error, input_triangles, surface_box, Vec::new());
        sections.header = self.header(sections.header);
        let kinds = SectionKind::ALL.into_iter().filter(|kind| kind.is_hull());
        sections.bodies = kinds.map(|kind| (kind, self.section(kind, &sections.header))).collect();
        sections
    }

    fn header(&self, bare: Header) -> Header {
        Header {
            flags: if self.is_cut { FLAG_CUT } else { 0 }
                | if self.encloses { 0 } else { FLAG_SWEEP_ONLY },
            vertex_format: self.grid.format,
            grid_exponent: self.grid.exponent,
            grid_origin: self.grid.origin,
            vertices: self.vertices.len() as u32,
            base_vertices: self.base_vertices,
            base_triangles: self.base.len() as u32,
            splits: self.splits.len() as u32,
            rings: self.rings.len() as u32,
            surface_triangles: self.source.len() as u32,
            levels: self.levels.len() as u32,
            hull_box: self.hull_box().corners(),
            queue_capacity: self.queue_capacity,
            dependency_depth: self.dependency_depth(),
            ..bare
        }
    }

    fn section(&self, kind: SectionKind, header: &Header) -> Vec<u8> {
        let (wv, ws) = (header.vertex_index_bytes(), header.split_index_bytes());
        let (wr, wt) = (header.ring_index_bytes(), header.start_index_bytes());
        let mut out = Vec::new();
        match kind {
            SectionKind::Vertices => {
                self.vertices.iter().for_each(|&v| self.put_vertex(&mut out, v))
            }
            SectionKind::BaseTriangles => {
                self.base.iter().flatten().for_each(|&v| put(&mut out, v, wv))
            }
            SectionKind::Splits => {
                for split in &self.splits {
                    put(&mut out, split.vertex, wv);
                    put(&mut out, split.ring_start, wr);
                    let [right, left] = split.before;
                    let bits =
                        if right { RIGHT_BEFORE } else { 0 } | if left { LEFT_BEFORE } else { 0 };
                    out.extend([split.right | bits, split.star_radius.0, split.error.0]);
                }
            }
            SectionKind::BaseGroups => {
                for (corners, radius) in &self.groups {
                    corners.iter().for_each(|&v| put(&mut out, v, wv));
                    out.extend(radius.0.to_le_bytes());
                }
            }
            SectionKind::Rings => self.rings.iter().for_each(|&v| put(&mut out, v, wv)),
            SectionKind::Radii => out.extend(self.radii.iter().map(|r| r.0)),
            SectionKind::SplitsWith => {
                self.splits_with.iter().for_each(|s| put(&mut out, s.unwrap_or(none(ws)), ws));
            }
            SectionKind::SourceStarts => {
                self.source_starts.iter().for_each(|&start| put(&mut out, start, wt));
            }
            SectionKind::Source => {
                let width = header.source_index_bytes();
                self.source.iter().for_each(|&s| put(&mut out, s, width));
            }
            SectionKind::Levels => {
                for level in &self.levels {
                    for word in [level.faces, level.splits] {
                        out.extend(word.to_le_bytes());
                    }
                    for x in [level.hull_to_surface, level.surface_to_hull, level.void_ratio] {
                        out.extend(x.to_le_bytes());
                    }
                }
            }
            // Sections of other structures.
            _ => {}
        }
        out
    }

    fn put_vertex(&self, out: &mut Vec<u8>, v: Vec3) {
        let width = match self.grid.format {
            VertexFormat::F32 => {
                v.to_array().iter().for_each(|x| out.extend(x.to_le_bytes()));
                return;
            }
            VertexFormat::Grid16 => 2,
            VertexFormat::Grid24 => 3,
        };
        for (x, origin) in v.to_array().into_iter().zip(self.grid.origin) {
            let stored = f64::from(x) * exp2(-self.grid.exponent) - f64::from(origin);
            // Exact: the vertex is on the grid.
            put(out, stored as u32, width);
        }
    }
}

/// The low `width` bytes of an index.
fn put(out: &mut Vec<u8>, index: u32, width: usize) {
    out.extend(&index.to_le_bytes()[..width]);
}
