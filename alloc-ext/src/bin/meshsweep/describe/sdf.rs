//! The distance field: kind, layout, cells, errors.

use meshsweep::counted::Counted;
use meshsweep::number::{AtMost, Short};
use meshsweep::trade::{Board, most_of_field};
use meshsweep_core::internal::sdf::format::layout::tree;
use meshsweep_core::{Sdf, SdfKind, SdfLayout};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The largest error below and above, and the largest sum of both, in the mesh's unit. All error of
/// a tree's leaf is above.
fn largest(sdf: &Sdf<'_>) -> [f64; 3] {
    let header = sdf.header();
    let of_cell = |&errors: &u8| {
        let low = f64::from(header.low[usize::from(errors & 15)]);
        let high = f64::from(header.high[usize::from(errors >> 4)]);
        [low, high, low + high]
    };
    let of_entry = |&[_, _, _, kind, _]: &[u8; 5]| {
        let number = usize::from(kind & 31);
        let book = if number < 16 { &header.low } else { &header.high };
        let is_leaf = kind & tree::IS_LEAF != 0;
        let width = if is_leaf { f64::from(book[number % 16]) } else { 0.0 };
        [0.0, width, width]
    };
    let most = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| a[k].max(b[k]));
    let cells = sdf.errors().iter().map(of_cell);
    let of_all = cells.chain(sdf.entries().iter().map(of_entry));
    of_all.fold([0.0; 3], most).map(|units| units / f64::from(header.per_unit))
}

/// Leaves of a tree.
fn leaves(sdf: &Sdf<'_>) -> usize {
    sdf.entries().iter().filter(|entry| entry[3] & tree::IS_LEAF != 0).count()
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
    let unit = Short(sdf.unit());
    if sdf.layout() == SdfLayout::Tree {
        writeln!(out, "  tree of {} leaves", leaves(sdf))?;
        writeln!(out, "  {x} x {y} x {z} root cells of 65536 units of {unit}")?;
    } else {
        writeln!(out, "  {x} x {y} x {z} cells of 2048 units of {unit}")?;
    }
    let [m4f, m0] = Board::ALL.map(|board| {
        let most = (most_of_field(board, sdf) / 10.0).ceil() * 10.0;
        format!("{most} instructions of a {}", board.name())
    });
    let steps = Counted(sdf.steps() as usize, "step");
    writeln!(out, "  a question takes {steps} at most: some {m4f}, {m0}")?;
    writeln!(out, "  from {low} to {high}")?;
    writeln!(out, "  largest error {below} below, {above} above; widest cell {both}")
}

pub(super) fn as_json(sdf: &Sdf<'_>) -> Value {
    let header = sdf.header();
    let [below, above, both] = largest(sdf);
    json!({
        "kind": sdf.kind().name(),
        "layout": sdf.layout().name(),
        "cells": sdf.cells(),
        "steps": sdf.steps(),
        "unit": sdf.unit(),
        "per_unit": header.per_unit,
        "bounds": sdf.bounds(),
        "largest_error_below": below,
        "largest_error_above": above,
        "widest_cell": both,
    })
}
