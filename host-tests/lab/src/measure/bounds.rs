//! Convex bounds of a mesh: how tight each is, and how many meetings it reports that are none.
//!
//! ```text
//! convex_hull ──────┬─ dop (slabs; `clip` makes them solids) ─┐
//!                   ├─ workload::sphere ──────────────────────┼─ sizes (volume)
//!                   └─ oriented_box ──────────────────────────┴─ contenders (each with its rig: the same in f32)
//!                                                                    │
//! pose (a moved copy) ─ workload::contact (whether the meshes meet) ───┴─ false_positives ─ cost
//! ```
//! The tribox (Crosnier & Rossignac 1999) is the 18-DOP of the axes and the edges' diagonals. All
//! but what is counted is in f64, of the f32 mesh.

mod all;
pub mod clip;
pub mod contact;
mod contenders;
pub mod convex_hull;
pub mod cost;
pub mod dop;
mod false_positives;
pub mod oriented_box;
pub mod pose;
mod rig;

use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row};

use all::Bounds;
use cost::Cost;
use false_positives::{Cases, Tally};

/// The tables; `counts` are the instructions that [`cost::counted`] had counted.
///
/// # Errors
/// The mesh is flat, or parry3d refuses it, or f32 cannot hold its squares.
pub fn tables(subject: &Subject, counts: Option<&[Cost]>) -> Result<Vec<Table>, String> {
    let bounds = Bounds::new(subject)?;
    let mut contenders = contenders::contenders(&bounds)?;
    let cases = Cases::new(subject, &bounds);
    let tallies: Vec<Tally> =
        contenders.iter_mut().map(|contender| Tally::of(&cases, contender)).collect();
    let mut tables = vec![sizes(&bounds), false_positives::table(&cases, &contenders, &tallies)];
    tables.extend(counts.map(|counts| cost::table(&contenders, &tallies, counts)));
    Ok(tables)
}

fn sizes(bounds: &Bounds) -> Table {
    let columns = ["bound", "faces", "vertices", "volume", "of the hull's"];
    let mut table = Table::new("bounds", "Convex bounds: volume, input units", &columns);
    let hull = bounds.hull.volume();
    let mut push = |name: &str, counts: Option<[usize; 2]>, volume: f64| {
        let [faces, vertices] =
            counts.map_or([Cell::Empty, Cell::Empty], |two| two.map(Cell::from));
        table.push(row![name, faces, vertices, four_digits(volume), fixed(volume / hull, 3)]);
    };
    for (slabs, _, solid) in &bounds.slabs {
        push(slabs.name, Some([solid.faces.len(), solid.vertices.len()]), solid.volume());
    }
    push("smallest enclosing sphere", None, bounds.sphere.volume());
    push("oriented box, least on a hull's face", Some([6, 8]), bounds.oriented.volume());
    push("convex hull", Some([bounds.hull.triangles.len(), bounds.hull.points.len()]), hull);
    table.note(
        "faces and vertices: those left of the solid, merged at 1e-9 of its size; of the hull: triangles",
    );
    table.note(
        "axes: x, y, z; edges: x±y, y±z, z±x; corners: x±y±z; a direction is a slab, so two planes",
    );
    table.note("on a face: least volume with a side on a face of the hull");
    table
}

/// A number of any magnitude, comparable with its neighbours: four digits unless it is tiny.
fn four_digits(value: f64) -> Cell {
    let before = value.log10().floor();
    fixed(value, if before.is_finite() { (3.0 - before).clamp(0.0, 12.0) as usize } else { 0 })
}
