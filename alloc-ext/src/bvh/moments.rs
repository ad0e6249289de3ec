//! Moments of all nodes, for winding numbers. `core/docs/rounding.md` §20 bounds their errors.

use super::fans::FanLeaf;
use super::nodes::order::Topology;
use super::store::OnGrid;
use crate::error::BuildError;
use crate::mesh::Mesh;
use crate::progress::Watch;
use crate::surface::{EdgeTable, ends};
use glam::{DMat3, DVec3};
use meshsweep_core::internal::bvh::tree::format::NodeMoments;
use meshsweep_core::internal::num::{exp2, up_to_f32};
use std::collections::BinaryHeap;

/// The section's bytes, in the order of nodes.
pub(super) fn moments(
    mesh: &Mesh,
    edges: &EdgeTable,
    topology: &Topology,
    leaves: &[FanLeaf],
    grid: &OnGrid,
    watch: Watch<'_>,
) -> Result<Vec<u8>, BuildError> {
    let tree = Tree::new(mesh, topology, leaves);
    let moved = grid.surface_error / exp2(grid.exponent);
    let boundaries = tree.boundaries(&mesh.triangles, edges, &grid.positions, moved);
    let of_node = |node: usize| {
        let mut triangles = Vec::new();
        tree.triangles_below(node as u32, &mut triangles);
        let corners: Vec<[DVec3; 3]> = triangles
            .iter()
            .map(|&t| mesh.triangles[t as usize].map(|v| grid.positions[v as usize]))
            .collect();
        of_triangles(&corners, boundaries[node]).write()
    };
    Ok(watch.map(topology.nodes.len(), of_node)?.into_flattened())
}

/// Which node holds which triangles. Wires have no area, so they are left out.
struct Tree<'a> {
    topology: &'a Topology,
    leaves: &'a [FanLeaf],
    /// Triangles that are no wires.
    count: u32,
    /// The node of each triangle's leaf.
    node_of: Vec<u32>,
    /// The parent of each node; of the root itself.
    parent: Vec<u32>,
}

impl<'a> Tree<'a> {
    fn new(mesh: &Mesh, topology: &'a Topology, leaves: &'a [FanLeaf]) -> Self {
        let count = mesh.triangles.len();
        let mut tree = Tree {
            topology,
            leaves,
            count: count as u32,
            node_of: vec![0; count],
            parent: vec![0; topology.nodes.len()],
        };
        for (number, node) in (0u32..).zip(&topology.nodes) {
            node.inner.iter().for_each(|&child| tree.parent[child as usize] = number);
            let own: Vec<u32> = tree.own_triangles(number).collect();
            own.into_iter().for_each(|triangle| tree.node_of[triangle as usize] = number);
        }
        tree
    }

    /// Triangles of a node's own leaves.
    fn own_triangles(&self, node: u32) -> impl Iterator<Item = u32> {
        let node = &self.topology.nodes[node as usize];
        let items = node.leaves.iter().flat_map(|&item| self.leaves[item as usize].triangles());
        items.filter(|&t| t < self.count)
    }

    fn triangles_below(&self, node: u32, out: &mut Vec<u32>) {
        let mut open = vec![node];
        while let Some(node) = open.pop() {
            out.extend(self.own_triangles(node));
            open.extend(&self.topology.nodes[node as usize].inner);
        }
    }

    /// For each node the length of its boundary. An edge counts as often as the node's triangles
    /// use it more in one direction than in the other, and made `2·moved` longer.
    fn boundaries(
        &self,
        triangles: &[[u32; 3]],
        edges: &EdgeTable,
        positions: &[DVec3],
        moved: f64,
    ) -> Vec<f64> {
        let mut boundaries = vec![0.0; self.parent.len()];
        // Nodes that use the edge, each with its uses in one direction less those in the other.
        let mut uses: BinaryHeap<(u32, i32)> = BinaryHeap::new();
        for edge in edges.edges() {
            let mut length = 0.0;
            uses.clear();
            uses.extend(edge.iter().map(|&(_, half_edge)| {
                let [from, to] = ends(triangles, half_edge);
                length = (positions[from as usize] - positions[to as usize]).length();
                (self.node_of[half_edge as usize / 3], if from < to { 1 } else { -1 })
            }));
            // Parents come before children, so the greatest number is complete.
            while let Some((node, mut net)) = uses.pop() {
                while let Some(&(_, more)) = uses.peek().filter(|of| of.0 == node) {
                    net += more;
                    uses.pop();
                }
                boundaries[node as usize] += f64::from(net.abs()) * (length + 2.0 * moved);
                if node > 0 && (net != 0 || !uses.is_empty()) {
                    uses.push((self.parent[node as usize], net));
                }
            }
        }
        boundaries
    }
}

/// Rounding of a sum of this many terms in f64, relative to their sizes: 2^-50 for each (§20).
fn rounding(terms: usize) -> f64 {
    (terms + 64) as f64 * exp2(-50)
}

fn of_triangles(corners: &[[DVec3; 3]], boundary: f64) -> NodeMoments {
    let (mut area, mut weighted, mut centroids) = (0.0, DVec3::ZERO, DVec3::ZERO);
    for &[a, b, c] in corners {
        let here = 0.5 * (b - a).cross(c - a).length();
        centroids += (a + b + c) / 3.0;
        weighted += (a + b + c) * (here / 3.0);
        area += here;
    }
    // Any centre will do; that of the area has the least moments.
    let mean = centroids / corners.len().max(1) as f64;
    let centre = if area > 0.0 { weighted / area } else { mean }.as_vec3();
    let about = |v: DVec3| v - centre.as_dvec3();
    let mut normals = DVec3::ZERO;
    let mut first_moment = DMat3::ZERO;
    let (mut spread, mut sizes, mut radius) = (0.0, 0.0, 0f64);
    for &triangle in corners {
        // Differences of stored corners are exact on the grid.
        let [e, g] = [triangle[1] - triangle[0], triangle[2] - triangle[0]];
        let [a, b, c] = triangle.map(about);
        let normal = 0.5 * e.cross(g);
        let h = (a + b + c) / 3.0;
        normals += normal;
        first_moment += DMat3::from_cols(h * normal.x, h * normal.y, h * normal.z);
        let size = e.length() * g.length();
        let squares = a.length_squared() + b.length_squared() + c.length_squared();
        let most_area = normal.length() + size * exp2(-48);
        spread += most_area * (squares + (a + b + c).length_squared()) / 12.0;
        sizes += size;
        radius = radius.max(squares_max([a, b, c]).sqrt());
    }
    let relative = rounding(corners.len());
    let radius = up_to_f32(radius * (1.0 + relative));
    let symmetric = (first_moment + first_moment.transpose()) * 0.5;
    let third = (symmetric.x_axis.x + symmetric.y_axis.y + symmetric.z_axis.z) / 3.0;
    let [xx, xy, xz] = symmetric.x_axis.to_array();
    let wanted = [xx - third, xy, xz, symmetric.y_axis.y - third, symmetric.y_axis.z];
    let stored = wanted.map(|x| x as f32);
    let stored_area = normals.as_vec3();
    // Entries off the diagonal count twice, and the last of the diagonal is minus the others.
    let off: [f64; 5] = std::array::from_fn(|i| (wanted[i] - f64::from(stored[i])).abs());
    let off_first = 2.0 * off.iter().sum::<f64>();
    let off_area = (normals - stored_area.as_dvec3()).length();
    let per_radius = if radius > 0.0 { 3.0 * off_first / f64::from(radius) } else { 0.0 };
    NodeMoments {
        centre,
        radius,
        area: stored_area,
        first: stored,
        spread: up_to_f32(3.0 * spread * (1.0 + relative)),
        area_error: up_to_f32((off_area + per_radius + 4.0 * relative * sizes) * (1.0 + relative)),
        boundary: up_to_f32(boundary * (1.0 + relative)),
    }
}

fn squares_max(points: [DVec3; 3]) -> f64 {
    points.into_iter().map(DVec3::length_squared).fold(0.0, f64::max)
}
