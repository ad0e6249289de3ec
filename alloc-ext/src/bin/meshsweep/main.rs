//! The `meshsweep` program: builds blobs, asks them, and exports hulls.
//!
//! | file | owns |
//! | --- | --- |
//! | `args` | the command line |
//! | `failure` | what can go wrong, each in one line, and the exit status |
//! | `mesh_file` | from a mesh file to a clean mesh, closed if a hull is wanted |
//! | `blob_file`, `served` | reading and opening a blob; which questions it answers, and by which hierarchy |
//! | `queries`, `csv`, `threads` | points and segments of arguments and files; asking many on several threads |
//! | `stop` | stop rules, working memory, how queries ended |
//! | `output` | files that are whole or not there, and pipes that close early |
//! | `describe` | tables of sections, levels and memory |
//! | `progress` | the bar |
//! | `points` | questions about points that only the box tree answers: `within`, `nearest`, `signed` |
//! | `build`, `info`, `closest`, `field`, `segment`, `overlap`, `cull`, `hull`, `cut`, `tribox`, `demo` | one command each |

mod args;
mod ask;
mod blob_file;
mod build;
mod closest;
mod cull;
mod cut;
mod demo;
mod describe;
mod failure;
mod field;
mod hull;
mod hull_report;
mod info;
mod mesh_file;
mod nearest;
mod need;
mod number;
mod output;
mod overlap;
mod progress;
mod queries;
mod segment;
mod served;
mod signed;
mod tribox;
mod unmet;
mod within;

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
        Some(Command::Overlap(args)) => overlap::run(&args),
        Some(Command::Cull(args)) => cull::run(&args),
        Some(Command::Field(args)) => field::run(&args),
        Some(Command::Segment(args)) => segment::run(&args),
        Some(Command::Hull(args)) => hull::run(&args),
        Some(Command::Cut(args)) => cut::run(&args),
        Some(Command::Tribox(args)) => tribox::run(&args),
    }
}
