//! Meshes as they were given, with their blobs, and places to put queries.

use meshsweep::bvh::{TreeOptions, build as build_tree};
use meshsweep::hull::{BuildOptions, Levels, build as build_hull};
use meshsweep::mesh::{Mesh, RawMesh, repair, require_closed_manifold};
use meshsweep::progress::Watch;
use meshsweep_core::{Bvh, Hull};

use crate::generate::corpus::add;
use crate::generate::{Rng, Triangles};
use crate::oracle::{Bounded, distance_to_mesh, distance_to_triangle};
use std::sync::OnceLock;

type Point = [f32; 3];

/// A mesh and its blobs.
#[derive(Clone, Debug)]
pub struct Scene {
    /// For messages.
    pub name: String,
    /// The mesh as it was given, before the builder repaired or moved anything.
    pub positions: Vec<Point>,
    /// Its triangles.
    pub triangles: Vec<[u32; 3]>,
    /// The blob.
    pub bytes: Vec<u8>,
    /// Whether some of its points lie on triangles without area alone, of [`Scene::sweep`].
    pub has_wires: bool,
    /// The same with f32 vertices, of [`Scene::both`] and [`Scene::moved`].
    pub f32_bytes: Vec<u8>,
    /// What [`Scene::model`] opened.
    model: OnceLock<Hull<'static>>,
}

impl Scene {
    fn new(name: impl Into<String>, (positions, triangles): Triangles) -> Self {
        let name = name.into();
        let (bytes, f32_bytes) = (Vec::new(), Vec::new());
        let model = OnceLock::new();
        Self { name, positions, triangles, bytes, has_wires: false, f32_bytes, model }
    }

    /// A mesh to be measured, without a blob.
    #[must_use]
    pub fn of_mesh(name: &str, mesh: Triangles) -> Self {
        Self::new(name, mesh)
    }

    /// A closed mesh with a hull hierarchy.
    ///
    /// # Panics
    /// The mesh is not closed.
    #[must_use]
    pub fn hull(name: impl Into<String>, mesh: Triangles, options: &BuildOptions<'_>) -> Self {
        let mut scene = Self::new(name, mesh);
        let raw = RawMesh::from_f32(&scene.positions, &scene.triangles);
        let (repaired, _) = repair(raw).expect("a sound mesh");
        require_closed_manifold(&repaired).expect("a closed mesh");
        let built = build_hull(repaired.as_input(), options, Watch::NONE);
        scene.bytes = built.expect("builds").0.to_bytes();
        scene
    }

    /// Any mesh with a hierarchy for sweeps.
    ///
    /// # Panics
    /// The mesh has no area.
    #[must_use]
    pub fn sweep(name: impl Into<String>, mesh: Triangles, options: &BuildOptions<'_>) -> Self {
        let mut scene = Self::new(name, mesh);
        let raw = RawMesh::from_f32(&scene.positions, &scene.triangles);
        let (repaired, _) = repair(raw).expect("a sound mesh");
        scene.has_wires = !repaired.wires.is_empty();
        let options = options.with_levels(Levels::Sweep);
        let built = build_hull(repaired.as_input(), &options, Watch::NONE);
        scene.bytes = built.expect("builds").0.to_bytes();
        scene
    }

    /// Any mesh with a box tree for distances alone.
    #[must_use]
    pub fn tree(name: &str, mesh: Triangles, single: bool) -> Self {
        let mut scene = Self::new(format!("{name}{}", if single { ", f32" } else { "" }), mesh);
        let options = TreeOptions::default().with_segments(false).with_f32(single);
        scene.bytes = tree_blob(&scene.positions, &scene.triangles, 0.0, &options);
        scene
    }

    /// Any mesh with two box trees for segments, overlap and winding numbers: on a grid, and with
    /// f32 vertices.
    #[must_use]
    pub fn both(name: &str, mesh: Triangles) -> Self {
        Self::moved(name, mesh, 0.0, 0)
    }

    /// The same, but the blobs hold vertices that were moved by up to `by`, and say so as their
    /// surface error.
    #[must_use]
    pub fn moved(name: &str, mesh: Triangles, by: f32, seed: u64) -> Self {
        let options = TreeOptions::default().with_closest(false).with_winding(true);
        Self::with_trees(name, mesh, (by, seed), &options)
    }

    /// Any mesh with two box trees for all questions: on a grid, and with f32 vertices. The blobs
    /// hold vertices that were moved by up to `by`.
    #[must_use]
    pub fn solid(name: &str, mesh: Triangles, by: f32, seed: u64) -> Self {
        Self::with_trees(name, mesh, (by, seed), &TreeOptions::default().with_winding(true))
    }

    fn with_trees(
        name: &str,
        mesh: Triangles,
        (by, seed): (f32, u64),
        options: &TreeOptions,
    ) -> Self {
        let mut scene = Self::new(name, mesh);
        let rng = &mut Rng::new(seed);
        let moved = |&p| if by > 0.0 { add(p, rng.direction(), 0.99 * by) } else { p };
        let stored: Vec<Point> = scene.positions.iter().map(moved).collect();
        [scene.bytes, scene.f32_bytes] = [false, true].map(|single| {
            let options = options.with_f32(single);
            tree_blob(&stored, &scene.triangles, f64::from(by), &options)
        });
        scene
    }

    /// The hull hierarchy. It is opened once, of a copy that is never freed: to open it takes longer
    /// than most questions.
    ///
    /// # Panics
    /// The scene has none.
    #[must_use]
    pub fn model(&self) -> Hull<'_> {
        *self.model.get_or_init(|| {
            Hull::open(Box::leak(self.bytes.clone().into_boxed_slice())).expect("opens")
        })
    }

    /// The box tree. It was checked when it was built: tests ask for it more often than for answers.
    ///
    /// # Panics
    /// The scene has none.
    #[must_use]
    pub fn bvh(&self) -> Bvh<'_> {
        Bvh::open_trusted(&self.bytes).expect("opens")
    }

    /// Both box trees: on a grid, then with f32 vertices.
    ///
    /// # Panics
    /// The scene has only one.
    #[must_use]
    pub fn trees(&self) -> [Bvh<'_>; 2] {
        [&self.bytes, &self.f32_bytes].map(|bytes| Bvh::open_trusted(bytes).expect("opens"))
    }

    /// Corners of a triangle.
    #[must_use]
    pub fn corners(&self, triangle: u32) -> [Point; 3] {
        self.triangles[triangle as usize].map(|v| self.positions[v as usize])
    }

    /// The distance of the mesh.
    #[must_use]
    pub fn truth(&self, p: Point) -> Bounded {
        distance_to_mesh(p, &self.positions, &self.triangles)
    }

    /// The distance of one triangle.
    #[must_use]
    pub fn truth_of(&self, p: Point, triangle: u32) -> Bounded {
        distance_to_triangle(p, self.corners(triangle))
    }

    /// Least and greatest corner.
    #[must_use]
    pub fn bounds(&self) -> (Point, Point) {
        let fold = |f: fn(f32, f32) -> f32| {
            std::array::from_fn(|k| self.positions.iter().map(|p| p[k]).reduce(f).unwrap_or(0.0))
        };
        (fold(f32::min), fold(f32::max))
    }

    /// Longest side of the box; of a point, some steps of its largest coordinate.
    #[must_use]
    pub fn size(&self) -> f32 {
        let (low, high) = self.bounds();
        let size = (0..3).map(|k| high[k] - low[k]).fold(0.0, f32::max);
        if size > 0.0 { size } else { self.reach() as f32 / 65_536.0 }
    }

    /// Largest coordinate: rounding is relative to it.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.positions.iter().flatten().fold(0f64, |m, x| m.max(f64::from(x.abs())))
    }

    /// A random point of a triangle, rounded.
    pub fn on_triangle(&self, triangle: u32, rng: &mut Rng) -> Point {
        let [a, b, c] = self.corners(triangle);
        let (mut u, mut v) = (rng.unit_f64(), rng.unit_f64());
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        std::array::from_fn(|k| {
            let [a, b, c] = [a[k], b[k], c[k]].map(f64::from);
            (a + u * (b - a) + v * (c - a)) as f32
        })
    }

    /// A random point of a random triangle, rounded.
    pub fn on_surface(&self, rng: &mut Rng) -> Point {
        let triangle = rng.below(self.triangles.len()) as u32;
        self.on_triangle(triangle, rng)
    }

    /// A random vertex.
    pub fn vertex(&self, rng: &mut Rng) -> Point {
        self.positions[rng.below(self.positions.len())]
    }

    /// A random point in the box grown to `factor` times its size, which is never flat.
    pub fn around(&self, factor: f32, rng: &mut Rng) -> Point {
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
    #[must_use]
    pub fn points(&self, count: usize, rng: &mut Rng) -> Asked<'_> {
        let size = self.size();
        let mut points = Vec::with_capacity(count);
        for i in 0..count {
            let t = rng.below(self.triangles.len()) as u32;
            let on = self.on_triangle(t, rng);
            let [a, b, _] = self.corners(t);
            let d = rng.direction();
            let off = |p: Point, by: f32| add(p, d, size * by);
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
        Asked { scene: self, points: points.into_iter(), here: None }
    }
}

/// Points to be asked one after the other. A test that fails meanwhile says at which point of which
/// scene.
#[derive(Debug)]
pub struct Asked<'a> {
    scene: &'a Scene,
    points: std::vec::IntoIter<Point>,
    here: Option<Point>,
}

impl Iterator for Asked<'_> {
    type Item = Point;

    fn next(&mut self) -> Option<Point> {
        self.here = self.points.next();
        self.here
    }
}

impl Drop for Asked<'_> {
    fn drop(&mut self) {
        if std::thread::panicking()
            && let Some(p) = self.here
        {
            eprintln!("{}: {p:?}", self.scene.name);
        }
    }
}

fn tree_blob(
    positions: &[Point],
    triangles: &[[u32; 3]],
    moved: f64,
    options: &TreeOptions,
) -> Vec<u8> {
    let mesh = Mesh::new(positions.to_vec(), triangles.to_vec());
    let input = meshsweep::mesh::Input { moved, ..mesh.as_input() };
    let bytes = build_tree(input, options, Watch::NONE).expect("builds").0.to_bytes();
    assert!(Bvh::open(&bytes).is_ok(), "what the builder wrote opens");
    bytes
}
