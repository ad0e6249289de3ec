//! Several meshes as one, each where it is put.

use std::path::Path;

use super::copies::Copies;
use super::placement::Placement;
use super::{MeshError, RawMesh, Unit};

/// Joins meshes of one unit. Repair then takes them as the parts of one file.
pub(crate) fn joined(
    name: &Path,
    unit: Unit,
    parts: &[(RawMesh, Placement)],
) -> Result<RawMesh, MeshError> {
    let size = parts.iter().map(|(raw, _)| raw.positions.len() + raw.triangles.len()).sum();
    let (mut copies, mut before) = (Copies::new(name, size), 0f64);
    let (mut decimal, mut left_out) = (false, super::LeftOut::default());
    for (part, placement) in parts {
        let first = copies.put(&part.positions, placement)?;
        copies.join(&part.triangles, first, placement)?;
        copies.raw.polygons.add(&part.polygons);
        before = before.max(part.error * placement.stretch());
        decimal |= part.decimal;
        left_out.add(&part.left_out);
    }
    let mut raw = RawMesh { unit: Some(unit), decimal, left_out, ..copies.raw };
    raw.error += before;
    Ok(raw)
}
