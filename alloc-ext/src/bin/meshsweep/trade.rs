//! `meshsweep trade`: what each setting of a mesh promises, finds and costs.

mod choose;
mod measured;
mod table;

pub use choose::build;

use crate::args::TradeArgs;
use crate::failure::Failure;
use crate::mesh_file;
use crate::output::Output;
use measured::measured;

pub fn run(args: &TradeArgs) -> Result<(), Failure> {
    let loaded = mesh_file::load(&args.mesh, args.unit)?;
    let measured = measured(&args.mesh, &loaded, &args.at, args.points as usize)?;
    Output::stdout().finish(|out| match args.json {
        true => table::write_json(out, &measured),
        false => table::write(out, args, &loaded, &measured),
    })
}
