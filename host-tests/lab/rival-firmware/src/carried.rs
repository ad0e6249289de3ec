//! The bytes that the host wrote for this image: a mesh, and the questions about it.

use meshsweep_rival_firmware::race::Questions;
use meshsweep_rival_firmware::records::Records;

macro_rules! file {
    ($name:literal) => {
        Records::new(include_bytes!(concat!(env!("MESHSWEEP_RIVAL"), "/", $name)))
    };
}

/// The mesh's vertices.
#[allow(dead_code, reason = "each engine reads its own")]
pub const VERTICES: Records<3> = file!("vertices.f32");
/// The mesh's triangles.
#[allow(dead_code, reason = "each engine reads its own")]
pub const TRIANGLES: Records<3> = file!("triangles.u32");

/// The box tree of the mesh.
#[allow(dead_code, reason = "each engine reads its own")]
pub const TREE: &[u8] = &Aligned(*include_bytes!(concat!(env!("MESHSWEEP_RIVAL"), "/tree.msw"))).0;

/// As a linker script would align a section for it.
#[repr(C, align(16))]
struct Aligned<T>(T);

/// The questions.
pub const QUESTIONS: Questions = Questions {
    points: [("far", file!("far.f32")), ("near", file!("near.f32"))],
    path: ("path", file!("path.f32")),
    segments: ("segment", file!("segment.f32")),
};
