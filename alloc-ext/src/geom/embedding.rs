//! Whether and where a surface meets itself, by exact predicates.

use super::bounds::Bounds;
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

/// Whether faces have area and share no points but common corners and common edges, with each other
/// and with others. Exact. `near` calls its second argument with each of the others whose box meets
/// the first, until it returns false, and returns whether it never did.
pub(crate) fn fits(
    new: &[Face],
    near: impl FnOnce(&Bounds, &mut dyn FnMut(&Face) -> bool) -> bool,
) -> bool {
    if new.iter().any(|face| is_degenerate(&face.at)) {
        return false;
    }
    let among = |i: usize| new[..i].iter().all(|other| are_apart(&new[i], other));
    if !(1..new.len()).all(among) {
        return false;
    }
    let boxes: Vec<Bounds> = new.iter().map(|face| Bounds::of(&face.at)).collect();
    let all = boxes.iter().fold(Bounds::EMPTY, |all, &b| all.join(b));
    near(&all, &mut |old| {
        let bounds = Bounds::of(&old.at);
        new.iter().zip(&boxes).all(|(face, b)| !b.meets(&bounds) || are_apart(face, old))
    })
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
