//! Bounds of distances and of segments are below the truth, and are those of the nearest leaf.

use super::{blob, mesh};
use meshsweep_core::{Budget, Ended, QueryError, ScratchEntry, Triboxes};
use meshsweep_host_tests::generate::{Rng, bracket, groove_block, scaled, torus};
use meshsweep_host_tests::oracle::{distance_to_mesh, meets};

#[test]
fn distances_are_those_of_the_nearest_leaf_and_below_the_mesh_s() {
    let mut rng = Rng::new(21);
    for triangles in [
        torus(2.0, 0.75, 24, 12),
        bracket(),
        scaled(&groove_block(), 1e-30),
        scaled(&groove_block(), 1e30),
    ] {
        let mesh = mesh(&triangles);
        let bytes = blob(&mesh, 32);
        let all = Triboxes::open(&bytes).expect("opens");
        let root = all.node(0).expect("a root");
        let [x, y, z, ..] = root.low;
        let [xx, yy, zz, ..] = root.high;
        let mut few = 0;
        for run in 0..300 {
            let triboxes = all.coarser([1, 4, 32][run % 3]);
            let p = rng.point_in(
                [2.0 * x - xx, 2.0 * y - yy, 2.0 * z - zz],
                [2.0 * xx - x, 2.0 * yy - y, 2.0 * zz - z],
            );
            let mut stack = vec![ScratchEntry::EMPTY; all.depth() as usize + 2];
            let answer = triboxes.distance(p, Budget::EXACT, &mut stack).expect("answered");
            let brute = triboxes
                .leaves()
                .map(|(_, tribox)| tribox.distance(p))
                .fold(f32::INFINITY, f32::min);
            // A parent's bound may be a little above a child's, and is as good.
            assert!(
                answer.lower >= brute && answer.lower <= brute * (1.0 + 1e-5),
                "{answer:?} {brute}"
            );
            let truth = distance_to_mesh(p, &mesh.positions, &mesh.triangles);
            assert!(f64::from(answer.lower) <= truth.upper, "{answer:?} {truth:?}");
            assert_eq!(answer.ended, Ended::Exact);
            few += usize::from(answer.work.bounds < triboxes.node_count());
            let short = triboxes.distance(p, Budget::EXACT, &mut stack[..1]).expect("answered");
            assert!(
                short.lower <= answer.lower
                    && (short.ended == Ended::Scratch || triboxes.leaf_count() == 1)
            );
        }
        assert!(few > 100, "{few}: nothing was spared");
    }
}

#[test]
fn segments_are_clear_of_the_mesh_before_the_bound() {
    let mut rng = Rng::new(22);
    for triangles in [torus(2.0, 0.75, 24, 12), bracket()] {
        let mesh = mesh(&triangles);
        let bytes = blob(&mesh, 32);
        let triboxes = Triboxes::open(&bytes).expect("opens");
        let root = triboxes.node(0).expect("a root");
        let low = [0, 1, 2].map(|k| root.low[k] - 0.2 * (root.high[k] - root.low[k]));
        let high = [0, 1, 2].map(|k| root.high[k] + 0.2 * (root.high[k] - root.low[k]));
        let mut stack = vec![ScratchEntry::EMPTY; triboxes.depth() as usize + 2];
        let (mut clear, mut hit) = (0, 0);
        for _ in 0..400 {
            let [a, b] = [(); 2].map(|()| rng.point_in(low, high));
            let answer = triboxes.clip(a, b, Budget::EXACT, &mut stack).expect("answered");
            let inside = triboxes.leaves().filter_map(|(_, tribox)| tribox.clip(a, b));
            let brute = inside.map(|(enter, _)| enter).fold(f32::INFINITY, f32::min);
            assert!(
                answer.lower >= brute.max(0.0)
                    && (answer.lower <= brute.max(0.0) + 1e-5 || brute == answer.lower)
            );
            assert_eq!(answer.lower.is_infinite(), answer.node.is_none());
            // The part before the bound, a little short of it for the end is rounded.
            let t = if answer.lower.is_infinite() { 1.0 } else { answer.lower - 1e-5 };
            let end = if t >= 1.0 { b } else { [0, 1, 2].map(|k| a[k] + t * (b[k] - a[k])) };
            if t > 0.0 {
                let met = (0..mesh.triangles.len())
                    .any(|i| meets(a, end, mesh.corners(i).expect("one")).is_some());
                assert!(!met, "{a:?} {b:?} {answer:?}");
                clear += 1;
            }
            hit += usize::from(answer.node.is_some());
        }
        assert!(clear > 100 && hit > 100, "{clear} {hit}");
    }
}

#[test]
fn what_is_no_point_is_refused() {
    let bytes = blob(&mesh(&torus(2.0, 0.75, 8, 6)), 4);
    let triboxes = Triboxes::open(&bytes).expect("opens");
    let stack = &mut [ScratchEntry::EMPTY; 8];
    let fine = [0.0; 3];
    for (x, error) in [
        (f32::NAN, QueryError::NotFinite),
        (f32::INFINITY, QueryError::NotFinite),
        (2e36, QueryError::OutOfDomain),
    ] {
        let odd = [0.0, x, 1.0];
        assert_eq!(triboxes.distance(odd, Budget::EXACT, stack).unwrap_err(), error);
        assert_eq!(triboxes.clip(odd, fine, Budget::EXACT, stack).unwrap_err(), error);
        assert_eq!(triboxes.clip(fine, odd, Budget::EXACT, stack).unwrap_err(), error);
    }
    assert_eq!(triboxes.distance(fine, Budget::EXACT, &mut []).unwrap_err(), QueryError::NoScratch);
    let bad = Budget::EXACT.with_relative(-1.0);
    assert_eq!(triboxes.distance(fine, bad, stack).unwrap_err(), QueryError::Tolerance);
    assert_eq!(triboxes.clip(fine, fine, bad, stack).unwrap_err(), QueryError::Tolerance);
}
