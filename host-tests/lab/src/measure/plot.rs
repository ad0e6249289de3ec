//! Tables that are a trade as a plot: error against work, one panel each, two beside each other,
//! mesh below mesh.
//!
//! ```text
//! tables ─ charts (which columns are what) ─ draw (plotters, SVG) ─ labels (a place for each)
//! ```

mod charts;
mod draw;
mod labels;

use meshsweep_xtask::table::Table;

/// What was measured on a mesh.
pub struct Measured {
    /// The mesh's name.
    pub mesh: String,
    /// Its tables.
    pub tables: Vec<Table>,
}

/// An SVG with a panel for every trade among the tables.
///
/// # Errors
/// No table is one, one lacks a column, or plotters refuses.
pub fn svg(measured: &[Measured]) -> Result<String, String> {
    let rows = measured.iter().map(|one| charts::of(&one.mesh, &one.tables));
    let mut rows = rows.collect::<Result<Vec<_>, String>>()?;
    rows.retain(|row| !row.is_empty());
    if rows.is_empty() {
        return Err("none of the tables is a trade that can be plotted".to_owned());
    }
    draw::svg(&rows)
}
