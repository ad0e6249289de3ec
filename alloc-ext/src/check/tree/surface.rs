//! Whether the leaves hold the input's triangles, and as near to where they were as the header
//! says.

use super::chosen::Chosen;
use super::parse::TreeBlob;
use super::proof::TreeProof;
use crate::check::enclosure::{Surface, check_fronts};
use crate::check::input::{Given, Stored};
use crate::mesh::Mesh;

/// Every triangle of the mesh, and every wire as one, is stored exactly once, with its number, its
/// winding, and its corners within the surface error. Returns the mesh's vertices at the corners of
/// all stored triangles.
pub(super) fn triangles(
    tree: &TreeBlob,
    given: &Given<'_>,
    stored: impl Iterator<Item = Stored>,
    proof: &mut TreeProof,
) -> Result<Vec<[u32; 3]>, String> {
    let count = given.mesh.all_triangles().count();
    if tree.source.len() != count {
        return Err(format!("{} triangles of {count}", tree.source.len()));
    }
    if let Some(number) = tree.source.iter().find(|&&number| number >= tree.input_triangles) {
        return Err(format!("triangle {number} of an input of {}", tree.input_triangles));
    }
    let wanted = given.mesh.all_triangles().zip(given.mesh.all_sources());
    let (found, exact) = given.find(wanted, stored, tree.surface_error, false)?;
    proof.triangles += found.len();
    proof.exact_corners += exact;
    Ok(found)
}

/// The header's star radius is no less than any triangle's two spokes, by their 1-norms.
pub(super) fn star_radius(tree: &TreeBlob) -> Result<(), String> {
    let norm = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).abs()).sum::<f64>();
    for leaf in &tree.leaves {
        for triangle in 0..leaf.triangles() {
            let [centre, a, b] = leaf.corners(triangle).map(|corner| leaf.vertices[corner]);
            // Differences of coordinates below 2^25, and sums of six of them.
            let star_radius = norm(centre, a) + norm(centre, b);
            if star_radius > tree.star_radius {
                return Err(format!(
                    "a triangle of star radius {star_radius:e}, the header says {:e}",
                    tree.star_radius
                ));
            }
        }
    }
    Ok(())
}

/// The header's flag says whether the triangles are closed, and it promises sides only of triangles
/// that may have them.
pub(super) fn closed(tree: &TreeBlob, chosen: &Chosen<'_>) -> Result<(), String> {
    if chosen.closed != tree.closed {
        return Err(format!("closed: {}, the header says {}", chosen.closed, tree.closed));
    }
    if tree.closed && !tree.sides_lost && !chosen.has_sides {
        return Err("sides are promised of triangles that repair changed".to_owned());
    }
    Ok(())
}

/// Without frames no question about sides is served.
fn promises_sides(tree: &TreeBlob) -> bool {
    tree.closed && !tree.sides_lost && !tree.frames.is_empty()
}

/// If sides are promised, the tree's triangles as its bits turn them are those of the mesh in the
/// winding that tells sides.
pub(super) fn turned<'a>(
    tree: &TreeBlob,
    chosen: &Chosen<'a>,
    given: impl Fn(&'a Mesh) -> Given<'a>,
) -> Result<(), String> {
    match chosen.turned {
        Some(mesh) if promises_sides(tree) => {
            let stored = tree.triangles().zip(&tree.turned);
            let stored = stored
                .map(|((number, [a, b, c]), &is)| (number, if is { [a, c, b] } else { [a, b, c] }));
            triangles(tree, &given(mesh), stored, &mut TreeProof::default()).map(drop)
        }
        _ if tree.turned.contains(&true) => {
            Err("triangles are turned for sides that the mesh has not".to_owned())
        }
        _ => Ok(()),
    }
}

/// If the header promises sides, the stored surface winds 0 times around all places in front of the
/// triangles that tell sides. `corners` are the mesh's vertices at the corners of the stored
/// triangles.
pub(super) fn sides(tree: &TreeBlob, corners: &[[u32; 3]]) -> Result<(), String> {
    if !promises_sides(tree) {
        return Ok(());
    }
    // Where the error is larger than triangles, a vertex may be taken for its neighbour. Then
    // corners at one place are one vertex.
    let result = fronts(tree, corners);
    match result {
        Err(Fronts::Places(_)) => {
            let welded = Surface::welded(tree.triangles().map(|(_, at)| at)).triangles;
            fronts(tree, &welded)
        }
        result => result,
    }
    .map_err(|why| match why {
        Fronts::Places(why) | Fronts::Sides(why) => format!("sides are promised, but {why}"),
    })
}

/// Why fronts are not proved.
enum Fronts {
    /// A vertex is at two places.
    Places(String),
    /// The surface is another.
    Sides(String),
}

/// The fronts of the stored triangles, whose corners have these numbers.
fn fronts(tree: &TreeBlob, corners: &[[u32; 3]]) -> Result<(), Fronts> {
    let (mut surface, mut turned, mut sideless) = (Surface::default(), Vec::new(), Vec::new());
    let bits = tree.turned.iter().zip(&tree.sideless);
    for (((_, at), ids), (&is_turned, &is_sideless)) in tree.triangles().zip(corners).zip(bits) {
        // A wire repeats a vertex, and bounds nothing.
        if ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0] {
            continue;
        }
        for (&id, p) in ids.iter().zip(at) {
            if surface.positions.len() <= id as usize {
                surface.positions.resize(id as usize + 1, [f64::NAN; 3]);
            }
            let place = &mut surface.positions[id as usize];
            if place[0].is_nan() {
                *place = p;
            } else if *place != p {
                let why = format!("vertex {id} is stored at {place:?} and at {p:?}");
                return Err(Fronts::Places(why));
            }
        }
        let [a, b, c] = *ids;
        surface.triangles.push(if is_turned { [a, c, b] } else { *ids });
        turned.push(is_turned);
        sideless.push(is_sideless);
    }
    check_fronts(&surface, &turned, &sideless).map_err(Fronts::Sides)
}
