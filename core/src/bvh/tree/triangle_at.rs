//! Where a triangle lies in the tree, in one word.

use super::format::{Bvh, FanLeaf};

/// A triangle of the tree: its node, the number of its leaf among the node's children, and its
/// number in the leaf. Places rise as the triangles' numbers in the blob do, because leaves stand
/// in the order of their nodes ([`Bvh::open`] checks it).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct TriangleAt(u32);

impl TriangleAt {
    /// No triangle. Behind all others.
    pub(crate) const NONE: TriangleAt = TriangleAt(u32::MAX);

    /// A node's number has 24 bits.
    #[inline(always)]
    pub(crate) fn new(node: u32, child: u32, lane: usize) -> Self {
        TriangleAt(node << 6 | (child & 7) << 3 | (lane as u32 & 7))
    }

    /// The place in a word of [`Self::word`].
    #[inline(always)]
    pub(crate) fn of_word(word: u32) -> Self {
        TriangleAt(word)
    }

    /// The place as a word.
    #[inline(always)]
    pub(crate) fn word(self) -> u32 {
        self.0
    }

    /// Another triangle of the same leaf.
    #[inline(always)]
    pub(crate) fn with_lane(self, lane: usize) -> Self {
        TriangleAt(self.0 & !7 | (lane as u32 & 7))
    }

    /// Number of the triangle in its leaf.
    #[inline(always)]
    pub(crate) fn lane(self) -> usize {
        (self.0 & 7) as usize
    }

    #[inline(always)]
    pub(crate) fn node(self) -> u32 {
        self.0 >> 6
    }

    /// Number of the leaf among the children of the node.
    #[inline(always)]
    pub(crate) fn child(self) -> u32 {
        self.0 >> 3 & 7
    }

    /// The leaf that holds the triangle.
    #[inline(always)]
    pub(crate) fn leaf<'t>(self, tree: &Bvh<'t>) -> Option<FanLeaf<'t>> {
        tree.leaf(self.node(), self.child())
    }

    /// The triangle's number in the blob.
    pub(crate) fn number(self, tree: &Bvh<'_>) -> Option<u32> {
        let first = tree.links(self.node())?.triangle(self.child());
        Some(first.wrapping_add(self.0 & 7))
    }

    /// The triangle's number in the input file.
    pub(crate) fn source(self, tree: &Bvh<'_>) -> Option<u32> {
        tree.source(self.number(tree)?)
    }
}

#[cfg(test)]
mod tests {
    use super::TriangleAt;
    use crate::bvh::tree::format::Bvh;

    #[test]
    fn places_rise_as_numbers_do() {
        let tree = Bvh::open(include_bytes!("../../../fixtures/groove.msw")).unwrap();
        let (mut last, mut number) = (None, 0);
        for node in 0..tree.header().nodes {
            let links = tree.links(node).unwrap();
            for child in links.inner..links.count {
                for lane in 0..links.shape(child).triangles() {
                    let place = TriangleAt::new(node, child, lane);
                    assert!(last.is_none_or(|last| last < place) && place < TriangleAt::NONE);
                    assert_eq!(place.number(&tree), Some(number));
                    (last, number) = (Some(place), number + 1);
                }
            }
        }
        assert_eq!(number, tree.triangle_count());
    }
}
