//! The firmware's costs, as a table and as JSON.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::boards::Board;
use crate::elf::Size;
use crate::images::Profile;
use crate::reading::{Cost, Reading};

/// What one image adds to the empty one.
#[derive(Clone, Debug)]
pub struct Added {
    /// The question that the image asks.
    pub question: &'static str,
    /// How the image is optimised.
    pub profile: Profile,
    /// Bytes beyond the empty image.
    pub size: Size,
}

/// What one blob's image told.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The blob's name.
    pub blob: &'static str,
    /// How the image is optimised.
    pub profile: Profile,
    /// Answers and costs.
    pub reading: Reading,
}

/// All that was measured on one board.
#[derive(Clone, Debug)]
pub struct Row {
    /// The board.
    pub board: Board,
    /// Each blob's.
    pub readings: Vec<Measured>,
    /// Each question's code.
    pub added: Vec<Added>,
}

/// The table for people.
pub fn text(rows: &[Row]) -> String {
    let mut table =
        String::from("\nflash and static RAM in bytes, beyond an image that asks nothing\n");
    let _ = writeln!(
        table,
        "{:<12}{:<14}{:<9}{:>8}{:>8}{:>8}",
        "cpu", "question", "profile", "text", "rodata", "RAM"
    );
    for row in rows {
        for Added { question, profile, size } in &row.added {
            let (cpu, profile, ram) = (row.board.cpu, profile.name(), size.ram());
            let _ = writeln!(
                table,
                "{cpu:<12}{question:<14}{profile:<9}{:>8}{:>8}{ram:>8}",
                size.text, size.rodata
            );
        }
    }
    table.push_str(
        "\ninstructions a query, and bytes of RAM: stack, and scratch that the caller hands over\n",
    );
    let _ = writeln!(
        table,
        "{:<12}{:<14}{:<9}{:<14}{:>7}{:>10}{:>10}{:>10}{:>8}{:>9}",
        "cpu", "blob", "profile", "query", "count", "min", "mean", "max", "stack", "scratch"
    );
    for row in rows {
        for Measured { blob, profile, reading } in &row.readings {
            for Cost { kind, queries, min, mean, max, stack } in &reading.costs {
                let (cpu, profile, scratch) = (row.board.cpu, profile.name(), reading.scratch);
                let _ = writeln!(
                    table,
                    "{cpu:<12}{blob:<14}{profile:<9}{kind:<14}{queries:>7}{min:>10.0}{mean:>10.0}{max:>10.0}{stack:>8}{scratch:>9}",
                );
            }
        }
    }
    table
}

/// The same for programs.
pub fn write_json(rows: &[Row], file: &Path) -> Result<(), String> {
    let value: Vec<Value> = rows.iter().map(row).collect();
    let text = serde_json::to_string_pretty(&value).map_err(|error| error.to_string())?;
    fs::write(file, text + "\n")
        .map_err(|error| format!("cannot write {}: {error}", file.display()))
}

fn row(row: &Row) -> Value {
    let added: Vec<_> = row
        .added
        .iter()
        .map(|Added { question, profile, size }| {
            json!({
                "question": question, "profile": profile.name(),
                "text_bytes": size.text, "rodata_bytes": size.rodata,
                "data_bytes": size.data, "bss_bytes": size.bss,
            })
        })
        .collect();
    let blobs: Vec<_> = row
        .readings
        .iter()
        .map(|Measured { blob, profile, reading }| {
            let costs: Vec<_> = reading.costs.iter().map(cost).collect();
            json!({
                "name": blob, "profile": profile.name(), "bytes_and_hash": reading.blob,
                "scratch_bytes": reading.scratch, "costs": costs,
            })
        })
        .collect();
    json!({
        "cpu": row.board.cpu, "target": row.board.target, "machine": row.board.machine.name(),
        "added": added, "blobs": blobs,
    })
}

fn cost(cost: &Cost) -> Value {
    json!({
        "query": cost.kind, "count": cost.queries, "stack_bytes": cost.stack,
        "instructions_min": cost.min, "instructions_mean": cost.mean, "instructions_max": cost.max,
    })
}
