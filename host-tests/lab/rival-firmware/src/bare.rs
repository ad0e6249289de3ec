//! What the images share that are linked but never started.

use core::panic::PanicInfo;

/// Says nothing, so that the text of messages is no part of an engine's size.
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    loop {}
}

/// The image's entry in name, and all there is of the empty image.
#[unsafe(no_mangle)]
pub extern "C" fn ask_nothing() {}

/// What a caller hands over. Reached through a pointer from outside of the image, so the optimiser
/// knows nothing of it.
#[repr(C)]
#[allow(dead_code, reason = "each image asks its own questions")]
pub struct Input<'a> {
    /// Positions of the vertices.
    pub vertices: &'a [[f32; 3]],
    /// Vertices of the triangles.
    pub triangles: &'a [[u32; 3]],
    /// A blob of the same mesh.
    pub blob: &'a [u8],
    /// A query point, or a segment's first end.
    pub a: [f32; 3],
    /// A segment's second end.
    pub b: [f32; 3],
}
