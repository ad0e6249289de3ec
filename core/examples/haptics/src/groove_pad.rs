// The blob `groove_pad.msw` of `groove.obj`, opened by the compiler.
//
// Written by `meshsweep build --emit rust`. Keep both files in one folder, and write
// `mod groove_pad;` in a crate that depends on `meshsweep-core` 0.1.0.
//
// - triangles in the mesh file: 404
//
// Bytes of the processor's stack that a question takes, at opt-level "s" / 3. Debug builds
// take several times as much: core/docs/guide.md tells how to avoid it.
//                                    Cortex-M4F      Cortex-M0     Cortex-M33       RV32IMAC
//   open a distance field           1536 / 1408    1600 / 1408    1536 / 1408    1472 / 1280
//   distance of a field               384 / 320      512 / 512      384 / 320      320 / 320
//   distance of a field in units      384 / 320      448 / 384      384 / 320      320 / 256
//   distance and gradient of a field      448 / 384      704 / 640      448 / 384      384 / 384
//   within of a field                 384 / 320      576 / 576      384 / 320      384 / 320
//
// Distances are in the mesh's unit. Intervals hold of the mesh, not only of the stored surface.

use meshsweep_core::{Blob, Scratch, Sdf};

/// Bytes that begin at a multiple of four.
#[repr(C, align(4))]
pub struct Aligned<const N: usize>(pub [u8; N]);

/// The blob.
#[allow(dead_code)]
pub static BYTES: Aligned<2161> = Aligned(*include_bytes!("groove_pad.msw"));

/// What `Blob::checksum` gives while the bytes are those of the builder.
#[allow(dead_code)]
pub const CHECKSUM: u32 = 0x86c11474;

#[allow(long_running_const_eval, reason = "every byte is compared")]
const _: () = assert!(
    matches!(Blob::checksum(include_bytes!("groove_pad.msw")), Ok(CHECKSUM)),
    "the file is another blob than this module was written for"
);

/// No question about one point, segment or solid needs more scratch entries.
#[allow(dead_code)]
pub const SCRATCH_ENTRIES: usize = 1;

/// Scratch memory. `cargo build` refuses fewer than `SCRATCH_ENTRIES`.
#[allow(dead_code)]
pub const fn scratch<const N: usize>() -> Scratch<N> {
    const { assert!(N >= SCRATCH_ENTRIES, "too few scratch entries") }
    Scratch::new()
}

/// The distance field. It needs no scratch. A unit of it is 0.0022461165.
#[allow(dead_code)]
pub static FIELD: Sdf<'static> = match Sdf::open_trusted(&BYTES.0) {
    Ok(field) => field,
    Err(_) => panic!("the blob has no distance field"),
};
