//! `meshsweep build`: a mesh file in, a blob and a report out.

use super::args::{BuildArgs, StoredBits};
use super::failure::Failure;
use super::output::{Output, refuse_same_file};
use super::progress::Bar;
use super::solid::{self, Solid};
use super::{blob_file, describe};
use meshsweep_alloc::collapse::Stuck;
use meshsweep_alloc::hull::{self, BuildOptions, BuildReport};
use meshsweep_core::Model;
use meshsweep_core::blob::layout::VertexFormat;
use std::io::{self, Write};

pub fn run(args: &BuildArgs) -> Result<(), Failure> {
    refuse_same_file(&args.output, &[&args.mesh])?;
    Output::probe(&args.output)?;
    let options = BuildOptions {
        base_faces: args.base as usize,
        priority: args.collapse.priority(),
        conditions: args.collapse.conditions(),
        vertex_bits: args.vertex_bits.format(),
    };
    let solid = solid::load(&args.mesh, options.vertex_bits)?;
    let bar = Bar::new(solid.mesh.triangles.len(), options.base_faces);
    let built =
        hull::build(&solid.mesh, solid.moved, solid.input_triangles, &options, |progress| bar.show(progress))
            .map_err(|error| Failure::Build { file: args.mesh.clone(), error })?;
    drop(bar);
    Output::file(&args.output)?.finish(|out| out.write_all(&built.bytes))?;
    let model = blob_file::open(&args.output, &built.bytes)?;
    Output::stdout().finish(|out| write_report(out, args, &solid, &built.report, &model))
}

fn write_report(
    out: &mut dyn Write,
    args: &BuildArgs,
    solid: &Solid,
    report: &BuildReport,
    model: &Model<'_>,
) -> io::Result<()> {
    writeln!(out, "{}", args.mesh.display())?;
    writeln!(out, "  {}", solid.report)?;
    writeln!(out, "  volume {}", describe::Length(report.volume))?;
    if solid.moved > 0.0 {
        writeln!(out, "  vertices moved to the grid by up to {}", describe::Length(solid.moved))?;
    }
    writeln!(out, "{}", args.output.display())?;
    writeln!(out, "  base hull: {} faces", report.base_faces)?;
    if let Some(stuck) = report.stuck {
        writeln!(out, "  {}", why_stuck(args.base, &stuck))?;
    }
    if let Some(note) = other_format(args.vertex_bits, model.header().vertex_format) {
        writeln!(out, "  {note}")?;
    }
    describe::write_blob(out, model)?;
    writeln!(
        out,
        "seconds: read and repair {:.3}, collapse {:.3} ({} programs), sweep {:.3}, certify and check {:.3}",
        solid.time.as_secs_f64(),
        report.collapse_time.as_secs_f64(),
        report.programs,
        report.sweep_time.as_secs_f64(),
        report.certify_time.as_secs_f64()
    )
}

/// Why a hull has more faces than `wanted`.
pub fn why_stuck(wanted: u32, stuck: &Stuck) -> String {
    format!(
        "stopped before {wanted} faces, for no edge may collapse: {} by topology or valence, {} because no vertex is \
         outside all planes, {} by compactness or normals; the conditions can be relaxed",
        stuck.topology, stuck.no_vertex, stuck.shape
    )
}

/// Says so if the wanted format could not be had.
fn other_format(wanted: StoredBits, got: VertexFormat) -> Option<&'static str> {
    let wanted_format = match wanted {
        StoredBits::Sixteen => VertexFormat::Grid16,
        StoredBits::TwentyFour => VertexFormat::Grid24,
        StoredBits::Auto | StoredBits::ThirtyTwo => return None,
    };
    (got != wanted_format).then_some(
        "the mesh is too small or too far from its origin for the grid: coordinates are stored as f32",
    )
}
