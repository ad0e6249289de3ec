//! Meshes with box trees for segments.

use meshsweep_host_tests::generate::corpus::{solids, soups};
use meshsweep_host_tests::generate::{Triangles, cube, icosphere, inverted, rough_sphere, torus};
use meshsweep_host_tests::scene::Scene;
use std::sync::LazyLock;

/// Closed solids, one of them inside out.
pub fn closed() -> Vec<(&'static str, Triangles)> {
    let mut meshes = solids();
    meshes.push(("inverted icosphere", inverted(&icosphere(2))));
    meshes
}

/// Solids, soups, and solids whose blobs hold moved vertices; built once for all tests.
pub fn all() -> &'static [Scene] {
    static ALL: LazyLock<Vec<Scene>> = LazyLock::new(|| {
        let mut meshes = closed();
        meshes.extend(soups());
        let mut scenes: Vec<Scene> =
            meshes.into_iter().map(|(name, mesh)| Scene::both(name, mesh)).collect();
        scenes.push(Scene::moved("moved cube", cube(3), 1e-3, 5));
        scenes.push(Scene::moved("moved sphere", rough_sphere(2, 0.2, 1), 3e-2, 6));
        scenes.push(Scene::moved("moved torus", torus(2.0, 0.75, 16, 8), 1e-6, 7));
        scenes
    });
    &ALL
}
