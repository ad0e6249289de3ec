//! Pairs that a search left out, so that a later search can begin with them.

use crate::num::{down_to_f32, lesser};

/// The groups of pairs that searches left out, in the caller's memory.
pub(crate) struct SkippedPairs<'f> {
    pub(crate) groups: &'f mut [PairGroup],
    /// Groups in use.
    pub(crate) count: usize,
    /// A group did not fit.
    pub(crate) is_truncated: bool,
    /// The groups already hold the searched pairs: `keep` adds none.
    pub(crate) is_known: bool,
}

impl SkippedPairs<'_> {
    /// These pairs are not nearer than `distance`, common units.
    pub(crate) fn keep(&mut self, pairs: ChildPairs, distance: f64) {
        if self.is_known {
            return;
        }
        let ChildPairs { nodes, wanted } = pairs;
        let wanted = [wanted as u32, (wanted >> 32) as u32];
        let group = PairGroup { distance: down_to_f32(distance), nodes, wanted };
        let count = self.count;
        let latest = count.saturating_sub(LATEST)..count;
        let latest = self.groups.get_mut(latest).unwrap_or(&mut []);
        if let Some(like) = latest.iter_mut().find(|other| other.is_like(&group)) {
            like.add(&group);
            return;
        }
        match self.groups.get_mut(count) {
            Some(slot) => {
                *slot = group;
                self.count += 1;
            }
            None => self.is_truncated = true,
        }
    }

    /// Pairs did not fit the search's stack, so they never reach these groups.
    pub(crate) fn overflow(&mut self) {
        self.is_truncated |= !self.is_known;
    }
}

/// Pairs of children of two nodes that a search left out.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairGroup {
    /// No pair is nearer, common units.
    pub(crate) distance: f32,
    nodes: [u32; 2],
    /// [`ChildPairs::wanted`], its lower half first. In halves an entry has 20 bytes.
    wanted: [u32; 2],
}

impl PairGroup {
    pub(crate) const EMPTY: PairGroup = PairGroup { distance: 0.0, nodes: [0; 2], wanted: [0; 2] };

    pub(crate) fn pairs(&self) -> ChildPairs {
        let [low, high] = self.wanted.map(u64::from);
        ChildPairs { nodes: self.nodes, wanted: high << 32 | low }
    }

    fn is_like(&self, other: &PairGroup) -> bool {
        self.nodes == other.nodes
            && self.distance <= other.distance * LIKE
            && other.distance <= self.distance * LIKE
    }

    fn add(&mut self, other: &PairGroup) {
        let ([low, high], [more_low, more_high]) = (self.wanted, other.wanted);
        self.wanted = [low | more_low, high | more_high];
        self.distance = lesser(self.distance, other.distance);
    }
}

/// Groups of the same nodes are merged if their distances are within this factor.
const LIKE: f32 = 1.25;

/// Only this many latest groups are compared: those of the same nodes come soon after each other.
const LATEST: usize = 8;

/// Pairs of children of two nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ChildPairs {
    pub(crate) nodes: [u32; 2],
    /// A byte for each child of the first node, a bit in it for each child of the second.
    pub(crate) wanted: u64,
}

impl ChildPairs {
    /// Both trees whole.
    pub(crate) const ALL: ChildPairs = ChildPairs { nodes: [0; 2], wanted: u64::MAX };
}
