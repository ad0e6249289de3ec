//! The level table: faces, void, and certified distances between each level and the surface.

use super::tables::Tables;
use crate::bvh::exact_blob_watched;
use crate::collapse::History;
use crate::error::BuildError;
use crate::hausdorff::{farthest, nearest_in};
use crate::mesh::Mesh;
use crate::progress::Watch;
use meshsweep_core::internal::num::up_to_f32;
use meshsweep_core::{Bvh, Hull, HullLevel, VertIdx};

/// Split counts of the levels: the base hull, then every doubling of the faces, then all.
fn level_splits(history: &History) -> Vec<u32> {
    let total = history.collapses.len() as u32;
    let base = history.base.len() as u32;
    let mut splits = Vec::new();
    let mut faces = base;
    while faces.saturating_sub(base) / 2 < total {
        splits.push((faces - base) / 2);
        faces = faces.saturating_mul(2);
    }
    splits.push(total);
    splits
}

/// The level table with distances 0. `void_ratio` is relative to `volume`, or 0 without a volume.
pub fn levels(history: &History, volume: Option<f64>) -> Vec<HullLevel> {
    let total = history.collapses.len();
    let mut added = vec![0.0; total + 1];
    for (i, volume) in history.added_volume.iter().enumerate() {
        added[i + 1] = added[i] + volume;
    }
    let void = |splits: u32| volume.map_or(0.0, |unit| added[total - splits as usize] / unit);
    level_splits(history)
        .into_iter()
        .map(|splits| HullLevel {
            faces: (history.base.len() + 2 * splits as usize) as u32,
            splits,
            hull_to_surface: 0.0,
            surface_to_hull: 0.0,
            void_ratio: up_to_f32(void(splits)),
        })
        .collect()
}

/// Fills in certified distances between each level's hull and the surface, both ways, and counts
/// the faces. A box tree of the surface's triangles gives the distances to it.
///
/// # Errors
/// [`BuildError`].
pub fn certify(tables: &mut Tables, history: &History, watch: Watch<'_>) -> Result<(), BuildError> {
    let bytes = tables.to_bytes();
    let model = Hull::open(&bytes).map_err(BuildError::Reopen)?;
    let position = |label: usize| history.positions[label].as_vec3().to_array();
    let surface = Mesh::new(
        (0..history.original_vertices as usize).map(position).collect(),
        history.original_triangles[..history.surface_triangles].to_vec(),
    );
    let tree = exact_blob_watched(&surface, watch.part(0.0, 0.5))?;
    let tree = Bvh::open(&tree).map_err(BuildError::Reopen)?;
    let queries = 2 * surface.triangles.len();
    let mut nearest = watch.part(0.5, 1.0).asks(queries, nearest_in(&tree, &surface));
    let at = |v: VertIdx| tables.vertices[v.0 as usize].as_dvec3();
    let last = tables.levels.len() - 1;
    let mut measured = Vec::new();
    for (index, level) in tables.levels.iter().enumerate() {
        let faces: Vec<_> = model.faces(level).collect();
        let count = faces.len() as u32;
        if index == last {
            measured.push((count, 0.0, 0.0));
            break;
        }
        let surface_to_hull = faces.iter().map(|face| face.radius).fold(0f32, f32::max);
        let triangles = faces.iter().map(|face| face.corners.map(at));
        let hull_to_surface = farthest(triangles, 0.0, &mut nearest).upper;
        measured.push((count, up_to_f32(hull_to_surface), surface_to_hull));
    }
    watch.check()?;
    for (level, (faces, hull_to_surface, surface_to_hull)) in tables.levels.iter_mut().zip(measured)
    {
        level.faces = faces;
        level.hull_to_surface = hull_to_surface;
        level.surface_to_hull = surface_to_hull;
    }
    Ok(())
}
