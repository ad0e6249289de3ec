//! The boundary counts what it does; loops close; triboxes keep their words on small integers, where everything is exact.

use meshsweep_core::tribox::{Boundary, DIRECTIONS, FACES, Pose, SLABS, Scalar, Tribox, VERTICES, boundary};
use meshsweep_host_tests::oracle::polytope::{Dimension, HalfSpace, Polytope};
use std::cell::Cell;
use std::cmp::Ordering;
use std::ops::{Add, Neg, Sub};

thread_local! {
    static COUNTS: Cell<[u32; 3]> = const { Cell::new([0; 3]) };
}

/// A number that counts additions, halvings and comparisons.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Counted(f64);

fn count(what: usize) {
    COUNTS.with(|counts| {
        let mut now = counts.get();
        now[what] += 1;
        counts.set(now);
    });
}

impl Add for Counted {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        count(0);
        Counted(self.0 + other.0)
    }
}

impl Sub for Counted {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        count(0);
        Counted(self.0 - other.0)
    }
}

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        Counted(-self.0)
    }
}

impl PartialOrd for Counted {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        count(2);
        self.0.partial_cmp(&other.0)
    }
}

impl Scalar for Counted {
    const ZERO: Self = Counted(0.0);
    fn half(self) -> Self {
        count(1);
        Counted(0.5 * self.0)
    }
}

/// SplitMix64 (Steele, Lea & Flood 2014).
struct Rng(u64);

impl Rng {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    /// A few points with small integer coordinates: many coincide, lie in planes or on lines.
    fn points(&mut self) -> Vec<[f32; 3]> {
        let span = [2, 3, 5, 9, 65, 4097][self.below(6) as usize];
        let count = 1 + self.below(12);
        let flat = self.below(8);
        (0..count)
            .map(|_| {
                let mut point = [0; 3].map(|_: i32| self.below(span) as f32 - (span / 2) as f32);
                if flat < 3 {
                    point[flat as usize] = 1.0;
                }
                point
            })
            .collect()
    }
}

fn along(slab: usize, [x, y, z]: [f32; 3]) -> f32 {
    let [a, b, c] = DIRECTIONS[slab].map(f32::from);
    a * x + b * y + c * z
}

#[test]
fn no_boundary_takes_more_than_112_additions_24_halvings_24_comparisons() {
    let mut rng = Rng(1);
    let mut most = [0; 3];
    for _ in 0..20_000 {
        let tribox = Tribox::of_points(rng.points()).unwrap();
        COUNTS.with(|counts| counts.set([0; 3]));
        let scalar = |x: f32| Counted(f64::from(x));
        let _ = boundary(&tribox.low.map(scalar), &tribox.high.map(scalar));
        let counts = COUNTS.with(Cell::get);
        assert!(counts[0] >= 96 && counts[0] <= 112 && counts[1] == 24 && counts[2] <= 24, "{counts:?}");
        for (most, here) in most.iter_mut().zip(counts) {
            *most = here.max(*most);
        }
    }
    assert_eq!(most, [112, 24, 24], "the limits are reached");
}

/// Every edge of the 18 loops is run through once in each direction.
fn edges_are_paired(of: &Boundary<f32>) -> usize {
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
    let mut rng = Rng(2);
    for _ in 0..20_000 {
        let of = Tribox::of_points(rng.points()).unwrap().boundary();
        assert_eq!(edges_are_paired(&of), 48);
        assert!((0..FACES).all(|face| of.face(face).len() >= 4));
    }
}

#[test]
fn vertices_are_inside_all_slabs_and_on_those_whose_faces_hold_them() {
    let mut rng = Rng(3);
    for _ in 0..20_000 {
        let tribox = Tribox::of_points(rng.points()).unwrap();
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
            assert!(of.corners(face).all(|vertex| along(face / 2, vertex) == side[face / 2]), "{face}");
        }
    }
}

#[test]
fn faces_turn_counter_clockwise_from_outside() {
    let mut rng = Rng(4);
    for _ in 0..20_000 {
        let of = Tribox::of_points(rng.points()).unwrap().boundary();
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
fn points_make_tight_triboxes_and_tightening_changes_none() {
    let mut rng = Rng(5);
    for _ in 0..5_000 {
        let tribox = Tribox::of_points(rng.points()).unwrap();
        assert_eq!(tribox.tightened(), tribox);
    }
}

#[test]
fn tightened_intersections_touch_with_every_plane_or_are_empty() {
    let mut rng = Rng(6);
    let mut empty = 0;
    for _ in 0..5_000 {
        let (a, b) = (Tribox::of_points(rng.points()).unwrap(), Tribox::of_points(rng.points()).unwrap());
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
fn cleaned_boundaries_have_no_edge_of_no_length_and_obey_euler() {
    let mut rng = Rng(7);
    for _ in 0..20_000 {
        let tribox = Tribox::of_points(rng.points()).unwrap();
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

#[test]
fn snapping_moves_planes_outward_and_no_farther_than_told() {
    let mut rng = Rng(8);
    let mut fewer = 0;
    for _ in 0..300 {
        let tribox = Tribox::of_points(rng.points()).unwrap();
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
        Tribox::of_points([[0.0, 0.0, 0.0], [8.0, 7.0, 8.0], [7.0, 8.0, 8.0], [8.0, 8.0, 0.0]]).unwrap();
    assert_eq!(cut.snapped(0.0), cut);
    assert!(cut.snapped(1.0) != cut);
}

#[test]
fn a_grid_holds_all_and_makes_the_boundary_exact() {
    let mut rng = Rng(9);
    for _ in 0..5_000 {
        let scale = [1e-40f32, 1e-30, 1e-3, 1.0, 1e3, 1e30][rng.below(6) as usize];
        let points: Vec<_> = rng
            .points()
            .into_iter()
            .map(|p| p.map(|x| (x + (rng.below(1000) as f32) * 1e-3) * scale))
            .collect();
        let tight = Tribox::of_points(points).unwrap();
        let grid = tight.on_grid();
        assert!(grid.contains(&tight), "{tight:?} {grid:?}");
        let of = grid.boundary();
        let exact =
            boundary(&grid.low.map(|x| Counted(f64::from(x))), &grid.high.map(|x| Counted(f64::from(x))));
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
    assert!(Tribox::of_point([f32::NAN, 0.0, 0.0]).is_err() && Tribox::of_point([1e38, 0.0, 0.0]).is_err());
    assert!(Tribox::EMPTY.boundary().vertices.iter().flatten().all(|x| !x.is_finite()));
    assert!(!Tribox::EMPTY.overlaps(&tribox) && tribox.contains(&Tribox::EMPTY));
    assert_eq!(Tribox::EMPTY.tightened(), Tribox::EMPTY);
    assert_eq!(tribox.union(&Tribox::EMPTY), tribox);
}

#[test]
fn segments_are_clipped_outward() {
    let mut rng = Rng(10);
    let mut met = 0;
    for _ in 0..20_000 {
        let tribox = Tribox::of_points(rng.points()).unwrap();
        let mut end = || [0; 3].map(|_: i32| (rng.below(4001) as f32 - 2000.0) / 256.0);
        let (a, b) = (end(), end());
        let exact = |t: f64| {
            let p: [f64; 3] =
                std::array::from_fn(|k| f64::from(a[k]) + t * (f64::from(b[k]) - f64::from(a[k])));
            (0..SLABS).all(|slab| {
                let d = DIRECTIONS[slab].map(f64::from);
                let here = d[0] * p[0] + d[1] * p[1] + d[2] * p[2];
                f64::from(tribox.low[slab]) <= here && here <= f64::from(tribox.high[slab])
            })
        };
        let clipped = tribox.clip(a, b);
        for step in 0..=64 {
            let t = f64::from(step) / 64.0;
            if exact(t) {
                let (enter, leave) = clipped.expect("a point of the segment is inside");
                assert!(f64::from(enter) <= t && t <= f64::from(leave));
                met += 1;
            }
        }
        if let Some((enter, leave)) = clipped {
            let middle = f64::midpoint(f64::from(enter), f64::from(leave));
            assert!(leave - enter < 1e-5 || exact(middle), "{tribox:?} {a:?} {b:?} {clipped:?}");
        }
    }
    assert!(met > 1000, "{met}");
}

#[test]
fn distances_are_below_those_to_the_vertices_hull_and_exact_beyond_faces() {
    let mut rng = Rng(11);
    for _ in 0..5_000 {
        let points = rng.points();
        let tribox = Tribox::of_points(points.iter().copied()).unwrap();
        let p = [0; 3].map(|_: i32| (rng.below(4001) as f32 - 2000.0) / 64.0);
        let lower = f64::from(tribox.distance(p));
        for point in points {
            let way = glam::Vec3::from_array(p).as_dvec3() - glam::Vec3::from_array(point).as_dvec3();
            assert!(lower <= way.length());
        }
        if tribox.contains_point(p) {
            assert_eq!(lower, 0.0);
        }
    }
    let corners = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|bit| bit as f32));
    let cube = Tribox::of_points(corners).unwrap();
    assert!((cube.distance([0.5, 0.5, 3.0]) - 2.0).abs() < 1e-5);
    for scale in [1e-30f32, 1e-10, 1.0, 1e10, 1e30] {
        let cube = Tribox::of_points([[0.0; 3], [scale; 3]]).unwrap();
        let distance = cube.distance([3.0 * scale; 3]);
        assert!(distance <= 3.465 * scale && distance > 3.46 * scale, "{scale} {distance}");
    }
    assert_eq!(Tribox::EMPTY.distance([0.0; 3]), f32::INFINITY);
}

#[test]
fn what_is_moved_stays_inside() {
    let mut rng = Rng(12);
    for _ in 0..3_000 {
        let points = rng.points();
        let (sine, cosine) = (rng.below(6283) as f64 * 1e-3).sin_cos();
        let (s, c) = (sine as f32, cosine as f32);
        let t = [0; 3].map(|_: i32| rng.below(1000) as f32 * 0.1 - 50.0);
        let pose = Pose {
            rotation: [[c, -s, 0.0], [0.6 * s, 0.6 * c, -0.8], [0.8 * s, 0.8 * c, 0.6]],
            translation: t,
        };
        let tight = pose.bound(points.iter().copied()).unwrap();
        let loose = Tribox::of_points(points.iter().copied()).unwrap().moved(&pose).unwrap();
        for point in &points {
            let p = point.map(f64::from);
            let q: [f64; 3] = std::array::from_fn(|k| {
                let row = pose.rotation[k].map(f64::from);
                row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + f64::from(t[k])
            });
            for (slab, direction) in DIRECTIONS.iter().enumerate() {
                let d = direction.map(f64::from);
                let here = d[0] * q[0] + d[1] * q[1] + d[2] * q[2];
                for bound in [&tight, &loose] {
                    assert!(f64::from(bound.low[slab]) <= here && here <= f64::from(bound.high[slab]));
                }
            }
        }
    }
    let point = Tribox::of_point([1.0, 2.0, 3.0]).unwrap();
    let there = point.moved(&Pose::IDENTITY).unwrap();
    assert!(there.contains(&point) && there.high[0] - there.low[0] < 3e-5);
    assert!(Pose { rotation: [[3.0; 3]; 3], translation: [0.0; 3] }.bound([[0.0; 3]]).is_err());
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
    let mut rng = Rng(13);
    let mut dimensions = [0u32; 4];
    for round in 0..100_000 {
        let scale = if round % 5 == 0 { 1024.0 } else { 1.0 };
        let points: Vec<_> = rng.points().into_iter().map(|p| p.map(|x| x * scale + 3.0)).collect();
        let mut tribox = Tribox::of_points(points).unwrap();
        if round % 3 == 0 {
            let other = Tribox::of_points(rng.points()).unwrap();
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
    assert!(dimensions.iter().all(|&count| count > 1000), "{dimensions:?}");
}

#[test]
fn boundaries_in_f32_are_within_ten_roundings() {
    let mut rng = Rng(14);
    let mut unit = || (rng.next() >> 40) as f32 / (1u64 << 24) as f32;
    for round in 0..20_000 {
        let (flat, away) =
            (if round % 3 == 0 { 1e-6 } else { 1.0 }, if round % 4 == 0 { 100.0 } else { 0.0 });
        let points: Vec<[f32; 3]> =
            (0..4 + round % 40).map(|_| [unit() + away, unit() * flat, unit() - 0.5]).collect();
        let tribox = Tribox::of_points(points.iter().copied()).unwrap();
        let most = tribox.slabs().fold(0f32, |most, (low, high)| most.max(low.abs()).max(high.abs()));
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

#[test]
fn what_f32_cannot_sum_is_neither_clear_nor_far() {
    let cube = Tribox::of_points([[-1.0; 3], [1.0; 3], [1.0, -1.0, 1.0], [-1.0, 1.0, -1.0]]).unwrap();
    assert!(
        cube.clip([2e38, -3.0, 0.0], [-2e38, 3.0, 0.0])
            .is_some_and(|(enter, leave)| enter <= 0.5 && 0.5 <= leave)
    );
    assert!(
        cube.clip([2e38, 0.0, 0.0], [-2e38, 0.0, 0.0])
            .is_some_and(|(enter, leave)| enter <= 0.5 && 0.5 <= leave)
    );
    let distance = cube.distance([2e38, 2e38, 0.0]);
    assert!(distance > 1.9e38 && distance < 2.83e38, "{distance}");
    // One unit of the subnormal range, by √2 outward.
    let ulp = f32::from_bits(1);
    let padded = Tribox::of_point([0.0; 3]).unwrap().padded(ulp).unwrap();
    assert!(padded.high[3] >= f32::from_bits(2) && padded.high[0] == ulp);
}
