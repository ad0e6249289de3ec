//! The firmware's part: same bits on every board, no panic, sizes and costs.

use std::path::Path;

use crate::blobs::Blob;
use crate::boards::{BOARDS, Board};
use crate::cost::{self, Added, Measured, Row};
use crate::cross::Cross;
use crate::images::{self, Profile};
use crate::qemu::Qemu;
use crate::reading::Reading;
use crate::steps::Steps;
use crate::{blobs, elf, proof};

/// What the firmware's part needs beside cargo.
#[derive(Clone, Debug)]
pub struct Tools {
    cross: Cross,
    qemu: Qemu,
}

/// Makes sure of the tools.
pub fn setup(steps: &mut Steps) -> Option<Tools> {
    let cross = steps.run("setup: std for the boards", Cross::find);
    let qemu = steps.run("setup: QEMU", Qemu::find);
    Some(Tools { cross: cross?, qemu: qemu? })
}

/// Runs all of it; prints the table, and writes it to `json`.
pub fn run(steps: &mut Steps, tools: &Tools, json: Option<&Path>) {
    if steps.run("the host's answers", blobs::write).is_none() {
        return;
    }
    let rows: Vec<Row> = BOARDS.iter().map(|board| on_board(steps, tools, board)).collect();
    say!("{}", cost::text(&rows));
    if let Some(file) = json {
        steps.run("write the table", || cost::write_json(&rows, file));
    }
}

fn on_board(steps: &mut Steps, tools: &Tools, board: &Board) -> Row {
    let Tools { cross, qemu } = tools;
    let step = |what: &str| format!("{}: {what}", board.cpu);
    let standard = Blob::standard(board.flash);
    let mut readings = Vec::new();
    for blob in standard {
        let name = step(&format!("the host's bits, {}", blob.name));
        let reading = steps.run(&name, || compared(cross, qemu, board, blob));
        readings.extend(reading.map(|reading| Measured {
            blob: blob.name,
            profile: blob.profile(board.flash),
            reading,
        }));
    }
    for variant in Blob::VARIANTS {
        let name = format!("the host's bits, {}", variant.name);
        steps.run(&step(&name), || compared(cross, qemu, board, variant).map(drop));
    }
    if cross.has_clippy() {
        steps.run(&step("lints"), || images::lint(cross, board.target, &standard[0].file()));
    }
    for profile in Profile::ALL {
        steps.run(&step(&format!("no panic, {}", profile.name())), || {
            proof::holds(cross, board.target, profile)
        });
    }
    steps.run(&step("a panic is noticed"), || {
        proof::notices_a_panic(cross, board.target, Profile::Release)
    });
    let added = steps.run(&step("sizes"), || sizes(cross, board)).unwrap_or_default();
    Row { board: *board, readings, added }
}

/// Runs the suite on a board; its answers are the host's bit by bit, or it is an error.
fn compared(cross: &Cross, qemu: &Qemu, board: &Board, blob: Blob) -> Result<Reading, String> {
    let profile = blob.profile(board.flash);
    let image = images::suite(cross, board.target, profile, blob.image, &blob.file())?;
    asked(qemu, board, &image, &blob.expected()?)
}

/// The same for any blob: `expected` is what the host printed.
pub fn reading(
    tools: &Tools,
    board: &Board,
    image: &str,
    blob: &Path,
    expected: &str,
) -> Result<Reading, String> {
    let image = images::suite(&tools.cross, board.target, Profile::Release, image, blob)?;
    asked(&tools.qemu, board, &image, &Reading::parse(expected, None)?)
}

fn asked(qemu: &Qemu, board: &Board, image: &Path, expected: &Reading) -> Result<Reading, String> {
    let reading = Reading::parse(&qemu.run(board.machine, image)?, Some(board))?;
    reading.compare(expected)?;
    Ok(reading)
}

fn sizes(cross: &Cross, board: &Board) -> Result<Vec<Added>, String> {
    const QUESTIONS: [&str; 11] = [
        "open",
        "closest",
        "segment",
        "outer",
        "tree_open",
        "tree_closest",
        "tree_alone",
        "tree_segment",
        "tree_session",
        "triboxes",
        "tight",
    ];
    let mut added = Vec::new();
    for profile in Profile::ALL {
        let names = QUESTIONS.map(|question| format!("size_{question}"));
        let names: Vec<&str> =
            std::iter::once("size_empty").chain(names.iter().map(String::as_str)).collect();
        let images = images::sizes(cross, board.target, profile, &names)?;
        let sizes = images.iter().map(|image| elf::size(image)).collect::<Result<Vec<_>, _>>()?;
        if let [empty, others @ ..] = sizes.as_slice() {
            added.extend(QUESTIONS.iter().zip(others).map(|(question, size)| {
                let size = size.beyond(*empty);
                Added { question, profile, size }
            }));
        }
    }
    Ok(added)
}
