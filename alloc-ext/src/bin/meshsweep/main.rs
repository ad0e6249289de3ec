//! The `meshsweep` program: builds blobs, asks them, and exports hulls.
//!
//! | file | owns |
//! | --- | --- |
//! | `args` | the command line |
//! | `failure` | what can go wrong, each in one line, and the exit status |
//! | `solid` | from a mesh file to a closed manifold mesh |
//! | `blob_file` | reading and opening a blob |
//! | `queries`, `csv` | points and segments from files |
//! | `stop` | stop rules, the queue, how queries ended |
//! | `output` | files that are whole or not there, and pipes that close early |
//! | `describe` | tables of sections, levels and memory |
//! | `progress` | the bar |
//! | `build`, `info`, `closest`, `segment`, `hull`, `cut`, `demo` | one command each |

mod args;
mod blob_file;
mod build;
mod closest;
mod csv;
mod cut;
mod demo;
mod describe;
mod failure;
mod hull;
mod info;
mod output;
mod progress;
mod queries;
mod segment;
mod solid;
mod stop;

use args::{Arguments, Command};
use clap::Parser;
use failure::Failure;
use std::process::ExitCode;

fn main() -> ExitCode {
    match run(Arguments::parse()) {
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
        Some(Command::Segment(args)) => segment::run(&args),
        Some(Command::Hull(args)) => hull::run(&args),
        Some(Command::Cut(args)) => cut::run(&args),
    }
}
