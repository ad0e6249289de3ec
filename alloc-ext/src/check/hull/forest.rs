//! The triangles of all levels as a forest, built anew from the split tables: which part of the
//! surface each stands for, and whether its radius contains it.

use super::parse::{Blob, small_radius};
use super::report::CheckReport;
use crate::check::distance::{ABSOLUTE, ROUNDING, distance};
use crate::check::manifold::canonical;
use glam::DVec3;
use std::collections::HashMap;

/// The triangles of all levels, in the order of their radii.
pub(super) struct Forest {
    /// Number of each triangle.
    pub(super) number: HashMap<[u32; 3], usize>,
    /// The vertices of the surface that each stands for. Empty in a cut blob.
    pub(super) below: Vec<Vec<u32>>,
    /// Whether each stands for a part of the surface.
    pub(super) has_part: Vec<bool>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Queue entries that a sweep needs below each triangle; 0 for one that no split removes.
    waiting: Vec<u32>,
}

/// Entries that triangles need that wait together: all of them, or all but the one that is opened
/// and what that needs.
fn together(needs: impl Iterator<Item = u32>) -> u32 {
    let needs: Vec<u32> = needs.filter(|&need| need > 0).collect();
    let (count, most) = (needs.len() as u32, needs.iter().copied().max().unwrap_or(0));
    count.max((count + most).saturating_sub(1))
}

impl Forest {
    /// Undoes the splits from fine to coarse. Each triangle that a split removes stands for what
    /// its children stand for.
    pub(super) fn of(blob: &Blob) -> Result<Self, String> {
        let triangles = blob.triangles();
        let number: HashMap<[u32; 3], usize> =
            triangles.iter().enumerate().map(|(i, &t)| (canonical(t), i)).collect();
        if number.len() != triangles.len() {
            return Err("a triangle occurs twice".into());
        }
        let mut below: Vec<Vec<u32>> = vec![Vec::new(); triangles.len()];
        let mut has_children: Vec<bool> = triangles.iter().map(|&t| blob.is_final(t)).collect();
        // The surface, and beyond a cut what stands for it.
        let mut has_part = vec![false; triangles.len()];
        for (index, &t) in triangles.iter().enumerate().filter(|(_, t)| blob.is_final(**t)) {
            has_part[index] = blob.has_part(index);
            if has_part[index] && !blob.is_cut {
                below[index] = sorted(t).to_vec();
            }
        }
        let mut waiting = vec![0; triangles.len()];
        let mut first = triangles.len();
        for (index, split) in blob.splits.iter().enumerate().rev() {
            let k = split.ring.len();
            first -= k + 2;
            let mut children: Vec<Vec<usize>> = (0..k).map(|i| vec![first + i]).collect();
            children[split.right - usize::from(split.before[0])].push(first + k);
            children[if split.before[1] { k - 1 } else { 0 }].push(first + k + 1);
            for (i, children) in children.into_iter().enumerate() {
                let coarse = [split.vertex, split.ring[i], split.ring[(i + 1) % k]];
                let parent = *number
                    .get(&canonical(coarse))
                    .ok_or(format!("split {index}: it removes {coarse:?}, which is not there"))?;
                if std::mem::replace(&mut has_children[parent], true) {
                    return Err(format!("split {index}: {coarse:?} was removed before"));
                }
                has_part[parent] = children.iter().any(|&child| has_part[child]);
                if has_part[parent] {
                    waiting[parent] = together(children.iter().map(|&child| waiting[child])).max(1);
                }
                let mut part: Vec<u32> =
                    children.iter().flat_map(|&child| below[child].clone()).collect();
                part.sort_unstable();
                part.dedup();
                below[parent] = part;
            }
        }
        match has_children.iter().position(|has| !has) {
            Some(lonely) => Err(format!("triangle {lonely} is split and has no children")),
            None => Ok(Self { number, below, has_part, triangles, waiting }),
        }
    }

    /// Every triangle swept by its radius contains its part of the surface.
    pub(super) fn covers(&self, blob: &Blob, report: &mut CheckReport) -> Result<(), String> {
        for (index, (&triangle, below)) in self.triangles.iter().zip(&self.below).enumerate() {
            let radius = small_radius(blob.radii[index]);
            if self.has_part[index] != blob.has_part(index) {
                return Err(format!("triangle {index}: its radius {radius:e} denies its part"));
            }
            let corners = blob.places(triangle);
            for &v in below {
                let d = distance(DVec3::from(blob.vertices[v as usize]), corners);
                if d > radius * ROUNDING + ABSOLUTE && !triangle.contains(&v) {
                    return Err(format!(
                        "triangle {index} leaves out vertex {v}: {d:e} > {radius:e}"
                    ));
                }
            }
            report.covered += below.len();
            if !blob.is_cut && *below == sorted(triangle) && radius != 0.0 {
                return Err(format!("triangle {index} is its own part and has radius {radius:e}"));
            }
        }
        Ok(())
    }

    /// The queue that the header names suffices.
    pub(super) fn capacity(&self, blob: &Blob) -> Result<(), String> {
        let groups = self.waiting[..blob.base.len()].chunks(16);
        let most = together(groups.map(|group| together(group.iter().copied()).max(1)));
        if most > blob.queue_capacity {
            return Err(format!(
                "a sweep needs {most} queue entries, the header says {}",
                blob.queue_capacity
            ));
        }
        Ok(())
    }
}

fn sorted(mut triangle: [u32; 3]) -> [u32; 3] {
    triangle.sort_unstable();
    triangle
}
