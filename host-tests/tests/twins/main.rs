//! The core as boards have it gives the bits of the core as this machine has it.
//!
//! The core is compiled twice more for this machine, with the settings of a Cortex-M0 and of a
//! Cortex-M4F in place of its own: other kernels, other orders of search, integers in place of
//! floats. An emulated board answers a few thousand questions in the time in which these answer
//! millions. What only the compiler does differently, the boards' images show.

mod drawn;
mod suite;

use meshsweep_host_tests::generate::corpus::{slivers, solids, soups};
use meshsweep_host_tests::generate::{Rng, scaled, transformed};
use meshsweep_host_tests::scene::Scene;

/// Scenes of box trees, two each: the corpus, and needles that lie next to each other at the edge
/// of the grid.
fn scenes() -> Vec<Scene> {
    let needles = (0..4).map(|seed| {
        let mesh = slivers(120, 90 + seed, seed % 2 == 0);
        let turned = [[1.0, 0.0, 0.25], [0.0, 1.0, 0.5], [0.0, 0.0, 1.0]];
        ("needles drawn", transformed(&scaled(&mesh, 0.01), turned, [0.3, -7.0, 64.0]))
    });
    let meshes = solids().into_iter().chain(soups()).chain(needles);
    meshes.map(|(name, mesh)| Scene::solid(name, mesh, 0.0, 0)).collect()
}

/// A segment between two points, now and then along an axis or without length.
fn segment(a: [f32; 3], b: [f32; 3], rng: &mut Rng) -> [[f32; 3]; 2] {
    let mut end = b;
    match rng.below(8) {
        0 => end = a,
        1 => end = [b[0], a[1], a[2]],
        2 => end[2] = a[2],
        _ => {}
    }
    [a, end]
}
