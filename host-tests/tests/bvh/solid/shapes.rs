//! Solids with their boundaries, and how far a mesh truly is from them.

use meshsweep_core::internal::tribox::FACES;
use meshsweep_core::{Solid, Tribox};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::generate::corpus::IDENTITY;
use meshsweep_host_tests::oracle::{
    Bounded, contacts, distance_of_meshes, distance_of_moved_triangles, gap_to_triangle,
};
use meshsweep_host_tests::scene::Scene;

pub type Point = [f32; 3];

/// A solid, and the triangles of its hull's boundary if it has more than two corners.
#[derive(Clone, Debug)]
pub struct Shape {
    pub corners: Vec<Point>,
    pub faces: Vec<[u32; 3]>,
    pub radius: f32,
}

impl Shape {
    pub fn solid(&self) -> Solid<'_> {
        Solid::new(&self.corners, self.radius).expect("a solid")
    }

    fn new(corners: &[Point], faces: &[[u32; 3]], radius: f32) -> Self {
        Self { corners: corners.to_vec(), faces: faces.to_vec(), radius }
    }

    pub fn sphere(centre: Point, radius: f32) -> Self {
        Self::new(&[centre], &[], radius)
    }

    pub fn capsule(a: Point, b: Point, radius: f32) -> Self {
        Self::new(&[a, b], &[], radius)
    }

    pub fn triangle(corners: [Point; 3], radius: f32) -> Self {
        Self::new(&corners, &[[0, 1, 2]], radius)
    }

    pub fn tetrahedron(corners: [Point; 4], radius: f32) -> Self {
        Self::new(&corners, &[[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]], radius)
    }

    pub fn cuboid(low: Point, high: Point, radius: f32) -> Self {
        let quads =
            [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
        let faces: Vec<[u32; 3]> =
            quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Self::new(&Solid::box_corners(low, high), &faces, radius)
    }

    /// The least tribox of some points, up to its rounding.
    pub fn tribox(points: &[Point], radius: f32) -> Self {
        let tribox = Tribox::of_points(points.iter().copied()).expect("finite points");
        let boundary = tribox.on_grid().boundary();
        let mut faces = Vec::new();
        for face in 0..FACES {
            if let [first, rest @ ..] = boundary.face(face) {
                faces.extend(rest.windows(2).map(|two| [*first, two[0], two[1]].map(u32::from)));
            }
        }
        Self::new(&tribox.corners(), &faces, radius)
    }

    /// Of every kind, about as large as `size` or far smaller, near `at`.
    pub fn random(kind: usize, at: Point, size: f32, rng: &mut Rng) -> Self {
        let size = size * [1.0, 0.2, 1e-3][rng.below(3)];
        let radius = if rng.below(3) == 0 { 0.0 } else { 0.3 * size * rng.unit_f32() };
        let mut near = || {
            let d = rng.point_in([-size; 3], [size; 3]);
            [0, 1, 2].map(|k| at[k] + d[k])
        };
        match kind % 6 {
            0 => Self::sphere(at, radius),
            1 => Self::capsule(near(), near(), radius),
            2 => Self::triangle([near(), near(), near()], radius),
            3 => Self::tetrahedron([near(), near(), near(), near()], radius),
            4 => Self::tribox(&[near(), near(), near(), near(), near()], radius),
            _ => {
                let (a, b) = (near(), near());
                let low = [0, 1, 2].map(|k: usize| a[k].min(b[k]));
                let high = [0, 1, 2].map(|k: usize| a[k].max(b[k]));
                Self::cuboid(low, high, radius)
            }
        }
    }

    /// Whether a point is in the hull, by signs of volumes in f64; points next to a face count as
    /// outside.
    fn holds(&self, p: Point) -> bool {
        let wide = |p: Point| p.map(f64::from);
        let middle: [f64; 3] = std::array::from_fn(|k| {
            self.corners.iter().map(|c| f64::from(c[k])).sum::<f64>() / self.corners.len() as f64
        });
        self.faces.len() >= 4
            && self.faces.iter().all(|face| {
                let [a, b, c] = face.map(|v| wide(self.corners[v as usize]));
                let (inside, there) = (volume(a, b, c, middle), volume(a, b, c, wide(p)));
                inside * there > 0.0 && there.abs() > 1e-9 * inside.abs()
            })
    }

    /// The distance of the hull of the corners from the mesh, without the radius.
    pub fn truth(&self, scene: &Scene) -> Bounded {
        let meets = Bounded { lower: 0.0, upper: 0.0 };
        let mesh = (&scene.positions[..], &scene.triangles[..]);
        match self.corners[..] {
            [a] => return scene.truth(a),
            [a, b] if a == b => return scene.truth(a),
            [a, b] if !contacts(a, b, mesh.0, mesh.1).is_empty() => return meets,
            [a, b] => return distance_of_segment(a, b, scene),
            _ => {}
        }
        if scene.triangles.iter().flatten().any(|&v| self.holds(scene.positions[v as usize])) {
            return meets;
        }
        distance_of_meshes(mesh, (&self.corners, &self.faces), &IDENTITY, [0.0; 3])
    }
}

/// The distance of a segment that does not meet the mesh.
fn distance_of_segment(a: Point, b: Point, scene: &Scene) -> Bounded {
    let mut best = Bounded { lower: f64::INFINITY, upper: f64::INFINITY };
    for triangle in 0..scene.triangles.len() as u32 {
        let corners = scene.corners(triangle);
        if gap_to_triangle(a, b, corners) * 0.999 > best.upper {
            continue;
        }
        let found = distance_of_moved_triangles(corners, [a, b, b], &IDENTITY, [0.0; 3]);
        best.lower = best.lower.min(found.lower);
        best.upper = best.upper.min(found.upper);
    }
    best
}

fn volume(a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]) -> f64 {
    let minus = |p: [f64; 3]| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
    let ([a, b, c], [d, e, f], [g, h, i]) = (minus(b), minus(c), minus(d));
    a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
}
