//! The queue of edge collapses: a heap whose stale entries are evaluated again when they come out,
//! and the ordered tree of Platis & Theoharis 2003, 3.1.4, in which an edge is moved at once when
//! its star changes. `cargo bench -p meshsweep-lab --bench queue [-- MESH]`.
//!
//! The cost of an edge is its length, so that time is spent in the queue and in the mesh. A build
//! solves a linear program for each evaluation instead, which takes microseconds.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};
use std::time::Instant;

use glam::{DVec3, Vec3};
use meshsweep::collapse::{Conditions, Connectivity};
use meshsweep::mesh::Mesh;
use meshsweep_host_tests::generate::rough_sphere;
use meshsweep_host_tests::workload::Subject;

/// Triangles that are left at the end.
const LEFT: usize = 200;
/// Of the times the least counts.
const PASSES: usize = 5;

/// Bits of a cost that is not negative, which order as the cost does, and the edge.
type Key = (u64, [u32; 2]);

/// A mesh that is collapsed, each edge at its middle.
struct Collapsed {
    mesh: Connectivity,
    places: Vec<DVec3>,
    /// When the star of a vertex last changed.
    changed: Vec<u32>,
    star: Vec<u32>,
    evaluations: u64,
}

impl Collapsed {
    fn new(subject: &Mesh) -> Self {
        let places: Vec<DVec3> =
            subject.positions.iter().map(|&p| Vec3::from(p).as_dvec3()).collect();
        let mesh = Connectivity::new(places.len(), &subject.triangles);
        let changed = vec![0; places.len()];
        Self { mesh, changed, places, star: Vec::new(), evaluations: 0 }
    }

    fn key(&mut self, [a, b]: [u32; 2]) -> Key {
        self.evaluations += 1;
        let cost = self.places[a as usize].distance_squared(self.places[b as usize]);
        (cost.to_bits(), [a.min(b), a.max(b)])
    }

    fn admits(&mut self, [a, b]: [u32; 2]) -> bool {
        let most = Conditions::STANDARD.max_valence;
        self.mesh.collapsible_star(a, b, most, &mut self.star)
    }

    /// Collapses an edge. The vertex that is left, whose neighbours' stars changed too.
    fn collapse(&mut self, [a, b]: [u32; 2], now: u32) -> u32 {
        self.places[a as usize] = (self.places[a as usize] + self.places[b as usize]) / 2.0;
        self.mesh.collapse(a, b);
        self.changed[b as usize] = u32::MAX;
        self.changed[a as usize] = now;
        a
    }

    /// The edges whose cost a collapse into `a` changed.
    fn around(&self, a: u32) -> Vec<[u32; 2]> {
        self.mesh.neighbours(a).map(|b| [a, b]).collect()
    }
}

/// A heap; an entry that is older than an end of its edge is evaluated again when it comes out.
fn by_heap(subject: &Mesh) -> (f64, u64) {
    let mut state = Collapsed::new(subject);
    let begun = Instant::now();
    let edges = state.mesh.edges();
    let mut heap: BinaryHeap<Reverse<(Key, u32)>> =
        edges.into_iter().map(|edge| Reverse((state.key(edge), 0))).collect();
    let mut now = 0;
    while state.mesh.alive_count() > LEFT {
        let Some(Reverse(((_, edge), time))) = heap.pop() else { break };
        let newest = edge.map(|v| state.changed[v as usize]).into_iter().max().unwrap_or(0);
        if newest == u32::MAX {
            continue;
        }
        if time < newest {
            heap.push(Reverse((state.key(edge), newest)));
        } else if state.admits(edge) {
            now += 1;
            // Those of the vertex that stays are in the heap, with the costs of before.
            let [stays, _] = edge;
            let known = state.around(stays);
            let left = state.collapse(edge, now);
            for edge in state.around(left).into_iter().filter(|edge| !known.contains(edge)) {
                heap.push(Reverse((state.key(edge), now)));
            }
        }
    }
    (begun.elapsed().as_secs_f64(), state.evaluations)
}

/// An ordered tree; an edge whose cost changes is taken out and put in again.
fn by_tree(subject: &Mesh) -> (f64, u64) {
    let mut state = Collapsed::new(subject);
    let begun = Instant::now();
    let edges = state.mesh.edges();
    let mut tree: BTreeSet<Key> = edges.into_iter().map(|edge| state.key(edge)).collect();
    let mut now = 0;
    while state.mesh.alive_count() > LEFT {
        let Some((_, edge)) = tree.pop_first() else { break };
        if state.admits(edge) {
            for v in edge {
                for old in state.around(v) {
                    let key = state.key(old);
                    state.evaluations -= 1;
                    tree.remove(&key);
                }
            }
            now += 1;
            let left = state.collapse(edge, now);
            for edge in state.around(left) {
                let key = state.key(edge);
                tree.insert(key);
            }
        }
    }
    (begun.elapsed().as_secs_f64(), state.evaluations)
}

fn main() {
    let path = std::env::args().skip(1).find(|argument| !argument.starts_with("--"));
    let mesh = path.map_or_else(
        || {
            let (positions, triangles) = rough_sphere(6, 0.05, 1);
            Mesh::new(positions, triangles)
        },
        |path| Subject::load(path.as_ref()).expect("a closed mesh").mesh,
    );
    let least = |run: fn(&Mesh) -> (f64, u64)| {
        let all: Vec<(f64, u64)> = (0..PASSES).map(|_| run(&mesh)).collect();
        all.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).expect("a pass")
    };
    let ((heap, heap_keys), (tree, tree_keys)) = (least(by_heap), least(by_tree));
    println!("{} triangles to {LEFT}", mesh.triangles.len());
    println!("heap, stale entries: {heap:.3} s, {heap_keys} evaluations");
    println!("tree, moved entries: {tree:.3} s, {tree_keys} evaluations");
    println!("tree / heap: {:.2} of the time", tree / heap);
}
