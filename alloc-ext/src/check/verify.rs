//! Which structures a blob has, and the proof of each.

use super::bytes::{check_header, entries, section};
use super::curve::FilePolyline;
use super::finding::Finding;
use super::tree::{TREE, prove_tree};
use super::{curve, hull, sdf, tight, tree, triboxes};
use crate::mesh::{Input, KeyFrame, RawMesh};

const BYTES: &str = "blob";

/// What a blob is proved against.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Against<'a> {
    /// A mesh, and its key frames but the first.
    Mesh(Input<'a>, &'a [KeyFrame]),
    /// Polylines. Whether they are closed is not compared.
    Curves(&'a [FilePolyline]),
}

/// Kinds of the sections of each structure, by the format.
const KINDS: [(&str, &[u32]); 6] = [
    ("hull hierarchy", &[1, 2, 3, 4, 5, 6, 7, 9, 10, 11, 22, 23]),
    (TREE, &[12, 13, 14, 15, 16, 17, 18, 24, 25, 26]),
    ("triboxes", &[19]),
    ("tight hulls", &[20]),
    ("curve", &[21, 27]),
    ("distance field", &[28]),
];

/// Proves a blob from its bytes and the mesh or the curves that it was built from. Every claim has
/// a finding: proved, failed, or without a proof. Structures that the blob lacks have none.
///
/// The bytes must open, by [`Blob::open`](meshsweep_core::Blob::open).
///
/// Arithmetic: integers decide planes, boxes, corners and meetings. Radii and distances between
/// surfaces are compared in `f64`, up to 1e-12 of themselves and 1e-14 of the mesh's size.
///
/// Cost: of a box tree its vertices times its depth, of hulls some dozen closest points for each
/// face and each triangle.
///
/// # Panics
/// It may, if the bytes do not open.
#[must_use]
pub fn verify(bytes: &[u8], against: Against<'_>) -> Vec<Finding> {
    let mut out = Vec::new();
    let kinds: Vec<u32> = entries(bytes).iter().map(|entry| entry.kind).collect();
    let whole = check_header(bytes).and_then(|()| {
        kinds.iter().try_for_each(|&kind| section(bytes, kind, "a section").map(drop))
    });
    if let Err(error) = whole {
        return vec![Finding::failed(BYTES, error)];
    }
    for &kind in &kinds {
        if !KINDS.iter().any(|(_, known)| known.contains(&kind)) {
            out.push(Finding::not_proved(BYTES, format!("section of the unknown kind {kind}")));
        }
    }
    for (structure, of) in KINDS {
        if !of.iter().any(|kind| kinds.contains(kind)) {
            continue;
        }
        match (structure, against) {
            ("curve", Against::Curves(polylines)) => out.push(curve::verify(bytes, polylines)),
            ("curve", Against::Mesh(..)) | (_, Against::Curves(_)) => {
                out.push(Finding::failed(structure, "it is not of the given file".to_owned()));
            }
            (TREE, Against::Mesh(input, _)) => out.push(tree_of_mesh(bytes, input)),
            ("distance field", Against::Mesh(input, _)) => out.push(sdf::verify(bytes, input)),
            ("triboxes", Against::Mesh(input, _)) => triboxes::verify(bytes, input, &mut out),
            ("tight hulls", Against::Mesh(input, _)) => tight::verify(bytes, input, &mut out),
            (_, Against::Mesh(input, keys)) => hull::verify(bytes, input, keys, &mut out),
        }
    }
    if out.is_empty() {
        out.push(Finding::not_proved(BYTES, "it has no structure".to_owned()));
    }
    out
}

/// Proves what a blob claims of the file's triangles, before rounding: tight hulls and triboxes
/// hold them, and the triangles of a box tree and of a hull hierarchy's finest surface are within
/// the surface error of them. The hierarchy's levels enclose the surface as stored.
///
/// The bytes must open, by [`Blob::open`](meshsweep_core::Blob::open).
///
/// # Panics
/// It may, if the bytes do not open.
#[must_use]
pub fn verify_file(bytes: &[u8], raw: &RawMesh) -> Vec<Finding> {
    let kinds: Vec<u32> = entries(bytes).iter().map(|entry| entry.kind).collect();
    let mut out = Vec::new();
    if kinds.contains(&19) {
        out.push(triboxes::verify_file(bytes, raw));
    }
    if kinds.contains(&20) {
        out.push(tight::verify_file(bytes, raw));
    }
    if kinds.contains(&12) {
        out.push(tree::verify_file(bytes, raw));
    }
    if kinds.contains(&1) {
        out.extend(hull::verify_file(bytes, raw));
    }
    out
}

fn tree_of_mesh(bytes: &[u8], input: Input<'_>) -> Finding {
    match prove_tree(bytes, input) {
        Err(error) => Finding::failed(TREE, error),
        Ok(proof) => Finding::proved(
            TREE,
            "every triangle of the mesh is stored once, by its number, within the error; every box \
             holds what is below it",
            &[
                ("triangle", proof.triangles),
                ("node", proof.nodes),
                ("enclosed coordinate", proof.contained),
                ("exact comparison", proof.exact_contained),
                ("normal cone", proof.cones),
                ("moment", proof.moments),
            ],
        ),
    }
}
