//! Tribox hierarchies in blobs: their bytes, what they hold, and what they prove.

mod apart;
mod bytes;
mod contain;
mod hull_error;
mod nearest;
mod turned;

use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep::tribox::{self, TriboxOptions};
use meshsweep_host_tests::generate::Triangles;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

fn mesh((positions, triangles): &Triangles) -> Mesh {
    Mesh::new(positions.clone(), triangles.clone())
}

/// A blob of triboxes alone. The same are asked for by many tests, and are built once.
fn blob(mesh: &Mesh, count: u32) -> Vec<u8> {
    type Built = (Mesh, u32, Arc<OnceLock<Vec<u8>>>);
    static ALL: Mutex<Vec<Built>> = Mutex::new(Vec::new());
    let built = {
        let mut all = ALL.lock().unwrap_or_else(PoisonError::into_inner);
        let known =
            all.iter().find(|(m, c, _)| *c == count && m == mesh).map(|(.., built)| built.clone());
        known.unwrap_or_else(|| {
            let built = Arc::<OnceLock<Vec<u8>>>::default();
            all.push((mesh.clone(), count, built.clone()));
            built
        })
    };
    let build = || {
        let (tables, _) = tribox::build(mesh.as_input(), &TriboxOptions::new(count), Watch::NONE)
            .expect("in the domain");
        tables.to_bytes()
    };
    built.get_or_init(build).clone()
}

fn of(triangles: &Triangles, count: u32) -> Vec<u8> {
    blob(&mesh(triangles), count)
}
