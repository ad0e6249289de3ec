//! Winding numbers are those of all triangles of the file.

use super::{File, exact_winding, side, views, winding};
use meshsweep::bvh::TreeOptions;
use meshsweep_core::{Budget, Bvh, Interval, ScratchEntry, Side};
use meshsweep_host_tests::generate::evil::{glued_blocks, plugged_shell, room};
use meshsweep_host_tests::generate::{Triangles, block, inverted, joined};

fn trees(file: &Triangles) -> [Vec<u8>; 2] {
    File::of(file).trees(TreeOptions::default().with_winding(true))
}

fn assert_number(tree: &Bvh<'_>, point: [f32; 3], wanted: f32) {
    let (Interval { lower, upper }, side) = winding(tree, point);
    assert!(
        lower <= wanted && wanted <= upper && upper - lower < 0.1,
        "{point:?}: {lower} {upper}"
    );
    assert_eq!(side, if wanted > 0.5 { Side::Inside } else { Side::Outside }, "{point:?}");
}

#[test]
fn glued_solids_are_one_solid_in_any_order() {
    let along = |from: f32, to: f32| block([from, 0.0, 0.0], [to, 10.0, 10.0]);
    let parts = [along(0.0, 10.0), along(11.0, 21.0), along(10.0, 11.0)];
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        let [a, b, c] = order.map(|k: usize| &parts[k]);
        let blobs = trees(&joined(&joined(a, b), c));
        for tree in views(&blobs) {
            for x in [1.0, 5.0, 9.9, 10.5, 11.1, 16.0, 20.0] {
                assert_number(&tree, [x, 5.0, 5.0], 1.0);
            }
            for p in [[-0.1, 5.0, 5.0], [21.1, 5.0, 5.0], [10.5, 10.1, 5.0]] {
                assert_number(&tree, p, 0.0);
            }
            assert!(tree.is_closed(), "every part is closed");
        }
    }
    for tree in views(&trees(&glued_blocks())) {
        assert_number(&tree, [11.1, 5.0, 5.0], 1.0);
    }
}

#[test]
fn a_plug_fills_the_cavity_whose_walls_it_shares() {
    for tree in views(&trees(&plugged_shell())) {
        for p in [[0.0; 3], [7.9, 0.0, 0.0], [9.0, 0.0, 0.0]] {
            assert_number(&tree, p, 1.0);
        }
        assert_number(&tree, [10.5, 0.0, 0.0], 0.0);
    }
}

#[test]
fn every_voxel_of_a_solid_is_inside_and_the_places_beside_it_are_outside() {
    for count in [5u16, 8] {
        let cells = |from: i32, to: i32| {
            let all = move |x| (from..to).flat_map(move |y| (from..to).map(move |z| [x, y, z]));
            (from..to).flat_map(all).map(|p| p.map(|x| x as f32))
        };
        let count = i32::from(count);
        let voxels = cells(0, count).map(|p| block(p, p.map(|x| x + 1.0)));
        let solid = voxels.reduce(|a, b| joined(&a, &b)).expect("voxels");
        for tree in views(&trees(&solid)) {
            for cell in cells(-1, count + 1) {
                let is_within = cell.iter().all(|x| (0.0..count as f32).contains(x));
                let number = if is_within { 1.0 } else { 0.0 };
                assert_number(&tree, cell.map(|x| x + 0.5), number);
            }
        }
    }
}

#[test]
fn a_room_whose_walls_face_inwards_winds_once_backwards() {
    for tree in views(&trees(&room())) {
        // A solid all the same: only the number tells that it faces inwards.
        for (point, number, wanted) in
            [([5.0, 5.5, 5.2], -1.0, Side::Inside), ([15.0, 5.0, 5.0], 0.0, Side::Outside)]
        {
            let (Interval { lower, upper }, by_number) = winding(&tree, point);
            assert!(lower <= number && number <= upper && upper - lower < 0.1);
            assert_eq!((by_number, side(&tree, point)), (wanted, wanted));
        }
    }
}

#[test]
fn a_cavity_in_a_skin_with_a_hole_is_outside_whichever_triangle_is_missing() {
    let cavity = inverted(&block([-8.0; 3], [8.0; 3]));
    for missing in 0..12 {
        let mut skin = block([-10.0; 3], [10.0; 3]);
        skin.1.remove(missing);
        let file = joined(&skin, &cavity);
        for tree in views(&trees(&file)) {
            for point in [[0.0; 3], [7.9, 0.0, 0.0], [-3.0, 2.0, 1.0], [30.0, 1.0, 2.0]] {
                let truth = exact_winding(&File::of(&file), point.map(f64::from)) as f32;
                assert_number(&tree, point, truth);
                let stack = &mut vec![ScratchEntry::EMPTY; tree.scratch_entries()];
                let signed =
                    tree.signed_distance_by_winding(point, Budget::EXACT, stack).expect("answers");
                assert!(signed.side == Side::Outside && signed.distance.lower > 0.0);
            }
        }
    }
}

#[test]
fn nothing_in_a_part_that_is_inside_out_is_called_outside() {
    let inverted_block = || inverted(&block([-2.0; 3], [2.0; 3]));
    // A copy of a triangle; a part that touches another from without; an edge of four triangles.
    let mut doubled = inverted_block();
    doubled.1.push(doubled.1[0]);
    let touching = joined(&block([-20.0, -9.0, -9.0], [-2.0, 9.0, 9.0]), &inverted_block());
    let along_edge = joined(&inverted_block(), &inverted(&block([2.0; 3], [4.0; 3])));
    let along_edge = joined(&along_edge, &inverted(&block([2.0, 2.0, -2.0], [4.0, 4.0, 2.0])));
    for file in [doubled, touching, along_edge] {
        for tree in views(&trees(&file)) {
            let (Interval { lower, .. }, by_number) = winding(&tree, [0.5, 0.25, 0.125]);
            assert!(lower < -0.5);
            assert!(by_number == Side::Inside || matches!(by_number, Side::Undecided(_)));
            assert_ne!(side(&tree, [0.5, 0.25, 0.125]), Side::Outside);
            assert_eq!(winding(&tree, [30.0, 0.0, 0.0]).1, Side::Outside);
        }
    }
}

#[test]
fn a_t_junction_that_a_triangle_without_area_closes_is_closed() {
    // On the grid the middle of the edge is not on the edge.
    let file = |cap: &[[u32; 3]]| File {
        positions: vec![
            [0.1, 0.2, 0.3],
            [2.1, 0.4, 0.7],
            [0.3, 1.3, 0.2],
            [0.2, 0.1, 1.4],
            [1.1, 0.3, 0.5],
        ]
        .into_iter()
        .map(|p: [f32; 3]| p.map(|x| f64::from((x * 1024.0).round() / 1024.0)))
        .collect(),
        triangles: [&[[0, 2, 1], [0, 4, 3], [4, 1, 3], [1, 2, 3], [0, 3, 2]], cap].concat(),
    };
    let (closed, open) = (file(&[[0, 1, 4]]), file(&[]));
    let options = TreeOptions::default().with_winding(true);
    let (blobs, gaps) = (closed.trees(options), open.trees(options));
    for (tree, gap) in views(&blobs).iter().zip(&views(&gaps)) {
        assert!(tree.is_closed() && !gap.is_closed());
        assert_number(tree, [0.5, 0.4, 0.5], 1.0);
        assert_number(tree, [5.0, 4.0, 3.0], 0.0);
    }
}
