//! The progressive hull of a closed mesh.

use crate::args::{FACES, HullArgs};
use crate::failure::Failure;
use crate::hull_report::{why_stuck, write_repairs, write_wires};
use crate::mesh_file;
use crate::number::Percent;
use crate::output::Output;
use crate::progress::Bar;
use meshsweep::counted::Counted;
use meshsweep::hull::{hull_of, wires_off_surface};
use meshsweep::mesh::write_ply;
use std::time::Instant;

pub fn run(args: &HullArgs) -> Result<(), Failure> {
    Output::probe(&args.output)?;
    let faces = args.faces.unwrap_or(FACES);
    let options = args.collapse.options(faces, args.vertex_bits);
    let solid = mesh_file::load_solid(&args.input, options.vertex_bits, args.unit, None)?;
    let from = solid.mesh.triangles.len();
    let bar = Bar::new(from.saturating_sub(options.base_faces), "collapsing", "faces");
    let started = Instant::now();
    let (hull, void, stuck) = hull_of(&solid.mesh, options.base_faces, &options, |progress| {
        bar.show(from.saturating_sub(progress.faces))
    })
    .map_err(|error| Failure::build(&args.input, error))?;
    let time = started.elapsed();
    drop(bar);
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
        write_wires(out, wires)?;
        stuck.map_or(Ok(()), |stuck| writeln!(out, "{}", why_stuck(faces, &stuck)))
    })
}
