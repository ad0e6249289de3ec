//! Writing a blob. Same tables, same bytes.

use super::tables::Tables;
use crate::tight::TightTables;
use crate::tree::TreeTables;
use crate::tribox::TriboxTables;
use glam::Vec3;
use meshsweep_core::SectionKind;
use meshsweep_core::internal::format::layout::{
    FLAG_CUT, HEADER_BYTES, SECTION_ALIGNMENT, SECTION_ENTRY_BYTES, VertexFormat, field, none,
};
use meshsweep_core::internal::format::{Header, section_crc};
use meshsweep_core::internal::hull::format::layout::LEAF_FLAG;
use meshsweep_core::internal::num::{down_to_f32, exp2, up_to_f32};

/// What a blob is to hold, all of the same mesh.
#[derive(Clone, Copy, Debug, Default)]
pub struct Parts<'a> {
    /// The hull hierarchy.
    pub hull: Option<&'a Tables>,
    /// The box tree.
    pub tree: Option<&'a TreeTables>,
    /// The tribox hierarchy.
    pub triboxes: Option<&'a TriboxTables>,
    /// The tight hulls.
    pub tight: Option<&'a TightTables>,
}

/// A blob of a hull hierarchy, a box tree, or both of the same mesh.
///
/// The sections follow each other as given here; same tables, same bytes. Without either the blob
/// does not open.
pub fn blob(hull: Option<&Tables>, tree: Option<&TreeTables>) -> Vec<u8> {
    assemble(&Parts { hull, tree, ..Parts::default() })
}

/// A blob of any of its parts; without one it does not open. Same tables, same bytes.
pub fn assemble(parts: &Parts<'_>) -> Vec<u8> {
    let mut header = match *parts {
        Parts { hull: Some(tables), .. } => tables.header(),
        Parts { tree: Some(tree), .. } => tree_header(tree),
        Parts { triboxes: Some(of), .. } => {
            bare_header(of.scale_exponent, of.surface_error, of.input_triangles, of.bounds)
        }
        Parts { tight: Some(of), .. } => {
            bare_header(of.scale_exponent, of.surface_error, of.input_triangles, of.bounds)
        }
        _ => Tables::default().header(),
    };
    let mut bodies: Vec<(SectionKind, Vec<u8>)> = Vec::new();
    if let Some(tables) = parts.hull {
        let kinds = SectionKind::ALL.into_iter().filter(|kind| kind.is_hull());
        bodies.extend(kinds.map(|kind| (kind, tables.section(kind, &header))));
    }
    if let Some(tree) = parts.tree {
        header.input_triangles = header.input_triangles.max(tree.input_triangles);
        bodies.extend(tree.sections.iter().cloned());
    }
    if let Some(triboxes) = parts.triboxes {
        debug_assert_eq!(triboxes.scale_exponent, header.scale_exponent, "of another mesh");
        bodies.push((SectionKind::Triboxes, triboxes.section.clone()));
    }
    if let Some(tight) = parts.tight {
        header.input_triangles = header.input_triangles.max(tight.input_triangles);
        bodies.push((SectionKind::TightHulls, tight.section.clone()));
    }
    bodies.retain(|(_, body)| !body.is_empty());
    join(header, &bodies)
}

/// The header of a blob that holds neither hull hierarchy nor box tree.
fn bare_header(
    scale_exponent: i32,
    surface_error: f32,
    input_triangles: u32,
    bounds: [[f32; 3]; 2],
) -> Header {
    Header {
        scale_exponent,
        surface_error,
        input_triangles,
        hull_box: bounds,
        surface_box: bounds,
        queue_capacity: 0,
        ..Tables::default().header()
    }
}

/// The header of a blob that holds a box tree alone.
fn tree_header(tree: &TreeTables) -> Header {
    let h = &tree.header;
    let at = |stored: [u16; 3], axis: usize, down: bool| {
        let units = f64::from(stored[axis]) + f64::from(h.grid_origin[axis]);
        let x = units * exp2(h.grid_exponent);
        if down { down_to_f32(x) } else { up_to_f32(x) }
    };
    let corner = |stored: [u16; 3], down: bool| [0, 1, 2].map(|axis| at(stored, axis, down));
    let bounds = [corner(h.low, true), corner(h.high, false)];
    Header {
        scale_exponent: tree.scale_exponent,
        surface_error: h.surface_error,
        hull_box: bounds,
        surface_box: bounds,
        queue_capacity: 0,
        ..Tables::default().header()
    }
}

fn join(mut header: Header, bodies: &[(SectionKind, Vec<u8>)]) -> Vec<u8> {
    let table_bytes = HEADER_BYTES + bodies.len() * SECTION_ENTRY_BYTES;
    let mut table = Vec::new();
    let mut out = vec![0u8; table_bytes];
    for (kind, body) in bodies {
        out.resize(out.len().next_multiple_of(SECTION_ALIGNMENT), 0);
        for word in [*kind as u32, out.len() as u32, body.len() as u32, section_crc(body)] {
            table.extend(word.to_le_bytes());
        }
        out.extend(body);
    }
    header.header_bytes = table_bytes as u32;
    header.section_count = bodies.len() as u32;
    header.total_bytes = out.len() as u32;
    out[..HEADER_BYTES].copy_from_slice(&header.write());
    out[HEADER_BYTES..table_bytes].copy_from_slice(&table);
    let mut covered = out[..field::CRC].to_vec();
    covered.extend(&out[field::CRC + 4..table_bytes]);
    out[field::CRC..field::CRC + 4].copy_from_slice(&section_crc(&covered).to_le_bytes());
    out
}

impl Tables {
    /// A blob of the hull hierarchy alone.
    pub fn to_bytes(&self) -> Vec<u8> {
        blob(Some(self), None)
    }

    fn header(&self) -> Header {
        Header {
            header_bytes: 0,
            total_bytes: 0,
            section_count: 0,
            flags: if self.is_cut { FLAG_CUT } else { 0 },
            scale_exponent: self.scale_exponent,
            vertex_format: self.grid.format,
            grid_exponent: self.grid.exponent,
            grid_origin: self.grid.origin,
            vertices: self.vertices.len() as u32,
            base_vertices: self.base_vertices,
            base_triangles: self.base.len() as u32,
            splits: self.splits.len() as u32,
            rings: self.rings.len() as u32,
            nodes: self.nodes.len() as u32,
            surface_triangles: self.surface.len() as u32,
            levels: self.levels.len() as u32,
            input_triangles: self.input_triangles,
            surface_error: self.surface_error,
            hull_box: self.hull_box().corners(),
            surface_box: self.surface_box.corners(),
            queue_capacity: self.queue_capacity,
            dependency_depth: self.dependency_depth(),
        }
    }

    fn section(&self, kind: SectionKind, header: &Header) -> Vec<u8> {
        let (wv, ws) = (header.vertex_index_bytes(), header.split_index_bytes());
        let (wr, wc) = (header.ring_index_bytes(), header.child_index_bytes());
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
                    out.extend([split.right, split.reach.0]);
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
            SectionKind::Cover => {
                for node in &self.nodes {
                    node.corners.iter().for_each(|&v| put(&mut out, v, wv));
                    out.extend(node.radius.0.to_le_bytes());
                    // What was cut off is "none": it lies beyond every count.
                    let first = if node.count == 0 { none(wc) } else { node.first };
                    put(&mut out, first, wc);
                    out.push(node.count | if node.leaf { LEAF_FLAG } else { 0 });
                }
            }
            SectionKind::Surface => {
                self.surface.iter().flatten().for_each(|&v| put(&mut out, v, wv))
            }
            SectionKind::Source => {
                let width = header.source_index_bytes();
                self.source.iter().for_each(|&s| put(&mut out, s, width));
            }
            SectionKind::Levels => {
                for level in &self.levels {
                    for word in [level.faces, level.splits, level.nodes] {
                        out.extend(word.to_le_bytes());
                    }
                    for x in [level.hull_to_surface, level.surface_to_hull, level.void_ratio] {
                        out.extend(x.to_le_bytes());
                    }
                }
            }
            // All others bring their own.
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
