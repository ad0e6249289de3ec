//! Tight hulls, triboxes and hull levels: they enclose points of triangles without area, or carry
//! them in their surface error. And what repair says of them.

use crate::scene::{Kind, Raw, Scene, inputs, joined, pierced_cube, repaired};
use meshsweep::hull::{self, BuildOptions};
use meshsweep::mesh::{Input, Mesh, MeshError, require_closed_manifold};
use meshsweep::progress::Watch;
use meshsweep::tight::{self, ChainOptions, hull_mesh};
use meshsweep::tribox::{self, TriboxOptions};
use meshsweep_core::{Budget, Hull, ScratchEntry, TightHulls, Triboxes, Verdict};
use meshsweep_host_tests::oracle::exact::{distance_compared, first_meeting};
use meshsweep_host_tests::oracle::winding_number;
use std::cmp::Ordering::{Greater, Less};

const KINDS: [Kind; 2] = [Kind::Grid, Kind::Snapped];

/// Samples of all that the mesh has, wires too.
fn samples(mesh: &Mesh) -> Vec<[f64; 3]> {
    mesh.all_triangles()
        .flat_map(|t| {
            let [a, b, c] = t.map(|v| mesh.positions[v as usize].map(f64::from));
            [[8, 0, 0], [0, 8, 0], [4, 4, 0], [0, 2, 6], [3, 3, 2]].map(|weights| {
                let [u, v, w] = weights.map(|n| f64::from(n) / 8.0);
                std::array::from_fn(|k| u * a[k] + v * b[k] + w * c[k])
            })
        })
        .collect()
}

fn hulls_of(mesh: &Mesh, moved: f64, faces: usize) -> Vec<u8> {
    let options = ChainOptions::of_faces(&[faces]).with_effort(0.01);
    let count = mesh.all_triangles().count();
    let (tables, _) =
        tight::build(Input { mesh, moved, input_triangles: count }, &options, Watch::NONE)
            .expect("there is room");
    tables.to_bytes()
}

#[test]
fn tight_hulls_enclose_wires_and_points_and_their_answers_hold() {
    let chosen =
        ["pierced cube", "cap", "wires", "one slanted wire", "torus among wires", "crumbs"];
    // Both kinds in turn: to build the hulls takes most of the time.
    let inputs = inputs();
    let chosen = inputs.iter().filter(|(name, _)| chosen.contains(name));
    for ((name, raw), kind) in chosen.zip(KINDS.into_iter().cycle()) {
        let scene = Scene::new(name, raw, kind);
        let bytes = hulls_of(&scene.mesh, scene.moved, 100);
        let hulls = TightHulls::open(&bytes).expect("opens");
        let hull = hulls.get(0).expect("a hull");
        let surface = hull_mesh(&hull);
        for wire in scene.mesh.wire_corners() {
            let [a, b, _] = wire.map(|p| p.map(f64::from));
            for face in 0..surface.triangles.len() {
                let face = surface.corners(face).expect("a face").map(|p| p.map(f64::from));
                assert!(first_meeting(a, b, &face).is_none(), "{}: {a:?} {b:?}", scene.name);
            }
            let number = winding_number(a, &surface.positions, &surface.triangles, 1.0);
            assert!((number - 1.0).abs() < 1e-6, "{}: {a:?}", scene.name);
        }
        let mut stack = vec![ScratchEntry::EMPTY; hull.bvh().header().stack_entries as usize];
        for p in scene.points(120, 31) {
            let truth = scene.nearest(p);
            let answer = hull.closest_point(p, Budget::EXACT, &mut stack).expect("a point");
            let compared = |t, x: f32| distance_compared(p.map(f64::from), t, f64::from(x));
            let holds = truth.iter().all(|t| compared(t, answer.distance.lower) != Less)
                && truth.iter().any(|t| compared(t, answer.distance.upper) != Greater);
            assert!(holds, "{}: {p:?} {answer:?}", scene.name);
            let within = hull.within(p, 0.5 * answer.distance.upper, Budget::EXACT, &mut stack);
            let is_near = truth.iter().any(|t| compared(t, 0.5 * answer.distance.upper) != Greater);
            match within.expect("a distance").verdict {
                Verdict::Yes => assert!(is_near, "{}: {p:?}", scene.name),
                Verdict::No => assert!(!is_near, "{}: {p:?}", scene.name),
                _ => {}
            }
        }
    }
}

#[test]
fn every_level_of_triboxes_holds_wires_and_points() {
    const DIRECTIONS: [[f64; 3]; 9] = [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [1.0, 1.0, 0.0],
        [1.0, -1.0, 0.0],
        [0.0, 1.0, 1.0],
        [0.0, 1.0, -1.0],
        [1.0, 0.0, 1.0],
        [-1.0, 0.0, 1.0],
    ];
    for (name, raw) in inputs() {
        for kind in KINDS {
            let (mesh, moved, _) = repaired(&raw, kind);
            let input = Input { mesh: &mesh, moved, input_triangles: raw.1.len() };
            let (tables, _) =
                tribox::build(input, &TriboxOptions::new(8), Watch::NONE).expect("in the domain");
            let bytes = tables.to_bytes();
            let triboxes = Triboxes::open(&bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
            let size =
                mesh.positions.iter().flatten().fold(0f64, |m, &x| m.max(f64::from(x).abs()));
            for level in triboxes.levels() {
                let leaves: Vec<_> =
                    triboxes.coarser(level.triboxes).leaves().map(|(_, tribox)| tribox).collect();
                for p in samples(&mesh) {
                    let along = DIRECTIONS.map(|d| d[0] * p[0] + d[1] * p[1] + d[2] * p[2]);
                    let is_in = leaves.iter().any(|leaf| {
                        (0..9).all(|k| {
                            along[k] - f64::from(leaf.high[k]) <= 1e-15 * size
                                && f64::from(leaf.low[k]) - along[k] <= 1e-15 * size
                        })
                    });
                    assert!(is_in, "{name} {kind:?}, {} triboxes: {p:?}", level.triboxes);
                }
            }
        }
    }
}

#[test]
fn a_hull_hierarchy_carries_wires_in_its_surface_error() {
    for kind in KINDS {
        let scene = Scene::new("pierced cube", &pierced_cube(), kind);
        let options = BuildOptions { base_faces: 12, ..BuildOptions::default() };
        let count = scene.corners.len();
        let built = hull::build(
            Input { moved: scene.moved, input_triangles: count, ..scene.mesh.as_input() },
            &options,
            Watch::NONE,
        );
        let (sections, report) = built.expect("a cube");
        let bytes = sections.to_bytes();
        let model = Hull::open(&bytes).expect("opens");
        // The wire ends 2 in front of the cube.
        assert!(report.wires >= 2.0 && report.wires < 2.2, "{}", report.wires);
        let mut queue = vec![ScratchEntry::EMPTY; model.scratch_entries()];
        for p in scene.points(200, 32) {
            let truth = scene.nearest(p);
            let answer = model.closest_point(p, Budget::EXACT, &mut queue).expect("a point");
            let compared = |t, x: f32| distance_compared(p.map(f64::from), t, f64::from(x));
            let holds = truth.iter().all(|t| compared(t, answer.distance.lower) != Less)
                && truth.iter().any(|t| compared(t, answer.distance.upper) != Greater);
            assert!(holds, "{kind:?} {p:?} {answer:?}");
        }
        for pair in scene.points(200, 33).chunks_exact(2) {
            let answer = model.first_hit(pair[0], pair[1], Budget::EXACT, &mut queue);
            let [a, b] = [pair[0], pair[1]].map(|p| p.map(f64::from));
            let is_met = scene.corners.iter().any(|t| first_meeting(a, b, t).is_some());
            assert!(!(is_met && answer.expect("a segment").is_clear()), "{kind:?} {pair:?}");
        }
    }
}

#[test]
fn a_mesh_of_wires_alone_builds_a_tree_and_no_hull() {
    for (_, raw) in inputs().iter().filter(|(name, _)| ["line", "one point"].contains(name)) {
        let (mesh, _, report) = repaired(raw, Kind::Grid);
        assert_eq!((mesh.triangles.len(), mesh.wires.len(), report.wires.count), (0, 1, 1));
        assert_eq!(require_closed_manifold(&mesh), Err(MeshError::NoArea { count: 1 }));
        let scene = Scene::new("alone", raw, Kind::Grid);
        assert!(!scene.tree().header().is_closed());
    }
}

#[test]
fn repair_tells_what_it_kept_from_what_others_cover() {
    let counts = |raw: &Raw| {
        let (mesh, _, report) = repaired(raw, Kind::Grid);
        let said = report.to_string();
        assert_eq!(said.contains("kept as a segment or a point"), report.wires.count > 0, "{said}");
        assert_eq!(mesh.wires.len(), report.wires.count);
        (
            report.flipped_caps.count,
            report.zero_area.count,
            report.repeated_corner.count,
            mesh.wires.len(),
        )
    };
    let input =
        |wanted: &str| inputs().into_iter().find(|(name, _)| *name == wanted).expect("an input").1;
    assert_eq!(counts(&input("cap")), (1, 0, 0, 0));
    assert_eq!(counts(&input("stuck cap")), (0, 1, 0, 0));
    assert_eq!(counts(&input("line")), (0, 0, 0, 1));
    // Of five wires the one along the cube's edge is a chain of edges.
    assert_eq!(counts(&pierced_cube()), (0, 0, 1, 4));
    // Twice the same wire, and a point at its end.
    let wire = vec![[0.0; 3], [1.0, 2.0, 3.0]];
    assert_eq!(counts(&(wire, vec![[0, 1, 1], [1, 0, 0], [1, 1, 1]])), (0, 0, 2, 1));
    // A fin that the grid folds up.
    let fin: Raw =
        (vec![[0.5, 0.5, 3.0], [0.5, 0.5 + 1e-9, 3.0], [0.5, 0.5, 4.0]], vec![[0, 1, 2]]);
    let (mesh, _, report) = repaired(&joined(&pierced_cube(), &fin), Kind::Snapped);
    assert_eq!((report.wires.count, mesh.wires.len()), (5, 5));
}
