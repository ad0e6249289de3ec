//! Arguments of all commands that read a mesh, and of those that work on several threads.

use super::values::{threads, unit};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use meshsweep::mesh::{FORMATS, Unit};
use std::num::NonZeroUsize;

/// How a mesh is read.
#[derive(Debug, Args)]
pub struct ReadArgs {
    /// Format of a mesh from the standard input, which is named '-'
    ///
    /// One of stl, ply, obj, off, glb, gltf, 3mf and dae; for build, verify and trade also csv.
    #[arg(
        long,
        value_name = "FORMAT",
        value_parser = PossibleValuesParser::new(FORMATS.into_iter().chain([CURVE])).map(format),
        hide_possible_values = true
    )]
    pub format: Option<&'static str>,
    /// Unit of the mesh: um, mm, cm, m, in or ft
    ///
    /// glTF, which is in metres, 3MF and COLLADA are scaled to it. Of other files it is the unit of
    /// their numbers.
    #[arg(long, value_name = "UNIT", value_parser = unit)]
    pub unit: Option<Unit>,
}

/// Points of curves, a format of build, verify and trade.
const CURVE: &str = "csv";

fn format(name: String) -> &'static str {
    FORMATS.into_iter().find(|&format| format == name).unwrap_or(CURVE)
}

/// Threads of a command.
#[derive(Debug, Args)]
pub struct ThreadArgs {
    /// Threads [default: one for each processor]; nothing that is written depends on it
    #[arg(id = "threads", long = "threads", value_name = "N", value_parser = threads)]
    pub wanted: Option<NonZeroUsize>,
}

impl ThreadArgs {
    /// Has the library work on so many threads. To be called once, before the work.
    pub fn start(&self) {
        if let Some(wanted) = self.wanted {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(wanted.get());
            // It fails if the library works already. The threads change times alone.
            let _ = pool.build_global();
        }
    }
}
