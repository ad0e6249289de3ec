//! Proof of tight hulls from the blob's bytes and the mesh: each encloses the mesh, and its
//! distances from the mesh are those that it states.

use super::bytes::{Cursor, section};
use super::enclosure::{Surface, check_enclosure, check_margin};
use super::file::FileSurface;
use super::finding::Finding;
use super::near::{Near, Verdict};
use super::tree::prove_faces;
use crate::mesh::{Input, Mesh, RawMesh};
use glam::DVec3;

const TIGHT: &str = "tight hulls";

/// A stored hull.
struct Hull {
    /// In the local frame of its own blob.
    surface: Surface,
    /// Input coordinate = local coordinate × 2^this.
    scale_exponent: i32,
    /// Claimed upper bounds, local frame of its blob: of each face from the mesh, of all faces from
    /// the mesh, of the mesh from the hull.
    slacks: Vec<f64>,
    slack: f64,
    depth: f64,
    void_ratio: f64,
    /// What the mesh may have moved before, local frame of its blob.
    surface_error: f64,
}

fn hulls(bytes: &[u8]) -> Result<Vec<Hull>, String> {
    let body = section(bytes, 20, TIGHT)?;
    let mut cursor = Cursor(body, TIGHT);
    let (count, _) = (cursor.uint(4)?, cursor.uint(4)?);
    let mut hulls: Vec<Hull> = Vec::new();
    for index in 0..count {
        let [start, length, faces] = [cursor.uint(4)?, cursor.uint(4)?, cursor.uint(4)?];
        let [slack, depth, void_ratio] = [cursor.float()?, cursor.float()?, cursor.float()?];
        let (start, length, faces) = (start as usize, length as usize, faces as usize);
        let at = |from: usize, length: usize| {
            body.get(from..from + length).ok_or(format!("hull {index} leaves the section"))
        };
        let tree = prove_faces(at(start, length)?).map_err(|e| format!("hull {index}: {e}"))?;
        let mut triangles = tree.triangles;
        triangles.sort_unstable_by_key(|(number, _)| *number);
        if !triangles.iter().map(|(number, _)| *number).eq(0..faces as u32) {
            return Err(format!("hull {index}: its faces are not numbered from 0 to {faces}"));
        }
        if hulls.last().is_some_and(|last| last.surface.triangles.len() >= faces) {
            return Err(format!("hull {index} has no more faces than the one before"));
        }
        let local = 2f64.powi(-tree.scale_exponent);
        let radius = |record: &[u8]| {
            let bits = u32::from(record[0]) << 16 | u32::from(record[1]) << 24;
            f64::from(f32::from_bits(bits)) * local
        };
        hulls.push(Hull {
            surface: Surface::welded(triangles.into_iter().map(|(_, corners)| corners)),
            scale_exponent: tree.scale_exponent,
            slacks: at(start + length, 2 * faces)?.chunks_exact(2).map(radius).collect(),
            slack: f64::from(slack) * local,
            depth: f64::from(depth) * local,
            void_ratio: f64::from(void_ratio),
            surface_error: tree.surface_error,
        });
    }
    Ok(hulls)
}

fn places(surface: &Surface) -> Vec<[DVec3; 3]> {
    let at = |v: u32| DVec3::from(surface.positions[v as usize]);
    surface.triangles.iter().map(|t| t.map(at)).collect()
}

/// Six times the signed volume.
fn volume(triangles: &[[DVec3; 3]]) -> f64 {
    let origin = triangles.first().map_or(DVec3::ZERO, |t| t[0]);
    let of = |t: &[DVec3; 3]| {
        let [a, b, c] = t.map(|p| p - origin);
        a.dot(b.cross(c))
    };
    triangles.iter().map(of).sum()
}

/// Largest relative error of a stored void: it is an f32, of a quotient of sums.
const VOID: f64 = 1e-5;

/// Proves all but the distances. Returns pairs of triangles that were found to be apart.
fn encloses(hull: &Hull, mesh: &Surface, input: Input<'_>) -> Result<usize, String> {
    let local = 2f64.powi(-hull.scale_exponent);
    let moved = (input.mesh.rounding + input.moved) * local;
    if hull.surface_error < moved {
        return Err(format!(
            "the mesh moved by {moved:e} when it was read, its surface error is {:e}",
            hull.surface_error
        ));
    }
    let pairs = check_enclosure(mesh, &hull.surface)?.pairs;
    let inner: Vec<[DVec3; 3]> = places(mesh).drain(..input.mesh.triangles.len()).collect();
    let void = volume(&places(&hull.surface)) / volume(&inner) - 1.0;
    if hull.void_ratio != 0.0 && (void - hull.void_ratio).abs() > VOID * (1.0 + void.abs()) {
        return Err(format!("its void is {void:e}, its record says {:e}", hull.void_ratio));
    }
    Ok(pairs)
}

/// Proves that no face is farther from the mesh, and no triangle of the mesh farther from the hull,
/// than stated. Returns whether all could be decided.
fn distances(hull: &Hull, mesh: &Surface) -> Result<bool, String> {
    let (faces, triangles) = (places(&hull.surface), places(mesh));
    let (outer, inner) = (Near::new(faces.clone()), Near::new(triangles.clone()));
    let mut is_decided = true;
    let slacks = hull.slacks.iter().map(|slack| slack.min(hull.slack));
    let outward = faces.iter().zip(slacks).map(|(&face, slack)| (&inner, face, slack, "face"));
    let inward = triangles.iter().map(|&triangle| (&outer, triangle, hull.depth, "triangle"));
    for (index, (to, triangle, limit, what)) in
        (0..faces.len()).chain(0..triangles.len()).zip(outward.chain(inward))
    {
        match to.within(triangle, limit) {
            Verdict::Within => {}
            Verdict::Undecided => is_decided = false,
            Verdict::Beyond(p, d) => {
                return Err(format!(
                    "{what} {index}: {p} is {d:e} away, {limit:e} is stated, local frame"
                ));
            }
        }
    }
    Ok(is_decided)
}

/// Proves a blob's tight hulls.
pub(crate) fn verify(bytes: &[u8], input: Input<'_>, out: &mut Vec<Finding>) {
    let hulls = match hulls(bytes) {
        Ok(hulls) => hulls,
        Err(error) => return out.push(Finding::failed(TIGHT, error)),
    };
    let (mut pairs, mut faces) = (0, 0);
    let mut undecided = Vec::new();
    for (index, hull) in hulls.iter().enumerate() {
        let mesh = in_frame(input.mesh, hull.scale_exponent);
        let proof = encloses(hull, &mesh, input)
            .and_then(|apart| Ok((apart, distances(hull, &mesh)?)))
            .map_err(|error| format!("hull {index}: {error}"));
        match proof {
            Ok((apart, is_decided)) => {
                pairs += apart;
                faces += hull.surface.triangles.len();
                if !is_decided {
                    undecided.push(index.to_string());
                }
            }
            Err(error) => return out.push(Finding::failed(TIGHT, error)),
        }
    }
    out.push(Finding::proved(
        TIGHT,
        "every hull is closed, winds once around every vertex of the mesh, and meets neither mesh \
         nor itself",
        &[("hull", hulls.len()), ("face", faces), ("disjoint pair", pairs)],
    ));
    out.push(if undecided.is_empty() {
        let words = "slacks and depths bound the distances between hulls and mesh";
        Finding::proved(TIGHT, words, &[("hull", hulls.len()), ("face", faces)])
    } else {
        let which = undecided.join(", ");
        Finding::not_proved(TIGHT, format!("slack and depth of hull {which}"))
    });
}

/// Proves that every hull encloses the file's triangles.
pub(super) fn verify_file(bytes: &[u8], raw: &RawMesh) -> Finding {
    let prove = || -> Result<[usize; 3], String> {
        let (hulls, mut pairs) = (hulls(bytes)?, 0);
        for (index, hull) in hulls.iter().enumerate() {
            let file = FileSurface::new(raw, hull.scale_exponent);
            let proof = check_margin(&file.surface, &hull.surface, file.error);
            pairs += proof.map_err(|error| format!("hull {index}: {error}, in the file"))?.pairs;
        }
        Ok([hulls.len(), raw.triangles.len(), pairs])
    };
    let words = "every hull encloses every triangle of the file, before rounding";
    match prove() {
        Ok([hulls, triangles, pairs]) => Finding::proved(
            TIGHT,
            words,
            &[("hull", hulls), ("triangle", triangles), ("disjoint pair", pairs)],
        ),
        Err(error) => Finding::failed(TIGHT, error),
    }
}

/// A mesh, its wires too, in a local frame.
fn in_frame(mesh: &Mesh, scale_exponent: i32) -> Surface {
    let scale = 2f64.powi(-scale_exponent);
    Surface {
        positions: mesh.positions.iter().map(|p| p.map(|x| f64::from(x) * scale)).collect(),
        triangles: mesh.all_triangles().collect(),
    }
}
