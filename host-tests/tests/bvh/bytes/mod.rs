//! Opening the bytes of a box tree: every fault is a typed error that names the record. Bytes that
//! open are safe to query.

mod header;
mod links;
mod records;
mod trusted;
mod whole;

use meshsweep::bvh::{TreeOptions, build};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep_core::{Budget, Bvh, CoherentQuery, OpenError, Pose, SectionKind};
use meshsweep_host_tests::corrupt::{self, Asker};
use meshsweep_host_tests::generate::{Triangles, icosphere};

fn blob_of((positions, triangles): Triangles, options: &TreeOptions) -> Vec<u8> {
    let mesh = Mesh::new(positions, triangles);
    build(mesh.as_input(), options, Watch::NONE).expect("builds").0.to_bytes()
}

/// A sphere of 320 triangles: more than one level of nodes, and every section that needs no choice.
fn sphere() -> Vec<u8> {
    blob_of(icosphere(2), &TreeOptions::default())
}

fn single() -> Vec<u8> {
    blob_of(icosphere(2), &TreeOptions::default().with_f32(true))
}

fn open(bytes: &[u8]) -> Result<(), OpenError> {
    Bvh::open(bytes).map(|_| ())
}

/// Opens a blob after an edit of one section's bytes, its CRCs right.
fn edited(
    bytes: Vec<u8>,
    kind: SectionKind,
    edit: impl FnOnce(&mut [u8]),
) -> Result<(), OpenError> {
    corrupt::edited(bytes, kind, edit, open)
}

fn record(section: SectionKind, index: u32) -> Result<(), OpenError> {
    Err(OpenError::Record { section, index })
}

/// Asks an opened tree everything, at ordinary places and at hostile ones, with much memory and
/// with little.
fn ask_everything(tree: &Bvh<'_>, some: bool) {
    const POINTS: [[f32; 3]; 5] = [
        [0.1, 0.2, 0.3],
        [5.0, -3.0, 1.0],
        [1e38, -1e38, 1e38],
        [1e-40, 0.0, -0.0],
        [0.5, 0.5, 1e19],
    ];
    const ENDS: [[[f32; 3]; 2]; 4] = [
        [[-3.0, 0.1, 0.2], [3.0, 0.15, 0.1]],
        [[0.0, 0.0, 1.0]; 2],
        [[0.0, -2.0, 0.0], [0.0, 2.0, 0.0]],
        [[1e9, 1e9, 1e9], [-1e9, -1e9, -1e9]],
    ];
    let mut asker = Asker::new(tree.header().stack_entries.min(4096) as usize, 8);
    for point in POINTS.into_iter().take(if some { 2 } else { 5 }) {
        asker.point(
            tree,
            point,
            0.75,
            &Budget::EXACT.with_steps(3).with_relative(0.1).with_absolute(0.0),
        );
    }
    for [a, b] in ENDS.into_iter().take(if some { 2 } else { 4 }) {
        asker.segment(tree, a, b);
    }
    asker.sight(tree, POINTS[1]);
    let path = (0..6).map(|step| [0.9, 0.2, 0.01 * step as f32]);
    asker.path(&mut CoherentQuery::<16>::new(), tree, path, &Budget::EXACT);
    let turned = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]];
    for translation in POINTS.into_iter().take(if some { 2 } else { 5 }) {
        asker.two_models(tree, tree, &Pose::rigid(turned, translation), 60);
    }
    Asker::new(1, 1).point(tree, POINTS[0], 0.5, &Budget::EXACT);
}
