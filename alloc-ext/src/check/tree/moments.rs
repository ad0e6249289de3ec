//! Whether the moments of every node are those of the triangles below it, within the errors that
//! they state. In f64, whose rounding the stated errors have room for.

use std::collections::HashMap;

use super::parse::{Moments, TreeBlob};
use super::proof::TreeProof;
use crate::check::vector::{cross, dot};

type Point = [f64; 3];

/// A triangle's corners, and their numbers.
type Numbered = ([Point; 3], [u32; 3]);

/// Each node's moments against its triangles, whose corners have these numbers.
pub(super) fn moments(
    tree: &TreeBlob,
    corners: &[[u32; 3]],
    proof: &mut TreeProof,
) -> Result<(), String> {
    for (index, stored) in tree.moments.iter().enumerate() {
        let triangles = below(tree, corners, index);
        check(stored, &triangles, tree.surface_error / 2f64.powi(tree.grid_exponent))
            .map_err(|what| format!("moments of node {index}: {what}"))?;
        proof.moments += 1;
    }
    Ok(())
}

/// The triangles below a node, without those that stand for segments and points: a number repeats.
fn below(tree: &TreeBlob, corners: &[[u32; 3]], index: usize) -> Vec<Numbered> {
    let (mut open, mut found) = (vec![index], Vec::new());
    while let Some(node) = open.pop() {
        let node = &tree.nodes[node];
        open.extend(node.nodes.clone());
        for leaf in &tree.leaves[node.leaves.clone()] {
            let all = (0..leaf.triangles()).map(|t| {
                (leaf.corners(t).map(|v| leaf.vertices[v]), corners[leaf.first_triangle + t])
            });
            found.extend(all.filter(|(_, [a, b, c])| a != b && b != c && c != a));
        }
    }
    found
}

fn check(stored: &Moments, triangles: &[Numbered], moved: f64) -> Result<(), String> {
    let centre = stored.centre.map(f64::from);
    let (mut area, mut first, mut spread) = ([0.0; 3], [[0.0; 3]; 3], 0.0);
    let mut edges: HashMap<[u32; 2], (f64, f64)> = HashMap::new();
    for (corners, numbers) in triangles {
        let about = corners.map(|v| [0, 1, 2].map(|k| v[k] - centre[k]));
        if about.iter().any(|v| dot(v, v).sqrt() > f64::from(stored.radius)) {
            return Err("a corner is outside of the ball".into());
        }
        let [a, b, c] = about;
        let edge = |from: Point, to: Point| [0, 1, 2].map(|k| to[k] - from[k]);
        let normal = cross(&edge(a, b), &edge(a, c)).map(|x| 0.5 * x);
        let own = dot(&normal, &normal).sqrt();
        // Quadrature by the middles of the edges is exact for squares.
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let middle = [0, 1, 2].map(|k| 0.5 * (from[k] + to[k]));
            spread += own * dot(&middle, &middle);
            for i in 0..3 {
                for j in 0..3 {
                    first[i][j] += middle[i] * normal[j] / 3.0;
                }
            }
        }
        (0..3).for_each(|k| area[k] += normal[k]);
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let [low, high] = [numbers[from], numbers[to]];
            let (ends, sign) = if low < high { ([low, high], 1.0) } else { ([high, low], -1.0) };
            let way = edge(corners[from], corners[to]);
            let slot = edges.entry(ends).or_insert((0.0, dot(&way, &way).sqrt()));
            slot.0 += sign;
        }
    }
    // The header's error was rounded up to f32.
    let longer = 2.0 * moved * (1.0 - f64::from(f32::EPSILON));
    let boundary: f64 = edges.values().map(|(net, length)| net.abs() * (length + longer)).sum();
    if f64::from(stored.boundary) < boundary {
        return Err(format!("a boundary of {boundary} is stored as {}", stored.boundary));
    }
    if f64::from(stored.spread) < spread {
        return Err(format!("a spread of {spread} is stored as {}", stored.spread));
    }
    let third = (first[0][0] + first[1][1] + first[2][2]) / 3.0;
    let [xx, xy, xz, yy, yz] = stored.first.map(f64::from);
    let symmetric = [[xx, xy, xz], [xy, yy, yz], [xz, yz, -xx - yy]];
    let (mut off_first, mut off_area) = (0f64, 0f64);
    for i in 0..3 {
        for j in 0..3 {
            let wanted = 0.5 * (first[i][j] + first[j][i]) - if i == j { third } else { 0.0 };
            off_first += (wanted - symmetric[i][j]).powi(2);
        }
        off_area += (area[i] - f64::from(stored.area[i])).powi(2);
    }
    let radius = f64::from(stored.radius).max(f64::MIN_POSITIVE);
    let off = off_area.sqrt() + 3.0 * off_first.sqrt() / radius;
    if f64::from(stored.area_error) < off {
        return Err(format!("an error of {off} is stored as {}", stored.area_error));
    }
    Ok(())
}
