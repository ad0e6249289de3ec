//! Whether the finest surface is the mesh, at rest and at key frames.

use super::deform;
use super::parse::Blob;
use crate::check::input::{Given, is_within};
use crate::check::near::{Near, Verdict};
use crate::mesh::{KeyFrame, Mesh};
use glam::DVec3;
use std::collections::HashMap;

/// The mesh's vertex at each vertex of the finest surface, and how often integers had to decide.
pub(super) type Places = (HashMap<u32, u32>, usize);

/// Every triangle of the mesh is one of the finest surface, exactly once, with its number and its
/// corners within the surface error; in the mesh's winding if the levels enclose.
pub(super) fn triangles(blob: &Blob, given: &Given<'_>) -> Result<Places, String> {
    let count = given.mesh.triangles.len();
    if blob.surface.len() != count {
        return Err(format!("the surface has {} triangles, the mesh {count}", blob.surface.len()));
    }
    if let Some(number) = blob.source.iter().find(|&&number| number >= blob.input_triangles) {
        return Err(format!("triangle {number} of an input of {}", blob.input_triangles));
    }
    let Mesh { triangles, source, .. } = given.mesh;
    let wanted = triangles.iter().copied().zip(source.iter().copied());
    let corners = blob.surface.iter().map(|&t| blob.corners(t));
    let stored = blob.source.iter().copied().zip(corners);
    let (found, exact) = given.find(wanted, stored, blob.surface_error, !blob.encloses)?;
    let pairs = blob.surface.iter().zip(&found);
    let places = pairs.flat_map(|(of, at)| (0..3).map(|k| (of[k], at[k]))).collect();
    Ok((places, exact))
}

/// Every segment and point of the mesh that belongs to no triangle with an area is within the
/// surface error of the finest surface. Returns how many were undecided.
pub(super) fn wires(blob: &Blob, given: &Given<'_>) -> Result<usize, String> {
    if given.mesh.wires.is_empty() {
        return Ok(0);
    }
    let surface = Near::new(blob.surface.iter().map(|&t| blob.places(t)).collect());
    let limit = (blob.surface_error - given.moved()).max(0.0);
    let mut undecided = 0;
    for wire in &given.mesh.wires {
        let corners = wire.triangle().map(|v| DVec3::from(given.place(v)));
        match surface.within(corners, limit) {
            Verdict::Within => {}
            Verdict::Undecided => undecided += 1,
            Verdict::Beyond(_, d) => {
                return Err(format!(
                    "triangle {}, which has no area, is {d:e} from the surface, the header says \
                     {limit:e}",
                    wire.source
                ));
            }
        }
    }
    Ok(undecided)
}

/// Every vertex of the finest surface has the number of the mesh's vertex in the input file. Of one
/// that only closes holes the number is that of some vertex of the mesh at its place.
pub(super) fn numbers(
    bytes: &[u8],
    blob: &Blob,
    given: &Given<'_>,
    (places, _): &Places,
) -> Result<usize, String> {
    let numbers = deform::numbers(bytes, blob)?;
    let mesh = given.mesh;
    let of_number: HashMap<u32, u32> = mesh.vertex_source.iter().copied().zip(0..).collect();
    let mut exact = 0;
    let mut is_there = |label: u32, number: u32| {
        let Some(&vertex) = of_number.get(&number) else { return false };
        let here = blob.vertices[label as usize];
        is_within(here, given.place(vertex), [blob.surface_error, 0.0, 0.0], &mut exact)
    };
    let labels = (0..).zip(&blob.splits_with).filter(|(_, with)| with.is_none());
    for ((label, _), &number) in labels.zip(&numbers) {
        let wanted = places.get(&label).map(|&v| mesh.vertex_source[v as usize]);
        if wanted.is_none() && !blob.encloses && is_there(label, number) {
            continue;
        }
        if wanted != Some(number) {
            let wanted = wanted.map_or("none".to_owned(), |number| number.to_string());
            return Err(format!("vertex {label} has the number {number} and not {wanted}"));
        }
    }
    Ok(numbers.len())
}

/// Every vertex of the finest surface is within a key frame's error of the frame's mesh. Returns
/// how many vertices were compared.
pub(super) fn frames(
    bytes: &[u8],
    blob: &Blob,
    given: &Given<'_>,
    keys: &[KeyFrame],
    (places, _): &Places,
) -> Result<usize, String> {
    let stored = deform::frames(bytes, blob)?;
    if stored.len() != keys.len() {
        let (stored, given) = (stored.len() + 1, keys.len() + 1);
        return Err(format!("key frames, frame 0 included: {stored} stored, {given} given"));
    }
    let (mut compared, mut exact) = (0, 0);
    for (index, (frame, key)) in stored.iter().zip(keys).enumerate() {
        for (&label, &vertex) in places {
            let there = key.positions[vertex as usize].map(|x| f64::from(x) * given.scale);
            let here = frame.vertices[label as usize].to_array();
            let allowed = [frame.error, -key.rounding * given.scale, 0.0];
            if !is_within(here, there, allowed, &mut exact) {
                return Err(format!(
                    "key frame {}: vertex {label} is not within {:e} of the mesh's",
                    index + 1,
                    frame.error
                ));
            }
            compared += 1;
        }
    }
    Ok(compared)
}
