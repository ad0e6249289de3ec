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
//   open a box tree                 2624 / 2368    2752 / 2432    2624 / 2368    2560 / 2368
//   closest point                   1344 / 1408    2112 / 2368    1344 / 1408    1856 / 2112
//   closest point from a hint       1280 / 1344    2112 / 2304    1280 / 1344    1792 / 2048
//   closest point in f64            7424 / 7168    7296 / 6784    7424 / 7104    7040 / 6528
//   coherent query                  1792 / 1856    2688 / 2880    1792 / 1856    2368 / 2624
//   closest points                  1920 / 3072    2752 / 4032    1920 / 3072    2432 / 3776
//   within                          1856 / 1920    2688 / 2816    1856 / 1920    2368 / 2624
//   nearest triangles               1728 / 1792    2560 / 2752    1728 / 1792    2240 / 2496
//   all within                      1728 / 1792    2560 / 2816    1728 / 1792    2304 / 2560
//   signed distance                 3008 / 3136    4096 / 4032    3008 / 3136    3712 / 3712
//   first hit                       1472 / 1408    1728 / 1664    1472 / 1408    1536 / 1472
//   any hit                         1344 / 1088    1600 / 1536    1344 / 1088    1408 / 1408
//   all hits                        1600 / 1408    1856 / 1664    1600 / 1408    1664 / 1536
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
