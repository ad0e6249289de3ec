//! Asks the cache for what a descent is about to read.

use super::format::{Bvh, Links};

/// Bytes of a line of the cache.
#[cfg(meshsweep_avx2)]
const LINE: usize = 64;

/// Bytes of leaves from which on a tree is asked for ahead. A smaller one stays in the second-level
/// cache.
#[cfg(meshsweep_avx2)]
const LARGE: usize = 1 << 18;

/// Asks for the records of a node's children: boxes and links of nodes, vertices of leaves. They
/// are neighbours. If there is one kind of children only, others of the tree are asked for as well:
/// a branch would cost more. `boxes` are those of the question, of all nodes.
#[cfg(meshsweep_avx2)]
#[inline(always)]
pub(crate) fn prefetch_children<const N: usize>(tree: &Bvh<'_>, boxes: &[[u8; N]], links: &Links) {
    if tree.fans.len() < LARGE {
        return;
    }
    let node = links.first_node as usize;
    let boxes = boxes.get(node..).unwrap_or_default().as_flattened();
    let vertex_bytes = if tree.header.is_f32() { 12 } else { 6 };
    let leaves = tree.fans.get(links.first_vertex as usize * vertex_bytes..).unwrap_or_default();
    prefetch::<8>(boxes);
    prefetch::<7>(leaves);
    prefetch::<2>(tree.links.get(node..).unwrap_or_default().as_flattened());
}

/// No stable function of the target does it.
#[cfg(target_arch = "aarch64")]
#[inline(always)]
pub(crate) fn prefetch_children<const N: usize>(_: &Bvh<'_>, _: &[[u8; N]], _: &Links) {}

/// Asks for the number in the input file of a leaf's first triangle: an answer may name it.
#[cfg(meshsweep_avx2)]
#[inline(always)]
pub(crate) fn prefetch_source(tree: &Bvh<'_>, node: u32, child: u32) {
    if tree.fans.len() >= LARGE {
        prefetch_source_of_large(tree, node, child);
    }
}

#[cfg(meshsweep_avx2)]
#[inline(never)]
fn prefetch_source_of_large(tree: &Bvh<'_>, node: u32, child: u32) {
    let Some(links) = tree.links(node) else { return };
    prefetch::<1>(tree.source_bytes(links.triangle(child)).unwrap_or_default());
}

/// No stable function of the target does it.
#[cfg(target_arch = "aarch64")]
#[inline(always)]
pub(crate) fn prefetch_source(_: &Bvh<'_>, _: u32, _: u32) {}

/// Asks for the first lines. Near the end of a section it asks for none.
#[cfg(meshsweep_avx2)]
#[inline(always)]
fn prefetch<const LINES: usize>(bytes: &[u8]) {
    let (lines, _) = bytes.as_chunks::<LINE>();
    if let Some(lines) = lines.first_chunk::<LINES>() {
        for line in lines {
            safe_arch::prefetch_t0(line);
        }
    }
}
