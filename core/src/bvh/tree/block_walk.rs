//! The descent of a question that nothing ends early, on vector targets: the nearest child comes
//! first, at every level. `point/search/blocks` and `segment/blocks` use it. Other questions go by
//! `descent`.
//!
//! The stack is one of blocks in the caller's memory. A block holds a node and the keys of its
//! children, as the kernel leaves them in a register. A child that was visited has
//! [`NO_CHILD`](super::node::NO_CHILD) for a key. So a node costs one store, a return one load, and
//! the children come in order without a sort.
//!
//! From the keys of a node to the address of the next one, each instruction counts: the processor
//! waits for that chain and for little else.

use super::descent::{LeafVisit, LeafVisitor};
use super::format::{Bvh, BvhChild};
use super::node::{CHILD_MASK, OpenedNode, TakenLeast};
use super::prefetch::prefetch_children;
use crate::geom::fan::WIDTH;
use crate::query::{ScratchEntry, Work};

/// How a walk ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BlockWalk {
    /// Nothing within the limit is left.
    Done,
    /// The visitor ended it.
    Answered,
    /// The memory holds too few blocks: narrow nodes one below the other need more of it as blocks
    /// than as entries. Or more nodes were opened than the tree has, which was not checked.
    /// [`descend`](super::descent::descend) does not need more than
    /// [`scratch_entries`](Bvh::scratch_entries).
    Unfinished,
}

/// Entries of a block: keys of the children, two in an entry, and the node.
const BLOCK: usize = WIDTH / 2 + 1;

#[inline(always)]
fn write(block: &mut [ScratchEntry; BLOCK], keys: &[u32; WIDTH], node: u32) {
    let (pairs, _) = keys.as_chunks::<2>();
    for (slot, pair) in block.iter_mut().zip(pairs) {
        *slot = ScratchEntry::of_words(*pair);
    }
    block[BLOCK - 1] = ScratchEntry::of_words([0, node]);
}

#[inline(always)]
fn read(block: &[ScratchEntry; BLOCK]) -> [u32; WIDTH] {
    let mut keys = [[0; 2]; BLOCK - 1];
    for (pair, entry) in keys.iter_mut().zip(block) {
        *pair = entry.words();
    }
    let [[a, b], [c, d], [e, f], [g, h]] = keys;
    [a, b, c, d, e, f, g, h]
}

/// Visits every leaf within the visitor's limit, nearest child first. `keys_of` gives the keys of a
/// node's children (see [`NodeQuery::keys`](super::descent::NodeQuery::keys)), and `take_least` is
/// that of `node/keys.rs` for the target's registers. `boxes` are read by `keys_of`. `None` says
/// that the tree is unchecked.
#[inline(always)]
pub(crate) fn walk<const N: usize>(
    tree: &Bvh<'_>,
    boxes: &[[u8; N]],
    scratch: &mut [ScratchEntry],
    visitor: &mut impl LeafVisitor,
    work: &mut Work,
    keys_of: impl Fn(&OpenedNode) -> Option<[u32; WIDTH]>,
    take_least: impl Fn(&[u32; WIDTH], u32) -> TakenLeast,
) -> Option<BlockWalk> {
    let (blocks, _) = scratch.as_chunks_mut::<BLOCK>();
    let most_steps = tree.most_steps();
    let (mut splits, mut nodes, mut triangles) = (0u32, 0u32, 0u32);
    let mut used = 0usize;
    let (mut node, mut bound) = (0u32, 0u32);
    // Read where it may have changed, and only there. Before the keys it would be a load, which the
    // compiler makes as wide as a register: wider than what was stored there.
    let mut limit = visitor.limit();
    let ended = 'all: loop {
        let mut links = tree.links(node)?;
        prefetch_children(tree, boxes, &links);
        let opened = OpenedNode { node, count: links.count, bound, limit };
        let mut keys = keys_of(&opened)?;
        if splits == most_steps {
            break BlockWalk::Unfinished;
        }
        splits += 1;
        nodes += links.count;
        loop {
            let TakenLeast { least, rest, has_more } = take_least(&keys, limit);
            if least > limit {
                let Some(top) = used.checked_sub(1) else { break 'all BlockWalk::Done };
                used = top;
                let block = blocks.get(top)?;
                keys = read(block);
                node = block[BLOCK - 1].node();
                links = tree.links(node)?;
                continue;
            }
            let Some(block) = blocks.get_mut(used) else { break 'all BlockWalk::Unfinished };
            write(block, &rest, node);
            bound = least & !CHILD_MASK;
            let child = least & CHILD_MASK;
            // The inner children come first, so the next node need not wait for the shape.
            if child < links.inner {
                // A block without another child within the limit is overwritten.
                used += usize::from(has_more);
                node = links.first_node.wrapping_add(child);
                break;
            }
            let BvhChild { at, shape } = links.leaf_child(child);
            let leaf = tree.leaf_at(at, shape)?;
            triangles += shape.triangles() as u32;
            if !visitor.leaf(&LeafVisit { leaf, key: bound, node, child })? {
                break 'all BlockWalk::Answered;
            }
            limit = visitor.limit();
            keys = rest;
        }
    };
    work.opened += splits;
    work.bounds += nodes;
    work.triangles += triangles;
    Some(ended)
}
