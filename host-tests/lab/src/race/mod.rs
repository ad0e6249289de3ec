//! Engines against each other on the same queries, in one run and one thread.
//!
//! ```text
//! workload (which questions) ─┐
//! entrants (the engines) ─────┼─ timing (interleaved rounds) ─┐
//!   ┌───────────────────────────────────────────────────────────┘
//!   └─ agreement (with f64, with parry3d) ─ report (tables)
//!   parry, cwbvh, embree, fcpw, tree: one file each ─ engine (their interface)
//! child (programs in C++ and Python) ─ child_engine (embree, fcpw), pairs, hausdorff
//! pairs     (distance and overlap of two models)
//! hausdorff (Hausdorff distance of two meshes)
//! ```
//! A new engine is a file with an `Engine` and a line in `ENTRANTS`.
//!
//! Times are the processor's, the fastest of up to three rounds. Within a round every engine has
//! its turn at a workload, so that a busy machine hits all alike. Even so only ratios within one
//! run mean something.

mod agreement;
mod child;
mod child_engine;
mod cwbvh;
mod embree;
mod engine;
mod entrants;
mod fcpw;
pub mod hausdorff;
pub mod pairs;
mod parry;
mod report;
mod timing;
mod tree;
mod workload;

use std::path::Path;
use std::sync::LazyLock;

use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::Table;
use rayon::{ThreadPool, ThreadPoolBuilder};

pub use workload::Scale;

/// Lets every engine answer every workload on a mesh, and checks the answers.
///
/// # Errors
/// The file is no mesh, or an engine refused it or a query.
pub fn race(file: &Path, scale: Scale) -> Result<[Table; 2], String> {
    let subject = Subject::load_any(file)?;
    let mut blobs: Vec<Vec<u8>> = vec![Vec::new(); entrants::ENTRANTS.len()];
    let (mut built, missing) = timing::build_engines(&subject, &mut blobs);
    let measurements = timing::measure(&subject, scale, &mut built)?;
    Ok([report::engines(&subject, &built, missing), report::measurements(&measurements, scale)])
}

/// Does work on the only thread of a pool, so that what it gives to rayon takes one processor.
fn on_one_thread<T: Send>(work: impl FnOnce() -> Result<T, String> + Send) -> Result<T, String> {
    static POOL: LazyLock<Result<ThreadPool, String>> = LazyLock::new(|| {
        ThreadPoolBuilder::new().num_threads(1).build().map_err(|error| error.to_string())
    });
    POOL.as_ref().map_err(Clone::clone)?.install(work)
}
