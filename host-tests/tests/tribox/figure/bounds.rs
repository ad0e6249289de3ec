//! Parameters: their closure, what is derived from them, and rounding.

use super::along;
use super::counted::Counted;
use super::points::points;
use meshsweep_core::Tribox;
use meshsweep_core::internal::tribox::{FACES, SLABS, boundary};
use meshsweep_host_tests::generate::Rng;

#[test]
fn points_make_tight_triboxes_and_tightening_changes_none() {
    let mut rng = Rng::new(5);
    for _ in 0..5_000 {
        let tribox = Tribox::of_points(points(&mut rng)).unwrap();
        assert_eq!(tribox.tightened(), tribox);
    }
}

#[test]
fn tightened_intersections_touch_with_every_plane_or_are_empty() {
    let mut rng = Rng::new(6);
    let mut empty = 0;
    for _ in 0..5_000 {
        let (a, b) = (
            Tribox::of_points(points(&mut rng)).unwrap(),
            Tribox::of_points(points(&mut rng)).unwrap(),
        );
        let both = a.intersection(&b);
        let tight = both.tightened();
        if tight.is_empty() {
            empty += 1;
            continue;
        }
        assert!(a.overlaps(&b) && both.contains(&tight) && tight.tightened() == tight);
        let of = tight.boundary();
        assert!(of.vertices.iter().all(|&vertex| both.contains_point(vertex)), "{both:?}");
        for slab in 0..SLABS {
            assert!(of.vertices.iter().any(|&vertex| along(slab, vertex) == tight.high[slab]));
            assert!(of.vertices.iter().any(|&vertex| along(slab, vertex) == tight.low[slab]));
        }
    }
    assert!(empty > 100, "{empty}");
}

#[test]
fn snapping_moves_planes_outward_and_no_farther_than_told() {
    let mut rng = Rng::new(8);
    let mut fewer = 0;
    for _ in 0..300 {
        let tribox = Tribox::of_points(points(&mut rng)).unwrap();
        let tolerance = rng.below(4) as f32;
        let snapped = tribox.snapped(tolerance);
        assert!(snapped.contains(&tribox));
        for slab in 0..SLABS {
            let length = if slab < 3 { 1.0 } else { std::f32::consts::SQRT_2 };
            assert!(snapped.high[slab] - tribox.high[slab] <= tolerance * length * 1.000_001);
            assert!(tribox.low[slab] - snapped.low[slab] <= tolerance * length * 1.000_001);
        }
        let faces = |tribox: &Tribox| {
            let of = tribox.boundary().cleaned();
            (0..FACES).filter(|&face| !of.face(face).is_empty()).count()
        };
        // A flat one may become solid.
        let solid = tribox.slabs().all(|(low, high)| low < high);
        assert!(!solid || faces(&snapped) <= faces(&tribox));
        fewer += usize::from(faces(&snapped) < faces(&tribox));
    }
    assert!(fewer > 50, "{fewer}");
    let cut =
        Tribox::of_points([[0.0, 0.0, 0.0], [8.0, 7.0, 8.0], [7.0, 8.0, 8.0], [8.0, 8.0, 0.0]])
            .unwrap();
    assert_eq!(cut.snapped(0.0), cut);
    assert!(cut.snapped(1.0) != cut);
}

#[test]
fn a_grid_holds_all_and_makes_the_boundary_exact() {
    let mut rng = Rng::new(9);
    for _ in 0..5_000 {
        let scale = [1e-40f32, 1e-30, 1e-3, 1.0, 1e3, 1e30][rng.below(6)];
        let points: Vec<_> = points(&mut rng)
            .into_iter()
            .map(|p| p.map(|x| (x + (rng.below(1000) as f32) * 1e-3) * scale))
            .collect();
        let tight = Tribox::of_points(points).unwrap();
        let grid = tight.on_grid();
        assert!(grid.contains(&tight), "{tight:?} {grid:?}");
        let of = grid.boundary();
        let exact = boundary(
            &grid.low.map(|x| Counted(f64::from(x))),
            &grid.high.map(|x| Counted(f64::from(x))),
        );
        for (vertex, exact) in of.vertices.iter().zip(exact.vertices) {
            assert_eq!(vertex.map(f64::from), exact.map(|x| x.0));
        }
        for vertex in of.vertices {
            assert!(grid.contains_point(vertex));
        }
    }
}

#[test]
fn padding_and_translation_hold_what_they_should() {
    let tribox = Tribox::of_points([[0.1, 0.2, 0.3], [1.0, -2.0, 0.7]]).unwrap();
    let moved = tribox.translated([0.3, 1e-9, -7.7]).unwrap();
    assert!(moved.contains_point([0.1 + 0.3, 0.2, 0.3 - 7.7]));
    let padded = tribox.padded(0.5).unwrap();
    assert!(padded.contains(&tribox) && padded.contains_point([1.0 + 0.35, -2.0 - 0.35, 0.7]));
    assert!(tribox.padded(-1.0).is_err() && tribox.padded(f32::NAN).is_err());
    assert!(
        Tribox::EMPTY.padded(1.0).unwrap().is_empty()
            && Tribox::EMPTY.translated([1.0; 3]).unwrap().is_empty()
    );
    assert!(
        Tribox::of_point([f32::NAN, 0.0, 0.0]).is_err()
            && Tribox::of_point([1e38, 0.0, 0.0]).is_err()
    );
    assert!(Tribox::EMPTY.boundary().vertices.iter().flatten().all(|x| !x.is_finite()));
    assert!(!Tribox::EMPTY.overlaps(&tribox) && tribox.contains(&Tribox::EMPTY));
    assert_eq!(Tribox::EMPTY.tightened(), Tribox::EMPTY);
    assert_eq!(tribox.union(&Tribox::EMPTY), tribox);
}
