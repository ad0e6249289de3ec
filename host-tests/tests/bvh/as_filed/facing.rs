//! Fronts and backs are those of the file.

use super::{File, first, stack, views};
use meshsweep::bvh::TreeOptions;
use meshsweep_core::{Budget, Eye, Facing, TriangleHit};
use meshsweep_host_tests::generate::evil::room;
use meshsweep_host_tests::generate::{icosphere, inverted, scaled};

/// A square of two triangles, wound against each other: the first faces up.
fn two_windings() -> File {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    File { positions, triangles: vec![[0, 1, 2], [0, 3, 2]] }
}

#[test]
fn within_a_room_whose_walls_face_inwards_every_wall_is_a_front() {
    let blobs = File::of(&room()).trees(TreeOptions::default());
    let beam = [[5.0, 5.5, 5.2], [15.0, 5.5, 5.2]];
    for tree in views(&blobs) {
        let hit = first(&tree, beam, Facing::Front).expect("a wall");
        assert_eq!((hit.t, hit.triangle), (0.5, Some(11)));
        assert_eq!(first(&tree, beam, Facing::Back), None);
        // From outside walls show their backs.
        let [inside, outside] = beam;
        assert_eq!(first(&tree, [outside, inside], Facing::Front), None);
        let hit = first(&tree, [outside, inside], Facing::Back).expect("a wall");
        assert_eq!((hit.t, hit.triangle), (0.5, Some(11)));
    }
}

#[test]
fn culling_from_within_an_inverted_sphere_keeps_all_and_from_outside_all_that_face_the_eye() {
    let file = File::of(&scaled(&inverted(&icosphere(3)), 10.0));
    assert_eq!(file.triangles.len(), 1280);
    let blobs = file.trees(TreeOptions::default().with_cull(true));
    for tree in views(&blobs) {
        let listed = |eye: [f32; 3]| {
            let mut triangles = vec![0; 1280];
            let found = tree.front_facing(Eye::At(eye), &mut triangles).expect("answers");
            triangles.truncate(found.stored);
            triangles
        };
        assert_eq!(listed([0.0; 3]).len(), 1280);
        let from_outside = listed([30.0, 0.0, 0.0]);
        let mut facing = 0;
        for triangle in 0..1280 {
            if faces(&file, triangle, [30.0, 0.0, 0.0]) {
                facing += 1;
                assert!(from_outside.contains(&triangle), "triangle {triangle}");
            }
        }
        assert!(facing > 800 && from_outside.len() < 1000, "{facing}, {}", from_outside.len());
    }
}

/// Whether a triangle clearly faces a place.
fn faces(file: &File, triangle: u32, eye: [f64; 3]) -> bool {
    let [a, b, c] = file.corners(triangle);
    let minus = super::minus;
    let ([e0, e1, e2], [g0, g1, g2], s) = (minus(b, a), minus(c, a), minus(eye, a));
    let normal = [e1 * g2 - e2 * g1, e2 * g0 - e0 * g2, e0 * g1 - e1 * g0];
    (0..3).map(|k| normal[k] * s[k]).sum::<f64>() > 1e-2
}

#[test]
fn triangles_wound_against_each_other_keep_their_own_fronts() {
    let blobs = two_windings().trees(TreeOptions::default());
    let through = |x: f32, y: f32| [[x, y, 1.0], [x, y, -1.0]];
    for tree in views(&blobs) {
        let number = |beam, facing| first(&tree, beam, facing).map(|hit| hit.triangle);
        let (up, down) = (through(0.75, 0.25), through(0.25, 0.75));
        assert_eq!(number(up, Facing::Front), Some(Some(0)));
        assert_eq!(number(up, Facing::Back), None);
        assert_eq!(number(down, Facing::Front), None);
        assert_eq!(number(down, Facing::Back), Some(Some(1)));
    }
}

#[test]
fn of_a_sheet_that_is_in_the_file_from_both_sides_each_side_is_met_under_its_own_number() {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let triangles = vec![[0, 1, 2], [0, 2, 3], [2, 1, 0], [3, 2, 0]];
    let file = File { positions, triangles };
    for options in [TreeOptions::default(), TreeOptions::default().with_winding(true)] {
        let blobs = file.trees(options);
        for tree in views(&blobs) {
            let (above, below) = ([0.75, 0.25, 1.0], [0.75, 0.25, -1.0]);
            for (beam, front, back) in [([above, below], 0, 2), ([below, above], 2, 0)] {
                for (facing, wanted) in [(Facing::Front, front), (Facing::Back, back)] {
                    let hit = first(&tree, beam, facing).expect("a side");
                    assert_eq!((hit.t, hit.triangle), (0.5, Some(wanted)));
                }
                let mut hits = [TriangleHit::EMPTY; 4];
                let [a, b] = beam;
                let (facing, budget) = (Facing::Both, Budget::EXACT);
                let all = tree.all_hits(a, b, facing, &mut hits, budget, &mut stack(&tree));
                assert_eq!(all.expect("answers").stored, 2);
            }
        }
    }
    // For distances alone one copy is enough.
    let blobs = file.trees(TreeOptions::default().with_segments(false));
    assert!(views(&blobs).iter().all(|tree| tree.triangle_count() == 2));
}

#[test]
fn copies_and_triangles_without_area_are_stored_once_or_not_at_all_without_winding_numbers() {
    let mut file = two_windings();
    file.positions.push([0.5, 0.0, 0.0]);
    // A copy that begins elsewhere, an edge in three parts, a corner, and a wire off the surface.
    file.positions.push([9.0, 9.0, 9.0]);
    file.triangles.extend([[1, 2, 0], [0, 4, 1], [3, 3, 3], [2, 5, 5]]);
    let blobs = file.trees(TreeOptions::default());
    assert!(views(&blobs).iter().all(|tree| tree.triangle_count() == 3));
    let blobs = file.trees(TreeOptions::default().with_winding(true));
    assert!(views(&blobs).iter().all(|tree| tree.triangle_count() == 6));
}
