//! The box tree: shape, memory, surface error, whether sides are defined.

use super::AtMost;
use super::shape::Shape;
use crate::counted::Counted;
use meshsweep_core::Bvh;
use meshsweep_core::num::tolerance::{TREE_FAN, TREE_RELATIVE, TREE_WEAK, U32};
use meshsweep_core::num::{exp2, up_to_f32};
use meshsweep_core::query::tree::ScratchEntry;
use std::io::{self, Write};

/// Bytes of a stack with which no query overflows.
pub fn stack_bytes(tree: &Bvh<'_>) -> usize {
    tree.header().stack_entries as usize * size_of::<ScratchEntry>()
}

/// Distance between the stored surface and the file's, rounded up, in the mesh's unit.
pub fn tree_surface_error(tree: &Bvh<'_>) -> f32 {
    up_to_f32(f64::from(tree.header().surface_error) * exp2(tree.scale_exponent()))
}

/// About what an exact answer's half-width is, in the mesh's unit: next to the surface, and one
/// diagonal of the mesh away (`core/docs/rounding.md` §8). Wider where slivers are near.
pub fn half_widths(tree: &Bvh<'_>, diagonal: f64) -> [f64; 2] {
    let h = tree.header();
    let unit = exp2(h.grid_exponent + tree.scale_exponent());
    let u = f64::from(U32);
    let near =
        f64::from(tree_surface_error(tree)) + f64::from(TREE_FAN) * u * f64::from(h.reach) * unit;
    // What is not weak is certified to that part of the square: a half of it of the distance, a
    // quarter at either end.
    let relative = f64::from(TREE_RELATIVE) * u + (1.0 - f64::from(TREE_WEAK)) / 4.0;
    [near, near + relative * diagonal]
}

/// How coordinates are stored.
pub fn tree_format_name(tree: &Bvh<'_>) -> &'static str {
    if tree.header().is_f32() { "f32" } else { "16-bit grid" }
}

/// What bounds the children of nodes, and the normals of leaves.
pub fn bounds(tree: &Bvh<'_>) -> Vec<&'static str> {
    [
        (tree.serves_distances(), "boxes in shared frames"),
        (tree.serves_segments(), "axis-aligned boxes"),
        (tree.serves_culling(), "normal cones"),
    ]
    .into_iter()
    .filter_map(|(is_there, name)| is_there.then_some(name))
    .collect()
}

pub(super) fn write(out: &mut dyn Write, tree: &Bvh<'_>, diagonal: f64) -> io::Result<()> {
    let h = tree.header();
    let shape = Shape::of(tree);
    writeln!(out, "box tree")?;
    writeln!(
        out,
        "  surface error {} (coordinates: {})",
        AtMost(tree_surface_error(tree)),
        tree_format_name(tree)
    )?;
    if tree.serves_distances() {
        let [near, far] = half_widths(tree, diagonal);
        writeln!(
            out,
            "  half-width of an exact answer: about {near:.1e} near the surface, {far:.1e} one diagonal of the mesh away"
        )?;
    }
    let closed = if h.is_closed() {
        "closed: signed distance is defined"
    } else {
        "open: signed distance is undefined"
    };
    writeln!(out, "  {closed}")?;
    writeln!(
        out,
        "  {} in {}: {:.2} each; {} of one triangle",
        Counted(h.triangles, "triangle"),
        Counted(shape.fans(), "fan"),
        shape.triangles_per_fan(),
        Counted(shape.single_triangle_fans(), "fan")
    )?;
    if shape.flat > 0 {
        writeln!(out, "  {} without area as stored", Counted(shape.flat, "triangle"))?;
    }
    writeln!(
        out,
        "  {} of one or two fans: {:.2} triangles each",
        Counted(h.leaves, "leaf"),
        shape.triangles_per_leaf
    )?;
    writeln!(
        out,
        "  {}: {:.2} children each, depth {}; {}",
        Counted(h.nodes, "node"),
        shape.children_per_node,
        shape.depth,
        bounds(tree).join(", ")
    )?;
    writeln!(
        out,
        "  stack: {}, {} bytes of RAM: no query can overflow it",
        Counted(h.stack_entries, "entry"),
        stack_bytes(tree)
    )
}
