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
//                               
//   open a box tree             
//   closest point               
//   closest point from a hint   
//   closest point in f64        
//   coherent query              
//   within                      
//   nearest triangles           
//   all within                  
//   signed distance             
//   winding number              
//   front facing                
//   first hit                   
//   any hit                     
//   all hits                    
//   overlap                     
//   distance of two models      
//   coherent pair               
//   scene                       
//   distance of a solid         
//   first contact               
//   penetration                 
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
