//! The greedy loop of edge collapses: cheapest first. Priorities, placement and admission are
//! plugged in as [`Collapsing`].
//!
//! Entries of the queue are never updated in place. An entry whose star has changed since is stale:
//! the loop recognises it when it comes out of the queue, and has it evaluated again.

use super::star::Connectivity;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// An edge that may be collapsed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate<N = ()> {
    /// Cost of the collapse when it was evaluated.
    pub cost: f64,
    /// Decides between equal costs, before the ends do.
    pub rank: u32,
    /// Ends, the lesser first.
    pub ends: [u32; 2],
    /// Time of the evaluation; 0 if the cost is only a guess.
    pub time: u32,
    /// Result of the evaluation that the collapse needs.
    pub note: N,
}

impl<N> Ord for Candidate<N> {
    /// The cheapest is the greatest. Ties are ordered, so a build does not depend on the heap's
    /// history.
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .cost
            .total_cmp(&self.cost)
            .then_with(|| (other.rank, other.ends).cmp(&(self.rank, self.ends)))
            .then(self.time.cmp(&other.time))
    }
}

impl<N> PartialOrd for Candidate<N> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<N> PartialEq for Candidate<N> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<N> Eq for Candidate<N> {}

/// Candidates by rising cost, and the times at which stars changed.
#[derive(Clone, Debug)]
pub(crate) struct Schedule<N = ()> {
    queue: BinaryHeap<Candidate<N>>,
    /// When the star of each vertex last changed.
    changed: Vec<u32>,
    now: u32,
}

impl<N> Schedule<N> {
    /// An empty one, at time 1.
    pub fn new(vertex_count: usize) -> Self {
        Self { queue: BinaryHeap::new(), changed: vec![0; vertex_count], now: 1 }
    }

    /// The time. Every collapse advances it by 1.
    pub fn now(&self) -> u32 {
        self.now
    }

    /// Adds an edge with its cost now.
    pub fn push(&mut self, cost: f64, ends: [u32; 2], note: N) {
        self.add(Candidate { cost, rank: 0, ends, time: self.now, note });
    }

    /// Adds a candidate.
    pub fn add(&mut self, candidate: Candidate<N>) {
        self.queue.push(candidate);
    }

    /// Whether the star of an edge has changed since a time.
    pub fn is_stale(&self, [a, b]: [u32; 2], time: u32) -> bool {
        time < self.changed[a as usize].max(self.changed[b as usize])
    }

    /// Advances the time, and marks the stars of a vertex and its ring as changed.
    fn mark(&mut self, vertex: u32, ring: &[u32]) {
        self.now += 1;
        self.changed[vertex as usize] = self.now;
        ring.iter().for_each(|&v| self.changed[v as usize] = self.now);
    }
}

/// A mesh that the loop collapses: the priority of its edges, the placement of new vertices, and
/// the conditions that admit them.
pub(crate) trait Collapsing {
    /// Result of an evaluation that the collapse needs.
    type Note;

    /// The mesh as it is.
    fn mesh(&self) -> &Connectivity;

    /// Adds an edge to the schedule with its cost now, unless it may not collapse.
    fn evaluate(&mut self, ends: [u32; 2], schedule: &mut Schedule<Self::Note>);

    /// Whether a candidate's entry counts. False for an edge that is gone.
    fn is_valid(&self, candidate: &Candidate<Self::Note>) -> bool;

    /// Collapses an edge into its first end; false if no place for the vertex meets all conditions.
    fn collapse(
        &mut self,
        candidate: &Candidate<Self::Note>,
        schedule: &mut Schedule<Self::Note>,
    ) -> bool;

    /// Evaluates edges whose star a collapse has changed.
    fn reconsider(&mut self, vertex: u32, ring: &[u32], schedule: &mut Schedule<Self::Note>) {
        for &v in ring {
            self.evaluate([vertex.min(v), vertex.max(v)], schedule);
        }
    }

    /// The queue is empty: adds more; false if there is nothing more to try.
    fn refill(&mut self, _schedule: &mut Schedule<Self::Note>) -> bool {
        false
    }

    /// Whether to stop now.
    fn is_late(&self) -> bool {
        false
    }
}

/// Collapses the cheapest edge until at most `target` faces are left; false if it ends before.
/// `on_collapse` is called after each collapse, and tells whether to go on.
pub(crate) fn run<C: Collapsing>(
    of: &mut C,
    schedule: &mut Schedule<C::Note>,
    target: usize,
    mut on_collapse: impl FnMut(&C) -> bool,
) -> bool {
    let mut ring = Vec::new();
    while of.mesh().alive_count() > target {
        if of.is_late() {
            return false;
        }
        let Some(candidate) = schedule.queue.pop() else {
            if of.refill(schedule) {
                continue;
            }
            return false;
        };
        if !of.is_valid(&candidate) {
            continue;
        }
        if schedule.is_stale(candidate.ends, candidate.time) {
            of.evaluate(candidate.ends, schedule);
        } else if of.collapse(&candidate, schedule) {
            let [vertex, _] = candidate.ends;
            ring.clear();
            ring.extend(of.mesh().neighbours(vertex));
            schedule.mark(vertex, &ring);
            of.reconsider(vertex, &ring, schedule);
            if !on_collapse(of) {
                return false;
            }
        }
    }
    true
}
