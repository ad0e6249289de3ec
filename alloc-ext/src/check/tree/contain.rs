//! Whether boxes contain what is below them, and whether a distance to them is a lower bound.

use super::parse::{Boxes, Leaf, Slabs, TreeBlob};
use super::proof::TreeProof;
use crate::check::dyadic::{Dyadic, is_semidefinite};

/// For each node its parent and its place there; the root has none.
pub(super) fn parents(tree: &TreeBlob) -> Result<Vec<Option<(usize, usize)>>, String> {
    let mut parents = vec![None; tree.nodes.len()];
    for (index, node) in tree.nodes.iter().enumerate() {
        for (lane, child) in node.nodes.clone().enumerate() {
            let slot = parents.get_mut(child).ok_or(format!("node {index}: no node {child}"))?;
            if child <= index || slot.replace((index, lane)).is_some() {
                return Err(format!("node {child} has no single parent before it"));
            }
        }
    }
    match parents.iter().skip(1).position(Option::is_none) {
        Some(before) => Err(format!("node {} has no parent", before + 1)),
        None => Ok(parents),
    }
}

/// A descent leaves at most all children but one of every node on its way behind, and writes eight
/// at a time.
pub(super) fn stack(tree: &TreeBlob) -> Result<(), String> {
    let mut waiting = vec![0; tree.nodes.len()];
    let mut most = 0;
    for (index, node) in tree.nodes.iter().enumerate() {
        let left = waiting[index] + node.children() - 1;
        most = most.max(left);
        node.nodes.clone().for_each(|child| waiting[child] = left);
    }
    let needed = most + 8;
    if tree.stack_entries >= needed {
        Ok(())
    } else {
        Err(format!(
            "a descent needs {needed} stack entries, the header says {}",
            tree.stack_entries
        ))
    }
}

/// The matrix of every frame makes no vector longer, so that no distance to a box comes out too
/// great: the identity less the sum of the rows' outer products is positive semidefinite.
pub(super) fn frames(tree: &TreeBlob, proof: &mut TreeProof) -> Result<(), String> {
    for (index, frame) in tree.frames.iter().enumerate() {
        let rest = |i: usize, j: usize| {
            let one = if i == j { 1i64 << 26 } else { 0 };
            let product = |row: &[i16; 3]| i64::from(row[i]) * i64::from(row[j]);
            Dyadic::from((one - frame.rows.iter().map(product).sum::<i64>()) as f64)
        };
        let rest: [[Dyadic; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| rest(i, j)));
        if !is_semidefinite(&rest) {
            return Err(format!("frame {index} makes a distance longer"));
        }
        proof.frames += 1;
    }
    Ok(())
}

/// A node's boxes of either kind.
trait Contains {
    /// Whether child `lane` contains a point, up to rounding; `None` if that decides.
    fn about(&self, lane: usize, axis: usize, point: [f64; 3]) -> Option<bool>;

    /// The same in exact arithmetic.
    fn exactly(&self, lane: usize, axis: usize, point: [f64; 3]) -> bool;
}

/// Twice what four roundings come to.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Whether a number that may be off by `doubt` lies between two that are exact.
fn between(value: f64, doubt: f64, [low, high]: [f64; 2]) -> Option<bool> {
    if value - doubt >= low && value + doubt <= high {
        Some(true)
    } else if value + doubt < low || value - doubt > high {
        Some(false)
    } else {
        None
    }
}

fn ends(bounds: [u8; 2]) -> [f64; 2] {
    bounds.map(|byte| f64::from(byte) - 128.0)
}

/// Units of a frame's matrix.
const ROWS: f64 = 8192.0;

impl Boxes {
    /// Both planes of a child along an axis, in units of the products of matrix and coordinates.
    fn planes(&self, lane: usize, axis: usize) -> [f64; 2] {
        ends(self.bounds[lane][axis]).map(|end| end * self.step[axis] * ROWS)
    }
}

impl Contains for Boxes {
    fn about(&self, lane: usize, axis: usize, point: [f64; 3]) -> Option<bool> {
        let terms: [f64; 3] =
            std::array::from_fn(|k| f64::from(self.rows[axis][k]) * (point[k] - self.origin[k]));
        let doubt = ROUNDING * terms.iter().map(|term| term.abs()).sum::<f64>();
        between(terms.iter().sum(), doubt, self.planes(lane, axis))
    }

    fn exactly(&self, lane: usize, axis: usize, point: [f64; 3]) -> bool {
        let value = (0..3).fold(Dyadic::from(0.0), |sum, k| {
            let way = &Dyadic::from(point[k]) - &Dyadic::from(self.origin[k]);
            &sum + &(&Dyadic::from(f64::from(self.rows[axis][k])) * &way)
        });
        let [low, high] = self.planes(lane, axis).map(Dyadic::from);
        low <= value && value <= high
    }
}

impl Contains for Slabs {
    fn about(&self, lane: usize, axis: usize, point: [f64; 3]) -> Option<bool> {
        let way = point[axis] - f64::from(self.origin[axis]);
        // A byte times an f32 has 32 bits.
        let ends = ends(self.bounds[lane][axis]).map(|end| end * f64::from(self.step[axis]));
        between(way, ROUNDING * way.abs(), ends)
    }

    fn exactly(&self, lane: usize, axis: usize, point: [f64; 3]) -> bool {
        let way = &Dyadic::from(point[axis]) - &Dyadic::from(f64::from(self.origin[axis]));
        let step = Dyadic::from(f64::from(self.step[axis]));
        let [low, high] = ends(self.bounds[lane][axis]).map(|end| &Dyadic::from(end) * &step);
        low <= way && way <= high
    }
}

fn contains(boxes: &impl Contains, lane: usize, leaf: &Leaf, proof: &mut TreeProof) -> bool {
    leaf.vertices.iter().all(|&vertex| {
        (0..3).all(|axis| {
            proof.contained += 1;
            boxes.about(lane, axis, vertex).unwrap_or_else(|| {
                proof.exact_contained += 1;
                boxes.exactly(lane, axis, vertex)
            })
        })
    })
}

/// Every box contains the vertices, and so the triangles, of all leaves below it; and the header's
/// box all of them.
pub(super) fn boxes(
    tree: &TreeBlob,
    parents: &[Option<(usize, usize)>],
    proof: &mut TreeProof,
) -> Result<(), String> {
    for (index, node) in tree.nodes.iter().enumerate() {
        for (place, leaf) in tree.leaves[node.leaves.clone()].iter().enumerate() {
            let mut above = Some((index, node.nodes.len() + place));
            while let Some((node, lane)) = above {
                if tree.frames.get(node).is_some_and(|frame| !contains(frame, lane, leaf, proof)) {
                    return Err(format!("box {lane} of node {node} leaves out a vertex below it"));
                }
                if tree.slabs.get(node).is_some_and(|slabs| !contains(slabs, lane, leaf, proof)) {
                    return Err(format!(
                        "axis-aligned box {lane} of node {node} leaves out a vertex below it"
                    ));
                }
                above = parents[node];
            }
        }
    }
    let [low, high] = tree.bounds;
    let mut vertices = tree.leaves.iter().flat_map(|leaf| &leaf.vertices);
    if vertices.any(|v| (0..3).any(|k| v[k] < low[k] || v[k] > high[k])) {
        return Err("the header's box leaves out a vertex".into());
    }
    let step = 2f64.powi(tree.grid_exponent);
    if let Some([low, high]) = tree.surface_box
        && tree
            .leaves
            .iter()
            .flat_map(|leaf| &leaf.vertices)
            .any(|v| (0..3).any(|k| !(low[k]..=high[k]).contains(&(v[k] * step))))
    {
        return Err("the blob's box of the surface leaves out a vertex".into());
    }
    Ok(())
}
