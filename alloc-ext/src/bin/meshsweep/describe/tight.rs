//! Tight hulls: faces, void, distances, bytes, memory.

use super::tree::{format_name, scratch_bytes};
use meshsweep::counted::Counted;
use meshsweep::number::{AtMost, Percent};
use meshsweep_core::internal::num::up_to_f32;
use meshsweep_core::{TightHull, TightHulls, TightRecord};
use serde_json::{Value, json};
use std::io::{self, Write};

fn all<'a>(hulls: &TightHulls<'a>) -> impl Iterator<Item = TightHull<'a>> {
    let hulls = *hulls;
    (0..hulls.count()).filter_map(move |index| hulls.get(index))
}

/// Bytes of a hull and its distances.
fn bytes(hull: &TightHull<'_>) -> usize {
    hull.bytes().len() + 2 * hull.record().faces as usize
}

/// A bound of the distance between a stored hull and the mesh of the file. The record's bound is of
/// both before rounding moved them; the surface error says how far it did.
fn to_file(hull: &TightHull<'_>, distance: f32) -> f32 {
    let moved = hull.bvh().surface_error();
    // The sum in f64 may be rounded down.
    let sum = (f64::from(distance) + f64::from(moved)).next_up();
    if moved == 0.0 { distance } else { up_to_f32(sum) }
}

/// Void as a fraction of the mesh's volume, if the mesh bounds one. The void of such a mesh is not
/// 0.
pub fn void(record: &TightRecord) -> Option<f32> {
    (record.void_ratio != 0.0).then_some(record.void_ratio)
}

pub(super) fn write(out: &mut dyn Write, hulls: &TightHulls<'_>) -> io::Result<()> {
    let encloses = match hulls.count() {
        1 => "it encloses the mesh",
        _ => "each encloses the mesh",
    };
    writeln!(out, "tight hulls")?;
    writeln!(out, "  {}: {encloses}", Counted(hulls.count(), "hull"))?;
    writeln!(
        out,
        "     faces    void %     bytes  scratch bytes  coordinates  hull to mesh, at most  mesh \
         to hull, at most"
    )?;
    for hull in all(hulls) {
        let record = hull.record();
        let void = void(record)
            .map_or("-".to_owned(), |void| Percent(f64::from(void) * 100.0).to_string());
        writeln!(
            out,
            "  {:>8} {void:>9} {:>9} {:>14}  {:<11}  {:>21}  {:>21}",
            record.faces,
            bytes(&hull),
            scratch_bytes(hull.bvh()),
            format_name(hull.bvh()),
            AtMost(to_file(&hull, record.slack)),
            AtMost(to_file(&hull, record.depth))
        )?;
    }
    Ok(())
}

pub(super) fn as_json(hulls: &TightHulls<'_>) -> Value {
    let hull = |hull: TightHull<'_>| {
        let record = hull.record();
        json!({
            "faces": record.faces,
            "void_ratio": void(record),
            "hull_to_mesh": to_file(&hull, record.slack),
            "mesh_to_hull": to_file(&hull, record.depth),
            "bytes": bytes(&hull),
            "vertex_format": format_name(hull.bvh()),
            "serves_distances": hull.bvh().serves_distances(),
            "serves_segments": hull.bvh().serves_segments(),
            "scratch_entries": hull.bvh().header().stack_entries,
            "scratch_bytes": scratch_bytes(hull.bvh()),
        })
    };
    json!({ "hulls": all(hulls).map(hull).collect::<Vec<_>>() })
}
