//! What a blob costs and guarantees, as tables for people. Lengths are in the mesh's unit.

use meshsweep_core::blob::layout::VertexFormat;
use meshsweep_core::blob::{Header, Level};
use meshsweep_core::num::{exp2, up_to_f32};
use meshsweep_core::{Model, QueueEntry};
use std::fmt;
use std::io::{self, Write};

/// Bytes of one word of a front's bit set.
const WORD: usize = size_of::<u32>();

/// Bytes of section data and of the blob per triangle are over this many triangles: the surface's, or in a cut blob
/// those of its finest level.
pub fn triangles(model: &Model<'_>) -> u32 {
    match model.header().surface_triangles {
        0 => model.levels().last().map_or(1, |level| level.faces.max(1)),
        triangles => triangles,
    }
}

/// Distance between the stored surface and the file's, rounded up, in the mesh's unit.
pub fn surface_error(header: &Header) -> f32 {
    up_to_f32(f64::from(header.surface_error) * exp2(header.scale_exponent))
}

/// Certified distances of a level, in the mesh's unit and to the mesh as it was read.
#[derive(Clone, Copy, Debug)]
pub struct LevelDistances {
    /// No point of the level's covering triangles is farther than this from the mesh.
    pub cover_to_mesh: f32,
    /// No point of the mesh is farther than this from them.
    pub mesh_to_cover: f32,
}

pub fn distances(header: &Header, level: &Level) -> LevelDistances {
    // One rounding of the sum, so a bound stays one.
    let up = |local: f32| {
        let sum = (f64::from(local) + f64::from(header.surface_error)) * (1.0 + f64::EPSILON);
        up_to_f32(sum * exp2(header.scale_exponent))
    };
    LevelDistances { cover_to_mesh: up(level.hull_to_surface), mesh_to_cover: up(level.surface_to_hull) }
}

/// Bytes of a queue with which no query overflows.
pub fn queue_bytes(model: &Model<'_>) -> usize {
    model.capacities().queue * size_of::<QueueEntry>()
}

/// Bytes of both bit sets of a front that can perform every split.
pub fn front_bytes(model: &Model<'_>) -> usize {
    2 * model.capacities().front_words * WORD
}

/// How coordinates are stored.
pub fn format_name(format: VertexFormat) -> &'static str {
    match format {
        VertexFormat::F32 => "f32",
        VertexFormat::Grid16 => "16-bit grid",
        VertexFormat::Grid24 => "24-bit grid",
    }
}

/// A length for people: as it is in everyday sizes, else with an exponent.
pub struct Length<T>(pub T);

impl<T: Copy + Into<f64> + fmt::Display + fmt::LowerExp> fmt::Display for Length<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.into().abs();
        let text = if size == 0.0 || (1e-3..1e7).contains(&size) {
            format!("{}", self.0)
        } else {
            format!("{:e}", self.0)
        };
        f.pad(&text)
    }
}

/// Sections with their bytes.
pub fn write_sections(out: &mut dyn Write, model: &Model<'_>) -> io::Result<()> {
    let triangles = f64::from(triangles(model));
    let mut line = |name: &str, bytes: usize| {
        writeln!(out, "  {name:<22} {bytes:>10} {:>12.2}", bytes as f64 / triangles)
    };
    let header = model.header().header_bytes as usize;
    line("header", header)?;
    let mut sections = 0;
    for section in model.sections() {
        sections += section.bytes as usize;
        line(section.kind.name(), section.bytes as usize)?;
    }
    line("padding", model.bytes().len() - header - sections)?;
    line("total", model.bytes().len())
}

/// Working memory that makes overflow impossible.
pub fn write_memory(out: &mut dyn Write, model: &Model<'_>) -> io::Result<()> {
    let capacities = model.capacities();
    writeln!(
        out,
        "  queue                  {:>10} entries, {} bytes of RAM: no query on the cover tree can overflow it",
        capacities.queue,
        queue_bytes(model)
    )?;
    writeln!(
        out,
        "  front                  {:>10} words in each of 2 bit sets, {} bytes: every split can be performed",
        capacities.front_words,
        front_bytes(model)
    )?;
    writeln!(out, "  dependency depth       {:>10} splits in the longest chain", capacities.dependency_depth)
}

/// The level table.
pub fn write_levels(out: &mut dyn Write, model: &Model<'_>) -> io::Result<()> {
    writeln!(out, "  level      faces     splits      nodes     void %   cover to mesh   mesh to cover")?;
    for (index, level) in model.levels().enumerate() {
        let LevelDistances { cover_to_mesh, mesh_to_cover } = distances(model.header(), &level);
        writeln!(
            out,
            "  {index:>5} {:>10} {:>10} {:>10} {:>10.3} {:>15} {:>15}",
            level.faces,
            level.splits,
            level.nodes,
            f64::from(level.void_ratio) * 100.0,
            Length(cover_to_mesh),
            Length(mesh_to_cover)
        )?;
    }
    Ok(())
}

/// Everything that both `build` and `info` print of a blob.
pub fn write_blob(out: &mut dyn Write, model: &Model<'_>) -> io::Result<()> {
    let h = model.header();
    writeln!(out, "section                       bytes per triangle")?;
    write_sections(out, model)?;
    writeln!(out, "memory for queries")?;
    write_memory(out, model)?;
    writeln!(out, "levels, with certified distances of their covering triangles in the mesh's unit")?;
    write_levels(out, model)?;
    writeln!(
        out,
        "surface error {} (coordinates: {})",
        Length(surface_error(h)),
        format_name(h.vertex_format)
    )
}
