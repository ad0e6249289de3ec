//! Tribox hierarchies in blobs: their bytes, what they hold, and what they prove.

mod apart;
mod bytes;
mod contain;
mod nearest;

use meshsweep_alloc::emit::{Parts, assemble};
use meshsweep_alloc::mesh::Mesh;
use meshsweep_alloc::tribox::store;
use meshsweep_host_tests::generate::Triangles;

fn mesh((positions, triangles): &Triangles) -> Mesh {
    Mesh::new(positions.clone(), triangles.clone())
}

/// A blob of triboxes alone.
fn blob(mesh: &Mesh, count: u32) -> Vec<u8> {
    let (tables, _) = store(mesh, 0.0, mesh.triangles.len(), count).expect("in the domain");
    assemble(&Parts { triboxes: Some(&tables), ..Parts::default() })
}

fn of(triangles: &Triangles, count: u32) -> Vec<u8> {
    blob(&mesh(triangles), count)
}
