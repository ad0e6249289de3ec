//! What the level table says of volumes and distances.

use super::forest::Forest;
use super::parse::{Blob, small_radius};
use super::report::CheckReport;
use crate::check::manifold::canonical;
use crate::check::near::{Near, Verdict};
use glam::DVec3;

/// Six times the signed volume, around a vertex of the mesh.
fn volume(blob: &Blob, triangles: &[[u32; 3]]) -> f64 {
    let Some(&[first, ..]) = triangles.first() else { return 0.0 };
    let origin = DVec3::from(blob.vertices[first as usize]);
    triangles
        .iter()
        .map(|&t| {
            let [a, b, c] = blob.corners(t).map(|p| DVec3::from(p) - origin);
            a.dot(b.cross(c))
        })
        .sum()
}

/// Void ratios are those of the meshes, and never grow from coarse to fine.
pub(super) fn volumes(blob: &Blob, hulls: &[Vec<[u32; 3]>]) -> Result<(), String> {
    if !blob.encloses {
        let has_void = blob.levels.iter().any(|level| level.void_ratio != 0.0);
        return if has_void { Err("a void of what encloses nothing".into()) } else { Ok(()) };
    }
    if blob.is_cut {
        return Ok(());
    }
    let surface = volume(blob, &blob.surface);
    let mut before = f64::INFINITY;
    for (index, (level, hull)) in blob.levels.iter().zip(hulls).enumerate() {
        let void = volume(blob, hull) / surface - 1.0;
        let stored = f64::from(level.void_ratio);
        let is_near = (void - stored).abs() <= 1e-6 * void.abs() + 1e-9;
        if !is_near {
            return Err(format!("level {index}: its void is {void:e}, the table says {stored:e}"));
        }
        if void > before + 1e-9 {
            return Err(format!(
                "level {index} is looser than the one before: {void:e} > {before:e}"
            ));
        }
        before = void;
    }
    Ok(())
}

/// The hull of each level is as near the surface as the table says, and its radii are below the
/// table's.
pub(super) fn distances(
    blob: &Blob,
    hulls: &[Vec<[u32; 3]>],
    forest: &Forest,
    report: &mut CheckReport,
) -> Result<(), String> {
    let Some((last, coarser)) = blob.levels.split_last() else { return Err("no levels".into()) };
    if !blob.is_cut && (last.hull_to_surface != 0.0 || last.surface_to_hull != 0.0) {
        return Err("the finest level is the surface, and the table says that it is not".into());
    }
    if blob.is_cut {
        report.undecided_levels = blob.levels.len();
        return Ok(());
    }
    let surface = Near::new(blob.surface.iter().map(|&t| blob.places(t)).collect());
    for (index, (level, hull)) in coarser.iter().zip(hulls).enumerate() {
        for &triangle in hull {
            let radius = small_radius(blob.radii[forest.number[&canonical(triangle)]]);
            if radius > f64::from(level.surface_to_hull) {
                return Err(format!(
                    "level {index}: a radius of {radius:e} exceeds {:e}",
                    level.surface_to_hull
                ));
            }
        }
        let mut is_decided = true;
        for &triangle in hull {
            match surface.within(blob.places(triangle), f64::from(level.hull_to_surface)) {
                Verdict::Within => report.level_triangles += 1,
                Verdict::Beyond(p, d) => {
                    return Err(format!(
                        "level {index}: {p} is {d:e} from the surface, the table says {:e}",
                        level.hull_to_surface
                    ));
                }
                Verdict::Undecided => {
                    is_decided = false;
                    break;
                }
            }
        }
        report.undecided_levels += usize::from(!is_decided);
    }
    Ok(())
}
