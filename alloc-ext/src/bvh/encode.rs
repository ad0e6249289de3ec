//! The tree's sections as bytes, through the constants of `meshsweep_core::internal::format`.

use super::fans::{FanLeaf, MAX_LEAF_TRIANGLES};
use super::nodes::boxes::NodeBoxes;
use super::nodes::order::Topology;
use super::store::OnGrid;
use crate::emit::{Sections, copied};
use arrayvec::ArrayVec;
use glam::{DVec3, Vec3};
use meshsweep_core::Blob;
use meshsweep_core::SectionKind;
use meshsweep_core::internal::bvh::tree::format::layout::{BOXES_BYTES, FAN_PADDING, FRAME_BYTES};
use meshsweep_core::internal::bvh::tree::format::{BvhHeader, LeafShape, Links};
use meshsweep_core::internal::geom::Aabb;
use meshsweep_core::internal::num::{down_to_f32, exp2, up_to_f32};

/// A box tree's sections; a blob of it alone has the tree's bounds.
pub(super) fn sections(
    scale_exponent: i32,
    input_triangles: u32,
    h: &BvhHeader,
    bodies: Vec<(SectionKind, Vec<u8>)>,
) -> Sections {
    let at = |stored: [u16; 3], axis: usize, down: bool| {
        let units = f64::from(stored[axis]) + f64::from(h.grid_origin[axis]);
        let x = units * exp2(h.grid_exponent);
        if down { down_to_f32(x) } else { up_to_f32(x) }
    };
    let corner = |stored: [u16; 3], down: bool| {
        Vec3::from_array([0, 1, 2].map(|axis| at(stored, axis, down)))
    };
    let bounds = Aabb { min: corner(h.low, true), max: corner(h.high, false) };
    Sections::new(scale_exponent, h.surface_error, input_triangles, bounds, bodies)
}

/// The sections of a blob's box tree, copied unchanged; `None` if the blob has none.
#[must_use]
pub fn sections_of(blob: &Blob<'_>) -> Option<Sections> {
    let tree = blob.bvh().ok()?;
    let bodies = copied(blob, SectionKind::is_bvh);
    Some(sections(tree.scale_exponent(), tree.input_triangles(), tree.header(), bodies))
}

/// Shape of a leaf.
pub(super) fn tag(leaf: &FanLeaf) -> LeafShape {
    match &leaf.second {
        None => LeafShape::new(leaf.triangle_count(), 0, false),
        Some(second) => {
            LeafShape::new(leaf.triangle_count(), leaf.first.triangles.len(), second.reversed)
        }
    }
}

/// Vertices of a leaf in stored order: centres, then the ring.
pub(super) fn vertices(
    leaf: &FanLeaf,
) -> (ArrayVec<u32, 2>, ArrayVec<u32, { MAX_LEAF_TRIANGLES + 1 }>) {
    let centres = leaf.fans().map(|fan| fan.centre).collect();
    let mut ring = leaf.first.ring.clone();
    if let Some(second) = &leaf.second {
        ring.extend(second.ring[1..].iter().copied());
    }
    (centres, ring)
}

/// Links of all nodes; `leaves` in item order.
pub(super) fn links(topology: &Topology, leaves: &[FanLeaf]) -> Vec<u8> {
    let mut out = Vec::new();
    let (mut vertex, mut triangle) = (0u32, 0u32);
    for node in &topology.nodes {
        let tags: Vec<LeafShape> =
            node.leaves.iter().map(|&item| tag(&leaves[item as usize])).collect();
        let first = node.inner.first().copied().unwrap_or(0);
        out.extend(Links::write(first, node.inner.len(), vertex, triangle, &tags));
        vertex += tags.iter().map(|tag| tag.vertices() as u32).sum::<u32>();
        triangle += tags.iter().map(|tag| tag.triangles() as u32).sum::<u32>();
    }
    out
}

/// A bit for each item, least bit of a byte first.
pub(super) fn bits(items: impl Iterator<Item = bool>) -> Vec<u8> {
    let mut out = Vec::new();
    for (at, is_set) in items.enumerate() {
        if at % 8 == 0 {
            out.push(0);
        }
        if let Some(last) = out.last_mut() {
            *last |= u8::from(is_set) << (at % 8);
        }
    }
    out
}

/// Vertices of all leaves, in leaf order.
pub(super) fn fans(
    topology: &Topology,
    leaves: &[FanLeaf],
    grid: &OnGrid,
    single: bool,
) -> Vec<u8> {
    let mut out = Vec::new();
    let origin = DVec3::from(grid.origin.map(f64::from));
    for &item in &topology.leaf_order {
        let (centres, ring) = vertices(&leaves[item as usize]);
        let at = |v: u32| grid.positions[v as usize];
        let mut put = |x: f64, origin: f64| {
            if single {
                out.extend((x as f32).to_le_bytes());
            } else {
                // Exact: the vertex is on the grid.
                out.extend(((x - origin) as u16).to_le_bytes());
            }
        };
        for &centre in &centres {
            (0..3).for_each(|axis| put(at(centre)[axis], origin[axis]));
        }
        for axis in 0..3 {
            ring.iter().for_each(|&v| put(at(v)[axis], origin[axis]));
        }
    }
    out.extend(std::iter::repeat_n(0, if single { 2 * FAN_PADDING } else { FAN_PADDING }));
    out
}

/// Records of all nodes' boxes in shared frames.
pub(super) fn frames(nodes: &[NodeBoxes]) -> Vec<u8> {
    let mut out = Vec::with_capacity(nodes.len() * FRAME_BYTES);
    for node in nodes {
        for axis in 0..3 {
            out.extend(node.low[axis]);
            out.extend(node.high[axis].map(|high| 255 - high));
        }
        out.extend(node.matrix.as_flattened().iter().flat_map(|entry| entry.to_le_bytes()));
        out.extend(node.origin.iter().flat_map(|x| x.to_le_bytes()));
        out.extend(node.exponent.map(i8::cast_unsigned));
        out.push(0);
    }
    out
}

/// Records of all nodes' axis-aligned boxes.
pub(super) fn boxes(nodes: &[NodeBoxes], grid_origin: [i32; 3]) -> Vec<u8> {
    let mut out = Vec::with_capacity(nodes.len() * BOXES_BYTES);
    for node in nodes {
        for axis in 0..3 {
            out.extend(node.low[axis]);
            out.extend(node.high[axis]);
        }
        put_origin(&mut out, node, grid_origin);
        node.exponent.iter().for_each(|&e| put(&mut out, exp2(i32::from(e)) as f32));
    }
    out
}

fn put(out: &mut Vec<u8>, x: f32) {
    out.extend(x.to_le_bytes());
}

/// Exact: an integer of 24 bits.
fn put_origin(out: &mut Vec<u8>, node: &NodeBoxes, grid_origin: [i32; 3]) {
    node.origin.iter().zip(grid_origin).for_each(|(&x, o)| put(out, (i32::from(x) + o) as f32));
}
