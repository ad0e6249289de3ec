//! Meshes with box trees for distances, and how exact their answers have to be.

use meshsweep_core::ScratchEntry;
use meshsweep_host_tests::generate::Triangles;
use meshsweep_host_tests::generate::corpus::{mixed, slivers, solids, soups};
use meshsweep_host_tests::scene::Scene;
use std::sync::LazyLock;

/// Stack entries that are enough for every scene.
pub const STACK: usize = 4096;

pub fn stack(entries: usize) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; entries]
}

fn both(meshes: Vec<(&'static str, Triangles)>) -> Vec<Scene> {
    let forms = |(name, mesh): (&str, Triangles)| {
        [false, true].map(|single| Scene::tree(name, mesh.clone(), single))
    };
    meshes.into_iter().flat_map(forms).collect()
}

/// Solids, each on a grid and with f32 vertices; built once for all tests.
pub fn closed() -> &'static [Scene] {
    static ALL: LazyLock<Vec<Scene>> = LazyLock::new(|| both(solids()));
    &ALL
}

/// Solids and soups, each on a grid and with f32 vertices.
pub fn all() -> impl Iterator<Item = &'static Scene> {
    static SOUPS: LazyLock<Vec<Scene>> = LazyLock::new(|| both(soups()));
    closed().iter().chain(&*SOUPS)
}

/// A random soup of one kind.
pub fn random(kind: usize, seed: u64, single: bool) -> Scene {
    let mesh = match kind {
        0 => mixed(60, seed),
        1 => slivers(60, seed, false),
        _ => slivers(60, seed, true),
    };
    Scene::tree("soup", mesh, single)
}

/// Input numbers of the triangles in the order of the blob.
pub fn order(scene: &Scene) -> Vec<u32> {
    let tree = scene.bvh();
    (0..tree.header().triangles).map(|t| tree.source(t).expect("in range")).collect()
}

/// Error bound of the stored surface, input units.
pub fn surface_error(scene: &Scene) -> f64 {
    let tree = scene.bvh();
    f64::from(tree.header().surface_error) * 2f64.powi(tree.scale_exponent())
}

/// How wide an interval may be: the stored surface, and a few roundings of the distance and of
/// the lengths of triangles.
pub fn allowed_width(scene: &Scene, distance: f64) -> f64 {
    let tree = scene.bvh();
    let unit = 2f64.powi(tree.scale_exponent() + tree.header().grid_exponent);
    let roundings = 64.0 * distance + 96.0 * f64::from(tree.header().star_radius) * unit;
    // On the grid a certified square may fall short by one square unit before it is looked at
    // again.
    let rounding = roundings * f64::from(f32::EPSILON);
    let units = ((distance - surface_error(scene) - rounding) / unit).max(1.0);
    let short = if tree.header().is_f32() { 0.0 } else { units - (units * units - 1.0).sqrt() };
    // Squares of lengths far below the grid unit leave the range of f32. It matters where no
    // triangle has an extent.
    let least = 4.0 * 2f64.powi(-48) * unit;
    2.0 * surface_error(scene) + rounding + least + short * unit
}
