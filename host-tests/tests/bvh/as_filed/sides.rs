//! Turning tells sides, and nothing else.

use super::{File, side, views, winding};
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::check::{check_tree, prove_repair};
use meshsweep::mesh::{Filed, RawMesh, repair};
use meshsweep::progress::Watch;
use meshsweep_core::{Bvh, OpenError, SectionKind, Side, Undecided};
use meshsweep_host_tests::corrupt::{assert_damage_is_safe, edited, entries, entry};
use meshsweep_host_tests::generate::evil::room;
use meshsweep_host_tests::generate::{
    Rng, Triangles, block, icosphere, inverted, joined, scaled, torus,
};

const TURNED: u32 = SectionKind::TreeTurned as u32;

/// Whether a bit for each triangle says which are turned.
fn has_bits(bytes: &[u8]) -> bool {
    entries(bytes).iter().any(|entry| entry.kind == TURNED)
}

fn far_tetrahedron() -> Triangles {
    let corners = [[9.0, 0.0, 0.0], [10.0, 0.0, 0.0], [9.0, 1.0, 0.0], [9.0, 0.0, 1.0]];
    (corners.to_vec(), vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
}

/// Two solids, the second inside out.
fn one_of_two_inverted() -> Triangles {
    let far = |(positions, triangles): Triangles| {
        let positions = positions.into_iter().map(|[x, y, z]| [x + 4.0, y, z]).collect();
        (positions, triangles)
    };
    joined(&icosphere(0), &far(inverted(&icosphere(0))))
}

#[test]
fn a_room_whose_walls_face_inwards_is_a_solid_to_signed_distances() {
    for winding in [false, true] {
        let blobs = File::of(&room()).trees(TreeOptions::default().with_winding(winding));
        assert!(!blobs.iter().any(|bytes| has_bits(bytes)), "all are turned: one flag");
        assert_room_is_solid(&blobs);
    }
}

fn assert_room_is_solid(blobs: &[Vec<u8>; 2]) {
    for tree in views(blobs) {
        assert!(tree.is_closed() && tree.has_sides());
        assert_eq!(side(&tree, [5.0, 5.5, 5.2]), Side::Inside);
        assert_eq!(side(&tree, [15.0, 5.5, 5.2]), Side::Outside);
        // Next to a vertex and to an edge, where sums of normals decide.
        assert_eq!(side(&tree, [-1.0, -1.25, -1.5]), Side::Outside);
        assert_eq!(side(&tree, [5.0, 11.0, 11.5]), Side::Outside);
    }
}

#[test]
fn sides_do_not_depend_on_which_triangles_the_file_winds_wrongly() {
    let hollow = joined(&icosphere(2), &scaled(&inverted(&icosphere(2)), 0.5));
    let mut rng = Rng::new(11);
    // A hollow solid of which some triangles are flipped may be a solid in a solid.
    for (shape, flips) in [(torus(2.0, 0.75, 16, 10), true), (hollow, false)] {
        let plain = File::of(&shape).trees(TreeOptions::default());
        assert!(!plain.iter().any(|bytes| has_bits(bytes)));
        let mut flipped = shape.clone();
        for triangle in &mut flipped.1 {
            if rng.below(4) == 0 {
                triangle.swap(1, 2);
            }
        }
        for (file, is_mixed) in [(inverted(&shape), false), (flipped, true)] {
            if is_mixed && !flips {
                continue;
            }
            let blobs = File::of(&file).trees(TreeOptions::default());
            assert!(blobs.iter().all(|bytes| has_bits(bytes) == is_mixed));
            let mut decided = 0;
            for (tree, plain) in views(&blobs).iter().zip(&views(&plain)) {
                for _ in 0..500 {
                    let point = rng.point_in([-3.0; 3], [3.0; 3]);
                    let wanted = side(plain, point);
                    assert_eq!(side(tree, point), wanted, "{point:?}");
                    decided += usize::from(!matches!(wanted, Side::Undecided(_)));
                }
            }
            assert!(decided > 1900, "{decided}");
        }
    }
}

#[test]
fn the_majority_of_its_triangles_makes_no_part_a_cavity() {
    let outer = block([-10.0; 3], [10.0; 3]);
    for flipped in [1, 5, 7] {
        let mut inner = block([-4.0; 3], [4.0; 3]);
        inner.1.iter_mut().take(flipped).for_each(|t| t.swap(1, 2));
        let blobs = File::of(&joined(&outer, &inner)).trees(TreeOptions::default());
        for tree in views(&blobs) {
            for p in [[0.0; 3], [7.0, 0.0, 0.0], [4.5, 0.1, 0.2]] {
                assert!(matches!(side(&tree, p), Side::Undecided(_)), "{flipped} {p:?}");
            }
        }
        // Apart from others each bounds a solid.
        let apart = |(positions, triangles): &Triangles| {
            let positions = positions.iter().map(|&[x, y, z]| [x + 50.0, y, z]).collect();
            (positions, triangles.clone())
        };
        let blobs = File::of(&joined(&outer, &apart(&inner))).trees(TreeOptions::default());
        for tree in views(&blobs) {
            assert_eq!(side(&tree, [50.0, 0.0, 0.0]), Side::Inside);
            assert_eq!(side(&tree, [45.0, 0.0, 0.0]), Side::Outside);
            assert_eq!(side(&tree, [0.0; 3]), Side::Inside);
        }
    }
}

#[test]
fn the_majority_makes_no_cavity_of_a_part_that_shares_an_edge_with_the_skin() {
    let (mut positions, mut triangles) = block([0.0; 3], [10.0; 3]);
    let vertex =
        |positions: &[[f32; 3]], at| positions.iter().position(|&p| p == at).unwrap() as u32;
    let [a, b] = [[0.0; 3], [0.0, 0.0, 10.0]].map(|at| vertex(&positions, at));
    positions.extend([[4.0, 2.0, 5.0], [2.0, 4.0, 5.0]]);
    let [c, d] = [8, 9];
    // Outwards, but for three.
    triangles.extend([[a, b, c], [a, b, d], [a, c, d], [b, c, d]]);
    let blobs = File::of(&(positions, triangles)).trees(TreeOptions::default());
    for tree in views(&blobs) {
        assert_ne!(side(&tree, [1.5, 1.5, 5.0]), Side::Outside);
    }
}

#[test]
fn a_part_with_doubts_in_it_is_not_turned_and_no_side_there_is_wrong() {
    let (big, small) = (block([-20.0; 3], [20.0; 3]), block([-5.0; 3], [5.0; 3]));
    // It touches the small one with a corner, stands on its face, crosses it.
    let thirds = [
        block([5.0; 3], [7.0; 3]),
        block([5.0, -2.0, -2.0], [7.0, 2.0, 2.0]),
        block([4.0; 3], [7.0; 3]),
    ];
    for third in thirds.iter().flat_map(|third| [third.clone(), inverted(third)]) {
        let file = joined(&joined(&inverted(&big), &inverted(&small)), &third);
        for winding in [false, true] {
            let blobs = File::of(&file).trees(TreeOptions::default().with_winding(winding));
            for tree in views(&blobs) {
                assert_ne!(side(&tree, [-3.0, 0.0, 0.1]), Side::Outside);
                assert_ne!(side(&tree, [-12.0, 0.0, 0.1]), Side::Outside);
            }
        }
    }
}

#[test]
fn a_solid_in_a_solid_that_repair_turned_is_no_proved_cavity() {
    let (positions, triangles) = joined(&block([-10.0; 3], [10.0; 3]), &block([-4.0; 3], [4.0; 3]));
    let raw = RawMesh::from_f32(&positions, &triangles);
    let (mut mesh, _) = repair(raw.clone()).expect("a mesh");
    // A wrong repair that is true to itself.
    mesh.filed = Some(Box::new(Filed { positions, triangles }));
    mesh.turned = (0..24).map(|t| t >= 12).collect();
    mesh.triangles[12..].iter_mut().for_each(|t| t.swap(1, 2));
    assert!(prove_repair(&raw, mesh.as_input()).is_ok(), "it does not know what is right");
    let bytes =
        build(mesh.as_input(), &TreeOptions::default(), Watch::NONE).expect("builds").0.to_bytes();
    let tree = Bvh::open(&bytes).expect("opens");
    assert!(matches!(side(&tree, [0.0; 3]), Side::Undecided(_)), "the builder looks at the file");
    let all_told = edited(
        bytes,
        SectionKind::TreeSideless,
        |bits| bits.fill(0),
        |bytes| check_tree(bytes, &mesh).map(drop),
    );
    let refused = all_told.expect_err("the file winds twice there");
    assert!(refused.contains("the file winds 2 times"), "{refused}");
}

#[test]
fn a_tree_that_needs_no_sides_by_the_nearest_triangle_has_no_bits() {
    let file = File::of(&one_of_two_inverted());
    let plain = TreeOptions::default();
    assert!(file.trees(plain).iter().all(|bytes| has_bits(bytes)));
    assert!(!file.trees(plain.with_closest(false)).iter().any(|bytes| has_bits(bytes)));
}

#[test]
fn numbers_tell_no_side_in_a_part_that_is_inside_out_and_the_nearest_triangle_does() {
    let blobs = File::of(&one_of_two_inverted()).trees(TreeOptions::default().with_winding(true));
    for tree in views(&blobs) {
        let undecided = Side::Undecided(Undecided::Resolution);
        for (point, number, told, wanted) in [
            ([0.1, 0.0, 0.0], 1.0, Side::Inside, Side::Inside),
            ([4.1, 0.0, 0.0], -1.0, undecided, Side::Inside),
            ([2.0, 0.0, 0.0], 0.0, Side::Outside, Side::Outside),
        ] {
            let (interval, by_number) = winding(&tree, point);
            assert!(interval.lower <= number && number <= interval.upper, "{interval:?}");
            assert_eq!((by_number, side(&tree, point)), (told, wanted));
        }
    }
}

#[test]
fn turned_triangles_are_there_if_the_header_says_so_and_end_with_zeros() {
    let bytes = File::of(&one_of_two_inverted()).tree(&TreeOptions::default());
    assert_eq!(entry(&bytes, TURNED).bytes, 5, "a bit for each of 40 triangles");
    let open = |bytes: &[u8]| Bvh::open(bytes).map(drop);
    let flags =
        |flags: u8| edited(bytes.clone(), SectionKind::Bvh, |header| header[1] = flags, open);
    let missing = Err(OpenError::MissingSection { section: SectionKind::TreeTurned });
    assert_eq!(flags(9), Ok(()));
    assert_eq!(flags(1), missing, "bits that no flag announces");
    assert_eq!(flags(8), missing, "bits of a mesh that is not closed");
    assert_eq!(flags(13), missing, "bits of a tree without sides");
    assert_eq!(flags(33), Err(OpenError::Reserved));
    let (mut odd, triangles) = (one_of_two_inverted(), 44);
    odd = joined(&odd, &far_tetrahedron());
    let bytes = File::of(&odd).tree(&TreeOptions::default());
    let last = edited(bytes, SectionKind::TreeTurned, |bits| bits[5] |= 16, open);
    let beyond = OpenError::Record { section: SectionKind::TreeTurned, index: triangles };
    assert_eq!(last, Err(beyond));
}

#[test]
fn damaged_bits_are_safe() {
    let bytes = File::of(&one_of_two_inverted()).tree(&TreeOptions::default());
    let ask = |bytes: &[u8]| {
        Bvh::open(bytes).map(|tree| {
            side(&tree, [0.1, 0.2, 0.3]);
        })
    };
    assert_damage_is_safe(&[bytes], SectionKind::TreeTurned, 5, (500, 3), ask);
}
