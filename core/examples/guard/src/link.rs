// The blob `link.msw` of `link.obj`, opened by the compiler.
//
// Written by `meshsweep build --emit rust`. Keep both files in one folder, and write
// `mod link;` in a crate that depends on `meshsweep-core` 0.1.0.
//
// - triangles in the mesh file: 284
// - a box that contains it: [-8.503906, -0.00390625, -8.310547] to [66.00391, 8.003906, 8.310547]
//
// Bytes of the processor's stack that a question takes, at opt-level "s" / 3. Debug builds
// take several times as much: core/docs/guide.md tells how to avoid it.
//                                    Cortex-M4F      Cortex-M0     Cortex-M33       RV32IMAC
//   open tight hulls                2944 / 2496    2816 / 2560    2944 / 2496    2816 / 2496
//   closest point of tight hulls    2816 / 2880    3840 / 3904    2816 / 2880    3200 / 3264
//   within of tight hulls           2752 / 2752    3776 / 3840    2752 / 2752    3136 / 3264
//
// Distances are in the mesh's unit. Intervals hold of the mesh, not only of the stored surface.

use meshsweep_core::{Blob, Scratch, TightHull, TightHulls};

/// Bytes that begin at a multiple of four.
#[repr(C, align(4))]
pub struct Aligned<const N: usize>(pub [u8; N]);

/// The blob.
#[allow(dead_code)]
pub static BYTES: Aligned<1214> = Aligned(*include_bytes!("link.msw"));

/// What `Blob::checksum` gives while the bytes are those of the builder.
#[allow(dead_code)]
pub const CHECKSUM: u32 = 0xfd904fb2;

#[allow(long_running_const_eval, reason = "every byte is compared")]
const _: () = assert!(
    matches!(Blob::checksum(include_bytes!("link.msw")), Ok(CHECKSUM)),
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

/// Tight hulls, coarse to fine: 1 of them.
#[allow(dead_code)]
pub static TIGHT_HULLS: TightHulls<'static> = match TightHulls::open_trusted(&BYTES.0) {
    Ok(hulls) => hulls,
    Err(_) => panic!("the blob has no tight hulls"),
};

/// The tightest of them.
#[allow(dead_code)]
pub static FINEST_HULL: TightHull<'static> = match TIGHT_HULLS.finest() {
    Some(hull) => hull,
    None => panic!("the blob has no tight hulls"),
};
