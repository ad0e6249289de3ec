//! `meshsweep field`: distances on a regular grid.

mod lattice;
mod npy;
mod sampler;

use crate::args::FieldArgs;
use crate::ask::threads;
use crate::failure::Failure;
use crate::output::{Output, refuse_same_file};
use crate::progress::Bar;
use crate::{blob_file, describe, served};
use lattice::Lattice;
use meshsweep::counted::Counted;
use meshsweep::distances::has_sides;
use meshsweep_core::{BuildFor, QueryError};
use sampler::{NoSign, Sampler};
use std::io::{self, Write};
use std::path::Path;
use std::time::Instant;

/// A file of at least this many bytes is announced with its size before the work.
const LARGE: u64 = 1 << 30;

pub fn run(args: &FieldArgs) -> Result<(), Failure> {
    let extension = args.output.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let is_npy = match extension.as_deref() {
        Some("npy") => true,
        Some("f32" | "raw") => false,
        _ => {
            let file = args.output.display();
            return Err(Failure::Usage {
                what: format!("{file}: name an output that ends in .f32, .raw or .npy"),
            });
        }
    };
    refuse_same_file(Some(&args.output), &[&args.blob])?;
    let blob = blob_file::open(&args.blob)?;
    let tree = served::require_tree(&args.blob, &blob, BuildFor::Closest)?;
    if args.signed && !has_sides(&tree) {
        let instead = "build it --for winding, or leave out --signed";
        return Err(Failure::NotClosed { file: args.blob.clone(), instead });
    }
    let bounds = describe::surface_box(&blob);
    let lattice = Lattice::around(bounds, args.size, args.margin)
        .ok_or_else(|| Failure::GridTooLarge { file: args.blob.clone() })?;
    let output = Output::file(&args.output)?;
    let sampler = Sampler { tree: &tree, lattice, signed: args.signed, interval: args.interval };
    let [nx, ny, nz] = lattice.size;
    let bytes =
        4 * sampler.values() as u64 * lattice.size.iter().map(|&n| n as u64).product::<u64>();
    if bytes > LARGE {
        // A closed standard error does not withhold the field.
        let (file, gibibytes) = (args.output.display(), bytes as f64 / LARGE as f64);
        let _ = writeln!(io::stderr(), "{file}: will be a file of {gibibytes:.1} GiB");
    }
    output.require_size(bytes)?;
    let threads = threads::count(args.threads.wanted, ny * nz);
    let bar = Bar::new(ny * nz, "sampling", "rows");
    let started = Instant::now();
    let mut refused = None;
    let mut no_sign = NoSign::default();
    let written = output.finish(|out| {
        if is_npy {
            out.write_all(&npy::header(
                &[&[nz, ny, nx][..], if args.interval { &[2] } else { &[] }].concat(),
            ))?;
        }
        no_sign = sampler.write(out, threads, &bar).inspect_err(|error| {
            refused = error.get_ref().and_then(|inner| inner.downcast_ref::<QueryError>()).copied();
        })?;
        Ok(())
    });
    let time = started.elapsed();
    drop(bar);
    if let Some(error) = refused {
        return Err(Failure::Search { file: args.blob.clone(), error });
    }
    written?;
    note(&args.output, &no_sign, nx * ny * nz, args.interval);
    Output::stdout().finish(|out| {
        let samples = nx * ny * nz;
        writeln!(
            out,
            "{}: {} of f32, shape ({nz}, {ny}, {nx}{}), x fastest",
            args.output.display(),
            Counted(samples * sampler.values(), "value"),
            if args.interval { ", 2" } else { "" }
        )?;
        writeln!(out, "origin {:?}", lattice.origin)?;
        writeln!(out, "step {:?}", lattice.step)?;
        let nanoseconds = time.as_nanos() as f64 / samples as f64;
        writeln!(
            out,
            "{:.3} s, {nanoseconds:.1} ns per sample with {}",
            time.as_secs_f64(),
            Counted(threads, "thread")
        )
    })
}

/// Says on the standard error how many of the `samples` have no sign, and why.
fn note(file: &Path, no_sign: &NoSign, samples: usize, interval: bool) {
    if no_sign.count() > 0 {
        let instead = if interval {
            "their interval reaches from -upper to upper"
        } else {
            "their value is NaN"
        };
        // A closed standard error is no failure.
        let _ = writeln!(
            io::stderr(),
            "{}: {} of {} have no sign: {no_sign}; {instead}",
            file.display(),
            no_sign.count(),
            Counted(samples, "sample")
        );
    }
}
