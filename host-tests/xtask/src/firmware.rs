//! The firmware's part: same bits on every board, no panic, sizes and costs.

use std::path::{Path, PathBuf};

use crate::blobs::{Blob, Blocks};
use crate::boards::{BOARDS, Board, Flash};
use crate::cost::{self, Added, Measured, Row};
use crate::cross::Cross;
use crate::images::{self, Profile};
use crate::process;
use crate::questions::SIZES;
use crate::reading::Reading;
use crate::stack::{self, Stacks};
use crate::steps::Steps;
use crate::tools::Tools;
use crate::{blobs, c_library, elf, proof};

/// An image of the suite, built for one board, and a blob that it is asked about.
pub struct Asked {
    board: Board,
    blob: Blob,
    profile: Profile,
    image: PathBuf,
}

/// How much is measured and compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// All: `cargo xtask firmware`. Boards that compute floats by instructions are asked a quarter
    /// of the questions about two bodies, some of which take hundreds of millions of instructions.
    All,
    /// What can fail: `cargo xtask test`. Code that no table holds is not measured. Boards that
    /// compute floats by instructions take ten times as long as the others, and run a part of the
    /// queries: each kind and each blob, and as many of those in tables as the tables are made of.
    /// The proof that nothing panics is linked for size on those boards only, which need it most.
    /// One of the two boards with much the same instructions is asked less.
    Compared,
    /// What has a cost: `cargo xtask count --all`. As many queries as are [`Self::Compared`], of
    /// all boards and with both optimisations.
    Counted,
}

impl Scope {
    /// How many blocks of queries a board is asked about a blob.
    #[must_use]
    pub fn blocks(self, board: &Board, blob: Blob) -> Blocks {
        match self {
            Self::All if blob == blobs::APART && !board.has_floats => Blocks::QUARTER,
            Self::All => Blocks::ALL,
            // Its questions take millions of instructions.
            _ if blob == blobs::APART => Blocks::QUARTER,
            _ if board.has_floats => Blocks::ALL,
            _ if Blob::standard(board.flash).contains(&blob) => Blocks::TABLED,
            _ => Blocks::QUARTER,
        }
    }

    /// Whether a board is asked about a blob, by an image with this optimisation. The Cortex-M33
    /// runs nearly the instructions of the Cortex-M4F: `cargo xtask test` asks it about the two
    /// structures that have tables. The other optimisation is asked for the stack that it takes.
    fn asks(self) -> impl Fn(&Board, Blob, Profile) -> bool {
        move |board, blob, profile| {
            let has_table = matches!(blob.image, "suite_hull" | "suite_tree");
            let is_first = profile == blob.profile(board.flash);
            let all = is_first || board.flash == Flash::Large && blob.is_painted();
            match self {
                Self::All | Self::Counted => all,
                Self::Compared => is_first && (has_table || board.cpu != "Cortex-M33"),
            }
        }
    }

    /// Whether the proof image is linked for a board with a profile.
    fn is_proved(self, board: &Board, profile: Profile) -> bool {
        self == Self::All || profile == Profile::Release || !board.has_floats
    }

    /// Whether the proof image is linked with a panic too. That the link fails is the linker's
    /// doing, and all boards have the same one.
    fn is_sabotaged(self, board: &Board) -> bool {
        self == Self::All || board.cpu == BOARDS[0].cpu
    }

    /// Whether the C library's stack is bounded: in `cargo xtask test` that of the library that is
    /// built for its images.
    fn is_bound_in_c(self, board: &Board, profile: Profile) -> bool {
        self == Self::All || c_library::IMAGES == (board.cpu, profile)
    }

    /// Questions whose code is measured on a board, each by an image of its own: in `cargo xtask
    /// test` all of them on one board only.
    fn questions(self, board: &Board, profile: Profile) -> &'static [&'static str] {
        match self {
            Self::All | Self::Counted => &IMAGES,
            Self::Compared if board.cpu == BOARDS[0].cpu => &IMAGES,
            Self::Compared if profile == Profile::Release => &CODE,
            Self::Compared => &[],
        }
    }

    /// Debug builds whose stack is bounded.
    fn debug_profiles(self, board: &Board) -> &'static [Profile] {
        match self {
            Self::All if DEBUGGED.contains(&board.cpu) => &Profile::DEBUG,
            Self::Compared if DEBUGGED[0] == board.cpu => &[Profile::Overridden],
            _ => &[],
        }
    }
}

/// Runs all of it, and prints the table.
pub fn run(steps: &mut Steps, tools: &Tools) -> Vec<Row> {
    let asked = build(steps, tools, Scope::All);
    asked.map(|asked| ask(steps, tools, &asked, Scope::All)).unwrap_or_default()
}

/// Runs what has costs on some boards: the images of the suite, and those whose size is measured.
pub fn count(steps: &mut Steps, tools: &Tools, boards: &[Board]) -> Vec<Row> {
    let (cross, scope) = (&tools.cross, Scope::Counted);
    let asked = steps.run("images of the suite", || suites(cross, boards, scope.asks()));
    build_for_sizes(steps, cross, boards, scope);
    let mut rows =
        asked.map(|asked| answers(steps, tools, boards, &asked, scope)).unwrap_or_default();
    measure_sizes(steps, cross, &mut rows, scope);
    rows
}

/// Builds the images of some blobs, each as it is optimised for the board, and runs them.
pub fn some(
    steps: &mut Steps,
    tools: &Tools,
    boards: &[Board],
    is_asked: &dyn Fn(&Board, Blob) -> bool,
) -> Vec<Row> {
    let asked = steps.run("images of the suite", || {
        suites(&tools.cross, boards, |board, blob, profile| {
            profile == blob.profile(board.flash) && is_asked(board, blob)
        })
    });
    let rows = asked.map(|asked| answers(steps, tools, boards, &asked, Scope::Compared));
    rows.unwrap_or_default()
}

/// Builds all images, which takes nothing of the library on this machine. Lints and proofs are
/// among it.
pub fn build(steps: &mut Steps, tools: &Tools, scope: Scope) -> Option<Vec<Asked>> {
    let asked = steps.run("images of the suite", || suites(&tools.cross, &BOARDS, scope.asks()));
    proofs(steps, &tools.cross, scope);
    build_for_sizes(steps, &tools.cross, &BOARDS, scope);
    asked
}

/// Runs the images of the suite, bounds the stacks, and prints the table.
pub fn ask(steps: &mut Steps, tools: &Tools, asked: &[Asked], scope: Scope) -> Vec<Row> {
    let mut rows = answers(steps, tools, &BOARDS, asked, scope);
    stacks(steps, &tools.cross, &mut rows, scope);
    measure_sizes(steps, &tools.cross, &mut rows, scope);
    say!("{}", cost::text(&rows));
    rows
}

/// Runs the images of the suite.
fn answers(
    steps: &mut Steps,
    tools: &Tools,
    boards: &[Board],
    asked: &[Asked],
    scope: Scope,
) -> Vec<Row> {
    let written = steps.run("the host's answers", || {
        blobs::write()?;
        let in_flash = |Asked { board, blob, .. }: &Asked| {
            let blocks = scope.blocks(board, *blob);
            Ok((blob.in_flash(blocks)?, blocks.others))
        };
        asked.iter().map(in_flash).collect::<Result<Vec<_>, String>>()
    });
    let Some(flash) = written else { return Vec::new() };
    let runs: Vec<(&Asked, &(PathBuf, u32))> = asked.iter().zip(&flash).collect();
    let readings =
        process::parallel(&runs, |(Asked { board, blob, image, .. }, (flash, least))| {
            tools.asked_in_flash(board, image, flash, &blob.expected()?, *least)
        });
    let mut rows: Vec<Row> = boards
        .iter()
        .map(|board| Row {
            board: *board,
            readings: Vec::new(),
            added: Vec::new(),
            stacks: Stacks::default(),
        })
        .collect();
    for (asked, (reading, seconds)) in asked.iter().zip(readings) {
        let Asked { board, blob, profile, image } = asked;
        let name = format!("{}: the host's bits, {}, {}", board.cpu, blob.name, profile.name());
        let row = rows.iter_mut().find(|row| row.board.cpu == board.cpu);
        let Some(row) = row else { continue };
        let reading = reading.and_then(|reading| {
            row.stacks.paint(*profile, image, &reading)?;
            Ok(reading)
        });
        if let Some(reading) = steps.ended(&name, seconds, reading) {
            row.readings.push(Measured { blob: *blob, profile: *profile, reading });
        }
    }
    rows
}

/// Bounds the stacks of what was linked.
fn stacks(steps: &mut Steps, cross: &Cross, rows: &mut [Row], scope: Scope) {
    for Row { board, stacks, .. } in rows.iter_mut() {
        steps.run(&format!("{}: bounds of the stack", board.cpu), || {
            for profile in Profile::ALL {
                if scope.is_proved(board, profile) {
                    stacks.bound(cross, board, profile)?;
                }
            }
            for &profile in scope.debug_profiles(board) {
                stacks.bound_debug(cross, board, profile)?;
            }
            Ok(())
        });
    }
    steps.run("bounds of the stack in C", || {
        for Row { board, stacks, .. } in rows.iter_mut() {
            for profile in Profile::ALL {
                if scope.is_bound_in_c(board, profile) {
                    let linked = c_library::linked_for_stack(cross, board.target, profile)?;
                    let bound = stacks.bound_c(&linked, profile);
                    bound
                        .map_err(|reason| format!("{}, {}: {reason}", board.cpu, profile.name()))?;
                }
            }
        }
        Ok(())
    });
}

/// Measures the code of questions.
fn measure_sizes(steps: &mut Steps, cross: &Cross, rows: &mut [Row], scope: Scope) {
    for row in rows {
        let name = format!("{}: sizes", row.board.cpu);
        row.added = steps.run(&name, || sizes(cross, &row.board, scope)).unwrap_or_default();
    }
}

/// Lints and proofs.
fn proofs(steps: &mut Steps, cross: &Cross, scope: Scope) {
    if cross.has_clippy() {
        // The sources tell architectures apart and not their boards. Those of the core do, and are
        // no members of this workspace: they are linted as twins, with the workspace.
        let boards = BOARDS.iter().filter(|board| LINTED.contains(&board.cpu));
        let targets: Vec<&str> = boards.map(|board| board.target).collect();
        steps.run("lints of the images", || images::lint(cross, &targets));
    }
    for profile in Profile::ALL {
        let name = format!("no panic, {}", profile.name());
        let boards = BOARDS.iter().filter(|board| scope.is_proved(board, profile));
        let targets: Vec<&str> = boards.map(|board| board.target).collect();
        steps.run(&name, || proof::holds(cross, &targets, profile));
    }
    for board in BOARDS.iter().filter(|board| scope.is_sabotaged(board)) {
        let name = format!("{}: a panic is noticed", board.cpu);
        steps.run(&name, || proof::notices_a_panic(cross, board.target, Profile::Release));
    }
    for profile in Profile::DEBUG {
        let boards = BOARDS.iter().filter(|board| scope.debug_profiles(board).contains(&profile));
        let targets: Vec<&str> = boards.map(|board| board.target).collect();
        if !targets.is_empty() {
            steps.run(&format!("a debug build, {}", profile.name()), || {
                images::sizes(cross, &targets, profile, &[stack::DEBUG_IMAGE])
            });
        }
    }
}

/// Builds the images whose size is measured: one command for the boards that take the same images.
fn build_for_sizes(steps: &mut Steps, cross: &Cross, boards: &[Board], scope: Scope) {
    for profile in Profile::ALL {
        let name = format!("images for sizes, {}", profile.name());
        steps.run(&name, || {
            let mut built: Vec<(&[&str], Vec<&str>)> = Vec::new();
            for board in boards {
                let questions = scope.questions(board, profile);
                match built.iter_mut().find(|(others, _)| *others == questions) {
                    Some((_, targets)) => targets.push(board.target),
                    None => built.push((questions, vec![board.target])),
                }
            }
            for (questions, targets) in built.iter().filter(|(questions, _)| !questions.is_empty())
            {
                let names = size_images(questions);
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                images::sizes(cross, targets, profile, &names)?;
            }
            Ok(())
        });
    }
}

/// Builds all images of the suite: one command for each profile and the boards that take the same
/// images. What each is asked about.
fn suites(
    cross: &Cross,
    boards: &[Board],
    is_asked: impl Fn(&Board, Blob, Profile) -> bool,
) -> Result<Vec<Asked>, String> {
    let mut asked = Vec::new();
    let mut built: Vec<(Profile, Vec<&str>, Vec<&str>)> = Vec::new();
    for &board in boards {
        let mut names = Profile::ALL.map(|profile| (profile, Vec::new()));
        let blobs = Blob::standard(board.flash).into_iter().chain(Blob::VARIANTS);
        let asks = |blob| Profile::ALL.map(|profile| (blob, profile));
        for (blob, profile) in blobs.flat_map(asks) {
            if !is_asked(&board, blob, profile) {
                continue;
            }
            let image = images::image(cross, board.target, profile, blob.image);
            asked.push(Asked { board, blob, profile, image });
            for (_, names) in names.iter_mut().filter(|(of, _)| *of == profile) {
                if !names.contains(&blob.image) {
                    names.push(blob.image);
                }
            }
        }
        for (profile, names) in names.into_iter().filter(|(_, names)| !names.is_empty()) {
            match built.iter_mut().find(|(p, n, _)| (*p, n) == (profile, &names)) {
                Some((.., targets)) => targets.push(board.target),
                None => built.push((profile, names, vec![board.target])),
            }
        }
    }
    for (profile, names, targets) in built {
        images::running(cross, &targets, profile, &names)?;
    }
    Ok(asked)
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
    let image = tools.image(board, image)?;
    let flash = blobs::in_flash(blob, Blocks::ALL)?;
    let least = Blocks::ALL.others;
    tools.asked_in_flash(board, &image, &flash, &Reading::parse(expected, None)?, least)
}

/// A board of each architecture.
const LINTED: [&str; 2] = ["Cortex-M4F", "RV32IMAC"];

/// Boards whose debug builds are looked at: with floating point, and without.
pub const DEBUGGED: [&str; 2] = ["Cortex-M4F", "Cortex-M0"];

/// Questions whose code a table needs measured.
pub const CODE: [&str; 2] = ["closest", "tree_alone"];

/// Their images.
const IMAGES: [&str; SIZES.len()] = {
    let mut images = [""; SIZES.len()];
    let mut index = 0;
    while index < images.len() {
        images[index] = SIZES[index].0;
        index += 1;
    }
    images
};

/// The image that asks nothing, then one for each question.
fn size_images(questions: &[&str]) -> Vec<String> {
    ["empty"].iter().chain(questions).map(|question| format!("size_{question}")).collect()
}

fn sizes(cross: &Cross, board: &Board, scope: Scope) -> Result<Vec<Added>, String> {
    let mut added = Vec::new();
    for profile in Profile::ALL {
        let questions = scope.questions(board, profile);
        if questions.is_empty() {
            continue;
        }
        let size = |name: &String| elf::size(&images::image(cross, board.target, profile, name));
        let sizes = size_images(questions).iter().map(size).collect::<Result<Vec<_>, _>>()?;
        if let [empty, others @ ..] = sizes.as_slice() {
            added.extend(questions.iter().zip(others).map(|(question, size)| {
                let size = size.beyond(*empty);
                Added { question, profile, size }
            }));
        }
    }
    Ok(added)
}
