//! `meshsweep field`: distances on a regular grid.

mod lattice;
mod npy;

use super::args::FieldArgs;
use super::counted::Counted;
use super::failure::Failure;
use super::output::{Output, refuse_same_file};
use super::progress::Bar;
use super::served::{self, Need};
use super::{blob_file, describe, threads};
use lattice::Lattice;
use meshsweep_core::Tree;
use meshsweep_core::query::tree::{Hint, TreeEntry, closest_point_from, signed_distance};
use meshsweep_core::query::{QueryError, Stop};
use std::io::{self, Write};
use std::sync::Mutex;
use std::time::Instant;

/// Samples that are computed before they are written: a bound of the memory, and enough for every thread.
const AT_ONCE: usize = 1 << 22;

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
    refuse_same_file(&args.output, &[&args.blob])?;
    let bytes = blob_file::read(&args.blob)?;
    let model = blob_file::open(&args.blob, &bytes)?;
    let tree = served::require_tree(&args.blob, &model, Need::Distances)?;
    if args.signed && !tree.header().is_closed() {
        return Err(Failure::NotClosed { file: args.blob.clone() });
    }
    let bounds = describe::in_input_units(&model, &model.header().surface_box);
    let lattice = Lattice::around(bounds, args.size, args.margin)
        .ok_or_else(|| Failure::GridTooLarge { file: args.blob.clone() })?;
    let output = Output::file(&args.output)?;
    let sampler = Sampler { tree: &tree, lattice, signed: args.signed, interval: args.interval };
    let [nx, ny, nz] = lattice.size;
    let threads = threads::count(args.threads, ny * nz);
    let bar = Bar::new(ny * nz, "sampling", "rows");
    let started = Instant::now();
    let mut refused = None;
    let written = output.finish(|out| {
        if is_npy {
            out.write_all(&npy::header(
                &[&[nz, ny, nx][..], if args.interval { &[2] } else { &[] }].concat(),
            ))?;
        }
        sampler.write(out, threads, &bar).inspect_err(|error| {
            refused = error.get_ref().and_then(|inner| inner.downcast_ref::<QueryError>()).copied();
        })
    });
    let time = started.elapsed();
    drop(bar);
    if let Some(error) = refused {
        return Err(Failure::Search { file: args.blob.clone(), error });
    }
    written?;
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

/// Asks for the values of rows of samples.
struct Sampler<'a> {
    tree: &'a Tree<'a>,
    lattice: Lattice,
    signed: bool,
    interval: bool,
}

impl Sampler<'_> {
    /// Numbers that a sample has.
    fn values(&self) -> usize {
        1 + usize::from(self.interval)
    }

    /// Computes and writes all samples, many rows at once.
    fn write(&self, out: &mut dyn Write, threads: usize, bar: &Bar) -> io::Result<()> {
        let [nx, ny, nz] = self.lattice.size;
        let row_values = nx * self.values();
        let rows_at_once = (AT_ONCE / nx).clamp(1, ny * nz);
        let mut values = vec![0f32; rows_at_once * row_values];
        for first in (0..ny * nz).step_by(rows_at_once) {
            let rows = rows_at_once.min(ny * nz - first);
            let part = &mut values[..rows * row_values];
            self.sample(first, part, threads, bar).map_err(io::Error::other)?;
            for value in part.iter() {
                out.write_all(&value.to_le_bytes())?;
            }
        }
        Ok(())
    }

    /// Computes the rows from `first` on. Threads take rows as they get done; a row's values do not depend on which thread takes it.
    fn sample(&self, first: usize, values: &mut [f32], threads: usize, bar: &Bar) -> Result<(), QueryError> {
        let row_values = self.lattice.size[0] * self.values();
        let rows = Mutex::new(values.chunks_mut(row_values).enumerate());
        let work = || -> Result<(), QueryError> {
            let mut stack = vec![TreeEntry::EMPTY; self.tree.header().stack_entries as usize];
            loop {
                // No thread can panic while it holds the lock.
                let Some((row, values)) = rows.lock().ok().and_then(|mut rows| rows.next()) else {
                    return Ok(());
                };
                self.row(first + row, values, &mut stack)?;
                bar.advance(1);
            }
        };
        std::thread::scope(|scope| {
            let others: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
            let mine = work();
            let join =
                |other: std::thread::ScopedJoinHandle<'_, _>| other.join().unwrap_or(Err(QueryError::Model));
            others.into_iter().map(join).fold(mine, Result::and)
        })
    }

    /// Row `row`: samples next to each other, so that each answer is a good start for the next.
    fn row(&self, row: usize, values: &mut [f32], stack: &mut [TreeEntry]) -> Result<(), QueryError> {
        let ny = self.lattice.size[1];
        let mut hint = Hint::NONE;
        for (i, slot) in values.chunks_mut(self.values()).enumerate() {
            let point = self.lattice.point([i, row % ny, row / ny]);
            let [lower, upper] = self.interval(point, stack, &mut hint)?;
            match slot {
                [low, high] => (*low, *high) = (lower, upper),
                [middle] => *middle = ((f64::from(lower) + f64::from(upper)) / 2.0) as f32,
                _ => {}
            }
        }
        Ok(())
    }

    fn interval(
        &self,
        point: [f32; 3],
        stack: &mut [TreeEntry],
        hint: &mut Hint,
    ) -> Result<[f32; 2], QueryError> {
        if self.signed {
            let answer = signed_distance(self.tree, point, &Stop::EXACT, stack)?;
            return Ok([answer.lower, answer.upper]);
        }
        let answer = closest_point_from(self.tree, point, &Stop::EXACT, stack, hint)?;
        Ok([answer.lower, answer.upper])
    }
}
