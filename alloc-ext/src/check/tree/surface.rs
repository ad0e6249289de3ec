//! Whether the leaves hold the input's triangles, and as near to where they were as the header
//! says.

use crate::mesh::Mesh;

use super::parse::TreeBlob;
use super::proof::TreeProof;
use crate::check::dyadic::Dyadic;

/// Every triangle of the mesh, and every wire as one, is stored exactly once, with its number, its
/// winding, and its corners within the surface error.
///
/// Triangles that share a number, which a repaired mesh may have, are told apart by their corners.
pub(super) fn triangles(tree: &TreeBlob, mesh: &Mesh, proof: &mut TreeProof) -> Result<(), String> {
    let all: Vec<[u32; 3]> = mesh.all_triangles().collect();
    if tree.source.len() != all.len() {
        return Err(format!("{} triangles of {}", tree.source.len(), all.len()));
    }
    if let Some(number) = tree.source.iter().find(|&&number| number >= tree.input_triangles) {
        return Err(format!("triangle {number} of an input of {}", tree.input_triangles));
    }
    let mut wanted: Vec<(u32, usize)> = mesh.all_sources().zip(0..).collect();
    wanted.sort_unstable();
    let mut used = vec![false; wanted.len()];
    let near = Near::new(tree, mesh);
    for leaf in &tree.leaves {
        for triangle in 0..leaf.triangles() {
            let number = tree.source[leaf.first_triangle + triangle];
            let stored = leaf.corners(triangle).map(|corner| leaf.vertices[corner]);
            let from = wanted.partition_point(|&(source, _)| source < number);
            let candidates = wanted
                .iter()
                .enumerate()
                .skip(from)
                .take_while(|(_, (source, _))| *source == number);
            let free = candidates.filter(|&(place, _)| !used[place]);
            let mut found = None;
            for (place, &(_, input)) in free {
                if near.matches(stored, all[input], proof) {
                    found = Some(place);
                    break;
                }
            }
            used[found.ok_or(format!("the triangle stored as {number} is not the input's"))?] =
                true;
            proof.triangles += 1;
        }
    }
    Ok(())
}

/// What "as near as the header says" is for a vertex.
struct Near<'a> {
    mesh: &'a Mesh,
    /// Local coordinate = input coordinate times this.
    scale: f64,
    /// Local coordinate = grid coordinate times this.
    step: f64,
    surface_error: f64,
    /// What vertices moved before the tree was built.
    rounding: f64,
}

impl<'a> Near<'a> {
    fn new(tree: &TreeBlob, mesh: &'a Mesh) -> Self {
        let scale = 2f64.powi(-tree.scale_exponent);
        Self {
            mesh,
            scale,
            step: 2f64.powi(tree.grid_exponent),
            surface_error: tree.surface_error,
            rounding: mesh.rounding * scale,
        }
    }

    /// Whether stored corners, grid units, are those of an input triangle, beginning with any of
    /// them.
    fn matches(&self, stored: [[f64; 3]; 3], input: [u32; 3], proof: &mut TreeProof) -> bool {
        let there = input.map(|v| self.mesh.positions[v as usize].map(f64::from));
        (0..3).any(|turn| (0..3).all(|k| self.is_near(stored[k], there[(k + turn) % 3], proof)))
    }

    /// All factors are powers of two, so only the difference and its square are rounded.
    fn is_near(&self, stored: [f64; 3], there: [f64; 3], proof: &mut TreeProof) -> bool {
        let (stored, there) = (stored.map(|x| x * self.step), there.map(|x| x * self.scale));
        let allowed = self.surface_error - self.rounding;
        let square: f64 = (0..3).map(|k| (stored[k] - there[k]) * (stored[k] - there[k])).sum();
        let limit = allowed * allowed;
        if allowed > 0.0 && square < limit * (1.0 - 1e-14) {
            return true;
        }
        if square > limit * (1.0 + 1e-14) {
            return false;
        }
        proof.exact_corners += 1;
        let allowed = &Dyadic::from(self.surface_error) - &Dyadic::from(self.rounding);
        let square = (0..3).fold(Dyadic::from(0.0), |sum, k| {
            let way = &Dyadic::from(stored[k]) - &Dyadic::from(there[k]);
            &sum + &(&way * &way)
        });
        allowed.sign() >= 0 && square <= &allowed * &allowed
    }
}

/// The header's reach is no less than any triangle's two spokes, by their 1-norms, and its flag
/// says whether the mesh is closed.
pub(super) fn claims(tree: &TreeBlob, mesh: &Mesh) -> Result<(), String> {
    let norm = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).abs()).sum::<f64>();
    for leaf in &tree.leaves {
        for triangle in 0..leaf.triangles() {
            let [centre, a, b] = leaf.corners(triangle).map(|corner| leaf.vertices[corner]);
            // Differences of coordinates below 2^25, and sums of six of them.
            let reach = norm(centre, a) + norm(centre, b);
            if reach > tree.reach {
                return Err(format!(
                    "a triangle of reach {reach:e}, the header says {:e}",
                    tree.reach
                ));
            }
        }
    }
    let mut edges: Vec<(u32, u32, i32)> = Vec::with_capacity(3 * mesh.triangles.len());
    for corners in &mesh.triangles {
        for k in 0..3 {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            edges.push((from.min(to), from.max(to), if from < to { 1 } else { -1 }));
        }
    }
    edges.sort_unstable();
    let balanced = |edge: &[(u32, u32, i32)]| edge.iter().map(|(_, _, way)| way).sum::<i32>() == 0;
    let closed = !edges.is_empty() && edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).all(balanced);
    if closed == tree.closed {
        Ok(())
    } else {
        Err(format!("closed: {closed}, the header says {}", tree.closed))
    }
}
