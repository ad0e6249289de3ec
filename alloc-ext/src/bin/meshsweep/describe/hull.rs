//! The hull hierarchy: memory, levels, surface error.

use meshsweep::counted::Counted;
use meshsweep::number::{AtMost, Percent};
use meshsweep_core::internal::format::Header;
use meshsweep_core::internal::format::layout::VertexFormat;
use meshsweep_core::internal::num::{exp2, up_to_f32};
use meshsweep_core::{DeformableHull, Hull, HullLevel, MovedVertex, ScratchEntry};
use serde_json::{Value, json};
use std::io::{self, Write};

/// Distance between the stored surface and the file's, rounded up, in the mesh's unit.
fn surface_error(header: &Header) -> f32 {
    up_to_f32(f64::from(header.surface_error) * exp2(header.scale_exponent))
}

/// Certified distances of a level to the mesh as it was read, in its unit.
#[derive(Clone, Copy, Debug)]
struct LevelDistances {
    /// No point of the hull's triangles that stand for a part of the mesh is farther than this
    /// from the mesh.
    hull_to_mesh: f32,
    /// No point of the mesh is farther than this from them.
    mesh_to_hull: f32,
}

fn distances(header: &Header, level: &HullLevel) -> LevelDistances {
    // One rounding of the sum, so a bound stays one.
    let up = |local: f32| {
        let sum = (f64::from(local) + f64::from(header.surface_error)) * (1.0 + f64::EPSILON);
        up_to_f32(sum * exp2(header.scale_exponent))
    };
    LevelDistances {
        hull_to_mesh: up(level.hull_to_surface),
        mesh_to_hull: up(level.surface_to_hull),
    }
}

/// Bytes of so many scratch entries.
const fn entries_bytes(entries: usize) -> usize {
    entries * size_of::<ScratchEntry>()
}

/// Bytes of scratch that no query overflows.
fn scratch_bytes(hull: &Hull<'_>) -> usize {
    entries_bytes(hull.scratch_entries())
}

/// How coordinates are stored.
fn format_name(format: VertexFormat) -> &'static str {
    match format {
        VertexFormat::F32 => "f32",
        VertexFormat::Grid16 => "16-bit grid",
        VertexFormat::Grid24 => "24-bit grid",
    }
}

pub(super) fn write(out: &mut dyn Write, hull: &Hull<'_>) -> io::Result<()> {
    let h = hull.header();
    let enclosing =
        if hull.encloses() { "" } else { ", for sweeps only: its levels enclose nothing" };
    writeln!(out, "hull hierarchy{enclosing}")?;
    writeln!(
        out,
        "  surface error {} (coordinates: {})",
        AtMost(surface_error(h)),
        format_name(h.vertex_format)
    )?;
    write_memory(out, hull)?;
    write_levels(out, hull)
}

/// Working memory that makes overflow impossible.
fn write_memory(out: &mut dyn Write, hull: &Hull<'_>) -> io::Result<()> {
    writeln!(
        out,
        "  scratch: {}, {} bytes of RAM: no query can overflow it",
        Counted(hull.scratch_entries(), "entry"),
        scratch_bytes(hull)
    )?;
    writeln!(
        out,
        "  kept sweep: {}, {} bytes of RAM: no place of its point can overflow it",
        Counted(hull.sweep_entries(), "entry"),
        entries_bytes(hull.sweep_entries())
    )?;
    writeln!(
        out,
        "  refined hull: 16 bytes of RAM for each split that is performed, {} for all",
        16 * hull.split_count() as usize
    )?;
    writeln!(
        out,
        "  dependency depth: {} in the longest chain",
        Counted(hull.header().dependency_depth, "split")
    )
}

/// Void of a level, in percent.
fn void(hull: &Hull<'_>, level: &HullLevel) -> String {
    let percent = Percent(f64::from(level.void_ratio) * 100.0);
    if hull.encloses() { percent.to_string() } else { "-".to_owned() }
}

/// Memory of a hull that deforms, and its key frames.
pub(super) fn write_deformation(out: &mut dyn Write, hull: &DeformableHull<'_>) -> io::Result<()> {
    writeln!(out, "deformation")?;
    writeln!(
        out,
        "  moved hull: {} of {} bytes: {} bytes of RAM",
        Counted(hull.vertex_records(), "vertex record"),
        size_of::<MovedVertex>(),
        hull.vertex_records() * size_of::<MovedVertex>()
    )?;
    match hull.frames() {
        1 => writeln!(out, "  no key frames"),
        frames => writeln!(out, "  key frames: 0 to {}", frames - 1),
    }
}

pub(super) fn deformation_as_json(hull: &DeformableHull<'_>) -> Value {
    json!({
        "frames": hull.frames(),
        "input_vertices": hull.input_vertices(),
        "vertex_records": hull.vertex_records(),
        "vertex_record_bytes": hull.vertex_records() * size_of::<MovedVertex>(),
    })
}

/// The level table.
fn write_levels(out: &mut dyn Write, hull: &Hull<'_>) -> io::Result<()> {
    writeln!(out, "  levels, with certified distances")?;
    writeln!(out, "  level      faces     splits     void %    hull to mesh    mesh to hull")?;
    for (index, level) in hull.levels().enumerate() {
        let LevelDistances { hull_to_mesh, mesh_to_hull } = distances(hull.header(), &level);
        writeln!(
            out,
            "  {index:>5} {:>10} {:>10} {:>10} {:>15} {:>15}",
            level.faces,
            level.splits,
            void(hull, &level),
            AtMost(hull_to_mesh),
            AtMost(mesh_to_hull)
        )?;
    }
    Ok(())
}

pub(super) fn as_json(hull: &Hull<'_>, hull_box: [[f64; 3]; 2]) -> Value {
    let h = hull.header();
    let levels: Vec<Value> = hull
        .levels()
        .map(|level| {
            let LevelDistances { hull_to_mesh, mesh_to_hull } = distances(h, &level);
            json!({
                "faces": level.faces,
                "splits": level.splits,
                "void_ratio": hull.encloses().then_some(level.void_ratio),
                "hull_to_mesh": hull_to_mesh,
                "mesh_to_hull": mesh_to_hull,
            })
        })
        .collect();
    json!({
        "is_cut": hull.is_cut(),
        "encloses": hull.encloses(),
        "vertex_format": format_name(h.vertex_format),
        "surface_error": surface_error(h),
        "vertices": h.vertices,
        "base_vertices": h.base_vertices,
        "base_triangles": h.base_triangles,
        "splits": h.splits,
        "ring_entries": h.rings,
        "surface_triangles": h.surface_triangles,
        "hull_box": hull_box,
        "capacities": {
            "scratch_entries": hull.scratch_entries(),
            "scratch_bytes": scratch_bytes(hull),
            "dependency_depth": hull.header().dependency_depth,
            "kept_sweep": {
                "scratch_entries": hull.sweep_entries(),
                "scratch_bytes": entries_bytes(hull.sweep_entries()),
            },
        },
        "levels": levels,
    })
}
