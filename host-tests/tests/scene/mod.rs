//! Meshes with their blobs, and where to put queries.
#![allow(dead_code, reason = "each test binary uses a part")]

use meshsweep::hull::{BuildOptions, build};
use meshsweep::mesh::{RawMesh, repair, require_closed_manifold};
use meshsweep::precision::VertexBits;
use meshsweep_core::Model;
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, cube, groove_block, needle_comb, rough_sphere, scaled, torus,
    transformed, two_parts,
};

/// A mesh as it was given, and its blob.
pub struct Scene {
    pub name: String,
    pub positions: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
    pub bytes: Vec<u8>,
}

pub fn options(base_faces: usize) -> BuildOptions {
    BuildOptions { base_faces, ..BuildOptions::default() }
}

impl Scene {
    pub fn new(name: impl Into<String>, mesh: Triangles, options: &BuildOptions) -> Scene {
        let name = name.into();
        let (positions, triangles) = mesh;
        let (repaired, _) =
            repair(RawMesh::from_f32(&positions, &triangles)).expect("a sound mesh");
        require_closed_manifold(&repaired).expect("a closed mesh");
        let built = build(&repaired, 0.0, triangles.len(), options, |_| ()).expect("builds");
        Scene { name, positions, triangles, bytes: built.bytes }
    }

    pub fn model(&self) -> Model<'_> {
        Model::open(&self.bytes).expect("opens")
    }

    pub fn corners(&self, triangle: u32) -> [[f32; 3]; 3] {
        self.triangles[triangle as usize].map(|v| self.positions[v as usize])
    }

    /// Least and greatest corner.
    pub fn bounds(&self) -> ([f32; 3], [f32; 3]) {
        let fold = |f: fn(f32, f32) -> f32| {
            std::array::from_fn(|k| self.positions.iter().map(|p| p[k]).reduce(f).unwrap_or(0.0))
        };
        (fold(f32::min), fold(f32::max))
    }

    /// Longest side of the box.
    pub fn size(&self) -> f32 {
        let (low, high) = self.bounds();
        (0..3).map(|k| high[k] - low[k]).fold(0.0, f32::max)
    }

    /// Largest coordinate: what rounding is relative to.
    pub fn reach(&self) -> f64 {
        self.positions.iter().flatten().fold(0f64, |m, x| m.max(f64::from(x.abs())))
    }

    /// A random point of triangle `t`, rounded.
    pub fn on_triangle(&self, t: u32, rng: &mut Rng) -> [f32; 3] {
        let [a, b, c] = self.corners(t);
        let (mut u, mut v) = (rng.unit_f64(), rng.unit_f64());
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        std::array::from_fn(|k| {
            let [a, b, c] = [a[k], b[k], c[k]].map(f64::from);
            (a + u * (b - a) + v * (c - a)) as f32
        })
    }

    /// A random point in the box grown to `factor` times its size.
    pub fn around(&self, factor: f32, rng: &mut Rng) -> [f32; 3] {
        let (low, high) = self.bounds();
        std::array::from_fn(|k| {
            let (middle, half) = (0.5 * low[k] + 0.5 * high[k], 0.5 * (high[k] - low[k]));
            middle + half * factor * rng.range(-1.0, 1.0)
        })
    }

    /// Points of every kind that the distance has trouble with.
    pub fn points(&self, count: usize, rng: &mut Rng) -> Vec<[f32; 3]> {
        let size = self.size();
        let mut points = Vec::with_capacity(count);
        for i in 0..count {
            let t = rng.below(self.triangles.len()) as u32;
            let on = self.on_triangle(t, rng);
            let d = rng.direction();
            points.push(match i % 8 {
                0 => on,
                1 => self.corners(t)[rng.below(3)],
                2 => std::array::from_fn(|k| on[k] + d[k] * size * 1e-7),
                3 => std::array::from_fn(|k| on[k] + d[k] * size * 1e-3),
                4 => self.around(3.0, rng),
                5 => std::array::from_fn(|k| on[k] + d[k] * size * 1e3),
                _ => self.around(1.0, rng),
            });
        }
        points
    }
}

pub const IDENTITY: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn moved(mesh: &Triangles, shift: [f32; 3]) -> Triangles {
    transformed(mesh, IDENTITY, shift)
}

/// Every generated mesh once, as it is.
pub fn plain() -> Vec<Scene> {
    vec![
        Scene::new("torus", torus(2.0, 0.75, 24, 12), &options(40)),
        Scene::new("bracket", bracket(), &options(300)),
        Scene::new("rough sphere", rough_sphere(3, 0.2, 7), &options(60)),
        Scene::new("groove block", groove_block(), &options(30)),
        Scene::new("needle comb", needle_comb(), &options(100)),
        Scene::new("cube", cube(4), &options(12)),
        Scene::new("two parts", two_parts(), &options(60)),
    ]
}

/// Tiny, huge, far from the origin, and moved to a grid.
pub fn stretched() -> Vec<Scene> {
    let bits = |vertex_bits| BuildOptions { vertex_bits, ..options(40) };
    let far = [1e6, -1.5e6, 2e6];
    vec![
        Scene::new("torus × 1e-30", scaled(&torus(2.0, 0.75, 24, 12), 1e-30), &options(40)),
        Scene::new("torus × 1e30", scaled(&torus(2.0, 0.75, 24, 12), 1e30), &options(40)),
        Scene::new("rough sphere × 1e-30", scaled(&rough_sphere(2, 0.2, 3), 1e-30), &options(40)),
        Scene::new("groove block × 1e30", scaled(&groove_block(), 1e30), &options(40)),
        Scene::new("cube far away", moved(&cube(4), far), &options(12)),
        Scene::new(
            "two parts × 64 far away",
            moved(&scaled(&two_parts(), 64.0), far),
            &options(60),
        ),
        Scene::new("rough sphere, 16 bits", rough_sphere(3, 0.2, 7), &bits(VertexBits::Grid16)),
        Scene::new("torus, 24 bits", torus(2.0, 0.75, 24, 12), &bits(VertexBits::Grid24)),
        Scene::new("bracket, f32", bracket(), &bits(VertexBits::F32)),
    ]
}

/// All of them.
pub fn all() -> Vec<Scene> {
    let mut scenes = plain();
    scenes.extend(stretched());
    scenes
}
