//! `meshsweep info`: what a blob holds, for people and for machines.

use super::args::InfoArgs;
use super::counted::Counted;
use super::describe::{self, AtLeast, AtMost, LevelDistances, Shape, distances, in_input_units};
use super::failure::Failure;
use super::output::Output;
use super::{blob_file, served};
use meshsweep_core::blob::layout::{VERSION_MAJOR, VERSION_MINOR};
use meshsweep_core::{Bvh, Model};
use serde_json::{Value, json};
use std::io::{self, Write};

pub fn run(args: &InfoArgs) -> Result<(), Failure> {
    let bytes = blob_file::read(&args.blob)?;
    let model = blob_file::open(&args.blob, &bytes)?;
    Output::stdout().finish(|out| {
        if args.json {
            serde_json::to_writer_pretty(&mut *out, &as_json(&model))?;
            writeln!(out)
        } else {
            writeln!(out, "{}", args.blob.display())?;
            write_header(out, &model)?;
            describe::write_blob(out, &model)
        }
    })
}

fn write_header(out: &mut dyn Write, model: &Model<'_>) -> io::Result<()> {
    let h = model.header();
    let [low, high] = in_input_units(model, &h.surface_box);
    let low = low.map(|x| AtLeast(x).to_string());
    let high = high.map(|x| AtMost(x).to_string());
    let cut = if model.is_cut() { ", cut: finer levels are not there" } else { "" };
    let input =
        Counted(model.tree().map_or(h.input_triangles, |tree| tree.input_triangles()), "triangle");
    writeln!(out, "  format {VERSION_MAJOR}, {} bytes{cut}", h.total_bytes)?;
    writeln!(out, "  {input} in the input file; box {} to {}", low.join(", "), high.join(", "))?;
    if model.has_hull() {
        writeln!(
            out,
            "  hull hierarchy of {}: {}, {}, {}",
            Counted(h.surface_triangles, "triangle"),
            Counted(h.vertices, "vertex"),
            Counted(h.splits, "split"),
            Counted(h.nodes, "cover node")
        )?;
        writeln!(
            out,
            "  base hull: {}, {}",
            Counted(h.base_triangles, "triangle"),
            Counted(h.base_vertices, "vertex")
        )?;
    }
    Ok(())
}

fn as_json(model: &Model<'_>) -> Value {
    let h = model.header();
    let sections: Vec<Value> = model
        .sections()
        .map(|s| {
            json!({
                "name": s.kind.name(),
                "kind": s.kind as u32,
                "hierarchy": describe::hierarchy_key(s.kind),
                "offset": s.offset,
                "bytes": s.bytes,
                "bytes_per_triangle": f64::from(s.bytes) / f64::from(describe::triangles(model)),
                "crc": format!("{:08x}", s.crc),
            })
        })
        .collect();
    json!({
        "version": { "major": VERSION_MAJOR, "minor_known": VERSION_MINOR },
        "bytes": h.total_bytes,
        "header_bytes": h.header_bytes,
        "scale_exponent": h.scale_exponent,
        "input_triangles": h.input_triangles,
        "surface_box": in_input_units(model, &h.surface_box),
        "serves": served::questions(model),
        "sections": sections,
        "hull": model.has_hull().then(|| hull_as_json(model)),
        "tree": model.tree().map(|tree| tree_as_json(&tree, describe::diagonal(model))),
        "triboxes": model.triboxes().map(|triboxes| describe::triboxes_as_json(&triboxes)),
        "tight_hulls": model.tight_hulls().map(|hulls| describe::tight_as_json(&hulls)),
    })
}

fn hull_as_json(model: &Model<'_>) -> Value {
    let h = model.header();
    let capacities = model.capacities();
    let levels: Vec<Value> = model
        .levels()
        .map(|level| {
            let LevelDistances { cover_to_mesh, mesh_to_cover } = distances(h, &level);
            json!({
                "faces": level.faces,
                "splits": level.splits,
                "nodes": level.nodes,
                "void_ratio": level.void_ratio,
                "cover_to_mesh": cover_to_mesh,
                "mesh_to_cover": mesh_to_cover,
            })
        })
        .collect();
    json!({
        "is_cut": model.is_cut(),
        "vertex_format": describe::format_name(h.vertex_format),
        "surface_error": describe::surface_error(h),
        "vertices": h.vertices,
        "base_vertices": h.base_vertices,
        "base_triangles": h.base_triangles,
        "splits": h.splits,
        "ring_entries": h.rings,
        "cover_nodes": h.nodes,
        "surface_triangles": h.surface_triangles,
        "hull_box": in_input_units(model, &h.hull_box),
        "capacities": {
            "queue": capacities.queue,
            "queue_bytes": describe::queue_bytes(model),
            "front_words": capacities.front_words,
            "front_bytes": describe::front_bytes(model),
            "dependency_depth": capacities.dependency_depth,
        },
        "levels": levels,
    })
}

fn tree_as_json(tree: &Bvh<'_>, diagonal: f64) -> Value {
    let h = tree.header();
    let shape = Shape::of(tree);
    let [near, far] = describe::half_widths(tree, diagonal);
    json!({
        "is_closed": h.is_closed(),
        "vertex_format": describe::tree_format_name(tree),
        "surface_error": describe::tree_surface_error(tree),
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
        "bounds": describe::bounds(tree),
        "stack_entries": h.stack_entries,
        "stack_bytes": describe::stack_bytes(tree),
    })
}
