//! The target for blobs of a box tree and a distance field.

use super::input::Input;
use super::suite::ask_all;
use crate::generate::{Triangles, block, icosphere};
use meshsweep::Builder;
use meshsweep::builder::{For, SdfKind, SdfLayout};
use meshsweep::mesh::RawMesh;
use meshsweep_core::{Blob, BvhWithSdf};
use meshsweep_suite::ask::both;
use std::sync::OnceLock;

/// Small valid blobs of a tree and a field of each kind, in both layouts.
pub fn both_seeds() -> &'static [Vec<u8>] {
    static SEEDS: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    SEEDS.get_or_init(|| {
        let mut open = icosphere(1);
        open.1.truncate(60);
        vec![
            blob(&block([0.0; 3], [3.0, 2.0, 1.0]), SdfKind::Signed, SdfLayout::Tree),
            blob(&icosphere(1), SdfKind::Signed, SdfLayout::Lattice),
            blob(&block([-1.0; 3], [1.0, 2.0, 0.5]), SdfKind::Solid, SdfLayout::Lattice),
            blob(&open, SdfKind::Surface, SdfLayout::Tree),
        ]
    })
}

fn blob((positions, triangles): &Triangles, kind: SdfKind, layout: SdfLayout) -> Vec<u8> {
    let builder = Builder::new().serve_all([For::Closest, For::Segment, For::Sdf]);
    let builder = builder.sdf_bytes(400).sdf_kind(kind).sdf_layout(layout);
    builder.build(RawMesh::from_f32(positions, triangles)).expect("builds").into_bytes()
}

/// Any bytes, and edits of valid blobs. Tree and field of an edited blob contradict each other:
/// answers may be wrong, and each question ends.
///
/// # Panics
/// If an answer is out of range.
pub fn both(data: &[u8]) {
    let mut input = Input(data);
    let bytes = input.blob(both_seeds());
    for bytes in [data, &bytes] {
        let opened = BvhWithSdf::open(bytes);
        if let Ok(blob) = Blob::open(bytes) {
            let has_both = blob.bvh().is_ok() && blob.sdf().is_ok();
            assert_eq!(opened.is_ok(), has_both, "{opened:?}");
            assert_eq!(blob.bvh_with_sdf().is_ok(), has_both, "{opened:?}");
        }
    }
    ask_all::<BvhWithSdf<'_>>(&bytes, both::Scratch::new(), &mut input);
}
