//! Answers are about the oriented triangles of the file, whatever repair made of them to tell
//! inside from outside.

mod crossing;
mod facing;
mod random;
mod sides;
mod winding;

use meshsweep::bvh::{TreeOptions, build};
use meshsweep::check::check_tree;
use meshsweep::mesh::{Input, RawMesh, repair};
use meshsweep::progress::Watch;
use meshsweep_core::{Budget, Bvh, Facing, Hit, Interval, ScratchEntry, Side};
use meshsweep_host_tests::generate::Triangles;

/// A file in memory: its vertices as it writes them, and its triangles.
#[derive(Clone, Debug)]
struct File {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl File {
    fn of((positions, triangles): &Triangles) -> Self {
        let positions = positions.iter().map(|p| p.map(f64::from)).collect();
        Self { positions, triangles: triangles.clone() }
    }

    fn corners(&self, triangle: u32) -> [[f64; 3]; 3] {
        self.triangles[triangle as usize].map(|v| self.positions[v as usize])
    }

    /// The blob of a box tree, proved by the checker.
    fn tree(&self, options: &TreeOptions) -> Vec<u8> {
        let raw = RawMesh::from_f64(self.positions.clone(), self.triangles.clone());
        let (mesh, _) = repair(raw).expect("a mesh");
        let input = Input { mesh: &mesh, moved: 0.0, input_triangles: self.triangles.len() };
        let bytes = build(input, options, Watch::NONE).expect("builds").0.to_bytes();
        if let Err(why) = check_tree(&bytes, &mesh) {
            panic!("not proved: {why}: {self:?}");
        }
        bytes
    }

    /// The same on a grid and in f32.
    fn trees(&self, options: TreeOptions) -> [Vec<u8>; 2] {
        [false, true].map(|is_f32| self.tree(&options.with_f32(is_f32)))
    }
}

/// Views of blobs, checked and trusted. Emitted sources hold the bytes and open them trusted.
fn views(blobs: &[Vec<u8>; 2]) -> [Bvh<'_>; 4] {
    let [grid, exact] = blobs;
    let views =
        [Bvh::open(grid), Bvh::open(exact), Bvh::open_trusted(grid), Bvh::open_trusted(exact)];
    views.map(|view| view.expect("opens"))
}

fn stack(tree: &Bvh<'_>) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; tree.scratch_entries()]
}

/// The first hit; `None` proves that there is none.
fn first(tree: &Bvh<'_>, [a, b]: [[f32; 3]; 2], facing: Facing) -> Option<Hit> {
    let found = tree.first_hit(a, b, facing, Budget::EXACT, &mut stack(tree)).expect("answers");
    assert_eq!(found.is_clear(), found.hit.is_none(), "{found:?}");
    found.hit
}

fn winding(tree: &Bvh<'_>, point: [f32; 3]) -> (Interval, Side) {
    let budget = Budget::EXACT.with_absolute(1e-3);
    let found = tree.winding_number(point, budget, &mut stack(tree)).expect("answers");
    (found.number, found.side)
}

fn side(tree: &Bvh<'_>, point: [f32; 3]) -> Side {
    tree.signed_distance(point, Budget::EXACT, &mut stack(tree)).expect("answers").side
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] - b[k])
}

/// Sum of the solid angles of a file's triangles over 4π (Van Oosterom & Strackee 1983), in f64.
fn exact_winding(file: &File, p: [f64; 3]) -> f64 {
    let half_angle = |t: u32| {
        let [a, b, c] = file.corners(t).map(|v| minus(v, p));
        let dot = |x: [f64; 3], y: [f64; 3]| x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
        let [x, y, z] = [a, b, c].map(|v| dot(v, v).sqrt());
        let triple = a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        triple.atan2(x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y)
    };
    (0..file.triangles.len() as u32).map(half_angle).sum::<f64>() / std::f64::consts::TAU
}
