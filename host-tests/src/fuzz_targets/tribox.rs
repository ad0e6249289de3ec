//! The target for triboxes: any floats, no blob.

use super::input::Input;
use meshsweep_core::internal::tribox::{FACES, SLABS};
use meshsweep_core::{Pose, Tribox};

/// Triboxes of any floats, also such that contradict each other, are NaN or infinite: nothing
/// panics, and what is derived holds what it should.
pub fn tribox(data: &[u8]) {
    let mut input = Input(data);
    let mut three = || input.point();
    let points = [(); 4].map(|()| three());
    let (p, q) = (three(), three());
    let pose = Pose::affine([(); 3].map(|()| three()), three());
    let of_points = Tribox::of_points(points);
    if let Ok(tribox) = of_points {
        assert!(points.iter().all(|point| tribox.contains_point(*point)) && !tribox.is_empty());
        assert!(tribox.on_grid().contains(&tribox) && tribox.contains(&tribox.tightened()));
        assert!(!tribox.tightened().is_empty(), "{points:?}");
        if let Ok(moved) = tribox.moved(&pose) {
            assert!(!moved.is_empty());
        }
    }
    // Parameters that no points have.
    let mut any = of_points.unwrap_or(Tribox { low: [-1.0; SLABS], high: [1.0; SLABS] });
    any.low[3] = p[0];
    any.high[5] = p[1];
    for tribox in [any, any.tightened(), any.intersection(&Tribox::EMPTY), any.snapped(p[2])] {
        let boundary = tribox.boundary();
        let cleaned = boundary.cleaned();
        for face in 0..=FACES {
            assert!(boundary.corners(face).count() <= 8 && cleaned.corners(face).count() <= 8);
        }
        let _ = (tribox.clip(p, q), tribox.distance(p), tribox.contains_point(q), tribox.on_grid());
        let _ =
            (tribox.padded(q[0]), tribox.translated(q), tribox.moved(&pose), pose.bound([p, q]));
        if let Some((enter, leave)) = tribox.clip(p, q) {
            assert!(enter <= leave);
        }
    }
}
