//! Closed meshes with their hull hierarchies.

use meshsweep::hull::BuildOptions;
use meshsweep::surface::VertexBits;
use meshsweep_host_tests::generate::corpus::IDENTITY;
use meshsweep_host_tests::generate::{
    Triangles, bracket, cube, groove_block, needle_comb, rough_sphere, scaled, torus, transformed,
    two_parts,
};
use meshsweep_host_tests::scene::Scene;
use std::sync::LazyLock;

pub fn options(base_faces: usize) -> BuildOptions<'static> {
    BuildOptions { base_faces, ..BuildOptions::default() }
}

fn moved(mesh: &Triangles, shift: [f32; 3]) -> Triangles {
    transformed(mesh, IDENTITY, shift)
}

/// Every generated mesh once, as it is.
fn plain() -> Vec<Scene> {
    vec![
        Scene::hull("torus", torus(2.0, 0.75, 24, 12), &options(40)),
        Scene::hull("bracket", bracket(), &options(300)),
        Scene::hull("rough sphere", rough_sphere(3, 0.2, 7), &options(60)),
        Scene::hull("groove block", groove_block(), &options(30)),
        Scene::hull("needle comb", needle_comb(), &options(100)),
        Scene::hull("cube", cube(4), &options(12)),
        Scene::hull("two parts", two_parts(), &options(60)),
    ]
}

/// Tiny, huge, far from the origin, and moved to a grid.
fn stretched() -> Vec<Scene> {
    let bits = |vertex_bits| BuildOptions { vertex_bits, ..options(40) };
    let far = [1e6, -1.5e6, 2e6];
    vec![
        Scene::hull("torus × 1e-30", scaled(&torus(2.0, 0.75, 24, 12), 1e-30), &options(40)),
        Scene::hull("torus × 1e30", scaled(&torus(2.0, 0.75, 24, 12), 1e30), &options(40)),
        Scene::hull("rough sphere × 1e-30", scaled(&rough_sphere(2, 0.2, 3), 1e-30), &options(40)),
        Scene::hull("groove block × 1e30", scaled(&groove_block(), 1e30), &options(40)),
        Scene::hull("cube far away", moved(&cube(4), far), &options(12)),
        Scene::hull(
            "two parts × 64 far away",
            moved(&scaled(&two_parts(), 64.0), far),
            &options(60),
        ),
        Scene::hull("rough sphere, 16 bits", rough_sphere(3, 0.2, 7), &bits(VertexBits::Grid16)),
        Scene::hull("torus, 24 bits", torus(2.0, 0.75, 24, 12), &bits(VertexBits::Grid24)),
        Scene::hull("bracket, f32", bracket(), &bits(VertexBits::F32)),
    ]
}

/// All of them, built once for all tests.
pub fn all() -> &'static [Scene] {
    static ALL: LazyLock<Vec<Scene>> =
        LazyLock::new(|| plain().into_iter().chain(stretched()).collect());
    &ALL
}

/// Those whose surface is stored as it was given.
pub fn exact() -> Vec<&'static Scene> {
    let is_exact = |scene: &&Scene| scene.model().header().surface_error == 0.0;
    let scenes: Vec<&Scene> = all().iter().filter(is_exact).collect();
    assert!(scenes.len() > 10);
    scenes
}
