//! Tight hulls stored in a blob: what they say of the mesh within holds, and any bytes are safe to
//! open.

mod answers;
mod bytes;
mod chains;

use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep::tight::{self, ChainOptions, HullReport};
use meshsweep_host_tests::generate::Triangles;

fn mesh((positions, triangles): &Triangles) -> Mesh {
    Mesh::new(positions.clone(), triangles.clone())
}

/// Next to no polish: nothing here depends on how tight a hull is.
fn options(faces: &[usize]) -> ChainOptions {
    ChainOptions::of_faces(faces).with_effort(0.01)
}

/// A blob of tight hulls and nothing else, of a mesh of which every vertex was moved by `moved` at
/// most.
fn of(mesh: &Mesh, moved: f64, options: &ChainOptions) -> (Vec<u8>, Vec<HullReport>) {
    let (tables, reports) =
        tight::build(meshsweep::mesh::Input { moved, ..mesh.as_input() }, options, Watch::NONE)
            .expect("there is room around it");
    (tables.to_bytes(), reports)
}
