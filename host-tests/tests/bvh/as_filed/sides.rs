//! Turning tells sides, and nothing else.

use super::{File, side, views};
use meshsweep::bvh::TreeOptions;
use meshsweep_core::{Bvh, OpenError, SectionKind, Side};
use meshsweep_host_tests::corrupt::{assert_damage_is_safe, edited, entries, entry};
use meshsweep_host_tests::generate::evil::room;
use meshsweep_host_tests::generate::{Rng, icosphere, inverted, joined, scaled, torus};

const TURNED: u32 = SectionKind::TreeTurned as u32;

fn has_turned(bytes: &[u8]) -> bool {
    entries(bytes).iter().any(|entry| entry.kind == TURNED)
}

#[test]
fn a_room_whose_walls_face_inwards_is_a_solid_to_signed_distances() {
    let blobs = File::of(&room()).trees(TreeOptions::default());
    assert!(blobs.iter().all(|bytes| has_turned(bytes)));
    for tree in views(&blobs) {
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
    for shape in [torus(2.0, 0.75, 16, 10), hollow] {
        let plain = File::of(&shape).trees(TreeOptions::default());
        assert!(!plain.iter().any(|bytes| has_turned(bytes)));
        let mut flipped = shape.clone();
        for triangle in &mut flipped.1 {
            if rng.below(4) == 0 {
                triangle.swap(1, 2);
            }
        }
        for file in [inverted(&shape), flipped] {
            let blobs = File::of(&file).trees(TreeOptions::default());
            assert!(blobs.iter().all(|bytes| has_turned(bytes)));
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
fn a_tree_that_needs_no_sides_by_the_nearest_triangle_has_no_bits() {
    let file = File::of(&room());
    let plain = TreeOptions::default();
    for options in [plain.with_closest(false), plain.with_winding(true)] {
        assert!(!file.trees(options).iter().any(|bytes| has_turned(bytes)));
    }
}

#[test]
fn turned_triangles_are_there_if_the_header_says_so_and_end_with_zeros() {
    let bytes = File::of(&inverted(&icosphere(0))).tree(&TreeOptions::default());
    assert_eq!(entry(&bytes, TURNED).bytes, 3, "a bit for each of 20 triangles");
    let open = |bytes: &[u8]| Bvh::open(bytes).map(drop);
    let flags =
        |flags: u8| edited(bytes.clone(), SectionKind::Bvh, |header| header[1] = flags, open);
    let missing = Err(OpenError::MissingSection { section: SectionKind::TreeTurned });
    assert_eq!(flags(9), Ok(()));
    assert_eq!(flags(1), missing, "bits that no flag announces");
    assert_eq!(flags(8), missing, "bits of a mesh that is not closed");
    assert_eq!(flags(13), missing, "bits of a tree without sides");
    assert_eq!(flags(17), Err(OpenError::Reserved));
    let last = edited(bytes.clone(), SectionKind::TreeTurned, |bits| bits[2] |= 16, open);
    let beyond = OpenError::Record { section: SectionKind::TreeTurned, index: 20 };
    assert_eq!(last, Err(beyond));
}

#[test]
fn damaged_bits_are_safe() {
    let bytes = File::of(&inverted(&icosphere(0))).tree(&TreeOptions::default());
    let ask = |bytes: &[u8]| {
        Bvh::open(bytes).map(|tree| {
            side(&tree, [0.1, 0.2, 0.3]);
        })
    };
    assert_damage_is_safe(&[bytes], SectionKind::TreeTurned, 3, (500, 3), ask);
}
