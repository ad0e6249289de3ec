//! The progressive hull of a mesh: its edges as the [greedy loop](super::greedy) sees them, and the
//! record of its collapses.
//!
//! Costs are evaluated lazily. After a collapse only the edges of the new vertex are evaluated at
//! once. Other edges around it keep their old cost until they reach the top of the queue. With few
//! faces left every choice shows, and evaluation is eager, as in the paper. `DESIGN.md` has the
//! measurements ("The order of collapses").

use super::greedy::{self, Candidate, Collapsing, Schedule};
use super::history::{Collapse, History};
use super::placement::{Placement, Refusal};
use super::star::{Connectivity, MAX_STAR};
use super::surface::Surface;
use super::{Conditions, Priority};
use crate::surface::Grid;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// Why the loop ended before its target: the edges that are left, by the reason of their refusal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Stuck {
    /// Link condition or valence.
    pub topology: usize,
    /// No vertex outside all planes.
    pub no_vertex: usize,
    /// Compactness or normals.
    pub shape: usize,
}

impl Stuck {
    /// Why a progressive hull has more faces than `wanted`.
    #[must_use]
    pub fn why(&self, wanted: u32) -> String {
        format!(
            "stopped before {wanted} faces, for no edge may collapse: {} by topology or valence, \
             {} because no vertex is outside all planes, {} by compactness or normals; \
             --max-valence, --compactness and --max-normal-deviation relax the conditions",
            self.topology, self.no_vertex, self.shape
        )
    }
}

/// Collapses, or edges evaluated at first, between two calls of progress.
const STEPS: usize = 512;

/// State of an edge.
#[derive(Clone, Copy, Debug)]
enum EdgeState {
    /// Its entry in the queue has this time. Older entries do not count.
    Queued(u32),
    /// Refused; the cost of its entry when a star near it changes.
    Refused(f64),
}

/// A mesh being collapsed.
pub struct Engine {
    edges: Edges,
    schedule: Schedule,
    /// Whether every edge was evaluated once.
    is_scheduled: bool,
}

/// The edges of the mesh, and the record of their collapses.
struct Edges {
    surface: Surface,
    /// Label of the vertex in each slot.
    labels: Vec<u32>,
    /// Instance of the triangle in each slot.
    instances: Vec<u32>,
    states: FxHashMap<[u32; 2], EdgeState>,
    around: Vec<[u32; 2]>,
    history: History,
    priority: Priority,
}

impl Engine {
    /// A closed manifold mesh, positions on `grid`.
    pub fn new(
        positions: &[DVec3],
        triangles: &[[u32; 3]],
        conditions: Conditions,
        priority: Priority,
        grid: Grid,
    ) -> Self {
        let surface = Surface::new(positions.to_vec(), triangles, conditions, grid);
        Self::of(surface, triangles, triangles.len(), priority)
    }

    /// As [`new`](Self::new), for vertices that are placed near the surface, on either side of it.
    /// Triangles from `fillers` on close holes.
    pub fn near(
        positions: &[DVec3],
        triangles: &[[u32; 3]],
        fillers: usize,
        conditions: Conditions,
        grid: Grid,
    ) -> Self {
        let surface = Surface::near(positions.to_vec(), triangles, fillers, conditions, grid);
        Self::of(surface, triangles, fillers, Priority::Program)
    }

    fn of(
        surface: Surface,
        triangles: &[[u32; 3]],
        surface_triangles: usize,
        priority: Priority,
    ) -> Self {
        let positions = surface.positions.clone();
        let mut edges = Edges {
            surface,
            labels: (0..positions.len() as u32).collect(),
            instances: (0..triangles.len() as u32).collect(),
            states: FxHashMap::default(),
            around: Vec::new(),
            history: History {
                positions: positions.clone(),
                original_vertices: positions.len() as u32,
                original_triangles: triangles.to_vec(),
                surface_triangles,
                ..History::default()
            },
            priority,
        };
        edges.states.reserve(triangles.len() * 3 / 2);
        let schedule = Schedule::new(positions.len());
        Engine { edges, schedule, is_scheduled: false }
    }

    /// Faces left.
    pub fn face_count(&self) -> usize {
        self.edges.surface.mesh.alive_count()
    }

    /// Linear programs solved.
    pub fn programs(&self) -> u64 {
        self.edges.surface.programs
    }

    /// Volume that all collapses have added, local frame.
    pub fn added_volume(&self) -> f64 {
        self.edges.history.added_volume.iter().sum()
    }

    /// Positions by label, also of vertices that are gone.
    pub fn positions(&self) -> &[DVec3] {
        &self.edges.history.positions
    }

    /// Faces now, corners as labels of [`History`].
    pub fn faces(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.edges.faces()
    }

    /// Collapses until at most `target` faces are left; `Some` if no legal collapse is left before.
    /// The first run evaluates every edge. `goes_on` gets the number of faces left.
    pub fn run(&mut self, target: usize, mut goes_on: impl FnMut(usize) -> bool) -> Option<Stuck> {
        if !self.is_scheduled {
            for (number, ends) in self.edges.surface.mesh.edges().into_iter().enumerate() {
                if number % STEPS == STEPS - 1 && !goes_on(self.face_count()) {
                    return None;
                }
                self.edges.evaluate(ends, &mut self.schedule);
            }
            self.is_scheduled = true;
        }
        let mut is_ended = false;
        let show = |edges: &Edges| {
            is_ended = edges.history.collapses.len().is_multiple_of(STEPS)
                && !goes_on(edges.surface.mesh.alive_count());
            !is_ended
        };
        let is_reached = greedy::run(&mut self.edges, &mut self.schedule, target, show);
        if is_ended {
            return None;
        }
        if !is_reached {
            return Some(self.edges.why_stuck());
        }
        goes_on(self.face_count());
        None
    }

    /// Ends the loop. Labels and instances of the faces left go into the history.
    pub fn finish(self) -> History {
        let Edges { surface, labels, instances, mut history, .. } = self.edges;
        for t in surface.mesh.alive() {
            history.base.push(surface.mesh.corners[t as usize].map(|v| labels[v as usize]));
            history.base_instances.push(instances[t as usize]);
            history.base_surface += usize::from((t as usize) < history.surface_triangles);
        }
        history
    }
}

impl Collapsing for Edges {
    type Note = ();

    fn mesh(&self) -> &Connectivity {
        &self.surface.mesh
    }

    fn is_valid(&self, candidate: &Candidate) -> bool {
        // An edge that is gone has lost its state, see `apply`.
        let state = self.states.get(&candidate.ends);
        matches!(state, Some(EdgeState::Queued(time)) if *time == candidate.time)
    }

    /// A refused edge is remembered and comes back when something near it changes.
    fn evaluate(&mut self, ends: [u32; 2], schedule: &mut Schedule) {
        let cost = if !self.surface.gather(ends) {
            Err(Refusal::NoVertex)
        } else if self.priority == Priority::Span {
            Ok(self.surface.span(ends))
        } else {
            self.surface.place(ends, false).map(|placement| placement.cost)
        };
        match cost {
            Ok(cost) => self.enqueue(cost, ends, schedule.now(), schedule),
            Err(refusal) => self.refuse(ends, refusal),
        }
    }

    /// Places the vertex exactly and collapses; `false` if the edge is refused or put back.
    ///
    /// The span is only an estimate of the volume that a collapse adds. An edge that adds more than
    /// its span goes back into the queue with the true volume, unless the conditions are the
    /// paper's. This costs no further linear program for the other edges, and the last few hundred
    /// faces are better by it.
    fn collapse(&mut self, candidate: &Candidate, schedule: &mut Schedule) -> bool {
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
                if self.surface.conditions.puts_back
                    && self.priority == Priority::Span
                    && placement.cost > 6.000_001 * candidate.cost =>
            {
                self.enqueue(placement.cost / 6.0, ends, schedule.now(), schedule);
                false
            }
            Ok(placement) => self.apply(ends, placement).is_some(),
        }
    }

    /// Edges of the new vertex are evaluated at once, refused ones get another chance, and the rest
    /// are found stale when they come out of the queue.
    fn reconsider(&mut self, vertex: u32, ring: &[u32], schedule: &mut Schedule) {
        for &v in ring {
            self.evaluate([vertex.min(v), vertex.max(v)], schedule);
        }
        let eager = self.surface.mesh.alive_count() <= self.surface.conditions.lazy_above;
        let mut around = std::mem::take(&mut self.around);
        around.clear();
        // No edge of a vertex with more triangles may collapse: it is the centre of a large hole.
        let is_small = |v: &&u32| self.surface.mesh.at(**v).len() <= MAX_STAR;
        for &v in ring.iter().filter(is_small) {
            let others = self.surface.mesh.neighbours(v).filter(|&w| w != vertex);
            around.extend(others.map(|w| [v.min(w), v.max(w)]));
        }
        if eager {
            around.sort_unstable();
            around.dedup();
        }
        for &ends in &around {
            if eager {
                self.evaluate(ends, schedule);
            } else if let Some(&EdgeState::Refused(cost)) = self.states.get(&ends) {
                self.enqueue(cost, ends, 0, schedule);
            }
        }
        self.around = around;
    }
}

impl Edges {
    fn faces(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        let label = |v: u32| self.labels[v as usize];
        self.surface.mesh.alive().map(move |t| self.surface.mesh.corners[t as usize].map(label))
    }

    fn enqueue(&mut self, cost: f64, ends: [u32; 2], time: u32, schedule: &mut Schedule) {
        self.states.insert(ends, EdgeState::Queued(time));
        schedule.add(Candidate { cost, rank: 0, ends, time, note: () });
    }

    fn refuse(&mut self, ends: [u32; 2], refusal: Refusal) {
        let cost = match refusal {
            Refusal::NoVertex => 0.0,
            Refusal::Condition(cost) => cost,
        };
        self.states.insert(ends, EdgeState::Refused(cost));
    }

    fn apply(&mut self, [a, b]: [u32; 2], placement: Placement) -> Option<()> {
        let ring = self.surface.mesh.ring(a, b)?;
        let right_wing = self.surface.mesh.leaving(b, a)?;
        let left_wing = self.surface.mesh.leaving(a, b)?;
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
        if self.surface.encloses() {
            self.history.added_volume.push(placement.cost / 6.0);
        }

        for v in self.surface.mesh.neighbours(b) {
            self.states.remove(&[b.min(v), b.max(v)]);
        }
        self.surface.collapse(a, b, placement.position);
        self.labels[a as usize] = vertex;
        let first = self.history.first_coarse(index);
        for (i, &t) in ring.triangles.iter().enumerate() {
            self.instances[t as usize] = first + i as u32;
        }
        Some(())
    }

    /// Tries every edge once more and counts the reasons of refusals.
    fn why_stuck(&mut self) -> Stuck {
        let mut stuck = Stuck::default();
        for ends in self.surface.mesh.edges() {
            if !self.surface.gather(ends) {
                stuck.topology += 1;
                continue;
            }
            match self.surface.place(ends, true) {
                Err(Refusal::Condition(_)) => stuck.shape += 1,
                Err(Refusal::NoVertex) | Ok(_) => stuck.no_vertex += 1,
            }
        }
        stuck
    }
}
