//! What a blob costs and guarantees, as tables for people. Lengths are in the mesh's unit.

mod hull;
mod length;
mod shape;
mod tight;
mod tree;
mod triboxes;

pub use hull::{LevelDistances, distances, format_name, front_bytes, queue_bytes, surface_error};
pub use length::{About, AtLeast, AtMost, Given, Percent};
pub use shape::Shape;
pub use tight::{as_json as tight_as_json, void as tight_void};
pub use tree::{bounds, half_widths, stack_bytes, tree_format_name, tree_surface_error};
pub use triboxes::as_json as triboxes_as_json;

use super::served;
use meshsweep_core::Model;
use meshsweep_core::blob::layout::SectionKind;
use meshsweep_core::geom::Aabb;
use std::io::{self, Write};

/// What bytes per triangle are divided by: the surface's triangles, or in a cut blob those of its
/// finest level.
pub fn triangles(model: &Model<'_>) -> u32 {
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
pub fn diagonal(model: &Model<'_>) -> f64 {
    let [low, high] = in_input_units(model, &model.header().surface_box);
    low.iter().zip(high).map(|(low, high)| (high - low).powi(2)).sum::<f64>().sqrt()
}

/// Which hierarchy a section belongs to.
fn hierarchy(kind: SectionKind) -> &'static str {
    if kind.is_hull() {
        "hull hierarchy"
    } else if kind.is_tree() {
        "box tree"
    } else {
        // One section each.
        kind.name()
    }
}

/// The same for machines.
pub fn hierarchy_key(kind: SectionKind) -> &'static str {
    match hierarchy(kind) {
        "hull hierarchy" => "hull",
        "box tree" => "tree",
        "tight hulls" => "tight_hulls",
        other => other,
    }
}

/// Sections with their bytes, those of each hierarchy together.
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

/// Everything that both `build` and `info` print of a blob.
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
