//! The progressive hull of a closed mesh.

use crate::args::HullArgs;
use crate::failure::Failure;
use crate::mesh_file;
use crate::mesh_report::write_repairs;
use crate::output::Output;
use crate::progress::StageBars;
use meshsweep::builder::FACES;
use meshsweep::counted::Counted;
use meshsweep::hull::{BuildOptions, hull_of, wires_note, wires_off_surface};
use meshsweep::mesh::write_ply;
use meshsweep::number::Percent;
use meshsweep::progress::Callback;
use std::time::Instant;

pub fn run(args: &HullArgs) -> Result<(), Failure> {
    Output::probe(&args.output)?;
    let faces = args.faces.unwrap_or(FACES);
    let options = BuildOptions {
        base_faces: faces as usize,
        conditions: args.collapse.options().conditions(),
        vertex_bits: args.vertex_bits.format(),
        ..BuildOptions::default()
    };
    let solid = mesh_file::load_solid(&args.input, options.vertex_bits, args.unit)?;
    let mut bars = StageBars::default();
    let progress = Callback::new(|stage, _| bars.show(stage));
    let started = Instant::now();
    let (hull, void, stuck) =
        hull_of(solid.input(), options.base_faces, &options, progress.watch())
            .map_err(|error| Failure::build(&args.input, error))?;
    let time = started.elapsed();
    drop(bars);
    Output::file(&args.output)?.finish(|out| write_ply(&hull, out))?;
    let wires =
        wires_off_surface(&solid.mesh).map_err(|error| Failure::build(&args.input, error))?;
    Output::stdout().finish(|out| {
        write_repairs(out, &args.input, &solid)?;
        writeln!(
            out,
            "{}: {}, {} % void space, {:.3} s",
            args.output.display(),
            Counted(hull.triangles.len(), "face"),
            Percent((void * 100.0).max(0.0)),
            time.as_secs_f64()
        )?;
        wires_note(wires).map_or(Ok(()), |note| writeln!(out, "  {note}"))?;
        stuck.map_or(Ok(()), |stuck| writeln!(out, "{}", stuck.why(faces)))
    })
}
