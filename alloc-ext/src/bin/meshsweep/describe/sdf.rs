//! The distance field: kind, cells, errors.

use meshsweep::number::{AtMost, Short};
use meshsweep_core::{Sdf, SdfKind};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The largest error below and above, and the largest sum of both, in the mesh's unit.
fn largest(sdf: &Sdf<'_>) -> [f64; 3] {
    let header = sdf.header();
    let of = |&errors: &u8| {
        let low = f64::from(header.low[usize::from(errors & 15)]);
        let high = f64::from(header.high[usize::from(errors >> 4)]);
        [low, high, low + high]
    };
    let most = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| a[k].max(b[k]));
    sdf.errors().iter().map(of).fold([0.0; 3], most).map(|units| units / f64::from(header.per_unit))
}

pub(super) fn write(out: &mut dyn Write, sdf: &Sdf<'_>) -> io::Result<()> {
    let [x, y, z] = sdf.cells();
    let means = match sdf.kind() {
        SdfKind::Signed => "signed distances",
        SdfKind::Solid => "distances to the solid, 0 inside",
        _ => "distances to the surface, without a side",
    };
    let [low, high] = sdf.bounds().map(|corner| corner.map(|x| Short(x).to_string()).join(", "));
    let [below, above, both] = largest(sdf).map(AtMost);
    writeln!(out, "distance field")?;
    writeln!(out, "  {means}")?;
    writeln!(out, "  {x} x {y} x {z} cells of 2048 units of {}", Short(sdf.unit()))?;
    writeln!(out, "  from {low} to {high}")?;
    writeln!(out, "  largest error {below} below, {above} above; widest cell {both}")
}

pub(super) fn as_json(sdf: &Sdf<'_>) -> Value {
    let header = sdf.header();
    let [below, above, both] = largest(sdf);
    json!({
        "kind": sdf.kind().name(),
        "cells": sdf.cells(),
        "unit": sdf.unit(),
        "per_unit": header.per_unit,
        "bounds": sdf.bounds(),
        "largest_error_below": below,
        "largest_error_above": above,
        "widest_cell": both,
    })
}
