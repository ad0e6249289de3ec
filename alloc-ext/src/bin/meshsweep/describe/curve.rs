//! Curves: what they hold, memory, error.

use meshsweep::counted::Counted;
use meshsweep::number::AtMost;
use meshsweep_core::{Curve, ScratchEntry, Zone};
use serde_json::{Value, json};
use std::io::{self, Write};

/// Closed polylines.
fn closed(curve: &Curve<'_>) -> usize {
    let is_closed = |&polyline: &u32| curve.is_closed(polyline) == Some(true);
    (0..curve.polyline_count()).filter(is_closed).count()
}

/// Exclusion zones.
fn exclusions(curve: &Curve<'_>) -> usize {
    let is_exclusion = |&polyline: &u32| curve.zone(polyline) == Some(Zone::Exclusion);
    (0..curve.polyline_count()).filter(is_exclusion).count()
}

fn scratch_bytes(curve: &Curve<'_>) -> usize {
    curve.scratch_entries() * size_of::<ScratchEntry>()
}

pub(super) fn write(out: &mut dyn Write, curve: &Curve<'_>) -> io::Result<()> {
    let plane = if curve.is_planar() { ", z = 0" } else { "" };
    writeln!(out, "curves")?;
    writeln!(
        out,
        "  {} of {}, {} closed{plane}",
        Counted(curve.segment_count(), "segment"),
        Counted(curve.polyline_count(), "polyline"),
        closed(curve)
    )?;
    if closed(curve) < curve.polyline_count() as usize {
        writeln!(out, "  open: nothing joins the last point with the first; build --closed does")?;
    }
    match curve.check_fence() {
        Ok(()) if exclusions(curve) > 0 => {
            let inclusions = curve.polyline_count() as usize - exclusions(curve);
            writeln!(
                out,
                "  fence: inside of {} and outside of {}",
                Counted(inclusions, "inclusion zone"),
                Counted(exclusions(curve), "exclusion zone")
            )?;
        }
        Ok(()) => writeln!(out, "  fence: each polyline is an inclusion zone")?,
        Err(why) => writeln!(out, "  no fence: {why}")?,
    }
    writeln!(
        out,
        "  scratch: {}, {} bytes: no query needs more",
        Counted(curve.scratch_entries(), "scratch entry"),
        scratch_bytes(curve)
    )?;
    writeln!(out, "  curve error: {}", AtMost(curve.surface_error()))?;
    let [low, high] = curve.bounds();
    let size = (0..3).map(|k| f64::from(high[k]) - f64::from(low[k])).fold(0.0, f64::max);
    if f64::from(curve.surface_error()) > ROUGH * size {
        writeln!(
            out,
            "  far from its origin for its size: points and queries are rounded; subtract an origin"
        )?;
    }
    Ok(())
}

/// Part of its size by which rounding moves a curve that is far from its origin.
const ROUGH: f64 = 1.0 / 32_768.0;

pub(super) fn as_json(curve: &Curve<'_>) -> Value {
    json!({
        "polylines": curve.polyline_count(),
        "closed": closed(curve),
        "is_fence": curve.check_fence().is_ok(),
        "exclusion_zones": exclusions(curve),
        "segments": curve.segment_count(),
        "is_planar": curve.is_planar(),
        "box": curve.bounds(),
        "scratch_entries": curve.scratch_entries(),
        "scratch_bytes": scratch_bytes(curve),
        "surface_error": curve.surface_error(),
    })
}
