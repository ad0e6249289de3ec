//! All splits in order, from the base hull to the surface.

use super::parse::Blob;
use super::report::CheckReport;
use crate::check::exact::side;
use crate::check::manifold::{Manifold, canonical};
use std::collections::HashSet;

/// The triangles of each level's hull, without those that close holes.
pub(super) type Hulls = Vec<Vec<[u32; 3]>>;

/// Replays every split; returns the hull of every level.
pub(super) fn replay(blob: &Blob, report: &mut CheckReport) -> Result<Hulls, String> {
    let vertices = blob.vertices.len() as u32;
    let named = blob.base.iter().flatten().chain(blob.splits.iter().flat_map(|s| &s.ring));
    let named = named.chain(blob.groups.iter().flat_map(|(corners, _)| corners));
    if named.chain(blob.surface.iter().flatten()).any(|&v| v >= vertices) {
        return Err("a triangle names a vertex that does not exist".into());
    }
    splits_with(blob)?;
    let mut mesh = Manifold::default();
    for &triangle in &blob.base {
        if triangle.iter().any(|&v| v >= blob.base_vertices) {
            return Err(format!("base triangle {triangle:?} has a vertex that a split makes"));
        }
        mesh.add(triangle)?;
    }
    mesh.closed_manifold().map_err(|e| format!("base hull: {e}"))?;
    let partless = partless(blob);
    let mut hulls = Hulls::new();
    for level in &blob.levels {
        if level.splits as usize > blob.splits.len() {
            return Err(format!("a level of {} splits, there are fewer", level.splits));
        }
        while report.splits < level.splits as usize {
            let index = report.splits;
            split(blob, index, &mut mesh, report).map_err(|e| format!("split {index}: {e}"))?;
            report.splits += 1;
        }
        mesh.closed_manifold().map_err(|e| format!("after {} splits: {e}", level.splits))?;
        let mut hull = mesh.triangles();
        hull.retain(|triangle| !partless.contains(triangle));
        if hull.len() != level.faces as usize {
            return Err(format!("a level of {} faces has {}", level.faces, hull.len()));
        }
        hulls.push(hull);
    }
    if report.splits != blob.splits.len() {
        return Err("the last level lacks splits".into());
    }
    let mut finest = mesh.triangles();
    finest.retain(|triangle| !partless.contains(triangle));
    report.triangles = finest.len();
    if !blob.is_cut {
        let mut surface: Vec<[u32; 3]> = blob.surface.iter().map(|&t| canonical(t)).collect();
        surface.sort_unstable();
        if surface != finest {
            return Err("the finest mesh is not the surface".into());
        }
    }
    Ok(hulls)
}

/// The triangles of all levels that claim to stand for no part of the surface.
fn partless(blob: &Blob) -> HashSet<[u32; 3]> {
    let named = blob.triangles().into_iter().zip(0..);
    named.filter(|&(_, index)| !blob.has_part(index)).map(|(t, _)| canonical(t)).collect()
}

/// "Splits with" is the inverse of the splits' vertices.
fn splits_with(blob: &Blob) -> Result<(), String> {
    let mut expected = vec![None; blob.vertices.len()];
    for (index, split) in blob.splits.iter().enumerate() {
        let made_later = split.vertex as usize >= blob.base_vertices as usize + 2 * index;
        let slot = expected.get_mut(split.vertex as usize).filter(|_| !made_later);
        let slot = slot.ok_or(format!("split {index}: its vertex does not exist yet"))?;
        if slot.replace(index as u32).is_some() {
            return Err(format!("split {index}: its vertex was split before"));
        }
    }
    if expected == blob.splits_with {
        Ok(())
    } else {
        Err("splits with: not the inverse of the splits".into())
    }
}

/// One split: its star is the ring's fan, its vertex lies on or outside every new plane, and what
/// comes out is a manifold.
fn split(
    blob: &Blob,
    index: usize,
    mesh: &mut Manifold,
    report: &mut CheckReport,
) -> Result<(), String> {
    let split = &blob.splits[index];
    let ring = &split.ring;
    if mesh.valence(split.vertex) != ring.len() {
        return Err(format!(
            "{} triangles around, {} in the ring",
            mesh.valence(split.vertex),
            ring.len()
        ));
    }
    for (i, &from) in ring.iter().enumerate() {
        mesh.remove([split.vertex, from, ring[(i + 1) % ring.len()]])?;
    }
    let apex = blob.vertices[split.vertex as usize];
    for triangle in blob.fine(index) {
        let (sign, was_exact) = side(blob.corners(triangle), apex);
        report.planes += 1;
        report.exact_planes += usize::from(was_exact);
        if sign < 0 && blob.encloses {
            return Err(format!("its vertex lies inside the plane of {triangle:?}"));
        }
        mesh.add(triangle)?;
    }
    let origin = blob.base_vertices + 2 * index as u32;
    let touched =
        ring.iter().map(|&v| (v, ring[0])).chain([(origin, origin + 1), (origin + 1, origin)]);
    for (i, (vertex, to)) in touched.enumerate() {
        // A ring vertex still has its edge to the next one.
        let to = if i < ring.len() { ring[(i + 1) % ring.len()] } else { to };
        if !mesh.is_disc_at(vertex, to) {
            return Err(format!("the triangles at vertex {vertex} are not one fan"));
        }
    }
    Ok(())
}
