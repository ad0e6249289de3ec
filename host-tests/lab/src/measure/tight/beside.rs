//! Void of other bounds: convex ones, and triboxes.

use crate::measure::triboxes;
use glam::DVec3;
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep::tribox::{Extent, Hierarchy, SplitOptions, box_tree};
use meshsweep_core::Bvh;
use meshsweep_core::internal::num::Radius16;
use meshsweep_core::internal::tight::format::layout::{TIGHT_BYTES, TIGHT_HULL_BYTES};
use meshsweep_core::internal::tribox::format::layout::{
    TRIBOX_BYTES, TRIBOX_LEVEL_BYTES, TRIBOX_SPLIT_BYTES, TRIBOXES_BYTES,
};
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::sphere::Sphere;
use meshsweep_xtask::table::{Cell, Table, fixed, row};

use super::super::bounds::convex_hull::ConvexHull;
use super::super::bounds::dop::{Dop, Slabs};
use super::Measured;

/// Triboxes from which on a hierarchy takes minutes.
const MOST_TRIBOXES: usize = 256;

/// Bytes of a blob's section that holds this hull alone, for distances, with coordinates of 16
/// bits: where these are does not change how many bytes they take.
fn hull_bytes(hull: &Mesh) -> usize {
    let faces = hull.triangles.len();
    let options = TreeOptions::default().with_closest(true).with_segments(false);
    let (tree, _) = build(hull.as_input(), &options, Watch::NONE).expect("builds");
    let blob = tree.to_bytes();
    TIGHT_BYTES + TIGHT_HULL_BYTES + blob.len() + faces * size_of::<Radius16>()
}

/// Bytes of a blob's section that holds so many triboxes, and the nodes and levels above them.
fn tribox_bytes(count: usize) -> usize {
    let levels = count.next_power_of_two().ilog2() as usize + 1;
    let splits = count - 1;
    TRIBOXES_BYTES
        + levels * TRIBOX_LEVEL_BYTES
        + splits * TRIBOX_SPLIT_BYTES
        + (2 * splits + 1) * TRIBOX_BYTES
}

/// The most triboxes that take no more bytes, or one.
fn triboxes_of(bytes: usize) -> usize {
    (1..).take_while(|&count| tribox_bytes(count) <= bytes).last().unwrap_or(1)
}

/// What bounds that are convex, and triboxes, leave beside the mesh's own volume.
///
/// # Errors
/// The mesh is out of the domain of triboxes.
pub fn table(subject: &Subject, volume: f64, hulls: &[Measured]) -> Result<Table, String> {
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
        let positions = hull.points.iter().map(|p| p.to_array().map(|x| x as f32)).collect();
        let triangles = hull.triangles.iter().map(|t| t.map(|v| v as u32)).collect();
        let bytes = hull_bytes(&Mesh::new(positions, triangles));
        table.push(row!["convex", "convex hull", faces, bytes, void(hull.volume()), Cell::Empty]);
    }
    let mut counts = vec![(1, None)];
    counts.extend(hulls.iter().map(|hull| (triboxes_of(hull_bytes(&hull.hull)), Some(hull.asked))));
    counts.retain(|&(count, _)| count <= MOST_TRIBOXES);
    let leaves = counts.iter().map(|&(count, _)| count).max().unwrap_or(1);
    let bytes = box_tree(&subject.mesh).expect("builds");
    let tree = Bvh::open(&bytes).map_err(|error| error.to_string())?;
    let options = SplitOptions::default().with_leaves(leaves);
    let all = Hierarchy::new(&subject.mesh, &tree, &options).map_err(|error| error.to_string())?;
    for (count, faces) in counts {
        let leaves = all.leaves(count);
        let proxies = || leaves.iter().map(|&leaf| all.nodes[leaf as usize].proxy);
        let sides: usize = proxies().map(|tribox| triboxes::faces(&tribox)).sum();
        let name = if leaves.len() == 1 {
            "1 tribox".to_owned()
        } else {
            format!("{} triboxes", leaves.len())
        };
        table.push(row![
            "triboxes",
            name,
            sides,
            tribox_bytes(leaves.len()),
            void(proxies().map(|tribox| Extent::of(&tribox).volume).sum()),
            faces.map_or(Cell::Empty, Cell::from)
        ]);
    }
    table.note(format!(
        "bytes: of a blob's section; triboxes cover the mesh together, at most {MOST_TRIBOXES} here, as many as take no more bytes than the tight hull"
    ));
    Ok(table)
}

/// All of it as one trade of faces for void, for the plot.
pub fn trade(tight: &Table, beside: &Table) -> Table {
    let mut table = Table::new("tight_trade", "Void against faces", &["bound", "faces", "void %"]);
    let column = |of: &Table, name: &str| of.columns.iter().position(|column| *column == name);
    let series = [
        ("void %", "tight"),
        ("void %, lp", "progressive, lp"),
        ("void %, span", "progressive, span"),
    ];
    for (void, name) in series {
        let (Some(faces), Some(void)) = (column(tight, "faces"), column(tight, void)) else {
            continue;
        };
        for row in &tight.rows {
            table.push(row![name, row[faces].clone(), row[void].clone()]);
        }
    }
    if let [Some(kind), Some(faces), Some(void)] =
        ["kind", "faces", "void %"].map(|name| column(beside, name))
    {
        for row in &beside.rows {
            table.push(row![row[kind].text(), row[faces].clone(), row[void].clone()]);
        }
    }
    table
}
