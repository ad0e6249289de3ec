//! Bounds of sixteen base triangles at a time, for segments that meet few of them.

use super::forest::Forest;
use super::swept::best_cover;
use crate::collapse::History;
use glam::DVec3;
use meshsweep_core::internal::hull::format::layout::BASE_GROUP;

/// Puts the base triangles in an order in which sixteen consecutive ones lie together: recursive
/// median splits at multiples of sixteen. Triangles that close holes come last.
pub fn sort_base(history: &mut History) {
    let centre = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|l| history.positions[l as usize]);
        (a + b + c) / 3.0
    };
    let mut faces: Vec<(DVec3, [u32; 3], u32)> = history
        .base
        .iter()
        .zip(&history.base_instances)
        .map(|(corners, &instance)| (centre(corners), *corners, instance))
        .collect();
    let group = BASE_GROUP as usize;
    let mut open = vec![(0, history.base_surface), (history.base_surface, faces.len())];
    while let Some((from, to)) = open.pop() {
        if to - from <= group {
            continue;
        }
        let part = &mut faces[from..to];
        let (low, high) = part
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), f| (l.min(f.0), h.max(f.0)));
        let extent = (high - low).to_array();
        let axis = (0..3).max_by(|&i, &j| extent[i].total_cmp(&extent[j])).unwrap_or(0);
        part.sort_by(|a, b| {
            a.0.to_array()[axis].total_cmp(&b.0.to_array()[axis]).then(a.2.cmp(&b.2))
        });
        let middle = from + ((to - from) / 2).next_multiple_of(group);
        open.extend([(from, middle), (middle, to)]);
    }
    history.base = faces.iter().map(|f| f.1).collect();
    history.base_instances = faces.iter().map(|f| f.2).collect();
}

/// For each sixteen base triangles a swept triangle that contains them and their parts of the
/// surface: corners (labels) and radius. Triangles without a part do not count. The radius is
/// infinite if all are without.
pub fn base_groups(history: &History, forest: &Forest) -> Vec<([u32; 3], f64)> {
    let size = BASE_GROUP as usize;
    let groups = history.base.chunks(size).zip(forest.base_vertices.chunks(size));
    groups
        .map(|(faces, below)| {
            let standing = faces.iter().zip(below).filter(|(_, below)| !below.is_empty());
            let faces: Vec<[u32; 3]> = standing.map(|(&face, _)| face).collect();
            if faces.is_empty() {
                return ([history.base[0][0]; 3], f64::INFINITY);
            }
            let mut corners: Vec<u32> = faces.iter().flatten().copied().collect();
            corners.sort_unstable();
            corners.dedup();
            let mut vertices: Vec<u32> =
                corners.iter().chain(below.iter().flatten()).copied().collect();
            vertices.sort_unstable();
            vertices.dedup();
            best_cover(&history.positions, &faces, &corners, &vertices)
        })
        .collect()
}
