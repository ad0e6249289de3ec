//! Whether and where a surface meets itself, by exact predicates.

use super::bounds::Bounds;
use super::contact::Contact;
use super::predicates::{Face, are_apart, is_degenerate};
use super::tree::StaticTree;
use glam::DVec3;
use rayon::prelude::*;

/// Whether faces with area share no points but common corners and common edges. Exact.
///
/// Cost: one query of a static tree for each face, on all threads.
pub(crate) fn is_embedded(faces: &[Face]) -> bool {
    let boxes: Vec<Bounds> = faces.iter().map(|face| Bounds::of(&face.at)).collect();
    let tree = StaticTree::new(&boxes);
    let is_apart_from_later = |i: usize| {
        tree.visit_meeting(&boxes[i], |j| {
            j <= i || !boxes[j].meets(&boxes[i]) || are_apart(&faces[i], &faces[j])
        })
    };
    (0..faces.len()).into_par_iter().all(is_apart_from_later)
}

/// Pairs of faces that are not apart, and how they meet, ascending. Faces without area are passed
/// over. Exact. The search ends soon after `most` pairs: then there may be more.
///
/// Cost: one query of a static tree for each face, on all threads. The pairs are the same on any
/// number of threads.
pub(crate) fn contacts(faces: &[Face], most: usize) -> Vec<([u32; 2], Contact)> {
    let boxes: Vec<Bounds> = faces.iter().map(|face| Bounds::of(&face.at)).collect();
    let tree = StaticTree::new(&boxes);
    let has_area: Vec<bool> = faces.par_iter().map(|face| !is_degenerate(&face.at)).collect();
    let with_later = |i: usize| {
        let mut found = Vec::new();
        if has_area[i] {
            tree.visit_meeting(&boxes[i], |j| {
                if j > i && has_area[j] && boxes[j].meets(&boxes[i]) {
                    let contact = Contact::of(&faces[i], &faces[j]);
                    if contact != Contact::Apart {
                        found.push(([i as u32, j as u32], contact));
                    }
                }
                found.len() < most
            });
            found.sort_unstable_by_key(|(pair, _)| *pair);
        }
        found
    };
    let mut found = Vec::new();
    let mut from = 0;
    while from < faces.len() && found.len() < most {
        let to = (from + BLOCK).min(faces.len());
        found.par_extend((from..to).into_par_iter().flat_map_iter(with_later));
        from = to;
    }
    found
}

/// Faces that are searched before pairs are counted.
const BLOCK: usize = 1 << 12;

/// Pairs of faces that share more than common corners and edges, ascending; faces without a common
/// corner may touch in one point. Faces without area are passed over. Exact.
///
/// Cost: as [`contacts`], and the pairs.
pub(crate) fn crossing_pairs(faces: &[Face]) -> Vec<[u32; 2]> {
    let is_crossing =
        |(pair, contact)| matches!(contact, Contact::Edges(_) | Contact::Crossing).then_some(pair);
    contacts(faces, usize::MAX).into_iter().filter_map(is_crossing).collect()
}

/// The faces of triangles.
pub(crate) fn faces(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<Face> {
    let face = |ids: &[u32; 3]| Face { ids: *ids, at: ids.map(|v| positions[v as usize]) };
    triangles.iter().map(face).collect()
}

/// Whether triangles with area share points besides common corners and edges: the surface crosses
/// or touches itself. Exact.
pub(crate) fn crosses_itself(positions: &[DVec3], triangles: &[[u32; 3]]) -> bool {
    let mut faces = faces(positions, triangles);
    faces.retain(|face| !is_degenerate(&face.at));
    !is_embedded(&faces)
}
