//! Where a node of a COLLADA scene is in its parent.

use super::super::MeshError;
use super::super::document::Document;
use super::super::placement::Placement;

/// How far the last row of an affine matrix may be off, where a program multiplied matrices.
const NOISE: f64 = 1e-6;

/// Whether a node has a transform that is not read.
pub(super) fn is_unread(document: &Document<'_>, node: usize) -> bool {
    ["lookat", "skew"].iter().any(|name| document.child(node, name).is_some())
}

/// The transforms of a node, the first outermost.
pub(super) fn placement(document: &Document<'_>, node: usize) -> Result<Placement, MeshError> {
    let mut all = Placement::IDENTITY;
    for &child in &document.nodes[node].children {
        let one = match document.nodes[child].name.as_str() {
            "matrix" => {
                let m: [f64; 16] = document.exactly(child)?;
                let (rows, _) = m.as_chunks::<4>();
                let last = [m[12], m[13], m[14], m[15] - 1.0];
                if last.iter().any(|x| x.abs() > NOISE) {
                    return Err(document.malformed(child, "its last row is not 0 0 0 1"));
                }
                Placement::of_rows([rows[0], rows[1], rows[2]])
            }
            "translate" => {
                let [x, y, z] = document.exactly(child)?;
                Placement::of_rows([[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z]])
            }
            "scale" => {
                let [x, y, z] = document.exactly(child)?;
                Placement::of_rows([[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0]])
            }
            "rotate" => {
                let [x, y, z, degrees] = document.exactly(child)?;
                match Placement::of_rotation([x, y, z], degrees) {
                    Some(rotation) => rotation,
                    None => return Err(document.malformed(child, "its axis has no length")),
                }
            }
            name @ ("lookat" | "skew") => {
                return Err(document.unsupported(child, &format!("the transform {name}")));
            }
            _ => continue,
        };
        all = all.after(&one);
    }
    Ok(all)
}
