//! Meshes with triangles that have no area, or have none when they are stored.

use meshsweep::bvh::{TreeOptions, build};
use meshsweep::check::check_tree;
use meshsweep::mesh::{Input, Mesh, RawMesh, RepairReport, read, repair};
use meshsweep::progress::Watch;
use meshsweep::surface::{VertexBits, snap};
use meshsweep_core::{Bvh, ScratchEntry};
use meshsweep_host_tests::generate::{Rng, cube, torus};
use meshsweep_host_tests::oracle::exact::{Corners, about};
use std::path::Path;
use std::sync::LazyLock;

/// Positions as in a file, and triangles.
pub type Raw = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// An input, and the blob of its tree.
pub struct Scene {
    pub name: String,
    /// The input's own triangles, as read.
    pub corners: Vec<Corners>,
    pub mesh: Mesh,
    pub moved: f64,
    pub bytes: Vec<u8>,
}

/// How a mesh is stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Grid,
    F32,
    /// Moved to the hull's grid of 16 bits before repair.
    Snapped,
}

impl Scene {
    pub fn new(name: &str, raw: &Raw, kind: Kind) -> Scene {
        Self::with(name, raw, kind, &TreeOptions::default().with_cull(true))
    }

    pub fn with(name: &str, raw: &Raw, kind: Kind, options: &TreeOptions) -> Scene {
        let (mesh, moved, _) = repaired(raw, kind);
        let options = options.with_f32(kind == Kind::F32);
        let (tables, _) = build(
            Input { mesh: &mesh, moved, input_triangles: raw.1.len() },
            &options,
            Watch::NONE,
        )
        .expect("builds");
        let bytes = tables.to_bytes();
        assert!(Bvh::open(&bytes).is_ok(), "{name}");
        // The checker tells the halves of a flipped cap apart by their corners: not if the grid
        // makes them alike.
        let mut numbers: Vec<u32> = mesh.all_sources().collect();
        numbers.sort_unstable();
        numbers.dedup();
        if moved == 0.0 && (kind == Kind::F32 || numbers.len() == mesh.all_sources().count()) {
            check_tree(&bytes, &mesh).expect("the tree of the mesh and its wires");
        }
        let corners = raw.1.iter().map(|t| t.map(|v| raw.0[v as usize])).collect();
        Scene { name: format!("{name}, {kind:?}"), corners, mesh, moved, bytes }
    }

    /// It was checked when it was built.
    pub fn tree(&self) -> Bvh<'_> {
        Bvh::open_trusted(&self.bytes).expect("opens")
    }

    pub fn stack(&self) -> Vec<ScratchEntry> {
        vec![ScratchEntry::EMPTY; self.tree().header().stack_entries as usize]
    }

    /// The input's triangles that may be the nearest to a point.
    pub fn nearest(&self, p: [f32; 3]) -> Vec<&Corners> {
        let p = p.map(f64::from);
        let all: Vec<f64> = self.corners.iter().map(|corners| about(p, corners)).collect();
        let least = all.iter().copied().fold(f64::INFINITY, f64::min);
        let band = least + 1e-6 * (least + self.size());
        self.corners
            .iter()
            .zip(all)
            .filter(|(_, d)| *d <= band)
            .map(|(corners, _)| corners)
            .collect()
    }

    pub fn bounds(&self) -> [[f64; 3]; 2] {
        let fold = |f: fn(f64, f64) -> f64| {
            std::array::from_fn(|k| {
                self.corners.iter().flatten().map(|p| p[k]).reduce(f).expect("a corner")
            })
        };
        [fold(f64::min), fold(f64::max)]
    }

    pub fn size(&self) -> f64 {
        let [low, high] = self.bounds();
        (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max)
    }

    /// A length to go astray by: the mesh's, or that of its place.
    pub fn length(&self) -> f64 {
        let largest = self.corners.iter().flatten().flatten().fold(0f64, |m, x| m.max(x.abs()));
        if self.size() > 0.0 {
            self.size()
        } else if largest > 0.0 {
            largest
        } else {
            1.0
        }
    }

    /// A point of a triangle of the input, up to rounding.
    pub fn on(&self, rng: &mut Rng) -> [f64; 3] {
        let [a, b, c] = self.corners[rng.below(self.corners.len())];
        let (mut u, mut v) = (rng.unit_f64(), rng.unit_f64());
        match rng.below(4) {
            0 => (u, v) = (0.0, 0.0),
            1 => v = 0.0,
            _ if u + v > 1.0 => (u, v) = (1.0 - u, 1.0 - v),
            _ => {}
        }
        std::array::from_fn(|k| a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]))
    }

    /// Points on what the input is, beside it, around and far away.
    pub fn points(&self, count: usize, seed: u64) -> Vec<[f32; 3]> {
        let rng = &mut Rng::new(seed);
        let size = self.length();
        let off = [0.0, 1e-6, 1e-4, 1e-2, 0.1, 0.3, 1.0, 3.0, 1e3, 1e7];
        (0..count)
            .map(|i| {
                let (on, way) = (self.on(rng), rng.direction());
                std::array::from_fn(|k| {
                    (on[k] + off[i % off.len()] * size * f64::from(way[k])) as f32
                })
            })
            .collect()
    }
}

pub fn repaired((positions, triangles): &Raw, kind: Kind) -> (Mesh, f64, RepairReport) {
    let mut positions = positions.clone();
    let moved = if kind == Kind::Snapped { snap(&mut positions, VertexBits::Grid16) } else { 0.0 };
    let (mesh, report) = repair(RawMesh::from_f64(positions, triangles.clone())).expect("a mesh");
    (mesh, moved, report)
}

fn separate(corners: impl IntoIterator<Item = Corners>) -> Raw {
    let positions: Vec<[f64; 3]> = corners.into_iter().flatten().collect();
    let count = positions.len() as u32 / 3;
    (positions, (0..count).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect())
}

pub fn joined((positions, triangles): &Raw, other: &Raw) -> Raw {
    let first = positions.len() as u32;
    let positions = positions.iter().chain(&other.0).copied().collect();
    let others = other.1.iter().map(|t| t.map(|v| v + first));
    (positions, triangles.iter().copied().chain(others).collect())
}

fn mapped((positions, triangles): &Raw, f: impl Fn([f64; 3]) -> [f64; 3]) -> Raw {
    (positions.iter().map(|&p| f(p)).collect(), triangles.clone())
}

pub fn wide((positions, triangles): (Vec<[f32; 3]>, Vec<[u32; 3]>)) -> Raw {
    (positions.iter().map(|p| p.map(f64::from)).collect(), triangles)
}

/// Segments drawn as three collinear corners in any order, each coordinate of few bits.
pub fn wires(count: usize, seed: u64) -> Raw {
    let rng = &mut Rng::new(seed);
    separate((0..count).map(|i| {
        let mut few = |most: f32| (rng.range(-most, most) * 64.0).round() as f64 / 64.0;
        let from: [f64; 3] = std::array::from_fn(|_| few(2.0));
        let mut step: [f64; 3] = std::array::from_fn(|_| few(0.25));
        if i % 3 == 0 {
            step = std::array::from_fn(|k| if k == i % 2 { step[k] } else { 0.0 });
        }
        let at = |n: f64| std::array::from_fn(|k| from[k] + n * step[k]);
        let [u, v, w] = [[0.0, 1.0, 3.0], [5.0, 0.0, 2.0], [1.0, 4.0, 0.0], [0.0, 0.0, 2.0]][i % 4];
        [at(u), at(v), at(w)]
    }))
}

/// Points drawn as triangles.
fn points(count: usize, seed: u64) -> Raw {
    let rng = &mut Rng::new(seed);
    separate((0..count).map(|_| [rng.point_in([-1.0; 3], [1.0; 3]).map(f64::from); 3]))
}

/// Triangles a thousandth wide, so far from the origin that f32 takes their width.
fn needles(count: usize, seed: u64) -> Raw {
    let rng = &mut Rng::new(seed);
    separate((0..count).map(|i| {
        let at = rng.point_in([-4.0; 3], [4.0; 3]).map(|x| 1e6 + f64::from(x));
        let (way, off) = (rng.direction(), rng.direction());
        let long = [0.01, 1.0, 5.0][i % 3];
        let end = std::array::from_fn(|k| at[k] + long * f64::from(way[k]));
        let t = rng.unit_f64();
        let side = std::array::from_fn(|k| {
            at[k] + t * long * f64::from(way[k]) + 1e-3 * f64::from(off[k])
        });
        [at, end, side]
    }))
}

/// Triangles of a few steps of a grid of 16 bits and less, anywhere in the unit box.
fn crumbs(count: usize, seed: u64) -> Raw {
    let rng = &mut Rng::new(seed);
    separate((0..count).map(|i| {
        let at = rng.point_in([-1.0; 3], [1.0; 3]).map(f64::from);
        let size = [1e-7, 4e-6, 2e-5, 1e-4][i % 4];
        let mut near = || {
            let way = rng.direction();
            std::array::from_fn(|k| f64::from((at[k] + size * f64::from(way[k])) as f32))
        };
        [at, near(), near()]
    }))
}

/// Triangles of all sizes, most of them with next to no area or with none, that share corners.
fn random(seed: u64) -> Raw {
    let rng = &mut Rng::new(seed);
    let place = [0.0, 0.0, 3.0, 1e4][rng.below(4)];
    let mut positions: Vec<[f64; 3]> = Vec::new();
    let mut triangles = Vec::new();
    for _ in 0..30 {
        let first = positions.len();
        let at = rng.point_in([-1.0; 3], [1.0; 3]).map(|x| f64::from(x) + place);
        let long = 10f64.powf(f64::from(rng.range(-12.0, 0.0)));
        let way = rng.direction().map(f64::from);
        let along = |t: f64| std::array::from_fn(|k| f64::from((at[k] + t * long * way[k]) as f32));
        positions.extend([along(0.0), along(1.0), along(rng.unit_f64()), along(-0.5)]);
        let mut corner = || {
            let of = if rng.below(5) == 0 { positions.len() } else { 4 };
            let from = if of == 4 { first } else { 0 };
            (from + rng.below(of)) as u32
        };
        triangles.extend([[corner(), corner(), corner()], [corner(), corner(), corner()]]);
    }
    (positions, triangles)
}

fn fixture(name: &str) -> Raw {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures/evil").join(name);
    let raw = read(&file).expect("a fixture");
    (raw.positions, raw.triangles)
}

/// A wire that runs through a cube, one in it, one on a face, one along an edge, and a point
/// beside.
pub fn pierced_cube() -> Raw {
    let segment = |a: [f64; 3], b: [f64; 3]| [a, a, b];
    let more = separate([
        segment([-2.0, 0.125, 0.25], [3.0, 0.5, 0.25]),
        segment([-0.5, -0.5, -0.5], [-0.25, 0.25, 0.5]),
        segment([-0.5, 0.25, 1.0], [0.25, 0.125, 1.0]),
        segment([-1.0, 1.0, 1.0], [1.0, 1.0, 1.0]),
        [[0.0, 0.0, 2.5]; 3],
    ]);
    joined(&wide(cube(3)), &more)
}

pub fn inputs() -> Vec<(&'static str, Raw)> {
    let ring = wide(torus(1.0, 0.25, 12, 8));
    let scaled = |by: f64| move |p: [f64; 3]| p.map(|x| f64::from((x * by) as f32));
    let mixed = joined(&joined(&ring, &wires(30, 5)), &points(10, 6));
    let mut all = vec![
        ("wires", wires(40, 1)),
        ("one wire", separate([[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]])),
        ("one slanted wire", separate([[[0.5, 0.25, 1.0], [1.5, 1.25, 4.0], [1.0, 0.75, 2.5]]])),
        ("points", points(30, 2)),
        ("one point", separate([[[0.5, 0.25, 1.0]; 3]])),
        ("the origin", separate([[[0.0; 3]; 3]])),
        ("needles far from the origin", needles(40, 3)),
        ("crumbs", joined(&crumbs(40, 4), &wide(cube(1)))),
        ("crumbs alone", crumbs(30, 9)),
        ("pierced cube", pierced_cube()),
        ("torus among wires", mixed.clone()),
        ("cap", fixture("cap.obj")),
        ("stuck cap", fixture("stuck_cap.obj")),
        ("line", fixture("line.obj")),
        ("mixed × 1e-30", mapped(&mixed, scaled(1e-30))),
        ("mixed × 1e30", mapped(&mixed, scaled(1e30))),
        ("wires × 1e-30", mapped(&wires(20, 7), scaled(1e-30))),
        ("wires × 1e30", mapped(&wires(20, 7), scaled(1e30))),
        ("wires far from the origin", mapped(&wires(20, 8), |p| p.map(|x| x + 262_144.0))),
    ];
    let names = ["random", "another", "a third", "a fourth", "a fifth", "a sixth"];
    all.extend(names.into_iter().zip((100..).map(random)));
    all
}

/// Every input in every kind, built once.
pub fn scenes() -> &'static [Scene] {
    static SCENES: LazyLock<Vec<Scene>> = LazyLock::new(|| {
        let kinds = [Kind::Grid, Kind::F32, Kind::Snapped];
        let all = inputs();
        all.iter().flat_map(|(name, raw)| kinds.map(|kind| Scene::new(name, raw, kind))).collect()
    });
    &SCENES
}
