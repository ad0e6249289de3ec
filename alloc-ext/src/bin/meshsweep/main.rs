//! The `meshsweep` program: builds blobs, asks them, and exports hulls.
//!
//! | file | owns |
//! | --- | --- |
//! | `args` | the command line |
//! | `failure` | what can go wrong, each in one line, and the exit status |
//! | `mesh_file` | mesh files for commands that build no blob |
//! | `blob_file`, `served` | opening a blob, and which questions it serves |
//! | `queries` | points, segments and poses of arguments and files |
//! | `poses` | poses of a second mesh, as quaternions or as matrices |
//! | `ask` | one question about many queries, on several threads, answered as CSV |
//! | `output` | files that are complete or not there, and pipes that close early |
//! | `describe` | tables and JSON of sections, levels and memory |
//! | `mesh_report` | what commands say of a mesh that they read |
//! | `progress` | progress bars |
//! | `side`, `source` | the words for sides; what `--emit` writes |
//! | all others | one command each |
//!
//! A new question:
//! 1. its arguments in `args/asking.rs`, exported by `args/mod.rs`, where it is a variant of
//!    `Command`;
//! 2. the text below its options, a file in `args/help/`, named in `args/help.rs`;
//! 3. a file like `winding.rs` that makes an `ask::Question`, with a `mod` and an arm in `run`
//!    here;
//! 4. a row in `served.rs`: a test there fails without one.

mod args;
mod ask;
mod blob_file;
mod build;
mod clear;
mod clearance;
mod closest;
mod cull;
mod cut;
mod demo;
mod describe;
mod failure;
mod field;
mod hausdorff;
mod hull;
mod info;
mod mesh_file;
mod mesh_report;
mod nearest;
mod output;
mod overlap;
mod poses;
mod progress;
mod queries;
mod refine;
mod robot;
mod segment;
mod served;
mod side;
mod signed;
mod source;
mod trade;
mod tribox;
mod triboxes;
mod verify;
mod winding;
mod within;
mod worst;

use args::{Arguments, Command};
use failure::Failure;
use std::process::ExitCode;

fn main() -> ExitCode {
    match run(Arguments::of_the_program()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    match arguments.command {
        None => demo::run(),
        Some(Command::Build(args)) => build::run(&args),
        Some(Command::Info(args)) => info::run(&args),
        Some(Command::Closest(args)) => closest::run(&args),
        Some(Command::Within(args)) => within::run(&args),
        Some(Command::Nearest(args)) => nearest::run(&args),
        Some(Command::Signed(args)) => signed::run(&args),
        Some(Command::Winding(args)) => winding::run(&args),
        Some(Command::Overlap(args)) => overlap::run(&args),
        Some(Command::Clear(args)) => clear::run(&args),
        Some(Command::Clearance(args)) => clearance::run(&args),
        Some(Command::Hausdorff(args)) => hausdorff::run(&args),
        Some(Command::Cull(args)) => cull::run(&args),
        Some(Command::Field(args)) => field::run(&args),
        Some(Command::Segment(args)) => segment::run(&args),
        Some(Command::Hull(args)) => hull::run(&args),
        Some(Command::Refine(args)) => refine::run(&args),
        Some(Command::Cut(args)) => cut::run(&args),
        Some(Command::Tribox(args)) => tribox::run(&args),
        Some(Command::Robot(args)) => robot::run(&args),
        Some(Command::Verify(args)) => verify::run(&args),
        Some(Command::Trade(args)) => trade::run(&args),
        Some(Command::Worst(args)) => worst::run(&args),
    }
}
