//! The box tree: shape, memory, surface error, whether sides are defined.

use super::Length;
use crate::counted::Counted;
use meshsweep_core::Tree;
use meshsweep_core::num::{exp2, up_to_f32};
use meshsweep_core::query::tree::TreeEntry;
use std::io::{self, Write};

/// How full a tree is.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    pub triangles_per_leaf: f64,
    pub children_per_node: f64,
    /// Nodes on the longest path from the root.
    pub depth: u32,
}

impl Shape {
    pub fn of(tree: &Tree<'_>) -> Shape {
        let h = tree.header();
        let mut depth = vec![1u32; h.nodes as usize];
        let mut children = 0u64;
        // A node's number is less than its children's.
        for node in 0..h.nodes {
            let Some(links) = tree.links(node) else { break };
            children += u64::from(links.count);
            let below = depth[node as usize] + 1;
            let first = links.first_node as usize;
            depth.iter_mut().skip(first).take(links.inner as usize).for_each(|d| *d = below);
        }
        Shape {
            triangles_per_leaf: f64::from(h.triangles) / f64::from(h.leaves.max(1)),
            children_per_node: children as f64 / f64::from(h.nodes.max(1)),
            depth: depth.into_iter().max().unwrap_or(0),
        }
    }
}

/// Bytes of a stack with which no query overflows.
pub fn stack_bytes(tree: &Tree<'_>) -> usize {
    tree.header().stack_entries as usize * size_of::<TreeEntry>()
}

/// Distance between the stored surface and the file's, rounded up, in the mesh's unit.
pub fn tree_surface_error(tree: &Tree<'_>) -> f32 {
    up_to_f32(f64::from(tree.header().surface_error) * exp2(tree.scale_exponent()))
}

/// How coordinates are stored.
pub fn tree_format_name(tree: &Tree<'_>) -> &'static str {
    if tree.header().is_single() { "f32" } else { "16-bit grid" }
}

pub(super) fn write(out: &mut dyn Write, tree: &Tree<'_>) -> io::Result<()> {
    let h = tree.header();
    let shape = Shape::of(tree);
    writeln!(out, "box tree")?;
    writeln!(
        out,
        "  surface error {} (coordinates: {})",
        Length(tree_surface_error(tree)),
        tree_format_name(tree)
    )?;
    let closed = if h.is_closed() {
        "closed: signed distance is defined"
    } else {
        "open: signed distance is undefined"
    };
    writeln!(out, "  {closed}")?;
    writeln!(
        out,
        "  {} in {} ({:.2} each), {} ({:.2} children each), depth {}",
        Counted(h.triangles, "triangle"),
        Counted(h.leaves, "leaf"),
        shape.triangles_per_leaf,
        Counted(h.nodes, "node"),
        shape.children_per_node,
        shape.depth
    )?;
    writeln!(
        out,
        "  stack: {}, {} bytes of RAM: no query can overflow it",
        Counted(h.stack_entries, "entry"),
        stack_bytes(tree)
    )
}
