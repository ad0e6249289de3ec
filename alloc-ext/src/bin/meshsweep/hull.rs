//! `meshsweep hull`: an outer hull of a mesh, or a level of a blob, as binary PLY.

use super::args::{HullArgs, slack_within_margin};
use super::blob_file;
use super::build::{FACES, why_stuck, write_wires};
use super::counted::Counted;
use super::describe::{AtMost, Percent, tight_void};
use super::failure::Failure;
use super::output::{Output, refuse_same_file};
use super::progress::Bar;
use super::{mesh_file, served};
use meshsweep::emit::CutError;
use meshsweep::hull::{BuildOptions, hull_of, wires_off_surface};
use meshsweep::mesh::{Mesh, write_ply};
use meshsweep::tight::hull_mesh as tight_mesh;
use meshsweep_core::Model;
use meshsweep_core::blob::{Level, VertIdx};
use meshsweep_core::refine::hull_faces;
use std::path::Path;
use std::time::Instant;

mod tight;
mod unmet;

pub use tight::{WrapBars, widened, write_margin, write_start};
pub use unmet::{Tightness, Unmet, require_met};

pub fn run(args: &HullArgs) -> Result<(), Failure> {
    let usage = |what: String| Err(Failure::Usage { what });
    if !args.output.extension().is_some_and(|e| e.eq_ignore_ascii_case("ply")) {
        return usage(format!(
            "{}: the hull is written as PLY; name an output that ends in .ply",
            args.output.display()
        ));
    }
    if let Some(what) = slack_within_margin(args.slack, args.margin) {
        return usage(what);
    }
    refuse_same_file(&args.output, &[&args.input])?;
    let is_blob = mesh_file::is_blob(&args.input);
    let named_as_mesh = args.input.extension().and_then(|e| e.to_str()).is_some_and(|extension| {
        ["stl", "ply", "obj"].into_iter().any(|mesh| mesh.eq_ignore_ascii_case(extension))
    });
    match args.level {
        Some(_) if named_as_mesh && !is_blob => usage(format!(
            "{0}: is a mesh, and --level is for a blob; give --faces, or build a blob first: meshsweep build {0} --for hull \
             -o BLOB",
            args.input.display()
        )),
        Some(level) => of_blob(args, level),
        None if args.tight.is_some() && !is_blob && named_as_mesh => usage(format!(
            "{}: is a mesh, and --tight is for a blob; give --faces",
            args.input.display()
        )),
        None if is_blob || args.tight.is_some() => blob_without_level(args),
        None if args.progressive => of_mesh(args, args.faces.unwrap_or(FACES)),
        None => match args.progressive_option() {
            Some(option) => {
                usage(format!("{option} is for the progressive hull; give --progressive too"))
            }
            None => tight::run(args, args.faces.unwrap_or(FACES)),
        },
    }
}

/// A tight hull of a blob, or why none.
fn blob_without_level(args: &HullArgs) -> Result<(), Failure> {
    let usage =
        |what: &str| Err(Failure::Usage { what: format!("{}: {what}", args.input.display()) });
    if let Some(faces) = args.tight {
        return tight_of_blob(args, faces);
    }
    if args.faces.is_some() || args.void.is_some() || args.slack.is_some() {
        return usage(
            "--faces, --void and --slack are for a mesh; choose a hull of a blob with --level or --tight",
        );
    }
    usage(
        "a blob holds several hulls; choose one with --level or --tight (meshsweep info lists them)",
    )
}

fn tight_of_blob(args: &HullArgs, faces: u32) -> Result<(), Failure> {
    let bytes = blob_file::read(&args.input)?;
    let model = blob_file::open(&args.input, &bytes)?;
    let hull = served::require_tight(&args.input, &model, faces)?;
    write_hull(&args.output, &tight_mesh(&hull))?;
    Output::stdout().finish(|out| {
        let record = hull.record();
        write!(out, "{}: {}, ", args.output.display(), Counted(record.faces, "face"))?;
        if let Some(void) = tight_void(record) {
            write!(out, "{} % void space, ", Percent(f64::from(void) * 100.0))?;
        }
        writeln!(out, "at most {} from the mesh", AtMost(record.slack))
    })
}

fn of_mesh(args: &HullArgs, faces: u32) -> Result<(), Failure> {
    Output::probe(&args.output)?;
    let options = BuildOptions {
        base_faces: faces as usize,
        priority: args.collapse.priority(),
        conditions: args.collapse.conditions(),
        vertex_bits: args.vertex_bits.format(),
    };
    let solid = mesh_file::load_solid(&args.input, options.vertex_bits, None)?;
    let from = solid.mesh.triangles.len();
    let bar = Bar::new(from.saturating_sub(options.base_faces), "collapsing", "faces");
    let started = Instant::now();
    let (hull, void, stuck) = hull_of(&solid.mesh, options.base_faces, &options, |progress| {
        bar.show(from.saturating_sub(progress.faces))
    })
    .map_err(|error| Failure::Build { file: args.input.clone(), error })?;
    let time = started.elapsed();
    drop(bar);
    write_hull(&args.output, &hull)?;
    Output::stdout().finish(|out| {
        if !solid.report.is_clean() {
            writeln!(out, "{}\n  {}", args.input.display(), solid.report)?;
        }
        if solid.moved > 0.0 {
            writeln!(
                out,
                "vertices of the mesh moved to the grid by up to {}",
                AtMost(solid.moved)
            )?;
        }
        writeln!(
            out,
            "{}: {}, {} % void space, {:.3} s",
            args.output.display(),
            Counted(hull.triangles.len(), "face"),
            Percent((void * 100.0).max(0.0)),
            time.as_secs_f64()
        )?;
        write_wires(out, wires_off_surface(&solid.mesh))?;
        stuck.map_or(Ok(()), |stuck| writeln!(out, "{}", why_stuck(faces, &stuck)))
    })
}

fn of_blob(args: &HullArgs, index: u32) -> Result<(), Failure> {
    let bytes = blob_file::read(&args.input)?;
    let model = blob_file::open(&args.input, &bytes)?;
    served::require_hull(&args.input, &model)?;
    let levels = model.header().levels;
    let no_level = || Failure::Cut {
        file: args.input.clone(),
        error: CutError::NoLevel { wanted: index, levels },
    };
    let level = model.level(index).ok_or_else(no_level)?;
    let hull = level_mesh(&model, &level);
    write_hull(&args.output, &hull)?;
    Output::stdout().finish(|out| {
        writeln!(
            out,
            "{}: {}, {} % void space, level {index} of 0 to {}",
            args.output.display(),
            Counted(hull.triangles.len(), "face"),
            Percent(f64::from(level.void_ratio) * 100.0),
            levels - 1
        )
    })
}

/// The hull of a level in the mesh's unit. The scale is a power of two, so its vertices are exactly
/// those stored.
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
