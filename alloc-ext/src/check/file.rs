//! The triangles of a file by its own numbers: before any vertex was rounded to `f32` or merged,
//! and before any triangle was dropped.
//!
//! Coordinates are those that the reader gives, in `f64`. What lies between them and the file (the
//! text's decimals, transforms, another unit) is a margin, which the proofs add.

use super::distance::{ABSOLUTE, ROUNDING};
use super::enclosure::Surface;
use super::finding::Finding;
use super::input::Stored;
use super::near::{Near, Verdict};
use crate::mesh::RawMesh;
use glam::DVec3;

/// The triangles of a file, in a local frame.
pub(super) struct FileSurface {
    pub(super) surface: Surface,
    /// Upper bound of the distance of any vertex from its place in the file, local frame.
    pub(super) error: f64,
}

impl FileSurface {
    /// In the frame whose unit is 2^`scale_exponent`.
    pub(super) fn new(raw: &RawMesh, scale_exponent: i32) -> Self {
        let scale = 2f64.powi(-scale_exponent);
        let positions = raw.positions.iter().map(|p| p.map(|x| x * scale)).collect();
        let surface = Surface { positions, triangles: raw.triangles.clone() };
        Self { surface, error: error(raw) * scale }
    }
}

/// A structure's triangles as they are stored.
pub(super) struct StoredSurface {
    /// In the local frame, with their numbers in the file.
    pub(super) triangles: Vec<Stored>,
    /// Input coordinate = local coordinate × 2^this.
    pub(super) scale_exponent: i32,
    /// Claimed Hausdorff distance of the file's triangles and these, local frame.
    pub(super) surface_error: f64,
}

impl StoredSurface {
    /// Proves that the file's triangles and the stored ones are no farther from each other than the
    /// surface error. A stored triangle whose corners are near those of its number in the file
    /// proves both ways. Others are compared with the whole surface.
    pub(super) fn verify(&self, structure: &'static str, raw: &RawMesh) -> Finding {
        match self.prove(raw) {
            Err(error) => Finding::failed(structure, error),
            Ok((_, undecided)) if undecided > 0 => Finding::not_proved(
                structure,
                format!("how far {undecided} triangles are from those of the file"),
            ),
            Ok((by_corners, _)) => Finding::proved(
                structure,
                "the surface error bounds the distance of the file's triangles, before rounding, \
                 and the stored ones",
                &[
                    ("triangle", raw.triangles.len()),
                    ("stored triangle", self.triangles.len()),
                    ("matching pair", by_corners),
                ],
            ),
        }
    }

    /// How many triangles their corners prove, and how many are undecided.
    fn prove(&self, raw: &RawMesh) -> Result<(usize, usize), String> {
        let file = FileSurface::new(raw, self.scale_exponent);
        let at = |v: u32| DVec3::from(file.surface.positions[v as usize]);
        let filed: Vec<[DVec3; 3]> =
            file.surface.triangles.iter().map(|corners| corners.map(at)).collect();
        let stored: Vec<[DVec3; 3]> =
            self.triangles.iter().map(|(_, corners)| corners.map(DVec3::from)).collect();
        let limit = (self.surface_error - file.error).max(0.0);
        let most = limit * ROUNDING + ABSOLUTE;
        let are_near = |a: &[DVec3; 3], b: &[DVec3; 3]| {
            let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
            orders.iter().any(|order| (0..3).all(|k| a[k].distance(b[order[k]]) <= most))
        };
        let (mut is_filed_near, mut others) = (vec![false; filed.len()], Vec::new());
        for (index, (number, _)) in self.triangles.iter().enumerate() {
            match filed.get(*number as usize) {
                Some(own) if are_near(&stored[index], own) => {
                    is_filed_near[*number as usize] = true
                }
                _ => others.push(index),
            }
        }
        let by_corners = stored.len() - others.len();
        let mut undecided = 0;
        let mut compare =
            |from: &[DVec3; 3], to: &Near, what: &str, number: u32| match to.within(*from, limit) {
                Verdict::Within => Ok(()),
                Verdict::Undecided => {
                    undecided += 1;
                    Ok(())
                }
                Verdict::Beyond(p, d) => Err(format!(
                    "{what} {number}: {p} is {d:e} away, a surface error of {:e} is stated, local \
                     frame",
                    self.surface_error
                )),
            };
        if is_filed_near.contains(&false) {
            let surface = Near::new(stored.clone());
            for (number, triangle) in filed.iter().enumerate().filter(|(k, _)| !is_filed_near[*k]) {
                compare(triangle, &surface, "from the file's triangle", number as u32)?;
            }
        }
        if !others.is_empty() {
            let surface = Near::new(filed);
            for index in others {
                let number = self.triangles[index].0;
                compare(&stored[index], &surface, "from the triangle stored as", number)?;
            }
        }
        Ok((by_corners, undecided))
    }
}

/// How far a vertex may be from its place in the file.
///
/// A decimal is off by half a unit in the last place on each axis. A decimal whose nearest `f64` is
/// an `f32` counts as that number, so a file of them alone has no error.
fn error(raw: &RawMesh) -> f64 {
    let coordinates = || raw.positions.iter().flatten().copied();
    let is_f32 = coordinates().all(|x| f64::from(x as f32) == x);
    if !raw.decimal || is_f32 {
        return raw.error;
    }
    let largest = coordinates().fold(0f64, |most, x| most.max(x.abs()));
    // √3 halves of 2^-52 are less than one. Below the normal numbers the unit is absolute.
    (raw.error + f64::EPSILON * largest + 2.0 * f64::from_bits(1)).next_up()
}
