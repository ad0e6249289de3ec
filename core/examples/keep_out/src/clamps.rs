// The blob `clamps.msw` of `clamps.obj`, opened by the compiler.
//
// Written by `meshsweep build --emit rust`. Keep both files in one folder, and write
// `mod clamps;` in a crate that depends on `meshsweep-core` 0.1.0.
//
// - triangles in the mesh file: 40
// - closed
// - a box that contains it: [0.0, 0.0, 0.0] to [100.0, 16.0, 28.0]
// - no point of the mesh is farther than 0.0 from the stored surface
//
// Bytes of the processor's stack that a question takes, at opt-level "s" / 3. Debug builds
// take several times as much: core/docs/guide.md tells how to avoid it.
//                                    Cortex-M4F      Cortex-M0     Cortex-M33       RV32IMAC
//   open a box tree                 2240 / 1792    2368 / 1920    2240 / 1792    2176 / 1792
//   closest point                   1344 / 1344    2560 / 2944    1344 / 1344    2048 / 2368
//   closest point from a hint       1280 / 1344    2560 / 2880    1280 / 1344    1984 / 2304
//   closest point in f64            7424 / 7104    7232 / 6784    7424 / 7104    7040 / 6528
//   coherent query                  1792 / 1856    3136 / 3520    1792 / 1856    2560 / 2816
//   closest points                  1920 / 3072    3200 / 4672    1920 / 3072    2624 / 3968
//   within                          1792 / 1792    3136 / 3456    1792 / 1792    2560 / 2816
//   nearest triangles               1728 / 1792    3008 / 3328    1728 / 1792    2432 / 2752
//   all within                      1728 / 1792    3008 / 3392    1728 / 1792    2432 / 2752
//   signed distance                 2496 / 2688    3648 / 3648    2496 / 2688    2944 / 3008
//   first hit                       1216 / 1344    1600 / 1664    1216 / 1344    1472 / 1472
//   any hit                         1152 / 1088    1472 / 1600    1152 / 1088    1408 / 1408
//   all hits                        1408 / 1408    1664 / 1664    1408 / 1408    1472 / 1536
//   overlap                         6592 / 6144    6464 / 5952    6592 / 6144    6016 / 5696
//   distance of two models        10112 / 10432   9984 / 10048  10112 / 10368    9216 / 9472
//   coherent pair                 12032 / 12480  11968 / 12288  12032 / 12544  11264 / 11712
//   scene                         10944 / 12096  10816 / 11840  10944 / 12096  10112 / 11264
//   distance of a solid           12032 / 10368  11840 / 10176  12032 / 10368   11456 / 9664
//   first contact                 10688 / 10112   10560 / 9792  10688 / 10112   10240 / 9344
//
// Distances are in the mesh's unit. Intervals hold of the mesh, not only of the stored surface.

use meshsweep_core::{Blob, Bvh, Scratch};

/// Bytes that begin at a multiple of four.
#[repr(C, align(4))]
pub struct Aligned<const N: usize>(pub [u8; N]);

/// The blob.
#[allow(dead_code)]
pub static BYTES: Aligned<918> = Aligned(*include_bytes!("clamps.msw"));

/// What `Blob::checksum` gives while the bytes are those of the builder.
#[allow(dead_code)]
pub const CHECKSUM: u32 = 0x6afe8f34;

#[allow(long_running_const_eval, reason = "every byte is compared")]
const _: () = assert!(
    matches!(Blob::checksum(include_bytes!("clamps.msw")), Ok(CHECKSUM)),
    "the file is another blob than this module was written for"
);

/// No question about one point, segment or solid needs more scratch entries.
#[allow(dead_code)]
pub const SCRATCH_ENTRIES: usize = 13;

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
