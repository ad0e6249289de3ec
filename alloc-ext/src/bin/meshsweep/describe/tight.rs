//! Tight hulls: faces, void, distances, bytes, memory.

use super::Length;
use super::tree::{stack_bytes, tree_format_name};
use crate::counted::Counted;
use meshsweep_core::{TightHull, TightHulls};
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

pub(super) fn write(out: &mut dyn Write, hulls: &TightHulls<'_>) -> io::Result<()> {
    let nested = if hulls.is_nested() { ", each encloses the next" } else { "" };
    writeln!(out, "tight hulls")?;
    writeln!(out, "  {}{nested}: each encloses the mesh", Counted(hulls.count(), "hull"))?;
    writeln!(
        out,
        "     faces    void %     bytes  stack bytes  coordinates  farthest from the mesh, farthest of the mesh"
    )?;
    for hull in all(hulls) {
        let record = hull.record();
        writeln!(
            out,
            "  {:>8} {:>9.3} {:>9} {:>12}  {:<11}  {}, {}",
            record.faces,
            record.void_ratio * 100.0,
            bytes(&hull),
            stack_bytes(hull.tree()),
            tree_format_name(hull.tree()),
            Length(record.slack),
            Length(record.depth)
        )?;
    }
    Ok(())
}

pub fn as_json(hulls: &TightHulls<'_>) -> Value {
    let hull = |hull: TightHull<'_>| {
        let record = hull.record();
        json!({
            "faces": record.faces,
            "void_ratio": record.void_ratio,
            "slack": record.slack,
            "depth": record.depth,
            "bytes": bytes(&hull),
            "vertex_format": tree_format_name(hull.tree()),
            "serves_distances": hull.tree().serves_distances(),
            "serves_segments": hull.tree().serves_segments(),
            "stack_entries": hull.tree().header().stack_entries,
            "stack_bytes": stack_bytes(hull.tree()),
        })
    };
    json!({ "is_nested": hulls.is_nested(), "hulls": all(hulls).map(hull).collect::<Vec<_>>() })
}
