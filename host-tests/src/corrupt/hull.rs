//! Asks an opened hull hierarchy everything, and holds the answers to what is true of any bytes.

use meshsweep_core::{Budget, Hull, ScratchEntry, TriangleHit};

/// Asks an opened model everything; all of it ends, within work that its tables bound.
///
/// # Panics
/// If an answer is out of range or took too long.
pub fn ask_hull(model: &Hull<'_>) {
    let h = model.header();
    let most = 4 * (h.rings + 2 * h.splits + 2 * h.base_triangles) + 64;
    let mut queue = [ScratchEntry::EMPTY; 24];
    let mut hits = [TriangleHit::EMPTY; 4];
    for p in [[0.1, 0.2, 0.3], [5.0, -3.0, 1.0]] {
        let answer =
            model.closest_point(p, Budget::EXACT, &mut queue).expect("an opened model answers");
        assert!(
            answer.distance.lower <= answer.distance.upper && answer.work.total() <= most,
            "{answer:?}"
        );
    }
    let (a, b) = ([-3.0, 0.1, 0.2], [3.0, 0.15, 0.1]);
    if let Ok(first) = model.first_hit(a, b, Budget::EXACT, &mut queue) {
        assert!(first.t.lower <= first.t.upper && first.work.total() <= most, "{first:?}");
        let all =
            model.all_hits(a, b, &mut hits, Budget::EXACT, &mut queue).expect("in the domain");
        assert!(all.work.total() <= most, "{all:?}");
    }
    every_face_has_corners(model);
}

/// Holds that each corner of each face of each level is a vertex.
///
/// # Panics
/// If one is none.
pub fn every_face_has_corners(model: &Hull<'_>) {
    for level in model.levels() {
        assert!(model.faces(&level).all(|f| model.positions(f.corners).is_some()));
    }
}
