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
//   open a box tree                 2560 / 2240    2624 / 2304    2560 / 2240    2496 / 2240
//   closest point                   1408 / 1344    2240 / 2112    1408 / 1344    2048 / 1856
//   closest point from a hint       1344 / 1280    2240 / 2112    1344 / 1280    2048 / 1856
//   coherent query                  1856 / 1728    2816 / 2624    1856 / 1728    2560 / 2368
//   closest points                  3072 / 3008    3968 / 3904    3072 / 3008    3712 / 3520
//   within                          2048 / 1920    2944 / 2816    2048 / 1920    2688 / 2496
//   nearest triangles               1856 / 1856    2816 / 2688    1856 / 1792    2560 / 2432
//   all within                      1856 / 1856    2880 / 2752    1856 / 1856    2560 / 2432
//   signed distance                 3712 / 3840    4480 / 4544    3712 / 3840    4288 / 4224
//   first hit                       1792 / 1280    2112 / 1792    1792 / 1280    1792 / 1536
//   any hit                         1728 / 1216    1920 / 1664    1728 / 1216    1728 / 1408
//   all hits                        1856 / 1344    2048 / 1728    1856 / 1344    1856 / 1600
//   overlap                         6592 / 6144    6464 / 5952    6592 / 6144    6016 / 5696
//   distance of two models        10112 / 10432   9984 / 10048  10112 / 10432    9216 / 9472
//   coherent pair                 12032 / 12544  11968 / 12288  12032 / 12544  11264 / 11712
//   scene                         10816 / 11904  10688 / 11648  10816 / 11904   9984 / 11136
//   distance of a solid           12928 / 11264  12864 / 11136  12928 / 11328  12352 / 10560
//   first contact                 11200 / 10560  11072 / 10304  11200 / 10624   10752 / 9856
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
