//! Void of other bounds: convex ones, and triboxes.

use glam::DVec3;
use meshsweep_alloc::tribox::{Extent, Hierarchy, SplitOptions, box_tree};
use meshsweep_core::Tree;
use meshsweep_core::tribox::FACES;

use super::super::Subject;
use super::super::bounds::convex_hull::ConvexHull;
use super::super::bounds::dop::{Dop, Slabs};
use super::super::bounds::enclosing_sphere::Sphere;
use super::super::table::{Cell, Table, fixed, row};
use super::FACES as HULL_FACES;

/// Bytes of a tribox on a grid of 16 bits: as a node of a blob.
const TRIBOX_BYTES: usize = 40;

/// Triboxes from which on a hierarchy takes minutes.
const MOST_TRIBOXES: usize = 256;

/// Bytes of a hull with 16-bit coordinates and numbers of vertices: about half as many vertices as faces.
fn hull_bytes(faces: usize) -> usize {
    6 * (faces / 2 + 2) + 6 * faces
}

/// What bounds that are convex, and triboxes, leave beside the mesh's own volume.
///
/// # Errors
/// The mesh is out of the domain of triboxes.
pub fn table(subject: &Subject, volume: f64) -> Result<Table, String> {
    let mut table = Table::new(
        "tight_beside",
        "Void of other bounds",
        &["kind", "bound", "faces", "bytes", "void %", "tight hull of about as many bytes"],
    );
    let void = |bound: f64| fixed(100.0 * (bound / volume - 1.0), 1);
    let points: Vec<DVec3> =
        subject.mesh.positions.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect();
    if let Some(hull) = ConvexHull::new(&points) {
        let sphere = Sphere::enclosing(&hull.points);
        for slabs in Slabs::all() {
            let dop = Dop::of(&slabs, hull.points.iter().copied());
            let solid = dop.solid(&slabs, sphere.centre, sphere.radius);
            let name = slabs.name;
            table.push(row![
                "convex",
                name,
                solid.faces.len(),
                Cell::Empty,
                void(solid.volume()),
                Cell::Empty
            ]);
        }
        let faces = hull.triangles.len();
        table.push(row!["convex", "convex hull", faces, hull_bytes(faces), void(hull.volume()), Cell::Empty]);
    }
    let comparable = |faces: usize| (hull_bytes(faces) / TRIBOX_BYTES).max(1);
    let mut counts = vec![(1, None)];
    counts.extend(HULL_FACES.map(|faces| (comparable(faces), Some(faces))));
    counts.retain(|&(count, _)| count <= MOST_TRIBOXES);
    let leaves = counts.iter().map(|&(count, _)| count).max().unwrap_or(1);
    let bytes = box_tree(&subject.mesh);
    let tree = Tree::open(&bytes).map_err(|error| error.to_string())?;
    let options = SplitOptions { leaves, ..SplitOptions::default() };
    let all = Hierarchy::new(&subject.mesh, &tree, &options).map_err(|error| error.to_string())?;
    for (count, faces) in counts {
        let leaves = all.leaves(count);
        let proxies = || leaves.iter().map(|&leaf| all.nodes[leaf as usize].proxy);
        let sides: usize = proxies()
            .map(|tribox| {
                let boundary = tribox.boundary().cleaned();
                (0..FACES).filter(|&face| !boundary.face(face).is_empty()).count()
            })
            .sum();
        let name =
            if leaves.len() == 1 { "1 tribox".to_owned() } else { format!("{} triboxes", leaves.len()) };
        table.push(row![
            "triboxes",
            name,
            sides,
            TRIBOX_BYTES * leaves.len(),
            void(proxies().map(|tribox| Extent::of(&tribox).volume).sum()),
            faces.map_or(Cell::Empty, Cell::from)
        ]);
    }
    table.note(format!(
        "bytes: of a list on a 16-bit grid, {TRIBOX_BYTES} a tribox, about 9 a hull's face; triboxes cover the mesh together, at most {MOST_TRIBOXES} here"
    ));
    Ok(table)
}

/// All of it as one trade of faces for void, for the plot.
pub fn trade(tight: &Table, beside: &Table) -> Table {
    let mut table = Table::new("tight_trade", "Void against faces", &["bound", "faces", "void %", "label"]);
    let column = |of: &Table, name: &str| of.columns.iter().position(|column| *column == name);
    let series =
        [("void %", "tight"), ("void %, lp", "progressive, lp"), ("void %, span", "progressive, span")];
    for (void, name) in series {
        let (Some(faces), Some(void)) = (column(tight, "faces"), column(tight, void)) else { continue };
        for row in &tight.rows {
            table.push(row![name, row[faces].clone(), row[void].clone(), row[void].text()]);
        }
    }
    let columns = ["kind", "faces", "void %", "bound"].map(|name| column(beside, name));
    if let [Some(kind), Some(faces), Some(void), Some(bound)] = columns {
        for row in &beside.rows {
            table.push(row![row[kind].text(), row[faces].clone(), row[void].clone(), row[bound].text()]);
        }
    }
    table
}
