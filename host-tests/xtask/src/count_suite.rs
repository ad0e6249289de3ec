//! The suite's questions on this machine: the blobs and the queries of the boards, counted by
//! callgrind. It collects between the observer's two calls, so placing and folding are no part.

use std::ffi::OsStr;

use crate::blobs::{self, Blob, Blocks};
use crate::host;
use crate::process;
use crate::steps::Steps;
use crate::valgrind::Valgrind;
use crate::workspace;

/// A kind of queries to a blob.
#[derive(Clone, Debug)]
pub struct Counted {
    /// The blob.
    pub blob: Blob,
    /// The question's name.
    pub kind: String,
    /// Queries that were asked.
    pub queries: u32,
    /// Instructions of the mean one.
    pub mean: f64,
}

/// The name of this machine's processor in tables: counts of other ones are not comparable.
pub const CPU: &str = "x86-64";

/// Counts all kinds of queries to all blobs, on all cores. Nothing, with a line that says so, where
/// nothing can be counted.
pub fn run(steps: &mut Steps) -> Vec<Counted> {
    some(steps, |_| true)
}

/// The same of some blobs.
pub fn some(steps: &mut Steps, is_wanted: impl Fn(Blob) -> bool) -> Vec<Counted> {
    if cfg!(not(target_arch = "x86_64")) {
        say!("── the suite on this machine\n   skipped: its counts are those of {CPU}");
        return Vec::new();
    }
    let Some(valgrind) = Valgrind::find() else { return Vec::new() };
    let counted = steps.run("the suite on this machine, counted", || {
        let program = host::counted()?.join("counted-suite");
        blobs::write()?;
        let blocks = Blocks::QUARTER.others.to_string();
        let of_blob = |blob: &Blob| {
            let folder = workspace::target().join("counted-suite").join(blob.name);
            let file = blob.file();
            let arguments = [OsStr::new(blob.image), file.as_os_str(), OsStr::new(&blocks)];
            let options = ["--collect-atstart=no".to_owned()];
            let (printed, totals) = valgrind.dumps(&folder, &options, &program, &arguments)?;
            parse(*blob, &printed, &totals)
        };
        let mut blobs = Blob::all();
        blobs.retain(|blob| is_wanted(*blob));
        let all = process::parallel(&blobs, of_blob);
        let each: Result<Vec<Vec<Counted>>, String> =
            all.into_iter().map(|(counted, _)| counted).collect();
        Ok(each?.concat())
    });
    counted.unwrap_or_default()
}

/// A line `KIND QUERIES` for each dump of callgrind.
fn parse(blob: Blob, printed: &str, totals: &[f64]) -> Result<Vec<Counted>, String> {
    let lines: Vec<&str> = printed.lines().collect();
    if lines.len() != totals.len() {
        return Err(format!("{}: {} kinds, {} dumps", blob.name, lines.len(), totals.len()));
    }
    let counted = lines.iter().zip(totals).map(|(line, total)| {
        let (kind, queries) = line.split_once(' ')?;
        let queries: u32 = queries.parse().ok()?;
        Some(Counted { blob, kind: kind.to_owned(), queries, mean: total / f64::from(queries) })
    });
    counted.collect::<Option<Vec<_>>>().ok_or_else(|| format!("not counts: {printed}"))
}
