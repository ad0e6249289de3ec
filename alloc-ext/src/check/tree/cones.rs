//! Whether the normals of every leaf lie in its cone, in exact arithmetic.

use super::parse::{Leaf, TreeBlob};
use super::proof::TreeProof;
use crate::check::dyadic::Dyadic;
use crate::check::vector::{cross, dot, minus};

/// The normal of every triangle with an area makes an acute angle with its leaf's axis, whose sine
/// is at most the stored one.
pub(super) fn cones(tree: &TreeBlob, proof: &mut TreeProof) -> Result<(), String> {
    for (index, (leaf, &(axis, sine))) in tree.leaves.iter().zip(&tree.cones).enumerate() {
        if sine == 255 || axis == [0; 3] {
            continue;
        }
        for triangle in 0..leaf.triangles() {
            if !contains(leaf, triangle, axis, sine) {
                return Err(format!("the normal cone of leaf {index} leaves out a normal"));
            }
        }
        proof.cones += 1;
    }
    Ok(())
}

fn contains(leaf: &Leaf, triangle: usize, axis: [i8; 3], sine: u8) -> bool {
    let [a, b, c] = leaf.corners(triangle).map(|v| leaf.vertices[v].map(Dyadic::from));
    let normal = cross(&minus(&b, &a), &minus(&c, &a));
    if normal.iter().all(|x| x.sign() == 0) {
        return true;
    }
    let axis = axis.map(|x| Dyadic::from(f64::from(x)));
    let across = cross(&normal, &axis);
    let square = |x: f64| Dyadic::from(x * x);
    let least = &square(254.0) * &dot(&across, &across);
    let most = &square(f64::from(sine)) * &(&dot(&normal, &normal) * &dot(&axis, &axis));
    dot(&normal, &axis).sign() > 0 && least <= most
}
