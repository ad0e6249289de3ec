// The blob `groove.msw` of `groove.obj`, opened by the compiler.
//
// Written by `meshsweep build --emit rust`. Keep both files in one folder, and write
// `mod groove;` in a crate that depends on `meshsweep-core` 0.1.0.
//
// - triangles in the mesh file: 404
// - closed
// - a box that contains it: [0.0, 0.0, 0.0] to [40.0, 40.0, 30.0]
// - no point of the mesh is farther than 0.0 from the stored surface
//
// Bytes of the processor's stack that a question takes, at opt-level "s" / 3. Debug builds
// take several times as much: core/docs/guide.md tells how to avoid it.
//                                    Cortex-M4F      Cortex-M0     Cortex-M33       RV32IMAC
//   open a box tree                 2624 / 2368    2752 / 2432    2624 / 2368    2560 / 2368
//   closest point                   1280 / 1216    2112 / 2048    1280 / 1216    1920 / 1728
//   closest point from a hint       1280 / 1152    2048 / 2048    1280 / 1152    1920 / 1728
//   closest point in f64            7424 / 6976    7232 / 6720    7424 / 6976    7040 / 6464
//   coherent query                  1728 / 1664    2624 / 2624    1728 / 1664    2368 / 2240
//   closest points                  2944 / 2880    3840 / 3840    2944 / 2944    3584 / 3456
//   within                          1792 / 1664    2624 / 2560    1792 / 1664    2432 / 2240
//   nearest triangles               1664 / 1600    2496 / 2496    1664 / 1600    2304 / 2176
//   all within                      1664 / 1600    2560 / 2496    1664 / 1600    2304 / 2176
//   signed distance                 3136 / 3264    3968 / 4096    3136 / 3264    3712 / 3712
//   winding number                   1280 / 960    1664 / 1408     1280 / 960    1472 / 1280
//   front facing                      640 / 576      960 / 960      640 / 576      768 / 768
//   first hit                       1472 / 1152    1792 / 1664    1472 / 1152    1536 / 1408
//   any hit                         1344 / 1088    1664 / 1536    1344 / 1088    1472 / 1344
//   all hits                        1600 / 1408    1920 / 1664    1600 / 1408    1728 / 1536
//   overlap                         6592 / 6144    6464 / 5952    6592 / 6144    6016 / 5696
//   distance of two models        10112 / 10432   9984 / 10048  10112 / 10432    9216 / 9472
//   coherent pair                 12032 / 12480  11968 / 12288  12032 / 12544  11264 / 11712
//   scene                         10944 / 12096  10816 / 11840  10944 / 12096  10112 / 11264
//   distance of a solid           12032 / 10368  11840 / 10240  12032 / 10432   11456 / 9664
//   first contact                 10688 / 10112   10624 / 9792  10688 / 10112   10240 / 9344
//   penetration                   11456 / 12288  11264 / 11904  11456 / 12288  10496 / 11264
//
// Distances are in the mesh's unit. Intervals hold of the mesh, not only of the stored surface.

use meshsweep_core::{Blob, Bvh, Scratch};

/// Bytes that begin at a multiple of four.
#[repr(C, align(4))]
pub struct Aligned<const N: usize>(pub [u8; N]);

/// The blob.
#[allow(dead_code)]
pub static BYTES: Aligned<7260> = Aligned(*include_bytes!("groove.msw"));

/// What `Blob::checksum` gives while the bytes are those of the builder.
#[allow(dead_code)]
pub const CHECKSUM: u32 = 0xa25b2e86;

#[allow(long_running_const_eval, reason = "every byte is compared")]
const _: () = assert!(
    matches!(Blob::checksum(include_bytes!("groove.msw")), Ok(CHECKSUM)),
    "the file is another blob than this module was written for"
);

/// No question about one point, segment or solid needs more scratch entries.
#[allow(dead_code)]
pub const SCRATCH_ENTRIES: usize = 31;

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
