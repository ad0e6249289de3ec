//! Candidate edges by rising cost. Entries are never updated in place: a stale one is recognised
//! when it comes out.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A candidate edge.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// What the collapse costs, as far as known.
    pub cost: f64,
    /// Ends, the lesser first.
    pub ends: [u32; 2],
    /// Time of the evaluation; 0 if the cost is only a guess.
    pub time: u32,
}

impl Candidate {
    /// Equal costs are ordered by the ends, so that a build does not depend on the heap's history.
    fn key(&self) -> (f64, [u32; 2], u32) {
        (self.cost, self.ends, self.time)
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let (a, b) = (self.key(), other.key());
        b.0.total_cmp(&a.0).then_with(|| b.1.cmp(&a.1)).then_with(|| a.2.cmp(&b.2))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

/// The queue.
pub type Queue = BinaryHeap<Candidate>;
