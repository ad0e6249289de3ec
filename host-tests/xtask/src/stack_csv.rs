//! The builder's table of stacks: bounds of all questions and of the C functions.

use std::fs;
use std::path::PathBuf;

use crate::cost::Row;
use crate::images::Profile;
use crate::questions::QUESTIONS;
use crate::stack::C_FUNCTIONS;
use crate::workspace;

/// The builder's table, from which `meshsweep build --emit` takes what it writes.
fn file() -> PathBuf {
    workspace::root().join("alloc-ext/src/emit/source/stack.csv")
}

/// What the builder is told of a bound: another compiler's may be a little more.
fn with_room(bound: u32) -> u32 {
    (bound + 64).next_multiple_of(64)
}

/// Columns of the builder's table: a board, and how it is optimised.
fn columns(rows: &[Row]) -> impl Iterator<Item = (&Row, Profile)> {
    rows.iter().flat_map(|row| [Profile::Small, Profile::Release].map(|profile| (row, profile)))
}

/// Where the bounds of a line of the builder's table are.
#[derive(Clone, Copy)]
enum Bounds {
    OfQuestion(usize),
    OfC(usize),
}

impl Bounds {
    fn of(self, row: &Row, profile: Profile) -> Option<u32> {
        match self {
            Self::OfQuestion(index) => row.stacks.of(profile)[index].bound,
            Self::OfC(index) => row.stacks.of_c(profile)[index],
        }
    }
}

/// Lines of the builder's table: a name, what a blob has to have, and the bounds.
fn listed() -> impl Iterator<Item = (&'static str, &'static str, Bounds)> {
    let questions = QUESTIONS.iter().enumerate();
    let questions = questions.map(|(i, of)| (of.name, of.needs, Bounds::OfQuestion(i)));
    let functions = C_FUNCTIONS.iter().enumerate();
    questions.chain(functions.map(|(i, &(name, needs))| (name, needs, Bounds::OfC(i))))
}

/// Writes the builder's table.
///
/// # Errors
/// A bound is not known, or the file cannot be written.
pub fn write(rows: &[Row]) -> Result<(), String> {
    let mut text = "question,needs".to_owned();
    for (row, profile) in columns(rows) {
        let level = if profile == Profile::Small { "s" } else { "3" };
        text.push_str(&format!(",{} {level}", row.board.cpu));
    }
    for (name, needs, bounds) in listed() {
        text.push_str(&format!("\n{name},{needs}"));
        for (row, profile) in columns(rows) {
            let Some(bound) = bounds.of(row, profile) else {
                return Err(format!("stack.csv: {name} is not known of all boards"));
            };
            text.push_str(&format!(",{}", with_room(bound)));
        }
    }
    text.push('\n');
    fs::write(file(), text).map_err(|error| format!("{}: {error}", file().display()))
}

/// Compares the builder's table with the bounds that are known.
///
/// # Errors
/// A number below a bound, or far above it.
pub fn check(rows: &[Row]) -> Result<(), String> {
    let text = fs::read_to_string(file());
    let text = text.map_err(|error| format!("{}: {error}", file().display()))?;
    let mut lines = text.lines().skip(1);
    for (name, needs, bounds) in listed() {
        let mut cells = lines.next().unwrap_or_default().split(',');
        let named = [cells.next(), cells.next()];
        if named != [Some(name), Some(needs)] {
            return Err(format!("stack.csv: {named:?}, not {name}"));
        }
        for (row, profile) in columns(rows) {
            let written = cells.next().and_then(|cell| cell.parse::<u32>().ok()).unwrap_or(0);
            let Some(bound) = bounds.of(row, profile) else { continue };
            let most = with_room(bound) + 64 + bound / 8;
            if !(bound..=most).contains(&written) {
                return Err(format!(
                    "stack.csv: {name}, {}, {}: {written}, and the bound is {bound}",
                    row.board.cpu,
                    profile.name()
                ));
            }
        }
    }
    Ok(())
}
