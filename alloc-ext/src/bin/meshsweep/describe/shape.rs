//! How full a box tree is: counted by walking it once.

use meshsweep_core::Bvh;
use meshsweep_core::internal::bvh::tree::format::{BvhHeader, FanLeaf};
use meshsweep_core::internal::geom::fan::WIDTH;

/// Counts and means of a tree.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// Fans of 1, 2, … 8 triangles.
    pub fan_sizes: [u32; WIDTH],
    /// Triangles that have no area as they are stored.
    pub flat: u32,
    pub triangles_per_leaf: f64,
    pub children_per_node: f64,
    /// Nodes on the longest path from the root.
    pub depth: u32,
}

impl Shape {
    pub fn of(tree: &Bvh<'_>) -> Shape {
        let &BvhHeader { nodes, leaves, triangles, .. } = tree.header();
        let mut depth = vec![1u32; nodes as usize];
        let mut children = 0u64;
        let mut fan_sizes = [0; WIDTH];
        let mut flat = 0;
        // A node's number is less than its children's.
        for node in 0..nodes {
            let Some(links) = tree.links(node) else { break };
            children += u64::from(links.count);
            let below = depth[node as usize] + 1;
            let first = links.first_node as usize;
            depth.iter_mut().skip(first).take(links.inner as usize).for_each(|d| *d = below);
            for leaf in (links.inner..links.count).filter_map(|lane| tree.leaf(node, lane)) {
                let count = leaf.shape().triangles();
                let first = leaf.shape().turn().min(count);
                for size in [first, count - first].into_iter().filter(|&size| size > 0) {
                    fan_sizes[size - 1] += 1;
                }
                flat += (0..count).filter(|&lane| is_flat(&leaf, lane)).count() as u32;
            }
        }
        Shape {
            fan_sizes,
            flat,
            triangles_per_leaf: f64::from(triangles) / f64::from(leaves.max(1)),
            children_per_node: children as f64 / f64::from(nodes.max(1)),
            depth: depth.into_iter().max().unwrap_or(0),
        }
    }

    pub fn fans(&self) -> u32 {
        self.fan_sizes.iter().sum()
    }

    pub fn triangles_per_fan(&self) -> f64 {
        let triangles: u32 = (1..).zip(self.fan_sizes).map(|(size, count)| size * count).sum();
        f64::from(triangles) / f64::from(self.fans().max(1))
    }

    /// Fans of a single triangle.
    pub fn single_triangle_fans(&self) -> u32 {
        self.fan_sizes[0]
    }
}

fn is_flat(leaf: &FanLeaf<'_>, lane: usize) -> bool {
    let [a, b, c] = leaf.corners(lane).map(|corner| corner.as_dvec3());
    (b - a).cross(c - a) == glam::DVec3::ZERO
}
