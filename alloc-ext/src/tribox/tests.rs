//! What a hierarchy promises, against oracles that share no code with it.

use super::*;
use crate::error::BuildError;
use crate::mesh::{Mesh, RawMesh, read, repair};
use crate::random::SplitMix;
use meshsweep_core::Bvh;
use meshsweep_core::internal::tribox::DIRECTIONS;
use meshsweep_core::{Tribox, TriboxError};
use std::path::Path;

type Point = [f64; 3];

fn fixture(name: &str) -> Mesh {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name);
    repair(read(&path).unwrap()).unwrap().0
}

fn repaired(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Mesh {
    repair(RawMesh::from_f32(positions, triangles)).unwrap().0
}

/// Blocks, each between two corners; those named after the first `solid` are cavities.
fn blocks(corners: &[[[f32; 3]; 2]], solid: usize) -> Mesh {
    const FACES: [[u32; 4]; 6] =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let mut mesh = Mesh::default();
    for (number, ends) in corners.iter().enumerate() {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend((0..8).map(|i: usize| std::array::from_fn(|k| ends[i >> k & 1][k])));
        for [a, b, c, d] in FACES.map(|face| face.map(|v| v + first)) {
            let [b, d] = if number < solid { [b, d] } else { [d, b] };
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh::new(mesh.positions, mesh.triangles)
}

fn split(mesh: &Mesh, options: &SplitOptions) -> Hierarchy {
    let bytes = box_tree(mesh).unwrap();
    Hierarchy::new(mesh, &Bvh::open(&bytes).unwrap(), options).unwrap()
}

fn options(leaves: usize) -> SplitOptions {
    SplitOptions { leaves, ..SplitOptions::default() }
}

/// Points of the surface, exactly: weights are 64ths, so that f64 holds all products and sums.
fn on_surface(mesh: &Mesh, count: usize) -> Vec<Point> {
    let mut random = SplitMix::new(7);
    let of = |_| {
        let t = (random.roll() * mesh.triangles.len() as f64) as usize;
        let u = (random.roll() * 65.0).floor();
        let v = (random.roll() * (65.0 - u)).floor();
        let [a, b, c] = mesh.corners(t).unwrap().map(|p| p.map(f64::from));
        std::array::from_fn(|k| (a[k] * (64.0 - u - v) + b[k] * u + c[k] * v) / 64.0)
    };
    (0..count).map(of).collect()
}

/// Winding number, by solid angles (van Oosterom & Strackee).
fn winding(mesh: &Mesh, p: Point) -> f64 {
    let dot = |a: Point, b: Point| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let angle = |t: usize| {
        let [a, b, c] =
            mesh.corners(t).unwrap().map(|v| std::array::from_fn(|k| f64::from(v[k]) - p[k]));
        let cross =
            [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
        let [la, lb, lc] = [a, b, c].map(|v| dot(v, v).sqrt());
        2.0 * dot(a, cross).atan2(la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb)
    };
    (0..mesh.triangles.len()).map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

/// Random points whose winding number is not 0.
fn in_solid(mesh: &Mesh, count: usize) -> Vec<Point> {
    let bounds = Tribox::of_points(mesh.positions.iter().copied()).unwrap();
    let mut random = SplitMix::new(99);
    let mut of = |_| {
        std::array::from_fn(|k| {
            let (low, high) = (f64::from(bounds.low[k]), f64::from(bounds.high[k]));
            f64::from((low + random.roll() * (high - low)) as f32)
        })
    };
    (0..count).map(&mut of).filter(|&p| winding(mesh, p).abs() > 0.5).collect()
}

/// In f64, where sums of such points are exact.
fn holds(tribox: &Tribox, p: Point) -> bool {
    DIRECTIONS.iter().zip(tribox.slabs()).all(|(d, (low, high))| {
        let along: f64 = d.iter().zip(p).map(|(&d, x)| f64::from(d) * x).sum();
        f64::from(low) <= along && along <= f64::from(high)
    })
}

fn demand_cover(hierarchy: &Hierarchy, points: &[Point]) {
    for count in [1, 2, 3, 8, 32, usize::MAX] {
        let leaves = hierarchy.leaves(count);
        for &p in points {
            let nodes = || leaves.iter().map(|&leaf| &hierarchy.nodes[leaf as usize]);
            assert!(nodes().any(|node| holds(&node.tribox, p)), "{p:?} of {count}");
            assert!(nodes().any(|node| holds(&node.proxy, p)), "{p:?} of {count}");
        }
    }
}

/// Children within their parents and on their sides of the planes; volumes that never grow.
fn demand_order(hierarchy: &Hierarchy) {
    let volume = |node: u32| Extent::of(&hierarchy.nodes[node as usize].tribox).volume;
    for node in &hierarchy.nodes {
        assert!(node.proxy.contains(&node.tribox) && !node.tribox.is_empty());
        let Some(Split { slab, at, children }) = node.split else { continue };
        let [low, high] = children.map(|child| hierarchy.nodes[child as usize]);
        assert!(node.tribox.contains(&low.tribox) && node.tribox.contains(&high.tribox));
        assert!(low.tribox.high[slab] <= at && at <= high.tribox.low[slab], "siblings overlap");
        assert!(low.proxy.high[slab] <= at && at <= high.proxy.low[slab], "proxies overlap");
    }
    let all = Extent::of(&hierarchy.nodes[0].tribox).volume;
    let mut last = f64::INFINITY;
    for count in 1..=hierarchy.order.len() + 1 {
        let leaves = hierarchy.leaves(count);
        assert_eq!(leaves.len(), count);
        let now: f64 = leaves.into_iter().map(volume).sum();
        assert!(now <= last + 1e-12 * all, "{now} after {last}");
        last = now;
    }
}

#[test]
fn solids_are_covered_with_their_insides() {
    let overlapping = blocks(&[[[0.0; 3], [2.0; 3]], [[1.5, 0.5, 0.25], [4.0, 1.0, 1.75]]], 2);
    let hollow = blocks(&[[[0.0; 3], [4.0; 3]], [[0.5; 3], [3.0, 3.5, 3.25]]], 1);
    // The large ones are split less often, which takes most of the time.
    for (mesh, leaves) in [
        (fixture("torus.ply"), 12),
        (fixture("bracket.stl"), 6),
        (fixture("groove.obj"), 40),
        (overlapping, 40),
        (hollow, 40),
    ] {
        let hierarchy = split(&mesh, &options(leaves));
        assert!(hierarchy.is_solid && hierarchy.measure == Measure::Volume);
        demand_order(&hierarchy);
        demand_cover(&hierarchy, &on_surface(&mesh, 2000));
        let inside = in_solid(&mesh, 1000);
        assert!(inside.len() > 50, "the oracle finds an inside");
        demand_cover(&hierarchy, &inside);
    }
}

#[test]
fn insides_hold_where_the_plane_is_chosen_by_area_and_at_the_thickest_slab() {
    let mesh = blocks(&[[[0.0; 3], [2.0; 3]], [[1.5, 0.5, 0.25], [4.0, 1.0, 1.75]]], 2);
    for planes in [Planes::Thickest, Planes::Nine(2)] {
        let any = SplitOptions {
            measure: Some(Measure::Area),
            planes,
            least_gain: f64::NEG_INFINITY,
            ..options(32)
        };
        let hierarchy = split(&mesh, &any);
        assert_eq!(hierarchy.order.len(), 31);
        demand_order(&hierarchy);
        demand_cover(&hierarchy, &in_solid(&mesh, 2000));
    }
}

fn volume(hierarchy: &Hierarchy) -> f64 {
    proxies(hierarchy, usize::MAX).iter().map(|tribox| Extent::of(tribox).volume).sum()
}

#[test]
fn a_hole_is_found_although_no_single_split_shows_it() {
    let mesh = fixture("torus.ply");
    let blind = split(&mesh, &SplitOptions { foresight: 0.0, ..options(16) });
    let seeing = split(&mesh, &options(16));
    assert!(volume(&seeing) < 0.85 * volume(&blind), "{} {}", volume(&seeing), volume(&blind));
}

#[test]
fn nine_directions_leave_no_more_void_than_the_thickest_slab() {
    let mesh = fixture("torus.ply");
    let paper =
        SplitOptions { measure: Some(Measure::Volume), planes: Planes::Thickest, ..options(16) };
    assert!(volume(&split(&mesh, &options(16))) <= volume(&split(&mesh, &paper)));
}

#[test]
fn a_large_least_gain_ends_splitting_early() {
    let eager = SplitOptions { least_gain: 0.2, ..options(64) };
    assert!(split(&fixture("torus.ply"), &eager).order.len() < 63);
}

#[test]
fn of_an_open_mesh_the_surface_is_covered() {
    let mut mesh = fixture("torus.ply");
    mesh.triangles.truncate(mesh.triangles.len() - 40);
    mesh.source.truncate(mesh.triangles.len());
    let hierarchy = split(&mesh, &options(48));
    assert!(!hierarchy.is_solid);
    demand_order(&hierarchy);
    demand_cover(&hierarchy, &on_surface(&mesh, 3000));
}

#[test]
fn flat_meshes_are_split_by_area_and_stay_flat() {
    let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [1.0, 1.0], [1.0, 4.0], [0.0, 4.0]];
    let positions = corners.map(|[x, y]| [x, y, 0.3]);
    let mesh = repaired(&positions, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]);
    let hierarchy = split(&mesh, &options(8));
    assert_eq!(hierarchy.measure, Measure::Area);
    demand_cover(&hierarchy, &on_surface(&mesh, 500));
    let area: f64 = proxies(&hierarchy, 8).iter().map(|tribox| Extent::of(tribox).area).sum();
    assert!((area - 14.0).abs() < 1e-3, "{area}");
    assert!(
        proxies(&hierarchy, 8)
            .iter()
            .all(|tribox| tribox.low[2] >= 0.29999 && tribox.high[2] <= 0.30001)
    );
}

#[test]
fn a_single_triangle_is_covered_at_every_scale() {
    for scale in [1e-37f32, 1e-30, 1.0, 1e30, 1e36] {
        let positions =
            [[0.1, 0.2, 0.3], [1.0, 0.4, 0.2], [0.3, 0.9, 0.8f32]].map(|p| p.map(|x| x * scale));
        let mesh = Mesh::new(positions.to_vec(), vec![[0, 1, 2]]);
        let hierarchy = split(&mesh, &options(8));
        demand_cover(&hierarchy, &on_surface(&mesh, 500));
        demand_order(&hierarchy);
        assert!(!surface(&proxies(&hierarchy, 8)).triangles.is_empty());
    }
}

#[test]
fn solids_are_covered_at_every_scale_and_far_from_the_origin() {
    for scale in [1e-30f32, 1e30] {
        let mut mesh = fixture("torus.ply");
        mesh.positions.iter_mut().flatten().for_each(|x| *x *= scale);
        let hierarchy = split(&mesh, &options(6));
        assert!(hierarchy.is_solid);
        demand_order(&hierarchy);
        demand_cover(&hierarchy, &on_surface(&mesh, 500));
    }
    let mut mesh = fixture("torus.ply");
    mesh.positions.iter_mut().for_each(|p| p[0] += 1e4);
    let hierarchy = split(&mesh, &options(6));
    demand_cover(&hierarchy, &on_surface(&mesh, 500));
    demand_cover(&hierarchy, &in_solid(&mesh, 300));
}

#[test]
fn coordinates_beyond_the_domain_are_refused() {
    let beyond = BuildError::Triboxes(TriboxError::OutOfDomain);
    for (x, wanted) in [(3e38, beyond), (f32::NAN, BuildError::NotFinite { vertex: 1 })] {
        let fine = Mesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]);
        let bytes = box_tree(&fine).unwrap();
        let mut mesh = fine.clone();
        mesh.positions[1][0] = x;
        let refused = Hierarchy::new(&mesh, &Bvh::open(&bytes).unwrap(), &SplitOptions::default());
        assert_eq!(refused.unwrap_err(), wanted);
    }
}

#[test]
fn the_same_mesh_gives_the_same_hierarchy() {
    let mesh = fixture("groove.obj");
    let (one, two) = (split(&mesh, &options(12)), split(&mesh, &options(12)));
    assert_eq!((&one.nodes, &one.order), (&two.nodes, &two.order));
    // The first splits do not depend on how many follow.
    assert_eq!(split(&mesh, &options(5)).order, one.order[..4]);
}

#[test]
fn simplified_proxies_hold_more_with_fewer_faces() {
    let mesh = fixture("torus.ply");
    let bytes = box_tree(&mesh).unwrap();
    let tree = Bvh::open(&bytes).unwrap();
    let exact = level(&split(&mesh, &options(8)), 8, &mesh, &tree);
    let hierarchy = split(&mesh, &SplitOptions { simplify: 0.1, ..options(8) });
    let simple = level(&hierarchy, 8, &mesh, &tree);
    assert!(simple.faces < exact.faces && simple.volume >= exact.volume, "{simple:?} {exact:?}");
    demand_cover(&hierarchy, &on_surface(&mesh, 500));
}

#[test]
fn a_level_s_figures_are_those_of_the_mesh_that_is_drawn() {
    let mesh = fixture("groove.obj");
    let bytes = box_tree(&mesh).unwrap();
    let hierarchy = split(&mesh, &options(8));
    let level = level(&hierarchy, 8, &mesh, &Bvh::open(&bytes).unwrap());
    let drawn = surface(&proxies(&hierarchy, 8));
    let volume: f64 = (0..drawn.triangles.len())
        .map(|t| {
            let [a, b, c] = drawn.corners(t).unwrap().map(|p| glam::DVec3::from(p.map(f64::from)));
            a.cross(b).dot(c) / 6.0
        })
        .sum();
    assert!((volume / level.volume - 1.0).abs() < 1e-9, "{volume} {level:?}");
    assert!(
        level.distance.lower > 0.0 && level.distance.upper <= level.distance.lower * 1.06,
        "{level:?}"
    );
}

#[test]
fn a_block_is_its_own_tribox_without_error() {
    let mesh = blocks(&[[[0.0; 3], [1.0, 2.0, 3.0]]], 1);
    let bytes = box_tree(&mesh).unwrap();
    let hierarchy = split(&mesh, &options(8));
    assert!(hierarchy.order.is_empty(), "nothing is saved by splitting a block");
    let level = level(&hierarchy, 8, &mesh, &Bvh::open(&bytes).unwrap());
    assert_eq!((level.faces, level.volume, level.error), (6, 6.0, 0.0));
}

/// An L of which the inner corner is at no even place.
#[test]
fn a_step_is_cut_off_where_it_ends() {
    let outline = [[0.0, 0.0], [4.0, 0.0], [4.0, 0.9], [0.7, 0.9], [0.7, 4.0], [0.0, 4.0f32]];
    let positions: Vec<[f32; 3]> =
        [0.0, 1.0].iter().flat_map(|&z| outline.map(|[x, y]| [x, y, z])).collect();
    let mut triangles = Vec::new();
    for [a, b, c] in [[0u32, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]] {
        triangles.extend([[a, c, b], [a + 6, b + 6, c + 6]]);
    }
    for i in 0..6u32 {
        let j = (i + 1) % 6;
        triangles.extend([[i, j, j + 6], [i, j + 6, i + 6]]);
    }
    let mesh = repaired(&positions, &triangles);
    let lattice = Some(Lattice::of(&mesh, 0.0).unwrap());
    let even = split(&mesh, &SplitOptions { lattice, ..options(2) });
    let planes = Planes::Extrema(7);
    let extrema = split(&mesh, &SplitOptions { planes, lattice, ..options(2) });
    demand_order(&extrema);
    demand_cover(&extrema, &in_solid(&mesh, 1000));
    // 4 by 0.9 and 0.7 by 3.1.
    let exact = 4.0 * 0.9 + 0.7 * 3.1;
    assert!((volume(&extrema) / exact - 1.0).abs() < 4e-3, "{} {exact}", volume(&extrema));
    assert!(volume(&even) > 1.01 * exact, "{}", volume(&even));
}
