//! The tribox hierarchy: size, levels, memory.

use meshsweep::counted::Counted;
use meshsweep::number::{AtMost, Percent, Short};
use meshsweep_core::{TriboxLevel, Triboxes};
use serde_json::{Value, json};
use std::io::{self, Write};

/// Void beside the solid, where there is one.
fn void(triboxes: &Triboxes<'_>, level: &TriboxLevel) -> Option<f32> {
    triboxes.is_solid().then_some(level.void_ratio)
}

pub(super) fn write(out: &mut dyn Write, triboxes: &Triboxes<'_>) -> io::Result<()> {
    let holds = if triboxes.is_solid() { "hold the solid" } else { "hold the surface" };
    writeln!(out, "triboxes")?;
    writeln!(
        out,
        "  {} of {}, depth {}: they {holds}",
        Counted(triboxes.node_count(), "node"),
        Counted(triboxes.leaf_count(), "leaf"),
        triboxes.depth()
    )?;
    if triboxes.is_turned() {
        let rows = triboxes.orientation().map(|row| row.map(|x| Short(x).to_string()).join(" "));
        writeln!(out, "  turned by the rotation {}", rows.join(" / "))?;
    }
    writeln!(out, "  triboxes    void %  hull error  largest distance to the mesh")?;
    for level in triboxes.levels() {
        let void = void(triboxes, &level)
            .map_or("-".to_owned(), |void| Percent(f64::from(void) * 100.0).to_string());
        writeln!(
            out,
            "  {:>8} {void:>9} {:>11}  {}",
            level.triboxes,
            AtMost(level.error),
            AtMost(level.distance)
        )?;
    }
    Ok(())
}

pub(super) fn as_json(triboxes: &Triboxes<'_>) -> Value {
    let level = |level: TriboxLevel| {
        json!({
            "triboxes": level.triboxes,
            "void_ratio": void(triboxes, &level),
            "hull_error": level.error,
            "distance": level.distance,
        })
    };
    json!({
        "is_solid": triboxes.is_solid(),
        "nodes": triboxes.node_count(),
        "leaves": triboxes.leaf_count(),
        "depth": triboxes.depth(),
        "orientation": triboxes.is_turned().then(|| triboxes.orientation()),
        "levels": triboxes.levels().map(level).collect::<Vec<_>>(),
    })
}
