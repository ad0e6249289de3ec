//! The points below nodes, with boxes for searching the extreme ones.

use super::extent::{Extent, Frame, PointBounds, PointSet};
use super::order::Topology;
use glam::DVec3;
use rayon::prelude::*;

/// All points of a tree: those of its leaves.
pub(super) struct Subtrees<'a> {
    topology: &'a Topology,
    /// Each item's points.
    leaves: &'a [&'a [DVec3]],
    item_bounds: Vec<PointBounds>,
    node_bounds: Vec<PointBounds>,
}

/// A child of a node.
#[derive(Clone, Copy)]
pub(super) enum Child {
    Node(u32),
    Item(u32),
}

impl<'a> Subtrees<'a> {
    /// `leaves` are the items' points.
    pub(super) fn new(topology: &'a Topology, leaves: &'a [&'a [DVec3]]) -> Self {
        let mut subtrees = Self {
            topology,
            leaves,
            item_bounds: leaves.par_iter().map(|points| PointBounds::of(points)).collect(),
            node_bounds: vec![PointBounds::EMPTY; topology.nodes.len()],
        };
        // Children come after their parents.
        for node in (0..topology.nodes.len() as u32).rev() {
            let bounds = subtrees.children(node).map(|child| subtrees.bounds(child));
            let all = bounds.fold(PointBounds::EMPTY, |all, of| all.union(of));
            subtrees.node_bounds[node as usize] = all;
        }
        subtrees
    }

    /// Inner children first, then leaves.
    fn children(&self, node: u32) -> impl Iterator<Item = Child> + use<'a> {
        let node = &self.topology.nodes[node as usize];
        let inner = node.inner.iter().map(|&child| Child::Node(child));
        inner.chain(node.leaves.iter().map(|&item| Child::Item(item)))
    }

    fn bounds(&self, child: Child) -> &PointBounds {
        match child {
            Child::Node(node) => &self.node_bounds[node as usize],
            Child::Item(item) => &self.item_bounds[item as usize],
        }
    }

    /// The points below each child of a node; `known` are some of them, for each inner child.
    pub(super) fn below<'b>(
        &'b self,
        node: u32,
        known: impl Fn(u32) -> &'b [DVec3],
    ) -> Vec<Subtree<'b>> {
        let subtree = |child| {
            let known = match child {
                Child::Node(node) => known(node),
                Child::Item(_) => &[],
            };
            Subtree { of: self, child, known }
        };
        self.children(node).map(subtree).collect()
    }

    /// Any point below `child`. Leaves are tried first, because they hold points themselves.
    fn first(&self, child: Child) -> Option<DVec3> {
        match child {
            Child::Item(item) => self.leaves[item as usize].first().copied(),
            Child::Node(node) => {
                let node = &self.topology.nodes[node as usize];
                let of_leaves = node.leaves.iter().map(|&item| Child::Item(item));
                let of_inner = node.inner.iter().map(|&child| Child::Node(child));
                of_leaves.chain(of_inner).find_map(|child| self.first(child))
            }
        }
    }

    /// Includes the points below `child`; skips subtrees whose box the extent contains.
    fn include(&self, child: Child, frame: &Frame, extent: &mut Extent) {
        if extent.contains(&frame.enclose(self.bounds(child))) {
            return;
        }
        match child {
            Child::Item(item) => extent.include(self.leaves[item as usize], frame),
            Child::Node(node) => {
                self.children(node).for_each(|child| self.include(child, frame, extent));
            }
        }
    }
}

/// The points below one child of a node.
pub(super) struct Subtree<'a> {
    of: &'a Subtrees<'a>,
    child: Child,
    /// Points that are likely to be extreme, so that most others are skipped.
    known: &'a [DVec3],
}

impl PointSet for Subtree<'_> {
    fn first(&self) -> Option<DVec3> {
        self.of.first(self.child)
    }

    fn extent(&self, frame: &Frame) -> Extent {
        let bounds = self.of.bounds(self.child);
        if frame.is_along_axes() {
            return frame.enclose(bounds).widened(bounds, frame);
        }
        let mut extent = Extent::EMPTY;
        match self.child {
            Child::Item(item) => extent.include(self.of.leaves[item as usize], frame),
            Child::Node(_) => {
                extent.include(self.known, frame);
                self.of.include(self.child, frame, &mut extent);
            }
        }
        extent.widened(bounds, frame)
    }
}
