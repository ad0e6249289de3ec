//! The greedy loop: cheapest legal collapse first.
//!
//! Costs are evaluated lazily: after a collapse only the edges of the new vertex are evaluated at
//! once; other edges around it keep their old cost until they reach the top of the queue. With few
//! faces left, where every choice shows, evaluation is eager, as in the paper. `core/DESIGN.md` has
//! the measurements.

use super::history::{Collapse, History};
use super::placement::{Placement, Refusal};
use super::queue::{Candidate, Queue};
use super::surface::Surface;
use super::{Conditions, Priority};
use crate::surface::Grid;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// Faces from which on the first priority is evaluated eagerly.
const EAGER_BELOW: usize = 4000;

/// What the loop has done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// Faces left.
    pub faces: usize,
    /// Collapses done.
    pub collapses: usize,
    /// Linear programs solved.
    pub programs: u64,
}

/// Why the loop stopped before its target: what kept the edges that were left from collapsing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stuck {
    /// Link condition or valence.
    pub topology: usize,
    /// No vertex outside all planes.
    pub no_vertex: usize,
    /// Compactness or normals.
    pub shape: usize,
}

/// What is known of an edge.
#[derive(Clone, Copy, Debug)]
enum EdgeState {
    /// In the queue, by its entry of this time; older entries are void.
    Queued(u32),
    /// Refused since anything near it changed; the cost to try again by.
    Refused(f64),
}

/// A mesh being collapsed.
pub struct Engine {
    surface: Surface,
    /// Label of the vertex that now sits in each slot.
    labels: Vec<u32>,
    /// Instance of the triangle that now sits in each slot.
    instances: Vec<u32>,
    /// When the star of each vertex last changed.
    changed: Vec<u32>,
    now: u32,
    queue: Queue,
    edges: FxHashMap<[u32; 2], EdgeState>,
    around: Vec<[u32; 2]>,
    history: History,
    priority: Priority,
}

impl Engine {
    /// A closed manifold mesh, positions on `grid`. Evaluates every edge.
    pub fn new(
        positions: &[DVec3],
        triangles: &[[u32; 3]],
        conditions: Conditions,
        priority: Priority,
        grid: Grid,
    ) -> Self {
        let mut engine = Engine {
            surface: Surface::new(positions.to_vec(), triangles, conditions, grid),
            labels: (0..positions.len() as u32).collect(),
            instances: (0..triangles.len() as u32).collect(),
            changed: vec![0; positions.len()],
            now: 1,
            queue: Queue::new(),
            edges: FxHashMap::default(),
            around: Vec::new(),
            history: History {
                positions: positions.to_vec(),
                original_vertices: positions.len() as u32,
                original_triangles: triangles.to_vec(),
                ..History::default()
            },
            priority,
        };
        engine.edges.reserve(triangles.len() * 3 / 2);
        for &[a, b, c] in triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                if from < to {
                    engine.evaluate([from, to]);
                }
            }
        }
        engine
    }

    /// Where the loop stands.
    pub fn progress(&self) -> Progress {
        Progress {
            faces: self.surface.mesh.alive_count(),
            collapses: self.history.collapses.len(),
            programs: self.surface.programs,
        }
    }

    /// Volume that all collapses have added, local frame.
    pub fn added_volume(&self) -> f64 {
        self.history.added_volume.iter().sum()
    }

    /// Positions by label, those that are gone too.
    pub fn positions(&self) -> &[DVec3] {
        &self.history.positions
    }

    /// Faces now, corners as labels of [`History`].
    pub fn faces(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        let alive =
            (0..self.surface.mesh.corners.len() as u32).filter(|&t| self.surface.mesh.is_alive(t));
        alive.map(|t| self.surface.mesh.corners[t as usize].map(|v| self.labels[v as usize]))
    }

    /// Collapses until at most `target` faces are left, `Some` if no legal collapse gets there.
    pub fn run(&mut self, target: usize, mut on_progress: impl FnMut(Progress)) -> Option<Stuck> {
        while self.surface.mesh.alive_count() > target {
            if !self.step() {
                return Some(self.why_stuck());
            }
            if self.history.collapses.len().is_multiple_of(1024) {
                on_progress(self.progress());
            }
        }
        on_progress(self.progress());
        None
    }

    /// Ends the loop: labels and instances of what is left go into the history.
    pub fn finish(mut self) -> History {
        for t in 0..self.surface.mesh.corners.len() as u32 {
            if self.surface.mesh.is_alive(t) {
                let corners =
                    self.surface.mesh.corners[t as usize].map(|v| self.labels[v as usize]);
                self.history.base.push(corners);
                self.history.base_instances.push(self.instances[t as usize]);
            }
        }
        self.history
    }

    /// One collapse; `false` if the queue has run dry.
    fn step(&mut self) -> bool {
        while let Some(candidate) = self.queue.pop() {
            let [a, b] = candidate.ends;
            if !matches!(self.edges.get(&candidate.ends), Some(EdgeState::Queued(time)) if *time == candidate.time)
            {
                continue;
            }
            let changed = self.changed[a as usize].max(self.changed[b as usize]);
            if candidate.time < changed {
                // The cost is of another star. An edge that is gone has lost its state, see
                // `apply`.
                self.evaluate(candidate.ends);
            } else if self.collapse(&candidate) {
                return true;
            }
        }
        false
    }

    /// Queues an edge by its cost now. A refused edge is remembered and comes back when something
    /// near it changes.
    fn evaluate(&mut self, ends: [u32; 2]) {
        let cost = if !self.surface.gather(ends) {
            Err(Refusal::NoVertex)
        } else if self.priority == Priority::Span {
            Ok(self.surface.span(ends))
        } else {
            self.surface.place(ends, false).map(|placement| placement.volume)
        };
        match cost {
            Ok(cost) => self.enqueue(cost, ends, self.now),
            Err(refusal) => self.refuse(ends, refusal),
        }
    }

    fn enqueue(&mut self, cost: f64, ends: [u32; 2], time: u32) {
        self.edges.insert(ends, EdgeState::Queued(time));
        self.queue.push(Candidate { cost, ends, time });
    }

    fn refuse(&mut self, ends: [u32; 2], refusal: Refusal) {
        let cost = match refusal {
            Refusal::NoVertex => 0.0,
            Refusal::Condition(cost) => cost,
        };
        self.edges.insert(ends, EdgeState::Refused(cost));
    }

    /// Places the vertex exactly and collapses; `false` if it is refused after all, or put back.
    ///
    /// The second priority learns here what the collapse really adds. One that adds more than its
    /// priority promised goes back and waits for its turn by that; the paper would apply it. It
    /// costs no further program for the edges that do collapse at once, and keeps the worst of
    /// them from the last few hundred faces.
    fn collapse(&mut self, candidate: &Candidate) -> bool {
        let ends = candidate.ends;
        let placed = if self.surface.gather(ends) {
            self.surface.place(ends, true)
        } else {
            Err(Refusal::NoVertex)
        };
        match placed {
            Err(refusal) => {
                self.refuse(ends, refusal);
                false
            }
            Ok(placement)
                if self.priority == Priority::Span
                    && placement.volume > 6.000_001 * candidate.cost =>
            {
                self.enqueue(placement.volume / 6.0, ends, self.now);
                false
            }
            Ok(placement) => self.apply(ends, placement),
        }
    }

    fn apply(&mut self, [a, b]: [u32; 2], placement: Placement) -> bool {
        let Some(ring) = self.surface.mesh.ring(a, b) else { return false };
        let wings = (self.surface.mesh.leaving(b, a), self.surface.mesh.leaving(a, b));
        let (Some(right_wing), Some(left_wing)) = wings else { return false };
        let index = self.history.collapses.len();
        let vertex = self.history.positions.len() as u32;
        let label = |slot: u32| self.labels[slot as usize];
        let collapse = Collapse {
            origin: label(a),
            destination: label(b),
            vertex,
            right: ring.right as u32,
            ring_start: self.history.rings.len() as u32,
            ring_len: ring.vertices.len() as u32,
        };
        self.history.rings.extend(ring.vertices.iter().map(|&v| label(v)));
        let fine = ring.triangles.iter().chain([&right_wing, &left_wing]);
        self.history.fine.extend(fine.map(|&t| self.instances[t as usize]));
        self.history.collapses.push(collapse);
        self.history.positions.push(placement.position);
        self.history.added_volume.push(placement.volume / 6.0);

        self.now += 1;
        for v in self.surface.mesh.neighbours(b) {
            self.edges.remove(&[b.min(v), b.max(v)]);
        }
        self.surface.mesh.collapse(a, b);
        self.surface.move_vertex(a, placement.position);
        self.labels[a as usize] = vertex;
        let first = self.history.first_coarse(index);
        for (i, &t) in ring.triangles.iter().enumerate() {
            self.instances[t as usize] = first + i as u32;
        }
        self.changed[a as usize] = self.now;
        for &v in &ring.vertices {
            self.changed[v as usize] = self.now;
        }
        self.reconsider(a, &ring.vertices);
        true
    }

    /// Edges whose star the collapse has changed: those of the new vertex are evaluated at once,
    /// refused ones get another chance, and the rest are found stale when they come out of the
    /// queue.
    fn reconsider(&mut self, vertex: u32, ring: &[u32]) {
        for &v in ring {
            self.evaluate([vertex.min(v), vertex.max(v)]);
        }
        let eager = self.surface.mesh.alive_count() <= EAGER_BELOW;
        let mut around = std::mem::take(&mut self.around);
        around.clear();
        for &v in ring {
            around.extend(
                self.surface
                    .mesh
                    .neighbours(v)
                    .filter(|&w| w != vertex)
                    .map(|w| [v.min(w), v.max(w)]),
            );
        }
        if eager {
            around.sort_unstable();
            around.dedup();
        }
        for &ends in &around {
            if eager {
                self.evaluate(ends);
            } else if let Some(&EdgeState::Refused(cost)) = self.edges.get(&ends) {
                self.enqueue(cost, ends, 0);
            }
        }
        self.around = around;
    }

    /// Tries every edge once more to say what is in the way.
    fn why_stuck(&mut self) -> Stuck {
        let mut stuck = Stuck::default();
        for t in 0..self.surface.mesh.corners.len() as u32 {
            if !self.surface.mesh.is_alive(t) {
                continue;
            }
            let [a, b, c] = self.surface.mesh.corners[t as usize];
            for (from, to) in [(a, b), (b, c), (c, a)] {
                if from > to {
                    continue;
                }
                if !self.surface.gather([from, to]) {
                    stuck.topology += 1;
                    continue;
                }
                match self.surface.place([from, to], true) {
                    Err(Refusal::Condition(_)) => stuck.shape += 1,
                    Err(Refusal::NoVertex) | Ok(_) => stuck.no_vertex += 1,
                }
            }
        }
        stuck
    }
}
