//! The tables and figures of the papers, one name each, beside the papers' own numbers.
//!
//! ```text
//! figures (what paper 000 reports) ─┬─ hulls (000.1, 000.2), segments (000.3)
//! dop ─ hierarchy (tree of k-DOPs) ─┼─ dops  (000.4)
//! fans (the paper's decomposition) ─┴─ fan_queries (003.1, 003.2, 003.3) ─┬─ fan_sample
//!                             fan_kernel (in f32, as on boards; 003.3) ──┘
//!    triboxes (001.1), oriented (001.3, 001.4), hausdorff (004.10)
//! ```

mod dop;
mod dops;
pub mod fan_kernel;
mod fan_queries;
pub mod fan_sample;
mod fans;
pub mod figures;
mod hausdorff;
mod hierarchy;
mod hulls;
mod oriented;
mod triboxes;

use std::path::Path;

use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Table, row};

use super::{segments, subject_table};

/// A table or figure of a paper.
pub struct Reported {
    /// The paper's number and the table's: what the command line names.
    pub name: &'static str,
    what: &'static str,
    /// Whether the mesh has to be closed.
    is_closed: bool,
    tables: fn(&Subject) -> Result<Vec<Table>, String>,
}

/// All of them.
pub const ALL: [Reported; 11] = [
    Reported {
        name: "000.1",
        what: "Platis & Theoharis 2003, Table 1: time of progressive hulls",
        is_closed: true,
        tables: |subject| Ok(vec![hulls::times(subject)]),
    },
    Reported {
        name: "000.2",
        what: "Platis & Theoharis 2003, Table 2: void of progressive hulls",
        is_closed: true,
        tables: |subject| Ok(vec![hulls::void(subject)]),
    },
    Reported {
        name: "000.3",
        what: "Platis & Theoharis 2003, Table 3: segments on the refined hull",
        is_closed: true,
        tables: |subject| Ok(segments::work(subject)?.into()),
    },
    Reported {
        name: "000.4",
        what: "Platis & Theoharis 2003, Table 4: segments in trees of k-DOPs",
        is_closed: true,
        tables: |subject| Ok(vec![dops::table(subject)?]),
    },
    Reported {
        name: "001.1",
        what: "Crosnier & Rossignac 1999, Table 1: faces of triboxes",
        is_closed: false,
        tables: |subject| Ok(vec![triboxes::table(subject)?]),
    },
    Reported {
        name: "001.3",
        what: "Crosnier & Rossignac 1999, section 3: the orientation of least volume or area",
        is_closed: false,
        tables: |subject| Ok(vec![oriented::orientations(subject)?]),
    },
    Reported {
        name: "001.4",
        what: "Crosnier & Rossignac 1999, section 4: triboxes split until each is near enough",
        is_closed: false,
        tables: |subject| Ok(vec![oriented::errors(subject)?]),
    },
    Reported {
        name: "003.1",
        what: "Galin & Akkouche 2005, Table 1: distance fields by fans",
        is_closed: false,
        tables: |subject| Ok(vec![fans::table(subject)?, fan_queries::distances(subject)?]),
    },
    Reported {
        name: "003.2",
        what: "Galin & Akkouche 2005, Table 2: segments by fans; 6.4: culling",
        is_closed: false,
        tables: |subject| Ok(vec![fan_queries::hits(subject)?, fan_queries::culling(subject)]),
    },
    Reported {
        name: "003.3",
        what: "Galin & Akkouche 2005, 3.3 and 4.3: stored edges, lengths and normals",
        is_closed: false,
        tables: |subject| Ok(vec![fan_queries::stored(subject)?]),
    },
    Reported {
        name: "004.10",
        what: "Guéziec 2000, Figure 10: Hausdorff distance to a simplified mesh",
        is_closed: true,
        tables: hausdorff::tables,
    },
];

/// What there is, as a table.
#[must_use]
pub fn list() -> Table {
    let columns = ["name", "what"];
    let mut table = Table::new("papers", "cargo xtask measure --paper NAME MESH...", &columns);
    for Reported { name, what, .. } in &ALL {
        table.push(row![*name, *what]);
    }
    table
}

/// The table of a mesh file.
///
/// # Errors
/// The file is no mesh that the table is about, or an answer is wrong.
pub fn measure(reported: &Reported, file: &Path) -> Result<Vec<Table>, String> {
    let subject = if reported.is_closed { Subject::load(file)? } else { Subject::load_any(file)? };
    let mut tables = vec![subject_table(&subject)];
    tables.extend((reported.tables)(&subject)?);
    Ok(tables)
}
