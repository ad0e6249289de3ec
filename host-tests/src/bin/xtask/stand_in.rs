//! A blob made by hand: a lumpy torus without splits, under an eight-fold tree of covers.
//!
//! It stands in for the builder's blobs, so that the firmware can be run and its bits compared without one.

use meshsweep_core::blob::layout::{
    HEADER_BYTES, HEADER_CRC_AT, LEAF_FLAG, SECTION_ENTRY_BYTES, SectionKind, VertexFormat,
};
use meshsweep_core::blob::{Header, section_crc};
use meshsweep_core::geom::Aabb;
use meshsweep_core::num::Radius16;
use meshsweep_suite::rng::Rng;

use glam::Vec3;

/// Children of an inner node.
const FAN_OUT: u32 = 8;

/// A torus of `2 · 4^log` triangles, `8^depth` leaves.
pub fn torus(log: u32, depth: u32) -> Vec<u8> {
    let side = 1_u32 << log;
    let mut rng = Rng::new(3);
    let vertices: Vec<Vec3> =
        (0..side * side).map(|v| position(v % side, v / side, side, &mut rng)).collect();
    let triangles: Vec<[u32; 3]> = (0..side * side).flat_map(|cell| halves(cell, side)).collect();
    let nodes = cover(&vertices, &triangles, depth);

    let bounds = |points: &[Vec3]| Aabb {
        min: points.iter().fold(Vec3::INFINITY, |low, p| low.min(*p)),
        max: points.iter().fold(Vec3::NEG_INFINITY, |high, p| high.max(*p)),
    };
    let header = Header {
        header_bytes: 0,
        total_bytes: 0,
        section_count: 0,
        flags: 0,
        scale_exponent: 2,
        vertex_format: VertexFormat::F32,
        grid_exponent: 0,
        grid_origin: [0; 3],
        vertices: count(vertices.len()),
        base_vertices: count(vertices.len()),
        base_triangles: count(triangles.len()),
        splits: 0,
        rings: 0,
        nodes: count(nodes.len()),
        surface_triangles: count(triangles.len()),
        levels: 1,
        input_triangles: count(triangles.len()),
        surface_error: 0.0,
        hull_box: bounds(&vertices),
        surface_box: bounds(&vertices),
        queue_capacity: FAN_OUT * (depth + 1),
        dependency_depth: 0,
    };
    let corners: Vec<u8> =
        triangles.iter().flatten().flat_map(|v| le(*v, header.vertex_index_bytes())).collect();
    let sections = SectionKind::ALL.map(|kind| {
        let bytes = match kind {
            SectionKind::Levels => [header.base_triangles, 0, header.nodes, 0, 0, 0]
                .iter()
                .flat_map(|word| le(*word, 4))
                .collect(),
            SectionKind::Vertices => {
                vertices.iter().flat_map(|v| v.to_array()).flat_map(f32::to_le_bytes).collect()
            }
            SectionKind::BaseTriangles | SectionKind::Surface => corners.clone(),
            SectionKind::Splits | SectionKind::Rings => Vec::new(),
            SectionKind::SplitsWith => vec![0xff; vertices.len() * header.split_index_bytes()],
            SectionKind::Radii => vec![0; triangles.len()],
            SectionKind::Cover => nodes.iter().flat_map(|node| node.bytes(&header)).collect(),
            SectionKind::Source => {
                (0..header.input_triangles).flat_map(|s| le(s, header.source_index_bytes())).collect()
            }
        };
        (kind, bytes)
    });
    assemble(header, &sections)
}

struct Node {
    corners: [u32; 3],
    radius: Radius16,
    first: u32,
    tag: u8,
}

impl Node {
    fn bytes(&self, header: &Header) -> Vec<u8> {
        let corners = self.corners.into_iter().flat_map(|v| le(v, header.vertex_index_bytes()));
        let rest = le(self.first, header.child_index_bytes()).chain([self.tag]);
        corners.chain(self.radius.0.to_le_bytes()).chain(rest).collect()
    }
}

fn position(i: u32, j: u32, side: u32, rng: &mut Rng) -> Vec3 {
    let turn = |k: u32| k as f32 / side as f32 * std::f32::consts::TAU;
    let (around, across) = (turn(i), turn(j));
    let ring = 0.5 + across.cos() * (0.2 + 0.05 * rng.signed_unit());
    Vec3::new(ring * around.cos(), ring * around.sin(), 0.25 * across.sin())
}

/// The triangles of a cell; cells are numbered along a Morton curve, so that runs of them are patches.
fn halves(cell: u32, side: u32) -> [[u32; 3]; 2] {
    let even = |word: u32| (0..16).map(|bit| (word >> (2 * bit) & 1) << bit).sum::<u32>();
    let (i, j) = (even(cell), even(cell >> 1));
    let vertex = |i: u32, j: u32| j % side * side + i % side;
    let (a, b, c, d) = (vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    [[a, b, c], [a, c, d]]
}

/// Nodes in breadth-first order. A node's triangle is the first of its patch; its radius reaches every vertex of the patch.
fn cover(vertices: &[Vec3], triangles: &[[u32; 3]], depth: u32) -> Vec<Node> {
    let mut nodes = Vec::new();
    let mut level_begin = 0;
    for level in 0..=depth {
        let width = FAN_OUT.pow(level);
        let per_node = triangles.len() / width as usize;
        for (index, patch) in (0_u32..).zip(triangles.chunks_exact(per_node)) {
            let at = |v: u32| vertices[v as usize].as_dvec3();
            let base = at(patch[0][0]);
            let reach = patch.iter().flatten().map(|v| at(*v).distance(base)).fold(0.0, f64::max);
            let (first, tag) = if level == depth {
                (index * count(per_node), LEAF_FLAG | u8::try_from(per_node).unwrap_or(0))
            } else {
                (level_begin + width + index * FAN_OUT, 8)
            };
            nodes.push(Node { corners: patch[0], radius: Radius16::round_up(reach), first, tag });
        }
        level_begin += width;
    }
    nodes
}

fn assemble(mut header: Header, sections: &[(SectionKind, Vec<u8>)]) -> Vec<u8> {
    header.section_count = count(sections.len());
    header.header_bytes = count(HEADER_BYTES + sections.len() * SECTION_ENTRY_BYTES);
    let mut body = Vec::new();
    let mut table = Vec::new();
    for (kind, bytes) in sections {
        let offset = header.header_bytes + count(body.len());
        table.extend(
            [*kind as u32, offset, count(bytes.len()), section_crc(bytes)].iter().flat_map(|w| le(*w, 4)),
        );
        body.extend_from_slice(bytes);
        body.resize(body.len().next_multiple_of(4), 0);
    }
    // The last section's padding would be bytes after the last section.
    let padding = sections.last().map_or(0, |(_, bytes)| bytes.len().next_multiple_of(4) - bytes.len());
    body.truncate(body.len() - padding);
    header.total_bytes = header.header_bytes + count(body.len());
    let fixed = header.write();
    let checked = [&fixed[..HEADER_CRC_AT], &table].concat();
    [&fixed[..HEADER_CRC_AT], &section_crc(&checked).to_le_bytes(), &table, &body].concat()
}

fn le(word: u32, bytes: usize) -> impl Iterator<Item = u8> {
    word.to_le_bytes().into_iter().take(bytes)
}

fn count(length: usize) -> u32 {
    u32::try_from(length).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::torus;
    use meshsweep_core::Model;

    #[test]
    fn the_core_opens_it() {
        for (log, depth) in [(4, 2), (5, 3)] {
            let blob = torus(log, depth);
            assert_eq!(Model::open(&blob).map(|model| model.header().surface_triangles), Ok(2 << (2 * log)));
        }
    }
}
