//! The cost and the guarantees of a blob, as tables for people and as JSON. Lengths are in the
//! mesh's unit.

mod curve;
pub mod hull;
mod sdf;
mod shape;
pub mod tight;
pub mod tree;
mod triboxes;

use crate::served;
use meshsweep::counted::Counted;
use meshsweep::number::{AtLeast, AtMost};
use meshsweep_core::internal::format::layout::{FLAG_CUT, VERSION_MAJOR};
use meshsweep_core::internal::num::exp2;
use meshsweep_core::{Blob, SectionKind};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The number of triangles for bytes per triangle: those of the surface, or in a cut blob those of
/// the finest level.
fn triangles(blob: &Blob<'_>) -> u32 {
    let of_levels =
        || blob.hull().ok().and_then(|hull| hull.levels().last()).map_or(0, |level| level.faces);
    let of_tree = || blob.bvh().map_or(0, |tree| tree.triangle_count());
    [blob.header().surface_triangles, of_tree(), of_levels(), blob.header().input_triangles]
        .into_iter()
        .find(|&n| n > 0)
        .unwrap_or(1)
}

/// What a blob is of, and the noun.
fn pieces(blob: &Blob<'_>) -> (u32, &'static str) {
    let curve = blob.curve().map(|curve| (curve.segment_count(), "segment"));
    curve.unwrap_or_else(|_| (triangles(blob), "triangle"))
}

/// A box of the local frame in the mesh's unit: low and high corner.
fn in_input_units(blob: &Blob<'_>, local: [[f32; 3]; 2]) -> [[f64; 3]; 2] {
    let scale = exp2(blob.header().scale_exponent);
    local.map(|corner| corner.map(|x| f64::from(x) * scale))
}

/// The box of the mesh, in its unit.
pub fn surface_box(blob: &Blob<'_>) -> [[f64; 3]; 2] {
    in_input_units(blob, blob.header().surface_box)
}

/// A box that contains the input, in its unit: that of the stored mesh, grown by the surface error.
fn input_box(blob: &Blob<'_>) -> [[f64; 3]; 2] {
    let header = blob.header();
    let of_header = f64::from(header.surface_error) * exp2(header.scale_exponent);
    let of_tree = blob.bvh().map_or(0.0, |tree| f64::from(tree.surface_error()));
    let error = of_header.max(of_tree);
    let [low, high] = surface_box(blob);
    if error == 0.0 {
        return [low, high];
    }
    [low.map(|x| (x - error).next_down()), high.map(|x| (x + error).next_up())]
}

/// Triangles of the file that the blob was built from; 0 of a curve.
pub fn input_triangles(blob: &Blob<'_>) -> u32 {
    blob.bvh().map_or(blob.header().input_triangles, |tree| tree.input_triangles())
}

/// The diagonal of the mesh's box, in its unit.
fn diagonal(blob: &Blob<'_>) -> f64 {
    let [low, high] = surface_box(blob);
    low.iter().zip(high).map(|(low, high)| (high - low).powi(2)).sum::<f64>().sqrt()
}

/// The structure that a section belongs to.
fn hierarchy(kind: SectionKind) -> &'static str {
    if kind.is_hull() {
        "hull hierarchy"
    } else if kind.is_bvh() {
        "box tree"
    } else if kind.is_deform() {
        "deformation"
    } else if kind.is_curve() {
        "curves"
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
        "distance field" => "sdf",
        other => other,
    }
}

/// The structures, in the order of the tables.
const TITLES: [&str; 7] = [
    "hull hierarchy",
    "box tree",
    "triboxes",
    "tight hulls",
    "curves",
    "deformation",
    "distance field",
];

/// Sections with their bytes, structure by structure.
fn write_sections(out: &mut dyn Write, blob: &Blob<'_>) -> io::Result<()> {
    let triangles = f64::from(pieces(blob).0);
    let mut line = |name: &str, bytes: usize| {
        writeln!(out, "  {name:<30} {bytes:>10} {:>12.2}", bytes as f64 / triangles)
    };
    let header = blob.header().header_bytes as usize;
    line("header", header)?;
    let mut all = 0;
    for title in TITLES {
        let of_kind = || blob.sections().filter(|section| hierarchy(section.kind) == title);
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
    line("padding", blob.bytes().len() - header - all)?;
    line("total", blob.bytes().len())
}

/// The tables that both `build` and `info` print.
pub fn write_blob(out: &mut dyn Write, blob: &Blob<'_>) -> io::Result<()> {
    writeln!(out, "  serves {}", served::listed(blob))?;
    writeln!(out, "section                               bytes per {}", pieces(blob).1)?;
    write_sections(out, blob)?;
    if let Ok(hull) = blob.hull() {
        hull::write(out, &hull)?;
    }
    if let Ok(hull) = blob.deformable_hull() {
        hull::write_deformation(out, &hull)?;
    }
    if let Ok(tree) = blob.bvh() {
        tree::write(out, &tree, diagonal(blob))?;
    }
    if let Ok(triboxes) = blob.triboxes() {
        triboxes::write(out, &triboxes)?;
    }
    if let Ok(curve) = blob.curve() {
        curve::write(out, &curve)?;
    }
    if let Ok(sdf) = blob.sdf() {
        sdf::write(out, &sdf)?;
    }
    blob.tight_hulls().map_or(Ok(()), |hulls| tight::write(out, &hulls))
}

/// Format, input and hull hierarchy, before the tables of `info`.
pub fn write_header(out: &mut dyn Write, blob: &Blob<'_>) -> io::Result<()> {
    let h = blob.header();
    let [low, high] = input_box(blob);
    let low = low.map(|x| AtLeast(x).to_string());
    let high = high.map(|x| AtMost(x).to_string());
    let cut = if h.flags & FLAG_CUT != 0 { ", cut: finer levels are not there" } else { "" };
    let input = Counted(input_triangles(blob), "triangle");
    writeln!(out, "  format {VERSION_MAJOR}, {} bytes{cut}", h.total_bytes)?;
    let of =
        if blob.curve().is_ok() { String::new() } else { format!("{input} in the input file; ") };
    writeln!(out, "  {of}box {} to {}", low.join(", "), high.join(", "))?;
    if blob.hull().is_ok() {
        writeln!(
            out,
            "  hull hierarchy of {}: {}, {}",
            Counted(h.surface_triangles, "triangle"),
            Counted(h.vertices, "vertex"),
            Counted(h.splits, "split")
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
pub fn as_json(blob: &Blob<'_>) -> Value {
    let h = blob.header();
    let (count, noun) = pieces(blob);
    let per_piece = format!("bytes_per_{noun}");
    let sections: Vec<Value> = blob
        .sections()
        .map(|s| {
            json!({
                "name": s.kind.name(),
                "kind": s.kind as u32,
                "hierarchy": hierarchy_key(s.kind),
                "offset": s.offset,
                "bytes": s.bytes,
                per_piece.as_str(): f64::from(s.bytes) / f64::from(count),
                "crc": format!("{:08x}", s.crc),
            })
        })
        .collect();
    json!({
        "version": { "major": VERSION_MAJOR, "minor_known": SectionKind::newest_minor() },
        "bytes": h.total_bytes,
        "header_bytes": h.header_bytes,
        "scale_exponent": h.scale_exponent,
        "input_triangles": h.input_triangles,
        "surface_box": surface_box(blob),
        "input_box": input_box(blob),
        "serves": served::questions(blob),
        "sections": sections,
        "hull": blob.hull().ok().map(|hull| hull::as_json(&hull, in_input_units(blob, h.hull_box))),
        "deformation": blob.deformable_hull().ok().map(|hull| hull::deformation_as_json(&hull)),
        "tree": blob.bvh().ok().map(|tree| tree::as_json(&tree, diagonal(blob))),
        "triboxes": blob.triboxes().ok().map(|triboxes| triboxes::as_json(&triboxes)),
        "curve": blob.curve().ok().map(|curve| curve::as_json(&curve)),
        "sdf": blob.sdf().ok().map(|sdf| sdf::as_json(&sdf)),
        "tight_hulls": blob.tight_hulls().ok().map(|hulls| tight::as_json(&hulls)),
    })
}
