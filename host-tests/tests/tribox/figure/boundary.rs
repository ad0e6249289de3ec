//! Vertices and faces.

use super::along;
use super::counted::{COUNTS, Counted};
use super::points::points;
use meshsweep_core::internal::tribox::{DIRECTIONS, FACES, SLABS, VERTICES, boundary};
use meshsweep_core::{Boundary, Tribox};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::oracle::polytope::{Dimension, HalfSpace, Polytope};
use std::cell::Cell;

#[test]
fn no_boundary_takes_more_than_112_additions_24_halvings_24_comparisons() {
    let mut rng = Rng::new(1);
    let mut most = [0; 3];
    for _ in 0..20_000 {
        let tribox = Tribox::of_points(points(&mut rng)).unwrap();
        COUNTS.with(|counts| counts.set([0; 3]));
        let scalar = |x: f32| Counted(f64::from(x));
        let _ = boundary(&tribox.low.map(scalar), &tribox.high.map(scalar));
        let counts = COUNTS.with(Cell::get);
        assert!(
            counts[0] >= 96 && counts[0] <= 112 && counts[1] == 24 && counts[2] <= 24,
            "{counts:?}"
        );
        for (most, here) in most.iter_mut().zip(counts) {
            *most = here.max(*most);
        }
    }
    assert_eq!(most, [112, 24, 24], "the limits are reached");
}

/// Every edge of the 18 loops is run through once in each direction.
fn edges_are_paired(of: &Boundary) -> usize {
    let mut seen = [[0u8; VERTICES]; VERTICES];
    for face in 0..FACES {
        let vertices = of.face(face);
        for (i, &from) in vertices.iter().enumerate() {
            let to = vertices[(i + 1) % vertices.len()];
            seen[from as usize][to as usize] += 1;
        }
    }
    let mut edges = 0;
    for (from, row) in seen.iter().enumerate() {
        for (to, &count) in row.iter().enumerate() {
            assert_eq!(count, seen[to][from], "edge {from} {to}");
            assert!(count <= 1);
            edges += usize::from(count);
        }
    }
    edges / 2
}

#[test]
fn there_are_always_32_vertices_48_edges_18_faces() {
    let mut rng = Rng::new(2);
    for _ in 0..20_000 {
        let of = Tribox::of_points(points(&mut rng)).unwrap().boundary();
        assert_eq!(edges_are_paired(&of), 48);
        assert!((0..FACES).all(|face| of.face(face).len() >= 4));
    }
}

#[test]
fn vertices_are_inside_all_slabs_and_on_those_whose_faces_hold_them() {
    let mut rng = Rng::new(3);
    for _ in 0..20_000 {
        let tribox = Tribox::of_points(points(&mut rng)).unwrap();
        let of = tribox.boundary();
        for vertex in of.vertices {
            for slab in 0..SLABS {
                let here = along(slab, vertex);
                assert!(
                    tribox.low[slab] <= here && here <= tribox.high[slab],
                    "{tribox:?} {vertex:?} {slab}"
                );
            }
        }
        for face in 0..FACES {
            let side = if face % 2 == 0 { &tribox.low } else { &tribox.high };
            assert!(
                of.corners(face).all(|vertex| along(face / 2, vertex) == side[face / 2]),
                "{face}"
            );
        }
    }
}

#[test]
fn faces_turn_counter_clockwise_from_outside() {
    let mut rng = Rng::new(4);
    for _ in 0..20_000 {
        let of = Tribox::of_points(points(&mut rng)).unwrap().boundary();
        for face in 0..FACES {
            let corners: Vec<glam::DVec3> =
                of.corners(face).map(|v| glam::Vec3::from_array(v).as_dvec3()).collect();
            let area = (0..corners.len())
                .map(|i| corners[i].cross(corners[(i + 1) % corners.len()]))
                .sum::<glam::DVec3>();
            let outward = glam::DVec3::from_array(DIRECTIONS[face / 2].map(f64::from));
            let outward = if face % 2 == 0 { -outward } else { outward };
            assert_eq!(area.cross(outward), glam::DVec3::ZERO);
            assert!(area.dot(outward) >= 0.0, "{face} {corners:?}");
        }
    }
}

#[test]
fn cleaned_boundaries_have_no_edge_of_no_length_and_obey_euler() {
    let mut rng = Rng::new(7);
    for _ in 0..20_000 {
        let tribox = Tribox::of_points(points(&mut rng)).unwrap();
        let of = tribox.boundary().cleaned();
        let mut used = [false; VERTICES];
        let mut faces = 0;
        for face in 0..FACES {
            let corners: Vec<_> = of.corners(face).collect();
            faces += usize::from(!corners.is_empty());
            assert!((0..corners.len()).all(|i| corners[i] != corners[(i + 1) % corners.len()]));
            of.face(face).iter().for_each(|&vertex| used[vertex as usize] = true);
        }
        let vertices = used.iter().filter(|used| **used).count();
        let solid = tribox.slabs().all(|(low, high)| low < high);
        if solid {
            assert_eq!(vertices + faces, edges_are_paired(&of) + 2, "{tribox:?} {of:?}");
        }
    }
}

/// The 18 half-spaces of parameters that are multiples of an eighth, in eighths.
fn half_spaces(tribox: &Tribox) -> Vec<HalfSpace> {
    let eighths = |x: f32| (f64::from(x) * 8.0) as i64;
    let sides = DIRECTIONS.iter().zip(tribox.slabs()).flat_map(|(direction, (low, high))| {
        let normal = direction.map(i64::from);
        [HalfSpace::new(normal.map(|n| -n), -eighths(low)), HalfSpace::new(normal, eighths(high))]
    });
    sides.collect()
}

/// Vertices of an exact polytope of [`half_spaces`], as f32.
fn vertices(of: &Polytope) -> Vec<[u32; 3]> {
    let bits = of.vertices().iter().map(|vertex| {
        let [x, y, z] = vertex.numerator.map(|n| n as f64 / (8.0 * vertex.denominator as f64));
        [x as f32 + 0.0, y as f32 + 0.0, z as f32 + 0.0].map(f32::to_bits)
    });
    let mut all: Vec<_> = bits.collect();
    all.sort_unstable();
    all.dedup();
    all
}

#[test]
fn boundaries_are_the_intersections_of_their_half_spaces() {
    let mut rng = Rng::new(13);
    let mut dimensions = [0u32; 4];
    for round in 0..20_000 {
        let scale = if round % 5 == 0 { 1024.0 } else { 1.0 };
        let moved: Vec<_> =
            points(&mut rng).into_iter().map(|p| p.map(|x| x * scale + 3.0)).collect();
        let mut tribox = Tribox::of_points(moved).unwrap();
        if round % 3 == 0 {
            let other = Tribox::of_points(points(&mut rng)).unwrap();
            tribox = tribox.intersection(&other.translated([3.0; 3]).unwrap());
        }
        let exact = Polytope::new(&half_spaces(&tribox));
        let tight = tribox.tightened();
        assert_eq!(exact.is_empty(), tight.is_empty(), "{tribox:?}");
        if exact.is_empty() {
            continue;
        }
        let touched = Polytope::new(&half_spaces(&tight));
        assert!((0..FACES).all(|plane| touched.is_tight(plane)), "{tight:?}");
        let boundary = tight.boundary();
        let mut found: Vec<_> =
            boundary.vertices.iter().map(|vertex| vertex.map(|x| (x + 0.0).to_bits())).collect();
        found.sort_unstable();
        found.dedup();
        assert_eq!(found, vertices(&exact), "{tribox:?}");
        let dimension = exact.dimension();
        dimensions[match dimension {
            Dimension::Solid => 3,
            Dimension::Polygon => 2,
            Dimension::Segment => 1,
            _ => 0,
        }] += 1;
        if dimension == Dimension::Solid {
            let cleaned = boundary.cleaned();
            let faces = (0..FACES).filter(|&face| !cleaned.face(face).is_empty()).count();
            assert_eq!(faces, exact.distinct_faces().count(), "{tribox:?}");
        }
    }
    assert!(dimensions.iter().all(|&count| count > 200), "{dimensions:?}");
}

#[test]
fn boundaries_in_f32_are_within_ten_roundings() {
    let mut rng = Rng::new(14);
    let mut unit = || (rng.next_u64() >> 40) as f32 / (1u64 << 24) as f32;
    for round in 0..20_000 {
        let (flat, away) =
            (if round % 3 == 0 { 1e-6 } else { 1.0 }, if round % 4 == 0 { 100.0 } else { 0.0 });
        let points: Vec<[f32; 3]> =
            (0..4 + round % 40).map(|_| [unit() + away, unit() * flat, unit() - 0.5]).collect();
        let tribox = Tribox::of_points(points.iter().copied()).unwrap();
        let most =
            tribox.slabs().fold(0f32, |most, (low, high)| most.max(low.abs()).max(high.abs()));
        let doubt = f64::from(most) * 10.0 / f64::from(1u32 << 24);
        let single = tribox.boundary();
        let exact = |x: f32| Counted(f64::from(x));
        let double = boundary(&tribox.low.map(exact), &tribox.high.map(exact));
        for vertex in double.vertices {
            let near = single.vertices.iter().any(|other| {
                other.iter().zip(vertex).all(|(x, exact)| (f64::from(*x) - exact.0).abs() <= doubt)
            });
            assert!(near, "{tribox:?} {vertex:?}");
        }
        for vertex in single.vertices {
            for (slab, (low, high)) in tribox.slabs().enumerate() {
                let d = DIRECTIONS[slab].map(f64::from);
                let here = (0..3).map(|k| d[k] * f64::from(vertex[k])).sum::<f64>();
                let doubt = if slab < 3 { doubt } else { 2.0 * doubt };
                assert!(f64::from(low) - doubt <= here && here <= f64::from(high) + doubt);
            }
        }
    }
}
