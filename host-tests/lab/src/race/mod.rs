//! Engines against each other on the same queries, in one run and one thread.
//!
//! ```text
//! workload (which questions) ─┐
//! engine (what each one is) ──┼─ timing (interleaved rounds) ─ agreement (with f64, with parry3d) ─ report (tables)
//!   scalar, parry, cwbvh,     └─ counted (what callgrind counts)
//!   tree, hull: one file each
//! ```
//! A new engine is a file with an [`Engine`](engine::Engine) and a line in
//! [`ENTRANTS`](engine::ENTRANTS).
//!
//! Times are the processor's, the fastest of three rounds; within a round every engine has its turn
//! at a workload, so that a busy machine hits all alike. Even so only ratios within one run mean
//! something.

mod agreement;
pub mod counted;
mod cwbvh;
pub mod engine;
mod hull;
mod parry;
mod report;
mod scalar;
mod timing;
mod tree;
mod workload;

use std::path::Path;

use meshsweep::mesh::require_closed_manifold;
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::Table;

pub use report::summary;
pub use timing::Lap;
pub use workload::{Scale, Workload};

/// What takes part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scope {
    /// How many queries.
    pub scale: Scale,
    /// The hull engine takes part on meshes of up to so many triangles: building a blob for it
    /// takes 0.04 ms a triangle.
    pub hull_triangles: usize,
}

/// One mesh's race.
#[derive(Clone, Debug)]
pub struct Race {
    /// The file's name without its extension.
    pub mesh: String,
    /// Triangles after repair.
    pub triangles: usize,
    /// Every engine on every workload that it answers.
    pub laps: Vec<Lap>,
    /// The same for people.
    pub tables: Vec<Table>,
}

/// Lets every engine answer every workload on a mesh, and checks the answers.
///
/// # Errors
/// The file is no mesh, or an engine refused it or a query.
pub fn race(file: &Path, scope: &Scope) -> Result<Race, String> {
    let subject = Subject::load_any(file)?;
    let mut blobs: Vec<Vec<u8>> = vec![Vec::new(); engine::ENTRANTS.len()];
    let mut lanes = timing::lanes(&subject, scope, &mut blobs)?;
    let laps = timing::laps(&subject, scope.scale, &mut lanes)?;
    let tables = vec![report::engines(&subject, &lanes), report::laps(&laps, scope.scale)];
    Ok(Race { mesh: subject.name.clone(), triangles: subject.mesh.triangles.len(), laps, tables })
}

fn is_closed(subject: &Subject) -> bool {
    require_closed_manifold(&subject.mesh).is_ok()
}

/// What the compiler was allowed to use.
fn machine() -> &'static str {
    if cfg!(all(target_arch = "x86_64", target_feature = "avx2", target_feature = "fma")) {
        "x86-64-v3 (AVX2, FMA)"
    } else if cfg!(target_arch = "x86_64") {
        "plain x86-64 (SSE2)"
    } else {
        std::env::consts::ARCH
    }
}
