//! `meshsweep info`: what a blob holds, for people and for machines.

use super::args::InfoArgs;
use super::describe::{self, LevelDistances};
use super::failure::Failure;
use super::output::Output;
use super::{blob_file, describe::distances};
use meshsweep_core::Model;
use meshsweep_core::blob::layout::{VERSION_MAJOR, VERSION_MINOR};
use meshsweep_core::geom::Aabb;
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

/// A box of the local frame in the mesh's unit: low and high corner.
fn box_in_input_units(model: &Model<'_>, local: &Aabb) -> [[f64; 3]; 2] {
    [local.min, local.max].map(|corner| (corner.as_dvec3() * model.scale()).to_array())
}

fn write_header(out: &mut dyn Write, model: &Model<'_>) -> io::Result<()> {
    let h = model.header();
    let [low, high] = box_in_input_units(model, &h.surface_box);
    let cut = if model.is_cut() { ", cut: finer levels are not there" } else { "" };
    writeln!(out, "  format {VERSION_MAJOR}, {} bytes{cut}", h.total_bytes)?;
    writeln!(
        out,
        "  {} surface triangles ({} in the input file), {} vertices, {} splits, {} cover nodes",
        h.surface_triangles, h.input_triangles, h.vertices, h.splits, h.nodes
    )?;
    writeln!(out, "  base hull: {} triangles, {} vertices", h.base_triangles, h.base_vertices)?;
    writeln!(out, "  surface box: {low:?} to {high:?}")
}

fn as_json(model: &Model<'_>) -> Value {
    let h = model.header();
    let capacities = model.capacities();
    let sections: Vec<Value> = model
        .sections()
        .map(|s| {
            json!({
                "name": s.kind.name(),
                "kind": s.kind as u32,
                "offset": s.offset,
                "bytes": s.bytes,
                "bytes_per_triangle": f64::from(s.bytes) / f64::from(describe::triangles(model)),
                "crc": format!("{:08x}", s.crc),
            })
        })
        .collect();
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
        "version": { "major": VERSION_MAJOR, "minor_known": VERSION_MINOR },
        "bytes": h.total_bytes,
        "header_bytes": h.header_bytes,
        "is_cut": model.is_cut(),
        "scale_exponent": h.scale_exponent,
        "vertex_format": describe::format_name(h.vertex_format),
        "vertices": h.vertices,
        "base_vertices": h.base_vertices,
        "base_triangles": h.base_triangles,
        "splits": h.splits,
        "ring_entries": h.rings,
        "cover_nodes": h.nodes,
        "surface_triangles": h.surface_triangles,
        "input_triangles": h.input_triangles,
        "surface_error": describe::surface_error(h),
        "surface_box": box_in_input_units(model, &h.surface_box),
        "hull_box": box_in_input_units(model, &h.hull_box),
        "capacities": {
            "queue": capacities.queue,
            "queue_bytes": describe::queue_bytes(model),
            "front_words": capacities.front_words,
            "front_bytes": describe::front_bytes(model),
            "dependency_depth": capacities.dependency_depth,
        },
        "sections": sections,
        "levels": levels,
    })
}
