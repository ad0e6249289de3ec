//! The firmware's costs.

use std::fmt::Write as _;

use crate::blobs::Blob;
use crate::boards::Board;
use crate::elf::Size;
use crate::images::Profile;
use crate::questions::QUESTIONS;
use crate::reading::{Cost, Reading};
use crate::stack::{Stack, Stacks};

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
    /// The blob.
    pub blob: Blob,
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
    /// Each question's stack.
    pub stacks: Stacks,
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
        let reported = |measured: &&Measured| measured.blob.is_reported(row.board.flash);
        for Measured { blob, profile, reading } in row.readings.iter().filter(reported) {
            for Cost { kind, queries, min, mean, max, stack } in &reading.costs {
                let (cpu, profile, scratch) = (row.board.cpu, profile.name(), reading.scratch);
                let blob = blob.name;
                let _ = writeln!(
                    table,
                    "{cpu:<12}{blob:<14}{profile:<9}{kind:<14}{queries:>7}{min:>10.0}{mean:>10.0}{max:>10.0}{stack:>8}{scratch:>9}",
                );
            }
        }
    }
    table.push_str("\nstack of a question, bytes: most seen, and bound\n");
    for row in rows {
        for profile in Profile::ALL {
            let stacks = QUESTIONS.iter().zip(row.stacks.of(profile));
            for (question, Stack { painted, bound }) in stacks {
                let text = |bytes: Option<u32>| bytes.map_or("-".to_owned(), |b| b.to_string());
                let _ = writeln!(
                    table,
                    "{:<12}{:<32}{:<9}{:>8}{:>8}",
                    row.board.cpu,
                    question.name,
                    profile.name(),
                    text(painted),
                    text(bound)
                );
            }
        }
    }
    table
}
