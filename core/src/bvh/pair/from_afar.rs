//! Two models that are very far from each other, or of which no pair was measured. Balls around
//! their boxes bound the distance from below, two vertices from above.

use super::stored_pair::{StoredPair, moved};
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::format::layout::MAX_TREE_DEPTH;
use crate::bvh::tree::gap::TriangleGap;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::num::greater;
use crate::num::tolerance::U64;

/// Lower end: the gap of balls around both boxes. Upper end: the distance of one vertex of each.
/// `None` if a tree is unchecked.
#[cold]
#[inline(never)]
pub(crate) fn from_afar(pair: &StoredPair<'_>) -> Option<TriangleGap> {
    let [a, b] = pair.trees;
    let ([unit, _], longest) =
        (pair.common.vertices.units.map(f64::from), pair.common.vertices.longest);
    let (first, second) = (some_vertex(a)?, some_vertex(b)?);
    let near = |p: [f64; 3]| p.map(|x| x * unit);
    let points = [near(first.at), moved(&pair.common.vertices, second.at)];
    let ((middle_a, radius_a), (middle_b, radius_b)) = (ball(a), ball(b));
    let between = distance(near(middle_a), moved(&pair.common.vertices, middle_b));
    // Roundings of f64 in lengths up to the sum of all of these.
    let radii = radius_a * unit + radius_b * longest;
    let rounding = 4.0 * pair.common.vertices.vertex_error_f64 + 16.0 * U64 * (between + radii);
    let [p, q] = points;
    Some(TriangleGap {
        place: [first.place, second.place],
        lower: greater(0.0, between - radii - rounding),
        upper: distance(p, q) + rounding,
        meets: false,
        points,
    })
}

/// A vertex of the first triangle of some leaf.
struct Vertex {
    place: TriangleAt,
    /// The tree's units, from its origin.
    at: [f64; 3],
}

fn some_vertex(tree: &Bvh<'_>) -> Option<Vertex> {
    let mut node = 0;
    for _ in 0..MAX_TREE_DEPTH {
        let child = tree.child(node, 0)?;
        if child.is_leaf() {
            let leaf = tree.leaf_at(child.at, child.shape)?;
            let at = leaf.stored_vertices().map(|[centre, ..]| f64::from(centre));
            return Some(Vertex { place: TriangleAt::new(node, 0, 0), at });
        }
        node = child.at;
    }
    None
}

/// A ball that contains the tree, its units, from its origin.
fn ball(tree: &Bvh<'_>) -> ([f64; 3], f64) {
    let header = tree.header();
    let origin = if header.is_f32() { [0.0; 3] } else { header.grid_origin.map(f64::from) };
    let (low, high) = tree.grid_bounds();
    let [low, high] = [low, high].map(|corner| corner.to_array().map(f64::from));
    let middle = |k: usize| (low[k % 3] + high[k % 3]) * 0.5 - origin[k % 3];
    let radius = distance(low, high) * 0.5 * (1.0 + 16.0 * U64);
    ([middle(0), middle(1), middle(2)], radius)
}

fn distance([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> f64 {
    let (u, v, w) = (x - a, y - b, z - c);
    libm::sqrt((u * u + v * v) + w * w)
}
