//! Whether the mesh that a blob is proved of is that of its file: repair moved no vertex farther
//! than it says, lost no point, and told which triangles it wound anew.
//!
//! A blob is proved of a repaired mesh. So a wrong repair would prove itself, were it not proved
//! here from the file's own triangles.

mod cover;
mod place;
mod tiles;

use super::finding::Finding;
use super::input::is_within;
use crate::mesh::{Input, Mesh, RawMesh};
use cover::Edges;
use place::{Place, place};
use std::collections::HashMap;

/// What was counted on the way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RepairProof {
    /// Triangles of the file that the mesh has, in the file's winding or against it.
    pub kept: usize,
    /// Of these the ones that the mesh winds against the file.
    pub turned: usize,
    /// Triangles of the file that several of the mesh tile.
    pub tiled: usize,
    /// Further copies of a triangle, in either winding.
    pub copies: usize,
    /// Triangles without area whose points are those of others, or of a wire.
    pub flat: usize,
    /// How often integers had to decide whether a corner is near.
    pub exact: usize,
}

/// Proves that a repaired mesh is that of `raw`, the file as it was read.
///
/// Cost: linear in the triangles.
#[must_use]
pub fn verify_repair(raw: &RawMesh, input: Input<'_>) -> Finding {
    match prove_repair(raw, input) {
        Err(error) => Finding::failed("mesh", error),
        Ok(proof) => Finding::proved(
            "mesh",
            "every triangle of the file is in the mesh by its number, within the rounding, or is a \
             copy, or has no area and lies on others; the mesh says which triangles it turned",
            &[
                ("triangle", proof.kept),
                ("turned triangle", proof.turned),
                ("tiled triangle", proof.tiled),
                ("copy", proof.copies),
                ("triangle without area", proof.flat),
                ("exact comparison", proof.exact),
            ],
        ),
    }
}

/// The same with counts.
///
/// # Errors
/// The first claim that does not hold, in words.
pub fn prove_repair(raw: &RawMesh, input: Input<'_>) -> Result<RepairProof, String> {
    let mesh = input.mesh;
    let mut proof = RepairProof::default();
    let file = FileTriangles::new(raw, mesh)?;
    file.prove_places(raw, [mesh.rounding, input.moved], &mut proof)?;
    let of_file = file.of_file(mesh, &mut proof)?;
    file.prove_rest(mesh, &of_file, &mut proof)?;
    Ok(proof)
}

/// The file's triangles as the mesh remembers them.
struct FileTriangles<'a> {
    positions: &'a [[f32; 3]],
    triangles: &'a [[u32; 3]],
}

/// What the mesh has of one triangle of the file.
#[derive(Clone, Debug, PartialEq)]
enum Kept {
    Nothing,
    Itself,
    Tiles(Vec<u32>),
}

impl<'a> FileTriangles<'a> {
    fn new(raw: &RawMesh, mesh: &'a Mesh) -> Result<Self, String> {
        let count = raw.triangles.len();
        let file = match &mesh.filed {
            Some(filed) => Self { positions: &filed.positions, triangles: &filed.triangles },
            None => {
                let is_in_order = (0u32..).zip(&mesh.source).all(|(t, &source)| t == source);
                let is_as_filed = mesh.turned.is_empty() && mesh.wires.is_empty();
                if !is_in_order || !is_as_filed {
                    return Err("the mesh is not the file's, and does not say so".into());
                }
                Self { positions: &mesh.positions, triangles: &mesh.triangles }
            }
        };
        match file.triangles.len() {
            found if found == count => Ok(file),
            found => Err(format!("{found} triangles of the file's {count}")),
        }
    }

    fn corners(&self, triangle: usize) -> [[f32; 3]; 3] {
        self.triangles[triangle].map(|v| self.positions[v as usize])
    }

    fn places(&self, triangle: usize) -> [Place; 3] {
        self.corners(triangle).map(place)
    }

    /// Every corner is within the stated bounds of its place in the file, and no vertex stands for
    /// two places: a gap in the file stays one.
    fn prove_places(
        &self,
        raw: &RawMesh,
        [rounding, moved]: [f64; 2],
        proof: &mut RepairProof,
    ) -> Result<(), String> {
        let mut stands_for: Vec<Option<[f64; 3]>> = vec![None; self.positions.len()];
        for (t, (ids, of_file)) in self.triangles.iter().zip(&raw.triangles).enumerate() {
            for (&id, &v) in ids.iter().zip(of_file) {
                let there = raw.positions[v as usize].map(|x| x + 0.0);
                match stands_for[id as usize].replace(there) {
                    Some(before) if before == there => continue,
                    Some(before) => {
                        return Err(format!("one vertex stands for {before:?} and {there:?}"));
                    }
                    None => {}
                }
                let here = self.positions[id as usize].map(f64::from);
                if here != there
                    && !is_within(here, there, [rounding, moved, 0.0], &mut proof.exact)
                {
                    return Err(format!(
                        "a corner of triangle {t} is at {here:?}, in the file at {there:?}"
                    ));
                }
            }
        }
        Ok(())
    }

    /// What the mesh has of each triangle of the file, by its number.
    fn of_file(&self, mesh: &Mesh, proof: &mut RepairProof) -> Result<Vec<Kept>, String> {
        let mut kept = vec![Kept::Nothing; self.triangles.len()];
        for (t, &number) in mesh.source.iter().enumerate() {
            let corners = mesh.corners(t).ok_or(format!("triangle {t} has no corners"))?;
            let slot = kept
                .get_mut(number as usize)
                .ok_or(format!("a triangle has the number {number}, which the file lacks"))?;
            let is_turned = mesh.turned.get(t).copied().unwrap_or(false);
            match winding(self.places(number as usize), corners.map(place)) {
                Some(same) if *slot == Kept::Nothing => {
                    if same == is_turned {
                        return Err(format!(
                            "triangle {number} is not wound as the mesh says that it is"
                        ));
                    }
                    proof.kept += 1;
                    proof.turned += usize::from(is_turned);
                    *slot = Kept::Itself;
                }
                Some(_) => return Err(format!("triangle {number} is in the mesh twice")),
                None => match slot {
                    Kept::Itself => {
                        return Err(format!("triangle {number} is in the mesh, and a part of it"));
                    }
                    Kept::Nothing => *slot = Kept::Tiles(vec![t as u32]),
                    Kept::Tiles(tiles) => tiles.push(t as u32),
                },
            }
        }
        for (number, kept) in kept.iter().enumerate() {
            if let Kept::Tiles(tiles) = kept {
                let tiles: Option<Vec<_>> = tiles
                    .iter()
                    .map(|&t| {
                        let is_turned = mesh.turned.get(t as usize).copied().unwrap_or(false);
                        let [a, b, c] = mesh.corners(t as usize)?;
                        Some(if is_turned { [a, c, b] } else { [a, b, c] })
                    })
                    .collect();
                if !tiles.is_some_and(|tiles| tiles::tile(self.corners(number), &tiles)) {
                    return Err(format!("the parts of triangle {number} are not the whole of it"));
                }
                proof.tiled += 1;
            }
        }
        Ok(kept)
    }

    /// Every triangle of the file that the mesh lacks is a copy of another, or has no area, and
    /// others have its points.
    fn prove_rest(
        &self,
        mesh: &Mesh,
        kept: &[Kept],
        proof: &mut RepairProof,
    ) -> Result<(), String> {
        let sorted = |mut places: [Place; 3]| {
            places.sort_unstable();
            places
        };
        let numbers = |wanted: bool| {
            let of_kept = kept.iter().map(move |kept| (*kept != Kept::Nothing) == wanted);
            of_kept.enumerate().filter(|(_, is_wanted)| *is_wanted).map(|(number, _)| number)
        };
        if numbers(false).next().is_none() {
            return if mesh.wires.is_empty() {
                Ok(())
            } else {
                Err("a wire of no triangle".into())
            };
        }
        let first: HashMap<[Place; 3], usize> =
            numbers(true).map(|number| (sorted(self.places(number)), number)).collect();
        let wires: HashMap<u32, [u32; 2]> =
            mesh.wires.iter().map(|wire| (wire.source, wire.ends)).collect();
        let mut edges = None;
        let mut wires_left = mesh.wires.len();
        for number in numbers(false) {
            let places = self.places(number);
            if let Some(&of) = first.get(&sorted(places)) {
                let is_opposite = winding(self.places(of), places) == Some(false);
                if is_opposite && !mesh.has_merged_walls {
                    return Err(format!(
                        "triangle {number} is the back of {of}, which is not told"
                    ));
                }
                proof.copies += 1;
                continue;
            }
            let corners = self.corners(number);
            if !cover::is_flat(corners) {
                return Err(format!("triangle {number} of the file is not in the mesh"));
            }
            let is_held = match wires.get(&(number as u32)) {
                Some(ends) => {
                    wires_left -= 1;
                    cover::is_wire_of(ends.map(|v| mesh.positions[v as usize]), corners)
                }
                None => edges.get_or_insert_with(|| Edges::new(mesh)).cover(corners),
            };
            if !is_held {
                return Err(format!("points of triangle {number}, without area, are lost"));
            }
            proof.flat += 1;
        }
        if wires_left > 0 {
            return Err("a wire of no triangle without area".into());
        }
        Ok(())
    }
}

/// Whether two triangles on the same three places are wound alike; `None` if the places differ.
/// Where two of the places are one, either answer may come.
fn winding(a: [Place; 3], b: [Place; 3]) -> Option<bool> {
    let turns = |b: [Place; 3]| [b, [b[1], b[2], b[0]], [b[2], b[0], b[1]]];
    if turns(b).contains(&a) {
        Some(true)
    } else if turns([b[0], b[2], b[1]]).contains(&a) {
        Some(false)
    } else {
        None
    }
}
