//! The box tree: shape, memory, surface error, whether sides are defined.

use super::shape::Shape;
use meshsweep::bvh::half_widths;
use meshsweep::counted::Counted;
use meshsweep::number::AtMost;
use meshsweep_core::{Bvh, ScratchEntry};
use serde_json::{Value, json};
use std::io::{self, Write};

/// Bytes of scratch memory with which no query overflows.
pub fn scratch_bytes(tree: &Bvh<'_>) -> usize {
    tree.scratch_entries() * size_of::<ScratchEntry>()
}

/// How coordinates are stored.
pub(super) fn format_name(tree: &Bvh<'_>) -> &'static str {
    if tree.header().is_f32() { "f32" } else { "16-bit grid" }
}

/// The bounds of nodes' children, and of leaves' normals.
fn bounds(tree: &Bvh<'_>) -> Vec<&'static str> {
    [
        (tree.serves_distances(), "boxes in shared frames"),
        (tree.serves_segments(), "axis-aligned boxes"),
        (tree.serves_culling(), "normal cones"),
        (tree.serves_winding(), "moments"),
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
        AtMost(tree.surface_error()),
        format_name(tree)
    )?;
    if tree.serves_distances() {
        let [near, far] = half_widths(tree, diagonal);
        writeln!(
            out,
            "  half-width of an exact answer: about {near:.1e} near the surface, {far:.1e} one \
             diagonal of the mesh away"
        )?;
    }
    let sideless = sideless(tree);
    let closed = match (tree.is_closed(), tree.serves_winding()) {
        (true, false) if !tree.has_sides() => {
            "closed, but no triangle tells a side: every side is undecided; --for closest,winding \
             decides them"
        }
        (true, false) if sideless > 0 => {
            "closed: signed distance is that of the nearest surface; some triangles tell no side"
        }
        (true, false) => "closed: signed distance is that of the nearest surface",
        (true, true) => {
            "closed: sides are those of the nearest triangle where it tells one, else of the \
             winding number; parts that overlap are united"
        }
        (false, true) => "open: sides are those of the winding number",
        _ => "open: every side is undecided; --for closest,winding decides them",
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
    if sideless > 0 {
        writeln!(out, "  {} that tell no side", Counted(sideless, "triangle"))?;
    }
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
        "  scratch: {}, {} bytes of RAM: no query about a point or a segment can overflow it",
        Counted(h.stack_entries, "entry"),
        scratch_bytes(tree)
    )
}

/// Triangles that tell no side, of a tree whose others do.
fn sideless(tree: &Bvh<'_>) -> usize {
    (0..tree.triangle_count()).filter(|&triangle| tree.is_sideless(triangle)).count()
}

pub(super) fn as_json(tree: &Bvh<'_>, diagonal: f64) -> Value {
    let h = tree.header();
    let shape = Shape::of(tree);
    let [near, far] = half_widths(tree, diagonal);
    json!({
        "is_closed": tree.is_closed(),
        "has_sides": tree.has_sides(),
        "sideless_triangles": sideless(tree),
        "vertex_format": format_name(tree),
        "surface_error": tree.surface_error(),
        "half_width_near": near,
        "half_width_one_diagonal_away": far,
        "triangles": h.triangles,
        "triangles_without_area": shape.flat,
        "fans": shape.fans(),
        "triangles_per_fan": shape.triangles_per_fan(),
        "single_triangle_fans": shape.single_triangle_fans(),
        "fans_by_size": shape.fan_sizes,
        "leaves": h.leaves,
        "triangles_per_leaf": shape.triangles_per_leaf,
        "vertices": h.vertices,
        "nodes": h.nodes,
        "children_per_node": shape.children_per_node,
        "depth": shape.depth,
        "bounds": bounds(tree),
        "scratch_entries": h.stack_entries,
        "scratch_bytes": scratch_bytes(tree),
    })
}
