//! Meshes with their trees, where to put queries, and the truth about them.

use meshsweep::emit::blob;
use meshsweep::mesh::Mesh;
use meshsweep::tree::{TreeOptions, build};
use meshsweep_core::Bvh;
use meshsweep_core::query::tree::ScratchEntry;
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, cube, groove_block, icosphere, needle_comb, rough_sphere, scaled,
    torus, transformed, two_parts, uv_sphere,
};
use meshsweep_host_tests::oracle::{Bounded, distance_to_mesh, distance_to_triangle};

/// Stack entries that are enough for every scene.
pub const STACK: usize = 4096;

/// A mesh as it was given, and the blob of its tree.
pub struct Scene {
    pub name: String,
    pub positions: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
    pub bytes: Vec<u8>,
}

pub fn stack(entries: usize) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; entries]
}

impl Scene {
    pub fn new(name: &str, (positions, triangles): Triangles, single: bool) -> Scene {
        let mesh = Mesh::new(positions.clone(), triangles.clone());
        let options = TreeOptions { segments: false, single, ..TreeOptions::default() };
        let (tables, _) = build(&mesh, 0.0, triangles.len(), &options);
        let name = format!("{name}{}", if single { ", f32" } else { "" });
        Scene { name, positions, triangles, bytes: blob(None, Some(&tables)) }
    }

    pub fn tree(&self) -> Bvh<'_> {
        Bvh::open(&self.bytes).expect("opens")
    }

    pub fn corners(&self, triangle: u32) -> [[f32; 3]; 3] {
        self.triangles[triangle as usize].map(|v| self.positions[v as usize])
    }

    pub fn truth(&self, p: [f32; 3]) -> Bounded {
        distance_to_mesh(p, &self.positions, &self.triangles)
    }

    pub fn truth_of(&self, p: [f32; 3], triangle: u32) -> Bounded {
        distance_to_triangle(p, self.corners(triangle))
    }

    /// Input numbers of the triangles in the order of the blob.
    pub fn order(&self) -> Vec<u32> {
        let tree = self.tree();
        (0..tree.header().triangles).map(|t| tree.source(t).expect("in range")).collect()
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

    /// Largest coordinate.
    pub fn reach(&self) -> f64 {
        self.positions.iter().flatten().fold(0f64, |m, x| m.max(f64::from(x.abs())))
    }

    /// Error bound of the stored surface, input units.
    pub fn surface_error(&self) -> f64 {
        let tree = self.tree();
        f64::from(tree.header().surface_error) * 2f64.powi(tree.scale_exponent())
    }

    /// How wide an interval may be: the stored surface, and a few roundings of the distance and of
    /// the lengths of triangles.
    pub fn width(&self, distance: f64) -> f64 {
        let tree = self.tree();
        let unit = 2f64.powi(tree.scale_exponent() + tree.header().grid_exponent);
        let roundings = 64.0 * distance + 96.0 * f64::from(tree.header().reach) * unit;
        // On the grid a certified square may fall short by one square unit before it is looked at
        // again.
        let rounding = roundings * f64::from(f32::EPSILON);
        let units = ((distance - self.surface_error() - rounding) / unit).max(1.0);
        let short = if tree.header().is_f32() { 0.0 } else { units - (units * units - 1.0).sqrt() };
        2.0 * self.surface_error() + rounding + short * unit
    }

    fn on_triangle(&self, t: u32, rng: &mut Rng) -> [f32; 3] {
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
        let size = self.size();
        std::array::from_fn(|k| {
            let (middle, half) =
                (0.5 * low[k] + 0.5 * high[k], 0.5 * (high[k] - low[k]) + 0.05 * size);
            middle + half * factor * rng.range(-1.0, 1.0)
        })
    }

    /// Points of every kind that distances have trouble with: on faces, at vertices, on edges, next
    /// to them, around, and far away.
    pub fn points(&self, count: usize, seed: u64) -> Vec<[f32; 3]> {
        let rng = &mut Rng::new(seed);
        let size = self.size();
        let mut points = Vec::with_capacity(count);
        for i in 0..count {
            let t = rng.below(self.triangles.len()) as u32;
            let on = self.on_triangle(t, rng);
            let [a, b, _] = self.corners(t);
            let d = rng.direction();
            let off = |p: [f32; 3], by: f32| std::array::from_fn(|k| p[k] + d[k] * size * by);
            points.push(match i % 12 {
                0 => on,
                1 => a,
                2 => std::array::from_fn(|k| 0.5 * a[k] + 0.5 * b[k]),
                3 => off(on, 1e-7),
                4 => off(on, 1e-4),
                5 => off(a, 1e-3),
                6 => off(on, 1e-2),
                7 => self.around(3.0, rng),
                8 => off(on, 1e3),
                9 => off(on, 1e5),
                _ => self.around(1.0, rng),
            });
        }
        points
    }
}

pub const IDENTITY: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A closed solid that bounds a volume once, its winding number 1 inside.
pub fn solids() -> Vec<(&'static str, Triangles)> {
    let far = [1e6, -1.5e6, 2e6];
    vec![
        ("torus", torus(2.0, 0.75, 24, 12)),
        ("bracket", bracket()),
        ("rough sphere", rough_sphere(3, 0.2, 7)),
        ("spiky sphere", rough_sphere(2, 0.8, 3)),
        ("groove block", groove_block()),
        ("needle comb", needle_comb()),
        ("cube", cube(4)),
        ("box of twelve", cube(1)),
        ("icosphere", icosphere(3)),
        ("sphere of meridians", uv_sphere(48, 24)),
        ("two parts", two_parts()),
        ("torus × 1e-30", scaled(&torus(2.0, 0.75, 24, 12), 1e-30)),
        ("torus × 1e30", scaled(&torus(2.0, 0.75, 24, 12), 1e30)),
        ("spiky sphere × 1e30", scaled(&rough_sphere(2, 0.8, 3), 1e30)),
        ("groove block × 1e-30", scaled(&groove_block(), 1e-30)),
        ("cube far away", transformed(&cube(4), IDENTITY, far)),
        ("two parts × 64 far away", transformed(&scaled(&two_parts(), 64.0), IDENTITY, far)),
        ("spire", spire()),
        ("corner touch", corner_touch()),
    ]
}

/// A tetrahedron a thousand times as high as wide: acute at every edge and at its tip.
fn spire() -> Triangles {
    let positions =
        vec![[1.0, 0.0, 0.0], [-0.5, 0.75, 0.0], [-0.5, -0.75, 0.0], [0.25, 0.0, 1000.0]];
    (positions, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
}

/// Two cubes that share one vertex, and a third that shares an edge with the first.
fn corner_touch() -> Triangles {
    use meshsweep_host_tests::generate::joined;
    let moved = |by| transformed(&cube(1), IDENTITY, by);
    joined(&joined(&cube(1), &moved([2.0, 2.0, 2.0])), &moved([-2.0, -2.0, 0.0]))
}

fn both(meshes: Vec<(&'static str, Triangles)>) -> Vec<Scene> {
    meshes
        .into_iter()
        .flat_map(|(name, mesh)| [false, true].map(|single| Scene::new(name, mesh.clone(), single)))
        .collect()
}

/// Solids, each on a grid and with f32 vertices.
pub fn closed() -> Vec<Scene> {
    both(solids())
}

/// Solids and soups, each on a grid and with f32 vertices.
pub fn all() -> Vec<Scene> {
    let mut meshes = solids();
    meshes.extend(super::soup::soups());
    both(meshes)
}
