//! The firmware's part: same bits on every board, no panic, sizes and costs.

use std::path::{Path, PathBuf};

use crate::blobs::Blob;
use crate::boards::{BOARDS, Board};
use crate::cost::{self, Added, Measured, Row};
use crate::cross::Cross;
use crate::images::{self, Profile};
use crate::process;
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

impl Tools {
    /// Builds an image that carries no blob, for a board; its path.
    ///
    /// # Errors
    /// The compiler's.
    pub fn image(&self, board: &Board, name: &str) -> Result<PathBuf, String> {
        let mut command = images::cargo(&self.cross, "build", &[board.target], Profile::Release);
        process::capture(command.args(["--bin", name]))?;
        Ok(images::image(&self.cross, board.target, Profile::Release, name))
    }

    /// Runs an image on a board, with a file in memory. Its answers are `expected`, bit by bit.
    ///
    /// # Errors
    /// Other bits, or an image that does not end.
    pub fn asked(
        &self,
        board: &Board,
        image: &Path,
        loaded: Option<(&Path, u32)>,
        expected: &Reading,
    ) -> Result<Reading, String> {
        let printed = self.qemu.run(board.machine, image, loaded)?;
        let reading = Reading::parse(&printed, Some(board))?;
        reading.compare(expected)?;
        Ok(reading)
    }
}

/// An image of the suite, built for one board.
struct Image {
    board: Board,
    blob: Blob,
    file: PathBuf,
}

/// Runs all of it, and prints the table.
pub fn run(steps: &mut Steps, tools: &Tools) -> Vec<Row> {
    let cross = &tools.cross;
    if steps.run("the host's answers", blobs::write).is_none() {
        return Vec::new();
    }
    let Some(images) = steps.run("images of the suite", || suites(cross)) else {
        return Vec::new();
    };
    // The emulator runs while the other images are built.
    let readings = std::thread::scope(|scope| {
        let readings = scope.spawn(|| {
            process::parallel(&images, |Image { board, blob, file }| {
                tools.asked(board, file, None, &blob.expected()?)
            })
        });
        built(steps, cross);
        readings.join().unwrap_or_default()
    });
    let mut rows: Vec<Row> = BOARDS
        .iter()
        .map(|board| Row { board: *board, readings: Vec::new(), added: Vec::new() })
        .collect();
    for (Image { board, blob, .. }, (reading, seconds)) in images.iter().zip(readings) {
        let name = format!("{}: the host's bits, {}", board.cpu, blob.name);
        let reading = steps.ended(&name, seconds, reading);
        let row = rows.iter_mut().find(|row| row.board.cpu == board.cpu);
        if let (Some(reading), Some(row)) = (reading, row)
            && Blob::standard(board.flash).contains(blob)
        {
            let profile = blob.profile(board.flash);
            row.readings.push(Measured { blob: blob.name, profile, reading });
        }
    }
    for row in &mut rows {
        let name = format!("{}: sizes", row.board.cpu);
        row.added = steps.run(&name, || sizes(cross, &row.board)).unwrap_or_default();
    }
    say!("{}", cost::text(&rows));
    rows
}

/// Lints, proofs, and the images whose size is measured.
fn built(steps: &mut Steps, cross: &Cross) {
    let targets = BOARDS.map(|board| board.target);
    if cross.has_clippy() {
        let [any, ..] = Blob::VARIANTS;
        steps.run("lints of the images", || images::lint(cross, &targets, &any.file()));
    }
    for profile in Profile::ALL {
        let name = format!("no panic, {}", profile.name());
        steps.run(&name, || proof::holds(cross, &targets, profile));
    }
    for board in BOARDS {
        let name = format!("{}: a panic is noticed", board.cpu);
        steps.run(&name, || proof::notices_a_panic(cross, board.target, Profile::Release));
    }
    for profile in Profile::ALL {
        let names = size_images();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let name = format!("images for sizes, {}", profile.name());
        steps.run(&name, || images::sizes(cross, &targets, profile, &names));
    }
}

/// Builds all images of the suite: one command for each blob and all boards that are asked about
/// it.
fn suites(cross: &Cross) -> Result<Vec<Image>, String> {
    let mut asked: Vec<(Blob, Profile, Vec<Board>)> = Vec::new();
    for board in BOARDS {
        for blob in Blob::standard(board.flash).into_iter().chain(Blob::VARIANTS) {
            let profile = blob.profile(board.flash);
            match asked.iter_mut().find(|(b, p, _)| (*b, *p) == (blob, profile)) {
                Some((.., boards)) => boards.push(board),
                None => asked.push((blob, profile, vec![board])),
            }
        }
    }
    let mut images = Vec::new();
    for (blob, profile, boards) in asked {
        let targets: Vec<&str> = boards.iter().map(|board| board.target).collect();
        let files = images::suite(cross, &targets, profile, blob.image, &blob.file())?;
        let built = boards.into_iter().zip(files);
        images.extend(built.map(|(board, file)| Image { board, blob, file }));
    }
    Ok(images)
}

/// Runs the suite about any blob on a board. Its answers are `expected`, the host's, bit by bit.
///
/// # Errors
/// Other bits, or an image that does not build or end.
pub fn reading(
    tools: &Tools,
    board: &Board,
    image: &str,
    blob: &Path,
    expected: &str,
) -> Result<Reading, String> {
    let files = images::suite(&tools.cross, &[board.target], Profile::Release, image, blob)?;
    let file = files.first().ok_or("no image")?;
    tools.asked(board, file, None, &Reading::parse(expected, None)?)
}

/// Questions whose code is measured, each by an image of its own.
const QUESTIONS: [&str; 12] = [
    "open",
    "closest",
    "segment",
    "outer",
    "tree_open",
    "tree_closest",
    "tree_alone",
    "tree_segment",
    "tree_coherent",
    "triboxes",
    "tight",
    "curve",
];

/// The image that asks nothing, then one for each question.
fn size_images() -> Vec<String> {
    ["empty"].iter().chain(&QUESTIONS).map(|question| format!("size_{question}")).collect()
}

fn sizes(cross: &Cross, board: &Board) -> Result<Vec<Added>, String> {
    let mut added = Vec::new();
    for profile in Profile::ALL {
        let size = |name: &String| elf::size(&images::image(cross, board.target, profile, name));
        let sizes = size_images().iter().map(size).collect::<Result<Vec<_>, _>>()?;
        if let [empty, others @ ..] = sizes.as_slice() {
            added.extend(QUESTIONS.iter().zip(others).map(|(question, size)| {
                let size = size.beyond(*empty);
                Added { question, profile, size }
            }));
        }
    }
    Ok(added)
}
