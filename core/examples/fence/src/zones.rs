// The blob `zones.msw` of `zones.csv`, opened by the compiler.
//
// Written by `meshsweep build --emit rust`. Keep both files in one folder, and write
// `mod zones;` in a crate that depends on `meshsweep-core` 0.1.0.
//
// - triangles in the mesh file: 0
//
// Bytes of the processor's stack that a question takes, at opt-level "s" / 3. Debug builds
// take several times as much: core/docs/guide.md tells how to avoid it.
//                                    Cortex-M4F      Cortex-M0     Cortex-M33       RV32IMAC
//   open curves                     1728 / 1600    1792 / 1728    1728 / 1600    1664 / 1472
//   closest point of curves         1920 / 1856    1856 / 1792    1920 / 1856    1664 / 1600
//   sweep of curves                 2240 / 2240    2368 / 2304    2240 / 2240    1984 / 1920
//   nearest segments of curves      1472 / 1472    1472 / 1408    1472 / 1408    1280 / 1216
//   all within of curves            1472 / 1472    1472 / 1408    1472 / 1408    1280 / 1280
//   signed distance of curves       2176 / 2176    2112 / 2048    2176 / 2176    1856 / 1856
//
// Distances are in the mesh's unit. Intervals hold of the mesh, not only of the stored surface.

use meshsweep_core::{Blob, OpenError, Scratch};

/// Bytes that begin at a multiple of four.
#[repr(C, align(4))]
pub struct Aligned<const N: usize>(pub [u8; N]);

/// The blob.
#[allow(dead_code)]
pub static BYTES: Aligned<1215> = Aligned(*include_bytes!("zones.msw"));

/// What `Blob::checksum` gives while the bytes are those of the builder.
#[allow(dead_code)]
pub const CHECKSUM: u32 = 0xb55acd75;

#[allow(long_running_const_eval, reason = "every byte is compared")]
const _: () = assert!(
    matches!(Blob::checksum(include_bytes!("zones.msw")), Ok(CHECKSUM)),
    "the file is another blob than this module was written for"
);

/// No question about one point, segment or solid needs more scratch entries.
#[allow(dead_code)]
pub const SCRATCH_ENTRIES: usize = 9;

/// Scratch memory. `cargo build` refuses fewer than `SCRATCH_ENTRIES`.
#[allow(dead_code)]
pub const fn scratch<const N: usize>() -> Scratch<N> {
    const { assert!(N >= SCRATCH_ENTRIES, "too few scratch entries") }
    Scratch::new()
}

/// Opens all structures of the blob and checks every byte. The compiler cannot open
/// hull hierarchies, triboxes and curves.
///
/// # Errors
/// Flash does not hold the blob any more.
#[allow(dead_code)]
pub fn open() -> Result<Blob<'static>, OpenError> {
    Blob::open(&BYTES.0)
}
