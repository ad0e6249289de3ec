//! Whether what claims to contain something does: boxes, groups, reaches, errors, source numbers,
//! depth.

use super::forest::Forest;
use super::parse::{Blob, Split, small_radius};
use crate::check::distance::{ABSOLUTE, ROUNDING, distance};
use crate::check::manifold::canonical;
use glam::DVec3;
use std::collections::HashMap;

/// Boxes are those of their vertices, to the last bit.
pub(super) fn boxes(blob: &Blob) -> Result<(), String> {
    let of = |vertices: &mut dyn Iterator<Item = u32>| {
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for v in vertices {
            let p = blob.vertices[v as usize];
            for k in 0..3 {
                bounds[0][k] = bounds[0][k].min(p[k]);
                bounds[1][k] = bounds[1][k].max(p[k]);
            }
        }
        bounds
    };
    if !blob.is_cut {
        if of(&mut (0..blob.vertices.len() as u32)) != blob.hull_box {
            return Err("the hull's box is not that of its vertices".into());
        }
        if of(&mut blob.surface.iter().flatten().copied()) != blob.surface_box {
            return Err("the surface's box is not that of its vertices".into());
        }
    }
    Ok(())
}

/// Every group contains the corners, and so the whole, of its base triangles, and the part of the
/// surface that they stand for.
pub(super) fn groups(blob: &Blob, forest: &Forest) -> Result<(), String> {
    for (index, faces) in blob.base.chunks(16).enumerate() {
        let (corners, radius) = blob.groups[index];
        let first = 16 * index;
        let below = forest.below[first..first + faces.len()].iter().flatten();
        let has_part = forest.has_part[first..first + faces.len()].contains(&true);
        // Of a blob for sweeps only, the infinite radius leaves the whole group out of every sweep.
        if has_part && !blob.encloses && !radius.is_finite() {
            return Err(format!("base group {index}: its radius {radius:e} denies its part"));
        }
        let standing = faces.iter().enumerate().filter(|(i, _)| forest.has_part[first + i]);
        for &v in standing.flat_map(|(_, face)| face).chain(below) {
            let d = distance(DVec3::from(blob.vertices[v as usize]), blob.places(corners));
            if d > radius * ROUNDING + ABSOLUTE {
                return Err(format!(
                    "base group {index} leaves out vertex {v}: {d:e} > {radius:e}"
                ));
            }
        }
    }
    Ok(())
}

/// Every split's star radius spans its ring and its new vertices.
pub(super) fn reaches(blob: &Blob) -> Result<(), String> {
    for (index, split) in blob.splits.iter().enumerate() {
        let apex = DVec3::from(blob.vertices[split.vertex as usize]);
        for v in blob.fine(index).into_iter().flatten() {
            let d = apex.distance(DVec3::from(blob.vertices[v as usize]));
            if d > split.star_radius * ROUNDING {
                return Err(format!(
                    "split {index}: vertex {v} is {d:e} away, its star radius is {:e}",
                    split.star_radius
                ));
            }
        }
    }
    Ok(())
}

/// The numbers of the surface's triangles are as many as the triangles, and each eighth split
/// starts where its triangles stand.
pub(super) fn sources(blob: &Blob) -> Result<(), String> {
    if blob.is_cut {
        return Ok(());
    }
    if blob.source.len() != blob.surface.len() {
        return Err(format!(
            "source: {} numbers for {} triangles",
            blob.source.len(),
            blob.surface.len()
        ));
    }
    let is_counted = |t: &[u32; 3], index: usize| blob.is_final(*t) && blob.has_part(index);
    let count = |triangles: &[[u32; 3]], first: usize| {
        triangles.iter().zip(first..).filter(|&(t, index)| is_counted(t, index)).count()
    };
    let (mut before, mut first) = (count(&blob.base, 0), blob.base.len());
    for index in 0..blob.splits.len() {
        if index % 8 == 0 && blob.source_starts[index / 8] as usize != before {
            return Err(format!("split {index} does not start at triangle {before}"));
        }
        let fine = blob.fine(index);
        before += count(&fine, first);
        first += fine.len();
    }
    Ok(())
}

/// Every split's error is the largest finite radius of the triangles that it removes.
pub(super) fn errors(blob: &Blob) -> Result<(), String> {
    let fine = (0..blob.splits.len()).flat_map(|index| blob.fine(index));
    let radius_of: HashMap<[u32; 3], f64> = blob
        .base
        .iter()
        .copied()
        .chain(fine)
        .zip(&blob.radii)
        .map(|(triangle, &code)| (canonical(triangle), small_radius(code)))
        .collect();
    for (index, Split { vertex, ring, error, .. }) in blob.splits.iter().enumerate() {
        let mut largest = 0f64;
        for (i, &from) in ring.iter().enumerate() {
            let removed = canonical([*vertex, from, ring[(i + 1) % ring.len()]]);
            let radius =
                radius_of.get(&removed).ok_or(format!("split {index} lacks a triangle"))?;
            if radius.is_finite() {
                largest = largest.max(*radius);
            } else if blob.encloses {
                return Err(format!("split {index}: a part that it removes has no finite radius"));
            }
        }
        if largest != *error {
            return Err(format!("split {index}: its error is {error:e} and not {largest:e}"));
        }
    }
    Ok(())
}

/// The dependency depth is what a walk over the tables finds.
pub(super) fn dependencies(blob: &Blob) -> Result<(), String> {
    let mut depth: Vec<u32> = Vec::with_capacity(blob.splits.len());
    for split in &blob.splits {
        let needs = split
            .ring
            .iter()
            .chain([&split.vertex])
            .filter_map(|v| v.checked_sub(blob.base_vertices));
        let below = needs
            .map(|past| depth.get(past as usize / 2).copied().unwrap_or(u32::MAX))
            .max()
            .unwrap_or(0);
        depth.push(below.checked_add(1).ok_or("a ring names a vertex that does not exist yet")?);
    }
    let deepest = depth.into_iter().max().unwrap_or(0);
    if deepest != blob.dependency_depth {
        return Err(format!(
            "the longest chain has {deepest} splits, the header says {}",
            blob.dependency_depth
        ));
    }
    Ok(())
}
