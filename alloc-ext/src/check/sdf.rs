//! Proof of a distance field from the blob's bytes and the mesh: every cell's errors hold for every
//! point of the cell.
//!
//! | file | owns |
//! | --- | --- |
//! | `parse` | the numbers of the section, and its cells or leaves |
//! | `function` | the function of a cell or leaf |
//! | `sides` | winding numbers of the mesh and of the file |
//! | `boxes` | the proof of a cell, by boxes that are halved |
//!
//! All is computed in the field's units, which are those of the stored errors: a mesh's vertex is
//! off by less than 2^-30 of them, and lengths are below 2^20.

mod boxes;
mod function;
mod parse;
mod sides;

use super::bytes::check_header;
use super::finding::Finding;
use crate::mesh::Input;
use boxes::{Cell, Unproved};
use glam::DVec3;
use parse::Field;
use rayon::prelude::*;
use sides::Sides;

const SDF: &str = "distance field";

/// Proves every cell.
pub(super) fn verify(bytes: &[u8], input: Input<'_>) -> Finding {
    match prove(bytes, input) {
        Ok([cells, boxes]) => Finding::proved(
            SDF,
            "the mesh lies in the field; at every point of every cell the distance is within the \
             cell's errors",
            &[("cell", cells), ("box", boxes)],
        ),
        Err(Unproved::Wrong(words)) => Finding::failed(SDF, words),
        Err(Unproved::Open(words)) => Finding::not_proved(SDF, words),
    }
}

fn prove(bytes: &[u8], input: Input<'_>) -> Result<[usize; 2], Unproved> {
    check_header(bytes).map_err(Unproved::Wrong)?;
    let field = Field::parse(bytes).map_err(Unproved::Wrong)?;
    let mesh = input.mesh;
    let corners = |t: [u32; 3]| t.map(|v| field.place(mesh.positions[v as usize]));
    let triangles: Vec<[DVec3; 3]> = mesh.all_triangles().map(corners).collect();
    // The file's mesh may be so far from the given one.
    let moved = (input.moved + mesh.rounding) * field.per_unit * (1.0 + 1e-9);
    let (least, end) = (DVec3::splat(moved), field.end() - moved);
    let is_within = |p: &&DVec3| p.cmpge(least).all() && p.cmple(end).all();
    if let Some(out) = triangles.iter().flatten().find(|p| !is_within(p)) {
        return Err(Unproved::Wrong(format!("the mesh leaves the field at {out:?}, in its units")));
    }
    let sides = if field.is_unsigned() { None } else { Some(Sides::of(mesh, &field)) };
    let cells = field.count();
    let index = boxes::Grid::new(&triangles, field.end());
    let cell = Cell { field: &field, sides: sides.as_ref(), moved };
    let prove = |number| cell.prove(number, &triangles, &index);
    let proofs: Vec<Result<usize, Unproved>> = (0..cells).into_par_iter().map(prove).collect();
    // A refuted cell goes before an unproved one. Among equals the first by number is told.
    let (mut boxes, mut open) = (0, None);
    for proof in proofs {
        match proof {
            Ok(count) => boxes += count,
            Err(Unproved::Wrong(words)) => return Err(Unproved::Wrong(words)),
            Err(error) => open = open.or(Some(error)),
        }
    }
    open.map_or(Ok([cells, boxes]), Err)
}
