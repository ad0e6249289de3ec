//! Void of triboxes that take as many bytes as tight hulls.

use crate::measure::triboxes;
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
use meshsweep_xtask::table::{Cell, Table, fixed, row};

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

/// The void that triboxes leave beside the mesh's own volume.
///
/// # Errors
/// The mesh is out of the domain of triboxes.
pub fn table(subject: &Subject, volume: f64, hulls: &[Measured]) -> Result<Table, String> {
    let mut table = Table::new(
        "tight_beside",
        "Void of triboxes",
        &["bound", "faces", "bytes", "void %", "tight hull of about as many bytes"],
    );
    let void = |bound: f64| fixed(100.0 * (bound / volume - 1.0), 1);
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
