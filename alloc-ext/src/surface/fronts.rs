//! Which faces of a closed surface have places of winding number 0 in front of them, all over.
//!
//! *Patches.* Faces that cross others are set aside. Every other face shares with all faces no more
//! than common corners, common edges, points, and parts of edges of both. So its interior without
//! finitely many points is connected and meets no other face: in front of it the winding number is
//! constant. So it is across an edge of two faces that no third touches along the edge. Faces that
//! such edges connect are a patch.
//!
//! *Samples.* For each patch a short segment through one face, that meets no other, begins at a
//! point in front. The winding number there is found by a ray, exactly: it is that in front of the
//! whole patch. Behind it the number is one more.
//!
//! Faces without area count for nothing: they have no front, and no winding. The faces at their
//! edges are not connected by them.

use crate::geom::{Contact, Face, FaceTree};
use crate::mesh::{EdgeTable, UnionFind, ends};
use rayon::prelude::*;

/// The faces with other places in front of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fronts {
    /// Whether each face has: it crosses another, or its patch has another winding number in front,
    /// or that was not found. Empty if none has.
    pub others: Vec<bool>,
    /// The first defect that was found, if any.
    pub defect: Option<Defect>,
    /// Pairs of faces that cross, ascending: all, if they are fewer than [`most_crossings`].
    pub crossings: Vec<[u32; 2]>,
}

/// Crossings of a surface of so many faces that are looked at one by one, less than this.
pub(crate) const fn most_crossings(faces: usize) -> usize {
    4 * faces + 1024
}

/// Why a face has another winding number than 0 in front, or may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Defect {
    /// These two cross, overlap, or touch in a segment within one of them.
    Crossing([u32; 2]),
    /// This one is inside out, or inside another part of the surface.
    Winding(u32),
}

impl Fronts {
    /// Of a closed surface: every edge has as many triangles in one direction as in the other.
    /// Exact.
    ///
    /// Cost: one query of a static tree for each face; some for each patch. Twice that if very many
    /// faces cross.
    ///
    /// `filed` has for each face 1 if the file winds it as here, −1 if the other way, 0 if its
    /// component is wound both ways. `None` if all are 1 or all are −1: then both numbers are 0
    /// together. A face tells a side only if the file's winding number in front of it is 0 too.
    pub fn of(
        faces: &[Face],
        triangles: &[[u32; 3]],
        edges: &EdgeTable,
        filed: Option<&[i32]>,
    ) -> Self {
        let tree = FaceTree::new(faces);
        let most = most_crossings(faces.len());
        let mut others = vec![false; faces.len()];
        let mut touched_edges = vec![0u8; faces.len()];
        let mut crossings = Vec::new();
        for ([a, b], contact) in tree.contacts(most) {
            match contact {
                Contact::Apart | Contact::Point => {}
                Contact::Edges([of_a, of_b]) => {
                    touched_edges[a as usize] |= of_a;
                    touched_edges[b as usize] |= of_b;
                }
                Contact::Crossing => {
                    crossings.push([a, b]);
                    others[a as usize] = true;
                    others[b as usize] = true;
                }
            }
        }
        if crossings.len() >= most {
            // There are more, perhaps as many as the square of the faces.
            for (face, meeting) in tree.meetings().into_iter().enumerate() {
                others[face] = meeting.crosses;
                touched_edges[face] = meeting.touched_edges;
            }
        }
        let mut defect = crossings.first().map(|&pair| Defect::Crossing(pair));
        let counts = |face: u32| tree.has_area(face) && !others[face as usize];
        let patches = patches(triangles, edges, &touched_edges, counts);
        let is_wrong = |patch: &&Vec<u32>| {
            let sample = patch.iter().find_map(|&face| tree.in_front(face));
            let in_file = |p| filed.map_or(0, |filed| tree.winding(p, |face| filed[face]));
            sample.is_none_or(|p| tree.winding(p, |_| 1) != 0 || in_file(p) != 0)
        };
        let wrong: Vec<&Vec<u32>> = patches.par_iter().filter(is_wrong).collect();
        defect = defect.or(wrong.first().map(|patch| Defect::Winding(patch[0])));
        wrong.into_iter().flatten().for_each(|&face| others[face as usize] = true);
        Self { others: if defect.is_some() { others } else { Vec::new() }, defect, crossings }
    }
}

/// The faces of each patch, ascending, of those that count.
fn patches(
    triangles: &[[u32; 3]],
    edges: &EdgeTable,
    touched_edges: &[u8],
    counts: impl Fn(u32) -> bool,
) -> Vec<Vec<u32>> {
    let mut sets = UnionFind::new(triangles.len());
    for edge in edges.edges() {
        let &[(_, g), (_, h)] = edge else { continue };
        let connects = |h: u32| touched_edges[h as usize / 3] >> (h % 3) & 1 == 0 && counts(h / 3);
        if ends(triangles, g)[0] != ends(triangles, h)[0] && connects(g) && connects(h) {
            sets.join(g / 3, h / 3);
        }
    }
    let mut patch_of = vec![usize::MAX; triangles.len()];
    let mut patches: Vec<Vec<u32>> = Vec::new();
    for face in (0..triangles.len() as u32).filter(|&face| counts(face)) {
        let patch = &mut patch_of[sets.find(face) as usize];
        if *patch == usize::MAX {
            *patch = patches.len();
            patches.push(Vec::new());
        }
        patches[*patch].push(face);
    }
    patches
}
