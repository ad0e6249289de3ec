//! Solids that are known, and what no input may break.

use super::{Dimension, HalfSpace, MAX_OFFSET, Polytope, Ratio};
use crate::generate::Rng;

const AXES: [[i64; 3]; 3] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
const EDGES: [[i64; 3]; 6] = [[1, 1, 0], [1, -1, 0], [0, 1, 1], [0, 1, -1], [1, 0, 1], [-1, 0, 1]];
const CORNERS: [[i64; 3]; 4] = [[1, 1, 1], [1, 1, -1], [1, -1, 1], [-1, 1, 1]];

/// |n·x| ≤ `offset` for each normal.
fn slabs(normals: &[[i64; 3]], offset: i64) -> Vec<HalfSpace> {
    let pair = |n: &[i64; 3]| [HalfSpace::new(*n, offset), HalfSpace::new(n.map(|x| -x), offset)];
    normals.iter().flat_map(pair).collect()
}

fn both(first: Vec<HalfSpace>, second: Vec<HalfSpace>) -> Polytope {
    Polytope::new(&[first, second].concat())
}

/// Vertices, edges and faces.
fn counts(polytope: &Polytope) -> [usize; 3] {
    polytope.check_graph().expect("a polyhedron");
    let sides: usize = polytope.distinct_faces().map(|(_, face)| face.len()).sum();
    [polytope.vertices().len(), sides / 2, polytope.distinct_faces().count()]
}

fn near(value: f64, wanted: f64) {
    assert!((value - wanted).abs() <= 1e-12 * wanted.abs().max(1.0), "{value} is not {wanted}");
}

#[test]
fn a_cube_has_its_faces_wound_outwards() {
    let cube = Polytope::new(&slabs(&AXES, 1));
    assert_eq!((cube.dimension(), counts(&cube)), (Dimension::Solid, [8, 12, 6]));
    near(cube.volume(), 8.0);
    near(cube.area(), 24.0);
    assert!(cube.vertices().iter().all(|v| v.planes.len() == 3 && v.denominator == 1));
    for plane in 0..6 {
        let corners: Vec<[f64; 3]> =
            cube.face(plane).iter().map(|v| cube.vertices()[*v].position()).collect();
        let [a, b, c] = [corners[0], corners[1], corners[2]];
        let normal = super::cross(super::minus(b, a), super::minus(c, a));
        assert_eq!(normal, cube.planes()[plane].normal.map(|x| 4.0 * x as f64));
    }
}

#[test]
fn an_octahedron_has_four_planes_through_each_vertex() {
    let octahedron = Polytope::new(&slabs(&CORNERS, 3));
    assert_eq!(counts(&octahedron), [6, 12, 8]);
    assert!(octahedron.vertices().iter().all(|v| v.planes.len() == 4));
    near(octahedron.volume(), 36.0);
    near(octahedron.area(), 36.0 * 3.0f64.sqrt());
}

#[test]
fn a_chamfered_cube_has_four_vertices_a_corner() {
    let tribox = both(slabs(&AXES, 2), slabs(&EDGES, 3));
    assert_eq!(counts(&tribox), [32, 48, 18]);
    // An eighth of the cube, 8, loses 3 · 1 to three chamfers, of which pairs share 1/3 and all
    // three 1/4.
    near(tribox.volume(), 8.0 * (8.0 - 3.0 + 1.0 - 0.25));
    assert!((0..18).all(|plane| tribox.is_tight(plane) && !tribox.is_degenerate(plane)));
    let halves = tribox.vertices().iter().filter(|v| v.denominator == 2);
    assert!(halves.map(|v| v.numerator.map(i64::abs)).eq([[3, 3, 3]; 8]));
}

#[test]
fn planes_that_only_touch_have_degenerate_faces() {
    let dodecahedron = both(slabs(&AXES, 2), slabs(&EDGES, 2));
    assert_eq!(counts(&dodecahedron), [14, 24, 12]);
    near(dodecahedron.volume(), 16.0);
    assert!((0..6).all(|plane| dodecahedron.is_degenerate(plane) && dodecahedron.is_tight(plane)));
    assert!((0..6).all(|plane| dodecahedron.face(plane).len() == 1));
}

#[test]
fn a_redundant_plane_has_a_lower_tight_offset() {
    let tribox = both(slabs(&AXES, 3), slabs(&EDGES, 7));
    assert_eq!(counts(&tribox), [8, 12, 6]);
    for plane in 6..18 {
        assert!(!tribox.is_tight(plane) && tribox.is_degenerate(plane));
        assert_eq!(tribox.tight_offset(plane), Some(Ratio::from(6)));
        assert!(tribox.tight_offset(plane) < Some(Ratio::from(7)));
    }
    assert_eq!(tribox.support([2, 1, 0]), Some(Ratio::from(9)));
}

#[test]
fn coinciding_planes_are_one_face() {
    let cube = both(slabs(&AXES, 1), slabs(&AXES.map(|n| n.map(|x| 2 * x)), 2));
    assert_eq!(counts(&cube), [8, 12, 6]);
    assert_eq!(cube.face(0), cube.face(6));
    near(cube.volume(), 8.0);
}

#[test]
fn what_is_flat_is_a_polygon_a_segment_or_a_point() {
    let plate = both(slabs(&AXES[..2], 1), slabs(&AXES[2..], 0));
    assert_eq!((plate.dimension(), plate.vertices().len()), (Dimension::Polygon, 4));
    assert_eq!(plate.volume(), 0.0);
    near(plate.area(), 8.0);
    let mut seen_from_below = plate.face(5).to_vec();
    seen_from_below[1..].reverse();
    assert_eq!(seen_from_below, plate.face(4));
    // Across the grid: x + y = 0.
    let slanted = both(slabs(&AXES, 1), slabs(&[[1, 1, 0]], 0));
    assert_eq!(slanted.dimension(), Dimension::Polygon);
    near(slanted.area(), 8.0 * 2.0f64.sqrt());
    let segment = both(slabs(&AXES[..1], 1), slabs(&AXES[1..], 0));
    assert_eq!(segment.dimension(), Dimension::Segment);
    let point = both(slabs(&AXES, 0), slabs(&EDGES, 0));
    assert_eq!((point.dimension(), point.vertices()[0].planes.len()), (Dimension::Point, 18));
    for flat in [&segment, &point] {
        assert_eq!((flat.volume(), flat.area(), flat.check_graph()), (0.0, 0.0, Ok(())));
    }
}

#[test]
fn contradictions_are_empty() {
    let empty = both(slabs(&AXES, 5), vec![HalfSpace::new([1, 1, 0], -11)]);
    assert!(empty.is_empty());
    assert_eq!((empty.dimension(), empty.tight_offset(0)), (Dimension::Empty, None));
    assert_eq!((empty.volume(), empty.area()), (0.0, 0.0));
    // By half a unit, between the integers: x + y ≥ 1, y + z ≥ 1, x + z ≥ 1, x + y + z ≤ 1.
    let parity = [[-1, -1, 0], [0, -1, -1], [-1, 0, -1]].map(|n| HalfSpace::new(n, -1)).to_vec();
    assert!(both(parity.clone(), vec![HalfSpace::new([1, 1, 1], 1)]).is_empty());
    let whole = parity.into_iter().map(|plane| HalfSpace::new(plane.normal, -2)).collect();
    assert_eq!(both(whole, vec![HalfSpace::new([1, 1, 1], 3)]).dimension(), Dimension::Point);
}

#[test]
fn the_largest_numbers_do_not_overflow() {
    let longest = [[8, 8, 8], [8, -8, 8], [8, 8, -8], [-8, 8, 8], [8, 7, -8], [7, 8, 5]];
    let polytope = Polytope::new(&slabs(&longest, MAX_OFFSET));
    assert_eq!(polytope.dimension(), Dimension::Solid);
    polytope.check_graph().expect("a polyhedron");
    for plane in 0..12 {
        assert!(polytope.tight_offset(plane) <= Some(Ratio::from(MAX_OFFSET)));
    }
}

#[test]
fn random_slabs_are_polyhedra_that_shrink_with_every_plane() {
    let mut rng = Rng::new(1999);
    let mut solids = 0;
    for round in 0..3_000 {
        let normals = if round % 2 == 0 {
            [&AXES[..], &EDGES].concat()
        } else {
            [&AXES[..], &CORNERS].concat()
        };
        // Small offsets, so that planes meet by chance and many inputs are flat or empty.
        let reach: i64 = [3, 20, 1 << 20][round % 3];
        let mut offset = || rng.below(reach as usize).cast_signed() as i64 - reach / 8;
        let planes: Vec<HalfSpace> = slabs(&normals, 0)
            .into_iter()
            .map(|plane| HalfSpace::new(plane.normal, offset()))
            .collect();
        let polytope = Polytope::new(&planes);
        polytope.check_graph().unwrap_or_else(|error| panic!("{planes:?}: {error}"));
        let fewer = Polytope::new(&planes[..planes.len() - 1]);
        assert!(polytope.volume() <= fewer.volume() * (1.0 + 1e-12) + 1e-12, "{planes:?}");
        assert!(polytope.dimension() <= fewer.dimension());
        for (plane, given) in planes.iter().enumerate() {
            let tight = polytope.tight_offset(plane);
            assert!(tight.is_none_or(|tight| tight <= Ratio::from(given.offset)));
            assert_eq!(tight == Some(Ratio::from(given.offset)), polytope.is_tight(plane));
        }
        solids += usize::from(polytope.dimension() == Dimension::Solid);
    }
    assert!((500..2_900).contains(&solids), "{solids} solids");
}
