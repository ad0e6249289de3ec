//! The progressive hull of a closed mesh.

use super::written::{self, Of, Written};
use crate::args::HullArgs;
use crate::failure::Failure;
use crate::mesh_file;
use crate::output::Output;
use crate::progress::StageBars;
use meshsweep::builder::FACES;
use meshsweep::hull::{BuildOptions, hull_of, wires_note, wires_off_surface};
use meshsweep::mesh::write_ply;
use meshsweep::progress::Callback;
use std::path::Path;
use std::time::Instant;

pub fn run(args: &HullArgs, mesh: &Path) -> Result<(), Failure> {
    Output::probe(&args.output)?;
    let faces = args.of_mesh.faces.unwrap_or(FACES);
    let collapse = args.collapse.options();
    let options = BuildOptions {
        base_faces: faces as usize,
        priority: collapse.priority.unwrap_or_default(),
        conditions: collapse.conditions(),
        vertex_bits: args.of_mesh.vertex_bits.format(),
        ..BuildOptions::default()
    };
    let solid = mesh_file::load_solid(&args.input, options.vertex_bits, &args.read)?;
    let mut bars = StageBars::default();
    let progress = Callback::new(|stage, _| bars.show(stage));
    let started = Instant::now();
    let (hull, void, stuck) =
        hull_of(solid.input(), options.base_faces, &options, progress.watch())
            .map_err(|error| Failure::build(mesh, error))?;
    let time = started.elapsed();
    drop(bars);
    Output::file(&args.output)?.finish(|out| write_ply(&hull, out))?;
    let wires = wires_off_surface(&solid.mesh).map_err(|error| Failure::build(mesh, error))?;
    let written = Written {
        faces: hull.triangles.len(),
        void: Some(void),
        time: Some(time),
        notes: wires_note(wires).into_iter().chain(stuck.map(|stuck| stuck.why(faces))).collect(),
        ..Written::default()
    };
    written::report(args, &Of::Mesh(mesh, &solid), &[written], &[])
}
