// The blob `link.msw` of `link.obj`, opened by the compiler.
//
// Written by `meshsweep build --emit rust`. Keep both files in one folder, and write
// `mod link;` in a crate that depends on `meshsweep-core` 0.1.0.
//
// - triangles in the mesh file: 284
// - closed
// - a box that contains it: [-6.0, 0.0, -6.0] to [66.0, 8.0, 6.0]
// - no point of the mesh is farther than 0.0 from the stored surface
//
// Bytes of the processor's stack that a question takes, at opt-level "s" / 3. Debug builds
// take several times as much: core/docs/guide.md tells how to avoid it.
//                                    Cortex-M4F      Cortex-M0     Cortex-M33       RV32IMAC
//   open a box tree                 2240 / 1792    2368 / 1920    2240 / 1792    2176 / 1792
//   first hit                       1152 / 1280    1600 / 1664    1152 / 1280    1472 / 1472
//   any hit                         1152 / 1088    1472 / 1600    1152 / 1088    1408 / 1408
//   all hits                        1344 / 1344    1728 / 1664    1344 / 1344    1536 / 1536
//   ray                             1408 / 1472    1728 / 1728    1408 / 1472    1536 / 1600
//   overlap                         6592 / 6016    6528 / 5760    6592 / 6016    6144 / 5504
//   distance of two models        11520 / 10816  11328 / 10752  11520 / 10816  10880 / 10304
//   coherent pair                 13184 / 12864  13120 / 12800  13184 / 12864  12608 / 12224
//   scene                         12928 / 12864  12864 / 12800  12928 / 12864  12416 / 12288
//   distance of a solid           11840 / 10368  11776 / 10176  11840 / 10368   11264 / 9600
//   first contact                 10688 / 10048   10560 / 9728  10688 / 10048   10240 / 9280
//
// Distances are in the mesh's unit. Intervals hold of the mesh, not only of the stored surface.

use meshsweep_core::{Blob, Bvh, Scratch};

/// Bytes that begin at a multiple of four.
#[repr(C, align(4))]
pub struct Aligned<const N: usize>(pub [u8; N]);

/// The blob.
#[allow(dead_code)]
pub static BYTES: Aligned<4032> = Aligned(*include_bytes!("link.msw"));

/// What `Blob::checksum` gives while the bytes are those of the builder.
#[allow(dead_code)]
pub const CHECKSUM: u32 = 0xcd35923d;

#[allow(long_running_const_eval, reason = "every byte is compared")]
const _: () = assert!(
    matches!(Blob::checksum(include_bytes!("link.msw")), Ok(CHECKSUM)),
    "the file is another blob than this module was written for"
);

/// No question about one point, segment or solid needs more scratch entries.
#[allow(dead_code)]
pub const SCRATCH_ENTRIES: usize = 30;

/// Scratch memory. `cargo build` refuses fewer than `SCRATCH_ENTRIES`.
#[allow(dead_code)]
pub const fn scratch<const N: usize>() -> Scratch<N> {
    const { assert!(N >= SCRATCH_ENTRIES, "too few scratch entries") }
    Scratch::new()
}

/// The box tree.
#[allow(dead_code)]
pub static TREE: Bvh<'static> = match Bvh::open_trusted(&BYTES.0) {
    Ok(tree) => tree,
    Err(_) => panic!("the blob has no box tree"),
};
