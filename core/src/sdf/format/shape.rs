//! The check of a tree's entries.
//!
//! The root cells come first. Then come the children of each node, in the order in which a descent
//! that visits children one after the other first meets the node. So a node's first child stands
//! where the entries seen so far end: each entry has one parent, and all are reached. The descent
//! needs a stack of as many places as there are steps.

use super::layout::tree::{AXES, ENTRY_BYTES, IS_LEAF, MOST_LEVEL, MOST_STEPS};

/// Children of one node that are to be visited, and how often their cells were halved along each
/// axis.
#[derive(Clone, Copy)]
struct Open {
    next: u32,
    end: u32,
    levels: [u8; 3],
}

/// Entries that a question reads at most; `None` of entries that are no tree.
pub(super) fn steps(entries: &[[u8; ENTRY_BYTES]], roots: u32) -> Option<u8> {
    let count = u32::try_from(entries.len()).ok()?;
    let mut stack = [Open { next: 0, end: roots, levels: [0; 3] }; MOST_STEPS as usize];
    let (mut depth, mut deepest, mut end) = (0usize, 0, roots);
    loop {
        let open = stack.get_mut(depth)?;
        if open.next == open.end {
            match depth.checked_sub(1) {
                Some(above) => depth = above,
                None => break,
            }
            continue;
        }
        let ([a, b, c, kind, e], mut levels) = (*entries.get(open.next as usize)?, open.levels);
        open.next = open.next.wrapping_add(1);
        let after = open.next;
        deepest = deepest.max(depth);
        if kind & IS_LEAF != 0 {
            continue;
        }
        if [c, e] != [0; 2] || kind == 0 || kind & !AXES != 0 {
            return None;
        }
        for (axis, level) in levels.iter_mut().enumerate() {
            *level = level.wrapping_add(kind >> axis & 1);
            if u32::from(*level) > MOST_LEVEL {
                return None;
            }
        }
        if u32::from(u16::from_le_bytes([a, b])).wrapping_add(after) != end {
            return None;
        }
        let next = end;
        end = end.wrapping_add(1 << kind.count_ones());
        depth = depth.wrapping_add(1);
        *stack.get_mut(depth)? = Open { next, end, levels };
    }
    (end == count).then(|| deepest.wrapping_add(1) as u8)
}
