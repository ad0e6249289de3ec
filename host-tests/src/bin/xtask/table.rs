//! What the firmware costs, as a table and as JSON.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::boards::Board;
use crate::elf::Size;
use crate::images::Profile;
use crate::reading::Reading;

/// What one image adds to the empty one.
#[derive(Clone, Debug)]
pub struct Added {
    pub question: &'static str,
    pub profile: Profile,
    pub size: Size,
}

/// All that was measured on one board.
#[derive(Clone, Debug)]
pub struct Row {
    pub board: Board,
    pub reading: Option<Reading>,
    pub added: Vec<Added>,
}

/// The table for people.
pub fn text(rows: &[Row]) -> String {
    let mut table = String::from("\nflash and static RAM in bytes, beyond an image that asks nothing\n");
    let _ = writeln!(
        table,
        "{:<12}{:<10}{:<9}{:>8}{:>8}{:>8}",
        "cpu", "question", "profile", "text", "rodata", "RAM"
    );
    for row in rows {
        for Added { question, profile, size } in &row.added {
            let (cpu, profile, ram) = (row.board.cpu, profile.name(), size.ram());
            let _ = writeln!(
                table,
                "{cpu:<12}{question:<10}{profile:<9}{:>8}{:>8}{ram:>8}",
                size.text, size.rodata
            );
        }
    }
    table.push_str(
        "\ninstructions a query, and bytes of RAM: stack, and scratch that the caller hands over\n",
    );
    let _ = writeln!(
        table,
        "{:<12}{:<14}{:>9}{:>10}{:>10}{:>10}{:>8}{:>9}",
        "cpu", "query", "count", "min", "mean", "max", "stack", "scratch"
    );
    for row in rows {
        let Some(reading) = &row.reading else { continue };
        for cost in &reading.costs {
            let _ = writeln!(
                table,
                "{:<12}{:<14}{:>9}{:>10.0}{:>10.0}{:>10.0}{:>8}{:>9}",
                row.board.cpu,
                cost.kind,
                cost.queries,
                cost.min,
                cost.mean,
                cost.max,
                cost.stack,
                reading.scratch
            );
        }
    }
    table
}

/// The same for programs.
pub fn write_json(rows: &[Row], file: &Path) -> Result<(), String> {
    let value: Vec<Value> = rows.iter().map(row).collect();
    let text = serde_json::to_string_pretty(&value).map_err(|error| error.to_string())?;
    fs::write(file, text + "\n").map_err(|error| format!("cannot write {}: {error}", file.display()))
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
    let costs: Vec<_> = row
        .reading
        .iter()
        .flat_map(|reading| &reading.costs)
        .map(|cost| {
            json!({
                "query": cost.kind, "count": cost.queries, "stack_bytes": cost.stack,
                "instructions_min": cost.min, "instructions_mean": cost.mean, "instructions_max": cost.max,
            })
        })
        .collect();
    json!({
        "cpu": row.board.cpu, "target": row.board.target, "machine": row.board.machine.name(),
        "scratch_bytes": row.reading.as_ref().map(|reading| reading.scratch),
        "blob": row.reading.as_ref().map(|reading| reading.blob.as_str()),
        "added": added, "costs": costs,
    })
}
