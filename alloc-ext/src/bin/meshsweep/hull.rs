//! `meshsweep hull`: an outer hull of a mesh, or a level of a blob, as binary PLY.

use super::args::HullArgs;
use super::blob_file;
use super::build::why_stuck;
use super::failure::Failure;
use super::output::{Output, refuse_same_file};
use super::progress::Bar;
use super::solid;
use meshsweep_alloc::emit::CutError;
use meshsweep_alloc::hull::{BuildOptions, hull_of};
use meshsweep_alloc::mesh::{Mesh, write_ply};
use meshsweep_core::Model;
use meshsweep_core::blob::layout::MAGIC;
use meshsweep_core::blob::{Level, VertIdx};
use meshsweep_core::refine::hull_faces;
use std::io::Read;
use std::path::Path;
use std::time::Instant;

/// Faces unless told otherwise: the base hull's of `build`.
const FACES: u32 = 200;

pub fn run(args: &HullArgs) -> Result<(), Failure> {
    let usage = |what: String| Err(Failure::Usage { what });
    if !args.output.extension().is_some_and(|e| e.eq_ignore_ascii_case("ply")) {
        return usage(format!(
            "{}: the hull is written as PLY; name an output that ends in .ply",
            args.output.display()
        ));
    }
    refuse_same_file(&args.output, &[&args.input])?;
    let is_blob = begins_with_magic(&args.input);
    match args.level {
        Some(level) => of_blob(args, level),
        None if is_blob && args.faces.is_some() => usage(format!(
            "{}: --faces is for a mesh; choose a hull of a blob with --level",
            args.input.display()
        )),
        None if is_blob => usage(format!(
            "{}: a blob holds several hulls; choose one with --level (meshsweep info lists them)",
            args.input.display()
        )),
        None => of_mesh(args, args.faces.unwrap_or(FACES)),
    }
}

/// A file that cannot be read is no blob here; whoever reads it next says why.
fn begins_with_magic(path: &Path) -> bool {
    let mut head = [0; MAGIC.len()];
    let read = std::fs::File::open(path).and_then(|mut file| file.read_exact(&mut head));
    read.is_ok() && head == MAGIC
}

fn of_mesh(args: &HullArgs, faces: u32) -> Result<(), Failure> {
    Output::probe(&args.output)?;
    let options = BuildOptions {
        base_faces: faces as usize,
        priority: args.collapse.priority(),
        conditions: args.collapse.conditions(),
        ..BuildOptions::default()
    };
    let solid = solid::load(&args.input, options.vertex_bits)?;
    let bar = Bar::new(solid.mesh.triangles.len(), options.base_faces);
    let started = Instant::now();
    let (hull, void, stuck) =
        hull_of(&solid.mesh, options.base_faces, &options, |progress| bar.show(progress))
            .map_err(|error| Failure::Build { file: args.input.clone(), error })?;
    let time = started.elapsed();
    drop(bar);
    write_hull(&args.output, &hull)?;
    Output::stdout().finish(|out| {
        if !solid.report.is_clean() {
            writeln!(out, "{}\n  {}", args.input.display(), solid.report)?;
        }
        writeln!(
            out,
            "{}: {} faces, {:.3} % void space, {:.3} s",
            args.output.display(),
            hull.triangles.len(),
            (void * 100.0).max(0.0),
            time.as_secs_f64()
        )?;
        stuck.map_or(Ok(()), |stuck| writeln!(out, "{}", why_stuck(faces, &stuck)))
    })
}

fn of_blob(args: &HullArgs, index: u32) -> Result<(), Failure> {
    let bytes = blob_file::read(&args.input)?;
    let model = blob_file::open(&args.input, &bytes)?;
    let levels = model.header().levels;
    let no_level =
        || Failure::Cut { file: args.input.clone(), error: CutError::NoLevel { wanted: index, levels } };
    let level = model.level(index).ok_or_else(no_level)?;
    let hull = level_mesh(&model, &level);
    write_hull(&args.output, &hull)?;
    Output::stdout().finish(|out| {
        writeln!(
            out,
            "{}: {} faces, {:.3} % void space, level {index} of 0 to {}",
            args.output.display(),
            hull.triangles.len(),
            f64::from(level.void_ratio) * 100.0,
            levels - 1
        )
    })
}

/// The hull of a level in the mesh's unit. The scale is a power of two, so its vertices are exactly those stored.
fn level_mesh(model: &Model<'_>, level: &Level) -> Mesh {
    let mut number = vec![None; model.header().vertices as usize];
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for face in hull_faces(model, level) {
        triangles.push(face.corners.map(|vertex: VertIdx| {
            *number[vertex.usize()].get_or_insert_with(|| {
                let local = model.position(vertex).unwrap_or_default().as_dvec3();
                positions.push((local * model.scale()).as_vec3().to_array());
                positions.len() as u32 - 1
            })
        }));
    }
    Mesh::new(positions, triangles)
}

fn write_hull(path: &Path, hull: &Mesh) -> Result<(), Failure> {
    Output::file(path)?.finish(|out| write_ply(hull, out))
}
