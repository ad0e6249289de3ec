//! Proof that a hull encloses a mesh, from the two surfaces alone.
//!
//! If [`check_enclosure`] returns `Ok`, then in exact arithmetic on their coordinates
//! 1. the hull is a closed manifold, and its faces have no point in common but the corners and
//!    edges that they share;
//! 2. no face of the hull touches or crosses a triangle of the mesh;
//! 3. the hull winds exactly once around every vertex of the mesh.
//!
//! By the second, a triangle of the mesh is inside as a whole if one vertex is. The mesh may be
//! anything: it is taken as loose triangles.
//!
//! With a margin above 0, [`check_margin`] proves moreover that
//! 4. no point of the hull is as near to the mesh as the margin, or nearer.
//!
//! So every point within the margin of the mesh is inside: the way to it from the mesh is no longer
//! than the margin and does not meet the hull.

mod contact;
mod distance;
mod fronts;
mod meeting;
mod surface;
mod winding;

use super::manifold::Manifold;
pub(crate) use distance::point_is_far;
pub(crate) use fronts::{as_filed, check_fronts};
pub(crate) use meeting::area_free;
use meeting::{apart, sharing_apart};
pub(crate) use surface::Corners;
pub use surface::Surface;
pub use winding::Winding;

/// What was proved, in numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EnclosureProof {
    /// Faces of the hull.
    pub faces: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Vertices of the mesh that the hull was found to wind around once.
    pub inside: usize,
    /// Pairs of a face and a triangle, or of two faces, whose boxes overlap and that were found to
    /// be apart.
    pub pairs: usize,
}

/// Proves it of two surfaces, with a margin in their unit; `pairs` counts those that are nearer
/// than that in each coordinate.
///
/// # Errors
/// What does not hold, in words.
pub fn check_margin(mesh: &Surface, hull: &Surface, margin: f64) -> Result<EnclosureProof, String> {
    let mut proof = check_enclosure(mesh, hull)?;
    if !(margin >= 0.0 && margin.is_finite()) {
        return Err(format!("{margin} is no margin"));
    }
    if margin > 0.0 {
        let triangles: Vec<_> = mesh.triangles.iter().map(|&t| mesh.corners(t)).collect();
        let faces: Vec<_> = hull.triangles.iter().map(|&t| hull.corners(t)).collect();
        let exact = distance::Margin::new(margin);
        for (t, f) in near(&triangles, &faces, margin) {
            proof.pairs += 1;
            let apart = distance::is_beyond(&triangles[t], &faces[f], margin)
                || exact.is_kept(&triangles[t], &faces[f]);
            if !apart {
                return Err(format!(
                    "face {f} of the hull is not farther than {margin:e} from triangle {t} of the \
                     mesh"
                ));
            }
        }
    }
    Ok(proof)
}

/// Proves it.
///
/// # Errors
/// What does not hold, in words.
pub fn check_enclosure(mesh: &Surface, hull: &Surface) -> Result<EnclosureProof, String> {
    let mut proof = EnclosureProof {
        faces: hull.triangles.len(),
        triangles: mesh.triangles.len(),
        ..EnclosureProof::default()
    };
    if hull.triangles.is_empty() {
        return Err("the hull has no faces".into());
    }
    let mut connectivity = Manifold::default();
    for &face in &hull.triangles {
        connectivity.add(face)?;
    }
    connectivity.closed_manifold()?;
    proof.pairs += embedded(hull)?;
    proof.pairs += clear_of(mesh, hull)?;
    let winding = Winding::new(hull);
    let mut used = vec![false; mesh.positions.len()];
    mesh.triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
    for (v, &p) in mesh.positions.iter().enumerate().filter(|(v, _)| used[*v]) {
        let turns = winding.around(p)?;
        if turns != 1 {
            return Err(format!(
                "the hull winds {turns} times around vertex {v} of the mesh, {p:?}"
            ));
        }
        proof.inside += 1;
    }
    Ok(proof)
}

/// No two faces meet but where they share corners; how many pairs had to be looked at.
fn embedded(hull: &Surface) -> Result<usize, String> {
    let faces: Vec<_> = hull.triangles.iter().map(|&t| hull.corners(t)).collect();
    if let Some(face) = faces.iter().position(area_free) {
        return Err(format!("face {face} of the hull has no area"));
    }
    let mut pairs = 0;
    for (i, j) in overlapping(&faces, &faces).into_iter().filter(|(i, j)| i < j) {
        pairs += 1;
        if !sharing_apart(&faces[i], hull.triangles[i], &faces[j], hull.triangles[j]) {
            return Err(format!("faces {i} and {j} of the hull meet"));
        }
    }
    Ok(pairs)
}

/// No face meets a triangle; how many pairs had to be looked at.
fn clear_of(mesh: &Surface, hull: &Surface) -> Result<usize, String> {
    let triangles: Vec<_> = mesh.triangles.iter().map(|&t| mesh.corners(t)).collect();
    let faces: Vec<_> = hull.triangles.iter().map(|&t| hull.corners(t)).collect();
    let pairs = overlapping(&triangles, &faces);
    for &(t, f) in &pairs {
        if !apart(&triangles[t], &faces[f]) {
            return Err(format!("face {f} of the hull meets triangle {t} of the mesh"));
        }
    }
    Ok(pairs.len())
}

/// Pairs whose boxes overlap or touch.
fn overlapping(first: &[Corners], second: &[Corners]) -> Vec<(usize, usize)> {
    near(first, second, 0.0)
}

/// Pairs whose boxes, the first being larger by a margin on all sides, overlap or touch: a sweep
/// along x.
fn near(first: &[Corners], second: &[Corners], margin: f64) -> Vec<(usize, usize)> {
    let bounds = |t: &Corners| {
        let pick = |k: usize, least: fn(f64, f64) -> f64| least(least(t[0][k], t[1][k]), t[2][k]);
        ([0, 1, 2].map(|k| pick(k, f64::min)), [0, 1, 2].map(|k| pick(k, f64::max)))
    };
    let mut boxes = [first, second].map(|all| all.iter().map(bounds).collect::<Vec<_>>());
    if margin > 0.0 {
        for (low, high) in &mut boxes[0] {
            // Rounding is undone by one step.
            *low = low.map(|x| (x - margin).next_down());
            *high = high.map(|x| (x + margin).next_up());
        }
    }
    let mut starts: Vec<(f64, usize, usize)> = Vec::new();
    for (side, all) in boxes.iter().enumerate() {
        starts.extend(all.iter().enumerate().map(|(i, (low, _))| (low[0], side, i)));
    }
    starts.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut open: [Vec<usize>; 2] = [Vec::new(), Vec::new()];
    let mut pairs = Vec::new();
    for (x, side, i) in starts {
        let (low, high) = boxes[side][i];
        let other = 1 - side;
        open[other].retain(|&j| boxes[other][j].1[0] >= x);
        for &j in &open[other] {
            let (l, h) = boxes[other][j];
            if (1..3).all(|k| low[k] <= h[k] && l[k] <= high[k]) {
                pairs.push(if side == 0 { (i, j) } else { (j, i) });
            }
        }
        open[side].push(i);
    }
    pairs
}
