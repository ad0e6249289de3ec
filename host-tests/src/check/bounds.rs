//! Whether what claims to contain something does: boxes, groups, reaches, radii, errors, cover,
//! capacities.

use super::CheckReport;
use super::mesh::canonical;
use super::parse::{Blob, Split, small_radius};
use glam::DVec3;
use std::collections::HashMap;

/// A stored radius is a bound of real numbers; these distances are rounded.
const ROUNDING: f64 = 1.0 + 1e-12;

/// Least distance of a point and a triangle, up to some 1e-14 of the lengths: the foot on the plane
/// if it lies inside three half-planes, else the nearest edge.
pub(super) fn distance(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let to_edge = |from: DVec3, to: DVec3| {
        let d = to - from;
        let t = if d == DVec3::ZERO {
            0.0
        } else {
            (d.dot(p - from) / d.length_squared()).clamp(0.0, 1.0)
        };
        (p - from - d * t).length()
    };
    let edges = to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a));
    let normal = (b - a).cross(c - a);
    let within = |from: DVec3, to: DVec3| (to - from).cross(normal).dot(p - from) <= 0.0;
    if normal != DVec3::ZERO && within(a, b) && within(b, c) && within(c, a) {
        return edges.min(normal.dot(p - a).abs() / normal.length());
    }
    edges
}

fn at(blob: &Blob, triangle: [u32; 3]) -> [DVec3; 3] {
    blob.corners(triangle).map(DVec3::from)
}

/// What a distance in the local frame may be off.
const ABSOLUTE: f64 = 1e-14;

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

/// Every group contains the corners, and so the whole, of its base triangles.
pub(super) fn groups(blob: &Blob) -> Result<(), String> {
    for (index, faces) in blob.base.chunks(16).enumerate() {
        let (corners, radius) = blob.groups[index];
        for &v in faces.iter().flatten() {
            let d = distance(DVec3::from(blob.vertices[v as usize]), at(blob, corners));
            if d > radius * ROUNDING + ABSOLUTE {
                return Err(format!(
                    "base group {index} leaves out vertex {v}: {d:e} > {radius:e}"
                ));
            }
        }
    }
    Ok(())
}

/// Every split's reach spans its ring and its new vertices.
pub(super) fn reaches(blob: &Blob) -> Result<(), String> {
    for (index, split) in blob.splits.iter().enumerate() {
        let apex = DVec3::from(blob.vertices[split.vertex as usize]);
        for v in blob.fine(index).into_iter().flatten() {
            let d = apex.distance(DVec3::from(blob.vertices[v as usize]));
            if d > split.reach * ROUNDING {
                return Err(format!(
                    "split {index}: vertex {v} is {d:e} away, its reach is {:e}",
                    split.reach
                ));
            }
        }
    }
    Ok(())
}

/// The surface's own triangles have radius 0; all other radii are numbers that are not negative.
pub(super) fn radii(blob: &Blob) -> Result<(), String> {
    let is_final = |t: [u32; 3]| t.iter().all(|&v| blob.splits_with[v as usize].is_none());
    let fine = (0..blob.splits.len()).flat_map(|index| blob.fine(index));
    for (index, triangle) in blob.base.iter().copied().chain(fine).enumerate() {
        let radius = small_radius(blob.radii[index]);
        if !blob.is_cut && is_final(triangle) && radius != 0.0 {
            return Err(format!("triangle {index} is the surface's and has radius {radius:e}"));
        }
        if radius < 0.0 || radius.is_nan() {
            return Err(format!("triangle {index} has radius {radius:e}"));
        }
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
            }
        }
        if largest != *error {
            return Err(format!("split {index}: its error is {error:e} and not {largest:e}"));
        }
    }
    Ok(())
}

/// Every node's swept triangle contains the vertices below it; every node but the root has one
/// parent, every triangle one leaf.
pub(super) fn cover(blob: &Blob, report: &mut CheckReport) -> Result<(), String> {
    let mut parent = vec![None; blob.nodes.len()];
    let mut next_triangle = 0;
    for (index, node) in blob.nodes.iter().enumerate() {
        if node.radius < 0.0
            || node.radius.is_nan()
            || node.corners.iter().any(|&v| v as usize >= blob.vertices.len())
        {
            return Err(format!(
                "cover node {index} has radius {:e}, corners {:?}",
                node.radius, node.corners
            ));
        }
        let children = node.first..node.first + node.count;
        if node.count == 0 {
            if !blob.is_cut {
                return Err(format!("cover node {index} has no children"));
            }
        } else if node.leaf {
            if node.first != next_triangle {
                return Err(format!(
                    "cover node {index}: its triangles do not follow those before"
                ));
            }
            next_triangle = children.end;
        } else {
            for child in children {
                if child as usize <= index || parent[child as usize].replace(index).is_some() {
                    return Err(format!("cover node {child} has no single parent before it"));
                }
            }
        }
    }
    if parent.iter().skip(1).any(Option::is_none) || next_triangle as usize != blob.surface.len() {
        return Err("a cover node or a triangle has no parent".into());
    }
    for (index, leaf) in
        blob.nodes.iter().enumerate().filter(|(_, node)| node.leaf && node.count > 0)
    {
        let mut below: Vec<u32> =
            (leaf.first..leaf.first + leaf.count).flat_map(|t| blob.surface[t as usize]).collect();
        below.sort_unstable();
        below.dedup();
        let mut ancestor = Some(index);
        while let Some(above) = ancestor {
            let node = blob.nodes[above];
            let corners = at(blob, node.corners);
            for &v in &below {
                let d = distance(DVec3::from(blob.vertices[v as usize]), corners);
                if d > node.radius * ROUNDING
                    && !node.corners.contains(&v)
                    && d > node.radius + ABSOLUTE
                {
                    return Err(format!(
                        "cover node {above} leaves out vertex {v}: {d:e} > {:e}",
                        node.radius
                    ));
                }
            }
            report.covered += below.len();
            ancestor = parent[above];
        }
    }
    Ok(())
}

/// Queue and dependency depth are what a walk over the tables finds.
pub(super) fn capacities(blob: &Blob) -> Result<(), String> {
    let mut waiting = vec![1u32; blob.nodes.len()];
    for (index, node) in blob.nodes.iter().enumerate() {
        if !node.leaf {
            for child in node.first..node.first + node.count {
                waiting[child as usize] = waiting[index] + node.count - 1;
            }
        }
    }
    let most = waiting.iter().copied().max().unwrap_or(0);
    if most > blob.queue_capacity {
        return Err(format!(
            "a descent needs {most} queue entries, the header says {}",
            blob.queue_capacity
        ));
    }
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
