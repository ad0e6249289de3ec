//! Sides of surfaces that cross, overlap or touch themselves.

use super::{File, exact_winding, side, views};
use meshsweep::bvh::TreeOptions;
use meshsweep::check::check_tree;
use meshsweep::mesh::{RawMesh, repair};
use meshsweep_core::{Bvh, OpenError, SectionKind, Side};
use meshsweep_host_tests::corrupt::{assert_damage_is_safe, edited, entries, entry, seal};
use meshsweep_host_tests::generate::{
    Rng, Triangles, block, coil, cube, icosphere, inverted, joined, scaled, torus, transformed,
};

const SIDELESS: u32 = SectionKind::TreeSideless as u32;

fn has_sideless(bytes: &[u8]) -> bool {
    entries(bytes).iter().any(|entry| entry.kind == SIDELESS)
}

const LEVEL: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn moved(shape: &Triangles, by: [f32; 3]) -> Triangles {
    transformed(shape, LEVEL, by)
}

/// Least and greatest corner, a quarter of the size farther out.
fn surroundings(file: &File) -> [[f32; 3]; 2] {
    let ends = |axis: usize| {
        let xs = file.positions.iter().map(|p| p[axis]);
        xs.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)])
    };
    let ends = [0, 1, 2].map(ends);
    [ends.map(|[l, h]| (l - 0.25 * (h - l)) as f32), ends.map(|[l, h]| (h + 0.25 * (h - l)) as f32)]
}

/// Asks about points of the surroundings on a grid and in f32. No decided side is wrong. Returns
/// how many are decided.
fn assert_no_wrong_side(file: &File, points: usize, rng: &mut Rng) -> usize {
    let blobs = file.trees(TreeOptions::default());
    let [low, high] = surroundings(file);
    let mut decided = 0;
    for _ in 0..points {
        let point = rng.point_in(low, high);
        // A component that faces inwards as a whole bounds a solid all the same.
        let number = exact_winding(file, point.map(f64::from)).abs();
        for tree in &views(&blobs)[..2] {
            match side(tree, point) {
                Side::Inside => assert!(number > 0.5, "{point:?}: inside, {number}"),
                Side::Outside => assert!(number < 0.5, "{point:?}: outside, {number}"),
                _ => continue,
            }
            decided += 1;
        }
    }
    decided
}

#[test]
fn a_coil_whose_end_goes_through_its_beginning_has_sides_but_next_to_that() {
    let file = File::of(&coil(400.0, 80, 2.0));
    let blobs = file.trees(TreeOptions::default());
    assert!(blobs.iter().all(|bytes| has_sideless(bytes)));
    assert!(views(&blobs).iter().all(|tree| tree.has_sides()));
    let decided = assert_no_wrong_side(&file, 400, &mut Rng::new(81));
    assert!((600..800).contains(&decided), "{decided} of 800");
}

/// A beam along a random curve around the z axis, which crosses itself.
fn sweep(rng: &mut Rng) -> Triangles {
    let degrees = f64::from(rng.range(370.0, 700.0));
    let (mut positions, triangles) =
        coil(degrees, 24 + rng.below(40), f64::from(rng.range(0.0, 5.0)));
    let (wave, phase) = (rng.range(0.0, 1.5), rng.range(0.0, 6.0));
    for p in &mut positions {
        let angle = p[1].atan2(p[0]);
        let factor = 1.0 + 0.1 * wave * (2.5 * angle + phase).sin();
        *p = [p[0] * factor, p[1] * factor, p[2] + wave * (1.5 * angle).cos()];
    }
    (positions, triangles)
}

#[test]
fn of_random_sweeps_that_cross_themselves_no_side_is_wrong() {
    let mut rng = Rng::new(82);
    let mut decided = 0;
    for _ in 0..24 {
        decided += assert_no_wrong_side(&File::of(&sweep(&mut rng)), 60, &mut rng);
    }
    assert!(decided > 24 * 60, "{decided}");
}

#[test]
fn of_random_boxes_and_balls_that_overlap_no_side_is_wrong() {
    let mut rng = Rng::new(83);
    let mut decided = 0;
    for round in 0..60 {
        let part = |rng: &mut Rng| {
            // Whole numbers: walls in one plane, edges on edges, corners on corners.
            let whole = |x: f32| if round % 3 == 0 { x.round() } else { x };
            let at = rng.point_in([0.0; 3], [4.0; 3]).map(whole);
            let size = rng.point_in([1.0; 3], [4.0; 3]).map(whole);
            match rng.below(3) {
                0 if round % 3 != 0 => moved(&scaled(&icosphere(1), size[0]), at),
                1 => inverted(&block(at, [0, 1, 2].map(|k| at[k] + 0.5 * size[k]))),
                _ => block(at, [0, 1, 2].map(|k| at[k] + size[k])),
            }
        };
        let count = 1 + rng.below(3);
        let shape = (0..count).fold(part(&mut rng), |all, _| joined(&all, &part(&mut rng)));
        decided += assert_no_wrong_side(&File::of(&shape), 60, &mut rng);
    }
    assert!(decided > 1000, "{decided}");
}

#[test]
fn a_solid_in_a_solid_leaves_the_outer_one_its_sides() {
    let file = File::of(&joined(&icosphere(2), &scaled(&icosphere(2), 0.5)));
    let blobs = file.trees(TreeOptions::default());
    for tree in views(&blobs) {
        assert!(tree.has_sides());
        assert_eq!(side(&tree, [0.9, 0.0, 0.0]), Side::Inside);
        assert_eq!(side(&tree, [1.2, 0.0, 0.0]), Side::Outside);
        assert!(matches!(side(&tree, [0.6, 0.0, 0.0]), Side::Undecided(_)));
    }
}

/// An octahedron by its corners: opposite ones follow each other.
fn octahedron(corners: [[f32; 3]; 6]) -> Triangles {
    let mut triangles = Vec::new();
    for x in [0, 1] {
        for y in [2, 3] {
            for z in [4, 5] {
                let is_even = (x + y + z) % 2 == 0;
                triangles.push(if is_even { [x, y, z] } else { [x, z, y] });
            }
        }
    }
    (corners.to_vec(), triangles)
}

/// The octahedra about the middle of a box from −10 to 10, and one in its first octant.
fn touching() -> Vec<(&'static str, Triangles)> {
    let about = |[x, y, z]: [f32; 3], r: f32| {
        octahedron([
            [x + r, y, z],
            [x - r, y, z],
            [x, y + r, z],
            [x, y - r, z],
            [x, y, z + r],
            [x, y, z - r],
        ])
    };
    let corner = octahedron([
        [10.0, 10.0, 10.0],
        [0.0, 0.0, 0.0],
        [7.0, 2.0, 4.0],
        [3.0, 8.0, 5.0],
        [4.0, 3.0, 8.0],
        [6.0, 6.0, 1.0],
    ]);
    vec![
        ("on a face", about([1.0, 2.0, 5.0], 5.0)),
        ("on a face, below", about([1.0, 2.0, -5.0], 5.0)),
        ("on the diagonal of a wall", about([2.0, 2.0, 5.0], 5.0)),
        ("on all walls", about([0.0; 3], 10.0)),
        ("on a vertex", corner),
    ]
}

#[test]
fn a_cavity_that_touches_the_skin_in_points_is_outside() {
    let skin = block([-10.0; 3], [10.0; 3]);
    for (name, hole) in touching() {
        let hole_out = inverted(&hole);
        let volume = |(positions, triangles): &Triangles| -> f32 {
            let triple = |t: &[u32; 3]| {
                let [a, b, c] = t.map(|v| positions[v as usize]);
                a[0] * (b[1] * c[2] - b[2] * c[1])
                    + a[1] * (b[2] * c[0] - b[0] * c[2])
                    + a[2] * (b[0] * c[1] - b[1] * c[0])
            };
            triangles.iter().map(triple).sum()
        };
        let cavity = if volume(&hole) < 0.0 { &hole } else { &hole_out };
        let middle = [0, 1, 2].map(|k| hole.0.iter().map(|p| p[k]).sum::<f32>() / 6.0);
        for shape in [joined(&skin, cavity), joined(cavity, &skin)] {
            let blobs = File::of(&shape).trees(TreeOptions::default());
            assert!(!blobs.iter().any(|bytes| has_sideless(bytes)), "{name}");
            for tree in views(&blobs) {
                assert!(tree.has_sides(), "{name}");
                assert_eq!(side(&tree, middle), Side::Outside, "{name}");
                assert_eq!(side(&tree, [-9.0, -9.0, -9.0]), Side::Inside, "{name}");
                assert_eq!(side(&tree, [-11.0, 0.5, 0.0]), Side::Outside, "{name}");
            }
        }
    }
}

#[test]
fn solids_that_share_an_edge_or_touch_along_one_have_all_sides() {
    let one = block([0.0; 3], [2.0; 3]);
    let shared = joined(&one, &block([2.0, 2.0, 0.0], [4.0, 4.0, 2.0]));
    // Its edge lies within the other's.
    let along = joined(&one, &block([2.0, 2.0, 0.5], [4.0, 4.0, 1.5]));
    for shape in [shared, along] {
        let file = File::of(&shape);
        let blobs = file.trees(TreeOptions::default());
        assert!(!blobs.iter().any(|bytes| has_sideless(bytes)));
        assert!(views(&blobs).iter().all(|tree| tree.has_sides()));
        assert!(assert_no_wrong_side(&file, 200, &mut Rng::new(84)) > 380);
    }
}

fn overlapping() -> File {
    File::of(&joined(&torus(2.0, 0.75, 16, 10), &moved(&cube(2), [2.0, 0.0, 0.0])))
}

#[test]
fn sides_that_are_promised_where_the_surface_crosses_itself_are_noticed() {
    let file = overlapping();
    let raw = RawMesh::from_f64(file.positions.clone(), file.triangles.clone());
    let (mesh, _) = repair(raw).expect("a mesh");
    for mut bytes in file.trees(TreeOptions::default()) {
        let bits = entry(&bytes, SIDELESS);
        bytes[bits.offset as usize..][..bits.bytes as usize].fill(0);
        seal(&mut bytes);
        let why = check_tree(&bytes, &mesh).expect_err("promised");
        assert!(why.starts_with("sides are promised, but faces"), "{why}");
    }
}

#[test]
fn sideless_triangles_are_there_if_the_header_says_so() {
    let bytes = overlapping().tree(&TreeOptions::default());
    let open = |bytes: &[u8]| Bvh::open(bytes).map(drop);
    let flags =
        |flags: u8| edited(bytes.clone(), SectionKind::Bvh, |header| header[1] = flags, open);
    let missing = Err(OpenError::MissingSection { section: SectionKind::TreeSideless });
    assert_eq!(flags(17), Ok(()));
    assert_eq!(flags(1), missing, "bits that no flag announces");
    assert_eq!(flags(16), missing, "bits of a mesh that is not closed");
    assert_eq!(flags(21), missing, "bits of a tree without sides");
    assert_eq!(flags(49), Err(OpenError::Reserved));
    let ask = |bytes: &[u8]| {
        Bvh::open(bytes).map(|tree| {
            side(&tree, [0.1, 0.2, 0.3]);
        })
    };
    assert_damage_is_safe(&[bytes], SectionKind::TreeSideless, 3, (500, 3), ask);
}
