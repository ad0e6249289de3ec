//! Meshes where floating point is at its worst, and points to ask about them.

use super::corpus::{IDENTITY, add};
use super::{Rng, Triangles, cube, icosphere, inverted, joined, scaled, torus, transformed};

type Point = [f32; 3];

/// A mesh at an end of what a mesh may be.
#[derive(Clone, Debug)]
pub struct Extreme {
    /// What is extreme about it, as tests are named.
    pub name: &'static str,
    /// The mesh.
    pub mesh: Triangles,
    /// Whether a hull hierarchy must take it.
    pub is_solid: bool,
}

/// Offsets of queries from the surface, in diagonals of the mesh.
const OFFSETS: [f32; 10] = [1e-20, 1e-10, 1e-7, 1e-5, 1e-2, 1.0, 1e3, 1e6, 1e10, 1e20];

/// All of them. No mesh has more than 100 triangles.
#[must_use]
pub fn extremes() -> Vec<Extreme> {
    let solid = |name, mesh| Extreme { name, mesh, is_solid: true };
    let soup = |name, mesh| Extreme { name, mesh, is_solid: false };
    let ring = torus(2.0, 0.75, 6, 4);
    let ball = icosphere(1);
    let moved = |mesh: &Triangles, by| transformed(mesh, IDENTITY, by);
    let unit_cube = moved(&scaled(&cube(1), 0.5), [0.5; 3]);
    let mut open = torus(2.0, 0.75, 6, 4);
    open.1.truncate(41);
    vec![
        solid("scale_1e_minus_30", scaled(&ring, 1e-30)),
        solid("scale_1e30", scaled(&ring, 1e30)),
        solid("subnormal_coordinates", scaled(&ring, 1e-38)),
        solid("the_largest_numbers", scaled(&cube(1), 3e38)),
        soup("scales_1e_minus_30_to_1e30_in_one_mesh", of_all_scales()),
        // The diagonal is 8.
        solid("ten_thousand_diagonals_away", moved(&ring, [8e4, -5e4, 3e4])),
        solid("ten_thousand_diagonals_along_one_axis", moved(&ring, [8e4, 0.0, 0.0])),
        // The least cube whose corners f32 tells apart.
        solid("ten_million_diagonals_away", moved(&unit_cube, [16_777_215.0, 0.0, 0.0])),
        solid("a_tower_of_aspect_1e8", tower()),
        soup("needles_of_aspect_1e8", needles(false)),
        soup("slivers_of_aspect_1e8", needles(true)),
        soup("coplanar_triangles_that_overlap", coplanar()),
        soup("collinear_corners", collinear()),
        soup("coincident_triangles", coincident()),
        soup("points_lines_and_triangles", zero_area()),
        soup("a_lattice_of_equal_distances", lattice()),
        solid("a_sphere", ball),
        soup("one_triangle", separate(&[SLANTED])),
        soup("two_triangles", (SQUARE.to_vec(), vec![[0, 1, 2], [0, 2, 3]])),
        solid("four_triangles", tetrahedron()),
        solid("surfaces_that_cross", joined(&cube(1), &moved(&cube(1), [0.5, 0.75, 1.0]))),
        solid("a_solid_in_a_solid", joined(&cube(1), &scaled(&cube(1), 0.25))),
        solid("a_cavity", joined(&cube(1), &inverted(&scaled(&cube(1), 0.25)))),
        soup("an_open_mesh", open),
    ]
}

const SLANTED: [Point; 3] = [[0.1, 0.2, 0.3], [1.1, 0.4, -0.2], [0.3, 1.5, 0.7]];

const SQUARE: [Point; 4] = [[0.0; 3], [1.0, 0.0, 0.5], [1.0, 1.0, 0.5], [0.0, 1.0, 0.0]];

fn separate(corners: &[[Point; 3]]) -> Triangles {
    let count = corners.len() as u32;
    (corners.concat(), (0..count).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect())
}

fn tetrahedron() -> Triangles {
    let positions = vec![[0.0; 3], [1.0, 0.1, 0.2], [0.3, 1.2, -0.1], [0.2, 0.4, 0.9]];
    (positions, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
}

/// Tetrahedra about the origin, each 1e15 times as large as the one before.
fn of_all_scales() -> Triangles {
    let scales = [1e-30, 1e-15, 1.0, 1e15, 1e30];
    let all = scales.map(|scale| scaled(&tetrahedron(), scale));
    all.into_iter().reduce(|all, more| joined(&all, &more)).unwrap_or_default()
}

/// A tetrahedron 1e8 times as high as wide.
fn tower() -> Triangles {
    let (mut positions, triangles) = tetrahedron();
    positions[3] = [0.25, 0.5, 1e8];
    (positions, triangles)
}

/// Triangles 1e8 times as long as high, with one short side or with none.
fn needles(is_sliver: bool) -> Triangles {
    let rng = &mut Rng::new(8);
    let triangle = |at: usize| {
        // Beside the origin, for f32 tells no heights of 1e-8 apart elsewhere.
        let mut way: Point = [0.0; 3];
        let mut aside: Point = [0.0; 3];
        way[at % 3] = rng.range(0.5, 1.0);
        aside[(at + 1) % 3] = 1e-8;
        let from: Point = std::array::from_fn(|k| if way[k] == 0.0 { 0.0 } else { -0.3 });
        let t = if is_sliver { rng.range(0.2, 0.8) } else { 0.0 };
        [from, add(from, way, 1.0), add(add(from, way, t), aside, 1.0)]
    };
    separate(&(0..9).map(triangle).collect::<Vec<_>>())
}

fn coplanar() -> Triangles {
    let rng = &mut Rng::new(9);
    // Coordinates of few bits, so that z = x + y / 2 is exact.
    let mut corner = || {
        let [x, y] = [(); 2].map(|()| (rng.range(-2.0, 2.0) * 1024.0).round() / 1024.0);
        [x, y, x + 0.5 * y]
    };
    separate(&(0..12).map(|_| [corner(), corner(), corner()]).collect::<Vec<_>>())
}

fn collinear() -> Triangles {
    let at = |t: f32| [t, 0.5 * t, -0.25 * t];
    separate(&[
        [at(0.0), at(1.0), at(2.0)],
        [at(3.0), at(-1.0), at(1.5)],
        [at(0.0), at(2.0), [1.0, 1.0, 1.0]],
    ])
}

fn coincident() -> Triangles {
    let [a, b, c] = SLANTED;
    separate(&[[a, b, c], [b, c, a], [a, c, b], [a, b, c], [a, b, [0.0; 3]]])
}

fn zero_area() -> Triangles {
    let [a, b, c] = SLANTED;
    separate(&[[a, a, a], [[2.0; 3]; 3], [a, b, b], [c, [3.0, 2.0, 1.0], c], [a, b, c]])
}

/// Triangles on the points of a grid, all alike.
fn lattice() -> Triangles {
    let place = |i: u32| [i % 3, i / 3 % 3, i / 9].map(|x| 4.0 * x as f32 - 4.0);
    let small = [[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.5, 0.0]];
    let at = |i: u32| small.map(|corner| add(corner, place(i), 1.0));
    separate(&(0..27).map(at).collect::<Vec<_>>())
}

/// Points to ask about a mesh: at vertices, on edges and faces, on medial axes, at centres, from
/// 1e-20 to 1e20 diagonals off, and at the ends of f32.
#[must_use]
pub fn extreme_points((positions, triangles): &Triangles) -> Vec<Point> {
    let rng = &mut Rng::new(10);
    let bound = |f: fn(f32, f32) -> f32| -> Point {
        [0, 1, 2].map(|k| positions.iter().map(|p| p[k]).reduce(f).unwrap_or_default())
    };
    let (low, high) = (bound(f32::min), bound(f32::max));
    let half = (0..3).map(|k| (0.5 * high[k] - 0.5 * low[k]).powi(2)).sum::<f32>().sqrt();
    // The squares may overflow or vanish.
    let largest = (0..3).map(|k| 0.5 * high[k] - 0.5 * low[k]).fold(0.0, f32::max);
    let diagonal = 2.0 * if half.is_normal() && half < 1e19 { half } else { largest };
    let middle = |a: Point, b: Point| std::array::from_fn(|k| 0.5 * a[k] + 0.5 * b[k]);
    let mut corners = || triangles[rng.below(triangles.len())].map(|v| positions[v as usize]);
    let [a, b, c] = corners();
    let [d, e, f] = corners();
    let centre = |a: Point, b, c| add([0.0; 3], add(add(a, b, 1.0), c, 1.0), 1.0 / 3.0);
    let mut points = vec![
        a,
        d,
        middle(a, b),
        middle(e, f),
        middle(middle(a, b), c),
        centre(d, e, f),
        // As far from one as from the other.
        middle(a, d),
        middle(middle(a, b), middle(d, f)),
        middle(low, high),
        [0.0; 3],
        [2.0, 2.0, 2.0],
        [1e-45, -1e-40, 1e-38],
        [f32::MAX, 0.0, -1.0],
        [-f32::MAX; 3],
    ];
    for (number, by) in OFFSETS.into_iter().enumerate() {
        let (on, way) = ([a, middle(b, c), middle(d, e)][number % 3], rng.direction());
        points.push(add(on, way.map(|x| x * by), diagonal));
        points.push(add(d, [0.0, 0.0, by], diagonal));
    }
    points.retain(|p| p.iter().all(|x| x.is_finite()));
    points
}
