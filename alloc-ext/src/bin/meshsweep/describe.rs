//! The cost and the guarantees of a blob, as tables for people and as JSON. Lengths are in the
//! mesh's unit.

pub mod hull;
mod shape;
pub mod tight;
pub mod tree;
mod triboxes;

use crate::number::{AtLeast, AtMost};
use crate::served;
use meshsweep::counted::Counted;
use meshsweep_core::Model;
use meshsweep_core::blob::layout::{SectionKind, VERSION_MAJOR, VERSION_MINOR};
use meshsweep_core::geom::Aabb;
use serde_json::{Value, json};
use std::io::{self, Write};

/// The number of triangles for bytes per triangle: those of the surface, or in a cut blob those of
/// the finest level.
fn triangles(model: &Model<'_>) -> u32 {
    let of_levels = || model.levels().last().map_or(0, |level| level.faces);
    let of_tree = || model.tree().map_or(0, |tree| tree.header().triangles);
    [model.header().surface_triangles, of_tree(), of_levels(), model.header().input_triangles]
        .into_iter()
        .find(|&n| n > 0)
        .unwrap_or(1)
}

/// A box of the local frame in the mesh's unit: low and high corner.
pub fn in_input_units(model: &Model<'_>, local: &Aabb) -> [[f64; 3]; 2] {
    [local.min, local.max].map(|corner| (corner.as_dvec3() * model.scale()).to_array())
}

/// The diagonal of the mesh's box, in its unit.
fn diagonal(model: &Model<'_>) -> f64 {
    let [low, high] = in_input_units(model, &model.header().surface_box);
    low.iter().zip(high).map(|(low, high)| (high - low).powi(2)).sum::<f64>().sqrt()
}

/// The structure that a section belongs to.
fn hierarchy(kind: SectionKind) -> &'static str {
    if kind.is_hull() {
        "hull hierarchy"
    } else if kind.is_tree() {
        "box tree"
    } else {
        // The other structures have one section each.
        kind.name()
    }
}

/// The same for machines.
fn hierarchy_key(kind: SectionKind) -> &'static str {
    match hierarchy(kind) {
        "hull hierarchy" => "hull",
        "box tree" => "tree",
        "tight hulls" => "tight_hulls",
        other => other,
    }
}

/// Sections with their bytes, structure by structure.
fn write_sections(out: &mut dyn Write, model: &Model<'_>) -> io::Result<()> {
    let triangles = f64::from(triangles(model));
    let mut line = |name: &str, bytes: usize| {
        writeln!(out, "  {name:<30} {bytes:>10} {:>12.2}", bytes as f64 / triangles)
    };
    let header = model.header().header_bytes as usize;
    line("header", header)?;
    let mut all = 0;
    for title in ["hull hierarchy", "box tree", "triboxes", "tight hulls"] {
        let of_kind = || model.sections().filter(|section| hierarchy(section.kind) == title);
        let bytes: usize = of_kind().map(|section| section.bytes as usize).sum();
        if bytes == 0 {
            continue;
        }
        line(title, bytes)?;
        for section in of_kind().filter(|section| section.kind.name() != title) {
            line(&format!("  {}", section.kind.name()), section.bytes as usize)?;
        }
        all += bytes;
    }
    line("padding", model.bytes().len() - header - all)?;
    line("total", model.bytes().len())
}

/// The tables that both `build` and `info` print.
pub fn write_blob(out: &mut dyn Write, model: &Model<'_>) -> io::Result<()> {
    writeln!(out, "  serves {}", served::listed(model))?;
    writeln!(out, "section                               bytes per triangle")?;
    write_sections(out, model)?;
    if model.has_hull() {
        hull::write(out, model)?;
    }
    if let Some(tree) = model.tree() {
        tree::write(out, &tree, diagonal(model))?;
    }
    if let Some(triboxes) = model.triboxes() {
        triboxes::write(out, &triboxes)?;
    }
    model.tight_hulls().map_or(Ok(()), |hulls| tight::write(out, &hulls))
}

/// Format, input and hull hierarchy, before the tables of `info`.
pub fn write_header(out: &mut dyn Write, model: &Model<'_>) -> io::Result<()> {
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

/// All that `info --json` prints.
pub fn as_json(model: &Model<'_>) -> Value {
    let h = model.header();
    let sections: Vec<Value> = model
        .sections()
        .map(|s| {
            json!({
                "name": s.kind.name(),
                "kind": s.kind as u32,
                "hierarchy": hierarchy_key(s.kind),
                "offset": s.offset,
                "bytes": s.bytes,
                "bytes_per_triangle": f64::from(s.bytes) / f64::from(triangles(model)),
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
        "hull": model.has_hull().then(|| hull::as_json(model, in_input_units(model, &h.hull_box))),
        "tree": model.tree().map(|tree| tree::as_json(&tree, diagonal(model))),
        "triboxes": model.triboxes().map(|triboxes| triboxes::as_json(&triboxes)),
        "tight_hulls": model.tight_hulls().map(|hulls| tight::as_json(&hulls)),
    })
}
