//! Meshes with their trees, and where to put segments.

use super::soup::soups;
use meshsweep::emit::blob;
use meshsweep::mesh::Mesh;
use meshsweep::tree::{TreeOptions, build};
use meshsweep_core::Bvh;
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, cube, groove_block, icosphere, inverted, joined, needle_comb,
    rough_sphere, scaled, torus, transformed, two_parts, uv_sphere,
};

pub type Point = [f32; 3];

/// A mesh as it was given, and the blobs of its trees: on a grid, then with f32 vertices.
pub struct Scene {
    pub name: String,
    pub positions: Vec<Point>,
    pub triangles: Vec<[u32; 3]>,
    pub blobs: [Vec<u8>; 2],
}

pub fn add(p: Point, d: Point, by: f32) -> Point {
    std::array::from_fn(|k| p[k] + by * d[k])
}

impl Scene {
    pub fn new(name: &str, mesh: Triangles) -> Scene {
        Scene::moved(name, mesh, 0.0, 0)
    }

    /// The blobs are of a mesh whose vertices were moved by up to `by` before, which their surface
    /// error says.
    pub fn moved(name: &str, (positions, triangles): Triangles, by: f32, seed: u64) -> Scene {
        let rng = &mut Rng::new(seed);
        let stored = positions
            .iter()
            .map(|&p| if by > 0.0 { add(p, rng.direction(), 0.99 * by) } else { p });
        let mesh = Mesh::new(stored.collect(), triangles.clone());
        let blobs = [false, true].map(|single| {
            let options = TreeOptions { closest: false, single, ..TreeOptions::default() };
            let (tables, _) = build(&mesh, f64::from(by), triangles.len(), &options);
            blob(None, Some(&tables))
        });
        Scene { name: name.to_owned(), positions, triangles, blobs }
    }

    pub fn trees(&self) -> [Bvh<'_>; 2] {
        self.blobs.each_ref().map(|bytes| Bvh::open(bytes).expect("opens"))
    }

    pub fn corners(&self, triangle: usize) -> [Point; 3] {
        self.triangles[triangle].map(|v| self.positions[v as usize])
    }

    /// Least and greatest corner.
    pub fn bounds(&self) -> (Point, Point) {
        let fold = |f: fn(f32, f32) -> f32| {
            std::array::from_fn(|k| self.positions.iter().map(|p| p[k]).reduce(f).unwrap_or(0.0))
        };
        (fold(f32::min), fold(f32::max))
    }

    /// Longest side of the box; for a point, some steps of its largest coordinate.
    pub fn size(&self) -> f32 {
        let (low, high) = self.bounds();
        let size = (0..3).map(|k| high[k] - low[k]).fold(0.0, f32::max);
        let largest = self.positions.iter().flatten().fold(0f32, |m, x| m.max(x.abs()));
        if size > 0.0 { size } else { largest / 65_536.0 }
    }

    pub fn on_triangle(&self, rng: &mut Rng) -> Point {
        let [a, b, c] = self.corners(rng.below(self.triangles.len()));
        let (mut u, mut v) = (rng.unit_f64(), rng.unit_f64());
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        std::array::from_fn(|k| {
            let [a, b, c] = [a[k], b[k], c[k]].map(f64::from);
            (a + u * (b - a) + v * (c - a)) as f32
        })
    }

    pub fn vertex(&self, rng: &mut Rng) -> Point {
        self.positions[rng.below(self.positions.len())]
    }

    /// A random point in the box grown to `factor` times its size.
    pub fn around(&self, factor: f32, rng: &mut Rng) -> Point {
        let (low, high) = self.bounds();
        let size = self.size();
        std::array::from_fn(|k| {
            let (middle, half) =
                (0.5 * low[k] + 0.5 * high[k], 0.5 * (high[k] - low[k]) + 0.05 * size);
            middle + half * factor * rng.range(-1.0, 1.0)
        })
    }
}

pub const IDENTITY: [Point; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Closed solids.
pub fn solids() -> Vec<(&'static str, Triangles)> {
    let far = [1e6, -1.5e6, 2e6];
    vec![
        ("torus", torus(2.0, 0.75, 20, 10)),
        ("bracket", bracket()),
        ("spiky sphere", rough_sphere(2, 0.8, 3)),
        ("groove block", groove_block()),
        ("needle comb", needle_comb()),
        ("cube", cube(3)),
        ("box of twelve", cube(1)),
        ("sphere of meridians", uv_sphere(24, 12)),
        ("inverted icosphere", inverted(&icosphere(2))),
        ("two parts", two_parts()),
        ("torus × 1e-30", scaled(&torus(2.0, 0.75, 16, 8), 1e-30)),
        ("spiky sphere × 1e30", scaled(&rough_sphere(2, 0.8, 3), 1e30)),
        ("groove block × 1e-30", scaled(&groove_block(), 1e-30)),
        ("cube far away", transformed(&cube(3), IDENTITY, far)),
        ("two parts × 64 far away", transformed(&scaled(&two_parts(), 64.0), IDENTITY, far)),
        ("corner touch", corner_touch()),
    ]
}

/// Two cubes that share one vertex, and a third that shares an edge with the first.
fn corner_touch() -> Triangles {
    let moved = |by| transformed(&cube(1), IDENTITY, by);
    joined(&joined(&cube(1), &moved([2.0, 2.0, 2.0])), &moved([-2.0, -2.0, 0.0]))
}

/// Solids, soups, and solids whose blobs are of other vertices.
pub fn all() -> Vec<Scene> {
    let mut meshes = solids();
    meshes.extend(soups());
    let mut scenes: Vec<Scene> =
        meshes.into_iter().map(|(name, mesh)| Scene::new(name, mesh)).collect();
    scenes.push(Scene::moved("moved cube", cube(3), 1e-3, 5));
    scenes.push(Scene::moved("moved sphere", rough_sphere(2, 0.2, 1), 3e-2, 6));
    scenes.push(Scene::moved("moved torus", torus(2.0, 0.75, 16, 8), 1e-6, 7));
    scenes
}
