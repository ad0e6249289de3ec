//! `cargo xtask rival`: what the box tree and parry3d take of a Cortex-M4F, on the same meshes and
//! for the same questions.
//!
//! A mesh is reduced to so many triangles, questions are drawn, and both go into one image an
//! engine. `target/rival/NAME-FACES/` keeps what the images carry, and the mesh as `mesh.ply`. An
//! engine more is a `race_NAME.rs` in `host-tests/lab/rival-firmware/src/bin`, and a line in
//! [`ENGINES`].

mod answers;
mod questions;

use std::path::PathBuf;

use meshsweep_xtask::cross::Cross;
use meshsweep_xtask::images::Profile;
use meshsweep_xtask::process;
use meshsweep_xtask::qemu::Qemu;
use meshsweep_xtask::rival::{BOARD, cargo, folder};
use meshsweep_xtask::say;
use meshsweep_xtask::steps::Steps;
use meshsweep_xtask::table::{Cell, Table, fixed};

use answers::{Answers, agree, of_host};
use questions::Course;

/// Engines by the names of their images.
const ENGINES: [&str; 2] = ["parry", "tree"];

/// What to run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    mesh: Option<PathBuf>,
    faces: Vec<usize>,
    seed: u64,
}

impl Options {
    /// `[MESH] [--faces COUNT,COUNT…] [--seed NUMBER]`; `None` if that is not what the words are.
    pub fn parse(words: &[&str]) -> Option<Self> {
        let mut options = Self { mesh: None, faces: vec![2_500, 10_000], seed: 1 };
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            match word {
                "--faces" => {
                    options.faces =
                        words.next()?.split(',').map(str::parse).collect::<Result<_, _>>().ok()?;
                }
                "--seed" => options.seed = words.next()?.parse().ok()?,
                flag if flag.starts_with("--") => return None,
                mesh => {
                    if options.mesh.replace(PathBuf::from(mesh)).is_some() {
                        return None;
                    }
                }
            }
        }
        Some(options)
    }
}

/// Runs each engine on each size of the mesh; prints the tables.
pub fn run(steps: &mut Steps, options: &Options) {
    let cross = steps.run("setup: std for the boards", Cross::find);
    let qemu = steps.run("setup: QEMU", Qemu::find);
    let (Some(cross), Some(qemu)) = (cross, qemu) else { return };
    let Some(mesh) = steps.run("mesh", || questions::load(options.mesh.as_deref())) else { return };
    let mut lints = cross.has_clippy();
    for &faces in &options.faces {
        let what = format!("{} at {faces} triangles", mesh.name);
        let course =
            steps.run(&format!("{what}: questions"), || Course::lay(&mesh, faces, options.seed));
        let Some(course) = course else { continue };
        if std::mem::take(&mut lints) {
            steps.run("lints of the images", || lint(&cross, &course));
        }
        let expected = steps.run(&format!("{what}: answers of the host"), || of_host(&course));
        let Some(expected) = expected else { continue };
        for engine in ENGINES {
            let answers = steps.run(&format!("{what}: {engine}"), || {
                let image = race(&cross, engine, &course)?;
                let answers = Answers::parse(&qemu.run(BOARD.machine, &image, None)?, &BOARD)?;
                agree(&answers, &expected, grid(&course))?;
                Ok(answers)
            });
            if let Some(answers) = answers {
                say::text(table(engine, &course, &answers).text());
            }
        }
    }
}

/// A unit of the finest grid of 16 bits that spans the mesh, or a little more.
fn grid(course: &Course) -> f64 {
    let positions = &course.subject.mesh.positions;
    let extent = |axis: usize| {
        let values = || positions.iter().map(|p| f64::from(p[axis]));
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    // Units are powers of two.
    (0..3).map(extent).fold(0.0, f64::max) * 2.0 / f64::from(u16::MAX)
}

fn table(engine: &str, course: &Course, answers: &Answers) -> Table {
    let triangles = course.subject.mesh.triangles.len();
    let title =
        format!("{engine} on {}, {triangles} triangles, {}", course.subject.name, BOARD.cpu);
    let columns = ["question", "count", "mean instructions", "max", "stack", "heap", "RAM"];
    let built = &answers.built;
    let mut table = Table::new("rival", title, &columns);
    for set in &answers.sets {
        table.push(vec![
            Cell::from(set.name.clone()),
            set.queries.into(),
            fixed(set.mean, 0),
            fixed(set.max, 0),
            set.stack.into(),
            set.heap.into(),
            (built.memory + built.heap + set.heap + set.stack).into(),
        ]);
    }
    let each = |bytes: u32| f64::from(bytes) / triangles as f64;
    table.note(format!(
        "built in {:.0} instructions with {} bytes of stack; heap after it {} bytes, {:.1} a triangle; most while it ran {}, {:.1} a triangle",
        built.instructions,
        built.stack,
        built.heap,
        each(built.heap),
        built.most,
        each(built.most)
    ));
    table.note("a tick is 40 instructions: a mean is within a few of them, a maximum within 40");
    table.note("bytes: the processor's stack, the heap beyond what building left, and all RAM that asking needs: with what building left, and what the engine keeps outside of the heap");
    table
}

/// Builds the image in which `engine` is asked; its path.
fn race(cross: &Cross, engine: &str, course: &Course) -> Result<PathBuf, String> {
    let name = format!("race_{engine}");
    let mut command = cargo(cross, "build");
    command.args(["--profile", Profile::Release.name()]);
    process::capture(command.args(["--bin", &name]).env("MESHSWEEP_RIVAL", &course.folder))?;
    Ok(folder(cross).join(BOARD.target).join(Profile::Release.name()).join(name))
}

fn lint(cross: &Cross, course: &Course) -> Result<(), String> {
    let mut command = cargo(cross, "clippy");
    command.env("MESHSWEEP_RIVAL", &course.folder);
    process::capture(command.args(["--lib", "--bins", "--", "-D", "warnings"])).map(drop)
}

#[cfg(test)]
mod tests {
    use super::Options;
    use std::path::PathBuf;

    #[test]
    fn words_come_in_any_order_and_have_defaults() {
        let options =
            Options::parse(&["--faces", "100,200", "a.ply", "--seed", "7"]).expect("fine");
        assert_eq!(
            options,
            Options { mesh: Some(PathBuf::from("a.ply")), faces: vec![100, 200], seed: 7 }
        );
        assert_eq!(Options::parse(&[]).expect("fine").faces, [2_500, 10_000]);
        assert_eq!(Options::parse(&["a.ply", "b.ply"]), None);
        assert_eq!(Options::parse(&["--faces", "many"]), None);
        assert_eq!(Options::parse(&["--fast"]), None);
    }
}
