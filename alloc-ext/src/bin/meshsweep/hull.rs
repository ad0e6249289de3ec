//! `meshsweep hull`: an outer hull of a mesh, or a hull of a blob, as binary PLY.

mod progressive;
mod stored;
mod tight;
mod written;

pub use stored::enclosing;

use crate::args::HullArgs;
use crate::failure::Failure;
use crate::mesh_file;
use crate::output::{refuse_other_extension, refuse_same_file};
use meshsweep::load::is_named_as_mesh;
use meshsweep::tight::Goal;

pub fn run(args: &HullArgs) -> Result<(), Failure> {
    mesh_file::check_format(&[&args.input], &args.read)?;
    args.threads.start();
    let usage = |what: String| Err(Failure::Usage { what });
    refuse_other_extension(&args.output, "ply", "the hull is written as PLY")?;
    if let Some(slack) = args.of_mesh.slack {
        let refused = |error| Failure::build(&args.input, error);
        Goal::Slack(slack).check(args.of_mesh.margin.unwrap_or(0.0)).map_err(refused)?;
    }
    refuse_same_file(Some(&args.output), &[&args.input])?;
    let name = args.input.display();
    let is_blob = mesh_file::is_blob(&args.input);
    let is_mesh = !is_blob && is_named_as_mesh(&args.input);
    if let Some(level) = args.level {
        return if is_mesh {
            usage(format!(
                "{name}: is a mesh, and --level is for a blob; give --faces, or build a blob \
                 first: meshsweep build {name} --for hull -o BLOB"
            ))
        } else {
            stored::write_level(args, level)
        };
    }
    if let Some(faces) = args.tight {
        return if is_mesh {
            usage(format!("{name}: is a mesh, and --tight is for a blob; give --faces"))
        } else {
            stored::write_tight(args, faces)
        };
    }
    if is_blob {
        let of_mesh = &args.of_mesh;
        let is_of_mesh =
            of_mesh.faces.is_some() || of_mesh.void.is_some() || of_mesh.slack.is_some();
        return usage(if is_of_mesh {
            format!(
                "{name}: --faces, --void and --slack are for a mesh; choose a hull of a blob with \
                 --level or --tight"
            )
        } else {
            format!(
                "{name}: is a blob; choose one of its hulls with --level or --tight (meshsweep \
                 info lists them)"
            )
        });
    }
    let mesh = mesh_file::named(&args.input, &args.read)?;
    match args.progressive_option() {
        _ if args.of_mesh.progressive => progressive::run(args, &mesh),
        Some(option) => {
            usage(format!("{option} is for the progressive hull; give --progressive too"))
        }
        None => tight::run(args, &mesh),
    }
}
